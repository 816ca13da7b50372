//! Scene files: what is wrong is said with its place.

mod common;

use common::{folder, message, smallest};
use lucerna_scene::{builtin, load, open, parse};
use std::path::Path;

#[track_caller]
fn fault(text: &str, expected: &str) {
    let error = parse(text, Path::new("torch.ron")).expect_err(expected).to_string();
    assert_eq!(error, expected);
}

#[test]
fn unknown_and_missing_fields_are_named() {
    fault(
        "(\n    name: \"x\",\n    wind: 3,\n)",
        "torch.ron:3:5: Unexpected field named `wind` in `Scene`, expected one of `name`, `seed`, `camera`, `camera_path`, \
         `look`, `air`, `fires`, `meshes`, `detail`, or `motions` instead",
    );
    fault("(\n    name: \"x\",\n)", "torch.ron:3:1: Unexpected missing field named `air` in `Scene`");
    fault("(name: 3)", "torch.ron:1:7: Expected string");
    fault("(name: \"x\"", "torch.ron:1:9: Expected comma");
    fault("", "torch.ron:1:1: Expected opening `(` for struct `Scene`");
}

#[test]
fn a_value_is_named_with_its_file() {
    let folder = folder("a_value_is_named_with_its_file");
    let text = smallest().to_ron().unwrap().replace("(8, 8, 8)", "(8, 0, 8)");
    std::fs::write(folder.join("torch.ron"), text).unwrap();
    let result = load(&folder.join("torch.ron"));
    assert_eq!(message(&folder, result), "torch.ron: air.cells[1] is 0: must be 2 to 256");
}

#[test]
fn files_that_are_not_scenes() {
    let folder = folder("files_that_are_not_scenes");
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.join(name), bytes).unwrap();
    write("latin.ron", b"(\n  name: \"caf\xe9\")");
    let result = load(&folder.join("latin.ron"));
    assert_eq!(message(&folder, result), "latin.ron:2:13: is not UTF-8 text");
    let result = load(&folder.join("missing.ron"));
    assert_eq!(message(&folder, result), "missing.ron: No such file or directory (os error 2)");
    std::fs::create_dir(folder.join("folder.ron")).unwrap();
    assert_eq!(message(&folder, load(&folder.join("folder.ron"))), "folder.ron: is not a regular file");
    write("deep.ron", "(".repeat(100_000).as_bytes());
    assert!(load(&folder.join("deep.ron")).is_err());
    let large = std::fs::File::create(folder.join("large.ron")).unwrap();
    large.set_len(1 << 30).unwrap();
    let result = load(&folder.join("large.ron"));
    assert_eq!(message(&folder, result), "large.ron: is 1073741824 bytes long: must be at most 16 MiB");
}

#[test]
fn names_that_are_unknown() {
    assert_eq!(
        builtin("bonfire").unwrap_err().to_string(),
        "there is no scene named `bonfire`: must be candle, oil_lamp, chandelier, torch, torch_swung, campfire, ring_burner, line_burner, wind, hall"
    );
    assert_eq!(
        open("bonfire").unwrap_err().to_string(),
        "there is no scene named `bonfire`: must be candle, oil_lamp, chandelier, torch, torch_swung, campfire, ring_burner, line_burner, wind, hall, or the path of a scene file"
    );
    let mut scene = smallest();
    assert_eq!(
        lucerna_scene::apply_preset(&mut scene, "pretty").unwrap_err().to_string(),
        "there is no preset named `pretty`: must be paper, draft, fine"
    );
}

#[test]
fn a_mesh_is_found_beside_its_scene() {
    let folder = folder("a_mesh_is_found_beside_its_scene");
    std::fs::create_dir(folder.join("things")).unwrap();
    std::fs::write(folder.join("things/one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let mut scene = smallest();
    let source = lucerna_scene::MeshSource {
        position_m: [0.0, 2.0, 0.0],
        scale: 0.5,
        ..lucerna_scene::MeshSource::new("things/one.obj")
    };
    scene.meshes.push(source);
    std::fs::write(folder.join("one.ron"), scene.to_ron().unwrap()).unwrap();
    let loaded = load(&folder.join("one.ron")).unwrap();
    assert_eq!(loaded.scene, scene);
    assert_eq!(loaded.meshes[0].vertices[1].position, [0.5, 2.0, 0.0]);
}
