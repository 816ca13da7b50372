//! Whole scenes as they burn: the air keeps its volume, every frame can be drawn whatever the time step, the same seed
//! is the same fire on any number of threads, and a world that is changed or reset is the world that was asked for.

use lucerna::flame::Drive;
use lucerna::frame::Frame;
use lucerna::scene::{LoadedScene, apply_preset, builtin};
use lucerna::{DebugLines, World};
use lucerna_tests::{burning, step_once};

const LINES: DebugLines = DebugLines { skeletons: true, control_nets: true, wireframe: true, air_box: true };

/// Fires whose gas burns in the air have nothing random, and lose their tips to the air alone.
fn burns_fuel(world: &World) -> bool {
    world.scene().scene.fires.iter().any(|fire| fire.drive != Drive::RootForces)
}

fn world(name: &str) -> World {
    World::new(builtin(name).expect(name)).expect(name)
}

#[test]
fn the_air_keeps_its_volume_at_every_step() {
    for name in lucerna_tests::small_scenes() {
        let mut world = world(name);
        while world.time_s() < 2.5 {
            let summary = step_once(&mut world);
            assert!(summary.divergence < 1e-3, "{name} at {} s: {}", world.time_s(), summary.divergence);
        }
    }
}

#[test]
fn every_frame_can_be_drawn_whatever_the_time_step() {
    for name in lucerna_tests::small_scenes() {
        for time_step_s in [1e-4, 1e-3, 1.0 / 60.0, 0.1, 1.0, 10.0] {
            let mut loaded = builtin(name).expect(name);
            loaded.scene.air.time_step_s = time_step_s;
            let mut world = World::new(loaded).expect(name);
            world.set_debug_lines(LINES);
            // Gas that burns in the air leaves it in so long a step, and the fire goes out.
            let may_go_out = burns_fuel(&world) && time_step_s >= 1.0;
            check_drawable(&world.frame(), &format!("{name} before its first step"));
            for step in 0..30 {
                step_once(&mut world);
                if may_go_out && world.frame().flame_draws.is_empty() {
                    continue;
                }
                check_drawable(&world.frame(), &format!("{name}, step {step} of {time_step_s} s"));
            }
        }
    }
}

/// Everything that the renderer reads is a number, of the size that it says, and refers to what is there.
#[track_caller]
fn check_drawable(frame: &Frame<'_>, when: &str) {
    assert!(!frame.flame_draws.is_empty() && !frame.flame_vertices.is_empty(), "{when}: no flame");
    for vertex in frame.flame_vertices {
        let numbers = [vertex.height, vertex.radius_m, vertex.uv[0], vertex.uv[1]];
        let finite = vertex.position.iter().chain(&vertex.normal).chain(&numbers).all(|x| x.is_finite());
        assert!(finite, "{when}: {vertex:?}");
        let length = vertex.normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        assert!((length - 1.0).abs() < 1e-3, "{when}: a normal of length {length}");
        assert!((0.0..=1.0).contains(&vertex.height) && vertex.radius_m > 0.0, "{when}: {vertex:?}");
        assert!((vertex.flame as usize) < frame.flame_shades.len(), "{when}: {vertex:?}");
    }
    assert_eq!(frame.flame_draws.len(), frame.flame_shades.len(), "{when}");
    for draw in frame.flame_draws {
        let indices = &frame.flame_indices[draw.first_index as usize..][..draw.index_count as usize];
        assert!(indices.iter().all(|&i| i < draw.vertex_count), "{when}: an index beyond {draw:?}");
        assert!((draw.first_vertex + draw.vertex_count) as usize <= frame.flame_vertices.len(), "{when}: {draw:?}");
    }
    assert!(frame.flame_shades.iter().all(|shade| (0.0..=1.0).contains(&shade.strength)), "{when}");
    for light in frame.lights {
        assert!(light.position.iter().all(|x| x.is_finite()), "{when}: {light:?}");
        // A black body is redder than any display: blue may be below zero, the luminance not.
        let [r, g, b] = light.intensity;
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        assert!(luminance.is_finite() && luminance >= 0.0, "{when}: {light:?}");
        assert!(light.radius_m.is_finite() && light.radius_m > 0.0, "{when}: {light:?}");
    }
    assert!(frame.lines.iter().flat_map(|end| end.position).all(f32::is_finite), "{when}: a debug line");
}

#[test]
fn the_same_seed_is_the_same_fire_on_any_number_of_threads() {
    for name in lucerna_tests::small_scenes() {
        let burn = |threads: usize, seed: u64| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
            pool.install(|| {
                let mut loaded = builtin(name).expect(name);
                loaded.scene.seed = seed;
                let mut world = World::new(loaded).expect(name);
                for _ in 0..45 {
                    step_once(&mut world);
                }
                (world.state_hash(), world.frame().flame_vertices.to_vec(), world.frame().lights.to_vec())
            })
        };
        let one = burn(1, 5);
        for threads in [2, 7] {
            assert!(burn(threads, 5) == one, "{name}: {threads} threads are not one");
        }
        let other = burn(2, 6);
        assert_ne!(other.0, one.0, "{name}");
        // Little about a still candle is random.
        let is_random = *name != "candle" && !burns_fuel(&world(name));
        assert!(other.1 != one.1 || !is_random, "{name}: another seed is the same fire");
    }
}

