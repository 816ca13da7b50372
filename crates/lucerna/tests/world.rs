//! Worlds made from the built-in scenes.

use lucerna::scene::{AirSides, LoadedScene, Pressure};
use lucerna::{DebugLines, MAX_STEPS, World, WorldError};

fn scene(name: &str) -> LoadedScene {
    lucerna::scene::open(name).expect("a built-in scene")
}

/// The scene on a small grid: the tests are of the world, not of the air.
fn small(name: &str) -> LoadedScene {
    let mut loaded = scene(name);
    loaded.scene.air.cells = [12, 16, 12];
    loaded
}

#[test]
fn every_built_in_scene_burns() {
    for name in lucerna::scene::builtin_names() {
        let mut world = World::new(scene(name)).expect(name);
        let summary = world.step(0.25).expect(name);
        assert!(summary.steps > 0 && summary.divergence < 1e-2, "{name}: {summary:?}");
        let frame = world.frame();
        assert!(!frame.flame_draws.is_empty() && !frame.lights.is_empty(), "{name}");
        assert_eq!(frame.flame_draws.len(), frame.flame_shades.len());
        assert!(frame.flame_vertices.iter().all(|v| v.position.iter().all(|x| x.is_finite())));
        for draw in frame.flame_draws {
            let indices = &frame.flame_indices[draw.first_index as usize..][..draw.index_count as usize];
            assert!(indices.iter().all(|&i| i < draw.vertex_count), "{name}");
        }
    }
}

#[test]
fn presets_burn_too() {
    for preset in lucerna::scene::presets() {
        let mut loaded = scene("torch");
        lucerna::scene::apply_preset(&mut loaded.scene, preset).expect(preset);
        loaded.scene.air.cells = loaded.scene.air.cells.map(|n| n.min(16));
        let mut world = World::new(loaded).expect(preset);
        for _ in 0..60 {
            world.step(1.0 / 60.0).expect(preset);
        }
        let top = world.frame().flame_vertices.iter().map(|v| v.position[1]).fold(f32::MIN, f32::max);
        assert!(top > 0.12, "{preset}: {top}");
    }
}

#[test]
fn time_is_stepped_evenly_and_what_is_too_much_is_dropped() {
    let mut loaded = small("candle");
    loaded.scene.air.time_step_s = 0.01;
    let mut world = World::new(loaded).expect("candle");
    let mut steps = |dt: f32| world.step(dt).map(|s| (s.steps, s.dropped)).expect("step");
    assert_eq!(steps(0.004), (0, 0));
    assert_eq!(steps(0.004), (0, 0));
    assert_eq!(steps(0.004), (1, 0));
    assert_eq!(steps(0.028), (3, 0), "the rest of 2 ms is kept");
    assert_eq!(steps(1.0), (MAX_STEPS, 92));
    assert_eq!(steps(0.0), (0, 0));
    assert!((world.time_s() - 0.12).abs() < 1e-6);
    for bad in [-0.1, f32::NAN, f32::INFINITY] {
        assert!(matches!(world.step(bad), Err(WorldError::Time { field: "dt_s", .. })));
    }
}

#[test]
fn no_time_step_makes_nonsense() {
    for step_s in [1e-4, 0.1, 10.0] {
        for pressure in [Pressure::Direct, Pressure::GaussSeidel(10)] {
            let mut loaded = small("torch");
            loaded.scene.air.time_step_s = step_s;
            loaded.scene.air.pressure = pressure;
            loaded.scene.air.sides = AirSides::Closed;
            loaded.scene.air.row_buoyancy_m_s2 = 0.5;
            let mut world = World::new(loaded).expect("torch");
            for _ in 0..30 {
                world.step(step_s).expect("step");
                let frame = world.frame();
                assert!(frame.flame_vertices.iter().all(|v| v.position.iter().all(|x| x.is_finite())));
            }
        }
    }
}

#[test]
fn the_strongest_scenes_move_the_air() {
    let mut loaded = small("torch");
    let (air, fire) = (&mut loaded.scene.air, &mut loaded.scene.fires[0]);
    air.cells = [4, 128, 4];
    air.row_buoyancy_m_s2 = 10_000.0;
    air.wind_m_s = [100.0, -100.0, 100.0];
    fire.fuel.heat_k_s = 1e6;
    fire.fuel.strength_m_s2 = 1e5;
    fire.fuel.distribution = lucerna::flame::FuelDistribution::Table(vec![1000.0; 2]);
    fire.fuel.swing = lucerna::flame::Swing::Random { amplitude: 100.0 };
    lucerna::scene::validate(&loaded.scene).expect("allowed");
    let mut world = World::new(loaded).expect("torch");
    for _ in 0..4 {
        world.step(1.0 / 60.0).expect("step");
    }
}

