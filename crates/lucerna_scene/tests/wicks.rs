//! Wicks of all sources: how many flames they are for, where they run, and what is refused.

mod common;

use common::{folder, message, smallest, with_wick};
use glam::Vec3;
use lucerna_flame::{Centreline, WickShape};
use lucerna_scene::{LoadedScene, Scene, SceneError, WickSource};
use std::fmt::Write;
use std::path::Path;

fn with_source(text: &str) -> Result<LoadedScene, SceneError> {
    let scene = format!(
        "(name: \"one\", air: (origin_m: (-1.0, -1.0, -1.0), size_m: (2.0, 2.0, 2.0), cells: (8, 8, 8)), \
         fires: [(wicks: [{text}])])"
    );
    let scene: Scene = lucerna_scene::parse(&scene, Path::new("one.ron"))?;
    let again = lucerna_scene::parse(&scene.to_ron()?, Path::new("again.ron"))?;
    assert_eq!(scene, again, "written and read");
    LoadedScene::from_scene(scene, Path::new(""))
}

fn lines(loaded: &LoadedScene) -> Vec<Vec<Vec3>> {
    let line = |shape: &WickShape| match shape.centreline().expect("a centreline") {
        Centreline::Line(line) => line,
        Centreline::Point(point) => vec![point],
    };
    loaded.wicks[0].iter().map(line).collect()
}

fn length(line: &[Vec3]) -> f32 {
    line.windows(2).map(|w| w[0].distance(w[1])).sum()
}

/// Faces of a tube around a ring in the plane y = 0, about a middle.
fn ring_obj(middle: [f32; 3], ring_m: f32, first: usize) -> String {
    let (around, across) = (48, 6);
    let mut text = String::new();
    for i in 0..around {
        let (sin, cos) = (std::f32::consts::TAU * i as f32 / around as f32).sin_cos();
        for j in 0..across {
            let (up, out) = (std::f32::consts::TAU * j as f32 / across as f32).sin_cos();
            let r = ring_m + 0.01 * out;
            writeln!(text, "v {} {} {}", middle[0] + r * cos, middle[1] + 0.01 * up, middle[2] + r * sin).unwrap();
        }
    }
    for i in 0..around {
        for j in 0..across {
            let at = |i: usize, j: usize| first + i % around * across + j % across + 1;
            writeln!(text, "f {} {} {} {}", at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)).unwrap();
        }
    }
    text
}

#[test]
fn a_ring_is_three_arcs_in_any_plane() {
    for normal in ["(0.0, 1.0, 0.0)", "(1.0, 1.0, 0.0)", "(0.0, 0.0, 5.0)"] {
        let text = format!("ring(center_m: (0.1, 0.0, 0.0), ring_m: 0.3, normal: {normal}, radius_m: 0.005)");
        let loaded = with_source(&text).unwrap();
        // A steep arc carries its flame as a candle's wick does, so its points are looked at, not its centreline.
        let points = |shape: &WickShape| match shape {
            WickShape::Polyline { points, .. } => points.iter().copied().map(Vec3::from).collect(),
            WickShape::Vertices(_) => Vec::<Vec3>::new(),
        };
        let arcs: Vec<Vec<Vec3>> = loaded.wicks[0].iter().map(points).collect();
        assert_eq!(arcs.len(), 3);
        for (i, arc) in arcs.iter().enumerate() {
            assert!((length(arc) / (0.2 * std::f32::consts::PI) - 1.0).abs() < 0.01, "{}", length(arc));
            assert!(arc[arc.len() - 1].distance(arcs[(i + 1) % 3][0]) < 1e-4);
            assert!(arc.iter().all(|p| (p.distance(Vec3::new(0.1, 0.0, 0.0)) - 0.3).abs() < 0.002));
        }
    }
}

