//! The way that the air of each cell went during a step, and the way on that it will go.
//!
//! One way is traced a cell; faces take the mean of the two cells beside them.

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::Trace;
use super::back::Kind;
use super::sample::{LANES, Lattice, V, active, load, ramp, sample, store};
use crate::grid::Grid;
use crate::parallel::{Partial, PlaneKernel, run_planes};

/// Ways in cells. A row of them has one before the first cell and one after the last: repeated at
/// walls, from around the corner where the axis is periodic; and room for whole vectors.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ways {
    data: Vec<f32>,
    cells: [usize; 3],
    periodic: [bool; 3],
    /// Values a row.
    stride: usize,
    /// Rows for each row of cells: 3, or 6 with the way on.
    parts: usize,
}

/// What the trace asks of a flow.
#[derive(Clone, Copy)]
pub(crate) struct Motion<'a> {
    /// Velocities on the faces, with a copy of the first plane behind the last one along
    /// periodic axes.
    pub(super) velocity: [Lattice<'a>; 3],
    /// Velocity of the grid itself, m/s.
    pub(super) frame: [f32; 3],
    pub(super) dt_s: f32,
}

impl Ways {
    fn plane(&self) -> usize {
        self.stride * self.parts * self.cells[1]
    }

    /// Traces the way of each cell; with `has_forth` also the way on, as long as this one to
    /// second order in the step: twice the step's way with the present velocity, less the way back.
    pub(super) fn trace<const WRAPS: bool>(
        &mut self,
        grid: &Grid,
        motion: &Motion,
        order: Trace,
        has_forth: bool,
        partials: &mut [Partial],
    ) {
        self.cells = grid.cells;
        self.periodic = grid.periodic();
        self.stride = grid.cells[0].next_multiple_of(LANES) + 2 * LANES;
        self.parts = if has_forth { 6 } else { 3 };
        let plane = self.plane();
        self.data.resize(plane * grid.cells[2], 0.0);
        let per_speed = grid.cell_m.map(|edge| motion.dt_s / edge);
        let kernel = Tracer::<WRAPS> { grid, motion, per_speed, order, has_forth, stride: self.stride };
        run_planes(grid.exec, &mut self.data, plane, partials, &kernel);
    }

    /// Start of the row of cells (j, k) in the part.
    #[inline(always)]
    fn row(&self, part: usize, j: usize, k: usize) -> usize {
        self.stride * (part + self.parts * (j + self.cells[1] * k))
    }

    /// The ways of a row of values; `from` is 0 for the way back, 3 for the way on.
    #[inline(always)]
    pub(super) fn of_row(&self, kind: Kind, from: usize, j: usize, k: usize) -> RowWays<'_> {
        let beside = |at: usize, across: usize| {
            let count = self.cells[across];
            if kind != Kind::faces(across) {
                (at, at)
            } else if self.periodic[across] {
                ((at + count - 1) % count, at % count)
            } else {
                (at.saturating_sub(1), at.min(count - 1))
            }
        };
        let (j_low, j_high) = beside(j, 1);
        let (k_low, k_high) = beside(k, 2);
        let parts = |j: usize, k: usize| {
            let at = self.row(from, j, k);
            let (x, rest) = self.data[at..at + 3 * self.stride].split_at(self.stride);
            let (y, z) = rest.split_at(self.stride);
            [x, y, z]
        };
        RowWays {
            low: parts(j_low, k_low),
            high: (kind != Kind::CENTRES).then(|| parts(j_high, k_high)),
            back: usize::from(kind == Kind::faces(0)),
        }
    }
}

