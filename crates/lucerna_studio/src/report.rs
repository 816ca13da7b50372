//! What a measured run writes down.

use crate::cli::SurfacesArg;
use lucerna::StageTimes;
use lucerna::frame::Shading;
use lucerna::render::{Stage, Statistics};
use serde::Serialize;

/// Milliseconds of one stage, one number a frame.
#[derive(Clone, Debug, Default)]
pub struct Samples(Vec<f64>);

impl Samples {
    /// Adds the time of one frame.
    pub fn push(&mut self, ms: f64) {
        self.0.push(ms);
    }

    /// The smallest value that at least `percent` per cent of the samples do not exceed (nearest rank); 0 without
    /// samples.
    #[must_use]
    pub fn percentile(&self, percent: f64) -> f64 {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        let rank = (percent / 100.0 * sorted.len() as f64).ceil() as usize;
        sorted.get(rank.saturating_sub(1)).copied().unwrap_or_default()
    }

    fn summary(&self) -> Milliseconds {
        Milliseconds { median: rounded(self.percentile(50.0)), p95: rounded(self.percentile(95.0)) }
    }
}

fn rounded(ms: f64) -> f64 {
    (ms * 1e4).round() / 1e4
}

/// A stage over all frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Milliseconds {
    /// Half of the frames took no longer.
    pub median: f64,
    /// Nineteen of twenty frames took no longer.
    pub p95: f64,
}

/// The stages of a frame in the order in which they run.
#[derive(Clone, Debug, Default)]
pub struct Timings {
    fluid: Samples,
    skeletons: Samples,
    nurbs: Samples,
    upload: Samples,
    gpu: [Samples; Stage::ALL.len()],
    frame: Samples,
}

impl Timings {
    /// Adds what the world took for a frame.
    pub fn push_world(&mut self, times: &StageTimes) {
        self.fluid.push(times.fluid_ms);
        self.skeletons.push(times.skeletons_ms);
        self.nurbs.push(times.nurbs_ms);
    }

    /// Adds what the upload, the stages on the device and the whole frame took.
    pub fn push_gpu(&mut self, upload_ms: f64, stages_ms: [f64; Stage::ALL.len()], frame_ms: f64) {
        self.upload.push(upload_ms);
        for (samples, ms) in self.gpu.iter_mut().zip(stages_ms) {
            samples.push(ms);
        }
        self.frame.push(frame_ms);
    }

    /// Median and 95th percentile of every stage.
    #[must_use]
    pub fn summary(&self) -> Stages {
        let [surfaces, shadows, opaque, peel, glow, compose] = self.gpu.each_ref().map(Samples::summary);
        Stages {
            fluid: self.fluid.summary(),
            skeletons: self.skeletons.summary(),
            nurbs: self.nurbs.summary(),
            upload: self.upload.summary(),
            surfaces,
            shadows,
            opaque,
            peel,
            glow,
            compose,
            frame: self.frame.summary(),
        }
    }
}

/// Milliseconds of every stage.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Stages {
    /// Air.
    pub fluid: Milliseconds,
    /// Particle chains.
    pub skeletons: Milliseconds,
    /// Control nets and lights; surfaces where they are made on the processor.
    pub nurbs: Milliseconds,
    /// Vertices or control points, lights and settings to the device.
    pub upload: Milliseconds,
    /// Surfaces made on the device.
    pub surfaces: Milliseconds,
    /// What the lights with a shadow see.
    pub shadows: Milliseconds,
    /// The lit opaque scene.
    pub opaque: Milliseconds,
    /// The flames.
    pub peel: Milliseconds,
    /// The blurred copies.
    pub glow: Milliseconds,
    /// Everything into the target.
    pub compose: Milliseconds,
    /// The whole frame by the clock, without reading back and encoding pictures.
    pub frame: Milliseconds,
}