#[test]
fn a_curve_runs_smoothly_through_its_points() {
    let points = "[(-0.4, 0.0, 0.0), (-0.1, 0.0, 0.2), (0.1, 0.0, -0.2), (0.4, 0.1, 0.0)]";
    let loaded = with_source(&format!("curve(points: {points}, radius_m: 0.005)")).unwrap();
    let [line] = &lines(&loaded)[..] else { panic!("one wick") };
    for point in loaded.scene.fires[0].wicks[0].points() {
        assert!(line.iter().any(|p| p.distance(Vec3::from(*point)) < 1e-5), "{point:?}");
    }
    let sharpest = line.windows(3).map(|w| (w[1] - w[0]).angle_between(w[2] - w[1])).fold(0.0, f32::max);
    println!("sharpest bend of a curve: {:.1} degrees", sharpest.to_degrees());
    assert!(sharpest.to_degrees() < 30.0);
    let closed = "[(0.3, 0.0, 0.0), (0.0, 0.0, 0.3), (-0.3, 0.0, 0.0), (0.0, 0.0, -0.3)]";
    let loaded = with_source(&format!("curve(points: {closed}, radius_m: 0.005, closed: true)")).unwrap();
    let arcs = lines(&loaded);
    assert_eq!(arcs.len(), 3);
    let off = arcs.iter().flatten().map(|p| (p.length() - 0.3).abs()).fold(0.0, f32::max);
    println!("a curve through four points of a circle: {off:.4} m off at most");
    assert!(off < 0.015);
    assert!(with_source("curve(points: [(0.1, 0.0, 0.0), (0.1, 0.0, 0.0)], radius_m: 0.01)").is_err());
}

#[test]
fn each_of_several_points_is_a_wick() {
    let loaded = with_source("points(points: [(0.1, 0.0, 0.0), (0.2, 0.0, 0.0), (0.3, 0.1, 0.0)], radius_m: 0.001)");
    assert_eq!(lines(&loaded.unwrap()).iter().map(Vec::len).collect::<Vec<_>>(), [1, 1, 1]);
}

#[test]
fn each_part_of_a_mesh_is_a_wick_and_each_ring_three() {
    let folder = folder("each_part_of_a_mesh_is_a_wick_and_each_ring_three");
    let mut obj = ring_obj([0.0; 3], 0.2, 0);
    obj += &ring_obj([0.0, 0.1, 0.0], 0.35, 288);
    // A bar with corners at its ends only, and a vertex that no face uses.
    obj += "v -0.4 0.5 0.01\nv -0.4 0.5 -0.01\nv 0.4 0.5 0.01\nv 0.4 0.5 -0.01\nf -4 -3 -1 -2\nv 0.9 0.9 0.9\n";
    let loaded = with_wick(&folder, "three.obj", obj.as_bytes()).unwrap();
    let found = lines(&loaded);
    assert_eq!(found.len(), 7);
    assert!((length(&found[6]) - 0.8).abs() < 0.03, "{}", length(&found[6]));
    // Parts that are near one another, taken together by hand.
    let mut scene = loaded.scene;
    scene.fires[0].wicks = vec![WickSource::Mesh {
        file: "three.obj".into(),
        group: None,
        position_m: [0.0; 3],
        rotation_deg: [0.0; 3],
        scale: 1.0,
        gap_m: Some(0.4),
    }];
    assert!(LoadedScene::from_scene(scene, &folder).unwrap().wicks[0].len() < 7);
}

#[test]
fn parts_of_a_glb_are_wicks_too() {
    let folder = folder("parts_of_a_glb_are_wicks_too");
    let loaded = with_wick(&folder, "triangle.glb", &common::triangle_glb());
    assert_eq!(loaded.unwrap().wicks[0].len(), 1);
}

#[test]
fn meshes_are_turned_about_x_then_y_then_z() {
    let folder = folder("meshes_are_turned_about_x_then_y_then_z");
    let obj = b"v 0 0 0\nv 0.1 0 0\nv 0 0.2 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
    let mut scene = common::with_mesh(&folder, "a.obj", obj).unwrap().scene;
    scene.meshes[0].rotation_deg = [90.0, 0.0, 90.0];
    scene.meshes[0].position_m = [0.5, 0.0, 0.0];
    let WickSource::Mesh { file, group, scale, gap_m, .. } = WickSource::mesh("a.obj") else { panic!("a mesh") };
    let [position_m, rotation_deg] = [scene.meshes[0].position_m, scene.meshes[0].rotation_deg];
    scene.fires[0].wicks = vec![WickSource::Mesh { file, group, position_m, rotation_deg, scale, gap_m }];
    let loaded = LoadedScene::from_scene(scene, &folder).unwrap();
    let WickShape::Vertices(wick) = &loaded.wicks[0][0] else { panic!("vertices") };
    // About x: (0.1, 0, 0), (0, 0, 0.2); about z: (0, 0.1, 0), (0, 0, 0.2); the normal goes to -y, then to x.
    let expected = [[0.5, 0.0, 0.0], [0.5, 0.1, 0.0], [0.5, 0.0, 0.2]];
    for (vertex, (point, want)) in loaded.meshes[0].vertices.iter().zip(wick.iter().zip(expected)) {
        assert!(Vec3::from(vertex.position).distance(want.into()) < 1e-6, "{vertex:?}");
        assert!(Vec3::from(*point).distance(want.into()) < 1e-6, "{point:?}");
        assert!(Vec3::from(vertex.normal).distance(Vec3::X) < 1e-6, "{vertex:?}");
    }
}

