//! The vortex street behind a cylinder at a Reynolds number of 100.

use std::path::Path;

use lucerna_fluid::{Advection, Fluid, Obstacle, Side, Sides, Vec3};

use crate::picture::Picture;
use crate::{Outcome, Row};

/// Cells a diameter, and diameters of the box.
const FINENESS: usize = 12;
const BOX: [usize; 2] = [20, 14];
const CENTRE: Vec3 = Vec3::new(5.0, 7.0, 0.0);
const REYNOLDS: f32 = 100.0;
/// Frequency of shedding times diameter over speed; C. Williamson, J. Fluid Mech. 206, 1989.
const STROUHAL: f64 = 0.164;
const DT_S: f32 = 0.04;
/// When counting starts and ends, s.
const TIMES_S: [f32; 2] = [60.0, 120.0];

/// Strouhal number, and a picture of the vorticity.
pub(crate) fn run(folder: &Path, rows: &mut Vec<Row>) -> Outcome<()> {
    let edge = 1.0 / FINENESS as f32;
    let mut fluid = Fluid::builder([BOX[0] * FINENESS, BOX[1] * FINENESS, 1])
        .size_m(Vec3::new(BOX[0] as f32, BOX[1] as f32, edge))
        .sides(Sides { x: [Side::Inflow, Side::Open], ..Sides::CLOSED })
        .wind(Vec3::X)
        .viscosity_m2_s(1.0 / REYNOLDS)
        .advection(Advection::Reflection)
        .build()?;
    fluid.set_obstacles(&[Obstacle::cylinder(CENTRE - Vec3::Z, CENTRE + Vec3::Z, 0.5)])?;
    // Pushed to one side for a moment, so that the street begins.
    let wake = CENTRE + Vec3::new(1.0, 0.0, 0.5 * edge);
    let probe = CENTRE + Vec3::new(2.0, 0.0, 0.5 * edge);
    let (mut crossings, mut before, mut iterations) = (Vec::new(), 0.0, 0);
    let steps = (TIMES_S[1] / DT_S) as usize;
    for step in 0..steps {
        let time = step as f32 * DT_S;
        if time < 2.0 {
            fluid.add_acceleration(wake, Vec3::Y * 20.0)?;
        }
        iterations += fluid.step(DT_S)?.pressure_iterations;
        let now = fluid.velocity(probe).y;
        if time > TIMES_S[0] && before < 0.0 && now >= 0.0 {
            crossings.push(f64::from(time - DT_S * now / (now - before)));
        }
        before = now;
    }
    let turns = crossings.len().saturating_sub(1) as f64;
    let span = crossings.last().copied().unwrap_or(0.0) - crossings.first().copied().unwrap_or(0.0);
    let strouhal = if span > 0.0 { turns / span } else { 0.0 };
    rows.push(Row {
        what: format!("vortex street behind a cylinder, {FINENESS} cells a diameter, Re {REYNOLDS}: Strouhal number"),
        measured: format!("{strouhal:.3} ({:+.1} %)", 100.0 * (strouhal / STROUHAL - 1.0)),
        reference: format!("{STROUHAL}, Williamson 1989, in an endless flow"),
    });
    rows.push(Row {
        what: "the same: iterations of the pressure solver a step, two solves".into(),
        measured: format!("{:.1}", f64::from(iterations) / steps as f64),
        reference: String::new(),
    });
    draw(&fluid).write(&folder.join("vortex_street.png"))
}

/// Vorticity, blue to red, in the middle half of the height.
fn draw(fluid: &Fluid) -> Picture {
    const PIXELS: usize = 40;
    let edge = 1.0 / FINENESS as f32;
    let low = 0.25 * BOX[1] as f32;
    let height = BOX[1] * PIXELS / 2;
    Picture::new(BOX[0] * PIXELS, height, |column, row| {
        let x = (column as f32 + 0.5) / PIXELS as f32;
        let y = low + (height as f32 - row as f32 - 0.5) / PIXELS as f32;
        let point = Vec3::new(x, y, 0.5 * edge);
        if point.truncate().distance(CENTRE.truncate()) < 0.5 {
            return [60; 3];
        }
        crate::picture::two_colours(0.5 + 0.25 * f64::from(fluid.vorticity_at(point).z))
    })
}
