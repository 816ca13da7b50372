//! Degree elevation.

use alloc::{vec, vec::Vec};

use super::{Strip, lacking};
use crate::Real;

impl<T: Real> Strip<T> {
    /// Raises the degree by one; the result is clamped.
    ///
    /// Not A5.9, which takes Bezier pieces apart and removes knots again, but the formula of
    /// H. Prautzsch, *Degree elevation of B-spline curves*, CAGD 1 (1984): when every distinct knot
    /// is repeated once more, the new points are the means of those of `degree + 1` refined curves,
    /// each of which leaves out every (degree + 1)-th of the new knots. Nothing is divided by a
    /// difference, so that errors do not grow.
    pub(crate) fn elevate(&mut self) {
        let (lo, hi) = self.domain();
        self.cut(lo, hi);
        let (p, width) = (self.degree, self.width);
        let mut raised = Vec::new();
        for run in self.knots.chunk_by(|a, b| a == b) {
            raised.extend_from_slice(run);
            raised.push(run[0]);
        }
        let count = raised.len() - p - 2;
        let mut data = vec![T::ZERO; count * width];
        for skipped in 0..=p {
            let kept = |i: &usize| i % (p + 1) != skipped;
            let inner = (0..raised.len()).filter(kept).map(|i| raised[i]).filter(|&knot| lo < knot && knot < hi);
            let mut refined = self.clone();
            refined.refine(&lacking(&self.knots, inner));
            // Point `i` of the result belongs to the new knots behind number `i`; without the
            // skipped one they are `degree` in a row of the refined curve's.
            let at_start = (0..p + 2).filter(kept).count();
            let mut kept_before = 0;
            for i in 0..count {
                kept_before += usize::from(kept(&i));
                let from = (kept_before + p - at_start) * width;
                let point = &refined.data[from..from + width];
                for (sum, &x) in data[i * width..(i + 1) * width].iter_mut().zip(point) {
                    *sum += x;
                }
            }
        }
        let share = T::from_usize(p + 1);
        data.iter_mut().for_each(|x| *x /= share);
        (self.degree, self.knots, self.data) = (p + 1, raised, data);
    }
}
