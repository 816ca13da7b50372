//! Implicit viscosity and conduction: `(1 - r Dxx)(1 - r Dyy)(1 - r Dzz) new = old`, one
//! tridiagonal system a line and axis (N. N. Yanenko, *The Method of Fractional Steps*, 1971).
//!
//! The three factors commute in a box, so that no axis is favoured; each is stable for any step
//! and never raises a maximum. Nothing iterates.
//!
//! Two passes over the memory: the lines along z are solved in slabs of one y, which threads
//! share and which fit into the nearest cache; those along x and y, in the planes of one z.

mod line;
mod lines;

use crate::field::Field;
use crate::grid::Grid;
use crate::limits::MAX_DIFFUSION_NUMBER;
use crate::parallel::for_planes;
use crate::sides::{GivenSides, Side, Wall, Walls};
use line::{End, Line};
use lines::{solve_rows, solve_transposed};

/// How fast something spreads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Diffusivity {
    pub(crate) uniform_m2_s: f32,
}

impl Diffusivity {
    pub(crate) fn acts(self) -> bool {
        self.uniform_m2_s > 0.0
    }
}

/// A field about to be spread: its lines along each axis, and which of its values are given.
struct Spread<'a> {
    lines: [Line; 3],
    /// What is held at the two ends of each axis.
    walls: [[Wall<'a>; 2]; 3],
    /// Ends, by axis, where the values themselves lie on the side and stay.
    is_given: [[bool; 2]; 3],
}

/// Lets the velocity spread for `dt_s`. The flow through the sides must have been set; `spare`
/// has the same shape.
pub(crate) fn diffuse_velocity(
    grid: &Grid,
    velocity: &mut [Field; 3],
    viscosity: Diffusivity,
    dt_s: f32,
    walls: Walls<'_>,
    spare: &mut [Field; 3],
) {
    for (component, (field, spare)) in velocity.iter_mut().zip(spare).enumerate() {
        let mut is_given = [[false; 2]; 3];
        is_given[component] = grid.sides[component].map(Side::fixes_flow);
        let end = |along: usize, end: usize| match grid.sides[along][end] {
            Side::Periodic => End::Cyclic,
            side if along == component && side.fixes_flow() => End::Given,
            Side::Open if along == component => End::Mirror,
            Side::NoSlip | Side::Inflow => End::Held,
            Side::FreeSlip | Side::Open => End::Free,
        };
        let lines = [0, 1, 2].map(|along| {
            let r = diffusion_number(grid, along, viscosity, dt_s);
            // The last face of a periodic axis is the first one.
            let is_double = along == component && grid.sides[along][0] == Side::Periodic;
            Line::new(field.counts[along] - usize::from(is_double), r, [end(along, 0), end(along, 1)])
        });
        let at = |axis: usize| [0, 1].map(|end| walls.at(grid, axis, end, component));
        diffuse(grid, field, spare, &Spread { lines, walls: [at(0), at(1), at(2)], is_given });
    }
}

/// Lets a scalar at the cells' centres spread for `dt_s`; `spare` has the same shape.
pub(crate) fn diffuse_scalar(
    grid: &Grid,
    field: &mut Field,
    diffusivity: Diffusivity,
    dt_s: f32,
    given: &GivenSides,
    spare: &mut Field,
) {
    let end = |along: usize, end: usize| match (grid.sides[along][end], given.temperature_k[along][end]) {
        (Side::Periodic, _) => End::Cyclic,
        (_, Some(_)) => End::Held,
        (_, None) => End::Free,
    };
    let lines = [0, 1, 2].map(|along| {
        let r = diffusion_number(grid, along, diffusivity, dt_s);
        Line::new(field.counts[along], r, [end(along, 0), end(along, 1)])
    });
    let walls = given.temperature_k.map(|ends| ends.map(|kelvin| Wall::Same(kelvin.unwrap_or(0.0))));
    diffuse(grid, field, spare, &Spread { lines, walls, is_given: [[false; 2]; 3] });
}

/// Square of the way that something spreads during the step, in cells, halved.
fn diffusion_number(grid: &Grid, along: usize, diffusivity: Diffusivity, dt_s: f32) -> f64 {
    let edge = f64::from(grid.cell_m[along]);
    (f64::from(diffusivity.uniform_m2_s) * f64::from(dt_s) / (edge * edge)).min(MAX_DIFFUSION_NUMBER)
}

fn diffuse(grid: &Grid, field: &mut Field, spare: &mut Field, spread: &Spread<'_>) {
    let [nx, ny, nz] = field.counts;
    let Spread { lines: [along_x, along_y, along_z], walls, is_given } = spread;
    let stays =
        |axis: usize, at: usize, count: usize| (at == 0 && is_given[axis][0]) || (at + 1 == count && is_given[axis][1]);
    let (lines_x, lines_y, lines_z) = (nx * ny, nx * nz, nx * ny);
    debug_assert!(lines_x == lines_z && spare.data.len() == lines_y * ny);
    // Along z, into slabs `[y][z][x]`.
    let from = &field.data;
    for_planes(
        grid.exec,
        &mut spare.data,
        nx * nz,
        #[inline(always)]
        |j, slab| {
            for (k, row) in slab.chunks_exact_mut(nx).enumerate() {
                row.copy_from_slice(&from[nx * (j + ny * k)..][..nx]);
            }
            if along_z.is_idle() || stays(1, j, ny) {
                return;
            }
            solve_rows(slab, nx, along_z, walls[2].map(|wall| wall.part(nx * j, nx)));
            for (end, i) in [0, nx - 1].into_iter().enumerate() {
                if is_given[0][end] {
                    (0..nz).for_each(|k| slab[i + nx * k] = from[i + nx * (j + ny * k)]);
                }
            }
        },
    );
    let slabs = &spare.data;
    for_planes(
        grid.exec,
        &mut field.data,
        nx * ny,
        #[inline(always)]
        |k, plane| {
            if stays(2, k, nz) {
                return;
            }
            let row = |j: usize| &slabs[nx * (k + nz * j)..][..nx];
            let inner = usize::from(is_given[1][0])..ny - usize::from(is_given[1][1]);
            if along_x.is_idle() {
                inner.for_each(|j| plane[nx * j..][..nx].copy_from_slice(row(j)));
            } else {
                solve_transposed(plane, nx, inner, row, along_x, walls[0].map(|wall| wall.part(ny * k, ny)));
            }
            if !along_y.is_idle() {
                solve_rows(plane, nx, along_y, walls[1].map(|wall| wall.part(nx * k, nx)));
            }
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sides::fix_sides;
    use glam::Vec3;

    /// `(1 - r Dxx)(1 - r Dyy)(1 - r Dzz)` applied in `f64` to a component, with its ends.
    fn applied(grid: &Grid, component: usize, values: &[f64], r: [f64; 3], wind: f64) -> Vec<f64> {
        let counts = grid.face_counts(component);
        let strides = [1, counts[0], counts[0] * counts[1]];
        let mut values = values.to_vec();
        // Where values on a side are held the factors do not commute: the last one solved comes first.
        for axis in [1, 0, 2] {
            let before = values.clone();
            for at in 0..values.len() {
                let index = |along: usize| at / strides[along] % counts[along];
                let is_on = |along: usize| along == component && [0, counts[along] - 1].contains(&index(along));
                let side = |along: usize| grid.sides[along][usize::from(index(along) > 0)];
                if (0..3).any(|along| is_on(along) && side(along).fixes_flow()) {
                    continue;
                }
                let period = counts[axis] - usize::from(component == axis);
                let neighbour = |is_up: bool| {
                    let i = index(axis);
                    let inside = if is_up { i + 1 < counts[axis] } else { i > 0 };
                    let is_circle = grid.sides[axis][0] == Side::Periodic;
                    let to = |j: usize| before[at - i * strides[axis] + j * strides[axis]];
                    match grid.sides[axis][usize::from(is_up)] {
                        _ if is_circle => to((i % period + if is_up { 1 } else { period - 1 }) % period),
                        _ if inside => to(if is_up { i + 1 } else { i - 1 }),
                        Side::Open if component == axis => to(if is_up { i - 1 } else { i + 1 }),
                        Side::NoSlip => -to(i),
                        Side::Inflow => 2.0 * wind - to(i),
                        _ => to(i),
                    }
                };
                values[at] -= r[axis] * (neighbour(true) + neighbour(false) - 2.0 * before[at]);
            }
        }
        values
    }

    #[test]
    fn what_was_solved_gives_back_what_was_there() {
        use Side::{FreeSlip, Inflow, NoSlip, Open, Periodic};
        let cases = [
            ([5, 6, 7], [[FreeSlip; 2], [NoSlip; 2], [Open; 2]]),
            ([19, 4, 3], [[Periodic; 2], [Inflow, Open], [NoSlip, FreeSlip]]),
            ([45, 2, 2], [[Open, NoSlip], [Periodic; 2], [Periodic; 2]]),
            ([3, 40, 4], [[Inflow, Open], [NoSlip, Open], [Periodic; 2]]),
            ([24, 26, 25], [[NoSlip; 2], [Periodic; 2], [Inflow; 2]]),
            ([18, 17, 1], [[Periodic; 2], [NoSlip; 2], [FreeSlip; 2]]),
            ([1, 17, 18], [[FreeSlip; 2], [Open; 2], [Periodic; 2]]),
        ];
        let mut most = 0.0_f64;
        for (cells, sides) in cases {
            let size = Vec3::new(cells[0] as f32, 2.0 * cells[1] as f32, 0.5 * cells[2] as f32);
            let grid = Grid::new(cells, Vec3::ZERO, size, sides);
            let given = GivenSides::default();
            let walls = Walls { wind: [0.3, -0.4, 0.7], frame: [0.0; 3], given: &given };
            let mut velocity = [0, 1, 2].map(|axis| Field::on_faces(&grid, axis));
            for (axis, field) in velocity.iter_mut().enumerate() {
                for (at, value) in field.data.iter_mut().enumerate() {
                    *value = ((at * (axis + 7)) as f32 * 12.9898).sin();
                }
            }
            fix_sides(&grid, &mut velocity, walls);
            let before = velocity.clone();
            let mut spare = velocity.clone();
            let viscosity = Diffusivity { uniform_m2_s: 0.25 };
            diffuse_velocity(&grid, &mut velocity, viscosity, 3.0, walls, &mut spare);
            fix_sides(&grid, &mut velocity, walls);
            let r = [0, 1, 2].map(|along| diffusion_number(&grid, along, viscosity, 3.0));
            for (axis, (field, before)) in velocity.iter().zip(&before).enumerate() {
                let solved: Vec<f64> = field.data.iter().map(|value| f64::from(*value)).collect();
                let back = applied(&grid, axis, &solved, r, f64::from(walls.wind[axis]));
                for (at, (back, before)) in back.iter().zip(&before.data).enumerate() {
                    let off = (back - f64::from(*before)).abs();
                    most = most.max(off);
                    assert!(off < 2.0e-5, "{cells:?} {axis} {at}: {back} against {before}");
                }
            }
        }
        println!("what was solved, put back into the equations, is off by {most:.1e} at most");
    }
}
