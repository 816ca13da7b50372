//! Mesh and wick files that cannot be used: one clear message each, at once.

mod common;

use common::{folder, message, smallest, triangle_glb, triangle_gltf, with_mesh, with_wick};
use lucerna_scene::{LoadedScene, WickSource};

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x06\0\0\0\x1f\x15\xc4\x89";

#[test]
fn wicks() {
    let folder = folder("import_faults_wicks");
    let cases: &[(&str, &[u8], &str)] = &[
        ("empty.obj", b"", "empty.obj: is empty"),
        ("comment.obj", b"# nothing\r\n", "comment.obj: has no vertices"),
        ("text.obj", b"Dear reader,\nthis is no mesh.\n", "text.obj: has no vertices"),
        ("picture.obj", PNG, "picture.obj: is not an OBJ file: it is not text"),
        ("picture.png", PNG, "picture.png: is not a mesh file: must be .obj, .gltf or .glb"),
        ("nan.obj", b"v 0 0 0\nv 0 nan 0\n", "nan.obj:2: `nan` in `v` is not a finite number"),
        ("inf.obj", b"v 0 1e99 0\n", "inf.obj:1: `1e99` in `v` is not a finite number"),
        ("word.obj", b"v 0 zero 0\n", "word.obj:1: `zero` in `v` is not a number"),
        ("two.obj", b"v 0 0\n", "two.obj:1: a vertex has 2 numbers: must be 3, 4 or 6"),
        ("weight.obj", b"v 1 0 0 0\n", "weight.obj:1: the weight of the vertex is 0: must not be 0"),
        (
            "far.obj",
            b"v 0 5 0\n",
            "fires[0].wicks[0] is at (0, 5, 0): must be inside the air, from (-1, -1, -1) to (1, 1, 1)",
        ),
        ("index.obj", b"v 0 0 0\n\nf 1 2 3\n", "index.obj:3: index 2 is out of range: there are 1 vertices so far"),
        (
            "huge.obj",
            b"v 0 0 0\nf 1 1 9223372036854775807\n",
            "huge.obj:2: index 9223372036854775807 is out of range: there are 1 vertices so far",
        ),
        (
            "least.obj",
            b"v 0 0 0\nf 1 1 -9223372036854775808\n",
            "least.obj:2: index -9223372036854775808 is out of range: there are 1 vertices so far",
        ),
        ("zero.obj", b"v 0 0 0\nf 0 1 1\n", "zero.obj:2: index 0 is out of range: there are 1 vertices so far"),
        ("slash.obj", b"v 0 0 0\nf 1/1/1/1 1 1\n", "slash.obj:2: index 1 is out of range: there are 0 normals so far"),
        ("corner.obj", b"v 0 0 0\nf 1/x 1 1\n", "corner.obj:2: `1/x` is not a corner of a face"),
    ];
    for (name, bytes, expected) in cases {
        assert_eq!(message(&folder, with_wick(&folder, name, bytes)), *expected);
    }
    let mut scene = smallest();
    scene.fires[0].wicks = vec![WickSource::mesh("gone.obj")];
    let result = LoadedScene::from_scene(scene, &folder);
    assert_eq!(message(&folder, result), "gone.obj: No such file or directory (os error 2)");
}

#[test]
fn too_large() {
    let folder = folder("import_faults_too_large");
    std::fs::File::create(folder.join("large.obj")).unwrap().set_len(1 << 40).unwrap();
    let mut scene = smallest();
    scene.fires[0].wicks = vec![WickSource::mesh("large.obj")];
    let result = LoadedScene::from_scene(scene, &folder);
    assert_eq!(message(&folder, result), "large.obj: is 1099511627776 bytes long: must be at most 512 MiB");
    let many = "v 0 0 0\n".repeat(4_000_001);
    let result = with_wick(&folder, "many.obj", many.as_bytes());
    assert_eq!(message(&folder, result), "many.obj: has more than 4000000 vertices");
}

