//! Divergence and gradient on the staggered grid, and the greatest speeds.

use crate::field::Field;
use crate::grid::Grid;
use crate::lanes::max_abs;
use crate::parallel::{Partial, for_planes, reduce};

/// Subtracts the gradient of the potential on every face whose flow is not fixed.
pub(crate) fn subtract_gradient(grid: &Grid, potential: &[f32], velocity: &mut [Field; 3]) {
    let [nx, ny, nz] = grid.cells;
    let plane = nx * ny;
    let inverse = grid.cell_m.map(|edge| 1.0 / edge);
    let is_open = grid.sides.map(|sides| sides.map(|side| !side.fixes_flow()));
    let [u, v, w] = velocity;
    for_planes(
        grid.exec,
        &mut u.data,
        (nx + 1) * ny,
        #[inline(always)]
        |k, out| {
            let rows = potential[k * plane..(k + 1) * plane].chunks_exact(nx);
            for (out, row) in out.chunks_exact_mut(nx + 1).zip(rows) {
                for (value, pair) in out[1..nx].iter_mut().zip(row.windows(2)) {
                    *value -= (pair[1] - pair[0]) * inverse[0];
                }
                if is_open[0][0] {
                    out[0] -= 2.0 * row[0] * inverse[0];
                }
                if is_open[0][1] {
                    out[nx] += 2.0 * row[nx - 1] * inverse[0];
                }
            }
        },
    );
    for_planes(
        grid.exec,
        &mut v.data,
        nx * (ny + 1),
        #[inline(always)]
        |k, out| {
            let values = &potential[k * plane..(k + 1) * plane];
            let row = |j: usize| &values[j * nx..(j + 1) * nx];
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let (low, high) = (row(j.saturating_sub(1)), row(j.min(ny - 1)));
                subtract_row(out, low, high, inverse[1], j, ny, is_open[1]);
            }
        },
    );
    for_planes(
        grid.exec,
        &mut w.data,
        plane,
        #[inline(always)]
        |k, out| {
            let values = |k: usize| &potential[k * plane..(k + 1) * plane];
            let (low, high) = (values(k.saturating_sub(1)), values(k.min(nz - 1)));
            subtract_row(out, low, high, inverse[2], k, nz, is_open[2]);
        },
    );
}

/// Subtracts the gradient across the faces number `index` of an axis with `count` cells.
#[inline(always)]
fn subtract_row(
    out: &mut [f32],
    low: &[f32],
    high: &[f32],
    inverse_m: f32,
    index: usize,
    count: usize,
    is_open: [bool; 2],
) {
    if index == 0 && is_open[0] {
        out.iter_mut().zip(high).for_each(|(value, high)| *value -= 2.0 * high * inverse_m);
    } else if index == count && is_open[1] {
        out.iter_mut().zip(low).for_each(|(value, low)| *value += 2.0 * low * inverse_m);
    } else if index > 0 && index < count {
        for ((value, low), high) in out.iter_mut().zip(low).zip(high) {
            *value -= (high - low) * inverse_m;
        }
    }
}

/// Divergence of a z-plane of cells, 1/s.
#[inline(always)]
pub(crate) fn divergence_plane(grid: &Grid, velocity: &[Field; 3], k: usize, out: &mut [f32]) {
    let [nx, ny, _] = grid.cells;
    let plane = nx * ny;
    let inverse = grid.cell_m.map(|edge| 1.0 / edge);
    let [u, v, w] = velocity;
    let u_plane = &u.data[k * (nx + 1) * ny..];
    let v_plane = &v.data[k * nx * (ny + 1)..];
    for (j, out) in out.chunks_exact_mut(nx).enumerate() {
        let u_row = &u_plane[j * (nx + 1)..(j + 1) * (nx + 1)];
        let (v_low, v_high) = (&v_plane[j * nx..(j + 1) * nx], &v_plane[(j + 1) * nx..(j + 2) * nx]);
        let at = k * plane + j * nx;
        let (w_low, w_high) = (&w.data[at..at + nx], &w.data[at + plane..at + plane + nx]);
        let (u_low, u_high) = (&u_row[..nx], &u_row[1..]);
        for i in 0..nx {
            out[i] = (u_high[i] - u_low[i]) * inverse[0]
                + (v_high[i] - v_low[i]) * inverse[1]
                + (w_high[i] - w_low[i]) * inverse[2];
        }
    }
}

/// Greatest speed through a face, by axis, m/s.
pub(crate) fn speeds(grid: &Grid, velocity: &[Field; 3], partials: &mut [Partial]) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let field = &velocity[axis];
        let plane = field.plane();
        let largest = |k| Partial { max: max_abs(&field.data[k * plane..(k + 1) * plane]), ..Partial::default() };
        reduce(grid.exec, &mut partials[..field.counts[2]], largest).max
    })
}
