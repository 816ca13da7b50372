//! The heated cavity: a square box, hot on the left, cold on the right, insulated below and above.

use std::path::Path;

use lucerna_fluid::{Fluid, GRAVITY_M_S2, Side, SideAt, Sides, Vec3};

use crate::picture::{Picture, two_colours};
use crate::published::DE_VAHL_DAVIS;
use crate::{Outcome, Row};

const CELLS: usize = 64;
const PRANDTL: f64 = 0.71;
const AMBIENT_K: f64 = 293.15;
/// Makes buoyancy over the whole difference 1 m/s²: velocities are then in units of
/// `sqrt(g beta dT L)`.
const DIFFERENCE_K: f64 = AMBIENT_K / GRAVITY_M_S2 as f64;

/// Mean Nusselt numbers against published values, and isotherms.
pub(crate) fn run(folder: &Path, rows: &mut Vec<Row>) -> Outcome<()> {
    let mut pictures = Vec::new();
    for (rayleigh, published) in DE_VAHL_DAVIS.iter().copied() {
        let (fluid, conductivity) = settled(rayleigh)?;
        let nusselt = nusselt(&fluid, conductivity);
        rows.push(Row {
            what: format!("heated cavity, {CELLS}^2, Ra {rayleigh:.0e}, Pr 0.71: mean Nusselt number"),
            measured: format!("{nusselt:.3} ({:+.1} %)", 100.0 * (nusselt / published - 1.0)),
            reference: format!("{published:.3}, de Vahl Davis 1983"),
        });
        pictures.push(draw(&fluid));
    }
    Picture::beside(&pictures, 8).write(&folder.join("heated_cavity.png"))
}

/// The steady flow, and its thermal diffusivity, m²/s.
fn settled(rayleigh: f64) -> Outcome<(Fluid, f64)> {
    let no_slip = [Side::NoSlip; 2];
    let edge = 1.0 / CELLS as f32;
    let viscosity = (PRANDTL / rayleigh).sqrt();
    let conductivity = viscosity / PRANDTL;
    let mut fluid = Fluid::builder([CELLS, CELLS, 1])
        .size_m(Vec3::new(1.0, 1.0, edge))
        .sides(Sides { x: no_slip, y: no_slip, ..Sides::CLOSED })
        .ambient_k(AMBIENT_K as f32)
        .viscosity_m2_s(viscosity as f32)
        .build()?;
    fluid.set_thermal_diffusivity_m2_s(conductivity as f32)?;
    let half_k = 0.5 * DIFFERENCE_K as f32;
    fluid.set_side_temperature(SideAt::Left, Some(half_k))?;
    fluid.set_side_temperature(SideAt::Right, Some(-half_k))?;
    fluid.fill_temperature(|point| half_k * (1.0 - 2.0 * point.x))?;
    let dt_s = edge;
    // A few times the time in which heat crosses the box, or the layers at the walls settle.
    let end_s = (1.5 / conductivity).min(200.0);
    for _ in 0..(end_s / f64::from(dt_s)) as usize {
        fluid.step(dt_s)?;
    }
    Ok((fluid, conductivity))
}

/// Heat through the box over what conduction alone would carry: the mean over all cells of
/// `u T - a dT/dx`, where the second part integrates to the difference of the walls.
fn nusselt(fluid: &Fluid, conductivity: f64) -> f64 {
    let [u, _, _] = fluid.face_velocities();
    let flux: f64 = fluid
        .temperatures()
        .iter()
        .enumerate()
        .map(|(cell, value)| {
            let face = cell % CELLS + (CELLS + 1) * (cell / CELLS);
            0.5 * f64::from(u[face] + u[face + 1]) * f64::from(*value)
        })
        .sum();
    1.0 + flux / (CELLS * CELLS) as f64 / (conductivity * DIFFERENCE_K)
}

/// Colours by temperature, with isotherms every tenth of the difference.
fn draw(fluid: &Fluid) -> Picture {
    const PIXELS: usize = 240;
    let share = |column: f64, row: f64| {
        let point = Vec3::new((column / PIXELS as f64) as f32, 1.0 - (row / PIXELS as f64) as f32, 0.5 / CELLS as f32);
        f64::from(fluid.temperature(point)) / DIFFERENCE_K + 0.5
    };
    Picture::new(PIXELS, PIXELS, |column, row| {
        let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
        let here = share(x, y);
        let band = |value: f64| (10.0 * value).floor() as i32;
        let is_line = band(here) != band(share(x + 1.0, y)) || band(here) != band(share(x, y + 1.0));
        if is_line { [20; 3] } else { two_colours(here) }
    })
}
