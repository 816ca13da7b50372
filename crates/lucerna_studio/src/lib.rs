//! The studio: a window with a panel, a headless runner, a recorder, and the program `lucerna`.
//!
//! The program is a thin shell around this library, and so is every example:
//!
//! ```no_run
//! fn main() -> std::process::ExitCode {
//!     lucerna_studio::run_example_with("candle", |scene| {
//!         scene.look.exposure_stops += 0.5;
//!     })
//! }
//! ```
//!
//! A run without a window goes [`cli`] -> [`scenes`] -> [`job`] -> [`headless`] -> [`record`] and [`report`]; a run with one
//! goes [`cli`] -> [`scenes`] -> [`window`]; flames for other programs go [`cli`] -> [`scenes`] -> [`export`];
//! the laws of fire [`cli`] -> [`validate`]. Errors become one line and exit code 2 in [`program`].

pub mod brightness;
pub mod cli;
pub mod export;
pub mod gpu;
pub mod headless;
pub mod job;
pub mod light_meter;
pub mod limits;
pub mod program;
pub mod progress;
pub mod record;
pub mod report;
pub mod scenes;
pub mod validate;
pub mod window;

pub use lucerna;
pub use program::{run_example, run_example_with, run_program};
