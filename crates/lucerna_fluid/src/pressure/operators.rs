//! Divergence and gradient on the staggered grid.

use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::{Partial, for_planes, scan_planes};
use crate::sides::Side;

use super::mask::Mask;

/// Values handled together.
const LANES: usize = 8;

/// The arrays of the three components.
pub(crate) fn slices(velocity: &[Field; 3]) -> [&[f32]; 3] {
    velocity.each_ref().map(|field| field.data.as_slice())
}

/// Divergence of a z-plane of cells, 1/s.
#[inline(always)]
pub(crate) fn divergence_plane(grid: &Grid, velocity: [&[f32]; 3], k: usize, out: &mut [f32]) {
    let [nx, ny, _] = grid.cells;
    let plane = nx * ny;
    let inverse = grid.cell_m.map(|edge| 1.0 / edge);
    let [u, v, w] = velocity;
    let u_plane = &u[k * (nx + 1) * ny..];
    let v_plane = &v[k * nx * (ny + 1)..];
    let (w_low, w_high) = (&w[k * plane..(k + 1) * plane], &w[(k + 1) * plane..(k + 2) * plane]);
    for (j, out) in out.chunks_exact_mut(nx).enumerate() {
        let row = j * nx..(j + 1) * nx;
        let u_row = &u_plane[j * (nx + 1)..(j + 1) * (nx + 1)];
        let (v_low, v_high) = (&v_plane[row.clone()], &v_plane[(j + 1) * nx..(j + 2) * nx]);
        let pairs = [[&u_row[..nx], &u_row[1..]], [v_low, v_high], [&w_low[row.clone()], &w_high[row]]];
        let mut first = 0;
        while let Some(last) = nx.checked_sub(LANES)
            && first < nx
        {
            // The last lanes reach back over values that are already there.
            first = first.min(last);
            let mut sums = [0.0_f32; LANES];
            for ([low, high], inverse) in pairs.iter().zip(inverse) {
                for lane in 0..LANES {
                    sums[lane] += (high[first..first + LANES][lane] - low[first..first + LANES][lane]) * inverse;
                }
            }
            out[first..first + LANES].copy_from_slice(&sums);
            first += LANES;
        }
        if nx < LANES {
            for (i, out) in out.iter_mut().enumerate() {
                *out = pairs
                    .iter()
                    .zip(inverse)
                    .fold(0.0, |sum, ([low, high], inverse)| sum + (high[i] - low[i]) * inverse);
            }
        }
    }
}

/// Subtracts the gradient of the potential on every face whose flow is not given. With a mask
/// faces next to solid cells keep what they have.
pub(crate) fn subtract_gradient(grid: &Grid, potential: &[f32], mask: Option<&Mask>, velocity: [&mut [f32]; 3]) {
    let [nx, ny, nz] = grid.cells;
    let plane = nx * ny;
    let inverse = grid.cell_m.map(|edge| 1.0 / edge);
    let [u, v, w] = velocity;
    let weights = |axis: usize, range: std::ops::Range<usize>| mask.map(|mask| &mask.weights(axis)[range]);
    for_planes(
        grid.exec,
        u,
        (nx + 1) * ny,
        #[inline(always)]
        |k, out| {
            let values = &potential[k * plane..(k + 1) * plane];
            for (j, out) in out.chunks_exact_mut(nx + 1).enumerate() {
                let row = &values[j * nx..(j + 1) * nx];
                let weights = weights(0, (j + ny * k) * (nx + 1)..(j + 1 + ny * k) * (nx + 1));
                subtract(
                    &mut out[1..nx],
                    &row[..nx - 1],
                    &row[1..],
                    inverse[0],
                    weights.map(|weights| &weights[1..nx]),
                );
                let ends = [row[0], row[nx - 1]];
                let [low, high] = end_steps(grid.sides[0], ends, weights.map(|weights| [weights[0], weights[nx]]));
                out[0] -= low * inverse[0];
                out[nx] -= high * inverse[0];
            }
        },
    );
    for_planes(
        grid.exec,
        v,
        nx * (ny + 1),
        #[inline(always)]
        |k, out| {
            let values = &potential[k * plane..(k + 1) * plane];
            let start = k * nx * (ny + 1);
            let inner = nx..nx * ny;
            let inner_weights = weights(1, start + inner.start..start + inner.end);
            subtract(&mut out[inner], &values[..plane - nx], &values[nx..], inverse[1], inner_weights);
            let rows = [&values[..nx], &values[plane - nx..]];
            let (low, high) = out.split_at_mut(nx * ny);
            let low_weights = weights(1, start..start + nx);
            subtract_end(&mut low[..nx], rows, grid.sides[1], 0, inverse[1], low_weights);
            subtract_end(high, rows, grid.sides[1], 1, inverse[1], weights(1, start + plane..start + plane + nx));
        },
    );
    let planes = [&potential[..plane], &potential[(nz - 1) * plane..]];
    for_planes(
        grid.exec,
        w,
        plane,
        #[inline(always)]
        |k, out| {
            let weights = weights(2, k * plane..(k + 1) * plane);
            if k > 0 && k < nz {
                let (low, high) = (&potential[(k - 1) * plane..k * plane], &potential[k * plane..(k + 1) * plane]);
                subtract(out, low, high, inverse[2], weights);
            } else {
                subtract_end(out, planes, grid.sides[2], usize::from(k > 0), inverse[2], weights);
            }
        },
    );
}

