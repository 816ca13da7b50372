//! A torch whose fuel is uneven and whose tips break away.
//!
//! ```text
//! cargo run --release --example torch
//! cargo run --release --example torch -- --headless --frames 300 --report torch.json
//! ```

use lucerna_studio::lucerna::flame::FuelDistribution;
use std::process::ExitCode;

fn main() -> ExitCode {
    lucerna_studio::run_example_with("torch", |scene| {
        for fire in &mut scene.fires {
            // Your own distribution of fuel along each wick: samples from one end to the other.
            fire.fuel.distribution = FuelDistribution::Table(vec![0.6, 1.0, 0.7, 0.9, 0.5]);

            // Expected number of tips that break away in a second, from each flame.
            fire.skeletons.shed_per_s = 3.0;
        }
        // Flames stand behind one another: peel enough layers to see them all.
        scene.look.layers = 12;
    })
}
