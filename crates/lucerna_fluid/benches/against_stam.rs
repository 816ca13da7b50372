//! Time of a step against the classic solver in C, on this machine, in one run:
//! `cargo bench -p lucerna_fluid`. Needs a C compiler as `cc` for the comparison.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use lucerna_fluid::{Fluid, PressureSolver, Side, Sides, StepReport, Vec3};

fn main() {
    // `cargo test --benches` only asks whether it runs.
    let is_quick = !std::env::args().any(|argument| argument == "--bench");
    let sizes: &[usize] = if is_quick { &[15] } else { &[15, 32, 64] };
    let program = compile();
    println!("shortest step, ms; one thread unless said; buoyant plume, dt = 1/60 s");
    println!(
        "{:>6} {:>12} {:>12} {:>12} {:>12} {:>9} {:>12}",
        "cells", "C, 20 sweeps", "20 sweeps", "direct", "all threads", "C/direct", "divergence"
    );
    for &n in sizes {
        // Each gets a few turns, so that a busy moment does not decide.
        let steps = if is_quick { 5 } else { (2_000_000 / (n * n * n)).clamp(10, 200) };
        let (mut c, mut sweeps, mut direct, mut shared) = (f64::MAX, f64::MAX, f64::MAX, f64::MAX);
        let mut report = StepReport::default();
        for _ in 0..if is_quick { 1 } else { 3 } {
            if let Some(program) = program.as_deref().filter(|_| n <= 32) {
                c = c.min(run_c(program, n, steps).unwrap_or(f64::MAX));
            }
            sweeps = sweeps.min(on_one_thread(|| run(n, steps, PressureSolver::GaussSeidel { sweeps: 20 })).0);
            let (ms, last) = on_one_thread(|| run(n, steps, PressureSolver::Direct));
            (direct, report) = (direct.min(ms), last);
            shared = shared.min(run(n, steps, PressureSolver::Direct).0);
        }
        let c_text = if c < f64::MAX { format!("{c:.3}") } else { "-".into() };
        let ratio = if c < f64::MAX { format!("{:.1}", c / direct) } else { "-".into() };
        let divergence = report.divergence_after;
        println!("{n:>4}^3 {c_text:>12} {sweeps:>12.3} {direct:>12.3} {shared:>12.3} {ratio:>9} {divergence:>12.1e}");
    }
}

/// Shortest step of a plume, ms, and the last report.
fn run(n: usize, steps: usize, pressure: PressureSolver) -> (f64, StepReport) {
    let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
    let mut fluid = Fluid::builder([n; 3]).sides(sides).pressure(pressure).build().expect("a small box");
    let mut best = f64::MAX;
    let mut report = StepReport::default();
    for _ in 0..steps {
        fluid.add_heat(Vec3::new(0.5, 0.1, 0.5), 0.12, 2000.0).expect("finite heat");
        let start = Instant::now();
        report = fluid.step(1.0 / 60.0).expect("a valid step");
        best = best.min(start.elapsed().as_secs_f64() * 1.0e3);
    }
    (best, report)
}

/// Runs with a pool of a single thread.
fn on_one_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    pool.install(work)
}

/// Compiles the C program next to cargo's other output; none without a compiler.
fn compile() -> Option<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/stam3d.c");
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("stam3d");
    let status = Command::new("cc").args(["-O3", "-o"]).arg(&program).arg(&source).arg("-lm").status();
    if status.is_ok_and(|status| status.success()) {
        Some(program)
    } else {
        println!("no C compiler: ours only");
        None
    }
}

/// Shortest step of the C program, ms.
fn run_c(program: &Path, n: usize, steps: usize) -> Option<f64> {
    let output = Command::new(program).args([n.to_string(), steps.to_string()]).output().ok()?;
    String::from_utf8(output.stdout).ok()?.split_whitespace().next()?.parse().ok()
}
