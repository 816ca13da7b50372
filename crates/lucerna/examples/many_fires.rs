//! How long the hall's fires take, by their number: `cargo run --release -p lucerna --example many_fires`.
//!
//! Every line is a hall with so many fires (ten candles to a torch), each stepped at 1/60 s. The times are the least
//! of several runs that take turns, so that other programs disturb them little.

use lucerna::scene::{LoadedScene, Scene};
use lucerna::{StageTimes, World};
use std::path::Path;

const STEPS: u32 = 30;
const ROUNDS: u32 = 5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let hall = lucerna::scene::open("hall")?.scene;
    let mut worlds = Vec::new();
    for fires in [55, 110, 220, 440] {
        let mut world = World::new(LoadedScene::from_scene(with_fires(&hall, fires), Path::new(""))?)?;
        for _ in 0..60 {
            world.step(1.0 / 60.0)?;
        }
        worlds.push((fires, world, [f64::INFINITY; 3]));
    }
    for _ in 0..ROUNDS {
        for (_, world, least) in &mut worlds {
            let mut sums = [0.0; 3];
            for _ in 0..STEPS {
                let StageTimes { fluid_ms, skeletons_ms, nurbs_ms } = world.step(1.0 / 60.0)?.times;
                sums.iter_mut().zip([fluid_ms, skeletons_ms, nurbs_ms]).for_each(|(sum, ms)| *sum += ms);
            }
            least.iter_mut().zip(sums).for_each(|(least, sum)| *least = least.min(sum / f64::from(STEPS)));
        }
    }
    println!("{} threads; milliseconds a frame of 1/60 s", rayon::current_num_threads());
    println!("fires  flames   air  skeletons  surfaces  together  a fire");
    for (fires, world, [air, skeletons, surfaces]) in &worlds {
        let (flames, together) = (world.flames().flame_lights().len(), air + skeletons + surfaces);
        let each = together / f64::from(*fires);
        println!("{fires:5}  {flames:6} {air:5.2}  {skeletons:9.2}  {surfaces:8.2}  {together:8.2}  {each:.4}");
    }
    Ok(())
}

/// The hall with another number of fires: some of its own, or those of several halls side by side.
fn with_fires(hall: &Scene, count: u32) -> Scene {
    let mut scene = hall.clone();
    for fire in &mut scene.fires {
        let own = fire.at.len();
        let wanted = own * count as usize / 220;
        let at = |i: usize| [fire.at[i % own][0] + 20.0 * (i / own) as f32, fire.at[i % own][1], fire.at[i % own][2]];
        (fire.at, fire.turns_deg) =
            ((0..wanted).map(at).collect(), (0..wanted).map(|i| fire.turns_deg[i % own]).collect());
    }
    scene.meshes.clear();
    scene
}
