//! Semi-Lagrangian advection: every value comes from where its air was one step ago.
//!
//! The way back is traced once per cell with the midpoint rule; faces take the mean of the two
//! cells beside them. What comes through a side that lets air in has the outside's value.

use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::{Partial, for_planes, reduce_planes};
use crate::sides::Side;

/// Fills `trace` with the way, in cells, that the air of each cell went during `dt_s`.
pub(crate) fn trace_back(grid: &Grid, velocity: &[Field; 3], dt_s: f32, trace: &mut [[f32; 3]]) {
    let [nx, ny, _] = grid.cells;
    let cells_per_speed = grid.cell_m.map(|edge| dt_s / edge);
    let [u, v, w] = velocity;
    let plane = grid.plane();
    for_planes(grid.is_parallel, trace, plane, |k, out| {
        for (j, out) in out.chunks_exact_mut(nx).enumerate() {
            let u_at = (nx + 1) * (j + ny * k);
            let u_row = &u.data[u_at..u_at + nx + 1];
            let v_at = nx * (j + (ny + 1) * k);
            let (v_low, v_high) = (&v.data[v_at..v_at + nx], &v.data[v_at + nx..v_at + 2 * nx]);
            let w_at = nx * (j + ny * k);
            let (w_low, w_high) = (&w.data[w_at..w_at + nx], &w.data[w_at + plane..w_at + plane + nx]);
            for (i, out) in out.iter_mut().enumerate() {
                // Half a step back with the velocity at the centre: a quarter of the faces' sum.
                let middle = [
                    i as f32 + 0.5 - 0.25 * cells_per_speed[0] * (u_row[i] + u_row[i + 1]),
                    j as f32 + 0.5 - 0.25 * cells_per_speed[1] * (v_low[i] + v_high[i]),
                    k as f32 + 0.5 - 0.25 * cells_per_speed[2] * (w_low[i] + w_high[i]),
                ];
                *out = [
                    cells_per_speed[0] * u.sample(middle),
                    cells_per_speed[1] * v.sample(middle),
                    cells_per_speed[2] * w.sample(middle),
                ];
            }
        }
    });
}

/// Fills `out` with `field` carried along `trace`. `axis` is the one that the field's faces lie
/// across, none at cell centres; `outside` is what comes in. Returns as `sum` what the
/// inflow brings of `outside²`.
pub(crate) fn advect(
    grid: &Grid,
    field: &Field,
    axis: Option<usize>,
    trace: &[[f32; 3]],
    outside: f32,
    out: &mut Field,
    partials: &mut [Partial],
) -> f64 {
    let [cx, cy, cz] = grid.cells;
    let [nx, _, _] = field.counts;
    let lets_in = grid.sides.map(|sides| sides.map(Side::lets_in));
    let back = |across: usize, index: usize| if axis == Some(across) { index.saturating_sub(1) } else { index };
    let plane = out.plane();
    let brought = reduce_planes(grid.is_parallel, &mut out.data, plane, partials, |k, out| {
        let (k_low, k_high) = (back(2, k), k.min(cz - 1));
        let mut inflow = 0.0_f64;
        for (j, out) in out.chunks_exact_mut(nx).enumerate() {
            let (j_low, j_high) = (back(1, j), j.min(cy - 1));
            let low_row = &trace[cx * (j_low + cy * k_low)..][..cx];
            let high_row = &trace[cx * (j_high + cy * k_high)..][..cx];
            for (i, out) in out.iter_mut().enumerate() {
                let (low, high) = (low_row[back(0, i)], high_row[i.min(cx - 1)]);
                let from = [
                    i as f32 - 0.5 * (low[0] + high[0]),
                    j as f32 - 0.5 * (low[1] + high[1]),
                    k as f32 - 0.5 * (low[2] + high[2]),
                ];
                let inside = field.sample_lattice(from);
                let share = outside_share(from, field.counts, lets_in);
                *out = inside + share * (outside - inside);
                inflow += f64::from(share);
            }
        }
        Partial { sum: inflow, ..Partial::default() }
    });
    brought.sum * f64::from(outside) * f64::from(outside)
}

/// How much of a sample comes from outside: nothing on the lattice, all of it one cell beyond.
#[inline]
fn outside_share(at: [f32; 3], counts: [usize; 3], lets_in: [[bool; 2]; 3]) -> f32 {
    let mut inside = 1.0_f32;
    for axis in 0..3 {
        let last = (counts[axis] - 1) as f32;
        if at[axis] < 0.0 && lets_in[axis][0] {
            inside *= (1.0 + at[axis]).max(0.0);
        } else if at[axis] > last && lets_in[axis][1] {
            inside *= (1.0 + last - at[axis]).max(0.0);
        }
    }
    1.0 - inside
}