/// Ways of a row of values, along x, y and z.
pub(super) struct RowWays<'a> {
    /// Of the cells before faces, or the cells themselves.
    low: [&'a [f32]; 3],
    /// Of the cells behind.
    high: Option<[&'a [f32]; 3]>,
    /// How many cells the lower ones are further along the row.
    back: usize,
}

impl RowWays<'_> {
    /// The ways of sixteen values from `first` on.
    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, simd: S, first: usize) -> [V<S>; 3] {
        let mut ways = [V::splat(simd, 0.0); 3];
        for (way, row) in ways.iter_mut().zip(&self.low) {
            let at = first + 1 - self.back;
            *way = V::from_slice(simd, &row[at..at + LANES]);
        }
        if let Some(high) = &self.high {
            for (way, row) in ways.iter_mut().zip(high) {
                *way = (*way + V::from_slice(simd, &row[first + 1..first + 1 + LANES])) * 0.5;
            }
        }
        ways
    }
}

struct Tracer<'a, const WRAPS: bool> {
    grid: &'a Grid,
    motion: &'a Motion<'a>,
    per_speed: [f32; 3],
    order: Trace,
    has_forth: bool,
    stride: usize,
}

impl<const WRAPS: bool> PlaneKernel<f32> for Tracer<'_, WRAPS> {
    #[inline(always)]
    fn plane<S: Simd>(&self, simd: S, k: usize, out: &mut [f32]) -> Partial {
        let nx = self.grid.cells[0];
        let [u, v, w] = &self.motion.velocity;
        let [u_counts, v_counts, w_counts] = [u.counts(), v.counts(), w.counts()];
        let is_periodic = WRAPS && self.grid.periodic()[0];
        let parts = if self.has_forth { 6 } else { 3 };
        for (j, rows) in out.chunks_exact_mut(parts * self.stride).enumerate() {
            let u_row = &u.data[u_counts[0] * (j + u_counts[1] * k)..];
            let v_at = v_counts[0] * (j + v_counts[1] * k);
            let (v_low, v_high) = (&v.data[v_at..], &v.data[v_at + v_counts[0]..]);
            let w_at = w_counts[0] * (j + w_counts[1] * k);
            let (w_low, w_high) = (&w.data[w_at..], &w.data[w_at + w_counts[0] * w_counts[1]..]);
            for block in 0..nx.div_ceil(LANES) {
                let first = LANES * block;
                let centre = [
                    load(simd, u_row, first) + load(simd, u_row, first + 1),
                    load(simd, v_low, first) + load(simd, v_high, first),
                    load(simd, w_low, first) + load(simd, w_high, first),
                ];
                let frame = self.motion.frame;
                // The way with the velocity at the centre.
                let mut straight = centre;
                for axis in 0..3 {
                    straight[axis] = (centre[axis] * 0.5 - frame[axis]) * self.per_speed[axis];
                }
                let mut back = straight;
                if self.order == Trace::Midpoint {
                    let x = ramp(simd) + first as f32 - straight[0] * 0.5;
                    let y = V::splat(simd, j as f32) - straight[1] * 0.5;
                    let z = V::splat(simd, k as f32) - straight[2] * 0.5;
                    let lanes = active(nx, first);
                    // They count from the centre of cell (0,0,0); faces begin half a cell before.
                    back = [
                        sample::<S, WRAPS>(simd, u, [x + 0.5, y, z], lanes),
                        sample::<S, WRAPS>(simd, v, [x, y + 0.5, z], lanes),
                        sample::<S, WRAPS>(simd, w, [x, y, z + 0.5], lanes),
                    ];
                    for axis in 0..3 {
                        back[axis] = (back[axis] - frame[axis]) * self.per_speed[axis];
                    }
                }
                for axis in 0..3 {
                    store(&mut rows[axis * self.stride + first + 1..], back[axis]);
                    if self.has_forth {
                        let forth = straight[axis] * 2.0 - back[axis];
                        store(&mut rows[(3 + axis) * self.stride + first + 1..], forth);
                    }
                }
            }
            for row in rows.chunks_exact_mut(self.stride) {
                row[0] = if is_periodic { row[nx] } else { row[1] };
                row[nx + 1] = if is_periodic { row[1] } else { row[nx] };
            }
        }
        Partial::default()
    }
}
