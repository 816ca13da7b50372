//! Worlds with many fires, each in a box of air of its own.

use lucerna::World;
use lucerna::scene::{FireAir, LoadedScene};
use std::path::Path;

/// Candles at these places, in boxes of 10 x 16 x 10 cells.
fn candles(at: &[[f32; 3]]) -> LoadedScene {
    let mut scene = lucerna::scene::open("candle").expect("candle").scene;
    let air = FireAir {
        origin_m: [-0.05, -0.0075, -0.05],
        size_m: [0.1, 0.16, 0.1],
        cells: [10, 16, 10],
        sides: None,
        vorticity_confinement: None,
        cooling_per_s: None,
    };
    (scene.fires[0].at, scene.fires[0].air) = (at.to_vec(), Some(air));
    scene.meshes.clear();
    LoadedScene::from_scene(scene, Path::new("")).expect("a scene")
}

fn burn(scene: LoadedScene, steps: usize) -> World {
    let mut world = World::new(scene).expect("a world");
    for _ in 0..steps {
        world.step(1.0 / 60.0).expect("a step");
    }
    world
}

fn row(count: usize) -> Vec<[f32; 3]> {
    (0..count).map(|i| [0.125 * i as f32, 0.0, 0.25 * (i % 3) as f32]).collect()
}

#[test]
fn a_fire_in_a_box_of_its_own_burns_as_in_a_scene_with_that_air() {
    let own = candles(&[]);
    let mut common = own.clone();
    common.scene.air = common.scene.fires[0].air.take().expect("air").air(&common.scene.air, [0.0; 3]);
    assert_eq!(burn(own, 40).state_hash(), burn(common, 40).state_hash());
}

#[test]
fn many_fires_burn_alike_on_any_number_of_threads() {
    let hash = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| {
            let world = burn(candles(&row(23)), 20);
            assert_eq!((world.airs().len(), world.frame().flame_draws.len()), (23, 23));
            (world.state_hash(), world.frame().flame_vertices.to_vec())
        })
    };
    let one = hash(1);
    assert!([2, 5].map(hash).iter().all(|other| *other == one));
}

#[test]
fn flames_stay_over_their_wicks_wherever_they_stand() {
    let mut scene = candles(&row(9)).scene;
    // The wick leans a little: turned about, it leans the other way.
    scene.fires[0].turns_deg = (0..9).map(|i| 40.0 * i as f32).collect();
    let world = burn(LoadedScene::from_scene(scene, Path::new("")).expect("a scene"), 40);
    let frame = world.frame();
    for (draw, [x, y, z]) in frame.flame_draws.iter().zip(row(9)) {
        let vertices = &frame.flame_vertices[draw.first_vertex as usize..][..draw.vertex_count as usize];
        let top = vertices.iter().map(|v| v.position[1] - y).fold(0.0, f32::max);
        let out = vertices.iter().map(|v| (v.position[0] - x).hypot(v.position[2] - z)).fold(0.0, f32::max);
        assert!((0.02..0.08).contains(&top) && out < 0.01, "at ({x}, {z}): {top} high, {out} out");
    }
}

#[test]
fn fires_too_near_for_boxes_of_their_own_influence_each_other() {
    let alone = burn(candles(&[[0.0; 3]]), 60);
    let pair = burn(candles(&[[0.0; 3], [0.012, 0.0, 0.0]]), 60);
    let far = burn(candles(&[[0.0; 3], [0.5, 0.0, 0.0]]), 60);
    assert_eq!((pair.airs().len(), far.airs().len()), (1, 2));
    let lean = |world: &World| {
        let draw = world.frame().flame_draws[0];
        let vertices = &world.frame().flame_vertices[..draw.vertex_count as usize];
        let tip = vertices.iter().max_by(|a, b| a.position[1].total_cmp(&b.position[1])).expect("vertices");
        tip.position[0]
    };
    println!(
        "tips at {} m alone, {} m with a candle 12 mm away, {} m half a metre away",
        lean(&alone),
        lean(&pair),
        lean(&far)
    );
    assert!((lean(&far) - lean(&alone)).abs() < 1e-5);
    assert!(lean(&pair) - lean(&alone) > 3e-4, "the flames lean towards each other");
}
