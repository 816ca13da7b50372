//! A scalar on a lattice: cell centres, or the faces across one axis.

use crate::grid::Grid;

/// Values with their lattice; x fastest, then y, then z.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub(crate) data: Vec<f32>,
    pub(crate) counts: [usize; 3],
    /// Where value (0,0,0) lies, in cells from the low corner of the box.
    pub(crate) offset: [f32; 3],
}

impl Field {
    /// Zeros at the centres of the cells.
    pub(crate) fn at_centres(grid: &Grid) -> Self {
        Self { data: vec![0.0; grid.count()], counts: grid.cells, offset: [0.5; 3] }
    }

    /// Zeros on the faces across `axis`.
    pub(crate) fn on_faces(grid: &Grid, axis: usize) -> Self {
        let counts = grid.face_counts(axis);
        let mut offset = [0.5; 3];
        offset[axis] = 0.0;
        Self { data: vec![0.0; counts.iter().product()], counts, offset }
    }

    /// Values in a z-plane.
    pub(crate) fn plane(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// Trilinear sample at a place in cells from the low corner; clamped to the lattice.
    #[inline]
    pub(crate) fn sample(&self, at: [f32; 3]) -> f32 {
        self.sample_lattice([at[0] - self.offset[0], at[1] - self.offset[1], at[2] - self.offset[2]])
    }

    /// Trilinear sample at lattice coordinates; clamped to the lattice.
    #[inline]
    pub(crate) fn sample_lattice(&self, at: [f32; 3]) -> f32 {
        let [nx, ny, nz] = self.counts;
        let (i, fx) = split(at[0], nx);
        let (j, fy) = split(at[1], ny);
        let (k, fz) = split(at[2], nz);
        let plane = nx * ny;
        let base = i + nx * j + plane * k;
        let (low, high) = (&self.data[base..base + nx + 2], &self.data[base + plane..base + plane + nx + 2]);
        let along_x = |row: &[f32], at: usize| row[at] + fx * (row[at + 1] - row[at]);
        let (a, b) = (along_x(low, 0), along_x(low, nx));
        let (c, d) = (along_x(high, 0), along_x(high, nx));
        let (e, f) = (a + fy * (b - a), c + fy * (d - c));
        e + fz * (f - e)
    }
}

/// Whole and fractional part of a lattice coordinate, clamped so that the next value exists.
/// What is not a number counts as zero.
#[inline]
fn split(at: f32, count: usize) -> (usize, f32) {
    let at = at.max(0.0).min((count - 1) as f32);
    let whole = (at as i32 as usize).min(count - 2);
    (whole, at - whole as f32)
}
