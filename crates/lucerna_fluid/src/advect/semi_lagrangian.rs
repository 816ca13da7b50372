//! Semi-Lagrangian advection of velocity: every value comes from where its air was one step ago.
//!
//! The way back is traced once per cell with the midpoint rule; faces take the mean of the two
//! cells beside them. What comes through a side that lets air in has the outside's value.

use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::{Partial, for_planes, reduce_planes};
use crate::sides::Side;

/// Values handled together.
pub(super) const LANES: usize = 8;
pub(super) type Lanes = [f32; LANES];

/// Fills `trace` with the way, in cells, that the air of each cell went during `dt_s`: for each
/// z-plane the x parts of its cells, then the y parts, then the z parts.
pub(crate) fn trace_back(grid: &Grid, velocity: &[Field; 3], dt_s: f32, trace: &mut [f32]) {
    let [nx, ny, _] = grid.cells;
    let per_speed = grid.cell_m.map(|edge| dt_s / edge);
    let [u, v, w] = velocity;
    let plane = grid.plane();
    for_planes(
        grid.exec,
        trace,
        3 * plane,
        #[inline(always)]
        |k, out| {
            for j in 0..ny {
                let u_row = &u.data[(nx + 1) * (j + ny * k)..][..nx + 1];
                let v_rows = &v.data[nx * (j + (ny + 1) * k)..][..2 * nx];
                let (v_low, v_high) = v_rows.split_at(nx);
                let w_low = &w.data[nx * j + plane * k..][..nx];
                let w_high = &w.data[nx * j + plane * (k + 1)..][..nx];
                for first in (0..nx).step_by(LANES) {
                    // Half a step back with the velocity at the centre: a quarter of the faces' sum.
                    let (u_low, u_high) = (load(u_row, first, 0), load(&u_row[1..], first, 0));
                    let x = centres(first as f32, 1.0, 0.25 * per_speed[0], u_low, u_high);
                    let (v_low, v_high) = (load(v_low, first, 0), load(v_high, first, 0));
                    let y = centres(j as f32, 0.0, 0.25 * per_speed[1], v_low, v_high);
                    let (w_low, w_high) = (load(w_low, first, 0), load(w_high, first, 0));
                    let z = centres(k as f32, 0.0, 0.25 * per_speed[2], w_low, w_high);
                    // `x`, `y` and `z` count from the centre of cell (0,0,0); faces begin half a cell before.
                    let ways = [
                        u.sample_lanes([x.map(|at| at + 0.5), y, z]),
                        v.sample_lanes([x, y.map(|at| at + 0.5), z]),
                        w.sample_lanes([x, y, z.map(|at| at + 0.5)]),
                    ];
                    for axis in 0..3 {
                        let row = &mut out[axis * plane + j * nx..][..nx];
                        let way = ways[axis].map(|speed| speed * per_speed[axis]);
                        store(&mut row[first..], way);
                    }
                }
            }
        },
    );
}

/// Places that start at `first`, `spacing` apart, less `scale` times the sum of two velocities.
#[inline(always)]
fn centres(first: f32, spacing: f32, scale: f32, low: Lanes, high: Lanes) -> Lanes {
    let mut out = [0.0; LANES];
    for lane in 0..LANES {
        out[lane] = (first + spacing * lane as f32) - scale * (low[lane] + high[lane]);
    }
    out
}

/// Eight values of a row from `first - back` on; those beyond its ends repeat the end's.
#[inline(always)]
pub(super) fn load(row: &[f32], first: usize, back: usize) -> Lanes {
    if first >= back
        && let Some(values) = row[first - back..].first_chunk::<LANES>()
    {
        return *values;
    }
    std::array::from_fn(|lane| row[(first + lane).saturating_sub(back).min(row.len() - 1)])
}

/// Writes as many of the values as there is room for.
#[inline(always)]
fn store(out: &mut [f32], values: Lanes) {
    if let Some(chunk) = out.first_chunk_mut::<LANES>() {
        *chunk = values;
    } else {
        out.iter_mut().zip(values).for_each(|(out, value)| *out = value);
    }
}

/// Fills `out` with `field`, the velocity component across the faces of `axis`, carried along
/// `trace`; `outside` is what comes in. Returns the sum of squares that the inflow brings.
pub(crate) fn advect(
    grid: &Grid,
    field: &Field,
    axis: usize,
    trace: &[f32],
    outside: f32,
    out: &mut Field,
    partials: &mut [Partial],
) -> f64 {
    let [cx, cy, cz] = grid.cells;
    let [nx, _, _] = field.counts;
    let lets_in = grid.sides.map(|sides| sides.map(Side::lets_in));
    let has_inflow = lets_in.iter().flatten().any(|lets_in| *lets_in);
    let back = [0, 1, 2].map(|across| usize::from(across == axis));
    let (plane, cell_plane) = (out.plane(), grid.plane());
    let brought = reduce_planes(
        grid.exec,
        &mut out.data,
        plane,
        partials,
        #[inline(always)]
        |k, out| {
            let (k_low, k_high) = (k.saturating_sub(back[2]), k.min(cz - 1));
            let mut inflow = 0.0_f64;
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let (j_low, j_high) = (j.saturating_sub(back[1]), j.min(cy - 1));
                let rows = |k: usize, j: usize| {
                    let plane = &trace[3 * cell_plane * k..][..3 * cell_plane];
                    [0, 1, 2].map(|across| &plane[across * cell_plane + cx * j..][..cx])
                };
                let (low, high) = (rows(k_low, j_low), rows(k_high, j_high));
                for first in (0..nx).step_by(LANES) {
                    let from = [
                        centres(first as f32, 1.0, 0.5, load(low[0], first, back[0]), load(high[0], first, 0)),
                        centres(j as f32, 0.0, 0.5, load(low[1], first, back[0]), load(high[1], first, 0)),
                        centres(k as f32, 0.0, 0.5, load(low[2], first, back[0]), load(high[2], first, 0)),
                    ];
                    let mut samples = field.sample_lanes(from);
                    if has_inflow {
                        let shares = outside_shares(from, field.counts, lets_in);
                        for (sample, share) in samples.iter_mut().zip(shares) {
                            *sample += share * (outside - *sample);
                        }
                        inflow += f64::from(shares.iter().take(nx - first).sum::<f32>());
                    }
                    store(&mut out[first..], samples);
                }
            }
            Partial { sum: inflow, ..Partial::default() }
        },
    );
    brought.sum * f64::from(outside) * f64::from(outside)
}

/// How much of each sample comes from outside: nothing on the lattice, all of it from one cell
/// beyond on, where the air outside begins.
#[inline(always)]
pub(super) fn outside_shares(at: [Lanes; 3], counts: [usize; 3], lets_in: [[bool; 2]; 3]) -> Lanes {
    let mut inside = [1.0_f32; LANES];
    for axis in 0..3 {
        let last = (counts[axis] - 1) as f32;
        let [low, high] = lets_in[axis].map(|lets_in| if lets_in { 1.0 } else { 0.0 });
        for (inside, at) in inside.iter_mut().zip(at[axis]) {
            let below = if at < 0.0 { -at * low } else { 0.0 };
            let above = if at > last { (at - last) * high } else { 0.0 };
            let left = 1.0 - below - above;
            *inside *= if left > 0.0 { left } else { 0.0 };
        }
    }
    inside.map(|inside| 1.0 - inside)
}
