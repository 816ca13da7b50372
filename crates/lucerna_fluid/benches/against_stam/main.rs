//! Time of a step against the classic solver in C and against what the machine can do, in one
//! run: `cargo bench -p lucerna_fluid`, with sizes of one's own after `--` (`-- 32 128`). Needs a
//! C compiler as `cc` for the comparison; without, it times this crate's solver alone.
//!
//! All take turns, so that a busy moment of the machine does not decide; each figure is the
//! shortest step of all turns.

mod bounds;
mod classic;
mod machine;
mod ours;

use classic::{Classic, Mode};
use machine::{Machine, triad};
use ours::{Fastest, VARIANTS};

/// Compilations of the C program: its name, flags.
const COMPILATIONS: [(&str, &[&str]); 2] = [("-O3", &["-O3"]), ("-O3 -march=native", &["-O3", "-march=native"])];
const MODES: [(&str, Mode); 4] = [
    ("C, full step", Mode::Full),
    ("C, full, Stam's order of sums", Mode::AsPrinted),
    ("C, full, red-black", Mode::RedBlack),
    ("C, lean, red-black", Mode::Lean),
];

/// Arrays of one value a cell that a step works on, for the size of the triad's arrays.
const ARRAYS: usize = 14;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    // `cargo test --benches` only asks whether it runs.
    let is_quick = !arguments.iter().any(|argument| argument == "--bench");
    let asked: Vec<usize> = arguments.iter().skip(1).filter_map(|argument| argument.parse().ok()).collect();
    let sizes = match (is_quick, asked.is_empty()) {
        (true, _) => vec![8],
        (_, true) => vec![15, 16, 32, 64],
        (_, false) => asked,
    };
    let programs: Vec<(&str, Classic)> = COMPILATIONS
        .into_iter()
        .enumerate()
        .filter_map(|(at, (name, flags))| Some((name, Classic::compile(&format!("stam3d_{at}"), flags)?)))
        .collect();
    if programs.is_empty() {
        println!("no C compiler: ours only");
    }
    let machine = Machine::measure(if is_quick { 1_000 } else { 20_000_000 });
    println!("one core: {:.0} Gflop/s fused, {:.0} apart", machine.fused, machine.apart);
    if !is_quick {
        for mib in [1, 8, 16, 256] {
            println!("triad over {mib} MiB: {:.0} GB/s", triad(mib << 20));
        }
    }
    for n in sizes {
        compare(n, is_quick, &programs, &machine);
    }
    let (boxes, steps) = if is_quick { (8, 1) } else { (1000, 30) };
    println!("\n{boxes} boxes of 15^3 in a batch, steps of a box per ms and thread: on one thread, on two");
    for variant in VARIANTS {
        let [one, two] = [1, 2].map(|threads| ours::run_batch(boxes, steps, threads, variant.set));
        println!("  {:<32} {one:>9.2} {two:>9.2}", variant.name);
    }
}

/// Prints the tables of one size.
fn compare(n: usize, is_quick: bool, programs: &[(&str, Classic)], machine: &Machine) {
    let cells = n * n * n;
    let turns = if is_quick { 1 } else { 5 };
    let steps = if is_quick { 2 } else { (4_000_000 / cells).clamp(8, 100) };
    let c_steps = if is_quick { 2 } else { (500_000 / cells).clamp(3, 100) };
    let mut classic = vec![[f64::MAX; MODES.len()]; programs.len()];
    let mut ours = vec![[Fastest::NONE; 2]; VARIANTS.len()];
    for _ in 0..turns {
        for ((_, program), best) in programs.iter().zip(&mut classic) {
            for ((_, mode), best) in MODES.into_iter().zip(best) {
                *best = best.min(program.run(mode, n, c_steps).unwrap_or(f64::MAX));
            }
        }
        for (variant, best) in VARIANTS.iter().zip(&mut ours) {
            for (threads, best) in [1, 2].into_iter().zip(best) {
                *best = best.or(ours::run(n, steps, threads, variant.set));
            }
        }
    }
    println!("\n{n}^3 cells, ms a step, one thread, dt = 1/60 s, {turns} turns");
    for ((flags, _), times) in programs.iter().zip(&classic) {
        for ((name, _), ms) in MODES.into_iter().zip(times) {
            println!("  {name:<32} {ms:>9.4}   {flags}");
        }
    }
    // Times of C over ours: with `-O3`, and with the machine's own instructions too.
    let ratio = |mode: Mode, ms: f64| {
        let at = MODES.into_iter().position(|(_, other)| other as usize == mode as usize).unwrap_or(0);
        let ratios: Vec<String> = classic.iter().map(|times| format!("{:.1}", times[at] / ms)).collect();
        if ratios.is_empty() { "-".to_owned() } else { ratios.join(" / ") }
    };
    println!(
        "  {:<32} {:>9} {:>9} {:>15} {:>15} {:>15} {:>8} {:>8} {:>8} {:>8}",
        "ours", "1 thread", "2 threads", "C, Stam's order", "C, full", "C, lean", "ns/cell", "memory", "flops", "share"
    );
    let gb_s = triad(4 * ARRAYS * cells);
    for (variant, [one, two]) in VARIANTS.iter().zip(&ours) {
        let ns = one.ms * 1.0e6 / cells as f64;
        let (memory, arithmetic) = (variant.counts)(n).bounds_ns(gb_s, machine.fused);
        println!(
            "  {:<32} {:>9.4} {:>9.4} {:>15} {:>15} {:>15} {ns:>8.2} {memory:>8.2} {arithmetic:>8.2} {:>7.0}%",
            variant.name,
            one.ms,
            two.ms,
            ratio(Mode::AsPrinted, one.ms),
            ratio(Mode::Full, one.ms),
            ratio(Mode::Lean, one.ms),
            100.0 * memory.max(arithmetic) / ns,
        );
    }
    println!("  stages, ms: advection, forces, viscosity, pressure, report; divergence left");
    for (variant, [one, _]) in VARIANTS.iter().zip(&ours) {
        let times = one.times;
        println!(
            "  {:<32} {:>9.4} {:>9.4} {:>9.4} {:>9.4} {:>9.4} {:>9.1e}",
            variant.name,
            times.advection_ms,
            times.forces_ms,
            times.viscosity_ms,
            times.pressure_ms,
            times.report_ms,
            one.divergence
        );
    }
    println!("  memory at this size: {gb_s:.0} GB/s");
}
