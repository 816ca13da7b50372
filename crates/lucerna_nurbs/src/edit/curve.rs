//! Editing curves.

use alloc::{vec, vec::Vec};

use super::{check_interval, elevate, insertable, remove};
use crate::strip::{Strip, lift, project};
use crate::{Curve, KnotVector, NurbsError, Real, check};

impl<T: Real, const D: usize> Curve<T, D> {
    /// Inserts the knot `t` `times` times (The NURBS Book, A5.1). The curve stays where it is.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, KnotVector};
    ///
    /// let knots = KnotVector::clamped_uniform(2, 3)?;
    /// let curve = Curve::new(knots, vec![[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]], None)?;
    /// let refined = curve.insert_knot(0.5, 1)?;
    /// assert_eq!(refined.points(), [[0.0, 0.0], [0.5, 1.0], [1.5, 1.0], [2.0, 0.0]]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain, or would occur more often than the degree.
    pub fn insert_knot(&self, t: T, times: usize) -> Result<Self, NurbsError> {
        self.knots().check("t", t)?;
        // One more than may be is enough to be refused.
        self.refine(&vec![t; times.min(self.knots().degree() + 1)])
    }

    /// Inserts many knots at once, in any order, repeated or not (A5.4).
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// let line = Curve::line([0.0], [8.0])?.elevate(1)?;
    /// let refined = line.refine(&[0.75, 0.25, 0.25])?;
    /// assert_eq!(refined.points(), [[0.0], [1.0], [2.0], [4.0], [7.0], [8.0]]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`insert_knot`](Self::insert_knot).
    pub fn refine(&self, knots: &[T]) -> Result<Self, NurbsError> {
        let new = insertable(self.knots(), "t", knots)?;
        let mut strip = self.strip();
        strip.refine(&new);
        self.rebuild(strip)
    }

    /// Removes the inner knot `t` up to `times` times, as long as the curve moves by no more than
    /// `tolerance` in all; returns the result and how often the knot was removed (A5.8). A knot
    /// that does not occur, and one at an end, is not removed.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, KnotVector};
    ///
    /// let knots = KnotVector::clamped_uniform(2, 3)?;
    /// let curve = Curve::new(knots, vec![[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]], None)?;
    /// let (back, removed) = curve.insert_knot(0.5, 2)?.remove_knot(0.5, 5, 1e-12)?;
    /// assert_eq!((back, removed), (curve, 2));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain, or the tolerance is not positive and finite.
    pub fn remove_knot(&self, t: T, times: usize, tolerance: T) -> Result<(Self, usize), NurbsError> {
        self.knots().check("t", t)?;
        check::positive("tolerance", tolerance)?;
        let (lo, hi) = self.domain();
        if t == lo || t == hi {
            return Ok((self.clone(), 0));
        }
        let mut strip = self.strip();
        let (parts, rational) = (strip.width, self.weights().is_some());
        let removed = remove(&mut strip, t, times, tolerance, parts, rational);
        Ok(if removed == 0 { (self.clone(), 0) } else { (self.rebuild(strip)?, removed) })
    }

    /// The same curve on clamped knots: it starts and ends in its end points. Knots before and
    /// behind the domain are dropped.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// let ring = Curve::closed(2, vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]], None)?;
    /// let clamped = ring.clamp()?;
    /// assert_eq!(clamped.points()[0], [1.0, 0.0]);
    /// assert_eq!(clamped.points().last(), Some(&[1.0, 0.0]));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the coordinates are so large that sums overflow.
    pub fn clamp(&self) -> Result<Self, NurbsError> {
        let (lo, hi) = self.domain();
        self.trim(lo, hi)
    }

    /// The part from `a` to `b`, with the parameters it had, clamped.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, KnotVector};
    ///
    /// let points = vec![[0.0, 0.0], [1.0, 2.0], [2.0, 0.0], [3.0, 1.0], [4.0, 0.0], [5.0, 2.0]];
    /// let curve = Curve::new(KnotVector::clamped_uniform(2, 6)?, points, None)?;
    /// let part = curve.trim(0.25, 0.75)?;
    /// assert_eq!(part.domain(), (0.25, 0.75));
    /// assert_eq!(part.point(0.5)?, curve.point(0.5)?);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a parameter is NaN or outside the domain, or `a` is not below `b`.
    pub fn trim(&self, a: T, b: T) -> Result<Self, NurbsError> {
        check_interval(self.knots(), "t", a, b)?;
        let mut strip = self.strip();
        strip.cut(a, b);
        self.rebuild(strip)
    }

