//! Implicit viscosity and conduction: `(1 - r Dxx)(1 - r Dyy)(1 - r Dzz) new = old`, one
//! tridiagonal system a line and axis (N. N. Yanenko, *The Method of Fractional Steps*, 1971).
//!
//! The three factors commute in a box, so that no axis is favoured; each is stable for any step
//! and never raises a maximum. Nothing iterates.
//!
//! Two passes over the memory: the lines along z are solved in slabs of one y, which threads
//! share and which fit into the nearest cache; those along x and y, in the planes of one z.

mod coefficients;
mod line;
mod lines;
mod spread;
#[cfg(test)]
mod tests;
mod varying;

use crate::field::Field;
use crate::grid::Grid;
use crate::sides::{Side, Wall, Walls};
pub(crate) use coefficients::Coefficients;
use line::End;
use spread::{Spread, diffuse};

/// How fast something spreads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Diffusivity<'a> {
    pub(crate) uniform_m2_s: f32,
    /// What eddies too small for the grid add, by cell, m²/s; at least 0.
    pub(crate) eddy_m2_s: Option<&'a [f32]>,
    /// Density over that of ambient air, by cell, above 0; nothing where it is 1. Momentum spreads as
    /// `div(rho nu grad u) / rho`, without the transposed gradient.
    pub(crate) density: Option<&'a [f32]>,
}

impl Diffusivity<'_> {
    pub(crate) fn acts(self) -> bool {
        self.uniform_m2_s > 0.0 || self.eddy_m2_s.is_some()
    }
}

/// Solid cells, as the lines of values meet them: empty, or one value each, zero where it is
/// free. See [`varying::Varying::held`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Held<'a> {
    pub(crate) faces: [&'a [f32]; 3],
    pub(crate) cells: &'a [f32],
}

/// Lets the velocity spread for `dt_s`. The flow through the sides and next to solid cells must
/// have been set; `spare` has the same shape.
#[expect(clippy::too_many_arguments, reason = "what the air is, what holds it, and room to work in")]
pub(crate) fn diffuse_velocity(
    grid: &Grid,
    velocity: &mut [Field; 3],
    viscosity: Diffusivity<'_>,
    dt_s: f32,
    walls: Walls<'_>,
    held: Held<'_>,
    spare: &mut [Field; 3],
    coefficients: &mut Coefficients,
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
        let at = |axis: usize| [0, 1].map(|end| walls.at(grid, axis, end, component));
        let walls = [at(0), at(1), at(2)];
        let ends = [0, 1, 2].map(|along| [end(along, 0), end(along, 1)]);
        let mut counts = field.counts;
        counts[component] -= usize::from(grid.sides[component][0] == Side::Periodic);
        let kind = coefficients.kind(grid, viscosity, dt_s, Some(component), counts, ends, held.faces[component]);
        diffuse(grid, field, spare, &Spread { kind, counts, ends, component: Some(component), walls, is_given });
    }
}

/// Lets a scalar at the cells' centres spread for `dt_s`, towards the temperatures that sides
/// are held at; solid cells insulate. `spare` has the same shape.
#[expect(clippy::too_many_arguments, reason = "what the air is, what holds it, and room to work in")]
pub(crate) fn diffuse_scalar(
    grid: &Grid,
    field: &mut Field,
    diffusivity: Diffusivity<'_>,
    dt_s: f32,
    sides: [[Option<f32>; 2]; 3],
    held: Held<'_>,
    spare: &mut Field,
    coefficients: &mut Coefficients,
) {
    let end = |along: usize, end: usize| match (grid.sides[along][end], sides[along][end]) {
        (Side::Periodic, _) => End::Cyclic,
        (_, Some(_)) => End::Held,
        (_, None) => End::Free,
    };
    let ends = [0, 1, 2].map(|along| [end(along, 0), end(along, 1)]);
    let walls = sides.map(|ends| ends.map(|value| Wall::Same(value.unwrap_or(0.0))));
    let counts = field.counts;
    let kind = coefficients.kind(grid, diffusivity, dt_s, None, counts, ends, held.cells);
    diffuse(grid, field, spare, &Spread { kind, counts, ends, component: None, walls, is_given: [[false; 2]; 3] });
}
