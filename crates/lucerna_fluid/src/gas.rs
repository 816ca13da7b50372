//! How viscosity and conductivity of gases grow with temperature.

use crate::grid::Grid;
use crate::parallel::for_planes;

/// Power of the absolute temperature with which the kinematic viscosity of air grows, and its thermal diffusivity: 0.7 for
/// the dynamic one (power law of F. White, *Viscous Fluid Flow*, section 1-3), 1 for the density. From 293 to 2000 K it is
/// within 5 % of both as computed from the transport data of GRI-Mech 3.0.
const POWER: f32 = 1.7;

/// Adds to diffusivities by cell (made if there are none) what hot gas has beyond cold one, m²/s: `at_ambient` times
/// `(T / T_a)^1.7 - 1`; nothing below ambient temperature.
pub(crate) fn add_of_hot_gas(
    grid: &Grid,
    out: &mut Vec<f32>,
    has_eddies: bool,
    (kelvin, ambient_k): (&[f32], f32),
    at_ambient: f32,
) {
    if !has_eddies {
        out.clear();
    }
    out.resize(grid.count(), 0.0);
    let plane = grid.plane();
    for_planes(grid.exec, out, plane, |k, out| {
        for (value, kelvin) in out.iter_mut().zip(&kelvin[k * plane..]) {
            if *kelvin > 1.0 {
                *value += at_ambient * ((1.0 + kelvin / ambient_k).powf(POWER) - 1.0);
            }
        }
    });
}