    /// The parts below and above `t`, both clamped, with the parameters they had. They share the
    /// point at `t` to the last bit.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, KnotVector};
    ///
    /// let line = Curve::new(KnotVector::clamped_uniform(1, 2)?, vec![[0.0], [8.0]], None)?;
    /// let (low, high) = line.split(0.25)?;
    /// assert_eq!((low.points(), high.points()), (&[[0.0], [2.0]][..], &[[2.0], [8.0]][..]));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN, outside the domain or at one of its ends.
    pub fn split(&self, t: T) -> Result<(Self, Self), NurbsError> {
        let (lo, hi) = self.domain();
        check_interval(self.knots(), "t", lo, t)?;
        check_interval(self.knots(), "t", t, hi)?;
        let (below, above) = self.strip().split(t);
        Ok((self.rebuild(below)?, self.rebuild(above)?))
    }

    /// The curve as Bezier curves, one for each span, with the parameters they had (A5.6): one point
    /// more than the degree each, the last of one being the first of the next.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, KnotVector};
    ///
    /// let knots = KnotVector::clamped(2, &[0.5])?;
    /// let curve = Curve::new(knots, vec![[0.0], [0.0], [1.0], [1.0]], None)?;
    /// let pieces = curve.bezier_pieces()?;
    /// assert_eq!(pieces[0].points(), [[0.0], [0.0], [0.5]]);
    /// assert_eq!(pieces[1].domain(), (0.5, 1.0));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the coordinates are so large that sums overflow.
    pub fn bezier_pieces(&self) -> Result<Vec<Self>, NurbsError> {
        self.strip().bezier_pieces().into_iter().map(|strip| self.rebuild(strip)).collect()
    }

    /// The same curve with a degree higher by `by`, clamped (as A5.9).
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, KnotVector};
    ///
    /// let line = Curve::new(KnotVector::clamped_uniform(1, 2)?, vec![[0.0], [6.0]], None)?;
    /// assert_eq!(line.elevate(2)?.points(), [[0.0], [2.0], [4.0], [6.0]]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the degree would exceed [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn elevate(&self, by: usize) -> Result<Self, NurbsError> {
        let mut strip = self.strip();
        elevate(&mut strip, by)?;
        self.rebuild(strip)
    }

    /// The curve run through the other way, on the same domain: what was at `t` is at
    /// `lo + hi - t`.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, KnotVector};
    ///
    /// let curve = Curve::new(KnotVector::clamped(1, &[0.25])?, vec![[0.0], [1.0], [5.0]], None)?;
    /// let back = curve.reverse()?;
    /// assert_eq!(back.points(), [[5.0], [1.0], [0.0]]);
    /// assert_eq!(back.knots().as_slice(), [0.0, 0.0, 0.75, 1.0, 1.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When knots that differ by rounding alone fall together and are too many.
    pub fn reverse(&self) -> Result<Self, NurbsError> {
        let points = self.points().iter().rev().copied().collect();
        let weights = self.weights().map(|weights| weights.iter().rev().copied().collect());
        Self::new(self.knots().reverse()?, points, weights)
    }

    pub(crate) fn strip(&self) -> Strip<T> {
        Strip::new(self.knots(), lift(self.points(), self.weights()))
    }

    /// A curve from its homogeneous form, rational as this one.
    fn rebuild(&self, strip: Strip<T>) -> Result<Self, NurbsError> {
        Self::from_strip(strip, self.weights().is_some())
    }

    pub(crate) fn from_strip(strip: Strip<T>, rational: bool) -> Result<Self, NurbsError> {
        let (points, weights) = project(&strip.data, rational);
        Self::new(KnotVector::new(strip.degree, strip.knots)?, points, weights)
    }
}
