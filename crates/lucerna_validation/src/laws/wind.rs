//! How far the wind bends a fire over.

use std::f64::consts::FRAC_PI_4;

use lucerna_fluid::{Fluid, GRAVITY_M_S2, Vec3};

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
    measures: "Angle from the vertical of the way from the middle of the burner to the tip of the flame: the farthest place \
               with gas 500 K above ambient half of the time, seen from the side. The wind blows along a floor without drag. \
               The law fits large pools; others for fires in wind differ from it by 20 degrees and more: A. Putnam's for gas \
               burners (Symp. (Int.) on Combustion 10, 1965), tan(tilt) = U / (2.24 sqrt(L)) with a flame L = 0.75 m long, is \
               told beside it.",
    short: None,
    long: "9 cells across, box of 2.4 x 1.5 x 1.3 m, 2 to 6 s each",
    burn,
};

const DIAMETER: f32 = 0.37;
const HEAT_KW: f32 = 34.4;
/// Gas hotter than this above ambient is flame, K.
const FLAME_K: f32 = 500.0;

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
    const CELL_M: f32 = DIAMETER / 9.0;
    const DT_S: f32 = 0.2 * CELL_M;
    let cells = [2.4_f32, 1.5, 1.3].map(|edge| (edge / CELL_M) as usize);
    let speeds = [0.0_f32, 0.3, 1.0, 2.0];
    let (mut tilts, mut rules) = (Vec::new(), Vec::new());
    for (at, wind_m_s) in speeds.into_iter().enumerate() {
        run.part(at, speeds.len());
        let plan = Plan {
            wind_m_s,
            at_m: vec![-0.6],
            ..Plan::new(PROPANE.radiating(0.28), HEAT_KW, Burner::Round { diameter: DIAMETER }, CELL_M, cells)
        };
        let mut fire = plan.light()?;
        let [start, end] = [2.0, 6.0].map(|time: f32| (time / DT_S) as usize);
        let (mut looks, mut times) = (0_u32, vec![0_u32; cells[0] * cells[1]]);
        let mut is_hot = vec![false; times.len()];
        run.steps(&mut fire.air, DT_S, end, |step, air, _| {
            if step < start || step % 4 != 0 {
                return;
            }
            is_hot.fill(false);
            for plane in air.temperatures().chunks_exact(is_hot.len()) {
                is_hot.iter_mut().zip(plane).for_each(|(is_hot, kelvin)| *is_hot |= *kelvin >= FLAME_K);
            }
            times.iter_mut().zip(&is_hot).for_each(|(times, is_hot)| *times += u32::from(*is_hot));
            looks += 1;
        })?;
        let tip = tip(&fire.air, fire.feet[0], |place| 2 * times[place] >= looks);
        let tilt = f64::from(tip.x.atan2(tip.y).to_degrees());
        let wind = f64::from(wind_m_s);
        let law = pool_degrees(wind);
        let figure = Figure::new(format!("tilt in {wind_m_s} m/s"), "°", law, tilt, Allowed::Difference(10.0));
        run.figure(figure.noted(format!("tip {:.2} m away, {:.2} m up", tip.x, tip.y)));
        tilts.push((wind, tilt));
        if wind_m_s > 0.0 {
            let what = format!("the same against Putnam, {wind_m_s} m/s");
            rules.push(Figure::new(what, "°", putnam_degrees(wind), tilt, Allowed::Difference(10.0)));
        }
    }
    rules.into_iter().for_each(|figure| run.figure(figure));
    let grows = tilts.windows(2).map(|pair| pair[1].1 - pair[0].1).fold(f64::INFINITY, f64::min);
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
            Series { name: "found".into(), mark: Mark::Points, points: tilts },
        ],
    });
    Ok(())
}

/// The way from the foot to the farthest place, seen along z, that `is_flame`.
fn tip(air: &Fluid, foot: Vec3, is_flame: impl Fn(usize) -> bool) -> Vec3 {
    let [nx, ny, _] = air.cells();
    let way = |place: usize| {
        let middle = Vec3::new((place % nx) as f32 + 0.5, (place / nx) as f32 + 0.5, 0.0) * air.cell_size_m();
        (air.origin() + middle - foot) * Vec3::new(1.0, 1.0, 0.0)
    };
    let ways = (0..nx * ny).filter(|place| is_flame(*place)).map(way);
    ways.max_by(|a, b| a.length().total_cmp(&b.length())).unwrap_or(Vec3::ZERO)
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
