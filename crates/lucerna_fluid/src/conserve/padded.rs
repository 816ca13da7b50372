//! Arrays with layers around them that hold what lies beyond the sides, so that loops over rows
//! need no branch.
//!
//! Cells and faces of all kinds share one shape: a face is kept at the place of the cell above
//! it. There are two layers below and three above, the first of which is the last face's.

use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::sides::{Side, Wall};

/// Layers below the first cell.
const LOW: usize = 2;
/// Layers in all.
const LAYERS: usize = 5;

/// The shape of the arrays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Shape {
    /// From a value to the next along each axis.
    pub(super) strides: [usize; 3],
    pub(super) total: usize,
}

impl Shape {
    pub(super) fn new(grid: &Grid) -> Self {
        let [nx, ny, nz] = grid.cells.map(|cells| cells + LAYERS);
        Self { strides: [1, nx, nx * ny], total: nx * ny * nz }
    }

    /// Place of a cell, or of the face below it.
    #[inline(always)]
    pub(super) fn at(&self, [i, j, k]: [usize; 3]) -> usize {
        (i + LOW) + self.strides[1] * (j + LOW) + self.strides[2] * (k + LOW)
    }

    /// Values in a plane.
    pub(super) fn plane(&self) -> usize {
        self.strides[2]
    }

    /// Where a row starts in its plane.
    #[inline(always)]
    fn row(&self, j: usize) -> usize {
        LOW + self.strides[1] * (j + LOW)
    }

    /// Calls `work` with the place of each value next to the low end of `axis`, and its number
    /// counted along the two other axes, the faster one first; `counts` are those of the values.
    #[inline(always)]
    fn each(&self, counts: [usize; 3], axis: usize, mut work: impl FnMut(usize, usize)) {
        let [first, second] = [[1, 2], [0, 2], [0, 1]][axis];
        let mut number = 0;
        for b in 0..counts[second] {
            for a in 0..counts[first] {
                let mut index = [0; 3];
                (index[first], index[second]) = (a, b);
                work(self.at(index), number);
                number += 1;
            }
        }
    }
}

/// The plane of `count` that a padded plane is; none for one of the layers.
#[inline(always)]
fn inner(plane: usize, count: usize) -> Option<usize> {
    plane.checked_sub(LOW).filter(|k| *k < count)
}

/// Calls `work` with the place of each row of a padded array's own values, the row's place in an
/// array that is not padded, and its values; `counts` are those without the layers.
#[inline(always)]
pub(super) fn for_rows(
    grid: &Grid,
    shape: Shape,
    counts: [usize; 3],
    out: &mut [f32],
    work: impl Fn(usize, usize, &mut [f32]) + Sync + Send,
) {
    let [nx, ny, nz] = counts;
    for_planes(
        grid.exec,
        out,
        shape.plane(),
        #[inline(always)]
        |plane, out| {
            let Some(k) = inner(plane, nz) else { return };
            for j in 0..ny {
                work(shape.at([0, j, k]), nx * (j + ny * k), &mut out[shape.row(j)..][..nx]);
            }
        },
    );
}

/// Copies a field with the given counts of values into a padded array.
pub(super) fn copy_in(grid: &Grid, shape: Shape, field: &[f32], counts: [usize; 3], out: &mut [f32]) {
    for_rows(
        grid,
        shape,
        counts,
        out,
        #[inline(always)]
        |_, place, out| out.copy_from_slice(&field[place..][..out.len()]),
    );
}

