//! Real fire for real-time worlds: a [`World`] made from a scene, `step`, and the frame to draw now.

mod air;
mod world;

pub use lucerna_flame as flame;
pub use lucerna_fluid as fluid;
pub use lucerna_frame as frame;
#[cfg(feature = "render")]
pub use lucerna_render as render;
pub use lucerna_scene as scene;
pub use world::{DebugLines, MAX_STEPS, StageTimes, StepSummary, World, WorldError};
