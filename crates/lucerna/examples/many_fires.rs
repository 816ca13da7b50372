//! How long the hall's fires take, by their number: `cargo run --release -p lucerna --example many_fires`.
//!
//! Every line is a hall with so many fires (ten candles to a torch), stepped at 1/60 s, all burning for themselves or
//! within a budget. The times are the least of several runs that take turns, so that other programs disturb them
//! little. Numbers of fires can be given instead: `-- 220 440`.

use lucerna::scene::{Budget, LoadedScene, Scene};
use lucerna::{StageTimes, World};
use std::path::Path;

const STEPS: u32 = 30;
const ROUNDS: u32 = 5;
/// What the hall may cost: about a quarter of the air that all of its fires would take.
const BUDGET: Budget = Budget { cell_steps: 130_000, vertices: 30_000 };

struct Run {
    fires: u32,
    budget: Option<Budget>,
    world: World,
    least_ms: [f64; 3],
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let hall = lucerna::scene::open("hall")?.scene;
    let mut given = std::env::args().skip(1).map(|text| text.parse()).collect::<Result<Vec<u32>, _>>()?;
    if given.is_empty() {
        given = vec![55, 110, 220, 440];
    }
    let mut runs = Vec::new();
    for budget in [None, Some(BUDGET)] {
        for &fires in &given {
            let mut world = World::new(LoadedScene::from_scene(with_fires(&hall, fires), Path::new(""))?)?;
            world.set_budget(budget)?;
            for _ in 0..200 {
                world.step(1.0 / 60.0)?;
            }
            runs.push(Run { fires, budget, world, least_ms: [f64::INFINITY; 3] });
        }
    }
    for _ in 0..ROUNDS {
        for Run { world, least_ms, .. } in &mut runs {
            let mut sums = [0.0; 3];
            for _ in 0..STEPS {
                let StageTimes { fluid_ms, skeletons_ms, nurbs_ms } = world.step(1.0 / 60.0)?.times;
                sums.iter_mut().zip([fluid_ms, skeletons_ms, nurbs_ms]).for_each(|(sum, ms)| *sum += ms);
            }
            least_ms.iter_mut().zip(sums).for_each(|(least, sum)| *least = least.min(sum / f64::from(STEPS)));
        }
    }
    println!("{} threads; milliseconds a frame of 1/60 s", rayon::current_num_threads());
    println!("detail  fires  flames   air  skeletons  surfaces  together  a fire");
    for Run { fires, budget, world, least_ms: [air, skeletons, surfaces] } in &runs {
        let detail = if budget.is_some() { "budget" } else { "full" };
        let (flames, together) = (world.flames().flame_lights().len(), air + skeletons + surfaces);
        let each = together / f64::from(*fires);
        println!(
            "{detail:6}  {fires:5}  {flames:6} {air:5.2}  {skeletons:9.2}  {surfaces:8.2}  {together:8.2}  {each:.4}"
        );
    }
    Ok(())
}

/// The hall with another number of fires: some of its own, or those of several halls side by side.
fn with_fires(hall: &Scene, count: u32) -> Scene {
    let mut scene = hall.clone();
    for fire in &mut scene.fires {
        let own = fire.at.len();
        let wanted = (own * count as usize / 220).max(1);
        let at = |i: usize| [fire.at[i % own][0] + 20.0 * (i / own) as f32, fire.at[i % own][1], fire.at[i % own][2]];
        let turn = |i: usize| fire.turns_deg[i % own];
        (fire.at, fire.turns_deg) = ((0..wanted).map(at).collect(), (0..wanted).map(turn).collect());
    }
    scene.meshes.clear();
    scene
}
