//! The Poisson equation solved directly: eigenvectors along x and z, tridiagonal systems along y.
//! Exact to rounding for any counts and any sides. R. W. Hockney, JACM 12, 1965.
//!
//! Sixteen x modes of the whole grid make a block. A block is found, transformed along z, solved
//! along y and transformed back along z while it stays in the cache.

use super::along_x::AlongX;
use super::along_y::AlongY;
use super::along_z::AlongZ;
use super::basis::{Basis, Ends};
use super::lines::{LANES, Lanes};
use crate::grid::Grid;
use crate::parallel::for_planes;

/// Tables for one grid.
pub(crate) struct DirectSolver {
    along_x: AlongX,
    along_y: AlongY,
    along_z: AlongZ,
}

/// Values in a block of x modes: the modes, and what the transform along z works in.
fn block_size(grid: &Grid) -> usize {
    let [_, ny, nz] = grid.cells;
    nz * (ny | 1) + AlongZ::spare(nz)
}

/// The array of modes that a solve works in.
pub(crate) fn mode_space(grid: &Grid) -> Vec<Lanes> {
    vec![Lanes::ZERO; grid.cells[0].div_ceil(LANES) * block_size(grid)]
}

impl DirectSolver {
    pub(crate) fn new(grid: &Grid) -> Self {
        let [nx, ny, nz] = grid.cells;
        let ends = grid.sides.map(Ends::new);
        let basis_x = Basis::new(nx, grid.cell_m[0], ends[0]);
        let basis_z = Basis::new(nz, grid.cell_m[2], ends[2]);
        Self {
            along_x: AlongX::new(&basis_x),
            along_y: AlongY::new(ny, grid.cell_m[1], ends[1], &basis_x, &basis_z),
            along_z: AlongZ::new(&basis_z),
        }
    }

    /// First half of a solve of `Laplacian(solution) = values`, one value a cell; fills `modes`,
    /// which [`mode_space`] made.
    pub(crate) fn analyze(&self, grid: &Grid, values: &[f32], modes: &mut [Lanes]) {
        let [_, ny, nz] = grid.cells;
        let (plane, stride) = (grid.plane(), self.along_y.stride);
        for_planes(
            grid.exec,
            modes,
            block_size(grid),
            #[inline(always)]
            |block, values_and_spare| {
                let (modes, spare) = values_and_spare.split_at_mut(nz * stride);
                for (rows, out) in values.chunks_exact(plane).zip(modes.chunks_exact_mut(stride)) {
                    self.along_x.forward(block, rows, &mut out[..ny]);
                }
                self.along_z.forward(modes, stride, ny, spare);
                self.along_y.solve(block, modes);
                self.along_z.backward(modes, stride, ny, spare);
            },
        );
    }

    /// Second half: fills the solution. In a sealed box its mean is zero, and the mean of the
    /// right-hand side has been left out.
    pub(crate) fn synthesize(&self, grid: &Grid, modes: &[Lanes], solution: &mut [f32]) {
        let stride = self.along_y.stride;
        let block = block_size(grid);
        for_planes(
            grid.exec,
            solution,
            grid.plane(),
            #[inline(always)]
            |k, out| self.along_x.backward(&modes[k * stride..], block, out),
        );
    }
}
