//! Fires that are long and narrow.

use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::fire::{Burner, PROPANE, Plan};
use crate::laws::heights::watch;
use crate::signal::exponent;

pub(crate) const LINE_FIRE: Experiment = Experiment {
    name: "line_fire",
    title: "Propane from an endless slit of 5 cm",
    law: "L = 0.017 Q'^(2/3) m, Q' in kW/m",
    source: "D. Drysdale, An Introduction to Fire Dynamics, line fires",
    origin: Origin::Emergent,
    measures: "Height below which 99 % of the heat is released on average; the box repeats along the slit.",
    short: None,
    long: "cells of 2.5 cm, box of 0.8 x 1.2 x 0.3 m, 2 to 6 s each",
    burn,
};

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    const CELL_M: f32 = 0.025;
    const CELLS: [usize; 3] = [32, 48, 12];
    let length = CELL_M * CELLS[2] as f32;
    let mut found = Vec::new();
    let heats = [25.0_f32, 70.0, 200.0];
    for (at, kw_m) in heats.into_iter().enumerate() {
        run.part(at, heats.len());
        let plan = Plan::new(PROPANE, kw_m * length, Burner::Line { width: 0.05 }, CELL_M, CELLS);
        let heights = watch(run, &plan, 0.005, [2.0, 6.0])?.heights;
        let law = 0.017 * f64::from(kw_m).powf(2.0 / 3.0);
        let figure =
            Figure::new(format!("height of {kw_m} kW/m"), "m", law, heights.released_99_m, Allowed::Percent(25.0));
        let note =
            format!("burning half of the time {:.2} m, 500 K {:.2} m", heights.half_of_time_m, heights.kelvin_500_m);
        run.figure(figure.noted(note));
        found.push((f64::from(kw_m), heights.released_99_m));
    }
    run.figure(Figure::new("exponent of the height", "", 2.0 / 3.0, exponent(&found), Allowed::Difference(0.1)));
    let law = [20.0, 250.0].map(|q: f64| (q, 0.017 * q.powf(2.0 / 3.0))).to_vec();
    run.chart(Chart {
        title: "Height of line fires".into(),
        x: Axis::log("kW/m"),
        y: Axis::log("m"),
        series: vec![
            Series { name: "0.017 Q'^(2/3)".into(), mark: Mark::Dashes, points: law },
            Series { name: "found".into(), mark: Mark::Points, points: found },
        ],
    });
    Ok(())
}
