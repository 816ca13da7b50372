//! The two passes: slabs of one y for the lines along z, planes of one z for the others.

use super::line::{End, Line};
use super::lines::{solve_rows, solve_transposed};
use super::varying::{Axis, Bundle, Job, Varying};
use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::sides::Wall;

/// A field about to be spread: its lines along each axis, and which of its values are given.
pub(super) struct Spread<'a> {
    pub(super) kind: Kind<'a>,
    /// Counts of values, without the last face of a periodic axis, which is its first one.
    pub(super) counts: [usize; 3],
    pub(super) ends: [[End; 2]; 3],
    /// The axis of a velocity component.
    pub(super) component: Option<usize>,
    /// What is held at the two ends of each axis.
    pub(super) walls: [[Wall<'a>; 2]; 3],
    /// Ends, by axis, where the values themselves lie on the side and stay.
    pub(super) is_given: [[bool; 2]; 3],
}

pub(super) enum Kind<'a> {
    /// One diffusivity everywhere: one system for all lines of an axis.
    Even(&'a [Line; 3]),
    Varying(Varying<'a>),
}

impl Spread<'_> {
    /// Whether the systems along an axis change nothing: one cell alone has nobody to spread to.
    fn is_idle(&self, axis: usize) -> bool {
        self.counts[axis] == 1 && !self.ends[axis].contains(&End::Held) || self.is_flat(axis)
    }

    /// Along the axis of one cell nothing moves.
    fn is_flat(&self, axis: usize) -> bool {
        self.component == Some(axis) && self.is_given[axis] == [true; 2] && self.counts[axis] == 2
    }

    fn stays(&self, axis: usize, at: usize) -> bool {
        let is_given = self.is_given[axis];
        (at == 0 && is_given[0]) || (at + 1 == self.counts[axis] && is_given[1])
    }

    fn axis(&self, grid: &Grid, axis: usize) -> Axis {
        Axis {
            count: self.counts[axis],
            per_square_m: 1.0 / (grid.cell_m[axis] * grid.cell_m[axis]),
            ends: self.ends[axis],
            is_own: self.component == Some(axis),
        }
    }

    /// Solves along z in place: the slab at `j`, `[z][x]`.
    #[inline(always)]
    fn solve_z(&self, grid: &Grid, field: &Field, j: usize, slab: &mut [f32]) {
        let [nx, ny, _] = field.counts;
        let walls = self.walls[2].map(|wall| wall.part(nx * j, nx));
        match &self.kind {
            Kind::Even(lines) => solve_rows(slab, nx, &lines[2], walls),
            Kind::Varying(varying) => {
                let at = Bundle { first: nx * j, along: nx * ny, across: 1, lines: nx };
                let cells_at = Bundle { first: grid.cells[0] * j, along: grid.plane(), ..at };
                let job = Job { from: Some(&field.data), from_at: at, field_at: at, cells_at, walls };
                varying.solve(self.axis(grid, 2), &job, slab, Bundle { first: 0, along: nx, ..at });
                self.repeat_last(2, slab, nx);
            }
        }
    }

    /// Solves along x and y: the plane at `k`, out of the slabs.
    #[inline(always)]
    fn solve_plane(&self, grid: &Grid, counts: [usize; 3], slabs: &[f32], k: usize, plane: &mut [f32]) {
        let [nx, ny, nz] = counts;
        let row = |j: usize| &slabs[nx * (k + nz * j)..][..nx];
        let inner = usize::from(self.is_given[1][0])..ny - usize::from(self.is_given[1][1]);
        let walls_x = self.walls[0].map(|wall| wall.part(ny * k, ny));
        let walls_y = self.walls[1].map(|wall| wall.part(nx * k, nx));
        let cells_first = grid.plane() * k;
        match &self.kind {
            _ if self.is_idle(0) => inner.for_each(|j| plane[nx * j..][..nx].copy_from_slice(row(j))),
            Kind::Even(lines) => solve_transposed(plane, nx, inner, row, &lines[0], walls_x),
            Kind::Varying(varying) => {
                let lines = inner.len();
                let from_at = Bundle { first: nx * (k + nz * inner.start), along: 1, across: nx * nz, lines };
                let out_at = Bundle { first: nx * inner.start, along: 1, across: nx, lines };
                let field_at = Bundle { first: nx * (inner.start + ny * k), ..out_at };
                let cells_at =
                    Bundle { first: cells_first + grid.cells[0] * inner.start, across: grid.cells[0], ..out_at };
                let walls = walls_x.map(|wall| wall.part(inner.start, lines));
                let job = Job { from: Some(slabs), from_at, field_at, cells_at, walls };
                varying.solve(self.axis(grid, 0), &job, plane, out_at);
                self.repeat_last(0, plane, nx);
            }
        }
        if self.is_idle(1) {
            return;
        }
        match &self.kind {
            Kind::Even(lines) => solve_rows(plane, nx, &lines[1], walls_y),
            Kind::Varying(varying) => {
                let out_at = Bundle { first: 0, along: nx, across: 1, lines: nx };
                let field_at = Bundle { first: nx * ny * k, ..out_at };
                let cells_at = Bundle { first: cells_first, ..out_at };
                let job = Job { from: None, from_at: out_at, field_at, cells_at, walls: walls_y };
                varying.solve(self.axis(grid, 1), &job, plane, out_at);
                self.repeat_last(1, plane, nx);
            }
        }
    }

    /// Copies the first value of a periodic axis to its last, in a plane or slab of rows.
    #[inline(always)]
    fn repeat_last(&self, axis: usize, rows: &mut [f32], nx: usize) {
        if self.component != Some(axis) || self.ends[axis][0] != End::Cyclic {
            return;
        }
        if axis == 0 {
            rows.chunks_exact_mut(nx).for_each(|row| row[nx - 1] = row[0]);
        } else {
            rows.copy_within(..nx, rows.len() - nx);
        }
    }
}

/// Spreads `field` in place.
pub(super) fn diffuse(grid: &Grid, field: &mut Field, spare: &mut Field, spread: &Spread<'_>) {
    let counts = field.counts;
    let [nx, ny, nz] = counts;
    // Along z, into slabs `[y][z][x]`.
    let from: &Field = field;
    for_planes(
        grid.exec,
        &mut spare.data,
        nx * nz,
        #[inline(always)]
        |j, slab| {
            for (k, row) in slab.chunks_exact_mut(nx).enumerate() {
                row.copy_from_slice(&from.data[nx * (j + ny * k)..][..nx]);
            }
            if spread.is_idle(2) || spread.stays(1, j) {
                return;
            }
            spread.solve_z(grid, from, j, slab);
            for (end, i) in [0, nx - 1].into_iter().enumerate() {
                if spread.is_given[0][end] {
                    (0..nz).for_each(|k| slab[i + nx * k] = from.data[i + nx * (j + ny * k)]);
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
            if !spread.stays(2, k) {
                spread.solve_plane(grid, counts, slabs, k, plane);
            }
        },
    );
}
