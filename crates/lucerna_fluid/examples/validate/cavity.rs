//! The lid-driven cavity: a square box whose upper wall slides along.

use std::path::Path;

use lucerna_fluid::{Advection, Fluid, Side, SideAt, Sides, Vec3};
use plotters::chart::SeriesLabelPosition;

use crate::chart::{Chart, Mark, Series, write_row};
use crate::published::{BOTELLA_1000_U, BOTELLA_1000_V, GHIA_100_U, GHIA_100_V, Profile};
use crate::{Outcome, Row};

const CELLS: usize = 64;

/// Centrelines at two Reynolds numbers against published values.
pub(crate) fn run(folder: &Path, rows: &mut Vec<Row>) -> Outcome<()> {
    let mut series = [Vec::new(), Vec::new()];
    let cases: [(f32, [&Profile; 2], &str, f32); 2] = [
        (100.0, [GHIA_100_U, GHIA_100_V], "Ghia et al. 1982", 25.0),
        (1000.0, [BOTELLA_1000_U, BOTELLA_1000_V], "Botella and Peyret 1998", 80.0),
    ];
    let schemes = [Advection::MacCormack, Advection::Reflection];
    let runs = cases.into_iter().enumerate().flat_map(|case| schemes.map(|scheme| (case, scheme)));
    for ((colour, (reynolds, published, source, end_s)), scheme) in runs {
        let fluid = settled(reynolds, end_s, scheme)?;
        // The better one is drawn.
        let is_drawn = scheme == Advection::Reflection;
        let mut off = [0.0_f64; 2];
        for axis in 0..2 {
            let at = |place: f64| {
                let mut point = Vec3::new(0.5, 0.5, 0.5 / CELLS as f32);
                point[1 - axis] = place as f32;
                f64::from(fluid.velocity(point)[axis])
            };
            // Sampling stops at the last centres; on the walls the velocity is given.
            let centres = (0..CELLS).map(|cell| (cell as f64 + 0.5) / CELLS as f64).map(|place| (place, at(place)));
            let lid = if axis == 0 { 1.0 } else { 0.0 };
            let line = [(0.0, 0.0)].into_iter().chain(centres).chain([(1.0, lid)]);
            if is_drawn {
                series[axis].push(Series {
                    name: format!("Re {reynolds}"),
                    colour: colour + 1,
                    mark: Mark::Line,
                    points: line.collect(),
                });
                series[axis].push(Series {
                    name: format!("Re {reynolds}, {source}"),
                    colour: colour + 1,
                    mark: Mark::Points,
                    points: published[axis].to_vec(),
                });
            }
            off[axis] = published[axis].iter().fold(0.0, |most, (place, value)| most.max((at(*place) - value).abs()));
        }
        rows.push(Row {
            what: format!(
                "lid-driven cavity, {CELLS}^2, Re {reynolds}, {scheme:?}: greatest difference on the centrelines, u and v"
            ),
            measured: format!("{:.4}, {:.4} of the lid's speed", off[0], off[1]),
            reference: source.into(),
        });
    }
    let [u, v] = series;
    let charts = [
        Chart {
            title: "Lid-driven cavity, 64 x 64 cells: vertical centreline",
            x: ("height y, of the edge", [0.0, 1.0]),
            y: ("horizontal velocity u, of the lid's", [-0.5, 1.0]),
            has_log_axes: false,
            legend: SeriesLabelPosition::UpperLeft,
            series: u,
        },
        Chart {
            title: "Lid-driven cavity, 64 x 64 cells: horizontal centreline",
            x: ("place x, of the edge", [0.0, 1.0]),
            y: ("vertical velocity v, of the lid's", [-0.6, 0.6]),
            has_log_axes: false,
            legend: SeriesLabelPosition::LowerLeft,
            series: v,
        },
    ];
    write_row(&folder.join("cavity.svg"), &charts)
}

/// The flow after `end_s` seconds, in a box of 1 m with a lid of 1 m/s.
fn settled(reynolds: f32, end_s: f32, scheme: Advection) -> Outcome<Fluid> {
    let no_slip = [Side::NoSlip; 2];
    let edge = 1.0 / CELLS as f32;
    let mut fluid = Fluid::builder([CELLS, CELLS, 1])
        .size_m(Vec3::new(1.0, 1.0, edge))
        .sides(Sides { x: no_slip, y: no_slip, ..Sides::CLOSED })
        .viscosity_m2_s(1.0 / reynolds)
        .advection(scheme)
        .build()?;
    fluid.set_side_velocity(SideAt::Top, |_| Vec3::X)?;
    let dt_s = 0.5 * edge;
    for _ in 0..(end_s / dt_s) as usize {
        fluid.step(dt_s)?;
    }
    Ok(fluid)
}
