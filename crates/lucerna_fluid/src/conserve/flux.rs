//! What passes the faces of the cells, and what is left in them.
//!
//! Values at the faces are upwind ones with van Leer's limited slope ("monotonized central", J.
//! Comput. Phys. 23, 1977). In a step of Euler's no new extreme appears where half of a cell's air,
//! or less, leaves it.

use super::padded::{Shape, for_rows};
use crate::grid::Grid;
use crate::limits::MAX_AXIS_CELLS;
use crate::parallel::{Partial, for_planes, reduce};

/// The value at the face between `low` and `high`, where the index rises with the flow if `is_up`.
#[inline(always)]
fn face_value(is_up: bool, [before, low, high, after]: [f32; 4]) -> f32 {
    let upwind = if is_up { low } else { high };
    let behind = if is_up { low - before } else { high - after };
    let ahead = if is_up { high - low } else { low - high };
    // The least in size of twice either difference and of their mean; zero at an extreme.
    let (size_behind, size_ahead) = (behind.abs(), ahead.abs());
    let steepest = 2.0 * if size_behind < size_ahead { size_behind } else { size_ahead };
    let mean = 0.5 * (behind + ahead).abs();
    let slope = if mean < steepest { mean } else { steepest };
    let slope = if behind * ahead > 0.0 { slope } else { 0.0 };
    upwind + (0.5 * slope).copysign(ahead)
}

/// Fills `out` with `flow` times the values at the faces across `axis`. All arrays are padded.
pub(super) fn fluxes(grid: &Grid, shape: Shape, axis: usize, flow: &[f32], values: &[f32], out: &mut [f32]) {
    let stride = shape.strides[axis];
    for_rows(
        grid,
        shape,
        grid.face_counts(axis),
        out,
        #[inline(always)]
        |at, _, out| {
            let nx = out.len();
            let flow = &flow[at..at + nx];
            let before = &values[at - 2 * stride..][..nx];
            let low = &values[at - stride..][..nx];
            let high = &values[at..][..nx];
            let after = &values[at + stride..][..nx];
            for i in 0..nx {
                out[i] = flow[i] * face_value(flow[i] > 0.0, [before[i], low[i], high[i], after[i]]);
            }
        },
    );
}

/// Turns the flux of what gas lacks of ambient density into that of mass, `flow - flux`, over
/// ambient density. Both are padded.
pub(super) fn mass_from_share(grid: &Grid, shape: Shape, axis: usize, flow: &[f32], flux: &mut [f32]) {
    for_rows(
        grid,
        shape,
        grid.face_counts(axis),
        flux,
        #[inline(always)]
        |at, _, out| {
            for (out, flow) in out.iter_mut().zip(&flow[at..]) {
                *out = flow - *out;
            }
        },
    );
}

/// Adds `-dt div fluxes` to cells, and keeps the result within two bounds. With `kept`, padded
/// values and the flow that carried them, what the flow's divergence makes of them is left out.
pub(super) fn add_fluxes(
    grid: &Grid,
    shape: Shape,
    fluxes: &[Vec<f32>; 3],
    kept: Option<(&[f32], &[Vec<f32>; 3])>,
    dt_s: f32,
    [least, most]: [f32; 2],
    out: &mut [f32],
) {
    let nx = grid.cells[0];
    let per_m = grid.cell_m.map(|edge| dt_s / edge);
    for_planes(
        grid.exec,
        out,
        grid.plane(),
        #[inline(always)]
        |k, out| {
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let at = shape.at([0, j, k]);
                for axis in [1, 0, 2] {
                    let (low, high) = (&fluxes[axis][at..], &fluxes[axis][at + shape.strides[axis]..]);
                    let (low, high, by) = (&low[..nx], &high[..nx], per_m[axis]);
                    if let Some((values, flow)) = kept {
                        let values = &values[at..at + nx];
                        let (flow_low, flow_high) = (&flow[axis][at..], &flow[axis][at + shape.strides[axis]..]);
                        let (flow_low, flow_high) = (&flow_low[..nx], &flow_high[..nx]);
                        for i in 0..nx {
                            out[i] += by * (values[i] * (flow_high[i] - flow_low[i]));
                        }
                    }
                    for i in 0..nx {
                        out[i] -= by * (high[i] - low[i]);
                    }
                }
                for value in out {
                    *value = if *value > least { *value } else { least };
                    *value = if *value < most { *value } else { most };
                }
            }
        },
    );
}

/// The greatest share of a cell's size that air goes through it in `dt_s`, by the sum over the axes
/// of the faster of the two faces. `flow` is padded.
pub(super) fn courant(grid: &Grid, shape: Shape, flow: &[Vec<f32>; 3], dt_s: f32, partials: &mut [Partial]) -> f32 {
    let nx = grid.cells[0];
    let per_m = grid.cell_m.map(|edge| dt_s / edge);
    let planes = grid.cells[2];
    reduce(grid.exec, &mut partials[..planes], |k| {
        let high = grid.exec.simd.run(
            #[inline(always)]
            || {
                let mut most = [0.0_f32; MAX_AXIS_CELLS];
                let most = &mut most[..nx];
                let mut sums = [0.0_f32; MAX_AXIS_CELLS];
                let sums = &mut sums[..nx];
                for j in 0..grid.cells[1] {
                    let at = shape.at([0, j, k]);
                    sums.fill(0.0);
                    for axis in 0..3 {
                        let (low, high) = (&flow[axis][at..], &flow[axis][at + shape.strides[axis]..]);
                        let (low, high, by) = (&low[..nx], &high[..nx], per_m[axis]);
                        for i in 0..nx {
                            let (low, high) = (low[i].abs(), high[i].abs());
                            sums[i] += by * if low > high { low } else { high };
                        }
                    }
                    for i in 0..nx {
                        most[i] = if sums[i] > most[i] { sums[i] } else { most[i] };
                    }
                }
                most.iter().fold(0.0_f32, |most, one| most.max(*one))
            },
        );
        Partial { high, ..Partial::default() }
    })
    .high
}
