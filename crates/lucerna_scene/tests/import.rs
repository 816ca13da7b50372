//! Meshes and wicks as they come from the wild.

mod common;

use common::{folder, message, smallest, triangle_glb, triangle_gltf, with_mesh, with_wick};
use lucerna_flame::WickShape;
use lucerna_scene::{LoadedScene, WickSource};
use std::fmt::Write;
use std::time::Instant;

fn vertices(wick: &WickShape) -> &[[f32; 3]] {
    match wick {
        WickShape::Vertices(vertices) => vertices,
        other => panic!("not vertices: {other:?}"),
    }
}

#[test]
fn crlf_latin1_backslashes_and_mixed_corners() {
    let folder = folder("crlf_latin1_backslashes_and_mixed_corners");
    std::fs::create_dir(folder.join("mat")).unwrap();
    let mtl = b"# \xe9\r\nnewmtl ch\xeane clair\r\n Kd 0.2 0.4 0.6\r\nKs\r\nNs\r\nmap_Kd missing \\ texture.png\r\nmap_kS\r\n\
                newmtl lit\r\nKd 0.5\r\nKe 1 0.5 0.25\r\nillum\r\n";
    std::fs::write(folder.join("mat/my colours.mtl"), mtl).unwrap();
    let obj =
        b"# caf\xe9\r\nmtllib mat\\my colours.mtl\r\no B\xfbche un\r\nv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\n\
                vt 0 0\r\nvt 1 0\r\nusemtl ch\xeane clair\r\ng a b\r\nf 1/1 2/2 \\\r\n 3/1 4/2\r\ng c\r\nusemtl lit\r\n\
                f 1 2 3\r\nf -4//  -3 -2\r\nl 1 2 3 4\r\ns off\r\ncurv 1 2\r\n";
    let loaded = with_mesh(&folder, "wild one.OBJ", obj).unwrap();
    let mesh = &loaded.meshes[0];
    assert_eq!(mesh.indices.len(), 3 * 4);
    let colours: Vec<_> = mesh.vertices.iter().map(|vertex| vertex.color).collect();
    assert!(colours.contains(&[0.2, 0.4, 0.6]) && colours.contains(&[0.5; 3]), "{colours:?}");
    assert!(mesh.vertices.iter().any(|vertex| vertex.emission == [1.0, 0.5, 0.25]));
    assert!(mesh.vertices.iter().all(|vertex| vertex.normal == [0.0, 0.0, 1.0]));
}

#[test]
fn a_missing_material_file_is_grey() {
    let folder = folder("a_missing_material_file_is_grey");
    let obj = b"mtllib gone.mtl\nusemtl gone\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let loaded = with_mesh(&folder, "grey.obj", obj).unwrap();
    assert!(loaded.meshes[0].vertices.iter().all(|v| v.color == [0.5; 3] && v.emission == [0.0; 3]));
}

#[test]
fn vertex_colours_multiply_the_material() {
    let folder = folder("vertex_colours_multiply_the_material");
    std::fs::write(folder.join("m.mtl"), "newmtl m\nKd 0.5 0.5 0.5\nKe 2 2 2\n").unwrap();
    let obj = b"mtllib m.mtl\nusemtl m\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
    let loaded = with_mesh(&folder, "c.obj", obj).unwrap();
    let first = loaded.meshes[0].vertices[0];
    assert_eq!((first.color, first.emission), ([0.5, 0.0, 0.0], [2.0, 0.0, 0.0]));
}

#[test]
fn creases_stay_sharp_and_curves_smooth() {
    let folder = folder("creases_stay_sharp_and_curves_smooth");
    // A strip that bends by 30 degrees, then by 90.
    let mut obj = String::new();
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.866, 0.5], [1.366, 1.366]] {
        writeln!(obj, "v {x} {y} 0\nv {x} {y} -1").unwrap();
    }
    obj += "f 1 3 4 2\nf 3 5 6 4\nf 5 7 8 6\n";
    let mesh = &with_mesh(&folder, "strip.obj", obj.as_bytes()).unwrap().meshes[0];
    assert_eq!(mesh.vertices.len(), 10, "two of eight points are split");
    let bent = mesh.vertices.iter().find(|vertex| vertex.position == [1.0, 0.0, 0.0]).unwrap();
    assert!((bent.normal[0] + 0.2588).abs() < 0.01 && (bent.normal[1] - 0.9659).abs() < 0.01, "{bent:?}");
}

