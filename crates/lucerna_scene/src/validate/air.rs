//! Whether the air is allowed.

use super::{Check, FAR_M};
use crate::{Air, Pressure, SceneError};

/// Smallest edge of a cell, m.
const MIN_CELL_M: f32 = 1.0e-4;

/// Most cells of a grid.
const MAX_CELLS: u32 = 4_000_000;

pub(super) fn air(check: &Check<'_>, air: &Air) -> Result<(), SceneError> {
    check.each("air.origin_m", &air.origin_m, &(-FAR_M..=FAR_M))?;
    for (axis, size) in air.size_m.iter().enumerate() {
        check.above_zero(&format!("air.size_m[{axis}]"), *size, 1000.0)?;
    }
    check.each("air.cells", &air.cells, &(2..=256))?;
    let [x, y, z] = air.cells;
    if x * y * z > MAX_CELLS {
        return Err(check.fail("air.cells", format!("{x} x {y} x {z}"), format!("at most {MAX_CELLS} in all")));
    }
    for (axis, (size, cells)) in air.size_m.iter().zip(air.cells).enumerate() {
        let least = MIN_CELL_M * cells as f32;
        if *size < least {
            return Err(check.fail(
                format!("air.size_m[{axis}]"),
                size,
                format!("at least {MIN_CELL_M} m for each cell"),
            ));
        }
    }
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
