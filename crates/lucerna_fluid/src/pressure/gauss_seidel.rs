//! The Poisson equation by Gauss-Seidel sweeps in the order of the cells, from zero: what
//! Stam's program and most that follow it do. It stops long before it has converged.

use super::mask::Mask;
use crate::grid::Grid;
use crate::sides::Side;

/// Runs `sweeps` sweeps on `Laplacian(solution) = values`, where the pressure acts as the mask
/// says. Serial: each cell needs the one before.
pub(crate) fn solve(grid: &Grid, mask: &Mask, values: &[f32], solution: &mut [f32], sweeps: u32) {
    let [nx, ny, nz] = grid.cells;
    let strides = [1, nx, nx * ny];
    let face_strides = [1, nx, nx * ny];
    let inverse_squares = grid.cell_m.map(|edge| 1.0 / (edge * edge));
    let is_periodic = grid.sides.map(|sides| sides[0] == Side::Periodic);
    solution.fill(0.0);
    for _ in 0..sweeps {
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let index = [i, j, k];
                    let cell = i + nx * (j + ny * k);
                    let faces = [i + (nx + 1) * (j + ny * k), i + nx * (j + (ny + 1) * k), cell];
                    let (mut diagonal, mut sum) = (0.0, 0.0);
                    for axis in 0..3 {
                        let weights = mask.weights(axis);
                        let (at, last) = (index[axis], grid.cells[axis] - 1);
                        let across = last * strides[axis];
                        let low = weights[faces[axis]] * inverse_squares[axis];
                        let high = weights[faces[axis] + face_strides[axis]] * inverse_squares[axis];
                        diagonal += low + high;
                        // Behind an open side the pressure is zero.
                        if at > 0 {
                            sum += low * solution[cell - strides[axis]];
                        } else if is_periodic[axis] {
                            sum += low * solution[cell + across];
                        }
                        if at < last {
                            sum += high * solution[cell + strides[axis]];
                        } else if is_periodic[axis] {
                            sum += high * solution[cell - across];
                        }
                    }
                    solution[cell] = if diagonal > 0.0 { (sum - values[cell]) / diagonal } else { 0.0 };
                }
            }
        }
    }
}
