//! The Poisson equation around obstacles: conjugate gradients, preconditioned by the direct
//! solve of the box without them. M. R. Hestenes and E. Stiefel, J. Res. NBS 49, 1952; the
//! preconditioner after P. Concus, G. H. Golub and D. P. O'Leary, 1976.

use super::direct::DirectSolver;
use super::figures::for_planes_and_figures;
use super::lines::Lanes;
use super::mask::Mask;
use super::regions::RegionSums;
use crate::grid::Grid;
use crate::limits::MAX_AXIS_CELLS;
use crate::parallel::for_planes;
use crate::sides::Side;

/// Most iterations of a solve.
pub(crate) const MAX_ITERATIONS: u32 = 200;

/// A residual of this part of the first one is as small as `f32` can tell.
const LEAST_PART: f64 = 1.0e-6;

/// Arrays that a solve works in; empty until the first.
#[derive(Default)]
pub(crate) struct Spare {
    direction: Vec<f32>,
    /// The preconditioned residual, then what the Laplacian makes of the direction.
    image: Vec<f32>,
    /// By plane.
    dots: Vec<f64>,
    pub(crate) sums: RegionSums,
}

/// What is to be solved, and by what.
pub(crate) struct Problem<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) mask: &'a Mask,
    pub(crate) direct: &'a DirectSolver,
    /// Greatest root mean square of the residual over the fluid cells that will do.
    pub(crate) tolerance: f64,
}

/// Solves `Laplacian(solution) = residual`; `residual` must have no mean in sealed regions and be
/// zero in solid cells, and becomes what is left. Returns the number of iterations.
pub(crate) fn solve(
    problem: &Problem,
    residual: &mut [f32],
    solution: &mut [f32],
    modes: &mut [Lanes],
    spare: &mut Spare,
) -> u32 {
    let Problem { grid, mask, direct, tolerance } = *problem;
    let Spare { direction, image, dots, sums } = spare;
    direction.resize(residual.len(), 0.0);
    image.resize(residual.len(), 0.0);
    dots.resize(grid.cells[2], 0.0);
    solution.fill(0.0);
    let first = squares(grid, residual, dots);
    let least = (tolerance * tolerance * mask.fluid_cells() as f64).max(LEAST_PART * LEAST_PART * first);
    let mut left = first;
    let mut before = 0.0;
    for iteration in 0..MAX_ITERATIONS {
        // Not a number counts as done.
        if left <= least || left.is_nan() {
            return iteration;
        }
        direct.analyze(grid, residual, modes);
        direct.synthesize(grid, modes, image);
        mask.regions().remove_means(grid, image, sums);
        // The Laplacian is negative: so are both of these, and the signs cancel in the ratios.
        let now = dot_with_fluid(grid, mask, residual, image, dots);
        let part = if iteration == 0 { 0.0 } else { (now / before) as f32 };
        before = now;
        combine(grid, direction, part, image);
        let curvature = laplacian(grid, mask, direction, image, dots);
        let step = now / curvature;
        if !step.is_finite() || !part.is_finite() {
            return iteration;
        }
        left = advance(grid, step as f32, [direction, image], solution, residual, dots);
        mask.regions().remove_means(grid, residual, sums);
    }
    MAX_ITERATIONS
}

/// Sums kept in `f32` before they go into an `f64`.
const SUMMED: usize = 512;
const LANES: usize = 8;

#[inline(always)]
fn dot_of(a: &[f32], b: &[f32]) -> f64 {
    let mut all = 0.0;
    for (a, b) in a.chunks(SUMMED).zip(b.chunks(SUMMED)) {
        let mut sums = [0.0_f32; LANES];
        let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
        for (a, b) in a.iter().zip(b) {
            for lane in 0..LANES {
                sums[lane] += a[lane] * b[lane];
            }
        }
        all += sums.iter().map(|sum| f64::from(*sum)).sum::<f64>();
        all += a_rest.iter().zip(b_rest).map(|(a, b)| f64::from(a * b)).sum::<f64>();
    }
    all
}

/// Sum of the squares of `values`.
fn squares(grid: &Grid, values: &[f32], dots: &mut [f64]) -> f64 {
    let plane = grid.plane();
    for_planes(
        grid.exec,
        dots,
        1,
        #[inline(always)]
        |k, dots| {
            let values = &values[k * plane..(k + 1) * plane];
            dots.fill(dot_of(values, values));
        },
    );
    dots.iter().sum()
}

/// Sum of the products; sets `values` to zero in solid cells.
fn dot_with_fluid(grid: &Grid, mask: &Mask, residual: &[f32], values: &mut [f32], dots: &mut [f64]) -> f64 {
    let plane = grid.plane();
    for_planes_and_figures(
        grid,
        values,
        dots,
        #[inline(always)]
        |k, values, dot| {
            let cells = k * plane..(k + 1) * plane;
            for (value, solid) in values.iter_mut().zip(&mask.solid()[cells.clone()]) {
                *value = if *solid { 0.0 } else { *value };
            }
            *dot = dot_of(values, &residual[cells]);
        },
    );
    dots.iter().sum()
}

