//! What a step reports.

use crate::combustion::CombustionReport;

/// How a step went. Divergences are relative: times the shortest edge of a cell, over the
/// greatest face speed that the projection met or left. A value of 1 is a cell that empties
/// itself at full speed; rounding leaves 1e-6 to 1e-4 after [`crate::PressureSolver::Direct`].
/// Where the caller added expansion, they measure `div u - expansion`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Length of the step, s.
    pub dt_s: f32,
    /// What the pressure solver left: root mean square divergence after over before.
    /// Zero where nothing was to be done.
    pub pressure_residual: f32,
    /// Greatest relative divergence before the projection.
    pub divergence_before: f32,
    /// Greatest relative divergence after the projection.
    pub divergence_after: f32,
    /// Greatest divergence after the projection, 1/s.
    pub divergence_after_per_s: f32,
    /// Root mean square divergence before the projection, relative: times the shortest edge of
    /// a cell, over the root mean square speed that the projection met or left, whichever is
    /// greater. The mean is over the cells of air; in a region without an open side the mean of
    /// the divergence itself is taken out first, as nothing can get away from there.
    pub rms_divergence_before: f32,
    /// The same after the projection, over the same speed: the measure of how well the pressure
    /// was solved for. Rounding leaves 1e-7 to 1e-5.
    pub rms_divergence_after: f32,
    /// Root mean square divergence after the projection, 1/s.
    pub rms_divergence_after_per_s: f32,
    /// Root mean square speed after the projection, m/s: of each component over all its faces,
    /// those on the sides and in obstacles too; squares added over the components.
    pub rms_speed_m_s: f32,
    /// Greatest speed through a face, m/s.
    pub max_speed_m_s: f32,
    /// Courant number: cells that the fastest face velocity crosses in this step.
    pub cfl: f32,
    /// Highest temperature above ambient, K.
    pub max_temperature_k: f32,
    /// Iterations of the pressure solver: of conjugate gradients around obstacles, sweeps of
    /// Gauss-Seidel; 0 where it is solved directly.
    pub pressure_iterations: u32,
    /// Parts into which the step was divided; see [`crate::FluidBuilder::cfl_limit`].
    pub substeps: u32,
    /// Heat that the air carried out of the box through its sides, less what it carried in, kW:
    /// what the transport of temperature took out of the box.
    pub carried_out_kw: f32,
    /// What burnt and radiated.
    pub combustion: CombustionReport,
    /// Time that each stage took.
    pub times: StageTimes,
}

/// Time that each stage of a step took, ms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageTimes {
    /// Moving velocity and scalars with the air.
    pub advection_ms: f32,
    /// Heat, combustion, and all that accelerates.
    pub forces_ms: f32,
    /// Viscosity and conduction.
    pub viscosity_ms: f32,
    /// Projections.
    pub pressure_ms: f32,
    /// Figures for this report.
    pub report_ms: f32,
}
