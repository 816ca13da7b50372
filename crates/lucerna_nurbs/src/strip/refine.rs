//! Knot insertion (The NURBS Book, A5.1 to A5.5).

use alloc::vec::Vec;
use core::iter::repeat_n;
use core::mem::take;

use super::Strip;
use crate::Real;

impl<T: Real> Strip<T> {
    /// Inserts nondecreasing knots of the domain, which with those already there must not occur
    /// more often than the degree.
    ///
    /// Boehm's rule, knot by knot from below: every new point lies between two neighbours, so that
    /// errors do not grow. What lies above the knot at hand is not yet touched, and the whole takes
    /// time linear in the size of the result.
    pub(crate) fn refine(&mut self, new: &[T]) {
        let (p, width) = (self.degree, self.width);
        let (old_knots, old_data) = (take(&mut self.knots), take(&mut self.data));
        let mut knots = Vec::with_capacity(old_knots.len() + new.len());
        let mut data = Vec::with_capacity(old_data.len() + new.len() * width);
        // The curve at any time: `knots`, then the old ones from `knots_read`; points likewise.
        let (mut knots_read, mut data_read) = (0, 0);
        for &t in new {
            let stop = knots_read + old_knots[knots_read..].partition_point(|&knot| knot <= t);
            knots.extend_from_slice(&old_knots[knots_read..stop]);
            knots_read = stop;
            let k = knots.len() - 1;
            let s = knots.iter().rev().take_while(|&&knot| knot == t).count();
            // The last point that changes is `k - s`; behind it comes its old self.
            let last = (k - s) * width;
            let missing = (last + width).saturating_sub(data.len());
            data.extend_from_slice(&old_data[data_read..data_read + missing]);
            data_read += missing;
            let len = data.len();
            data.resize(len + width, T::ZERO);
            data.copy_within(last..len, last + width);
            let knot = |i: usize| if i <= k { knots[i] } else { old_knots[knots_read + i - k - 1] };
            for i in (k + 1 - p..=k - s).rev() {
                let (lo, hi) = (knot(i), knot(i + p));
                blend(&mut data, i, width, (t - lo) / (hi - lo));
            }
            knots.push(t);
        }
        knots.extend_from_slice(&old_knots[knots_read..]);
        data.extend_from_slice(&old_data[data_read..]);
        (self.knots, self.data) = (knots, data);
    }

    /// Inserts each of the increasing knots until it occurs as often as the degree.
    pub(super) fn saturate(&mut self, at: &[T]) {
        let missing = |&t: &T| repeat_n(t, self.degree.saturating_sub(self.multiplicity(t)));
        let new: Vec<T> = at.iter().flat_map(missing).collect();
        self.refine(&new);
    }
}

/// Moves point `i` towards the one before it, leaving the fraction `alpha` of the way.
fn blend<T: Real>(data: &mut [T], i: usize, width: usize, alpha: T) {
    let (before, at) = data[(i - 1) * width..(i + 1) * width].split_at_mut(width);
    for (a, b) in before.iter().zip(at) {
        *b = *a + (*b - *a) * alpha;
    }
}
