//! A turbulent plume over a burner of 10 kW against the correlations of measured plumes
//! (G. Heskestad, *Fire Plumes, Flame Height, and Air Entrainment*, SFPE Handbook).

use std::path::Path;

use lucerna_fluid::{
    AIR_HEAT_CAPACITY_J_KG_K, Density, Fluid, GRAVITY_M_S2, Shape, Side, Sides, Source, Vec3, air_density_kg_m3,
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
/// Where figures for the table are taken, m above the floor.
const HEIGHT_M: f64 = 2.0;

/// Means on the axis by height.
struct Plume {
    speeds: Vec<(f64, f64)>,
    kelvins: Vec<(f64, f64)>,
}

/// Mean speed and temperature on the axis.
pub(crate) fn run(folder: &Path, rows: &mut Vec<Row>) -> Outcome<()> {
    let (heat, diameter, ambient_k) = (f64::from(HEAT_KW), f64::from(BURNER_M), 293.15);
    let (g, cp) = (f64::from(GRAVITY_M_S2), f64::from(AIR_HEAT_CAPACITY_J_KG_K) / 1000.0);
    let density = f64::from(air_density_kg_m3(293.15));
    let origin = 0.083 * heat.powf(0.4) - 1.02 * diameter;
    let speed = |z: f64| 3.4 * (g * heat / (cp * density * ambient_k * (z - origin))).cbrt();
    let scale = 9.1 * (ambient_k * heat * heat / (g * (cp * density).powi(2))).cbrt();
    let kelvin = |z: f64| scale * (z - origin).powf(-5.0 / 3.0);
    let measured = |of: &dyn Fn(f64) -> f64| (3..=15).map(|at| 0.2 * f64::from(at)).map(|z| (z, of(z))).collect();
    let points = |of: &dyn Fn(f64) -> f64| Series {
        name: "measured plumes (Heskestad)".into(),
        colour: 0,
        mark: Mark::Points,
        points: measured(of),
    };
    let (mut speeds, mut kelvins) = (vec![points(&speed)], vec![points(&kelvin)]);
    for (at, (name, density)) in
        [("Boussinesq", Density::Boussinesq), ("low Mach", Density::LowMach)].into_iter().enumerate()
    {
        let plume = burn(density)?;
        let near = |points: &[(f64, f64)]| {
            let nearest = points.iter().min_by(|a, b| (a.0 - HEIGHT_M).abs().total_cmp(&(b.0 - HEIGHT_M).abs()));
            nearest.map_or(f64::NAN, |point| point.1)
        };
        let (fast, hot) = (near(&plume.speeds), near(&plume.kelvins));
        let percent = |found: f64, expected: f64| 100.0 * (found / expected - 1.0);
        rows.push(Row {
            what: format!("plume of {HEAT_KW} kW, cells of {CELL_M} m, {name}: mean speed and temperature on the axis, {HEIGHT_M} m up"),
            measured: format!(
                "{fast:.2} m/s ({:+.0} %), {hot:.0} K ({:+.0} %)",
                percent(fast, speed(HEIGHT_M)),
                percent(hot, kelvin(HEIGHT_M))
            ),
            reference: format!("{:.2} m/s, {:.0} K, Heskestad's correlations", speed(HEIGHT_M), kelvin(HEIGHT_M)),
        });
        let line = |points| Series { name: name.into(), colour: at + 1, mark: Mark::Line, points };
        speeds.push(line(plume.speeds));
        kelvins.push(line(plume.kelvins));
    }
    let height = [0.0, 3.2];
    let charts = [
        Chart {
            title: "Plume of 10 kW, cells of 5 cm: mean speed on the axis",
            x: ("height, m", height),
            y: ("speed, m/s", [0.0, 4.0]),
            has_log_axes: false,
            legend: SeriesLabelPosition::LowerRight,
            series: speeds,
        },
        Chart {
            title: "The same: mean temperature on the axis",
            x: ("height, m", height),
            y: ("above ambient, K", [0.0, 400.0]),
            has_log_axes: false,
            legend: SeriesLabelPosition::UpperRight,
            series: kelvins,
        },
    ];
    write_row(&folder.join("plume.svg"), &charts)
}

/// Runs the plume.
fn burn(density: Density) -> Outcome<Plume> {
    let size = Vec3::from_array(CELLS.map(|cells| cells as f32 * CELL_M));
    let mut fluid = Fluid::builder(CELLS)
        .size_m(size)
        .sides(Sides { y: [Side::NoSlip, Side::Open], ..Sides::OPEN })
        .density(density)
        .build()?;
    let middle = Vec3::new(0.5 * size.x, 0.0, 0.5 * size.z);
    // A square burner as large as a round one of this diameter, two cells thick.
    let half = 0.5 * BURNER_M * (std::f32::consts::PI / 4.0).sqrt();
    let shape =
        Shape::Box { low: middle - Vec3::new(half, 0.0, half), high: middle + Vec3::new(half, 2.0 * CELL_M, half) };
    fluid.attach_source(Source { heat_kw: HEAT_KW, ..Source::new(shape.clone()) })?;
    let heights: Vec<f32> = (2..CELLS[1] - 2).map(|j| (j as f32 + 0.5) * CELL_M).collect();
    let mut sums = vec![(0.0_f64, 0.0_f64); heights.len()];
    let [start, end] = TIMES_S.map(|time| (time / DT_S) as usize);
    for step in 0..end {
        // Gusts from changing sides, a tenth of the lift: without any, a plume in still air stays straight.
        let angle = (0.37 * step as f32).sin() * 9.0;
        let push = Vec3::new(angle.cos(), 0.0, angle.sin());
        fluid.add_source(&Source { acceleration_m_s2: push, ..Source::new(shape.clone()) })?;
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
    let mean = |of: fn(&(f64, f64)) -> f64| {
        heights.iter().zip(&sums).map(|(height, sum)| (f64::from(*height), of(sum) / count)).collect()
    };
    Ok(Plume { speeds: mean(|sum| sum.0), kelvins: mean(|sum| sum.1) })
}
