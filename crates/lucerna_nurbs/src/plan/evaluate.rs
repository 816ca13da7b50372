//! The evaluation of a net on a plan, in two stages.
//!
//! The net is contracted along u first: for each column of the grid, `points along v` points and
//! their derivatives. These are stored with the columns side by side, so that the second
//! contraction, along v, has the same factors for a whole row of vertices and runs in vector
//! registers without gathering.

use alloc::vec::Vec;

use super::kernels::{combine, cross_rows, divide};
use super::{GridPlan, topology};
use crate::vector::{add_scaled, largest, sub};
use crate::{NurbsError, Real, check};

/// A vertex as [`GridPlan::evaluate`] hands it out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GridVertex<T> {
    /// The point of the surface, in the unit of the control points.
    pub position: [T; 3],
    /// The unit normal.
    pub normal: [T; 3],
    /// The place along u, 0 to 1 from the first column to the last.
    pub u: T,
    /// The place along v, 0 to 1.
    pub v: T,
}

/// Working memory of [`GridPlan::evaluate`].
///
/// It grows to what a plan needs on first use, and does not shrink: later evaluations of plans of
/// the same size or smaller allocate nothing.
#[derive(Clone, Debug, Default)]
pub struct Scratch<T> {
    /// The net about its origin, divided by its size: row by row.
    pub(super) net: Vec<T>,
    /// One column along v, before it is spread out, and its derivative.
    column: Vec<T>,
    /// Per point along v and coordinate: all columns; then the same for the derivative along u.
    columns: Vec<T>,
    /// One row of vertices: point, derivatives, normals.
    row: Vec<T>,
}

impl<T: Real> Scratch<T> {
    /// Empty working memory.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of scalars it can hold without allocating.
    pub fn capacity(&self) -> usize {
        [&self.net, &self.column, &self.columns, &self.row].into_iter().map(Vec::capacity).sum()
    }
}

/// What is known about a net before its vertices are computed.
pub(super) struct Net<'a, T> {
    pub(super) points: &'a [[T; 3]],
    /// The centred, scaled net of [`Scratch::net`].
    pub(super) scaled: &'a [T],
    /// 3, or 4 with weights.
    pub(super) parts: usize,
    pub(super) origin: [T; 3],
    pub(super) size: T,
}

impl<T: Real> GridPlan<T> {
    /// Working memory of the right size.
    pub fn scratch(&self) -> Scratch<T> {
        let mut scratch = Scratch::new();
        self.resize(&mut scratch, 4);
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
        let count = self.point_count();
        let repeated = self.u.points_repeated * self.v.points;
        let expected = if points.len() == repeated { repeated } else { count };
        check::points(points, expected)?;
        if let Some(weights) = weights {
            check::weights(weights, points.len())?;
        }
        let parts = if weights.is_some() { 4 } else { 3 };
        self.resize(scratch, parts);
        let points = &points[..count];
        let origin = points[0];
        let size = points.iter().fold(T::ZERO, |size, &point| size.max(largest(sub(point, origin))));
        fill(&mut scratch.net, points, weights, self.v.points, origin, size);
        self.contract_u(scratch, parts);
        let net = Net { points, scaled: &scratch.net, parts, origin, size };
        self.emit_rows(&net, &scratch.columns, &mut scratch.row, emit);
        Ok(())
    }

    /// Columns of the grid, rounded up to a multiple of a vector register.
    fn lanes(&self) -> usize {
        (self.options.columns + 1).next_multiple_of(8)
    }

    fn resize(&self, scratch: &mut Scratch<T>, parts: usize) {
        let (n_u, n_v, lanes) = (self.u.points, self.v.points, self.lanes());
        scratch.net.resize(n_u * n_v * parts, T::ZERO);
        scratch.column.resize(2 * n_v * parts, T::ZERO);
        scratch.columns.resize(2 * n_v * parts * lanes, T::ZERO);
        scratch.row.resize((3 * parts + 4) * lanes, T::ZERO);
    }

