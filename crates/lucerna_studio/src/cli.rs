//! The command line: what can be said, its limits and its defaults.

use crate::limits::{parse_exit_after, parse_fps, parse_frames, parse_size, parse_warmup};
use clap::{Args, Parser, Subcommand, ValueEnum};
use lucerna::flame::Surfaces;
use lucerna::frame::Shading;
use std::path::PathBuf;

/// Real fire: look at it in a window or record it.
#[derive(Debug, Parser)]
#[command(name = "lucerna", version, args_conflicts_with_subcommands = true)]
pub struct ProgramArgs {
    /// What to do; without it, the scenes and commands are listed.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The commands of the program.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Opens a window with a panel for every parameter.
    View {
        /// A built-in scene or the path of a scene file.
        scene: String,
        /// Changes to the scene.
        #[command(flatten)]
        changes: SceneArgs,
        /// How the window behaves.
        #[command(flatten)]
        window: WindowArgs,
        /// Size of the window in points [default: 1280x800].
        #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = parse_size)]
        size: Option<[u32; 2]>,
    },
    /// Draws without a window into a PNG, an animated GIF or a folder of PNGs.
    Render {
        /// A built-in scene or the path of a scene file.
        scene: String,
        /// Changes to the scene.
        #[command(flatten)]
        changes: SceneArgs,
        /// What is recorded.
        #[command(flatten)]
        record: RecordArgs,
        /// Accepted for symmetry with the examples: `render` never opens a window.
        #[arg(long)]
        headless: bool,
    },
    /// Writes flames for other programs: meshes, control nets and lights. Needs no graphics device.
    Export {
        /// A built-in scene or the path of a scene file.
        scene: String,
        /// What is written.
        #[command(flatten)]
        export: ExportArgs,
    },
    /// Holds the fire to the measured laws of fire. Only the experiment `brightness` needs a graphics device.
    Validate {
        /// What is validated.
        #[command(flatten)]
        validate: ValidateArgs,
    },
}

/// Which laws, how thoroughly, and where to.
#[derive(Args, Clone, Debug, Default)]
pub struct ValidateArgs {
    /// Fine grids and long times: about an hour of one core. Without it, seconds, and what can be said by then.
    #[arg(long)]
    pub long: bool,
    /// Only these experiments, separated by commas.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Write validation.md, and plots and what was found into validation/, in this folder. Experiments that are not run
    /// keep what was found last time.
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
    /// Fail where a figure falls short of its law.
    #[arg(long)]
    pub strict: bool,
}

/// What is exported and how.
#[derive(Args, Clone, Debug)]
pub struct ExportArgs {
    /// The folder that is written to; it is made where there is none.
    #[arg(long, value_name = "FOLDER")]
    pub out: PathBuf,
    /// How the surfaces are written.
    #[arg(long, value_enum, default_value = "gltf")]
    pub format: FormatArg,
    /// Write the control nets of every frame as JSON.
    #[arg(long)]
    pub nets: bool,
    /// Write the lights of all frames, and what each flame gives off, as tables.
    #[arg(long)]
    pub lights: bool,
    /// Number of frames, 1 to 100000.
    #[arg(long, value_name = "N", default_value = "1", allow_negative_numbers = true, value_parser = parse_frames)]
    pub frames: u32,
    /// Frames per second of simulated time, 1 to 1000.
    #[arg(long, value_name = "F", default_value = "30", allow_negative_numbers = true, value_parser = parse_fps)]
    pub fps: f64,
    /// Seconds simulated before the first frame, so that the fire burns, 0 to 600.
    #[arg(long, value_name = "SECONDS", default_value = "2", allow_negative_numbers = true, value_parser = parse_warmup)]
    pub warmup: f64,
    /// Apply a preset to the scene (a bare `lucerna` lists them).
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Everything random is drawn from it.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub seed: Option<u64>,
}

/// `--format`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormatArg {
    /// One OBJ a frame.
    Obj,
    /// One binary glTF that shows the frames one after the other.
    Gltf,
}

/// The command line of an example: its scene is fixed, the rest is that of `view` and `render`.
#[derive(Debug, Parser)]
#[command(version, about = "A fire in a window, or recorded without one", long_about = None)]
pub struct ExampleArgs {
    /// Draw without a window; --out, --report and --frames imply it.
    #[arg(long)]
    pub headless: bool,
    /// Changes to the scene.
    #[command(flatten)]
    pub changes: SceneArgs,
    /// What is recorded.
    #[command(flatten)]
    pub record: RecordArgs,
    /// How the window behaves.
    #[command(flatten)]
    pub window: WindowArgs,
}

impl ExampleArgs {
    /// Whether the run needs no window: asked for, or implied by what is recorded.
    #[must_use]
    pub fn runs_headless(&self) -> bool {
        self.headless || self.record.out.is_some() || self.record.report.is_some() || self.record.frames.is_some()
    }
}

/// Changes to a scene before it burns.
#[derive(Args, Clone, Debug, Default)]
pub struct SceneArgs {
    /// Apply a preset to the scene (a bare `lucerna` lists them).
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Everything random is drawn from it.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub seed: Option<u64>,
    /// What a flame's pixels are made from.
    #[arg(long, value_enum)]
    pub shading: Option<ShadingArg>,
    /// Depth layers that are peeled, 1 to 32.
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=32))]
    pub layers: Option<u32>,
    /// Where the vertices of flames are made.
    #[arg(long, value_enum, default_value = "cpu")]
    pub surfaces: SurfacesArg,
}

