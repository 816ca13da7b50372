//! How density answers to temperature, and what follows for the momentum.

use serde::{Deserialize, Serialize};

use crate::field::Field;
use crate::grid::Grid;
use crate::limits::MAX_EXPANSION_PER_S;
use crate::parallel::{Partial, for_pairs, for_planes, scan_planes};
use crate::sides::Side;
use crate::source::{kelvin_from_share, share_from_kelvin};

/// How density answers to temperature. `T` is the absolute temperature, `T_a` that of ambient air,
/// `dT = T - T_a`; `rho / rho_a = T_a / T` at constant pressure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Density {
    /// Constant but for a lift of `g dT / T_a`, the ratio clamped to -1 to 10 (J. Boussinesq,
    /// 1903). Right for small ratios; at flame temperatures it exaggerates the rise.
    #[default]
    Boussinesq,
    /// Constant but for a lift of `g (1 - rho / rho_a) = g dT / T`: the force on a volume is the
    /// right one, at most g up, and moves as much mass as if the air were cold.
    DensityRatio,
    /// Variable, for flow slow against sound (R. G. Rehm, H. R. Baum, *The Equations of Motion
    /// for Thermally Driven, Buoyant Flows*, J. Research NBS 83, 1978): pressure and weight act
    /// on the mass that is there, `g (rho_a - rho) / rho - grad p / rho`, and air that is heated
    /// expands, `div u = q R / (p c_p)`. The box needs an open side.
    LowMach,
}

/// Turns temperatures above ambient into what is conserved, `dT / T`.
pub(crate) fn to_shares(grid: &Grid, temperature: &mut Field, ambient_k: f32) {
    let plane = grid.plane();
    for_planes(
        grid.exec,
        &mut temperature.data,
        plane,
        #[inline(always)]
        |_, out| out.iter_mut().for_each(|value| *value = share_from_kelvin(*value, ambient_k)),
    );
}

/// Turns `dT / T` back into temperatures above ambient.
pub(crate) fn to_kelvin(grid: &Grid, share: &mut Field, ambient_k: f32) {
    let plane = grid.plane();
    for_planes(
        grid.exec,
        &mut share.data,
        plane,
        #[inline(always)]
        |_, out| out.iter_mut().for_each(|value| *value = kelvin_from_share(*value, ambient_k)),
    );
}

/// Fills `out` with `rho / rho_a`.
pub(crate) fn relative(grid: &Grid, kelvin: &[f32], ambient_k: f32, out: &mut [f32]) {
    for_pairs(
        grid.exec,
        out,
        kelvin,
        grid.plane(),
        #[inline(always)]
        |out, kelvin| *out = ambient_k / (ambient_k + kelvin),
    );
}

/// Adds the expansion of air whose `dT / T` grew from `before` to `after`, 1/s.
pub(crate) fn add_growth(grid: &Grid, expansion: &mut [f32], before: &[f32], after: &[f32], dt_s: f32) {
    let (plane, per_s) = (grid.plane(), 1.0 / dt_s);
    for_planes(
        grid.exec,
        expansion,
        plane,
        #[inline(always)]
        |k, out| {
            let (before, after) = (&before[k * plane..], &after[k * plane..]);
            for ((value, before), after) in out.iter_mut().zip(before).zip(after) {
                *value = (*value + per_s * (after - before)).clamp(-MAX_EXPANSION_PER_S, MAX_EXPANSION_PER_S);
            }
        },
    );
}

/// Multiplies (or divides) four scalars a cell by `rho / rho_a`.
pub(crate) fn weigh(grid: &Grid, pack: &mut [[f32; 4]], kelvin: &[f32], ambient_k: f32, divide: bool) {
    let plane = grid.plane();
    for_planes(
        grid.exec,
        pack,
        plane,
        #[inline(always)]
        |k, out| {
            for (values, kelvin) in out.iter_mut().zip(&kelvin[k * plane..]) {
                let hot = (ambient_k + kelvin) / ambient_k;
                let factor = if divide { hot } else { 1.0 / hot };
                values.iter_mut().for_each(|value| *value *= factor);
            }
        },
    );
}

