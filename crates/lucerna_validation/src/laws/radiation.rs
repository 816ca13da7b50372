//! What reaches a place beside the fire.

use std::f64::consts::PI;

use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::fire::{Burner, METHANOL, Plan};
use crate::laws::heights::watch;

pub(crate) const RADIATION: Experiment = Experiment {
    name: "radiation",
    title: "Radiation beside 19.2 kW of methanol on 0.301 m",
    law: "far away X Q / (4 pi r^2), X the radiated share",
    source: "K. Sung, R. Falkenstein-Smith, A. Hamins, NIST Technical Note 2162r1, 2024, and its MaCFP table: gauges 0.6 m \
             from the axis, uncertain by 37 %",
    origin: Origin::Calibrated,
    measures: "Each height radiates the measured share, 0.24, of the heat that is released there, evenly all around. The \
               share is theirs; where it comes from is found.",
    short: None,
    long: "12 cells across, box of 3 x 5 x 3 diameters, 2 to 6 s",
    burn,
};

/// Height of the gauge, m, and what it measured, kW/m².
const MEASURED: [(f64, f64); 12] = [
    (0.0, 0.81),
    (0.1, 0.95),
    (0.2, 0.98),
    (0.3, 0.90),
    (0.4, 0.83),
    (0.5, 0.71),
    (0.6, 0.55),
    (0.7, 0.46),
    (0.8, 0.37),
    (0.9, 0.27),
    (1.0, 0.19),
    (1.2, 0.07),
];
const GAUGE_M: f64 = 0.6;

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    const DIAMETER: f32 = 0.301;
    const HEAT_KW: f32 = 19.2;
    let cell_m = DIAMETER / 12.0;
    let plan = Plan::new(METHANOL, HEAT_KW, Burner::Round { diameter: DIAMETER }, cell_m, [36, 60, 36]);
    let rows = watch(run, &plan, 0.2 * cell_m, [2.0, 6.0])?.watched.release_by_row();
    let radiated_kw = f64::from(HEAT_KW * METHANOL.fuel.radiated);
    // A gauge faces the axis.
    let flux = |distance: f64, height: f64| {
        rows.iter()
            .map(|(at, share)| {
                let square = distance.powi(2) + (height - at).powi(2);
                radiated_kw * share / (4.0 * PI * square) * distance / square.sqrt()
            })
            .sum::<f64>()
    };
    for (height, published) in MEASURED.into_iter().step_by(2).take(5) {
        let what = format!("0.6 m away, {height} m up");
        run.figure(Figure::new(what, "kW/m²", published, flux(GAUGE_M, height), Allowed::Percent(25.0)));
    }
    let law = radiated_kw / (4.0 * PI * 9.0);
    run.figure(Figure::new("3 m away, 0.3 m up", "kW/m²", law, flux(3.0, 0.3), Allowed::Percent(5.0)));
    let found = (0..=24).map(|at| 0.05 * f64::from(at)).map(|height| (height, flux(GAUGE_M, height))).collect();
    run.chart(Chart {
        title: "Radiation 0.6 m from the axis".into(),
        x: Axis::linear("height, m"),
        y: Axis::linear("kW/m²"),
        series: vec![
            Series { name: "measured".into(), mark: Mark::Points, points: MEASURED.to_vec() },
            Series { name: "found".into(), mark: Mark::Line, points: found },
        ],
    });
    Ok(())
}
