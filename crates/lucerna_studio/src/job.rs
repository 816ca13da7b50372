//! What a run without a window is to do, with every default filled in.

use crate::cli::{RecordArgs, SceneArgs, SurfacesArg};
use crate::record::Output;
use anyhow::{Result, bail};
use lucerna::scene::LoadedScene;
use std::path::{Path, PathBuf};

/// Size of a picture where none is given.
const SIZE_PX: [u32; 2] = [960, 720];
/// Seconds simulated before the first frame where nothing is said.
const WARMUP_S: f64 = 2.0;
/// Length of an animation where none is given.
const ANIMATION_S: f64 = 5.0;

/// A run with everything decided.
#[derive(Clone, Debug)]
pub struct Job {
    /// What burns.
    pub scene: LoadedScene,
    /// The preset that was applied, for the report.
    pub preset: Option<String>,
    /// Where the vertices of flames are made.
    pub surfaces: SurfacesArg,
    /// Number of frames, 1 or more.
    pub frames: u32,
    /// Frames per second of simulated time.
    pub fps: f64,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Seconds simulated before the first frame.
    pub warmup_s: f64,
    /// Where the pictures go.
    pub output: Option<Output>,
    /// Where all that burns goes after the last frame.
    pub save: Option<PathBuf>,
    /// Where it comes from before the first.
    pub resume: Option<PathBuf>,
    /// Where the report goes; without it nothing is measured.
    pub report: Option<PathBuf>,
}

impl Job {
    /// Fills in the defaults. Without an output and a report, `default_out` is written.
    pub fn new(scene: LoadedScene, changes: &SceneArgs, args: &RecordArgs, default_out: PathBuf) -> Result<Self> {
        let output = match (&args.out, &args.report) {
            (Some(path), _) => Some(Output::new(path)?),
            (None, Some(_)) => None,
            (None, None) => Some(Output::Png(default_out)),
        };
        let written = [
            ("--out", output.as_ref().map(Output::path)),
            ("--save", args.save.as_deref()),
            ("--report", args.report.as_deref()),
        ];
        for (at, (option, path)) in written.iter().enumerate() {
            if let (Some(path), Some((other, _))) =
                (path, written[..at].iter().find(|(_, other)| is_same(*path, *other)))
            {
                bail!("{other} and {option} are both {}: one would overwrite the other", path.display());
            }
        }
        let animated = matches!(output, Some(Output::Gif(_)));
        let fps = args.fps.unwrap_or(if animated { 20.0 } else { 30.0 });
        let frames = args.frames.unwrap_or(if animated { (ANIMATION_S * fps).ceil() as u32 } else { 1 });
        Ok(Self {
            scene,
            preset: changes.preset.clone(),
            surfaces: changes.surfaces,
            frames,
            fps,
            size_px: args.size.unwrap_or(SIZE_PX),
            warmup_s: args.warmup.unwrap_or(if args.resume.is_some() { 0.0 } else { WARMUP_S }),
            save: args.save.clone(),
            resume: args.resume.clone(),
            output,
            report: args.report.clone(),
        })
    }
}

/// Whether both are paths of one file, which need not be there yet.
fn is_same(a: Option<&Path>, b: Option<&Path>) -> bool {
    let place = |path: &Path| {
        let folder = std::path::absolute(path).ok()?.parent()?.canonicalize().ok()?;
        Some(folder.join(path.file_name()?))
    };
    a.zip(b).is_some_and(|(a, b)| a == b || place(a).is_some_and(|a| place(b) == Some(a)))
}
