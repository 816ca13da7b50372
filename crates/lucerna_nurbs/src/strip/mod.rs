//! Curves in homogeneous coordinates with points of any width: what editing comes down to.
//!
//! A surface is such a curve too, once along u, whose points are the rows of its net, and once
//! along v, whose points are the columns. So each algorithm is written once.

mod cut;
mod elevate;
mod refine;
mod remove;

use alloc::vec::Vec;

use crate::{KnotVector, MAX_WEIGHT, MIN_WEIGHT, Real};

/// A B-spline curve whose points are `width` scalars each.
#[derive(Clone, Debug)]
pub(crate) struct Strip<T> {
    pub(crate) degree: usize,
    pub(crate) knots: Vec<T>,
    /// Point after point.
    pub(crate) data: Vec<T>,
    pub(crate) width: usize,
}

impl<T: Real> Strip<T> {
    pub(crate) fn new(knots: &KnotVector<T>, data: Vec<T>) -> Self {
        let width = data.len() / knots.count();
        Self { degree: knots.degree(), knots: knots.as_slice().to_vec(), data, width }
    }

    /// The number of points.
    pub(crate) fn count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    pub(crate) fn domain(&self) -> (T, T) {
        (self.knots[self.degree], self.knots[self.count()])
    }

    /// How often `t` is a knot.
    fn multiplicity(&self, t: T) -> usize {
        self.knots.partition_point(|&knot| knot <= t) - self.knots.partition_point(|&knot| knot < t)
    }

    /// The distinct knots between the ends of the domain.
    fn inner_knots(&self) -> Vec<T> {
        let (lo, hi) = self.domain();
        let mut inner: Vec<T> = self.knots.iter().copied().filter(|&knot| lo < knot && knot < hi).collect();
        inner.dedup();
        inner
    }
}

/// Homogeneous coordinates, point after point: the coordinates times the weight, then the weight;
/// without weights the coordinates alone.
pub(crate) fn lift<T: Real, const D: usize>(points: &[[T; D]], weights: Option<&[T]>) -> Vec<T> {
    let Some(weights) = weights else { return points.as_flattened().to_vec() };
    let parts = points.iter().zip(weights);
    parts.flat_map(|(point, &w)| point.map(|x| x * w).into_iter().chain([w])).collect()
}

/// The inverse of [`lift`].
pub(crate) fn project<T: Real, const D: usize>(data: &[T], rational: bool) -> (Vec<[T; D]>, Option<Vec<T>>) {
    let parts = D + usize::from(rational);
    let coordinates = |block: &[T], w: T| core::array::from_fn(|axis| block[axis] / w);
    if !rational {
        return (data.chunks_exact(parts).map(|block| coordinates(block, T::ONE)).collect(), None);
    }
    let points = data.chunks_exact(parts).map(|block| coordinates(block, block[D])).collect();
    (points, Some(data.chunks_exact(parts).map(|block| within(block[D])).collect()))
}

/// A weight that rounding, and no more, has carried past a limit is put on it.
fn within<T: Real>(w: T) -> T {
    let (lo, hi) = (T::from_f64(MIN_WEIGHT), T::from_f64(MAX_WEIGHT));
    let slack = T::ONE + T::from_f64(256.0) * T::EPSILON;
    if w < lo && w * slack >= lo {
        lo
    } else if w > hi && w <= hi * slack {
        hi
    } else {
        w
    }
}

/// What of `wanted` is not in `have`, each as often as it is missing; both do not decrease.
pub(crate) fn lacking<T: Real>(have: &[T], wanted: impl Iterator<Item = T>) -> Vec<T> {
    let mut have = have.iter().peekable();
    let mut lacking = Vec::new();
    for knot in wanted {
        while have.next_if(|&&other| other < knot).is_some() {}
        if have.next_if(|&&other| other == knot).is_none() {
            lacking.push(knot);
        }
    }
    lacking
}

/// Exchanges rows and columns of a net whose points are `parts` scalars each.
pub(crate) fn transpose<T: Real>(data: &[T], columns: usize, parts: usize) -> Vec<T> {
    let rows = data.len() / (columns * parts);
    let mut out = Vec::with_capacity(data.len());
    for j in 0..columns {
        for i in 0..rows {
            let at = (i * columns + j) * parts;
            out.extend_from_slice(&data[at..at + parts]);
        }
    }
    out
}
