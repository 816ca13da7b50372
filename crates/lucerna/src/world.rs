//! The world: a scene that burns.

use lucerna_frame::Frame;
use lucerna_scene::LoadedScene;

/// Why a world could not be made or stepped.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {}

/// Which debug lines the frame carries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DebugLines {
    /// The particle chains.
    pub skeletons: bool,
    /// The control nets.
    pub control_nets: bool,
    /// The edges of the flame triangles.
    pub wireframe: bool,
    /// The box of the air.
    pub air_box: bool,
}

/// What one call of [`World::step`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepSummary {
    /// Fixed steps that were run.
    pub steps: u32,
    /// Fixed steps that were due but dropped because the cap was reached.
    pub dropped: u32,
    /// Largest dimensionless divergence left after any of the steps' projections.
    pub divergence: f32,
    /// Where the time went.
    pub times: StageTimes,
}

/// Milliseconds that the stages of a step took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageTimes {
    /// Air.
    pub fluid_ms: f64,
    /// Particle chains.
    pub skeletons_ms: f64,
    /// Control nets and surfaces.
    pub nurbs_ms: f64,
}

/// A scene that burns.
#[derive(Debug)]
pub struct World {}

impl World {
    /// Lights the fires of a scene.
    pub fn new(_scene: LoadedScene) -> Result<Self, WorldError> {
        Ok(Self {})
    }
    /// Goes on by `dt_s` seconds in fixed steps of the scene's `time_step_s`, and makes the surfaces.
    pub fn step(&mut self, _dt_s: f32) -> Result<StepSummary, WorldError> {
        Ok(StepSummary::default())
    }
    /// Takes over a changed scene: keeps the fire burning where only parameters changed, starts anew where the
    /// grid or the wicks did.
    pub fn set_scene(&mut self, _scene: LoadedScene) -> Result<(), WorldError> {
        Ok(())
    }
    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &LoadedScene {
        unreachable!()
    }
    /// Back to time zero.
    pub fn reset(&mut self) {}
    /// Chooses the debug lines that [`World::frame`] carries.
    pub fn set_debug_lines(&mut self, _lines: DebugLines) {}
    /// Simulated time, s.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        0.0
    }
    /// A hash of all state that the next step depends on.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        0
    }
    /// What to draw now.
    #[must_use]
    pub fn frame(&self) -> Frame<'_> {
        Frame::default()
    }
}
