//! How far the wind bends a fire over.

use std::f64::consts::FRAC_PI_4;

use lucerna_fluid::GRAVITY_M_S2;

use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::fire::{Burner, PROPANE, Plan};

pub(crate) const WIND: Experiment = Experiment {
    name: "wind",
    title: "34.4 kW of propane on 0.37 m in wind",
    law: "cos(tilt) = sqrt(u / U) where U > u, u^3 = g m D / rho",
    source: "American Gas Association, as given by K. S. Mudan, Thermal Radiation Hazards from Hydrocarbon Pool Fires, \
             Prog. Energy Combust. Sci. 10, 1984; m is the fuel by area, rho the density of its vapour",
    origin: Origin::Emergent,
    measures: "Angle from the vertical of the way from the burner to the middle of the burning gas, mean over time. The law \
               fits large pools; others for fires in wind differ from it by 20 degrees: A. Putnam's for gas burners \
               (Symp. (Int.) on Combustion 10, 1965), tan(tilt) = U / (2.24 sqrt(L)) with a flame L = 0.75 m long, is drawn \
               beside it.",
    short: None,
    long: "cells of 6.2 cm, box of 2.7 x 1.5 x 1.5 m, 3 to 7 s each",
    burn,
};

const DIAMETER: f32 = 0.37;
const HEAT_KW: f32 = 34.4;

/// Tilt of a pool fire in a wind of so many m/s, degrees from the vertical.
fn pool_degrees(wind_m_s: f64) -> f64 {
    let fuel_kg_s = f64::from(HEAT_KW / PROPANE.fuel.heat_kj_kg);
    let width_m = f64::from(DIAMETER);
    let flux_kg_m2_s = fuel_kg_s / (FRAC_PI_4 * width_m * width_m);
    let scale_m_s = (f64::from(GRAVITY_M_S2) * flux_kg_m2_s * width_m / f64::from(PROPANE.density_kg_m3)).cbrt();
    (scale_m_s / wind_m_s).min(1.0).sqrt().acos().to_degrees()
}

/// The same of a gas burner, after Putnam.
fn putnam_degrees(wind_m_s: f64) -> f64 {
    const LENGTH_M: f64 = 0.75;
    (wind_m_s / (2.24 * LENGTH_M.sqrt())).atan().to_degrees()
}

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    let cell_m = DIAMETER / 6.0;
    let dt_s = 0.01;
    let speeds = [0.0_f32, 0.3, 1.0, 2.0];
    let mut found = Vec::new();
    for (at, wind_m_s) in speeds.into_iter().enumerate() {
        run.part(at, speeds.len());
        let plan = Plan {
            wind_m_s,
            at_m: vec![-0.7],
            ..Plan::new(PROPANE.radiating(0.28), HEAT_KW, Burner::Round { diameter: DIAMETER }, cell_m, [44, 24, 24])
        };
        let mut fire = plan.light()?;
        let (foot, id) = (fire.feet[0], fire.fuel);
        // Fuel that warms the gas around it by another 100 K and more.
        let least = 100.5 / plan.gas.fuel.heat_kj_kg;
        let (mut along, mut up, mut count) = (0.0_f64, 0.0_f64, 0.0_f64);
        let [start, end] = [3.0, 7.0].map(|time: f32| (time / dt_s) as usize);
        run.steps(&mut fire.air, dt_s, end, |step, air, _| {
            if step < start || step % 4 != 0 {
                return;
            }
            let [nx, ny, _] = air.cells();
            for (cell, fuel) in air.scalar_values(id).enumerate() {
                if fuel >= least {
                    let x = (cell % nx) as f64 + 0.5;
                    let y = (cell / nx % ny) as f64 + 0.5;
                    along += x * f64::from(cell_m) + f64::from(air.origin().x - foot.x);
                    up += y * f64::from(cell_m);
                    count += 1.0;
                }
            }
        })?;
        let tilt = (along / count).atan2(up / count).to_degrees();
        let what = format!("tilt in {wind_m_s} m/s");
        run.figure(Figure::new(what, "°", pool_degrees(f64::from(wind_m_s)), tilt, Allowed::Difference(10.0)));
        found.push((f64::from(wind_m_s), tilt));
    }
    let grows = found.windows(2).map(|pair| pair[1].1 - pair[0].1).fold(f64::INFINITY, f64::min);
    let what = "least growth of the tilt from one wind to the next";
    run.figure(Figure::new(what, "°", 0.0, grows, Allowed::UpTo(90.0)));
    let law = |tilt: fn(f64) -> f64| (0..=80).map(|at| 0.025 * f64::from(at)).map(|wind| (wind, tilt(wind))).collect();
    run.chart(Chart {
        title: "Tilt of 34.4 kW".into(),
        x: Axis::linear("wind, m/s"),
        y: Axis::linear("from the vertical, degrees"),
        series: vec![
            Series { name: "pools (AGA)".into(), mark: Mark::Dashes, points: law(pool_degrees) },
            Series { name: "Putnam".into(), mark: Mark::Line, points: law(putnam_degrees) },
            Series { name: "found".into(), mark: Mark::Points, points: found },
        ],
    });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pools_stand_up_to_a_light_wind_and_bend_from_there() {
        for (wind_m_s, degrees) in [(0.0, 0.0), (0.2, 0.0), (0.3, 26.8), (1.0, 60.7), (2.0, 69.8)] {
            let found = pool_degrees(wind_m_s);
            println!("{wind_m_s} m/s: {found:.1} degrees, gas burners {:.1}", putnam_degrees(wind_m_s));
            assert!((found - degrees).abs() < 0.1, "{wind_m_s}: {found}");
        }
        // U = 2.24 sqrt(L) bends by 45 degrees.
        assert!((putnam_degrees(2.24 * 0.75_f64.sqrt()) - 45.0).abs() < 1.0e-9);
    }
}