    /// The first stage: along u, and from columns side by side in time to side by side in memory.
    fn contract_u(&self, scratch: &mut Scratch<T>, parts: usize) {
        let (n_v, lanes) = (self.v.points, self.lanes());
        let stride = n_v * parts;
        let (points, slopes) = scratch.columns.split_at_mut(stride * lanes);
        let (point, slope) = scratch.column.split_at_mut(stride);
        for i in 0..=self.options.columns {
            let sample = self.u.sample(i);
            combine(point, &scratch.net, stride, sample.indices, sample.values);
            combine(slope, &scratch.net, stride, sample.indices, sample.slopes);
            for (to, &from) in points[i..].iter_mut().step_by(lanes).zip(&*point) {
                *to = from;
            }
            for (to, &from) in slopes[i..].iter_mut().step_by(lanes).zip(&*slope) {
                *to = from;
            }
        }
    }

    /// The second stage: along v, then normals, row by row.
    fn emit_rows(&self, net: &Net<'_, T>, columns: &[T], row: &mut [T], mut emit: impl FnMut(usize, GridVertex<T>)) {
        let lanes = self.lanes();
        let stride = net.parts * lanes;
        let (points, slopes) = columns.split_at(self.v.points * stride);
        let (s, rest) = row.split_at_mut(stride);
        let (su, rest) = rest.split_at_mut(stride);
        let (sv, normals) = rest.split_at_mut(stride);
        for j in 0..=self.options.rows {
            let sample = self.v.sample(j);
            combine(s, points, stride, sample.indices, sample.values);
            combine(su, slopes, stride, sample.indices, sample.values);
            combine(sv, points, stride, sample.indices, sample.slopes);
            if net.parts == 4 {
                divide(s, su, sv, lanes);
            }
            let sign = if self.options.flip { -T::ONE } else { T::ONE };
            cross_rows(su, sv, normals, lanes, sign);

            let at = |i: usize| {
                let mut position = net.origin;
                add_scaled(&mut position, &[s[i], s[lanes + i], s[2 * lanes + i]], net.size);
                position
            };
            let start = topology::row_start(&self.options, j);
            let len = topology::row_len(&self.options, j);
            let pole = len == self.options.columns;
            let shared = self.collapsed(net, j).or_else(|| pole.then(|| at(0)));
            let v = self.v.places[j];
            for i in 0..len {
                let place = if pole { self.middle.as_ref() } else { None };
                let exact = !pole && normals[3 * lanes + i] > T::ZERO;
                let normal = if exact {
                    [normals[i], normals[lanes + i], normals[2 * lanes + i]]
                } else {
                    self.limit_normal(net, i, j)
                };
                let vertex = GridVertex {
                    position: shared.unwrap_or_else(|| at(i)),
                    normal,
                    u: place.unwrap_or(&self.u).places[i],
                    v,
                };
                emit(start + i, vertex);
            }
        }
    }

    /// The control point into which row `j` collapses, when it does.
    fn collapsed(&self, net: &Net<'_, T>, j: usize) -> Option<[T; 3]> {
        if j != 0 && j != self.options.rows {
            return None;
        }
        let n_v = self.v.points;
        let column = self.v.only_point(j)?;
        let first = net.points[column];
        let mut rest = net.points[column..].iter().step_by(n_v);
        rest.all(|&point| point == first).then_some(first)
    }
}

/// The net about its origin and of size 1, in homogeneous coordinates when it has weights.
fn fill<T: Real>(net: &mut [T], points: &[[T; 3]], weights: Option<&[T]>, n_v: usize, origin: [T; 3], size: T) {
    let parts = if weights.is_some() { 4 } else { 3 };
    let by = T::ONE / size;
    let by = if by.is_finite() { by } else { T::ZERO };
    let rows = net.chunks_exact_mut(n_v * parts);
    for (i, (row, points)) in rows.zip(points.chunks_exact(n_v)).enumerate() {
        for (j, &point) in points.iter().enumerate() {
            let weight = weights.map_or(T::ONE, |weights| weights[i * n_v + j]);
            for (axis, x) in sub(point, origin).into_iter().enumerate() {
                row[j * parts + axis] = x * by * weight;
            }
            if parts == 4 {
                row[j * parts + 3] = weight;
            }
        }
    }
}