/// Steps of the potential across the faces at the two ends of a line, from its first and last value.
#[inline(always)]
fn end_steps(sides: [Side; 2], [first, last]: [f32; 2], weights: Option<[f32; 2]>) -> [f32; 2] {
    let [low, high] = weights.unwrap_or(end_weights(sides));
    if sides[0] == Side::Periodic { [low * (first - last); 2] } else { [low * first, -(high * last)] }
}

/// How strongly the pressure acts on the faces at the ends; see [`Mask::weights`].
#[inline(always)]
pub(crate) fn end_weights(sides: [Side; 2]) -> [f32; 2] {
    sides.map(|side| match side {
        Side::Open => 2.0,
        Side::Periodic => 1.0,
        _ => 0.0,
    })
}

/// As [`subtract`], on the faces at one end of the lines whose first and last values are `ends`.
#[inline(always)]
fn subtract_end(
    out: &mut [f32],
    ends: [&[f32]; 2],
    sides: [Side; 2],
    end: usize,
    inverse_m: f32,
    weights: Option<&[f32]>,
) {
    if weights.is_none() && end_weights(sides)[end] == 0.0 {
        return;
    }
    for (i, ((out, first), last)) in out.iter_mut().zip(ends[0]).zip(ends[1]).enumerate() {
        let steps = end_steps(sides, [*first, *last], weights.map(|weights| [weights[i]; 2]));
        *out -= steps[end] * inverse_m;
    }
}

/// Subtracts differences between `high` and `low` from `out`, weighted.
#[inline(always)]
fn subtract(out: &mut [f32], low: &[f32], high: &[f32], inverse_m: f32, weights: Option<&[f32]>) {
    let count = out.len();
    let (low, high) = (&low[..count], &high[..count]);
    let Some(last) = count.checked_sub(LANES) else {
        for i in 0..count {
            let step = (high[i] - low[i]) * inverse_m;
            out[i] -= weights.map_or(step, |weights| weights[i] * step);
        }
        return;
    };
    // The last lanes overlap those before them: find them first.
    let mut tail = [0.0; LANES];
    tail.copy_from_slice(&out[last..]);
    let (mut low_tail, mut high_tail) = ([0.0; LANES], [0.0; LANES]);
    low_tail.copy_from_slice(&low[last..]);
    high_tail.copy_from_slice(&high[last..]);
    let ((chunks, _), (lows, _), (highs, _)) =
        (out.as_chunks_mut::<LANES>(), low.as_chunks::<LANES>(), high.as_chunks::<LANES>());
    if let Some(weights) = weights {
        let mut weight_tail = [0.0; LANES];
        weight_tail.copy_from_slice(&weights[last..count]);
        let (weights, _) = weights.as_chunks::<LANES>();
        for (((out, low), high), weights) in chunks.iter_mut().zip(lows).zip(highs).zip(weights) {
            for lane in 0..LANES {
                out[lane] -= weights[lane] * ((high[lane] - low[lane]) * inverse_m);
            }
        }
        for lane in 0..LANES {
            tail[lane] -= weight_tail[lane] * ((high_tail[lane] - low_tail[lane]) * inverse_m);
        }
    } else {
        for ((out, low), high) in chunks.iter_mut().zip(lows).zip(highs) {
            for lane in 0..LANES {
                out[lane] -= (high[lane] - low[lane]) * inverse_m;
            }
        }
        for lane in 0..LANES {
            tail[lane] -= (high_tail[lane] - low_tail[lane]) * inverse_m;
        }
    }
    out[last..].copy_from_slice(&tail);
}

/// Greatest speed through a face, by axis, m/s.
pub(crate) fn speeds(grid: &Grid, velocity: &[Field; 3], partials: &mut [Partial]) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let field = &velocity[axis];
        scan_planes(grid.exec, &field.data, field.plane(), partials).greatest()
    })
}
