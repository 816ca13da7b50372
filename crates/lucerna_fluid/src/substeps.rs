//! A step divided into parts, so that none carries the air too far at once.

use crate::advect::Advection;
use crate::combustion::CombustionReport;
use crate::conserve::COURANT;
use crate::fluid::Fluid;
use crate::pressure::speeds;
use crate::report::{StageTimes, StepReport};
use crate::scratch::Scratch;

impl Fluid {
    /// A step in as many equal parts as the limit on the Courant number asks for. What was added
    /// acts in all of them, and is used up then.
    pub(crate) fn advance_in_parts(&mut self, scratch: &mut Scratch, dt_s: f32) -> StepReport {
        let parts = self.parts(scratch, dt_s);
        let part_s = dt_s / parts as f32;
        let mut report = self.advance(scratch, part_s);
        for _ in 1..parts {
            report = together(&report, &self.advance(scratch, part_s));
        }
        self.sources.clear();
        StepReport { dt_s, substeps: parts, ..report }
    }

    /// Number of parts.
    fn parts(&self, scratch: &mut Scratch, dt_s: f32) -> u32 {
        let mut parts = 1.0_f32;
        if let Some(limit) = self.settings.cfl_limit {
            let crossed = speeds(&self.grid, &self.state.velocity, &mut scratch.partials).into_iter();
            let cfl = crossed.zip(self.grid.cell_m).map(|(speed, edge)| speed * dt_s / edge).fold(0.0, f32::max);
            parts = cfl / limit;
        }
        if self.settings.advection == Advection::Conservative {
            parts = parts.max(self.courant(scratch, dt_s) / COURANT);
        }
        // The conversion saturates.
        (parts.ceil() as u32).clamp(1, self.settings.max_substeps)
    }
}

/// Two parts as one: the worst of what is left undone, sums of work, and the state at the end.
fn together(first: &StepReport, then: &StepReport) -> StepReport {
    let times = (&first.times, &then.times);
    let mean = |a: f32, b: f32| (a * first.dt_s + b * then.dt_s) / (first.dt_s + then.dt_s);
    StepReport {
        dt_s: first.dt_s + then.dt_s,
        pressure_residual: first.pressure_residual.max(then.pressure_residual),
        divergence_before: first.divergence_before.max(then.divergence_before),
        divergence_after: first.divergence_after.max(then.divergence_after),
        divergence_after_per_s: first.divergence_after_per_s.max(then.divergence_after_per_s),
        rms_divergence_before: first.rms_divergence_before.max(then.rms_divergence_before),
        rms_divergence_after: first.rms_divergence_after.max(then.rms_divergence_after),
        rms_divergence_after_per_s: first.rms_divergence_after_per_s.max(then.rms_divergence_after_per_s),
        rms_speed_m_s: then.rms_speed_m_s,
        max_speed_m_s: then.max_speed_m_s,
        cfl: first.cfl.max(then.cfl),
        max_temperature_k: then.max_temperature_k,
        pressure_iterations: first.pressure_iterations + then.pressure_iterations,
        substeps: first.substeps + then.substeps,
        carried_out_kw: mean(first.carried_out_kw, then.carried_out_kw),
        combustion: CombustionReport {
            heat_release_kw: mean(first.combustion.heat_release_kw, then.combustion.heat_release_kw),
            radiated_kw: mean(first.combustion.radiated_kw, then.combustion.radiated_kw),
            burnt_kg_s: mean(first.combustion.burnt_kg_s, then.combustion.burnt_kg_s),
            fuel_kg: then.combustion.fuel_kg,
        },
        times: StageTimes {
            advection_ms: times.0.advection_ms + times.1.advection_ms,
            forces_ms: times.0.forces_ms + times.1.forces_ms,
            viscosity_ms: times.0.viscosity_ms + times.1.viscosity_ms,
            pressure_ms: times.0.pressure_ms + times.1.pressure_ms,
            report_ms: times.0.report_ms + times.1.report_ms,
        },
    }
}
