//! How far the wind bends a fire over.

use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::fire::{Burner, PROPANE, Plan};

pub(crate) const WIND: Experiment = Experiment {
    name: "wind",
    title: "34.4 kW of propane on 0.37 m in wind",
    law: "tan(angle above the ground) = 2.24 sqrt(L) / U",
    source: "A. Putnam; L is the height without wind, 0.75 m",
    origin: Origin::Emergent,
    measures: "Angle from the vertical of the way from the burner to the middle of the burning gas, mean over time.",
    short: None,
    long: "cells of 6.2 cm, box of 2.7 x 1.5 x 1.5 m, 3 to 7 s each",
    burn,
};

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    const DIAMETER: f32 = 0.37;
    const HEIGHT_M: f64 = 0.75;
    let cell_m = DIAMETER / 6.0;
    let dt_s = 0.01;
    let speeds = [0.0_f32, 0.3, 1.0, 2.0];
    let mut found = Vec::new();
    for (at, wind_m_s) in speeds.into_iter().enumerate() {
        run.part(at, speeds.len());
        let plan = Plan {
            wind_m_s,
            at_m: vec![-0.7],
            ..Plan::new(PROPANE.radiating(0.22), 34.4, Burner::Round { diameter: DIAMETER }, cell_m, [44, 24, 24])
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
        let law =
            if wind_m_s > 0.0 { (f64::from(wind_m_s) / (2.24 * HEIGHT_M.sqrt())).atan().to_degrees() } else { 0.0 };
        let what = format!("tilt in {wind_m_s} m/s");
        run.figure(Figure::new(what, "°", law, tilt, Allowed::Difference(10.0)));
        found.push((f64::from(wind_m_s), tilt));
    }
    let grows = found.windows(2).map(|pair| pair[1].1 - pair[0].1).fold(f64::INFINITY, f64::min);
    let what = "least growth of the tilt from one wind to the next";
    run.figure(Figure::new(what, "°", 0.0, grows, Allowed::UpTo(90.0)));
    let law = (0..=20).map(|at| 0.1 * f64::from(at)).map(|u| (u, (u / (2.24 * HEIGHT_M.sqrt())).atan().to_degrees()));
    run.chart(Chart {
        title: "Tilt of 34.4 kW".into(),
        x: Axis::linear("wind, m/s"),
        y: Axis::linear("from the vertical, degrees"),
        series: vec![
            Series { name: "Putnam".into(), mark: Mark::Dashes, points: law.collect() },
            Series { name: "found".into(), mark: Mark::Points, points: found },
        ],
    });
    Ok(())
}
