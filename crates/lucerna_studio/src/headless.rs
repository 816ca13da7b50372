//! A run without a window: steps the world, draws, records and measures.

use crate::gpu::{Gpu, TARGET_FORMAT, Target};
use crate::job::Job;
use crate::light_meter::LightMeter;
use crate::progress::Progress;
use crate::record::{self, Recorder};
use crate::report::{self, Counts, Report, Timings};
use anyhow::{Context, Result};
use lucerna::render::{FireRenderer, Stage};
use lucerna::{StageTimes, World};
use std::time::Instant;

/// Frames of a measured run in which layers are counted.
const COUNTED_FRAMES: u32 = 20;
/// Longer side of the picture whose light is measured, px: the mean hardly depends on it, the time does.
const LIT_PX: u32 = 160;
/// Most fixed steps that the world is asked for at once, well below its cap, so that none is ever dropped.
const STEPS_AT_ONCE: f64 = 4.0;

/// Runs a job and says in words what was written, one line a file.
pub fn run(job: &Job) -> Result<Vec<String>> {
    let mut recorder = match &job.output {
        Some(output) => {
            // First of all what is cheap and can fail.
            let recorder = Recorder::new(output.clone(), job.size_px, job.frames, job.fps)?;
            output.prepare()?;
            Some(recorder)
        }
        None => None,
    };
    for path in [&job.report, &job.save].into_iter().flatten() {
        record::check_file(path)?;
    }
    let mut run = Run::new(job)?;
    run.warm_up()?;
    let mut progress = Progress::new("frame", u64::from(job.frames));
    for frame in 0..job.frames {
        run.frame(frame)?;
        if let Some(recorder) = &mut recorder {
            if recorder.wants_next() {
                run.target.read(&run.gpu, &mut run.rgb)?;
                recorder.push(&run.rgb)?;
            } else {
                recorder.skip();
            }
        }
        progress.set(u64::from(frame) + 1);
    }
    drop(progress);
    let mut written = Vec::new();
    if let Some(recorder) = recorder {
        written.push(recorder.finish()?);
    }
    if let Some(path) = &job.save {
        std::fs::write(path, run.world.save()).with_context(|| format!("cannot write {}", path.display()))?;
        written.push(format!("wrote {}", path.display()));
    }
    if let Some(path) = &job.report {
        let json = serde_json::to_string_pretty(&run.report()).context("the report cannot be written as JSON")?;
        std::fs::write(path, json + "\n").with_context(|| format!("cannot write {}", path.display()))?;
        written.push(format!("wrote {}", path.display()));
    }
    Ok(written)
}

/// A run under way. Everything that is used for every frame is made once.
struct Run<'a> {
    job: &'a Job,
    gpu: Gpu,
    target: Target,
    renderer: FireRenderer,
    world: World,
    timings: Timings,
    counts: Counts,
    /// With a report: what measures the light, and the light of each frame.
    meter: Option<LightMeter>,
    luminance: Vec<f64>,
    rgb: Vec<u8>,
}

impl<'a> Run<'a> {
    fn new(job: &'a Job) -> Result<Self> {
        let gpu = Gpu::open()?;
        let target = Target::new(&gpu, job.size_px)?;
        let renderer = FireRenderer::new(&gpu.device, &gpu.queue, TARGET_FORMAT);
        gpu.check()?;
        let mut world = World::new(job.scene.clone())?;
        world.set_surfaces(job.surfaces.into());
        if let Some(path) = &job.resume {
            let bytes = std::fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
            world.restore(&bytes).with_context(|| format!("cannot go on from {}", path.display()))?;
        }
        let meter = match job.report {
            Some(_) => Some(LightMeter::new(&gpu, lit_size(job.size_px))?),
            None => None,
        };
        let (timings, counts) = (Timings::default(), Counts::default());
        let (luminance, rgb) = (Vec::new(), Vec::new());
        Ok(Self { job, gpu, target, renderer, world, timings, counts, meter, luminance, rgb })
    }

    fn slices(&self, time_s: f64) -> u32 {
        slices(time_s, f64::from(self.job.scene.scene.air.time_step_s))
    }

    fn measured(&self) -> bool {
        self.meter.is_some()
    }

    /// Lets the fire grow, and draws once where the first frame's time counts.
    fn warm_up(&mut self) -> Result<()> {
        let slices = self.slices(self.job.warmup_s);
        let mut progress = Progress::new("warming up", u64::from(slices));
        for slice in 0..slices {
            self.step((self.job.warmup_s / f64::from(slices)) as f32)?;
            progress.set(u64::from(slice) + 1);
        }
        if self.measured() {
            self.prepare()?;
            self.render()?;
        }
        Ok(())
    }

    fn step(&mut self, dt_s: f32) -> Result<StageTimes> {
        let scene = &self.world.scene().scene;
        let view = scene.camera_at(self.world.time_s());
        self.world.set_view(&view)?;
        let step = self.world.step(dt_s)?;
        self.counts.push_step(&step);
        Ok(step.times)
    }

