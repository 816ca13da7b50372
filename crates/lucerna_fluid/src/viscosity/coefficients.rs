//! What the systems of a field are made of: one diffusivity, or one a value.

use super::Diffusivity;
use super::line::{End, Line};
use super::spread::Kind;
use super::varying::Varying;
use crate::grid::Grid;
use crate::limits::MAX_DIFFUSION_NUMBER;
use crate::sides::Side;

/// Arrays for the systems; empty until they are first needed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Coefficients {
    in_cells: Vec<f32>,
    at_values: Vec<f32>,
    light: Vec<f32>,
    /// Of a diffusivity that does not vary: along x, y and z.
    lines: Option<Box<[Line; 3]>>,
}

impl Coefficients {
    /// The systems of one field.
    #[expect(clippy::too_many_arguments, reason = "a field, and what acts on it")]
    pub(super) fn kind<'a>(
        &'a mut self,
        grid: &Grid,
        diffusivity: Diffusivity<'_>,
        dt_s: f32,
        component: Option<usize>,
        counts: [usize; 3],
        ends: [[End; 2]; 3],
        held: &'a [f32],
    ) -> Kind<'a> {
        let is_even = diffusivity.eddy_m2_s.is_none() && diffusivity.density.is_none() && held.is_empty();
        if is_even {
            let line = |along: usize| {
                Line::new(counts[along], diffusion_number(grid, along, diffusivity.uniform_m2_s, dt_s), ends[along])
            };
            let lines = [line(0), line(1), line(2)];
            match &mut self.lines {
                Some(place) => **place = lines,
                None => self.lines = Some(Box::new(lines)),
            }
        }
        if let (true, Some(lines)) = (is_even, &self.lines) {
            return Kind::Even(lines);
        }
        let most = MAX_DIFFUSION_NUMBER as f32 * grid.shortest_m() * grid.shortest_m();
        let spread = |eddy: f32| {
            let number = (diffusivity.uniform_m2_s + eddy) * dt_s;
            // What is not a number does not spread.
            if number > 0.0 { number.min(most) } else { 0.0 }
        };
        self.in_cells.clear();
        match diffusivity.eddy_m2_s {
            Some(eddy) => self.in_cells.extend(eddy.iter().map(|eddy| spread(*eddy))),
            None => self.in_cells.resize(grid.count(), spread(0.0)),
        }
        self.at_values.clear();
        self.light.clear();
        if let Some(density) = diffusivity.density {
            self.in_cells.iter_mut().zip(density).for_each(|(number, density)| *number *= density);
        }
        let in_cells = &self.in_cells;
        if let Some(axis) = component {
            to_faces(grid, axis, in_cells, &mut self.at_values);
            if let Some(density) = diffusivity.density {
                to_faces(grid, axis, density, &mut self.light);
                self.light.iter_mut().for_each(|density| *density = 1.0 / *density);
            }
        }
        let at_values = if component.is_some() { &self.at_values } else { &self.in_cells };
        Kind::Varying(Varying { at_values, in_cells: &self.in_cells, held, light: &self.light })
    }
}

/// Appends the means of the cells below and above each face across an axis; beyond a side the cell inside stands for the
/// one that is not there.
fn to_faces(grid: &Grid, axis: usize, in_cells: &[f32], out: &mut Vec<f32>) {
    let [nx, ny, nz] = grid.face_counts(axis);
    let cells = grid.cells;
    let last = cells[axis];
    let is_periodic = grid.sides[axis][0] == Side::Periodic;
    let beside = |at: usize| match at {
        0 if is_periodic => [last - 1, 0],
        at if at == last && is_periodic => [last - 1, 0],
        at => [at.saturating_sub(1), at.min(last - 1)],
    };
    let row = |j: usize, k: usize| &in_cells[cells[0] * (j + cells[1] * k)..][..cells[0]];
    for k in 0..nz {
        for j in 0..ny {
            if axis == 0 {
                let row = row(j, k);
                out.extend((0..nx).map(|i| {
                    let [low, high] = beside(i);
                    0.5 * (row[low] + row[high])
                }));
            } else {
                let [low, high] = beside([0, j, k][axis]);
                let (low, high) = if axis == 1 { (row(low, k), row(high, k)) } else { (row(j, low), row(j, high)) };
                out.extend(low.iter().zip(high).map(|(low, high)| 0.5 * (low + high)));
            }
        }
    }
}

/// Square of the way that something spreads during the step, in cells, halved.
pub(super) fn diffusion_number(grid: &Grid, along: usize, uniform_m2_s: f32, dt_s: f32) -> f64 {
    let edge = f64::from(grid.cell_m[along]);
    (f64::from(uniform_m2_s) * f64::from(dt_s) / (edge * edge)).min(MAX_DIFFUSION_NUMBER)
}
