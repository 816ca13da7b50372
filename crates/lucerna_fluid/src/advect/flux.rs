//! Transport of heat through the faces, upwind (R. Courant, E. Isaacson, M. Rees, 1952).
//!
//! What enters a cell pushes out as much of what was in it. In a flow free of divergence this
//! keeps the total heat exactly, which no back-trace does: a trace from a stagnation point on a
//! heated floor finds only itself, and heats up for ever. New values lie between old ones.

use crate::field::Field;
use crate::grid::Grid;
use crate::lanes::max_abs;
use crate::limits::{MAX_AXIS_CELLS, MAX_HEAT_STEPS};
use crate::parallel::{Partial, for_planes, reduce_planes};

/// Beyond the sides the air is at ambient temperature.
const AMBIENT: [f32; MAX_AXIS_CELLS] = [0.0; MAX_AXIS_CELLS];

/// Carries `temperature` for `dt_s`, in as many parts as stability asks for: no cell's air may be
/// exchanged more than once a part. A step that would need more than [`MAX_HEAT_STEPS`] parts
/// carries the heat only as far as that many do. `spare` is of the same shape.
pub(crate) fn transport(
    grid: &Grid,
    velocity: &[Field; 3],
    dt_s: f32,
    temperature: &mut Field,
    spare: &mut Field,
    partials: &mut [Partial],
) {
    let per_speed = grid.cell_m.map(|edge| dt_s / edge);
    let exchanged = reduce_planes(
        grid.exec,
        &mut spare.data,
        grid.plane(),
        partials,
        #[inline(always)]
        |k, out| {
            inflow_plane(grid, velocity, per_speed, k, out);
            Partial { max: max_abs(out), ..Partial::default() }
        },
    );
    let exchanged = exchanged.max;
    // Below one, so that rounding cannot overshoot.
    let parts = (exchanged / 0.99).ceil().clamp(1.0, MAX_HEAT_STEPS);
    let scale = (1.0 / parts).min(0.99 / exchanged.max(1.0e-30));
    let per_speed = per_speed.map(|per_speed| per_speed * scale);
    for _ in 0..parts as usize {
        let from: &Field = temperature;
        for_planes(
            grid.exec,
            &mut spare.data,
            grid.plane(),
            #[inline(always)]
            |k, out| {
                carry_plane(grid, velocity, per_speed, from, k, out);
            },
        );
        std::mem::swap(temperature, spare);
    }
}

/// The rows of velocities around a row of cells: low and high faces along x, y and z.
#[inline(always)]
fn face_rows<'a>(grid: &Grid, velocity: &'a [Field; 3], j: usize, k: usize) -> [&'a [f32]; 6] {
    let [nx, ny, _] = grid.cells;
    let [u, v, w] = velocity;
    let u_row = &u.data[(nx + 1) * (j + ny * k)..][..nx + 1];
    let v_at = nx * (j + (ny + 1) * k);
    let w_at = nx * (j + ny * k);
    let w_high = &w.data[w_at + grid.plane()..][..nx];
    [&u_row[..nx], &u_row[1..], &v.data[v_at..][..nx], &v.data[v_at + nx..][..nx], &w.data[w_at..][..nx], w_high]
}

/// Fills `out` with the share of each cell's air that enters it.
#[inline(always)]
fn inflow_plane(grid: &Grid, velocity: &[Field; 3], per_speed: [f32; 3], k: usize, out: &mut [f32]) {
    for (j, out) in out.chunks_exact_mut(grid.cells[0]).enumerate() {
        let [u_low, u_high, v_low, v_high, w_low, w_high] = face_rows(grid, velocity, j, k);
        for i in 0..grid.cells[0] {
            out[i] = per_speed[0] * (positive(u_low[i]) + positive(-u_high[i]))
                + per_speed[1] * (positive(v_low[i]) + positive(-v_high[i]))
                + per_speed[2] * (positive(w_low[i]) + positive(-w_high[i]));
        }
    }
}

/// Carries one plane.
#[inline(always)]
fn carry_plane(grid: &Grid, velocity: &[Field; 3], per_speed: [f32; 3], from: &Field, k: usize, out: &mut [f32]) {
    let [nx, ny, nz] = grid.cells;
    let row = |j: usize, k: usize| &from.data[nx * (j + ny * k)..][..nx];
    let ambient = &AMBIENT[..nx];
    for (j, out) in out.chunks_exact_mut(nx).enumerate() {
        let [u_low, u_high, v_low, v_high, w_low, w_high] = face_rows(grid, velocity, j, k);
        let here = row(j, k);
        let below = if j > 0 { row(j - 1, k) } else { ambient };
        let above = if j + 1 < ny { row(j + 1, k) } else { ambient };
        let behind = if k > 0 { row(j, k - 1) } else { ambient };
        let before = if k + 1 < nz { row(j, k + 1) } else { ambient };
        for i in 0..nx {
            let value = here[i];
            out[i] = value
                + per_speed[1] * (positive(v_low[i]) * (below[i] - value) + positive(-v_high[i]) * (above[i] - value))
                + per_speed[2]
                    * (positive(w_low[i]) * (behind[i] - value) + positive(-w_high[i]) * (before[i] - value));
        }
        // The ends of the row; their neighbours outside are at ambient temperature, zero.
        out[0] -= per_speed[0] * positive(u_low[0]) * here[0];
        out[nx - 1] -= per_speed[0] * positive(-u_high[nx - 1]) * here[nx - 1];
        let (low, high) = (&here[..nx - 1], &here[1..]);
        for i in 0..nx - 1 {
            out[i] += per_speed[0] * positive(-u_high[i]) * (high[i] - low[i]);
        }
        for i in 0..nx - 1 {
            out[i + 1] += per_speed[0] * positive(u_low[i + 1]) * (low[i] - high[i]);
        }
    }
}

#[inline(always)]
fn positive(value: f32) -> f32 {
    if value > 0.0 { value } else { 0.0 }
}
