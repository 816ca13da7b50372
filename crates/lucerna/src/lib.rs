//! Real fire for real-time worlds: a [`World`] made from a scene, `step`, and the frame to draw now.
//!
//! ```
//! use lucerna::World;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut world = World::new(lucerna::scene::open("candle")?)?;
//! for _ in 0..60 {
//!     world.step(1.0 / 60.0)?;
//! }
//! let frame = world.frame();
//! assert_eq!(frame.flame_draws.len(), 1);
//! assert_eq!(frame.lights.len(), 3);
//! # Ok(())
//! # }
//! ```
//!
//! With the feature `render` (on by default) `lucerna::render` draws that frame with wgpu. With the feature `export`
//! `lucerna::export` writes flames for other programs.

mod air;
mod airs;
mod detail;
mod error;
#[cfg(feature = "export")]
pub mod export;
mod movers;
mod report;
mod save;
mod world;

pub use error::WorldError;
pub use lucerna_flame as flame;
pub use lucerna_fluid as fluid;
pub use lucerna_frame as frame;
#[cfg(feature = "render")]
pub use lucerna_render as render;
pub use lucerna_scene as scene;
pub use report::{DebugLines, StageTimes, StepSummary};
pub use save::SaveError;
pub use world::{MAX_STEPS, World};
