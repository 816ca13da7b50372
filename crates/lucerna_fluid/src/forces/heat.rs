//! Heating and cooling of every cell.

use crate::field::Field;
use crate::grid::Grid;
use crate::limits::MAX_TEMPERATURE_K;
use crate::parallel::for_planes;

/// Heats by `heat` (K/s), cools by the exact exponential of `cooling_per_s`, and clamps.
pub(crate) fn heat_and_cool(
    grid: &Grid,
    temperature: &mut Field,
    heat: Option<&[f32]>,
    cooling_per_s: f32,
    lowest_k: f32,
    dt_s: f32,
) {
    let plane = grid.plane();
    let keep = (-cooling_per_s * dt_s).exp();
    for_planes(
        grid.exec,
        &mut temperature.data,
        plane,
        #[inline(always)]
        |k, out| {
            if let Some(heat) = heat {
                let rates = &heat[k * plane..(k + 1) * plane];
                for (value, rate) in out.iter_mut().zip(rates) {
                    *value = (*value + dt_s * rate).max(lowest_k).min(MAX_TEMPERATURE_K);
                }
            }
            if keep != 1.0 {
                out.iter_mut().for_each(|value| *value *= keep);
            }
        },
    );
}
