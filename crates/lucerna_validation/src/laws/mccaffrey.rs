//! Speed and temperature on the axis of a gas fire, from the flame into the plume.

use lucerna_fluid::Vec3;

use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::fire::{Burner, METHANE, Plan};
use crate::signal::exponent;

pub(crate) const MCCAFFREY: Experiment = Experiment {
    name: "mccaffrey",
    title: "McCaffrey's fire: 14.4 kW of gas on a square of 0.3 m",
    law: "speed 1.9 Q^0.2 in the middle; above it speed as z^(-1/3), temperature as z^(-5/3)",
    source: "B. J. McCaffrey, Purely Buoyant Diffusion Flames: Some Experimental Results, NBSIR 79-1910, 1979",
    origin: Origin::Emergent,
    measures: "Means on the axis; the middle is z / Q^0.4 from 0.08 to 0.2, the plume from 0.2 to 0.5. The radiated share \
               is his, 0.17 (Western States Section of the Combustion Institute, paper 81-15, 1981).",
    short: None,
    long: "cells of 2.5 cm, box of 1.2 x 2.1 x 1.2 m, 4 to 16 s",
    burn,
};

const HEAT_KW: f32 = 14.4;
const TIMES_S: [f32; 2] = [4.0, 16.0];
/// Where the law's parts lie: height over `Q^0.4`, m/kW^0.4.
const MIDDLE: [f64; 2] = [0.08, 0.2];
const PLUME: [f64; 2] = [0.2, 0.5];

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    let (cell_m, dt_s) = (0.025, 0.005);
    let cells = [1.2_f32, 2.1, 1.2].map(|edge| (edge / cell_m).round() as usize);
    let plan = Plan::new(METHANE.radiating(0.17), HEAT_KW, Burner::Square { edge: 0.3 }, cell_m, cells);
    let mut fire = plan.light()?;
    let foot = fire.feet[0];
    let mut sums = vec![(0.0_f64, 0.0_f64); cells[1]];
    let height_m = |j: usize| (j as f32 + 0.5) * cell_m;
    let [start, end] = TIMES_S.map(|time| (time / dt_s) as usize);
    run.steps(&mut fire.air, dt_s, end, |step, air, _| {
        if step >= start {
            for (j, sum) in sums.iter_mut().enumerate() {
                let point = foot + height_m(j) * Vec3::Y;
                sum.0 += f64::from(air.velocity(point).y);
                sum.1 += f64::from(air.temperature(point));
            }
        }
    })?;
    let (count, scale) = ((end - start) as f64, f64::from(HEAT_KW).powf(0.4));
    let part = |[low, high]: [f64; 2], of: fn(&(f64, f64)) -> f64| -> Vec<(f64, f64)> {
        let means = sums.iter().enumerate().map(|(j, sum)| (f64::from(height_m(j)) / scale, of(sum) / count));
        means.filter(|(z, _)| (low..high).contains(z)).collect()
    };
    let middle = part(MIDDLE, |sum| sum.0);
    let speed = middle.iter().map(|(_, speed)| speed).sum::<f64>() / middle.len() as f64;
    let slowing = exponent(&part(PLUME, |sum| sum.0));
    let cooling = exponent(&part(PLUME, |sum| sum.1));
    run.figure(Figure::new("speed in the middle", "m/s", 1.9 * scale.sqrt(), speed, Allowed::Percent(15.0)));
    run.figure(Figure::new("exponent of the speed in the plume", "", -1.0 / 3.0, slowing, Allowed::Difference(0.1)));
    run.figure(Figure::new("exponent of the temperature", "", -5.0 / 3.0, cooling, Allowed::Difference(0.1)));
    let heights = || (0..=40).map(|at| 0.02 * 30.0_f64.powf(f64::from(at) / 40.0));
    let law = |of: &dyn Fn(f64, f64, f64) -> f64| {
        heights()
            .map(|z| {
                let (k, power) = match z {
                    ..0.08 => (6.8, 0.5),
                    ..0.2 => (1.9, 0.0),
                    _ => (1.1, -1.0 / 3.0),
                };
                (z, of(z, k, power))
            })
            .collect()
    };
    let speeds = law(&|z, k, power| k * z.powf(power) * scale.sqrt());
    let kelvins = law(&|z, k, power| 293.15 * (k / (0.9 * 19.62_f64.sqrt())).powi(2) * z.powf(2.0 * power - 1.0));
    for (title, label, law, of) in [
        ("Mean speed on the axis", "m/s", speeds, (|sum| sum.0) as fn(&(f64, f64)) -> f64),
        ("Mean temperature on the axis", "above ambient, K", kelvins, |sum| sum.1),
    ] {
        run.chart(Chart {
            title: title.into(),
            x: Axis::log("z / Q^0.4, m/kW^0.4"),
            y: Axis::log(label),
            series: vec![
                Series { name: "McCaffrey".into(), mark: Mark::Dashes, points: law },
                Series { name: "found".into(), mark: Mark::Line, points: part([0.015, 0.6], of) },
            ],
        });
    }
    Ok(())
}
