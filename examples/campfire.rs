//! A campfire seen from nearby, with the light that it throws around.
//!
//! ```text
//! cargo run --release --example campfire
//! cargo run --release --example campfire -- --headless --out campfire.png --size 1920x1080
//! ```

use std::process::ExitCode;

fn main() -> ExitCode {
    lucerna_studio::run_example_with("campfire", |scene| {
        // Three quarters of the way from the target to where the scene's camera stands.
        let camera = &mut scene.camera;
        for (eye, target) in camera.eye.iter_mut().zip(camera.target) {
            *eye = target + 0.75 * (*eye - target);
        }

        // A little light from the night sky besides the fire's own.
        scene.look.ambient = [0.002, 0.003, 0.006];

        // Every random number of the fire comes from the seed: another seed is another fire.
        scene.seed = 7;
    })
}