#[test]
fn meshes() {
    let folder = folder("import_faults_meshes");
    std::fs::write(folder.join("bad.mtl"), "newmtl a\nKd 0.1 0.2\n").unwrap();
    std::fs::write(folder.join("nan.mtl"), "newmtl a\nKe nan 0 0\n").unwrap();
    let cases: &[(&str, &[u8], &str)] = &[
        ("points.obj", b"v 0 0 0\nv 1 0 0\nf 1 2\n", "points.obj: has no faces"),
        (
            "partly.obj",
            b"v 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "partly.obj: has colours on some of its vertices: must be all or none",
        ),
        ("mtl.obj", b"mtllib bad.mtl\nv 0 0 0\n", "bad.mtl:2: `Kd` has 2 numbers: must be 1 or 3"),
        ("mtl2.obj", b"mtllib nan.mtl\nv 0 0 0\n", "nan.mtl:2: `Ke` holds `nan`: must be a finite number"),
        ("mtl3.obj", b"mtllib .\nv 0 0 0\n", ".: is not a regular file"),
    ];
    for (name, bytes, expected) in cases {
        assert_eq!(message(&folder, with_mesh(&folder, name, bytes)), *expected);
    }
}

#[test]
fn gltf() {
    let folder = folder("import_faults_gltf");
    let (json, bytes) = triangle_gltf("\"uri\":\"t.bin\",");
    std::fs::write(folder.join("t.bin"), &bytes).unwrap();
    let cases = [
        ("\"uri\":\"t.bin\"", "\"uri\":\"gone.bin\"", "gone.bin: No such file or directory (os error 2)"),
        (
            "\"uri\":\"t.bin\"",
            "\"uri\":\"http://t.bin\"",
            "t.gltf: its buffer 0 is `http://t.bin`: must be a relative path",
        ),
        ("\"uri\":\"t.bin\"", "\"uri\":\"%FF\"", "t.gltf: its buffer 0 is `%FF`: must be a relative path"),
        ("\"uri\":\"t.bin\",", "", "t.gltf: its buffer 0 is missing from the file"),
        ("\"byteLength\":56", "\"byteLength\":5600", "t.gltf: its buffer 0 has 56 bytes: must be 5600"),
        (
            "\"byteOffset\":36",
            "\"byteOffset\":18446744073709551615",
            "t.gltf: its accessor 1 reaches beyond its buffer",
        ),
        ("5123,\"count\":3", "5123,\"count\":3000", "t.gltf: its accessor 2 reaches beyond its buffer"),
        ("5123,\"count\":3", "5123,\"count\":0", "t.gltf: its accessor 2 has 0 items: must be 1 to 24000000"),
        ("\"byteLength\":36", "\"byteLength\":36,\"byteStride\":4", "t.gltf: its accessor 0 reaches beyond its buffer"),
        ("5123,", "5126,", "t.gltf: its accessor 2 has a type that is not allowed where it is used"),
        ("\"children\":[1]", "\"children\":[0]", "t.gltf: its node 0 has more than one parent"),
        ("\"children\":[1]", "\"children\":[]", "t.gltf: has no faces"),
    ];
    for (from, to, expected) in cases {
        assert!(json.contains(from), "{from}");
        let result = with_mesh(&folder, "t.gltf", json.replace(from, to).as_bytes());
        assert_eq!(message(&folder, result), expected, "{from} -> {to}");
    }
    for (name, bytes) in [("a.gltf", &b"{}"[..]), ("b.glb", PNG), ("c.glb", b"glTF"), ("d.gltf", b"not json")] {
        let text = message(&folder, with_mesh(&folder, name, bytes));
        assert!(text.starts_with(&format!("{name}: is not a glTF file: ")), "{text}");
    }
    // A face that names a vertex that is not there.
    let mut glb = triangle_glb();
    let last = glb.len() - 4;
    glb[last] = 9;
    let result = with_mesh(&folder, "i.glb", &glb);
    assert_eq!(message(&folder, result), "i.glb: has index 9 where there are 3 vertices");
}
