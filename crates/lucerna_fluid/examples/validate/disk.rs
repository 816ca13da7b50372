//! Zalesak's disk: a disk with a slot turns once in a flow that turns like a solid body
//! (S. Zalesak, J. Comput. Phys. 31, 1979).

use std::f32::consts::TAU;
use std::path::Path;

use lucerna_fluid::{Fluid, Side, SideAt, Sides, Vec3};
use plotters::chart::SeriesLabelPosition;

use crate::chart::{Chart, Mark, Series, write_row};
use crate::contour::contour;
use crate::schemes::SCALAR_SCHEMES;
use crate::{Outcome, Row};

const CELLS: usize = 100;
const STEPS: usize = 200;
const MIDDLE: Vec3 = Vec3::new(0.5, 0.5, 0.0);

/// Outlines after one turn, and what became of the mass and of the bounds.
pub(crate) fn run(folder: &Path, rows: &mut Vec<Row>) -> Outcome<()> {
    let mut series = Vec::new();
    let exact: Vec<f64> = (0..CELLS * CELLS)
        .map(|cell| {
            let place = |at: usize| (at as f32 + 0.5) / CELLS as f32;
            f64::from(disk(Vec3::new(place(cell % CELLS), place(cell / CELLS), 0.0)))
        })
        .collect();
    outline(&mut series, "exact", 0, &exact);
    let mass_before: f64 = exact.iter().sum();
    for (at, scheme) in SCALAR_SCHEMES.iter().enumerate() {
        let values = turned_once(scheme.set)?;
        outline(&mut series, scheme.name, at + 1, &values);
        let mass = values.iter().sum::<f64>() / mass_before - 1.0;
        let off = values.iter().zip(&exact).map(|(value, exact)| (value - exact).abs()).sum::<f64>() / mass_before;
        let (low, high) =
            values.iter().fold((0.0_f64, 0.0_f64), |(low, high), value| (low.min(*value), high.max(*value)));
        rows.push(Row {
            what: format!(
                "Zalesak's disk, {CELLS}^2, one turn in {STEPS} steps, {}: change of mass; least, greatest value; mean error",
                scheme.name
            ),
            measured: format!("{:+.2} %; {low:.3}, {high:.3}; {off:.3} of the mass", 100.0 * mass),
            reference: "0; 0, 1; 0 (exact)".into(),
        });
    }
    let chart = Chart {
        title: "Zalesak's disk after one turn: where half is left, 100 x 100 cells",
        x: ("x, m", [0.3, 0.85]),
        y: ("y, m", [0.55, 0.95]),
        has_log_axes: false,
        legend: SeriesLabelPosition::UpperRight,
        series,
    };
    write_row(&folder.join("zalesak.svg"), &[chart])
}

/// The slotted disk at its start.
fn disk(point: Vec3) -> f32 {
    let from_middle = point - Vec3::new(0.5, 0.75, 0.0);
    let is_slot = from_middle.x.abs() < 0.025 && point.y < 0.85;
    if from_middle.truncate().length() < 0.15 && !is_slot { 1.0 } else { 0.0 }
}

/// The scalar after one turn.
fn turned_once(set: fn(lucerna_fluid::FluidBuilder) -> lucerna_fluid::FluidBuilder) -> Outcome<Vec<f64>> {
    let inflow = [Side::Inflow; 2];
    let builder = Fluid::builder([CELLS, CELLS, 1])
        .size_m(Vec3::new(1.0, 1.0, 1.0 / CELLS as f32))
        .sides(Sides { x: inflow, y: inflow, ..Sides::CLOSED })
        .scalar("disk");
    let mut fluid = set(builder).build()?;
    let Some(id) = fluid.scalar_id("disk") else { return Err("no scalar".into()) };
    fluid.fill_scalar(id, disk)?;
    let turning = |point: Vec3| Vec3::new(MIDDLE.y - point.y, point.x - MIDDLE.x, 0.0);
    for side in [SideAt::Left, SideAt::Right, SideAt::Bottom, SideAt::Top] {
        fluid.set_side_velocity(side, turning)?;
    }
    for _ in 0..STEPS {
        // The flow would turn on by itself, but only the carrying of the disk is asked for.
        fluid.fill_velocity(turning)?;
        fluid.step(TAU / STEPS as f32)?;
    }
    Ok(fluid.scalar_values(id).map(f64::from).collect())
}

/// The line of one half, as series of which only the first is named.
fn outline(series: &mut Vec<Series>, name: &str, colour: usize, values: &[f64]) {
    let metres = |at: f64| (at + 0.5) / CELLS as f64;
    for (at, line) in contour(values, CELLS, 0.5).into_iter().enumerate() {
        let points = line.into_iter().map(|(x, y)| (metres(x), metres(y))).collect();
        let name = if at == 0 { name.to_owned() } else { String::new() };
        series.push(Series { name, colour, mark: Mark::Line, points });
    }
}
