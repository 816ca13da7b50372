//! The fire of B. `McCaffrey`, NBSIR 79-1910: 14.4 kW of gas on a square of 0.3 m. On the axis the
//! air rises at `1.9 Q^0.2` in the middle, and above that slows as `z^(-1/3)` and cools as `z^(-5/3)`.

use lucerna_fluid::{Combustion, Density, Fluid, Fuel, ScalarSource, Shape, Side, Sides, Source, Vec3};

use crate::signal::exponent;
use crate::{Off, Outcome, Row};

const HEAT_KW: f32 = 14.4;
const PLATE_M: f32 = 0.3;
const CELL_M: f32 = 0.05;
const CELLS: [usize; 3] = [24, 42, 24];
const STEP_S: f32 = 0.008;
const STEPS: [usize; 2] = [1000, 3000];
/// Where the law's parts lie: height over `Q^0.4`, m/kW^0.4.
const MIDDLE: [f64; 2] = [0.08, 0.2];
const PLUME: [f64; 2] = [0.2, 0.5];

/// Means on the axis against the law.
pub(crate) fn run(rows: &mut Vec<Row>) -> Outcome<()> {
    // The radiated share that he measured.
    let fuel = Fuel { radiated: 0.17, ..Fuel::METHANE };
    let size = CELL_M * Vec3::from_array(CELLS.map(|cells| cells as f32));
    let mut air = Fluid::builder(CELLS)
        .size_m(size)
        .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
        .density(Density::LowMach)
        .smagorinsky(0.1)
        .combustion(Combustion::new(fuel))
        .build()?;
    let foot = 0.5 * Vec3::new(size.x, 0.0, size.z) + CELL_M * Vec3::new(0.5, 0.0, -0.27);
    let reach = 0.5 * PLATE_M * Vec3::new(1.0, 0.0, 1.0);
    let kg_s = HEAT_KW / fuel.heat_kj_kg;
    let scalar = air.scalar_id("fuel").ok_or("no fuel")?;
    air.attach_source(Source {
        inflow_m3_s: kg_s / 0.667,
        scalars: vec![ScalarSource { kg_s, ..ScalarSource::new(scalar) }],
        ..Source::new(Shape::Box { low: foot - reach, high: foot + reach + CELL_M * Vec3::Y })
    })?;
    let mut sums = vec![(0.0_f64, 0.0_f64); CELLS[1]];
    let height_m = |j: usize| (j as f32 + 0.5) * CELL_M;
    for step in 0..STEPS[1] {
        air.step(STEP_S)?;
        if step >= STEPS[0] {
            for (j, sum) in sums.iter_mut().enumerate() {
                let point = foot + height_m(j) * Vec3::Y;
                sum.0 += f64::from(air.velocity(point).y);
                sum.1 += f64::from(air.temperature(point));
            }
        }
    }
    let (count, scale) = ((STEPS[1] - STEPS[0]) as f64, f64::from(HEAT_KW).powf(0.4));
    let part = |[low, high]: [f64; 2], of: fn(&(f64, f64)) -> f64| -> Vec<(f64, f64)> {
        let means = sums.iter().enumerate().map(|(j, sum)| (f64::from(height_m(j)), of(sum) / count));
        means.filter(|(z, _)| (low..high).contains(&(z / scale))).collect()
    };
    let middle = part(MIDDLE, |sum| sum.0);
    let speed = middle.iter().map(|(_, speed)| speed).sum::<f64>() / middle.len() as f64;
    let mut add = |law: &str, published: f64, found: f64, allowed: Off| {
        rows.push(Row { law: law.into(), published, found, allowed, note: String::new() });
    };
    add("McCaffrey's speed in the middle of 14.4 kW, m/s", 1.9 * scale.sqrt(), speed, Off::Percent(15.0));
    let slowing = exponent(&part(PLUME, |sum| sum.0));
    add("exponent of the speed by height above it", -1.0 / 3.0, slowing, Off::Difference(0.1));
    let cooling = exponent(&part(PLUME, |sum| sum.1));
    add("exponent of the temperature by height above it", -5.0 / 3.0, cooling, Off::Difference(0.1));
    Ok(())
}
