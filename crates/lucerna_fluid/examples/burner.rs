//! A gas burner against the laws of fire: `cargo run --release -p lucerna_fluid --example burner`
//! burns 30 kW of propane on a plate of 0.3 m and prints flame height, puffing, and the way in
//! which the plume cools.

use std::{error::Error, f32::consts::PI};

use lucerna_fluid::{Combustion, Density, Fluid, Fuel, ScalarSource, Shape, Side, Sides, Source, Vec3};

const HEAT_KW: f32 = 30.0;
const PLATE_M: f32 = 0.3;
const CELL_M: f32 = 0.0375;
const CELLS: [usize; 3] = [24, 48, 24];
const STEP_S: f32 = 0.0075;

fn main() -> Result<(), Box<dyn Error>> {
    let size = CELL_M * Vec3::new(CELLS[0] as f32, CELLS[1] as f32, CELLS[2] as f32);
    let mut air = Fluid::builder(CELLS)
        .size_m(size)
        .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
        .density(Density::LowMach)
        .smagorinsky(0.06)
        .combustion(Combustion::new(Fuel::PROPANE))
        .build()?;
    let Some(fuel) = air.scalar_id("fuel") else { return Err("no fuel".into()) };
    // A little off the middle, as nature is: the flow would stay mirror-symmetric otherwise.
    let middle = 0.5 * Vec3::new(size.x, 0.0, size.z) + Vec3::new(5.0e-4, 0.0, -3.0e-4);
    let reach = 0.5 * PLATE_M * Vec3::new(1.0, 0.0, 1.0);
    let kg_s = HEAT_KW / Fuel::PROPANE.heat_kj_kg;
    air.attach_source(Source {
        inflow_m3_s: kg_s / 1.84,
        scalars: vec![ScalarSource { kg_s, ..ScalarSource::new(fuel) }],
        ..Source::new(Shape::Box { low: middle - reach, high: middle + reach + CELL_M * Vec3::Y })
    })?;

    let mut axis_k = vec![0.0_f32; CELLS[1]];
    let mut speeds = Vec::new();
    for step in 0..1200 {
        let report = air.step(STEP_S)?;
        if step % 200 == 199 {
            let fire = report.combustion;
            println!(
                "{:.1} s: {:.1} kW burn, {:.1} kW radiate, {:.1} kW leave, up to {:.0} K and {:.1} m/s",
                STEP_S * (step + 1) as f32,
                fire.heat_release_kw,
                fire.radiated_kw,
                report.carried_out_kw,
                report.max_temperature_k,
                report.max_speed_m_s
            );
        }
        if step >= 400 {
            for (j, kelvin) in axis_k.iter_mut().enumerate() {
                *kelvin += air.temperature(middle + (j as f32 + 0.5) * CELL_M * Vec3::Y) / 800.0;
            }
            speeds.push(air.velocity(middle + 0.75 * PLATE_M * Vec3::Y).y);
        }
    }

    let width = PLATE_M * (4.0 / PI).sqrt();
    let height = axis_k.iter().rposition(|kelvin| *kelvin > 500.0).map_or(0.0, |j| (j + 1) as f32 * CELL_M);
    println!("flame height (500 K): {height:.2} m; Heskestad: {:.2} m", 0.235 * HEAT_KW.powf(0.4) - 1.02 * width);
    println!("puffing: {:.2} Hz; 1.5 / sqrt(D): {:.2} Hz", strongest_hz(&speeds), 1.5 / width.sqrt());
    let origin = 0.083 * HEAT_KW.powf(0.4) - 1.02 * width;
    let cool = |j: usize| ((j as f32 + 0.5) * CELL_M - origin, axis_k[j]);
    let ((low, warm), (high, cooler)) = (cool(28), cool(44));
    println!("temperature falls as height to the power {:.2}; law: -1.67", (cooler / warm).ln() / (high / low).ln());
    Ok(())
}

/// The frequency from 0.5 to 10 Hz at which the values swing most, under a raised cosine.
fn strongest_hz(values: &[f32]) -> f32 {
    let mean = values.iter().sum::<f32>() / values.len() as f32;
    let power = |hz: f32| {
        let (mut along, mut across) = (0.0, 0.0);
        for (at, value) in values.iter().enumerate() {
            let window = 1.0 - (2.0 * PI * at as f32 / values.len() as f32).cos();
            let (sin, cos) = (2.0 * PI * hz * STEP_S * at as f32).sin_cos();
            along += window * (value - mean) * cos;
            across += window * (value - mean) * sin;
        }
        along * along + across * across
    };
    (10..200).map(|at| 0.05 * at as f32).max_by(|a, b| power(*a).total_cmp(&power(*b))).unwrap_or(0.0)
}