#[test]
fn gltf_in_all_its_forms() {
    let folder = folder("gltf_in_all_its_forms");
    let (_, bytes) = triangle_gltf("");
    std::fs::write(folder.join("a b.bin"), &bytes).unwrap();
    let external = triangle_gltf("\"uri\":\"a%20b.bin\",").0;
    let embedded = triangle_gltf(&format!("\"uri\":\"data:application/octet-stream;base64,{}\",", base64(&bytes))).0;
    let glb = triangle_glb();
    for (name, file) in [("a.gltf", external.as_bytes()), ("b.gltf", embedded.as_bytes()), ("c.glb", &glb)] {
        let loaded = with_mesh(&folder, name, file).unwrap();
        let mesh = &loaded.meshes[0];
        assert_eq!((mesh.vertices.len(), mesh.indices.as_slice()), (3, &[0, 1, 2][..]), "{name}");
        let vertex = mesh.vertices[1];
        assert_eq!((vertex.position, vertex.normal), ([0.5, 0.5, 0.0], [0.0, 0.0, 1.0]), "{name}");
        assert_eq!(vertex.emission, [3.0, 1.5, 0.0], "{name}");
        assert!((vertex.color[1] - 0.251).abs() < 1.0e-3, "{name}: {vertex:?}");
        assert_eq!(vertices(&with_wick(&folder, name, file).unwrap().wicks[0][0]).len(), 3, "{name}");
    }
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let bits = three.iter().fold(0, |bits, &byte| bits << 8 | u32::from(byte)) << (8 * (3 - three.len()));
        for digit in 0..4 {
            let index = (bits >> (18 - 6 * digit)) as usize & 63;
            text.push(if digit > three.len() { '=' } else { char::from(DIGITS[index]) });
        }
    }
    text
}

#[test]
fn one_vertex_is_a_candle() {
    let folder = folder("one_vertex_is_a_candle");
    let loaded = with_wick(&folder, "point.obj", b"v 0 0.5 0\n").unwrap();
    assert_eq!(loaded.wicks, [[WickShape::Vertices(vec![[0.0, 0.5, 0.0]])]]);
}

#[test]
fn groups_named_for_wicks_are_wicks() {
    let folder = folder("groups_named_for_wicks_are_wicks");
    let obj = b"v 0 0 0\nv .1 0 0\nv 0 .1 0\nv .5 0 0\nv .5 .1 0\nv .5 0 .1\no bowl\nf 4 5 6\n\
                o Wick_left\nf 1 2 3\nl 1 2\no wick.right\nl 4 5\n";
    let several = message(&folder, with_wick(&folder, "lamp.obj", obj));
    assert_eq!(several, "lamp.obj: has several wicks: group must be one of `Wick_left`, `wick.right`");
    let mut scene = smallest();
    let wick = |group: &str| WickSource::Mesh {
        file: "lamp.obj".into(),
        group: Some(group.to_owned()),
        position_m: [0.0; 3],
        rotation_deg: [0.0; 3],
        scale: 1.0,
        gap_m: None,
    };
    scene.fires[0].wicks = vec![wick("Wick_left"), wick("wick.right"), wick("bowl")];
    let text = scene.to_ron().unwrap();
    assert_eq!(lucerna_scene::parse(&text, "lamp.ron".as_ref()).unwrap(), scene);
    let loaded = LoadedScene::from_scene(scene.clone(), &folder).unwrap();
    let counts: Vec<usize> = loaded.wicks[0].iter().map(|wick| vertices(wick).len()).collect();
    assert_eq!(counts, [3, 2, 3]);
    scene.fires[0].wicks = vec![wick("middle")];
    let missing = message(&folder, LoadedScene::from_scene(scene, &folder));
    assert_eq!(missing, "lamp.obj: has no group named `middle`");
    // A single one needs no name.
    let loaded =
        with_wick(&folder, "one.obj", b"v 0 0 0\nv .1 0 0\nv 0 .1 0\ng Wick\nl 1 2\ng rest\nf 1 2 3\n").unwrap();
    assert_eq!(vertices(&loaded.wicks[0][0]).len(), 2);
}

#[test]
fn a_million_faces_are_a_wick() {
    let folder = folder("a_million_faces_are_a_wick");
    let side = 708;
    let mut obj = String::new();
    for index in 0..side * side {
        let (x, z) = (index % side, index / side);
        writeln!(obj, "v {} 0.1 {}", x as f32 / 1000.0, z as f32 / 1000.0).unwrap();
    }
    for index in 0..(side - 1) * (side - 1) {
        let corner = 1 + index % (side - 1) + index / (side - 1) * side;
        writeln!(obj, "f {corner} {} {}\nf {} {} {corner}", corner + 1, corner + side, corner + side, corner + 1)
            .unwrap();
    }
    std::fs::write(folder.join("many.obj"), obj).unwrap();
    let mut scene = smallest();
    scene.fires[0].wicks = vec![WickSource::mesh("many.obj")];
    let start = Instant::now();
    let loaded = LoadedScene::from_scene(scene, &folder).unwrap();
    let time = start.elapsed();
    // No face uses the last corner.
    assert_eq!(vertices(&loaded.wicks[0][0]).len(), side * side - 1);
    println!("a million faces: {time:?}");
}
