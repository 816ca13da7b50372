//! The second half of Heun's method: means of start and end.

use super::padded::Shape;
use crate::grid::Grid;
use crate::parallel::{for_pairs, for_planes};

/// Makes a velocity component the mean of `start` and itself, weighted by the densities that go
/// with them; `shares`, padded, are `1 - rho / rho_a` at the start and at the end.
pub(super) fn mean_by_mass(
    grid: &Grid,
    shape: Shape,
    axis: usize,
    start: &[f32],
    shares: [&[f32]; 2],
    out: &mut [f32],
) {
    let [nx, ny, _] = grid.face_counts(axis);
    let own = shape.strides[axis];
    for_planes(
        grid.exec,
        out,
        nx * ny,
        #[inline(always)]
        |k, out| {
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let at = shape.at([0, j, k]);
                let (a, b) = (&shares[0][at - own..][..nx], &shares[0][at..][..nx]);
                let (c, d) = (&shares[1][at - own..][..nx], &shares[1][at..][..nx]);
                let start = &start[nx * (j + ny * k)..][..nx];
                for i in 0..nx {
                    let (before, after) = (2.0 - (a[i] + b[i]), 2.0 - (c[i] + d[i]));
                    // Written so that a uniform velocity stays what it is.
                    out[i] = start[i] + (out[i] - start[i]) * (after / (before + after));
                }
            }
        },
    );
}

/// Makes values the mean of `start` and themselves.
pub(super) fn mean(grid: &Grid, start: &[f32], out: &mut [f32]) {
    for_pairs(
        grid.exec,
        out,
        start,
        grid.plane(),
        #[inline(always)]
        |out, start| *out = 0.5 * (*out + start),
    );
}

/// As [`mean`], for four scalars a cell.
pub(super) fn mean_of_packs(grid: &Grid, start: &[[f32; 4]], out: &mut [[f32; 4]]) {
    for_pairs(
        grid.exec,
        out,
        start,
        grid.plane(),
        #[inline(always)]
        |out, start| {
            for at in 0..4 {
                out[at] = 0.5 * (out[at] + start[at]);
            }
        },
    );
}

/// Makes `out` the difference `now - start` of fields of one shape, a plane at a time.
pub(super) fn difference(grid: &Grid, plane: usize, now: &[f32], start: &[f32], out: &mut [f32]) {
    for_planes(
        grid.exec,
        out,
        plane,
        #[inline(always)]
        |k, out| {
            let (now, start) = (&now[k * plane..], &start[k * plane..]);
            for ((out, now), start) in out.iter_mut().zip(now).zip(start) {
                *out = now - start;
            }
        },
    );
}
