//! A turbulent plume over a burner of 10 kW against the correlations of measured plumes
//! (G. Heskestad, *Fire Plumes, Flame Height, and Air Entrainment*, SFPE Handbook; E. Zukoski).

use std::path::Path;

use lucerna_fluid::{
    AIR_HEAT_CAPACITY_J_KG_K, Fluid, GRAVITY_M_S2, Shape, Side, Sides, Source, Vec3, air_density_kg_m3,
};
use plotters::chart::SeriesLabelPosition;

use crate::chart::{Chart, Mark, Series, write_row};
use crate::{Outcome, Row};

const HEAT_KW: f32 = 10.0;
const BURNER_M: f32 = 0.3;
const CELL_M: f32 = 0.05;
const CELLS: [usize; 3] = [48, 64, 48];
const DT_S: f32 = 0.02;
/// The plume is left alone for the first part, and averaged over the second, s.
const TIMES_S: [f32; 2] = [8.0, 24.0];

/// Mean speed and temperature on the axis.
pub(crate) fn run(folder: &Path, rows: &mut Vec<Row>) -> Outcome<()> {
    let size = Vec3::from_array(CELLS.map(|cells| cells as f32 * CELL_M));
    let mut fluid =
        Fluid::builder(CELLS).size_m(size).sides(Sides { y: [Side::NoSlip, Side::Open], ..Sides::OPEN }).build()?;
    let middle = Vec3::new(0.5 * size.x, 0.0, 0.5 * size.z);
    // A square burner as large as a round one of this diameter, two cells thick.
    let half = 0.5 * BURNER_M * (std::f32::consts::PI / 4.0).sqrt();
    let shape =
        Shape::Box { low: middle - Vec3::new(half, 0.0, half), high: middle + Vec3::new(half, 2.0 * CELL_M, half) };
    fluid.attach_source(Source { heat_kw: HEAT_KW, ..Source::new(shape) })?;
    let heights: Vec<f32> = (2..CELLS[1] - 2).map(|j| (j as f32 + 0.5) * CELL_M).collect();
    let mut sums = vec![(0.0_f64, 0.0_f64); heights.len()];
    let [start, end] = TIMES_S.map(|time| (time / DT_S) as usize);
    for step in 0..end {
        fluid.step(DT_S)?;
        if step >= start {
            for (sum, height) in sums.iter_mut().zip(&heights) {
                let point = middle + Vec3::Y * *height;
                sum.0 += f64::from(fluid.velocity(point).y);
                sum.1 += f64::from(fluid.temperature(point));
            }
        }
    }
    let count = (end - start) as f64;
    let ambient_k = f64::from(fluid.ambient_k());
    let (heat, diameter) = (f64::from(HEAT_KW), f64::from(BURNER_M));
    let (g, cp) = (f64::from(GRAVITY_M_S2), f64::from(AIR_HEAT_CAPACITY_J_KG_K) / 1000.0);
    let density = f64::from(air_density_kg_m3(fluid.ambient_k()));
    let origin = 0.083 * heat.powf(0.4) - 1.02 * diameter;
    let speed = |z: f64| 3.4 * (g * heat / (cp * density * ambient_k * (z - origin))).cbrt();
    let kelvin =
        |z: f64| 9.1 * (ambient_k * heat * heat / (g * (cp * density).powi(2))).cbrt() * (z - origin).powf(-5.0 / 3.0);
    let (mut speeds, mut kelvins) = (Vec::new(), Vec::new());
    for (height, sum) in heights.iter().zip(&sums) {
        speeds.push((f64::from(*height), sum.0 / count));
        kelvins.push((f64::from(*height), sum.1 / count));
    }
    for (name, unit, found, expected) in [
        ("mean speed", "m/s", &speeds, &speed as &dyn Fn(f64) -> f64),
        ("mean temperature above ambient", "K", &kelvins, &kelvin),
    ] {
        let at = 2.0;
        let value =
            found.iter().min_by(|a, b| (a.0 - at).abs().total_cmp(&(b.0 - at).abs())).map_or(0.0, |pair| pair.1);
        rows.push(Row {
            what: format!("plume of {HEAT_KW} kW, cells of {CELL_M} m: {name} on the axis, {at} m up"),
            measured: format!("{value:.2} {unit} ({:+.0} %)", 100.0 * (value / expected(at) - 1.0)),
            reference: format!("{:.2} {unit}, Heskestad's correlation", expected(at)),
        });
    }
    let measured = |of: &dyn Fn(f64) -> f64| (3..=15).map(|at| 0.2 * f64::from(at)).map(|z| (z, of(z))).collect();
    let height = [0.0, 3.2];
    let charts = [
        Chart {
            title: "Plume of 10 kW, cells of 5 cm: mean speed on the axis",
            x: ("height, m", height),
            y: ("speed, m/s", [0.0, 3.0]),
            has_log_axes: false,
            legend: SeriesLabelPosition::LowerRight,
            series: vec![
                Series { name: "computed".into(), colour: 1, mark: Mark::Line, points: speeds },
                Series { name: "Heskestad".into(), colour: 1, mark: Mark::Points, points: measured(&speed) },
            ],
        },
        Chart {
            title: "The same: mean temperature on the axis",
            x: ("height, m", height),
            y: ("above ambient, K", [0.0, 400.0]),
            has_log_axes: false,
            legend: SeriesLabelPosition::UpperRight,
            series: vec![
                Series { name: "computed".into(), colour: 2, mark: Mark::Line, points: kelvins },
                Series { name: "Heskestad".into(), colour: 2, mark: Mark::Points, points: measured(&kelvin) },
            ],
        },
    ];
    write_row(&folder.join("plume.svg"), &charts)
}
