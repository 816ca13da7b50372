//! What a world is asked to show and says of its steps.

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

/// What one call of [`World::step`](crate::World::step) did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepSummary {
    /// Fixed steps that were run.
    pub steps: u32,
    /// Fixed steps that were due but dropped because the cap of [`MAX_STEPS`](crate::MAX_STEPS) was reached.
    pub dropped: u32,
    /// Cells of air that were advanced, once for each part of a step.
    pub cell_steps: u64,
    /// Largest dimensionless divergence left after any of the steps' projections.
    pub divergence: f32,
    /// Where the time went.
    pub times: StageTimes,
}

/// Milliseconds that the stages of a step took, all fixed steps together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageTimes {
    /// Air.
    pub fluid_ms: f64,
    /// Particle chains.
    pub skeletons_ms: f64,
    /// Control nets, surfaces, lights and debug lines.
    pub nurbs_ms: f64,
}
