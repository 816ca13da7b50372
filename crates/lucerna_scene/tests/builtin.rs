//! The scenes that come with the crate, presets, and writing scenes.

mod common;

use lucerna_frame::OpaqueMesh;
use lucerna_scene::{LoadedScene, apply_preset, builtin, builtin_names, load, open, parse, presets, validate};
use std::path::Path;

#[test]
fn embedded_scenes_are_those_on_disk() {
    for name in builtin_names() {
        let embedded = builtin(name).unwrap();
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.ron"));
        assert_eq!(embedded, load(&path).unwrap(), "{name}");
        assert_eq!(embedded, open(name).unwrap(), "{name}");
        assert_eq!(embedded, LoadedScene::from_scene(embedded.scene.clone(), Path::new("nowhere")).unwrap(), "{name}");
        // A ring is three arcs.
        let flames = if *name == "ring_burner" { 3 } else { embedded.scene.fires[0].wicks.len() };
        assert_eq!(embedded.wicks[0].len(), flames, "{name}");
    }
}

#[test]
fn built_in_meshes_are_sound() {
    for name in builtin_names() {
        let loaded = builtin(name).unwrap();
        let triangles: usize = loaded.meshes.iter().map(|mesh| mesh.indices.len() / 3).sum();
        assert!((1000..80_000).contains(&triangles), "{name} has {triangles} triangles");
        let burnt = ["torch", "torch_swung", "campfire"].contains(name);
        assert!(!burnt || loaded.meshes.iter().any(glows), "{name} has nothing that glows");
        for mesh in &loaded.meshes {
            for vertex in &mesh.vertices {
                let length = vertex.normal.iter().map(|x| x * x).sum::<f32>().sqrt();
                assert!((length - 1.0).abs() < 1.0e-3, "{name}: {vertex:?}");
                assert!(vertex.position.iter().all(|x| x.abs() < 13.0), "{name}: {vertex:?}");
                assert!(vertex.color.iter().all(|c| (0.0..=0.9).contains(c)), "{name}: {vertex:?}");
            }
        }
    }
}

fn glows(mesh: &OpaqueMesh) -> bool {
    mesh.vertices.iter().any(|vertex| vertex.emission[0] > 0.01)
}

#[test]
fn scenes_survive_writing() {
    for name in builtin_names() {
        let scene = builtin(name).unwrap().scene;
        let text = scene.to_ron().unwrap();
        assert_eq!(parse(&text, Path::new(name)).unwrap(), scene, "{text}");
    }
}

#[test]
fn presets_give_scenes_that_load() {
    for name in builtin_names() {
        let first = builtin(name).unwrap().scene;
        for preset in presets() {
            let mut scene = first.clone();
            apply_preset(&mut scene, preset).unwrap();
            validate(&scene).unwrap();
            let burns = scene.fires.iter().any(|fire| fire.drive != lucerna_flame::Drive::RootForces);
            assert!(!burns || *preset != "paper", "{name}: the closed box of the authors has no room for burnt gas");
            assert_eq!((&scene.camera, &scene.meshes), (&first.camera, &first.meshes), "{name} {preset}");
            let mut again = scene.clone();
            apply_preset(&mut again, preset).unwrap();
            // Twice as fine is finer still.
            if *preset != "fine" {
                assert_eq!(again, scene, "{name} {preset}");
            }
            LoadedScene::from_scene(scene, Path::new("")).unwrap();
        }
    }
}

#[test]
fn the_paper_preset_is_what_the_authors_run() {
    let mut scene = builtin("torch").unwrap().scene;
    apply_preset(&mut scene, "paper").unwrap();
    assert_eq!((scene.air.cells, scene.look.layers), ([15; 3], 4));
    assert_eq!((scene.fires[0].skeletons.slices, scene.fires[0].skeletons.particles), (2, 8));
    assert_eq!(
        scene.look.glow.iter().map(|level| (level.divisor, level.gain)).collect::<Vec<_>>(),
        [(1, 1.0), (4, 1.0)]
    );
    assert_eq!(scene.air.size_m, [1.2; 3]);
    let mut scene = builtin("candle").unwrap().scene;
    apply_preset(&mut scene, "paper").unwrap();
    assert_eq!(scene.look.layers, 2);
}

#[test]
fn fine_air_is_not_forced_on_fires_that_were_set_for_coarse_air() {
    let cells = |name: &str| {
        let mut scene = builtin(name).unwrap().scene;
        let before = (scene.air.cells, scene.fires[0].air);
        apply_preset(&mut scene, "fine").unwrap();
        assert_eq!(scene.fires[0].surface.around, 64, "{name}");
        (before.0, scene.air.cells, before.1, scene.fires[0].air)
    };
    assert_eq!(cells("candle").0, cells("candle").1);
    let torch = cells("torch");
    assert_eq!(torch.0.map(|n| 2 * n), torch.1);
    // Candles in an air of their own each; the air of the scene has no fire.
    let hall = cells("hall");
    assert_eq!((hall.0.map(|n| 2 * n), hall.2), (hall.1, hall.3));
}

#[test]
fn the_example_of_the_format_page_loads() {
    let page = include_str!("../../../docs/scene_format.md");
    let mut examples = page.split("```ron\n").skip(1);
    let text = examples.next().unwrap().split("```").next().unwrap();
    let scene = parse(text, Path::new("docs/scene_format.md")).unwrap();
    LoadedScene::from_scene(scene, Path::new("")).unwrap();
}

/// Every field of every struct of a scene is described, and its default is as the page says.
#[test]
fn the_format_page_is_up_to_date() {
    let page = include_str!("../../../docs/scene_format.md");
    let text = common::smallest().to_ron().unwrap();
    // Lines of one field each: the text is as deep as that.
    for (field, value) in text.lines().filter_map(|line| line.trim().split_once(": ")) {
        if field.contains('(') {
            continue;
        }
        let row = page.lines().find(|line| line.starts_with(&format!("| `{field}` |")));
        let row = row.unwrap_or_else(|| panic!("{field} is not described"));
        let value = value.trim_end_matches(',').parse::<f64>();
        let said = row.split(" | ").nth(2).unwrap_or_default().parse::<f64>();
        if let (Ok(value), Ok(said)) = (value, said) {
            assert!((value - said).abs() <= 1.0e-6 * said.abs(), "{field} is {value}, the page says {said}");
        }
    }
}
