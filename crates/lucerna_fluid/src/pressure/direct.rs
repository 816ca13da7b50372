//! The Poisson equation solved directly: eigenvectors along x and z, a tridiagonal system
//! along y. Exact to rounding for any counts and any sides. R. W. Hockney, JACM 12, 1965.

use super::basis::{Basis, ends};
use super::gemm::multiply;
use crate::grid::Grid;
use crate::parallel::{Execution, for_planes};

/// Planes of the transform along z that are computed together.
const PLANE_GROUP: usize = 4;

/// Tables for one grid.
pub(crate) struct DirectSolver {
    along_x: Basis,
    along_z: Basis,
    /// Reciprocal pivots of the tridiagonal systems, m²: `[z mode][y][x mode]`.
    reciprocal_pivots: Vec<f32>,
    /// Minus the off-diagonal of the tridiagonal systems, 1/m².
    coupling: f32,
}

impl DirectSolver {
    pub(crate) fn new(grid: &Grid) -> Self {
        let [nx, ny, nz] = grid.cells;
        let along_x = Basis::new(nx, grid.cell_m[0], ends(grid.sides[0]));
        let along_z = Basis::new(nz, grid.cell_m[2], ends(grid.sides[2]));
        let coupling = 1.0 / f64::from(grid.cell_m[1]).powi(2);
        let is_fixed = ends(grid.sides[1]);
        let mut reciprocal_pivots = vec![0.0_f32; grid.count()];
        for (kz, plane) in reciprocal_pivots.chunks_mut(nx * ny).enumerate() {
            for kx in 0..nx {
                let modes = along_x.eigenvalues[kx] + along_z.eigenvalues[kz];
                let mut previous = f64::INFINITY;
                for j in 0..ny {
                    let low = neighbour_weight(j > 0, is_fixed[0]);
                    let high = neighbour_weight(j + 1 < ny, is_fixed[1]);
                    let pivot = modes + coupling * (low + high) - coupling * coupling / previous;
                    // The last pivot of the constant mode of a sealed box is zero: pin its pressure.
                    let is_singular = pivot <= 1e-9 * coupling;
                    plane[j * nx + kx] = if is_singular { 0.0 } else { (1.0 / pivot) as f32 };
                    previous = pivot;
                }
            }
        }
        Self { along_x, along_z, reciprocal_pivots, coupling: coupling as f32 }
    }

    /// Replaces `values` by the solution of `Laplacian(solution) = values`; both arrays hold one
    /// value a cell.
    pub(crate) fn solve(&self, grid: &Grid, values: &mut [f32], spare: &mut [f32]) {
        let [nx, ny, nz] = grid.cells;
        let plane = nx * ny;
        let exec = grid.exec;
        for_planes(
            exec,
            spare,
            plane,
            #[inline(always)]
            |k, out| {
                multiply(out, &values[k * plane..(k + 1) * plane], &self.along_x.synthesis, nx, nx);
            },
        );
        transform_z(exec, values, &self.along_z.analysis, spare, nz, plane);
        for_planes(
            exec,
            values,
            plane,
            #[inline(always)]
            |kz, modes| {
                let reciprocals = &self.reciprocal_pivots[kz * plane..(kz + 1) * plane];
                solve_columns(modes, reciprocals, self.coupling, nx);
            },
        );
        transform_z(exec, spare, &self.along_z.synthesis, values, nz, plane);
        for_planes(
            exec,
            values,
            plane,
            #[inline(always)]
            |k, out| {
                multiply(out, &spare[k * plane..(k + 1) * plane], &self.along_x.analysis, nx, nx);
            },
        );
    }
}

/// What an end of a cell adds to the diagonal, in units of the coupling: a neighbour inside, a
/// face with fixed flow, or zero pressure half a cell away.
fn neighbour_weight(is_inside: bool, is_fixed: bool) -> f64 {
    match (is_inside, is_fixed) {
        (true, _) => 1.0,
        (false, true) => 0.0,
        (false, false) => 2.0,
    }
}

/// A matrix applied across the planes.
fn transform_z(exec: Execution, out: &mut [f32], matrix: &[f32], values: &[f32], nz: usize, plane: usize) {
    for_planes(
        exec,
        out,
        PLANE_GROUP * plane,
        #[inline(always)]
        |group, planes| {
            multiply(planes, &matrix[group * PLANE_GROUP * nz..], values, nz, plane);
        },
    );
}

/// Thomas's algorithm for all columns of a plane at once, in place, for the negated system.
#[inline(always)]
fn solve_columns(values: &mut [f32], reciprocals: &[f32], coupling: f32, nx: usize) {
    let rows = values.len() / nx;
    for (value, reciprocal) in values.iter_mut().zip(&reciprocals[..nx]) {
        *value *= -reciprocal;
    }
    for j in 1..rows {
        let (done, rest) = values.split_at_mut(j * nx);
        let below = &done[(j - 1) * nx..];
        let reciprocal_row = &reciprocals[j * nx..(j + 1) * nx];
        for ((value, low), reciprocal) in rest[..nx].iter_mut().zip(below).zip(reciprocal_row) {
            *value = (coupling * low - *value) * reciprocal;
        }
    }
    for j in (0..rows - 1).rev() {
        let (rest, done) = values.split_at_mut((j + 1) * nx);
        let above = &done[..nx];
        let reciprocal_row = &reciprocals[j * nx..(j + 1) * nx];
        for ((value, high), reciprocal) in rest[j * nx..].iter_mut().zip(above).zip(reciprocal_row) {
            *value += coupling * reciprocal * high;
        }
    }
}
