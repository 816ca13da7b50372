//! What accelerates the air: buoyancy, and what a caller adds.

use crate::density::Density;
use crate::field::Field;
use crate::grid::Grid;
use crate::limits::{BUOYANCY_RATIO, GRAVITY_M_S2};
use crate::parallel::for_planes;
use crate::sides::Side;

/// Adds the lift of hot air on the faces across y; see [`Density`].
pub(crate) fn buoyancy(grid: &Grid, v: &mut Field, temperature: &Field, density: Density, ambient_k: f32, dt_s: f32) {
    let [nx, ny, _] = grid.cells;
    let (least, most) = BUOYANCY_RATIO;
    let ratio = 0.5 / ambient_k;
    let wraps = grid.sides[1][0] == Side::Periodic;
    for_planes(
        grid.exec,
        &mut v.data,
        nx * (ny + 1),
        #[inline(always)]
        |k, out| {
            let row = |j: usize| &temperature.data[nx * (j + ny * k)..][..nx];
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let is_seam = wraps && (j == 0 || j == ny);
                let (low, high) = if is_seam { (ny - 1, 0) } else { (j.saturating_sub(1), j.min(ny - 1)) };
                let (low, high) = (row(low), row(high));
                let rows = out.iter_mut().zip(low).zip(high);
                match density {
                    Density::Boussinesq => {
                        for ((value, low), high) in rows {
                            *value += dt_s * GRAVITY_M_S2 * ((low + high) * ratio).max(least).min(most);
                        }
                    }
                    Density::DensityRatio => {
                        for ((value, low), high) in rows {
                            let hot = (low + high) * ratio;
                            *value += dt_s * GRAVITY_M_S2 * (hot / (1.0 + hot)).max(least);
                        }
                    }
                    Density::LowMach => {
                        for ((value, low), high) in rows {
                            *value += dt_s * GRAVITY_M_S2 * ((low + high) * ratio);
                        }
                    }
                }
            }
        },
    );
}

/// Adds accelerations that lie on the same faces.
pub(crate) fn accelerate(grid: &Grid, field: &mut Field, acceleration: &[f32], dt_s: f32) {
    let plane = field.plane();
    for_planes(
        grid.exec,
        &mut field.data,
        plane,
        #[inline(always)]
        |k, out| {
            let rates = &acceleration[k * plane..(k + 1) * plane];
            out.iter_mut().zip(rates).for_each(|(value, rate)| *value += dt_s * rate);
        },
    );
}
