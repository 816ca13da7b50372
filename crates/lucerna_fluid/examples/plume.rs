//! A plume without burning: `cargo run --release -p lucerna_fluid --example plume` lets 10 kW rise
//! from a ball of 0.2 m, once with each answer of density to temperature, and prints the heat
//! balance and the speed and temperature along the axis beside the plume of `McCaffrey`.

use std::error::Error;

use lucerna_fluid::{Density, Fluid, Shape, Side, Sides, Source, Vec3};

const HEAT_KW: f32 = 10.0;
const CELLS: [usize; 3] = [24, 48, 24];
const CELL_M: f32 = 0.05;
const STEP_S: f32 = 0.01;

fn main() -> Result<(), Box<dyn Error>> {
    let size = CELL_M * Vec3::new(CELLS[0] as f32, CELLS[1] as f32, CELLS[2] as f32);
    for density in [Density::Boussinesq, Density::DensityRatio, Density::LowMach] {
        let mut air = Fluid::builder(CELLS)
            .size_m(size)
            .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
            .density(density)
            .smagorinsky(0.03)
            .build()?;
        // A little off the middle: the flow would stay mirror-symmetric otherwise.
        let foot = 0.5 * Vec3::new(size.x, 0.0, size.z) + Vec3::new(5.0e-4, 0.1, -3.0e-4);
        let ball = Shape::Sphere { centre: foot, radius_m: 0.1 };
        air.attach_source(Source { heat_kw: HEAT_KW, ..Source::new(ball) })?;
        let (mut left_kj, mut put_in_kj) = (0.0, 0.0);
        let mut means = [(0.0_f32, 0.0_f32); 5];
        let place = |at: usize| foot + (0.5 + 0.35 * at as f32) * Vec3::Y;
        for step in 0..800 {
            let report = air.step(STEP_S)?;
            left_kj += f64::from(report.carried_out_kw * STEP_S);
            put_in_kj += f64::from(HEAT_KW * STEP_S);
            if step >= 400 {
                for (at, (speed, kelvin)) in means.iter_mut().enumerate() {
                    *speed += air.velocity(place(at)).y / 400.0;
                    *kelvin += air.temperature(place(at)) / 400.0;
                }
            }
        }
        let found_kj = air.total_heat_kj();
        println!("{density:?}: {put_in_kj:.2} kJ put in, {found_kj:.2} kJ found, {left_kj:.2} kJ gone");
        println!("  height   speed, law    excess temperature, law");
        for (at, (speed, kelvin)) in means.into_iter().enumerate() {
            // B. J. McCaffrey, NBSIR 79-1910: flame, intermittent flame and plume.
            let height = 0.5 + 0.35 * at as f32;
            let scaled = height / HEAT_KW.powf(0.4);
            let (factor, power) = match scaled {
                ..0.08 => (6.8, 0.5),
                ..0.2 => (1.9, 0.0),
                _ => (1.1_f32, -1.0_f32 / 3.0),
            };
            let law_speed = factor * scaled.powf(power) * HEAT_KW.powf(0.2);
            let law_kelvin = 293.15 * (factor / (0.9 * 19.62_f32.sqrt())).powi(2) * scaled.powf(2.0 * power - 1.0);
            println!("  {height:.2} m   {speed:.2}, {law_speed:.2} m/s   {kelvin:.0}, {law_kelvin:.0} K");
        }
    }
    Ok(())
}
