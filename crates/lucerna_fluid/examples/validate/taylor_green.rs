//! The Taylor-Green vortex: without viscosity its energy stays.

use std::f32::consts::PI;
use std::path::Path;

use lucerna_fluid::{Fluid, Vec3};
use plotters::chart::SeriesLabelPosition;

use crate::chart::{Chart, Mark, Series, write_row};
use crate::schemes::SCHEMES;
use crate::{Outcome, Row};

const END_S: f64 = 2.0;

/// Energy over time for all schemes.
pub(crate) fn run(folder: &Path, rows: &mut Vec<Row>) -> Outcome<()> {
    let mut charts = Vec::new();
    for n in [32, 64] {
        let mut series = Vec::new();
        for (colour, scheme) in SCHEMES.iter().enumerate() {
            let builder = (scheme.set)(Fluid::builder([n, n, 1]).size_m(Vec3::new(1.0, 1.0, 1.0 / n as f32)));
            let mut fluid = builder.build()?;
            fluid.fill_velocity(|point| {
                let (x, y) = (PI * point.x, PI * point.y);
                Vec3::new(x.sin() * y.cos(), -x.cos() * y.sin(), 0.0)
            })?;
            let before = fluid.mean_kinetic_energy_m2_s2();
            let mut points = vec![(0.0, 1.0)];
            let mut kept = 1.0;
            for step in 1..=(END_S * n as f64) as usize {
                // The greatest speed is 1 m/s: a Courant number of 1.
                fluid.step(1.0 / n as f32)?;
                kept = fluid.mean_kinetic_energy_m2_s2() / before;
                points.push((step as f64 / n as f64, kept));
            }
            rows.push(Row {
                what: format!("inviscid Taylor-Green vortex, {n}^2, t = 2, CFL 1, {}: energy kept", scheme.name),
                measured: format!("{kept:.4}"),
                reference: "1 (exact)".into(),
            });
            series.push(Series { name: scheme.name.into(), colour: colour + 1, mark: Mark::Line, points });
        }
        let exact = vec![(0.0, 1.0), (END_S, 1.0)];
        series.push(Series { name: "exact".into(), colour: 0, mark: Mark::Line, points: exact });
        charts.push((format!("Inviscid Taylor-Green vortex, {n} x {n} cells, CFL 1"), series));
    }
    let charts: Vec<Chart<'_>> = charts
        .iter_mut()
        .map(|(title, series)| Chart {
            title,
            x: ("time, s", [0.0, END_S]),
            y: ("kinetic energy, of the start's", [0.4, 1.1]),
            has_log_axes: false,
            legend: SeriesLabelPosition::LowerLeft,
            series: std::mem::take(series),
        })
        .collect();
    write_row(&folder.join("taylor_green.svg"), &charts)
}
