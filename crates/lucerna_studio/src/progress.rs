//! Progress of long runs, on standard error.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// A run shorter than this shows nothing.
const PATIENCE: Duration = Duration::from_secs(2);
/// Distance of the lines that stand for the bar where standard error is not a terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// Shows how far a run is once it has taken two seconds: a bar on a terminal, else a line now and then.
#[derive(Debug)]
pub struct Progress {
    what: &'static str,
    total: u64,
    started: Instant,
    last_line: Option<Instant>,
    terminal: bool,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Begins to watch a run of `total` parts.
    #[must_use]
    pub fn new(what: &'static str, total: u64) -> Self {
        let terminal = std::io::stderr().is_terminal();
        Self { what, total, started: Instant::now(), last_line: None, terminal, bar: None }
    }

    /// Says that `done` parts are done.
    pub fn set(&mut self, done: u64) {
        if self.started.elapsed() < PATIENCE {
            return;
        }
        if self.terminal {
            self.bar.get_or_insert_with(|| new_bar(self.what, self.total)).set_position(done);
        } else if self.last_line.is_none_or(|line| line.elapsed() >= LINE_EVERY) {
            self.last_line = Some(Instant::now());
            say(&format!("{} {done} of {}", self.what, self.total));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn new_bar(what: &'static str, total: u64) -> ProgressBar {
    let bar = ProgressBar::new(total);
    if let Ok(style) = ProgressStyle::with_template("{prefix} {wide_bar} {pos}/{len}, {eta} left") {
        bar.set_style(style);
    }
    bar.set_prefix(what);
    bar
}

/// Writes a line to standard error; a closed one is no reason to stop.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