/// The report of a run, written as JSON.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the scene.
    pub scene: String,
    /// The preset that was applied.
    pub preset: Option<String>,
    /// Where everything random comes from.
    pub seed: u64,
    /// Frames that were drawn.
    pub frames: u32,
    /// Frames per second that the medians allow: 1000 / `stages_ms.frame.median`.
    pub fps: f64,
    /// Frames per second of simulated time.
    pub animation_fps: f64,
    /// Simulated seconds before the first frame.
    pub warmup_s: f64,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Where the vertices of flames were made.
    pub surfaces: SurfacesArg,
    /// What a flame's pixels are made from.
    pub shading: Shading,
    /// Depth layers that were peeled.
    pub layers_peeled: u32,
    /// The graphics adapter.
    pub adapter: String,
    /// Hash of the world after the last step, 16 hexadecimal digits.
    pub state_hash: String,
    /// Most flame triangles drawn in a frame.
    pub triangles: u64,
    /// Most flame surfaces behind any pixel in the frames that were counted.
    pub layers: u32,
    /// Most pixels times intervals still open at the last layer in the frames that were counted.
    pub open_intervals: u32,
    /// Frames whose layers were counted, each in a drawing of its own that is not timed.
    pub frames_counted: u32,
    /// Largest dimensionless divergence that any step left.
    pub divergence_max: f64,
    /// Mean luminance of each frame's picture with its glow, before exposure and tone mapping: 1 is what appears white
    /// at exposure 0. Drawn for itself, not timed, at most 160 pixels wide and high.
    pub luminance: Vec<f64>,
    /// Fixed steps, warm-up included.
    pub steps: u64,
    /// Fixed steps that were dropped.
    pub dropped_steps: u64,
    /// How the times on the device were taken.
    pub gpu_timing: &'static str,
    /// Milliseconds of every stage.
    pub stages_ms: Stages,
}

/// Steps, triangles and layers of a run so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Fixed steps.
    pub steps: u64,
    /// Fixed steps that were dropped.
    pub dropped: u64,
    /// Largest divergence.
    pub divergence: f32,
    /// Most triangles of a frame.
    pub triangles: u64,
    /// Most layers and open intervals.
    pub gpu: Statistics,
    /// Frames whose layers were counted.
    pub counted: u32,
}

impl Counts {
    /// Adds what stepping did.
    pub fn push_step(&mut self, step: &lucerna::StepSummary) {
        self.steps += u64::from(step.steps);
        self.dropped += u64::from(step.dropped);
        self.divergence = self.divergence.max(step.divergence);
    }

    /// Adds the layers counted in one frame.
    pub fn push_layers(&mut self, counted: Statistics) {
        self.gpu.layers = self.gpu.layers.max(counted.layers);
        self.gpu.open_intervals = self.gpu.open_intervals.max(counted.open_intervals);
        self.counted += 1;
    }
}

/// Triangles of all flames of a frame.
#[must_use]
pub fn triangles(frame: &lucerna::frame::Frame<'_>) -> u64 {
    frame.flame_draws.iter().map(|draw| u64::from(draw.index_count / 3)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_nearest_rank() {
        let samples = Samples((1..=20).rev().map(f64::from).collect());
        assert_eq!(samples.percentile(50.0), 10.0);
        assert_eq!(samples.percentile(95.0), 19.0);
        assert_eq!(samples.percentile(100.0), 20.0);
        assert_eq!(samples.percentile(0.0), 1.0);
        assert_eq!(Samples(vec![3.0]).percentile(95.0), 3.0);
        assert_eq!(Samples::default().percentile(50.0), 0.0);
    }

    #[test]
    fn stages_keep_their_order() {
        let mut timings = Timings::default();
        timings.push_world(&StageTimes { fluid_ms: 1.0, skeletons_ms: 2.0, nurbs_ms: 3.0 });
        timings.push_gpu(4.0, [5.0, 6.0, 7.0, 8.0, 9.0, 10.0], 55.0);
        let value = serde_json::to_value(timings.summary()).unwrap();
        let order = [
            "fluid",
            "skeletons",
            "nurbs",
            "upload",
            "surfaces",
            "shadows",
            "opaque",
            "peel",
            "glow",
            "compose",
            "frame",
        ];
        for (stage, expected) in order.iter().zip([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 55.0]) {
            assert_eq!(value[stage]["median"], expected, "{stage}");
            assert_eq!(value[stage]["p95"], expected, "{stage}");
        }
    }

    #[test]
    fn counts_keep_the_worst() {
        let mut counts = Counts::default();
        let step = |divergence, dropped| lucerna::StepSummary { steps: 2, dropped, divergence, ..Default::default() };
        counts.push_step(&step(0.25, 0));
        counts.push_step(&step(0.125, 1));
        counts.push_layers(Statistics { layers: 6, open_intervals: 0 });
        counts.push_layers(Statistics { layers: 4, open_intervals: 9 });
        assert_eq!((counts.steps, counts.dropped, counts.divergence), (4, 1, 0.25));
        assert_eq!((counts.gpu.layers, counts.gpu.open_intervals, counts.counted), (6, 9, 2));
    }
}
