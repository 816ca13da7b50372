//! Four hundred flames, each in a box of its own, without any drawing:
//! `cargo run --release -p lucerna_fluid --example hundreds_of_flames`.

use std::{error::Error, time::Instant};

use lucerna_fluid::{Fluid, FluidBatch, Side, Sides, Vec3};

const FLAMES: usize = 400;
const STEPS: usize = 120;
const DT_S: f32 = 1.0 / 60.0;

fn main() -> Result<(), Box<dyn Error>> {
    let flame = Fluid::builder([15; 3])
        .size_m(Vec3::splat(0.3))
        .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
        .vorticity_confinement(2.0)
        .cooling_per_s(1.5);
    // Candles along a street, in a wind that falls off towards its end.
    let place = |at: usize| Vec3::new((at % 20) as f32, 0.0, (at / 20) as f32);
    let boxes = (0..FLAMES).map(|at| {
        let wind = Vec3::X * 0.3 * (1.0 - at as f32 / FLAMES as f32);
        flame.clone().origin(place(at)).wind(wind)
    });
    let mut batch = FluidBatch::new(boxes)?;

    let start = Instant::now();
    for step in 0..STEPS {
        batch.for_each(|at, fluid| {
            // Each flickers in its own time.
            let kelvin_per_s = 4000.0 + 2500.0 * (0.37 * step as f32 + at as f32).sin();
            let wick = fluid.origin() + Vec3::new(0.15, 0.03, 0.15);
            fluid.add_heat(wick, 0.04, kelvin_per_s).expect("finite heat");
        });
        batch.step(DT_S)?;
    }
    let ms = start.elapsed().as_secs_f64() * 1.0e3;

    let threads = rayon::current_num_threads();
    let per_ms = (FLAMES * STEPS) as f64 / ms;
    println!("{FLAMES} flames of 15^3 cells, {STEPS} steps on {threads} threads in {ms:.0} ms");
    println!("{per_ms:.1} box-steps per ms, {:.1} per ms and thread", per_ms / threads as f64);
    for at in [0, FLAMES / 2, FLAMES - 1] {
        let (fluid, report) = (&batch[at], &batch.reports()[at]);
        let above = fluid.velocity(fluid.origin() + Vec3::new(0.15, 0.2, 0.15));
        println!(
            "flame {at:>3}: {:.0} K above ambient at most, {above:.2} m/s above the wick",
            report.max_temperature_k
        );
    }
    Ok(())
}
