//! The Poisson equation solved directly: eigenvectors along x and z, tridiagonal systems along y.
//! Exact to rounding for any counts and any sides. R. W. Hockney, JACM 12, 1965.
//!
//! Sixteen x modes of the whole grid make a block. A block is found, transformed along z, solved
//! along y and transformed back along z while it stays in the cache.

use fearless_simd::Simd;

use super::along_x::{AlongX, FOLDED_ROWS};
use super::along_y::AlongY;
use super::along_z::AlongZ;
use super::basis::{Basis, Ends};
use super::lines::{ChunkKernel, LANES, Lanes, run_chunks};
use crate::grid::Grid;

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
        run_chunks(grid.exec, modes, block_size(grid), &Analysis { solver: self, values, ny, nz });
    }

    /// Second half: fills the solution. In a sealed box its mean is zero, and the mean of the
    /// right-hand side has been left out.
    pub(crate) fn synthesize(&self, grid: &Grid, modes: &[Lanes], solution: &mut [f32]) {
        let kernel = Synthesis { solver: self, modes, block: block_size(grid) };
        run_chunks(grid.exec, solution, grid.plane(), &kernel);
    }
}

/// A block of modes, from the cells to the solution's modes along x.
struct Analysis<'a> {
    solver: &'a DirectSolver,
    values: &'a [f32],
    ny: usize,
    nz: usize,
}

impl ChunkKernel<Lanes> for Analysis<'_> {
    #[inline(always)]
    fn run<S: Simd>(&self, simd: S, block: usize, modes_and_spare: &mut [Lanes]) {
        let Self { solver: DirectSolver { along_x, along_y, along_z }, values, ny, nz } = *self;
        let stride = along_y.stride;
        let plane = values.len() / nz;
        let (modes, spare) = modes_and_spare.split_at_mut(nz * stride);
        let mut folded = [0.0; FOLDED_ROWS];
        for k in 0..nz {
            let out = &mut modes[k * stride..k * stride + ny];
            along_x.forward(simd, block, &values[k * plane..(k + 1) * plane], out, &mut folded);
        }
        along_z.forward(simd, modes, stride, ny, spare);
        along_y.solve(simd, block, modes);
        along_z.backward(simd, modes, stride, ny, spare);
    }
}

/// A z-plane of the solution from its modes along x.
struct Synthesis<'a> {
    solver: &'a DirectSolver,
    modes: &'a [Lanes],
    block: usize,
}

impl ChunkKernel<f32> for Synthesis<'_> {
    #[inline(always)]
    fn run<S: Simd>(&self, simd: S, k: usize, out: &mut [f32]) {
        let DirectSolver { along_x, along_y, .. } = self.solver;
        along_x.backward(simd, &self.modes[k * along_y.stride..], self.block, out);
    }
}
