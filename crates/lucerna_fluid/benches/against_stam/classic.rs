//! The classic solver in C, compiled when the benchmark starts.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What the C program does in a step; its first argument.
#[derive(Clone, Copy)]
pub(crate) enum Mode {
    /// Diffusion of all fields, two projections, sweeps in the order of the cells.
    Full = 0,
    /// The same with red-black sweeps.
    RedBlack = 1,
    /// One projection of red-black sweeps, no diffusion, one trace.
    Lean = 2,
    /// As `Full` with each cell's neighbours summed in Stam's order.
    AsPrinted = 3,
}

/// One compilation of `stam3d.c`.
pub(crate) struct Classic(PathBuf);

impl Classic {
    /// Compiles the program next to cargo's other output; none without a compiler as `cc`.
    pub(crate) fn compile(name: &str, flags: &[&str]) -> Option<Self> {
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/stam3d.c");
        let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let status = Command::new("cc").args(flags).arg("-o").arg(&program).arg(&source).arg("-lm").status();
        status.is_ok_and(|status| status.success()).then_some(Self(program))
    }

    /// Shortest of `steps` steps with `n` cells an axis, ms.
    pub(crate) fn run(&self, mode: Mode, n: usize, steps: usize) -> Option<f64> {
        let arguments = [mode as usize, n, steps].map(|argument| argument.to_string());
        let output = Command::new(&self.0).args(arguments).output().ok()?;
        String::from_utf8(output.stdout).ok()?.split_whitespace().next()?.parse().ok()
    }
}
