//! The grid: counts, lengths, sides, and where the values of each field lie.

use glam::Vec3;

use crate::limits::PARALLEL_CELLS;
use crate::parallel::Execution;
use crate::sides::Side;
use crate::simd::Simd;

/// Shape of the box. Never changes after `build`.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    pub(crate) cells: [usize; 3],
    pub(crate) cell_m: [f32; 3],
    pub(crate) origin: Vec3,
    pub(crate) size_m: Vec3,
    pub(crate) sides: [[Side; 2]; 3],
    pub(crate) exec: Execution,
}

impl Grid {
    pub(crate) fn new(cells: [usize; 3], origin: Vec3, size_m: Vec3, sides: [[Side; 2]; 3]) -> Self {
        let size = size_m.to_array();
        let cell_m = std::array::from_fn(|axis| size[axis] / cells[axis] as f32);
        let is_parallel = cells.iter().product::<usize>() >= PARALLEL_CELLS;
        Self { cells, cell_m, origin, size_m, sides, exec: Execution { is_parallel, simd: Simd::best() } }
    }

    /// Which axes repeat themselves.
    pub(crate) fn periodic(&self) -> [bool; 3] {
        self.sides.map(|sides| sides[0] == Side::Periodic)
    }

    /// Number of cells.
    pub(crate) fn count(&self) -> usize {
        self.cells.iter().product()
    }

    /// Number of cells in a z-plane.
    pub(crate) fn plane(&self) -> usize {
        self.cells[0] * self.cells[1]
    }

    /// Volume of a cell, m³.
    pub(crate) fn cell_volume_m3(&self) -> f64 {
        self.cell_m.iter().map(|edge| f64::from(*edge)).product()
    }

    /// Values along each axis of the velocity component `axis`.
    pub(crate) fn face_counts(&self, axis: usize) -> [usize; 3] {
        let mut counts = self.cells;
        counts[axis] += 1;
        counts
    }

    /// Cells after which the box repeats, by axis; 0 where it does not.
    pub(crate) fn periods(&self) -> [usize; 3] {
        [0, 1, 2].map(|axis| if self.sides[axis][0] == Side::Periodic { self.cells[axis] } else { 0 })
    }

    /// Shortest edge of a cell, m.
    pub(crate) fn shortest_m(&self) -> f32 {
        self.cell_m[0].min(self.cell_m[1]).min(self.cell_m[2])
    }

    /// A point in cells from the low corner.
    pub(crate) fn cells_from_point(&self, point: Vec3) -> [f32; 3] {
        let from_corner = (point - self.origin).to_array();
        std::array::from_fn(|axis| from_corner[axis] / self.cell_m[axis])
    }

    /// The cell that holds a point; none outside the box.
    pub(crate) fn cell_of_point(&self, point: Vec3) -> Option<[usize; 3]> {
        let at = self.cells_from_point(point);
        let is_inside = (0..3).all(|axis| at[axis] >= 0.0 && at[axis] <= self.cells[axis] as f32);
        is_inside.then(|| std::array::from_fn(|axis| (at[axis] as usize).min(self.cells[axis] - 1)))
    }

    /// Whether no side lets the pressure out: it is then known up to a constant only.
    pub(crate) fn is_sealed(&self) -> bool {
        !self.sides.iter().flatten().any(|side| *side == Side::Open)
    }
}