/// `direction = part * direction + image`.
fn combine(grid: &Grid, direction: &mut [f32], part: f32, image: &[f32]) {
    let plane = grid.plane();
    for_planes(
        grid.exec,
        direction,
        plane,
        #[inline(always)]
        |k, values| {
            let image = &image[k * plane..(k + 1) * plane];
            values.iter_mut().zip(image).for_each(|(value, image)| *value = part * *value + image);
        },
    );
}

/// `solution += step * direction`, `residual -= step * image`; returns the residual's squares.
fn advance(
    grid: &Grid,
    step: f32,
    [direction, image]: [&[f32]; 2],
    solution: &mut [f32],
    residual: &mut [f32],
    dots: &mut [f64],
) -> f64 {
    let plane = grid.plane();
    let add = |values: &mut [f32], step: f32, change: &[f32]| {
        values.iter_mut().zip(change).for_each(|(value, change)| *value += step * change);
    };
    for_planes(
        grid.exec,
        solution,
        plane,
        #[inline(always)]
        |k, values| add(values, step, &direction[k * plane..(k + 1) * plane]),
    );
    for_planes_and_figures(
        grid,
        residual,
        dots,
        #[inline(always)]
        |k, values, dot| {
            add(values, -step, &image[k * plane..(k + 1) * plane]);
            *dot = dot_of(values, values);
        },
    );
    dots.iter().sum()
}

/// Fills `out` with the divergence of the weighted gradient; returns its product with `values`.
fn laplacian(grid: &Grid, mask: &Mask, values: &[f32], out: &mut [f32], dots: &mut [f64]) -> f64 {
    let [nx, ny, nz] = grid.cells;
    let plane = nx * ny;
    let inverse_squares = grid.cell_m.map(|edge| 1.0 / (edge * edge));
    let is_periodic = grid.sides.map(|sides| sides[0] == Side::Periodic);
    // Behind an open side the pressure is zero; behind others the weight is.
    let nothing = [0.0; MAX_AXIS_CELLS];
    for_planes_and_figures(
        grid,
        out,
        dots,
        #[inline(always)]
        |k, out, dot| {
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let row = |j: usize, k: usize| &values[nx * (j + ny * k)..][..nx];
                // Rows before and after along an axis.
                let beside = |index: usize, count: usize, axis: usize| {
                    let wrap = |index: usize| is_periodic[axis].then_some(index);
                    let low = index.checked_sub(1).or(wrap(count - 1));
                    [low, if index + 1 < count { Some(index + 1) } else { wrap(0) }]
                };
                let [y_low, y_high] = beside(j, ny, 1).map(|j| j.map_or(&nothing[..nx], |j| row(j, k)));
                let [z_low, z_high] = beside(k, nz, 2).map(|k| k.map_or(&nothing[..nx], |k| row(j, k)));
                let here = row(j, k);
                let x_weights = &mask.weights(0)[(nx + 1) * (j + ny * k)..][..nx + 1];
                let y_weights = |j: usize| &mask.weights(1)[nx * (j + (ny + 1) * k)..][..nx];
                let z_weights = |k: usize| &mask.weights(2)[nx * (j + ny * k)..][..nx];
                let (wy_low, wy_high, wz_low, wz_high) =
                    (y_weights(j), y_weights(j + 1), z_weights(k), z_weights(k + 1));
                for i in 0..nx {
                    let y = wy_low[i] * (y_low[i] - here[i]) + wy_high[i] * (y_high[i] - here[i]);
                    let z = wz_low[i] * (z_low[i] - here[i]) + wz_high[i] * (z_high[i] - here[i]);
                    out[i] = inverse_squares[1] * y + inverse_squares[2] * z;
                }
                let ends = if is_periodic[0] { [here[nx - 1], here[0]] } else { [0.0; 2] };
                out[0] += inverse_squares[0] * x_weights[0] * (ends[0] - here[0]);
                out[nx - 1] += inverse_squares[0] * x_weights[nx] * (ends[1] - here[nx - 1]);
                let (low, high, weights) = (&here[..nx - 1], &here[1..], &x_weights[1..nx]);
                for i in 0..nx - 1 {
                    out[i] += inverse_squares[0] * weights[i] * (high[i] - low[i]);
                }
                let later = &mut out[1..];
                for i in 0..nx - 1 {
                    later[i] += inverse_squares[0] * weights[i] * (low[i] - high[i]);
                }
            }
            *dot = dot_of(out, &values[k * plane..(k + 1) * plane]);
        },
    );
    dots.iter().sum()
}