/// Greatest `rho_a / rho`, at least 1: the weight of the pressure that is solved for.
pub(crate) fn lightest(grid: &Grid, kelvin: &[f32], ambient_k: f32, partials: &mut [Partial]) -> f32 {
    let hottest_k = scan_planes(grid.exec, kelvin, grid.plane(), partials).high;
    1.0 + hottest_k / ambient_k
}

/// What the last step's pressure does beyond the part that is to be solved for: adds
/// `(weight - rho_a / rho) grad P dt`, `P = p / rho_a`. With the weight of the lightest air the
/// sequence of steps converges (M. S. Dodd, A. Ferrante, *A Fast Pressure-Correction Method for
/// Incompressible Two-Fluid Flows*, J. Comput. Phys. 273, 2014).
pub(crate) fn add_baroclinic(
    grid: &Grid,
    velocity: &mut [Field; 3],
    pressure: &[f32],
    kelvin: &[f32],
    ambient_k: f32,
    weight: f32,
    dt_s: f32,
) {
    let [nx, ny, _] = grid.cells;
    let plane = grid.plane();
    let per_k = 0.5 / ambient_k;
    for (axis, field) in velocity.iter_mut().enumerate() {
        let count = grid.cells[axis];
        let scale = dt_s / grid.cell_m[axis];
        let faces = field.plane();
        let ends = grid.sides[axis];
        // Cells below and above a face, and what the difference of their pressures counts.
        let across = move |face: usize| -> Option<(usize, usize, [f32; 2])> {
            let side = match face {
                0 => ends[0],
                _ if face == count => ends[1],
                _ => return Some((face - 1, face, [1.0; 2])),
            };
            match side {
                Side::Periodic => Some((count - 1, 0, [1.0; 2])),
                // Zero on the face, half a cell away.
                Side::Open if face == 0 => Some((0, 0, [0.0, 2.0])),
                Side::Open => Some((count - 1, count - 1, [2.0, 0.0])),
                _ => None,
            }
        };
        for_planes(
            grid.exec,
            &mut field.data,
            faces,
            #[inline(always)]
            |k, out| {
                if axis == 0 {
                    for (j, out) in out.chunks_exact_mut(nx + 1).enumerate() {
                        let at = j * nx + k * plane;
                        let (p, t) = (&pressure[at..at + nx], &kelvin[at..at + nx]);
                        for (i, out) in out[1..nx].iter_mut().enumerate() {
                            let light = 1.0 + (t[i] + t[i + 1]) * per_k;
                            *out += (weight - light) * scale * (p[i + 1] - p[i]);
                        }
                        for face in [0, nx] {
                            if let Some((low, high, by)) = across(face) {
                                let light = 1.0 + (t[low] + t[high]) * per_k;
                                out[face] += (weight - light) * scale * (by[1] * p[high] - by[0] * p[low]);
                            }
                        }
                    }
                    return;
                }
                for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                    let Some((low, high, by)) = across(if axis == 1 { j } else { k }) else { continue };
                    let row = |cell: usize| if axis == 1 { nx * cell + plane * k } else { nx * j + plane * cell };
                    let (low, high) = (row(low), row(high));
                    let (p_low, p_high) = (&pressure[low..low + nx], &pressure[high..high + nx]);
                    let (t_low, t_high) = (&kelvin[low..low + nx], &kelvin[high..high + nx]);
                    for (i, out) in out.iter_mut().enumerate() {
                        let light = 1.0 + (t_low[i] + t_high[i]) * per_k;
                        *out += (weight - light) * scale * (by[1] * p_high[i] - by[0] * p_low[i]);
                    }
                }
                debug_assert!(axis != 1 || out.len() == nx * (ny + 1));
            },
        );
    }
}
