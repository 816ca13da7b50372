//! How many small boxes are stepped in a millisecond: `cargo bench -p lucerna_fluid --bench batch`.

use std::time::Instant;

use lucerna_fluid::{Advection, Fluid, FluidBatch, FluidBuilder, ScalarAdvection, Side, Sides, Trace, Vec3};

fn main() {
    // `cargo test --benches` only asks whether it runs.
    let is_quick = !std::env::args().any(|argument| argument == "--bench");
    let counts: &[usize] = if is_quick { &[8] } else { &[1, 100, 400, 1000] };
    println!("boxes of 15^3 with a plume, dt = 1/60 s; box-steps per ms");
    println!(
        "{:>6} {:>12} {:>12} {:>12} {:>18}",
        "boxes", "one thread", "two threads", "two / one", "plainest schemes"
    );
    for &count in counts {
        let turns = if is_quick { 1 } else { (2000 / count).max(3) };
        let usual = flame();
        let plain = flame().advection(Advection::SemiLagrangian).scalar_advection(ScalarAdvection::SemiLagrangian);
        let one = on_threads(1, || run(&usual, count, turns));
        let two = on_threads(2, || run(&usual, count, turns));
        let plain = on_threads(1, || run(&plain.trace(Trace::Euler), count, turns));
        println!("{count:>6} {one:>12.2} {two:>12.2} {:>12.2} {plain:>18.2}", two / one);
    }
}

/// A flame's box, with what a builder chooses by itself.
fn flame() -> FluidBuilder {
    Fluid::builder([15; 3]).size_m(Vec3::splat(0.3)).sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
}

/// The most box-steps per ms in any turn.
fn run(flame: &FluidBuilder, count: usize, turns: usize) -> f64 {
    let builders = (0..count).map(|index| flame.clone().wind(0.001 * index as f32 * Vec3::X));
    let mut batch = FluidBatch::new(builders).expect("small boxes");
    let mut best = 0.0_f64;
    for _ in 0..turns {
        for fluid in &mut batch {
            fluid.add_heat(Vec3::new(0.15, 0.03, 0.15), 0.04, 3000.0).expect("finite heat");
        }
        let (start, busy) = (Instant::now(), busy_ms());
        batch.step(1.0 / 60.0).expect("a valid step");
        let wall = start.elapsed().as_secs_f64() * 1.0e3;
        // On one thread, others that use the machine do not count.
        let is_alone = rayon::current_num_threads() == 1 && count >= 100;
        let ms = busy.zip(busy_ms()).filter(|_| is_alone).map_or(wall, |(before, after)| after - before);
        best = best.max(count as f64 / ms);
    }
    best
}

/// Time that this thread has been running, ms; Linux only.
fn busy_ms() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? * 1.0e-6)
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(work)
}
