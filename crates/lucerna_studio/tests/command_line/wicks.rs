//! Wicks from files: small ones, large ones, and files that are none.

use crate::place::{POLYLINE, Place, SMALL};
use std::fmt::Write;
use std::fs;

#[test]
fn wick_files_that_are_no_wicks_are_refused_by_name() {
    let place = Place::new("wicks");
    let with_wick = |file: &str| place.write_scene(POLYLINE, &format!("mesh(file: \"{file}\")"));
    let render = format!("render scene.ron {SMALL} --out never.png");
    let good = "o wick\nv -0.02 0 0\nv 0.02 0 0\nv 0 0.001 0\nf 1 2 3\n";

    with_wick("missing.obj");
    place.refuse(&render, &["missing.obj", "(os error 2)"]);
    place.write("picture.obj", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0");
    place.write("picture.png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0");
    for (name, text, parts) in [
        ("empty.obj", "", &["empty.obj", "is empty"][..]),
        ("empty.glb", "", &["empty.glb", "is empty"]),
        ("hollow.obj", "# nothing\no wick\n", &["hollow.obj", "no vertices"]),
        ("nan.obj", &good.replace("0.02 0 0", "nan 0 0"), &["nan.obj:2", "nan", "finite"]),
        ("huge.obj", &good.replace("0.02 0 0", "1e30 0 0"), &["fires[0].wicks[0]", "inside the air"]),
        ("beyond.obj", &good.replace("f 1 2 3", "f 1 2 4"), &["beyond.obj:5", "index 4"]),
        ("cut.glb", "glTF", &["cut.glb", "not a glTF"]),
    ] {
        place.write(name, text);
        with_wick(name);
        place.refuse(&render, parts);
    }
    for name in ["picture.obj", "picture.png"] {
        with_wick(name);
        place.refuse(&render, &[name, "is not"]);
    }
    assert!(!place.path("never.png").exists());

    place.write("good.obj", good);
    with_wick("good.obj");
    place.succeed(&format!("render scene.ron {SMALL} --out good.png"));
}

#[test]
fn a_wick_of_one_point_burns() {
    let place = Place::new("one_point");
    let draw = |scene: &str, from: &str| {
        place.write_scene(POLYLINE, scene);
        place.succeed("render scene.ron --size 64x48 --warmup 0.5 --report report.json --out one.png");
        assert!(place.report()["layers"].as_u64().is_some_and(|layers| layers >= 2), "no flame on {from}");
    };
    draw("polyline(points: [(0.0, 0.0, 0.0)], radius_m: 0.002)", "a point");
    place.write("point.obj", "v 0 0 0\n");
    draw("mesh(file: \"point.obj\")", "a mesh of one vertex");
}

/// A wick scanned too finely: half a million vertices, a million faces.
#[test]
fn a_wick_of_a_million_faces_burns() {
    let place = Place::new("million");
    let (along, around) = (5000, 100);
    let mut obj = String::with_capacity(60 << 20);
    obj.push_str("o wick\n");
    for i in 0..along {
        let x = 0.04 * i as f32 / along as f32 - 0.02;
        for j in 0..around {
            let (sin, cos) = (std::f32::consts::TAU * j as f32 / around as f32).sin_cos();
            let _ = writeln!(obj, "v {x:.6} {:.6} {:.6}", 0.002 * sin, 0.002 * cos);
        }
    }
    let mut faces = 0;
    for i in 1..along {
        for j in 0..around {
            let (a, b) = ((i - 1) * around + j + 1, (i - 1) * around + (j + 1) % around + 1);
            let _ = writeln!(obj, "f {a} {b} {}\nf {b} {} {}", a + around, b + around, a + around);
            faces += 2;
        }
    }
    assert!(faces > 990_000);
    place.write("million.obj", obj);
    let run = |wick: &str| {
        place.write_scene(POLYLINE, wick);
        let run = place.run("render scene.ron --size 64x48 --warmup 0.2 --report report.json");
        assert_eq!(run.code, Some(0), "{run:?}");
        (run.took, place.report()["triangles"].clone(), place.report()["layers"].clone())
    };
    let (took, triangles, layers) = run("mesh(file: \"million.obj\")");
    println!("a million faces: {took:?}");
    // The flame of a line, not that of a point.
    assert_eq!(triangles, run(POLYLINE).1);
    assert_ne!(triangles, run("polyline(points: [(0.0, 0.0, 0.0)], radius_m: 0.002)").1);
    assert!(layers.as_u64().is_some_and(|layers| layers >= 2), "{layers}");
    fs::remove_file(place.path("million.obj")).expect("a large file is cleared away");
}
