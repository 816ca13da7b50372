//! The Poisson equation by Gauss-Seidel sweeps in the order of the cells, from zero: what
//! Stam's program and most that follow it do. It stops long before it has converged.

use super::basis::ends;
use crate::grid::Grid;

/// Runs `sweeps` sweeps on `Laplacian(solution) = values`. Serial: each cell needs the one before.
pub(crate) fn solve(grid: &Grid, values: &[f32], solution: &mut [f32], sweeps: u32) {
    let [nx, ny, nz] = grid.cells;
    let plane = nx * ny;
    let weights = grid.cell_m.map(|edge| 1.0 / (edge * edge));
    let is_fixed = [ends(grid.sides[0]), ends(grid.sides[1]), ends(grid.sides[2])];
    // Diagonal weight and the neighbours' part along one axis.
    let along = |solution: &[f32], at: usize, index: usize, count: usize, stride: usize, axis: usize| {
        let weight = weights[axis];
        let (mut diagonal, mut sum) = (0.0, 0.0);
        if index > 0 {
            diagonal += weight;
            sum += weight * solution[at - stride];
        } else if !is_fixed[axis][0] {
            diagonal += 2.0 * weight;
        }
        if index + 1 < count {
            diagonal += weight;
            sum += weight * solution[at + stride];
        } else if !is_fixed[axis][1] {
            diagonal += 2.0 * weight;
        }
        (diagonal, sum)
    };
    solution.fill(0.0);
    for _ in 0..sweeps {
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let at = i + nx * j + plane * k;
                    let x = along(solution, at, i, nx, 1, 0);
                    let y = along(solution, at, j, ny, nx, 1);
                    let z = along(solution, at, k, nz, plane, 2);
                    solution[at] = (x.1 + y.1 + z.1 - values[at]) / (x.0 + y.0 + z.0);
                }
            }
        }
    }
}
