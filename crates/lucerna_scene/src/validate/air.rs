//! Whether the air is allowed.

use super::{Check, FAR_M};
use crate::{Air, Fire, Place, Pressure, SceneError};

/// Smallest edge of a cell, m.
const MIN_CELL_M: f32 = 1.0e-4;

/// Most cells of a grid.
const MAX_CELLS: u32 = 4_000_000;

/// Most cells of all boxes of air together: memory, not time, runs out first.
const MAX_ALL_CELLS: usize = 32_000_000;

/// The box of an air.
fn grid(
    check: &Check<'_>,
    of: &str,
    origin_m: &[f32; 3],
    size_m: &[f32; 3],
    cells: &[u32; 3],
) -> Result<(), SceneError> {
    check.each(&format!("{of}.origin_m"), origin_m, &(-FAR_M..=FAR_M))?;
    for (axis, size) in size_m.iter().enumerate() {
        check.above_zero(&format!("{of}.size_m[{axis}]"), *size, 1000.0)?;
    }
    check.each(&format!("{of}.cells"), cells, &(2..=256))?;
    let [x, y, z] = *cells;
    if x * y * z > MAX_CELLS {
        let allowed = format!("at most {MAX_CELLS} in all");
        return Err(check.fail(format!("{of}.cells"), format!("{x} x {y} x {z}"), allowed));
    }
    for (axis, (size, cells)) in size_m.iter().zip(cells).enumerate() {
        if *size < MIN_CELL_M * *cells as f32 {
            let allowed = format!("at least {MIN_CELL_M} m for each cell");
            return Err(check.fail(format!("{of}.size_m[{axis}]"), size, allowed));
        }
    }
    Ok(())
}

/// The air that a fire has of its own.
pub(super) fn of_fire(check: &Check<'_>, field: &str, fire: &Fire) -> Result<(), SceneError> {
    let Some(air) = &fire.air else { return Ok(()) };
    let of = |name: &str| format!("{field}.air.{name}");
    grid(check, &format!("{field}.air"), &air.origin_m, &air.size_m, &air.cells)?;
    let all = air.cells.iter().product::<u32>() as usize * fire.places().len();
    if all > MAX_ALL_CELLS {
        let counted = format!("the number of cells of all copies of {}", of("cells"));
        return Err(check.fail(counted, all, format!("at most {MAX_ALL_CELLS}")));
    }
    check.within(&of("vorticity_confinement"), air.vorticity_confinement.unwrap_or(0.0), 0.0..=100.0)?;
    check.within(&of("cooling_per_s"), air.cooling_per_s.unwrap_or(0.0), 0.0..=1000.0)
}

pub(super) fn air(check: &Check<'_>, air: &Air) -> Result<(), SceneError> {
    grid(check, "air", &air.origin_m, &air.size_m, &air.cells)?;
    check.within("air.time_step_s", air.time_step_s, 1.0e-5..=10.0)?;
    check.within("air.viscosity_m2_s", air.viscosity_m2_s, 0.0..=1000.0)?;
    check.within("air.vorticity_confinement", air.vorticity_confinement, 0.0..=100.0)?;
    if let Pressure::GaussSeidel(sweeps) = air.pressure {
        check.within("air.pressure gauss_seidel", sweeps, 1..=10_000)?;
    }
    check.within("air.ambient_k", air.ambient_k, 1.0..=5000.0)?;
    check.within("air.cooling_per_s", air.cooling_per_s, 0.0..=1000.0)?;
    check.within("air.row_buoyancy_m_s2", air.row_buoyancy_m_s2, 0.0..=10_000.0)?;
    check.each("air.wind_m_s", &air.wind_m_s, &(-100.0..=100.0))
}

/// Whether the points of a wick lie in the air that each copy of its fire burns in.
pub(crate) fn wick_inside(
    check: &Check<'_>,
    common: &Air,
    fire: &Fire,
    field: &str,
    points: &[[f32; 3]],
) -> Result<(), SceneError> {
    for place in fire.places() {
        match &fire.air {
            Some(own) => {
                let (air, turned) = (own.air(common, [0.0; 3]), Place { at: [0.0; 3], ..place });
                points.iter().try_for_each(|point| inside(check, &air, field, turned.point(*point)))?;
                // The box goes with the fire: only the turn makes a difference.
                if fire.turns_deg.is_empty() {
                    break;
                }
            }
            None => points.iter().try_for_each(|point| inside(check, common, field, place.point(*point)))?,
        }
    }
    Ok(())
}

/// Whether a point of a wick lies in the air's box.
pub(crate) fn inside(check: &Check<'_>, air: &Air, field: &str, point: [f32; 3]) -> Result<(), SceneError> {
    let inside = (0..3).all(|axis| {
        let low = air.origin_m[axis];
        (low..=low + air.size_m[axis]).contains(&point[axis])
    });
    if inside {
        return Ok(());
    }
    let [x, y, z] = air.origin_m;
    let [w, h, d] = air.size_m;
    let allowed = format!("inside the air, from ({x}, {y}, {z}) to ({}, {}, {})", x + w, y + h, z + d);
    Err(check.fail(field, format!("at ({}, {}, {})", point[0], point[1], point[2]), allowed))
}
