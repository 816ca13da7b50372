//! Running averages of what a frame costs.

use lucerna::StepSummary;
use lucerna::render::{Stage, Statistics};
use std::time::Instant;

/// Share of the newest frame in an average.
const NEWEST: f64 = 0.1;

/// A running average of milliseconds.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Meter(Option<f64>);

impl Meter {
    pub(super) fn push(&mut self, ms: f64) {
        self.0 = Some(self.0.map_or(ms, |mean| mean + NEWEST * (ms - mean)));
    }

    pub(super) fn ms(self) -> f64 {
        self.0.unwrap_or_default()
    }
}

/// What is shown under "Statistics".
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Meters {
    pub(super) fluid: Meter,
    pub(super) skeletons: Meter,
    pub(super) nurbs: Meter,
    pub(super) upload: Meter,
    pub(super) gpu: [Meter; Stage::ALL.len()],
    /// From one frame to the next.
    pub(super) frame: Meter,
    pub(super) steps: u64,
    pub(super) dropped: u64,
    pub(super) divergence: f32,
    /// Counted only while asked for.
    pub(super) layers: Option<Statistics>,
    last_frame: Option<Instant>,
}

impl Meters {
    /// Begins a frame and gives the seconds since the last one began.
    pub(super) fn begin_frame(&mut self) -> f64 {
        let now = Instant::now();
        let seconds = self.last_frame.map_or(0.0, |last| (now - last).as_secs_f64());
        if self.last_frame.replace(now).is_some() {
            self.frame.push(seconds * 1e3);
        }
        seconds
    }

    pub(super) fn push_step(&mut self, step: &StepSummary) {
        self.steps += u64::from(step.steps);
        self.dropped += u64::from(step.dropped);
        self.divergence = step.divergence;
        self.fluid.push(step.times.fluid_ms);
        self.skeletons.push(step.times.skeletons_ms);
        self.nurbs.push(step.times.nurbs_ms);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averages_begin_at_the_first_value_and_follow() {
        let mut meter = Meter::default();
        assert_eq!(meter.ms(), 0.0);
        meter.push(4.0);
        assert_eq!(meter.ms(), 4.0);
        for _ in 0..200 {
            meter.push(8.0);
        }
        assert!((meter.ms() - 8.0).abs() < 1e-6);
    }
}
