//! Parts of a curve, and its Bezier pieces (The NURBS Book, A5.6 and A5.7).

use alloc::vec::Vec;
use core::iter::repeat_n;

use super::Strip;
use crate::Real;

impl<T: Real> Strip<T> {
    /// Leaves the part from `a` to `b`, clamped. Both lie in the domain, `a` below `b`.
    pub(crate) fn cut(&mut self, a: T, b: T) {
        self.saturate(&[a, b]);
        let p = self.degree;
        // The last knot at `a` and the first at `b`: the point of the curve at `a` is the one whose
        // knots end with the former, that at `b` the one whose knots begin with the latter.
        let last = self.knots.partition_point(|&knot| knot <= a) - 1;
        let first = self.knots.partition_point(|&knot| knot < b);
        let inner = &self.knots[last + 1..first];
        let ends = |t| repeat_n(t, p + 1);
        self.knots = ends(a).chain(inner.iter().copied()).chain(ends(b)).collect();
        self.data.truncate(first * self.width);
        self.data.drain(..(last - p) * self.width);
    }

    /// The parts below and above `t`, which share the point there to the last bit.
    pub(crate) fn split(mut self, t: T) -> (Self, Self) {
        let (lo, hi) = self.domain();
        self.saturate(&[t]);
        let mut above = self.clone();
        self.cut(lo, t);
        above.cut(t, hi);
        (self, above)
    }

    /// One clamped piece without inner knots for each span of the domain.
    pub(crate) fn bezier_pieces(mut self) -> Vec<Self> {
        let (lo, hi) = self.domain();
        self.cut(lo, hi);
        let mut ends = self.inner_knots();
        self.saturate(&ends);
        ends.push(hi);
        let (p, width) = (self.degree, self.width);
        let mut start = lo;
        let piece = |(i, end): (usize, T)| {
            let knots = repeat_n(start, p + 1).chain(repeat_n(end, p + 1)).collect();
            start = end;
            let data = self.data[i * p * width..(i * p + p + 1) * width].to_vec();
            Self { degree: p, knots, data, width }
        };
        ends.into_iter().enumerate().map(piece).collect()
    }
}