/// Fills the layers around values at the centres: with `outside` where air comes in, with what is
/// next to them elsewhere. `flow` are the velocities against the grid.
pub(super) fn surround_cells(grid: &Grid, shape: Shape, values: &mut [f32], flow: &[Vec<f32>; 3], outside: f32) {
    for (axis, flow) in flow.iter().enumerate() {
        let (stride, count) = (shape.strides[axis], grid.cells[axis]);
        for end in 0..2 {
            let side = grid.sides[axis][end];
            shape.each(grid.cells, axis, |low, _| {
                let (inner, face) =
                    if end == 0 { (low, low) } else { (low + (count - 1) * stride, low + count * stride) };
                for layer in 1..=2 {
                    let place = if end == 0 { inner - layer * stride } else { inner + layer * stride };
                    values[place] = match side {
                        Side::Periodic if end == 0 => values[low + (count - layer.min(count)) * stride],
                        Side::Periodic => values[low + (layer - 1).min(count - 1) * stride],
                        side if side.lets_in() && (flow[face] > 0.0) == (end == 0) => outside,
                        _ => values[inner],
                    };
                }
            });
        }
    }
}

/// Fills the layer around a velocity component: so that the mean across a side is `given` where
/// air comes in, and with what is next to it elsewhere. `flow` are the velocities against the grid.
pub(super) fn surround_faces<'a>(
    grid: &Grid,
    shape: Shape,
    component: usize,
    values: &mut [f32],
    flow: &[Vec<f32>; 3],
    given: impl Fn(usize, usize) -> Wall<'a>,
) {
    let own = shape.strides[component];
    let counts = grid.face_counts(component);
    for axis in 0..3 {
        let stride = shape.strides[axis];
        let last = counts[axis] - 1;
        let cells = grid.cells[axis];
        for end in 0..2 {
            let side = grid.sides[axis][end];
            let wall = given(axis, end);
            shape.each(counts, axis, |low, number| {
                let (inner, face) = if end == 0 { (low, low) } else { (low + last * stride, low + cells * stride) };
                let place = if end == 0 { inner - stride } else { inner + stride };
                values[place] = match side {
                    Side::Periodic if end == 0 => values[low + (cells - 1) * stride],
                    Side::Periodic if axis == component => values[low + usize::from(cells > 1) * stride],
                    Side::Periodic => values[low],
                    side if side.lets_in() => {
                        let through = if axis == component {
                            flow[axis][face]
                        } else {
                            flow[axis][face] + flow[axis][face - own]
                        };
                        let given = match wall {
                            Wall::Same(value) => value,
                            Wall::Each(values) => values[number],
                        };
                        let comes_in = if end == 0 { through > 0.0 } else { through < 0.0 };
                        if comes_in { 2.0 * given - values[inner] } else { values[inner] }
                    }
                    _ => values[inner],
                };
            });
        }
    }
}

/// Fills the layer around fluxes through the faces across `component` with what is next to it.
pub(super) fn surround_fluxes(grid: &Grid, shape: Shape, component: usize, values: &mut [f32]) {
    let counts = grid.face_counts(component);
    for axis in 0..3 {
        let (stride, cells) = (shape.strides[axis], grid.cells[axis]);
        let last = counts[axis] - 1;
        let is_periodic = grid.sides[axis][0] == Side::Periodic;
        shape.each(counts, axis, |low, _| {
            let high = low + last * stride;
            (values[low - stride], values[high + stride]) = match (is_periodic, axis == component) {
                (true, true) => (values[low + (cells - 1) * stride], values[low + usize::from(cells > 1) * stride]),
                (true, false) => (values[high], values[low]),
                _ => (values[low], values[high]),
            };
        });
    }
}

/// Fills the layer around a pressure: zero on the face of an open side, even elsewhere.
pub(super) fn surround_pressure(grid: &Grid, shape: Shape, values: &mut [f32]) {
    for axis in 0..3 {
        let (stride, count) = (shape.strides[axis], grid.cells[axis]);
        shape.each(grid.cells, axis, |low, _| {
            let high = low + (count - 1) * stride;
            let beyond = |side: Side, own: f32, opposite: f32| match side {
                Side::Periodic => opposite,
                Side::Open => -own,
                _ => own,
            };
            let (first, last) = (values[low], values[high]);
            values[low - stride] = beyond(grid.sides[axis][0], first, last);
            values[high + stride] = beyond(grid.sides[axis][1], last, first);
        });
    }
}
