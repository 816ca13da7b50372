//! The solvers against the equation itself, in `f64`.

use glam::Vec3;

use super::conjugate::{self, Problem};
use super::direct::{DirectSolver, mode_space};
use super::gauss_seidel;
use super::mask::Mask;
use super::regions::RegionSums;
use crate::grid::Grid;
use crate::sides::Side;

const PAIRS: [[Side; 2]; 5] = [
    [Side::FreeSlip, Side::NoSlip],
    [Side::Open, Side::Open],
    [Side::Inflow, Side::Open],
    [Side::Open, Side::FreeSlip],
    [Side::Periodic, Side::Periodic],
];

fn grid(cells: [usize; 3], sides: [[Side; 2]; 3]) -> Grid {
    let size = Vec3::from_array([0.1, 0.13, 0.08]) * Vec3::from_array(cells.map(|count| count as f32));
    Grid::new(cells, Vec3::ZERO, size, sides)
}

/// Numbers between -1 and 1.
fn noise(count: usize) -> Vec<f32> {
    let mut state = 12345_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1 << 23) as f32 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// The Laplacian of a cell by its definition.
fn laplacian(grid: &Grid, solid: &[bool], values: &[f32], index: [usize; 3]) -> f64 {
    let [nx, ny, _] = grid.cells;
    let at = |index: [usize; 3]| index[0] + nx * (index[1] + ny * index[2]);
    let here = f64::from(values[at(index)]);
    let mut sum = 0.0;
    for axis in 0..3 {
        let last = grid.cells[axis] - 1;
        let weight = f64::from(grid.cell_m[axis]).powi(-2);
        for end in [0, 1] {
            let mut other = index;
            let is_side = index[axis] == end * last;
            match (is_side, grid.sides[axis][end]) {
                (true, Side::Open) => {
                    sum -= 2.0 * weight * here;
                    continue;
                }
                (true, Side::Periodic) => other[axis] = last - end * last,
                (true, _) => continue,
                (false, _) => other[axis] = index[axis] + 2 * end - 1,
            }
            if !solid[at(other)] {
                sum += weight * (f64::from(values[at(other)]) - here);
            }
        }
    }
    sum
}

/// Root mean square of `rhs - laplacian(solution)` in the cells of air, over that of `rhs` and of
/// the solution times the diagonal, of which `f32` leaves some 1e-7 whatever the solver.
fn residual(grid: &Grid, solid: &[bool], solution: &[f32], rhs: &[f32]) -> f64 {
    let [nx, ny, _] = grid.cells;
    let (mut left, mut all) = (0.0, 0.0);
    let diagonal = 2.0 * grid.cell_m.into_iter().map(|edge| f64::from(edge).powi(-2)).sum::<f64>();
    for cell in (0..grid.count()).filter(|cell| !solid[*cell]) {
        let index = [cell % nx, cell / nx % ny, cell / (nx * ny)];
        let rate = f64::from(rhs[cell]);
        left += (rate - laplacian(grid, solid, solution, index)).powi(2);
        all += rate * rate + (diagonal * f64::from(solution[cell])).powi(2);
    }
    (left / all).sqrt()
}

#[test]
fn the_direct_solver_solves_for_all_sides_and_sizes() {
    let sizes = [
        [15, 15, 15],
        [16, 16, 16],
        [2, 3, 2],
        [5, 4, 9],
        [17, 8, 31],
        [24, 13, 5],
        [33, 2, 18],
        [50, 9, 3],
        [64, 7, 12],
        [1, 12, 13],
        [20, 1, 11],
        [35, 14, 1],
    ];
    let mut worst = 0.0_f64;
    for cells in sizes {
        for pairs in 0..125 {
            let mut sides = [PAIRS[pairs % 5], PAIRS[pairs / 5 % 5], PAIRS[pairs / 25]];
            (0..3).filter(|axis| cells[*axis] == 1).for_each(|axis| sides[axis] = [Side::FreeSlip; 2]);
            let grid = grid(cells, sides);
            let mut rhs = noise(grid.count());
            let mut modes = mode_space(&grid);
            let direct = DirectSolver::new(&grid);
            let mut solution = vec![f32::NAN; grid.count()];
            direct.analyze(&grid, &rhs, &mut modes);
            direct.synthesize(&grid, &modes, &mut solution);
            if grid.is_sealed() {
                let mean = rhs.iter().sum::<f32>() / rhs.len() as f32;
                rhs.iter_mut().for_each(|value| *value -= mean);
                let mean = solution.iter().sum::<f32>() / solution.len() as f32;
                assert!(mean.abs() < 1e-6, "{cells:?} {sides:?}: mean {mean}");
            }
            let left = residual(&grid, &vec![false; grid.count()], &solution, &rhs);
            worst = worst.max(left);
            assert!(left < 1e-6, "{cells:?} {sides:?}: {left}");
        }
    }
    println!("greatest residual of the direct solver: {worst:.1e}");
}