/// What is recorded and how.
#[derive(Args, Clone, Debug, Default)]
pub struct RecordArgs {
    /// Number of frames, 1 to 100000 [default: 1; a .gif: five seconds].
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = parse_frames)]
    pub frames: Option<u32>,
    /// Frames per second of simulated time, 1 to 1000 [default: 30; a .gif: 20].
    #[arg(long, value_name = "F", allow_negative_numbers = true, value_parser = parse_fps)]
    pub fps: Option<f64>,
    /// Size of the picture in pixels, 16x16 to 8192x8192 [default: 960x720].
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Seconds simulated before the first frame, so that the fire burns, 0 to 600 [default: 2].
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = parse_warmup)]
    pub warmup: Option<f64>,
    /// Where to: a .png (the last frame), a .gif (an animation) or a folder (numbered PNGs).
    #[arg(long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Write all that burns after the last frame, to go on from it with --resume.
    #[arg(long, value_name = "FILE")]
    pub save: Option<PathBuf>,
    /// Go on from what --save wrote of the same scene, instead of lighting it; --warmup then is 0 unless it is given.
    #[arg(long, value_name = "FILE")]
    pub resume: Option<PathBuf>,
    /// Measure the run and write what was measured as JSON.
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,
}

/// How the window behaves.
#[derive(Args, Clone, Debug, Default)]
pub struct WindowArgs {
    /// Save a picture of the whole window when it closes through --exit-after.
    #[arg(long, value_name = "PATH", requires = "exit_after")]
    pub screenshot: Option<PathBuf>,
    /// Close the window after this many seconds, 0 to 86400.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = parse_exit_after)]
    pub exit_after: Option<f64>,
}

/// `--shading`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShadingArg {
    /// A texture on the surface, layers added.
    Shell,
    /// Light emitted along the part of the ray inside each flame.
    Volume,
}

impl From<ShadingArg> for Shading {
    fn from(arg: ShadingArg) -> Self {
        match arg {
            ShadingArg::Shell => Self::Shell,
            ShadingArg::Volume => Self::Volume,
        }
    }
}

/// `--surfaces`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SurfacesArg {
    /// On the processor.
    #[default]
    Cpu,
    /// On the graphics device, from control points.
    Gpu,
}

impl From<SurfacesArg> for Surfaces {
    fn from(arg: SurfacesArg) -> Self {
        match arg {
            SurfacesArg::Cpu => Self::Vertices,
            SurfacesArg::Gpu => Self::Nets,
        }
    }
}

/// A message of clap as one line: the paragraphs about usage and help are left out.
#[must_use]
pub fn one_line(error: &clap::Error) -> String {
    let text = error.to_string();
    let words: Vec<&str> = text.split("\n\n").next().unwrap_or_default().split_whitespace().collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(line: &str) -> Result<ProgramArgs, clap::Error> {
        ProgramArgs::try_parse_from(line.split_whitespace())
    }

    #[test]
    fn command_lines_are_consistent() {
        use clap::CommandFactory;
        ProgramArgs::command().debug_assert();
        ExampleArgs::command().debug_assert();
    }

    #[test]
    fn render_understands_every_option() {
        let line = "lucerna render torch --headless --frames 200 --fps 20 --size 480x360 --seed 7 --out a.gif \
                    --report r.json --preset paper --shading shell --layers 4 --surfaces gpu --warmup 1.5";
        let Some(Command::Render { scene, changes, record, headless }) = program(line).unwrap().command else {
            panic!("not a render command");
        };
        assert!(headless && scene == "torch");
        assert_eq!((changes.seed, changes.layers, changes.shading), (Some(7), Some(4), Some(ShadingArg::Shell)));
        assert_eq!((record.frames, record.fps, record.size), (Some(200), Some(20.0), Some([480, 360])));
        assert_eq!((record.warmup, changes.surfaces), (Some(1.5), SurfacesArg::Gpu));
    }

    #[test]
    fn limits_are_checked() {
        for bad in [
            "--size 15x720",
            "--size 960x8193",
            "--size 960",
            "--size 0x0",
            "--size -1x5",
            "--size 9999999999x9",
            "--frames 0",
            "--frames 100001",
            "--frames 1.5",
            "--fps 0",
            "--fps 1001",
            "--fps nan",
            "--warmup -1",
            "--warmup inf",
            "--layers 0",
            "--layers 33",
            "--shading flat",
            "--surfaces both",
            "--seed -1",
            "--unknown",
        ] {
            assert!(program(&format!("lucerna render candle {bad}")).is_err(), "{bad} was accepted");
        }
        for good in ["--size 16x8192", "--frames 100000", "--fps 1000", "--fps 23.976", "--warmup 0", "--layers 32"] {
            assert!(program(&format!("lucerna render candle {good}")).is_ok(), "{good} was refused");
        }
    }

    #[test]
    fn errors_fit_in_one_line() {
        for bad in
            ["lucerna render", "lucerna render x --size 1x1", "lucerna burn", "lucerna view a --screenshot b.png"]
        {
            let line = one_line(&program(bad).unwrap_err());
            assert!(line.starts_with("error: ") && !line.contains('\n') && !line.contains("Usage"), "{line}");
        }
    }

    #[test]
    fn recording_implies_headless() {
        let example = |line: &str| ExampleArgs::try_parse_from(line.split_whitespace()).unwrap().runs_headless();
        assert!(!example("candle"));
        assert!(!example("candle --seed 3 --size 640x480"));
        assert!(example("candle --headless"));
        assert!(example("candle --out a.png"));
        assert!(example("candle --report a.json"));
    }
}
