//! The evaluation of a net on a plan, in two stages.
//!
//! The net is contracted along u first: for each column of the grid, `points along v` points and
//! their derivatives. A register holds neighbouring columns, so that the second contraction, along
//! v, has the same factors for a whole row of vertices, and nothing is ever gathered.

use alloc::vec::Vec;

use super::net::Net;
use super::output::Each;
use super::{GridOutput, GridPlan, GridVertex, kernels, topology};
use crate::{NurbsError, Real, check};
use core::ops::Range;
use fearless_simd::dispatch;

/// Working memory of [`GridPlan::evaluate`].
///
/// It grows to what a plan needs on first use, and does not shrink: later evaluations of plans of
/// the same size or smaller allocate nothing.
#[derive(Clone, Debug, Default)]
pub struct Scratch<T> {
    /// The net about its origin, divided by its size: row by row.
    net: Vec<T>,
    /// All columns, contracted along u: see [`kernels::contract`].
    columns: Vec<T>,
    /// The same for the end of v that is being computed, at the middles of the columns.
    pole: Vec<T>,
    /// Some rows of vertices.
    rows: Vec<[T; 8]>,
}

impl<T: Real> Scratch<T> {
    /// Empty working memory.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of scalars it can hold without allocating.
    pub fn capacity(&self) -> usize {
        let own: usize = [&self.net, &self.columns, &self.pole].into_iter().map(Vec::capacity).sum();
        own + 8 * self.rows.capacity()
    }
}

/// Vertices that are kept in fast memory before they go to an output of another form.
const STAGED: usize = 512;

impl<T: Real> GridPlan<T> {
    /// Working memory of the right size.
    pub fn scratch(&self) -> Scratch<T> {
        let mut scratch = Scratch::new();
        self.resize(&mut scratch, 4);
        scratch.rows.resize(self.staged_rows() * (self.options.columns + 1), [T::ZERO; 8]);
        scratch
    }

    /// Computes the mesh of a net and hands each vertex to `emit`, in the order of their indices.
    ///
    /// `points` holds the net row by row, point `(i, j)` at `i * n_v + j`. Points repeated to close
    /// u periodically may be left out; they are not read.
    ///
    /// Normals are those of the surface, also where an edge collapses (see
    /// [`Surface::normal`](crate::Surface::normal)). Where the surface has no tangent plane, the
    /// normal is the mean of the adjacent triangles; where these have no area, it points along the
    /// net, from the first to the last point of its first row, at the lower end of v the other way;
    /// and a net that is a single point has the normal `(0, 1, 0)`.
    ///
    /// Nothing is allocated once `scratch` has the right size.
    ///
    /// # Errors
    /// When the number of points or weights is wrong, a coordinate is not finite or a weight is
    /// not positive. Then `emit` has not been called.
    pub fn evaluate(
        &self,
        points: &[[T; 3]],
        weights: Option<&[T]>,
        scratch: &mut Scratch<T>,
        emit: impl FnMut(usize, GridVertex<T>),
    ) -> Result<(), NurbsError> {
        self.evaluate_into(points, weights, scratch, &mut Each(emit))
    }

    /// [`evaluate`](Self::evaluate) into a buffer. See [`GridOutput`] for the forms it can have.
    ///
    /// # Errors
    /// As for [`evaluate`](Self::evaluate); also when the output has no room for
    /// [`vertex_count`](Self::vertex_count) vertices. Then nothing has been written.
    pub fn evaluate_into<O: GridOutput<T> + ?Sized>(
        &self,
        points: &[[T; 3]],
        weights: Option<&[T]>,
        scratch: &mut Scratch<T>,
        output: &mut O,
    ) -> Result<(), NurbsError> {
        let needed = self.vertex_count();
        if output.room() < needed {
            return Err(NurbsError::Room { found: output.room(), needed });
        }
        let count = self.point_count();
        let repeated = self.u.points_repeated * self.v.points;
        check::length(points.len(), if points.len() == repeated { repeated } else { count })?;
        if let Some(weights) = weights {
            check::weights(weights, points.len())?;
        }
        self.resize(scratch, if weights.is_some() { 4 } else { 3 });
        let Scratch { net, columns, pole, rows } = scratch;
        let net = Net::new(net, &points[..count], weights.map(|weights| &weights[..count]), self.v.points)?;
        let level = self.level.level();
        dispatch!(level, simd => kernels::contract(simd, &self.blocks, &net, &self.v.all, columns));

        let mut fill = |range: Range<usize>, to: &mut [[T; 8]]| {
            dispatch!(level, simd => kernels::fill_rows(simd, self, &net, columns, pole, range.clone(), to));
        };
        let last = self.options.rows + 1;
        if let Some(plain) = output.plain() {
            fill(0..last, &mut plain[..needed]);
            return Ok(());
        }
        rows.resize(rows.len().max(self.staged_rows() * (self.options.columns + 1)), [T::ZERO; 8]);
        let mut from = 0;
        while from < last {
            let to = (from + self.staged_rows()).min(last);
            let start = topology::row_start(&self.options, from);
            let rows = &mut rows[..topology::row_end(&self.options, to - 1) - start];
            fill(from..to, rows);
            for (index, &vertex) in (start..).zip(&*rows) {
                output.vertex(index, GridVertex::from(vertex));
            }
            from = to;
        }
        Ok(())
    }

    /// Rows that are staged at once.
    fn staged_rows(&self) -> usize {
        (STAGED / (self.options.columns + 1)).clamp(1, self.options.rows + 1)
    }

    fn resize(&self, scratch: &mut Scratch<T>, parts: usize) {
        let column = 2 * parts * self.blocks.len() * self.blocks.lanes;
        scratch.net.resize(self.point_count() * parts, T::ZERO);
        scratch.columns.resize(self.v.points * column, T::ZERO);
        if self.middle.is_some() {
            scratch.pole.resize(self.v.width * column, T::ZERO);
        }
    }
}