    /// Steps and draws one frame.
    fn frame(&mut self, frame: u32) -> Result<()> {
        let started = Instant::now();
        let dt_s = 1.0 / self.job.fps;
        let slices = self.slices(dt_s);
        let mut times = StageTimes::default();
        for _ in 0..slices {
            let slice = self.step((dt_s / f64::from(slices)) as f32)?;
            times.fluid_ms += slice.fluid_ms;
            times.skeletons_ms += slice.skeletons_ms;
            times.nurbs_ms += slice.nurbs_ms;
        }
        if self.measured() {
            self.draw_measured(started, &times)?;
            let every = self.job.frames.div_ceil(COUNTED_FRAMES);
            if frame.is_multiple_of(every) || frame + 1 == self.job.frames {
                self.count_layers()?;
            }
            if let Some(meter) = &mut self.meter {
                self.luminance.push(meter.read(&self.gpu, &self.world)?);
            }
        } else {
            self.prepare()?;
            self.render()?;
        }
        self.counts.triangles = self.counts.triangles.max(report::triangles(&self.world.frame()));
        Ok(())
    }

    fn prepare(&mut self) -> Result<()> {
        let scene = &self.world.scene().scene;
        let (gpu, frame) = (&self.gpu, self.world.frame());
        let camera = scene.camera_at(self.world.time_s());
        self.renderer.prepare(&gpu.device, &gpu.queue, self.job.size_px, &frame, &camera, &scene.look)?;
        Ok(())
    }

    fn render(&self) -> Result<()> {
        let mut encoder = self.gpu.encoder();
        self.renderer.render(&mut encoder, &self.target.view);
        self.gpu.submit(encoder);
        self.gpu.wait()
    }

    /// Draws stage by stage and waits after each.
    fn draw_measured(&mut self, started: Instant, times: &StageTimes) -> Result<()> {
        let upload = Instant::now();
        self.prepare()?;
        self.gpu.submit(self.gpu.encoder());
        self.gpu.wait()?;
        let upload_ms = milliseconds(upload);
        let mut stages_ms = [0.0; Stage::ALL.len()];
        for (stage, ms) in Stage::ALL.into_iter().zip(&mut stages_ms) {
            let began = Instant::now();
            let mut encoder = self.gpu.encoder();
            self.renderer.record(stage, &mut encoder, &self.target.view);
            self.gpu.submit(encoder);
            self.gpu.wait()?;
            *ms = milliseconds(began);
        }
        self.timings.push_world(times);
        self.timings.push_gpu(upload_ms, stages_ms, milliseconds(started));
        Ok(())
    }

    /// Draws the frame once more, untimed, with layers counted; then once as before, so that the next timed frame
    /// finds everything in place.
    fn count_layers(&mut self) -> Result<()> {
        self.renderer.set_statistics(true);
        self.prepare()?;
        self.render()?;
        self.counts.push_layers(self.renderer.read_statistics(&self.gpu.device, &self.gpu.queue)?);
        self.renderer.set_statistics(false);
        self.prepare()?;
        self.render()
    }

    fn report(&self) -> Report {
        let job = self.job;
        let scene = &job.scene.scene;
        let stages_ms = self.timings.summary();
        let frame_ms = stages_ms.frame.median;
        Report {
            scene: scene.name.clone(),
            preset: job.preset.clone(),
            seed: scene.seed,
            frames: job.frames,
            fps: if frame_ms > 0.0 { (1e5 / frame_ms).round() / 100.0 } else { 0.0 },
            animation_fps: job.fps,
            warmup_s: job.warmup_s,
            size: job.size_px,
            surfaces: job.surfaces,
            shading: scene.look.shading,
            layers_peeled: scene.look.layers,
            adapter: self.gpu.adapter.clone(),
            state_hash: format!("{:016x}", self.world.state_hash()),
            triangles: self.counts.triangles,
            layers: self.counts.gpu.layers,
            open_intervals: self.counts.gpu.open_intervals,
            frames_counted: self.counts.counted,
            divergence_max: f64::from(self.counts.divergence),
            luminance: self.luminance.clone(),
            steps: self.counts.steps,
            dropped_steps: self.counts.dropped,
            gpu_timing: "submit-and-wait per stage",
            stages_ms,
        }
    }
}

/// A size of the same shape whose longer side is at most [`LIT_PX`].
fn lit_size(size_px: [u32; 2]) -> [u32; 2] {
    let longer = size_px[0].max(size_px[1]).max(LIT_PX);
    size_px.map(|side| (side * LIT_PX).div_ceil(longer))
}

/// Number of calls of the world that a time is cut into, given its fixed step.
pub(crate) fn slices(time_s: f64, step_s: f64) -> u32 {
    // A hair more than a slice is still one: times are not exact.
    (time_s / (STEPS_AT_ONCE * step_s) - 1e-6).ceil().max(0.0) as u32
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_is_measured_in_a_small_picture_of_the_same_shape() {
        assert_eq!([[960, 720], [48, 32], [16, 8192]].map(lit_size), [[160, 120], [48, 32], [1, 160]]);
    }

    #[test]
    fn times_are_cut_into_slices_that_drop_nothing() {
        let slices_at = |time_s| slices(time_s, 1.0 / 60.0);
        assert_eq!([0.0, 1.0 / 1000.0, 1.0 / 30.0, 1.0 / 15.0, 1.0 / 12.0, 1.0].map(slices_at), [0, 1, 1, 1, 2, 15]);
        assert_eq!(slices(1.0 / 30.0, 0.001), 9);
    }
}
