//! What the program refuses, and that it says so soon and in one line.

use crate::place::{Place, SMALL};
use std::fs;

#[test]
fn options_out_of_range_are_refused() {
    let place = Place::new("options");
    place.refuse("render", &["<SCENE>"]);
    place.refuse("burn candle", &["burn"]);
    place.refuse("render bonfire", &["scene", "`bonfire`", "candle, oil_lamp, chandelier, torch"]);
    place.refuse("render candle --preset pretty", &["preset", "`pretty`", "paper, draft, fine"]);
    place.refuse("render candle --shading flat", &["--shading", "flat", "shell, volume"]);
    for size in ["0x0", "20000x20", "-1x5", "15x16", "4", "axb", "1e3x9"] {
        place.refuse(&format!("render candle --size {size}"), &["--size", size, "a size is "]);
    }
    for (option, values) in [
        ("--frames", &["0", "-3", "100001", "many"][..]),
        ("--fps", &["0", "-30", "nan"]),
        ("--warmup", &["-1", "inf", "601"]),
        ("--layers", &["0", "33", "-1"]),
        ("--seed", &["-1", "x"]),
    ] {
        for value in values {
            place.refuse(&format!("render candle {option} {value}"), &[option, value]);
        }
    }
    place.refuse("render candle --colour red", &["--colour"]);
    place.refuse("view candle", &["display", "lucerna render"]);
    place.refuse("export candle", &["--out <FOLDER>"]);
    for (option, value) in [("--format", "fbx"), ("--frames", "0"), ("--fps", "0"), ("--warmup", "-1"), ("--seed", "x")]
    {
        place.refuse(&format!("export candle --out e {option} {value}"), &[option, value]);
    }
    place.refuse("export bonfire --out e", &["scene", "`bonfire`", "candle, oil_lamp, chandelier, torch"]);
    assert!(!place.path("e").exists());
}

#[test]
fn places_that_cannot_be_written_to_are_refused_before_anything_burns() {
    let place = Place::new("unwritable");
    place.write("file", "not a folder");
    fs::create_dir(place.path("folder.json")).expect("a folder");
    for out in ["missing/a.png", "missing/a.gif", "file/a.png", "file/frames/"] {
        // A run that would take minutes.
        let line = format!("render campfire --warmup 600 --size 2000x2000 --out {out}");
        place.refuse(&line, &["cannot", out.trim_end_matches('/')]);
    }
    fs::create_dir_all(place.path("taken/lights.csv")).expect("a folder");
    for (out, options, named) in
        [("file", "", "file"), ("file/inside", "", "file/inside"), ("taken", "--lights", "taken/lights.csv")]
    {
        place.refuse(&format!("export campfire --warmup 600 --out {out} {options}"), &["cannot", named]);
    }
    place.refuse("render candle --out a.jpg", &["a.jpg", ".png, .gif or a folder"]);
    place.refuse("render candle --warmup 600 --report folder.json", &["cannot write", "folder.json"]);
    for (one, other) in
        [("--out a.png", "--report a.png"), ("--out ./a.gif", "--save a.gif"), ("--save a", "--report a")]
    {
        place.refuse(&format!("render candle --warmup 600 {one} {other}"), &["both", "overwrite"]);
    }
    place.refuse("render candle --fps 60 --out a.gif", &["GIF", "50 frames per second"]);
    let left: Vec<_> =
        fs::read_dir(&place.0).expect("the folder").map(|entry| entry.expect("an entry").file_name()).collect();
    assert!(left.iter().all(|name| !name.to_string_lossy().starts_with("a.")), "{left:?}");
}

#[test]
fn scene_files_that_say_what_cannot_be_are_refused_with_their_place() {
    let place = Place::new("scenes");
    place.refuse("render missing.ron", &["missing.ron", "(os error 2)"]);
    place.write_scene("", "");
    place.succeed(&format!("render scene.ron {SMALL} --out scene.png"));
    for (replaced, by, parts) in [
        ("    seed: 4,", "    sead: 4,", &["scene.ron:3:", "`sead`", "`seed`"][..]),
        ("slices: 2", "slises: 2", &["scene.ron:13:", "`slises`", "`slices`"]),
        ("slices: 2", "slices: 0", &["scene.ron: fires[0].skeletons.slices is 0", "1 to 64"]),
        ("slices: 2", "particles: 2", &["fires[0].skeletons.particles is 2", "3 to 32"]),
        ("(0.2, 0.3, 0.2)", "(0.2, -0.3, 0.2)", &["scene.ron: air.size_m[1] is -0.3", "above 0"]),
        ("(8, 12, 8)", "(100000, 100000, 100000)", &["scene.ron: air.cells[0] is 100000", "2 to 256"]),
        ("(8, 12, 8)", "(256, 256, 256)", &["scene.ron: air.cells is 256 x 256 x 256", "at most 4000000"]),
        ("(8, 12, 8)", "(8, -12, 8)", &["scene.ron:8:", "out of bounds"]),
        ("(-0.02, 0.0, 0.0)", "(-0.2, 0.0, 0.0)", &["fires[0].wicks[0].points[0]", "inside the air"]),
        ("(-0.02, 0.0, 0.0)", "(NaN, 0.0, 0.0)", &["fires[0].wicks[0].points[0]", "NaN"]),
        ("radius_m: 0.002", "radius_m: 0.0", &["fires[0].wicks[0].radius_m is 0"]),
        ("fires: [", "fires: [], meshes: [", &["scene.ron:"]),
    ] {
        place.write_scene(replaced, by);
        place.refuse(&format!("render scene.ron {SMALL} --out never.png"), parts);
    }
    assert!(!place.path("never.png").exists());
}
