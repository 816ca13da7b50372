//! Implicit viscosity: `(1 - r Dxx)(1 - r Dyy)(1 - r Dzz) u_new = u`, one tridiagonal system a
//! line and axis (N. N. Yanenko, *The Method of Fractional Steps*, 1971).
//!
//! The three factors commute in a box, so that no axis is favoured; each is stable for any step
//! and never raises a maximum. Nothing iterates.

use crate::field::Field;
use crate::grid::Grid;
use crate::limits::{MAX_AXIS_CELLS, MAX_DIFFUSION_NUMBER};
use crate::parallel::for_planes;
use crate::sides::Side;

/// One line's factored system: the same for every line of an axis.
struct Line {
    /// Weight of the lower neighbour, upper neighbour, and reciprocal pivot, by node.
    lower: [f32; MAX_AXIS_CELLS + 1],
    upper: [f32; MAX_AXIS_CELLS + 1],
    reciprocal: [f32; MAX_AXIS_CELLS + 1],
    /// What the low and the high end add: weight times a velocity that is given outside.
    added: [f32; 2],
}

impl Line {
    /// The line along `along` of the velocity component `component`.
    fn new(grid: &Grid, component: usize, along: usize, viscosity_dt: f64, wind: f32) -> Self {
        let edge = f64::from(grid.cell_m[along]);
        let r = (viscosity_dt / (edge * edge)).min(MAX_DIFFUSION_NUMBER);
        let count = grid.face_counts(component)[along];
        let zeros = [0.0; MAX_AXIS_CELLS + 1];
        let mut line = Self { lower: zeros, upper: zeros, reciprocal: zeros, added: [0.0; 2] };
        let mut passed_on = 0.0;
        for node in 0..count {
            let (mut lower, mut upper) = (r, r);
            let mut diagonal = 1.0 + 2.0 * r;
            for (end, is_end) in [node == 0, node + 1 == count].into_iter().enumerate() {
                if !is_end {
                    continue;
                }
                let side = grid.sides[along][end];
                let (outer, inner) = if end == 0 { (&mut lower, &mut upper) } else { (&mut upper, &mut lower) };
                *outer = 0.0;
                if component == along {
                    if side.fixes_flow() {
                        // The node lies on the side, and its value is given.
                        (diagonal, *inner) = (1.0, 0.0);
                    } else {
                        // Mirrored about the node: no gradient on the open face.
                        *inner = 2.0 * r;
                    }
                } else {
                    match side {
                        Side::FreeSlip | Side::Open | Side::Periodic => diagonal -= r,
                        Side::NoSlip => diagonal += r,
                        Side::Inflow => {
                            diagonal += r;
                            line.added[end] = (2.0 * r) as f32 * wind;
                        }
                    }
                }
            }
            let pivot = diagonal - lower * passed_on;
            passed_on = upper / pivot;
            line.lower[node] = lower as f32;
            line.upper[node] = upper as f32;
            line.reciprocal[node] = (1.0 / pivot) as f32;
        }
        line
    }
}

/// Lets the velocity diffuse for `viscosity_dt` m².
pub(crate) fn diffuse(grid: &Grid, velocity: &mut [Field; 3], viscosity_dt: f64, wind: [f32; 3]) {
    for (component, field) in velocity.iter_mut().enumerate() {
        let [nx, ny, _] = field.counts;
        let line = |along: usize| Line::new(grid, component, along, viscosity_dt, wind[component]);
        let (along_x, along_y, along_z) = (line(0), line(1), line(2));
        for_planes(
            grid.exec,
            &mut field.data,
            nx * ny,
            #[inline(always)]
            |_, plane| {
                plane.chunks_exact_mut(nx).for_each(|row| solve_rows(row, 1, &along_x));
                solve_rows(plane, nx, &along_y);
            },
        );
        solve_rows(&mut field.data, nx * ny, &along_z);
    }
}

/// Solves the systems that run across consecutive runs of `width` values.
#[inline(always)]
fn solve_rows(values: &mut [f32], width: usize, line: &Line) {
    let count = values.len() / width;
    let [low, high] = line.added;
    if low != 0.0 {
        values[..width].iter_mut().for_each(|value| *value += low);
    }
    if high != 0.0 {
        values[(count - 1) * width..].iter_mut().for_each(|value| *value += high);
    }
    values[..width].iter_mut().for_each(|value| *value *= line.reciprocal[0]);
    for node in 1..count {
        let (done, rest) = values.split_at_mut(node * width);
        let before = &done[(node - 1) * width..];
        let (lower, reciprocal) = (line.lower[node], line.reciprocal[node]);
        for (value, before) in rest[..width].iter_mut().zip(before) {
            *value = (*value + lower * before) * reciprocal;
        }
    }
    for node in (0..count - 1).rev() {
        let (rest, done) = values.split_at_mut((node + 1) * width);
        let factor = line.upper[node] * line.reciprocal[node];
        for (value, after) in rest[node * width..].iter_mut().zip(&done[..width]) {
            *value += factor * after;
        }
    }
}