#[test]
fn impossible_wicks_are_refused_by_field() {
    for (text, field) in [
        ("ring(center_m: (9.0, 0.0, 0.0), ring_m: 0.3, radius_m: 0.005)", "fires[0].wicks[0].center_m"),
        ("ring(center_m: (0.9, 0.0, 0.0), ring_m: 0.3, radius_m: 0.005)", "fires[0].wicks[0]"),
        ("ring(center_m: (0.0, 0.0, 0.0), ring_m: 0.0, radius_m: 0.005)", "fires[0].wicks[0].ring_m"),
        (
            "ring(center_m: (0.0, 0.0, 0.0), ring_m: 0.1, normal: (0.0, 0.0, 0.0), radius_m: 0.005)",
            "fires[0].wicks[0].normal",
        ),
        ("points(points: [], radius_m: 0.01)", "the number of fires[0].wicks[0].points"),
        ("curve(points: [(0.0, 0.0, 0.0)], radius_m: 0.0)", "fires[0].wicks[0].radius_m"),
        ("mesh(file: \"a.obj\", gap_m: 0.0)", "fires[0].wicks[0].gap_m"),
        ("mesh(file: \"a.obj\", rotation_deg: (0.0, 1000.0, 0.0))", "fires[0].wicks[0].rotation_deg[1]"),
    ] {
        match with_source(text) {
            Err(SceneError::Value { field: found, .. }) => assert_eq!(found, field, "{text}"),
            other => panic!("{text}: {other:?}"),
        }
    }
    let folder = folder("impossible_wicks_are_refused_by_field");
    let triangle = |i: usize| format!("v 0 0 0.{i:04}\nv 0.1 0 0.{i:04}\nv 0 0.001 0.{i:04}\nf -3 -2 -1\n");
    let many: String = (0..2600).map(triangle).collect();
    let error = message(&folder, with_wick(&folder, "many.obj", many.as_bytes()));
    println!("{error}");
    assert!(error.contains("2520") && error.contains("fires[0].wicks[0]"), "{error}");
    assert_eq!(smallest().fires.len(), 1);
}

#[test]
fn impossible_motions_are_refused_by_field() {
    let with = |motion: &str, path: &str| {
        let mut scene = smallest();
        let text = format!("(name: \"a\", path: {path})");
        scene.motions.push(ron(&text));
        scene.fires[0].motion = Some(motion.into());
        LoadedScene::from_scene(scene, Path::new("")).expect_err(path).to_string()
    };
    let swing = "swing(pivot_m: (0.0, 0.0, 0.0), axis: (0.0, 0.0, 1.0), angle_deg: 30.0, period_s: 1.0)";
    for (motion, path, expected) in [
        ("b", "still", "fires[0].motion is `b`: must be a"),
        (
            "a",
            &swing.replace("period_s: 1.0", "period_s: 0.0"),
            "motions[0].path.period_s is 0: must be 0.01 to 1000000",
        ),
        (
            "a",
            &swing.replace("1.0), angle", "0.0), angle"),
            "motions[0].path.axis is of no length: must be a direction",
        ),
        ("a", "keys(keys: [])", "the number of motions[0].path.keys is 0: must be 1 to 4096"),
        (
            "a",
            "keys(keys: [(time_s: 1.0), (time_s: 1.0)])",
            "motions[0].path.keys[1].time_s is 1: must be after that of the key before, 1",
        ),
        (
            "a",
            "keys(keys: [(time_s: 0.0), (time_s: 1.0, position_m: (0.0, 2.0, 0.0))])",
            "fires[0].wicks[0] at 0.52 s of its motion is at (0, 1.0",
        ),
    ] {
        let error = with(motion, path);
        assert!(error.starts_with(expected), "{error}");
    }
}

fn ron(text: &str) -> lucerna_scene::Motion {
    let whole = format!(
        "(name: \"m\", air: (origin_m: (0.0, 0.0, 0.0), size_m: (1.0, 1.0, 1.0), cells: (2, 2, 2)), fires: [], motions: [{text}])"
    );
    lucerna_scene::parse(&whole, Path::new("m.ron")).expect(text).motions.remove(0)
}