/// A random third of the cells, a ball, and walls with and without a gap.
fn obstacles(grid: &Grid) -> Vec<Vec<bool>> {
    let [nx, ny, nz] = grid.cells;
    let noise = noise(grid.count());
    let cells = |is_solid: &dyn Fn(usize, usize, usize) -> bool| -> Vec<bool> {
        (0..nx * ny * nz).map(|cell| is_solid(cell % nx, cell / nx % ny, cell / (nx * ny))).collect()
    };
    let ball = |i: usize, j: usize, k: usize| {
        let square = |at: usize, count: usize| (at as f32 + 0.5 - 0.5 * count as f32).powi(2);
        square(i, nx) + square(j, ny) + square(k, nz) < (0.3 * nx.min(ny) as f32).powi(2)
    };
    vec![
        noise.iter().map(|value| *value > 0.3).collect(),
        noise.iter().map(|value| *value > -0.3).collect(),
        cells(&ball),
        cells(&|i, _, _| i == nx / 3),
        cells(&|i, j, _| i == nx / 3 && j > 0),
        cells(&|i, j, _| i % 2 == 0 || j % 2 == 0),
    ]
}

#[test]
fn conjugate_gradients_solve_around_obstacles_for_all_sides() {
    let mut worst = (0.0_f64, 0);
    for cells in [[9, 10, 11], [18, 15, 1]] {
        for pairs in 0..125 {
            let mut sides = [PAIRS[pairs % 5], PAIRS[pairs / 5 % 5], PAIRS[pairs / 25]];
            (0..3).filter(|axis| cells[*axis] == 1).for_each(|axis| sides[axis] = [Side::FreeSlip; 2]);
            let grid = grid(cells, sides);
            let direct = DirectSolver::new(&grid);
            for solid in obstacles(&grid) {
                let mask = Mask::new(&grid, &solid);
                let mut rhs = noise(grid.count());
                mask.clear_solid(&grid, &mut rhs);
                mask.regions().remove_means(&grid, &mut rhs, &mut RegionSums::default());
                let mut solution = vec![f32::NAN; grid.count()];
                let problem = Problem { grid: &grid, mask: &mask, direct: &direct, tolerance: 1e-6 };
                let mut modes = mode_space(&grid);
                let spare = &mut conjugate::Spare::default();
                let iterations = conjugate::solve(&problem, &mut rhs.clone(), &mut solution, &mut modes, spare);
                if rhs.iter().all(|value| value.abs() < 1e-6) {
                    assert!(solution.iter().all(|value| value.is_finite()));
                    continue;
                }
                let left = residual(&grid, &solid, &solution, &rhs);
                worst = (worst.0.max(left), worst.1.max(iterations));
                assert!(left < 5e-6, "{cells:?} {sides:?}: {left} after {iterations}");
            }
        }
    }
    println!("greatest residual around obstacles: {:.1e}; most iterations: {}", worst.0, worst.1);
}

#[test]
fn sweeps_converge_around_obstacles_for_all_sides() {
    for pairs in (0..125).step_by(4) {
        let sides = [PAIRS[pairs % 5], PAIRS[pairs / 5 % 5], PAIRS[pairs / 25]];
        let grid = grid([5, 6, 4], sides);
        for solid in obstacles(&grid) {
            let mask = Mask::new(&grid, &solid);
            let mut rhs = noise(grid.count());
            mask.clear_solid(&grid, &mut rhs);
            mask.regions().remove_means(&grid, &mut rhs, &mut RegionSums::default());
            let mut solution = vec![f32::NAN; grid.count()];
            gauss_seidel::solve(&grid, &mask, &rhs, &mut solution, 3000);
            if rhs.iter().all(|value| value.abs() < 1e-6) {
                assert!(solution.iter().all(|value| value.is_finite()));
                continue;
            }
            let left = residual(&grid, &solid, &solution, &rhs);
            assert!(left < 1e-4, "{sides:?}: {left}");
        }
    }
}
