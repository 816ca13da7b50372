//! A world whose fires burn evenly allocates nothing: all that a frame does on the processor.

use allocation_counter::measure;
use lucerna::World;
use lucerna::flame::Surfaces;
use lucerna::scene::LoadedScene;

const STEP_S: f32 = 1.0 / 60.0;

/// A built-in scene in so coarse an air that it costs next to nothing.
fn coarse(name: &str) -> LoadedScene {
    let mut loaded = lucerna::scene::open(name).expect(name);
    loaded.scene.air.cells = loaded.scene.air.cells.map(|n| n.min(12));
    loaded
}

fn burning() -> LoadedScene {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/scenes/burning_candle.ron");
    lucerna::scene::load(path.as_ref()).expect("a scene of the examples")
}

#[test]
fn a_frame_of_a_fire_that_burns_evenly_allocates_nothing() {
    let scenes = [coarse("candle"), coarse("torch"), coarse("campfire"), burning()];
    // What other threads allocate is not counted.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    pool.install(|| {
        for scene in scenes {
            let mut world = World::new(scene).expect("a world");
            for surfaces in [Surfaces::Vertices, Surfaces::Nets] {
                world.set_surfaces(surfaces);
                let mut steps = |count| (0..count).for_each(|_| assert!(world.step(STEP_S).expect("a step").steps > 0));
                steps(60);
                let allocated = measure(|| steps(30)).count_total;
                println!("{}, {surfaces:?}: {allocated} allocations in 30 frames", world.scene().scene.name);
                assert_eq!(allocated, 0, "{}", world.scene().scene.name);
            }
        }
    });
}
