//! A folder to run the program in, and what it says there.

use serde_json::Value;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Longest that any run of these tests may take.
const PATIENCE: Duration = Duration::from_secs(60);
/// Longest that a refusal may take, a busy machine included.
const REFUSAL: Duration = Duration::from_secs(5);

/// An empty folder for one test, in which the program is run.
pub(crate) struct Place(pub(crate) PathBuf);

/// What a run of the program said.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    /// Lines on standard error, without those of graphics drivers.
    pub(crate) complaints: Vec<String>,
    pub(crate) took: Duration,
}

impl Place {
    pub(crate) fn new(test: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("command_line").join(test);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder for the test");
        Self(folder)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).expect("a file of the test");
    }

    /// Runs the program here with the words of a line.
    pub(crate) fn run(&self, line: &str) -> Run {
        self.run_with(line, &[])
    }

    /// As [`Place::run`], with variables of the environment.
    pub(crate) fn run_with(&self, line: &str, variables: &[(&str, &str)]) -> Run {
        let began = Instant::now();
        let pipe = |name| File::create(self.path(name)).expect("a file to write to");
        let mut child = Command::new(env!("CARGO_BIN_EXE_lucerna"))
            .args(line.split_whitespace())
            .current_dir(&self.0)
            .env("XDG_RUNTIME_DIR", &self.0)
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .envs(variables.iter().copied())
            .stdin(Stdio::null())
            .stdout(pipe(".out"))
            .stderr(pipe(".err"))
            .spawn()
            .expect("the program starts");
        let status = loop {
            if let Some(status) = child.try_wait().expect("the program runs") {
                break status;
            }
            if began.elapsed() > PATIENCE {
                child.kill().expect("the program can be stopped");
                panic!("`lucerna {line}` takes longer than {PATIENCE:?}");
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        let text = |name| String::from_utf8_lossy(&fs::read(self.path(name)).expect("what was written")).into_owned();
        let complaints = text(".err").lines().filter(|line| !is_of_a_driver(line)).map(str::to_owned).collect();
        Run { code: status.code(), out: text(".out"), complaints, took: began.elapsed() }
    }

    /// Runs the program, which must do what it was asked.
    #[track_caller]
    pub(crate) fn succeed(&self, line: &str) -> String {
        let run = self.run(line);
        // A slow machine is told how far a run is.
        let is_progress = |line: &String| line.starts_with("warming up ") || line.starts_with("frame ");
        assert!(run.code == Some(0) && run.complaints.iter().all(is_progress), "`lucerna {line}`: {run:?}");
        run.out
    }

    /// Runs the program, which must refuse in one line with all of `parts` in it.
    #[track_caller]
    pub(crate) fn refuse(&self, line: &str, parts: &[&str]) {
        let run = self.run(line);
        assert_eq!((run.code, run.out.as_str()), (Some(2), ""), "`lucerna {line}`: {run:?}");
        let [complaint] = run.complaints.as_slice() else {
            panic!("`lucerna {line}` must say one line: {:?}", run.complaints);
        };
        assert!(complaint.starts_with("error: "), "`lucerna {line}`: {complaint}");
        assert!(!complaint.contains("panicked"), "`lucerna {line}`: {complaint}");
        for part in parts {
            assert!(complaint.contains(part), "`lucerna {line}`: `{part}` is not in: {complaint}");
        }
        assert!(run.took < REFUSAL, "`lucerna {line}` took {:?}", run.took);
    }

    /// The report of a run that was asked for `--report report.json`.
    pub(crate) fn report(&self) -> Value {
        let text = fs::read_to_string(self.path("report.json")).expect("a report");
        serde_json::from_str(&text).expect("JSON")
    }

    /// Writes `scene.ron`: one wick in a small box of air, with a part of its text replaced.
    pub(crate) fn write_scene(&self, replaced: &str, by: &str) {
        assert!(SCENE.contains(replaced), "{replaced} is not in the scene");
        self.write("scene.ron", SCENE.replacen(replaced, by, 1));
    }
}

/// Drivers and loaders write to standard error what the program has no part in.
fn is_of_a_driver(line: &str) -> bool {
    let of_a_driver =
        ["MESA", "libEGL", "libGL", "WARNING: lavapipe", "DRI", "pci id for fd", "error: XDG_RUNTIME_DIR"];
    of_a_driver.iter().any(|start| line.starts_with(start))
}

/// What [`Place::write_scene`] starts from.
const SCENE: &str = r#"(
    name: "Test",
    seed: 4,
    camera: (eye: (0.0, 0.03, 0.3), target: (0.0, 0.03, 0.0), fov_y_deg: 25.0),
    air: (
        origin_m: (-0.1, -0.1, -0.1),
        size_m: (0.2, 0.3, 0.2),
        cells: (8, 12, 8),
    ),
    fires: [
        (
            wicks: [polyline(points: [(-0.02, 0.0, 0.0), (0.02, 0.0, 0.0)], radius_m: 0.002)],
            skeletons: (slices: 2),
        ),
    ],
)
"#;
/// Its wick.
pub(crate) const POLYLINE: &str = "polyline(points: [(-0.02, 0.0, 0.0), (0.02, 0.0, 0.0)], radius_m: 0.002)";

/// A picture that takes no time.
pub(crate) const SMALL: &str = "--size 48x32 --warmup 0.1";