#[test]
fn a_world_that_is_reset_burns_as_a_new_one() {
    for name in lucerna_tests::small_scenes() {
        // Changed while it burned, in everything that keeps it burning.
        let mut world = burning(name, 0.5);
        let mut changed = world.scene().clone();
        changed.scene.air.wind_m_s = [0.1, 0.0, -0.05];
        changed.scene.air.cooling_per_s *= 2.0;
        changed.scene.fires[0].fuel.strength_m_s2 *= 0.8;
        changed.scene.fires[0].skeletons.lead_life_s *= 1.2;
        world.set_scene(changed.clone()).expect(name);
        assert!(world.time_s() > 0.4, "{name} went out");
        step_once(&mut world);
        world.reset();
        let mut new = World::new(changed).expect(name);
        for step in 0..10 {
            assert_eq!(world.time_s().to_bits(), new.time_s().to_bits(), "{name}");
            assert_eq!(world.state_hash(), new.state_hash(), "{name} after {step} steps");
            assert!(world.frame().flame_vertices == new.frame().flame_vertices, "{name} after {step} steps");
            step_once(&mut world);
            step_once(&mut new);
        }
    }
}

#[test]
fn another_scene_takes_the_place_of_the_first() {
    let mut world = burning("candle", 0.3);
    let mut revision = world.frame().mesh_revision;
    for name in ["campfire", "torch", "candle"] {
        let loaded = builtin(name).expect(name);
        world.set_scene(loaded.clone()).expect(name);
        let new = World::new(loaded).expect(name);
        assert_eq!(world.state_hash(), new.state_hash(), "{name}");
        assert_eq!(world.frame().flame_draws, new.frame().flame_draws, "{name}");
        assert_eq!(world.frame().meshes, new.frame().meshes, "{name}");
        assert_ne!(world.frame().mesh_revision, revision, "the meshes of {name} would not be uploaded");
        revision = world.frame().mesh_revision;
        step_once(&mut world);
    }
}

#[test]
fn how_a_fire_is_looked_at_does_not_change_it() {
    for name in lucerna_tests::small_scenes() {
        let mut loaded = builtin(name).expect(name);
        loaded.scene.fires[0].skeletons.shed_per_s = 20.0;
        let mut world = World::new(loaded).expect(name);
        // Until a tip that broke away burns by itself.
        let sheds = |world: &World| world.frame().flame_draws.len() != world.scene().scene.fires[0].wicks.len();
        while !sheds(&world) {
            if burns_fuel(&world) && world.time_s() > 1.0 {
                break;
            }
            step_once(&mut world);
            assert!(world.time_s() < 10.0, "{name}: no tip broke away");
        }
        let (hash, revision) = (world.state_hash(), world.frame().mesh_revision);
        let draws = world.frame().flame_draws.to_vec();
        let mut looked_at: LoadedScene = world.scene().clone();
        looked_at.scene.look.exposure_stops += 1.0;
        looked_at.scene.camera.fov_y_deg *= 0.5;
        world.set_scene(looked_at).expect(name);
        world.set_debug_lines(LINES);
        assert_eq!(world.state_hash(), hash, "{name}");
        assert_eq!(world.frame().flame_draws, draws, "{name}");
        assert_eq!(world.frame().mesh_revision, revision, "{name}");
    }
}

/// Paper 003: "14 skeletons, each with fewer than 9 particles, in a 15 x 15 x 15 grid", textured shells, four layers.
#[test]
fn the_paper_preset_has_the_published_numbers() {
    for (name, leads, peripherals, layers) in [("candle", 1, 4, 2), ("torch", 4, 10, 4), ("campfire", 4, 10, 4)] {
        let mut loaded = builtin(name).expect(name);
        apply_preset(&mut loaded.scene, "paper").expect("the preset");
        let (air, look, fire) = (&loaded.scene.air, &loaded.scene.look, &loaded.scene.fires[0]);
        assert_eq!((air.cells, look.layers), ([15; 3], layers), "{name}");
        assert_eq!(look.shading, lucerna::frame::Shading::Shell, "{name}");
        assert!(fire.skeletons.slices == 2 && fire.skeletons.particles < 9, "{name}: {:?}", fire.skeletons);
        let (wicks, particles) = (fire.wicks.len(), fire.skeletons.particles as usize);

        let mut world = World::new(loaded).expect(name);
        assert_eq!(world.fluid().cells(), [15; 3], "{name}");
        let none = DebugLines::default();
        world.set_debug_lines(DebugLines { skeletons: true, ..none });
        // Lead skeletons are drawn red, peripheral ones blue; each is one unbroken line.
        let skeletons = |red: bool| {
            let lines = world.frame().lines.chunks_exact(2).filter(|line| (line[0].color[0] > 0.5) == red);
            let mut ends = None;
            lines.filter(|line| ends.replace(line[1].position) != Some(line[0].position)).count()
        };
        assert_eq!((skeletons(true), skeletons(false)), (leads * wicks, peripherals * wicks), "{name}");
        // One row of the net for each peripheral skeleton: its particles, its root, and both ends of its lead.
        world.set_debug_lines(DebugLines { control_nets: true, ..none });
        let columns = particles + 3;
        let edges = wicks * peripherals * (2 * columns - 1);
        assert_eq!(world.frame().lines.len(), 2 * edges, "{name}");
    }
}
