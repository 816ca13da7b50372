//! Slopes between the centres of neighbouring cells, without a branch inside a row.
//!
//! Rows along x get a value on either end, so that every cell has two neighbours: the cell's own
//! at a side, the opposite end's where the box is periodic.

use crate::grid::Grid;
use crate::limits::MAX_AXIS_CELLS;
use crate::sides::Side;

/// A row with a neighbour on either end.
pub(crate) const EMPTY_ROW: [f32; MAX_AXIS_CELLS + 2] = [0.0; MAX_AXIS_CELLS + 2];

/// One over the distance between the neighbours of a cell, 1/m, by axis and index.
pub(crate) fn per_m(grid: &Grid) -> [Vec<f32>; 3] {
    std::array::from_fn(|axis| {
        let count = grid.cells[axis];
        let inverse = 1.0 / grid.cell_m[axis];
        let is_between = |index: usize| is_periodic(grid, axis) || (index > 0 && index + 1 < count);
        (0..count).map(|index| if is_between(index) { 0.5 * inverse } else { inverse }).collect()
    })
}

/// Whether the two ends of an axis are one.
pub(crate) fn is_periodic(grid: &Grid, axis: usize) -> bool {
    grid.sides[axis][0] == Side::Periodic
}

/// Indices of a cell's neighbours along an axis; its own where there is none.
#[inline(always)]
pub(crate) fn neighbours(grid: &Grid, axis: usize, index: usize) -> (usize, usize) {
    let count = grid.cells[axis];
    let is_periodic = is_periodic(grid, axis);
    let low = if index > 0 {
        index - 1
    } else if is_periodic {
        count - 1
    } else {
        index
    };
    let high = if index + 1 < count {
        index + 1
    } else if is_periodic {
        0
    } else {
        index
    };
    (low, high)
}

/// Puts the neighbours beyond the ends of a row into their places.
#[inline(always)]
pub(crate) fn pad(row: &mut [f32], is_periodic: bool) {
    let last = row.len() - 2;
    (row[0], row[last + 1]) = if is_periodic { (row[last], row[1]) } else { (row[1], row[last]) };
}

/// Splits a run into arrays of `plane` values.
#[inline(always)]
pub(crate) fn parts<const N: usize>(values: &mut [f32], plane: usize) -> [&mut [f32]; N] {
    let mut chunks = values.chunks_exact_mut(plane);
    std::array::from_fn(|_| chunks.next().unwrap_or_default())
}
