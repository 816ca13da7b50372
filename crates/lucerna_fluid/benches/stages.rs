//! Time that each stage of a step takes, one thread: `cargo bench -p lucerna_fluid --bench stages`.

use lucerna_fluid::{Advection, Fluid, Side, Sides, StageTimes, Trace, Vec3};

fn main() {
    let is_quick = !std::env::args().any(|argument| argument == "--bench");
    println!("shortest time of each stage, ms; one thread; buoyant plume, dt = 1/60 s");
    println!(
        "{:>6} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9}",
        "cells", "advection", "forces", "pressure", "report", "step", "ns/cell"
    );
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    let schemes = [
        (Advection::SemiLagrangian, Trace::Euler),
        (Advection::SemiLagrangian, Trace::Midpoint),
        (Advection::MacCormack, Trace::Midpoint),
    ];
    for (advection, trace) in schemes {
        println!("{advection:?}, {trace:?}");
        for n in [15_usize, 32, 64] {
            let steps = if is_quick { 2 } else { (8_000_000 / (n * n * n)).clamp(30, 400) };
            let (times, step) = pool.install(|| run(n, steps, advection, trace));
            println!(
                "{n:>4}^3 {:>10.4} {:>10.4} {:>10.4} {:>10.4} {step:>10.4} {:>9.1}",
                times.advection_ms,
                times.forces_ms,
                times.pressure_ms,
                times.report_ms,
                1.0e6 * step / (n * n * n) as f32,
            );
        }
    }
}

/// Shortest time of each stage and of the sum, ms.
fn run(n: usize, steps: usize, advection: Advection, trace: Trace) -> (StageTimes, f32) {
    let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
    let mut fluid = Fluid::builder([n; 3]).sides(sides).advection(advection).trace(trace).build().expect("a small box");
    let most = f32::MAX;
    let mut best =
        StageTimes { advection_ms: most, forces_ms: most, viscosity_ms: most, pressure_ms: most, report_ms: most };
    let mut whole = most;
    for _ in 0..steps {
        fluid.add_heat(Vec3::new(0.5, 0.1, 0.5), 0.12, 2000.0).expect("finite heat");
        let times = fluid.step(1.0 / 60.0).expect("a valid step").times;
        let sum = times.advection_ms + times.forces_ms + times.viscosity_ms + times.pressure_ms + times.report_ms;
        whole = whole.min(sum);
        best.advection_ms = best.advection_ms.min(times.advection_ms);
        best.forces_ms = best.forces_ms.min(times.forces_ms);
        best.viscosity_ms = best.viscosity_ms.min(times.viscosity_ms);
        best.pressure_ms = best.pressure_ms.min(times.pressure_ms);
        best.report_ms = best.report_ms.min(times.report_ms);
    }
    (best, whole)
}
