//! A candle in a draught: a gentle wind that the flame leans away from.
//!
//! ```text
//! cargo run --release --example candle
//! cargo run --release --example candle -- --headless --out candle.gif --size 320x400
//! ```

use lucerna_studio::lucerna::flame::Swing;
use std::process::ExitCode;

fn main() -> ExitCode {
    lucerna_studio::run_example_with("candle", |scene| {
        // A draught comes through the open sides of the box of air; the flame is carried by that air.
        scene.air.wind_m_s = [0.03, 0.0, 0.0];

        // Fuel rises unevenly in the wick: the flame breathes a little.
        for fire in &mut scene.fires {
            fire.fuel.swing = Swing::Noise { amplitude: 0.1, frequency_hz: 2.0 };
        }
    })
}