#[test]
fn runs_repeat_bit_for_bit() {
    let run = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
        pool.install(|| {
            let mut loaded = small("torch");
            loaded.scene.seed = seed;
            let mut world = World::new(loaded).expect("torch");
            for _ in 0..40 {
                world.step(1.0 / 60.0).expect("step");
            }
            world.state_hash()
        })
    };
    let one = run(1, 5);
    assert_eq!(one, run(2, 5));
    assert_eq!(one, run(7, 5));
    assert_ne!(one, run(1, 6));

    let mut world = World::new(small("torch")).expect("torch");
    let start = world.state_hash();
    let after = |world: &mut World| {
        world.step(0.1).expect("step");
        world.state_hash()
    };
    let first = after(&mut world);
    world.reset();
    assert_eq!((world.time_s().to_bits(), world.state_hash()), (0, start));
    assert_eq!(first, after(&mut world));
}

#[test]
fn a_changed_scene_goes_on_burning() {
    let mut world = World::new(small("torch")).expect("torch");
    for _ in 0..60 {
        world.step(1.0 / 60.0).expect("step");
    }
    let top = |world: &World| world.frame().flame_vertices.iter().map(|v| v.position[1]).fold(f32::MIN, f32::max);
    let (before, revision) = (top(&world), world.frame().mesh_revision);
    let mut changed = world.scene().clone();
    changed.scene.fires[0].fuel.strength_m_s2 *= 1.5;
    changed.scene.air.wind_m_s = [0.2, 0.0, 0.0];
    world.set_scene(changed.clone()).expect("set");
    assert!(top(&world) > 0.7 * before && world.time_s() > 0.9, "{before} {}", top(&world));
    assert_eq!(world.frame().mesh_revision, revision);

    let hash = world.state_hash();
    let mut bad = changed.clone();
    bad.scene.fires[0].skeletons.width_m = -1.0;
    assert!(world.set_scene(bad).is_err());
    assert_eq!(world.state_hash(), hash, "a refused scene changes nothing");
    let mut bad = changed.clone();
    (bad.scene.fires[0].fuel.strength_m_s2, bad.scene.air.wind_m_s[0]) = (1.0, 1e3);
    assert!(matches!(world.set_scene(bad), Err(WorldError::Air(_))));
    assert_eq!(world.state_hash(), hash, "refused air changes nothing");

    changed.meshes.pop();
    changed.scene.air.cells = [10; 3];
    world.set_scene(changed).expect("set");
    assert!(world.time_s() < 1e-9, "another grid starts anew");
    assert_ne!(world.frame().mesh_revision, revision);
}

#[test]
fn debug_lines_come_in_pairs() {
    let mut world = World::new(small("candle")).expect("candle");
    assert!(world.frame().lines.is_empty());
    let none = DebugLines::default();
    for lines in [
        DebugLines { skeletons: true, ..none },
        DebugLines { control_nets: true, ..none },
        DebugLines { wireframe: true, ..none },
        DebugLines { air_box: true, ..none },
    ] {
        world.set_debug_lines(lines);
        let count = world.frame().lines.len();
        assert!(count > 0 && count.is_multiple_of(2), "{lines:?}");
        if lines.air_box {
            assert_eq!(count, 24);
        }
    }
}

#[test]
fn scenes_that_do_not_fit_together_are_refused() {
    let mut loaded = small("torch");
    loaded.wicks[0].pop();
    assert!(matches!(World::new(loaded), Err(WorldError::Wicks { wicks: 5, shapes: 4, .. })));
    let mut loaded = small("torch");
    loaded.scene.air.time_step_s = 0.0;
    assert!(matches!(World::new(loaded), Err(WorldError::Time { field: "air.time_step_s", .. })));
    let mut loaded = small("torch");
    loaded.scene.air.cells = [1, 1, 1];
    assert!(matches!(World::new(loaded), Err(WorldError::Air(_))));
}
