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
    law: "L = 0.0105 Q'^0.774 / W^0.161 m, Q' in kW/m, W the width of the slit in m",
    source: "M. Finney, T. Grumstrup, Effect of Flame Zone Depth on the Correlation of Flame Length with Fireline \
             Intensity, Int. J. Wildland Fire 32, 2023: gas from slits",
    origin: Origin::Calibrated,
    measures: "Height with burning gas half of the time; the box repeats along the slit. \
               Small eddies mix at the rate of FDS, which was set to Heskestad's heights of round fires there. \
               Drawn beside it: L = 0.034 Q'^(2/3), narrow slits of gas (L. Yuan, G. Cox, An Experimental Study of Some Line \
               Fires, Fire Safety Journal 27, 1996).",
    short: None,
    long: "cells of 2 cm, box of 0.8 x 1.2 x 0.3 m, 1.5 to 5 s each",
    burn,
};

const WIDTH_M: f64 = 0.05;

/// Height of a line of fire over a slit, m, by its heat, kW/m.
fn height_m(kw_m: f64) -> f64 {
    0.01051 * kw_m.powf(0.774) / WIDTH_M.powf(0.161)
}

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    const CELL_M: f32 = 0.02;
    const CELLS: [usize; 3] = [40, 60, 15];
    let length = CELL_M * CELLS[2] as f32;
    let mut found = Vec::new();
    let heats = [25.0_f32, 70.0, 200.0];
    for (at, kw_m) in heats.into_iter().enumerate() {
        run.part(at, heats.len());
        let plan = Plan::new(PROPANE, kw_m * length, Burner::Line { width: WIDTH_M as f32 }, CELL_M, CELLS);
        let heights = watch(run, &plan, 0.004, [1.5, 5.0])?.heights;
        let law = height_m(f64::from(kw_m));
        let figure =
            Figure::new(format!("height of {kw_m} kW/m"), "m", law, heights.half_of_time_m, Allowed::Percent(25.0));
        let note = format!("99 % of the heat {:.2} m, 500 K {:.2} m", heights.released_99_m, heights.kelvin_500_m);
        run.figure(figure.noted(note));
        found.push((f64::from(kw_m), heights.half_of_time_m));
    }
    run.figure(Figure::new("exponent of the height", "", 0.774, exponent(&found), Allowed::Difference(0.1)));
    let law = |height: fn(f64) -> f64| [20.0, 250.0].map(|kw_m| (kw_m, height(kw_m))).to_vec();
    run.chart(Chart {
        title: "Height of line fires".into(),
        x: Axis::log("kW/m"),
        y: Axis::log("m"),
        series: vec![
            Series { name: "Finney and Grumstrup".into(), mark: Mark::Dashes, points: law(height_m) },
            Series { name: "Yuan and Cox".into(), mark: Mark::Line, points: law(|kw_m| 0.034 * kw_m.powf(2.0 / 3.0)) },
            Series { name: "found".into(), mark: Mark::Points, points: found },
        ],
    });
    Ok(())
}
