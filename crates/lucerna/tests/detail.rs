//! Level of detail: what it saves, that nothing jumps, and that it is the same whenever it is repeated.

use lucerna::World;
use lucerna::frame::Camera;
use lucerna::scene::{Budget, FireAir, LoadedScene};
use std::path::Path;

const COPIES: usize = 24;
const CELLS: u64 = 10 * 16 * 10;
const BUDGET: Budget = Budget { cell_steps: 6 * CELLS, vertices: 4000 };

/// A row of candles, 0.2 m apart, seen from one end.
fn candles() -> World {
    let mut scene = lucerna::scene::open("candle").expect("candle").scene;
    let fire = &mut scene.fires[0];
    fire.at = (0..COPIES).map(|i| [0.2 * i as f32, 0.0, 0.0]).collect();
    let (sides, vorticity_confinement, cooling_per_s) = (None, None, None);
    let (origin_m, size_m, cells) = ([-0.05, -0.0075, -0.05], [0.1, 0.16, 0.1], [10, 16, 10]);
    fire.air = Some(FireAir { origin_m, size_m, cells, sides, vorticity_confinement, cooling_per_s });
    scene.meshes.clear();
    World::new(LoadedScene::from_scene(scene, Path::new("")).expect("a scene")).expect("a world")
}

fn looking_from(x: f32) -> Camera {
    Camera { eye: [x, 0.05, 0.4], target: [x + 1.0, 0.03, 0.0], ..Camera::default() }
}

fn step(world: &mut World, steps: usize) {
    (0..steps).for_each(|_| assert!(world.step(1.0 / 60.0).is_ok()));
}

fn asleep(world: &World) -> Vec<usize> {
    (0..COPIES).filter(|&flame| world.flames().is_asleep(flame)).collect()
}

/// All control points of the attached flames.
fn points(world: &World) -> Vec<[f32; 3]> {
    world.flames().control_nets().flat_map(|net| net.points.iter().copied()).collect()
}

/// The farthest that a control point moves in a step, over a run in which the camera flies along the row and back, m.
fn fastest(world: &mut World) -> f32 {
    let mut most = 0.0_f32;
    for frame in 0..480 {
        let x = 4.0 * (frame as f32 / 240.0 * std::f32::consts::PI).sin().abs();
        world.set_view(&looking_from(x)).expect("a view");
        let before = points(world);
        step(world, 1);
        for (a, b) in before.iter().zip(points(world)) {
            most = most.max((0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f32>().sqrt());
        }
    }
    most
}

#[test]
fn a_budget_lets_far_fires_follow_and_nothing_jumps() {
    let (mut full, mut less) = (candles(), candles());
    less.set_budget(Some(BUDGET)).expect("a budget");
    step(&mut full, 150);
    step(&mut less, 150);
    let (without, with) = (fastest(&mut full), fastest(&mut less));
    println!(
        "the fastest control point moves {:.2} mm a step without level of detail, {:.2} mm with",
        1e3 * without,
        1e3 * with
    );
    assert!(with <= 1.25 * without, "{with} m against {without} m");
    // Long after: seen from the near end, the near ones burn for themselves.
    less.set_view(&looking_from(0.0)).expect("a view");
    step(&mut less, 90);
    let asleep = asleep(&less);
    println!("asleep: {asleep:?}");
    assert_eq!(asleep, (6..COPIES).collect::<Vec<_>>());
    let vertices = |world: &World| world.frame().flame_draws.iter().map(|draw| draw.vertex_count).sum::<u32>();
    println!("{} vertices instead of {}", vertices(&less), vertices(&full));
    assert!(u64::from(vertices(&less)) <= BUDGET.vertices.max(COPIES as u64 * 300));
    assert!(vertices(&less) < vertices(&full) / 2);
    // What follows burns, too: all flames are as high as before.
    for world in [&full, &less] {
        for net in world.flames().control_nets() {
            let top = net.points.iter().map(|p| p[1]).fold(0.0, f32::max);
            assert!((0.02..0.08).contains(&top), "{top}");
        }
    }
}

#[test]
fn without_a_budget_again_all_burn_for_themselves() {
    let mut world = candles();
    world.set_budget(Some(BUDGET)).expect("a budget");
    step(&mut world, 240);
    assert!(!asleep(&world).is_empty());
    world.set_budget(None).expect("no budget");
    step(&mut world, 90);
    assert!(asleep(&world).is_empty());
}

#[test]
fn the_level_of_detail_repeats_and_can_be_saved_at_any_time() {
    let run = |threads: usize, saves_at: &[usize]| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| {
            let mut world = candles();
            world.set_budget(Some(BUDGET)).expect("a budget");
            for frame in 0..260 {
                world.set_view(&looking_from(0.02 * frame as f32)).expect("a view");
                if saves_at.contains(&frame) {
                    let mut next = candles();
                    next.restore(&world.save()).expect("restored");
                    assert!(next.frame().flame_vertices == world.frame().flame_vertices, "frame {frame}");
                    world = next;
                }
                step(&mut world, 1);
            }
            (world.state_hash(), world.frame().flame_vertices.to_vec())
        })
    };
    let once = run(1, &[]);
    assert!(run(2, &[60, 140, 175, 230]) == once);
}

#[test]
fn a_fire_that_is_put_out_goes_out_though_it_followed() {
    let mut world = candles();
    world.set_budget(Some(BUDGET)).expect("a budget");
    step(&mut world, 240);
    let flame = *asleep(&world).last().expect("one that follows");
    world.extinguish(flame).expect("a flame");
    step(&mut world, 90);
    assert!(!world.flames().is_lit(flame) && !world.flames().is_asleep(flame));
    assert_eq!(world.frame().flame_draws.len(), COPIES - 1);
}
