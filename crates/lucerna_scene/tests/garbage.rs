//! Files that are cut short or damaged anywhere give a scene or an error, never a panic.

mod common;

use common::{folder, triangle_glb, triangle_gltf, with_mesh, with_wick};
use lucerna_scene::{LoadedScene, parse};
use std::path::Path;

/// A fixed sequence of numbers that look random.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self, below: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % below
    }
}

/// Damages bytes in one to four places: other bytes, bytes that mean something, cuts, repeats.
fn damage(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    const TELLING: &[u8] = b"\0\n\r\\/-0159.eE,:()[]{}\" \xff\xe9v";
    let mut bytes = bytes.to_vec();
    for _ in 0..=numbers.next(4) {
        let at = numbers.next(bytes.len().max(1)).min(bytes.len().saturating_sub(1));
        match numbers.next(5) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..(at + 1 + numbers.next(8)).min(bytes.len()))),
            2 => {
                let piece = bytes[at..(at + 12).min(bytes.len())].to_vec();
                bytes.splice(at..at, piece);
            }
            3 if at < bytes.len() => bytes[at] = numbers.next(256) as u8,
            _ if at < bytes.len() => bytes[at] = TELLING[numbers.next(TELLING.len())],
            _ => {}
        }
    }
    bytes
}

#[test]
fn scene_files() {
    let mut numbers = Numbers(1);
    let text = include_str!("../scenes/torch.ron");
    for _ in 0..1500 {
        let damaged = damage(text.as_bytes(), &mut numbers);
        let damaged = String::from_utf8_lossy(&damaged);
        if let Ok(scene) = parse(&damaged, Path::new("damaged.ron")) {
            let _ = lucerna_scene::validate(&scene);
        }
    }
    for end in 0..text.len() {
        if text.is_char_boundary(end) {
            assert!(parse(&text[..end], Path::new("cut.ron")).is_err() || text[end..].trim().is_empty(), "{end}");
        }
    }
}

#[test]
fn obj_and_mtl_files() {
    let folder = folder("garbage_obj_and_mtl_files");
    let obj = b"mtllib m.mtl\no one\nv 0 0 0 1 1 1\nv 1 0 0 1 .5 0\nv 1 1 0 0 0 0\nv 0 1 0 1 1 1\nvn 0 0 1\nvt 0 0\n\
                usemtl a\ng Wick one\nf 1/1/1 2/1/1 3/1/1 4/1/1\nusemtl b\nf -4//1 -3//1 -2//1\nl 1 2 3\n";
    let mtl = b"newmtl a\nKd 0.5 0.5 0.5\nKe 1 0 0\nd 1\nillum 2\nnewmtl b\nKd 0.1\nmap_Kd a b.png\nNs 10\nNi 1.5\n";
    let mut numbers = Numbers(2);
    for round in 0..500 {
        let material = if round % 2 == 0 { damage(mtl, &mut numbers) } else { mtl.to_vec() };
        std::fs::write(folder.join("m.mtl"), material).unwrap();
        let damaged = damage(obj, &mut numbers);
        check(with_mesh(&folder, "damaged.obj", &damaged));
        check(with_wick(&folder, "damaged.obj", &damaged));
    }
}

#[test]
fn random_bytes() {
    let folder = folder("garbage_random_bytes");
    let mut numbers = Numbers(3);
    for round in 0..150 {
        let mut bytes: Vec<u8> = (0..numbers.next(600)).map(|_| numbers.next(256) as u8).collect();
        if round % 3 == 0 {
            // Text of sorts, so that it is read beyond its first bytes.
            let words: [&[u8]; 8] = [b"v ", b"f ", b"1 ", b"-2 ", b"\n", b"vn ", b"3/4/5 ", b"1e9 "];
            bytes = (0..100).flat_map(|_| words[numbers.next(words.len())].to_vec()).collect();
        }
        for name in ["r.obj", "r.gltf", "r.glb"] {
            check(with_mesh(&folder, name, &bytes));
            check(with_wick(&folder, name, &bytes));
        }
    }
}

#[test]
fn gltf_and_glb_files() {
    let folder = folder("garbage_gltf_and_glb_files");
    let (json, bytes) = triangle_gltf("\"uri\":\"t.bin\",");
    std::fs::write(folder.join("t.bin"), bytes).unwrap();
    let glb = triangle_glb();
    let mut numbers = Numbers(4);
    for _ in 0..700 {
        check(with_mesh(&folder, "damaged.gltf", &damage(json.as_bytes(), &mut numbers)));
        check(with_wick(&folder, "damaged.glb", &damage(&glb, &mut numbers)));
    }
    for end in 0..glb.len() {
        check(with_mesh(&folder, "cut.glb", &glb[..end]));
    }
}

/// What was loaded can be drawn: indices in range, normals of length one.
fn check(result: Result<LoadedScene, lucerna_scene::SceneError>) {
    match result {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(loaded) => {
            for mesh in &loaded.meshes {
                assert!(mesh.indices.iter().all(|&index| (index as usize) < mesh.vertices.len()));
                for vertex in &mesh.vertices {
                    let length = vertex.normal.iter().map(|x| x * x).sum::<f32>();
                    assert!((length - 1.0).abs() < 1.0e-3, "{vertex:?}");
                    assert!(vertex.position.iter().chain(&vertex.emission).all(|x| x.is_finite()), "{vertex:?}");
                }
            }
        }
    }
}
