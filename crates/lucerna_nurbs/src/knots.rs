//! Knot vectors, validated once.

use alloc::{vec, vec::Vec};

use crate::{MAX_DEGREE, MAX_POINTS, NurbsError, Real, check};

/// A nondecreasing sequence of knots together with the degree it is meant for.
///
/// A vector of `m + 1` knots and degree `p` carries `n = m - p` control points. The curve lives on
/// the domain from knot `p` to knot `n`. A value that is constructed is valid for good: evaluation
/// never checks knots again.
///
/// ```
/// use lucerna_nurbs::KnotVector;
///
/// let knots = KnotVector::<f64>::clamped_uniform(3, 6)?;
/// assert_eq!(knots.as_slice()[..5], [0.0, 0.0, 0.0, 0.0, 1.0 / 3.0]);
/// assert_eq!(knots.domain(), (0.0, 1.0));
/// assert_eq!(knots.find_span(0.5)?, 4);
/// # Ok::<(), lucerna_nurbs::NurbsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "crate::serial::RawKnots<T>", bound(deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct KnotVector<T> {
    degree: usize,
    knots: Vec<T>,
}

impl<T: Real> KnotVector<T> {
    /// Takes knots as they are.
    ///
    /// ```
    /// use lucerna_nurbs::{KnotVector, NurbsError};
    ///
    /// let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0])?;
    /// assert_eq!((knots.count(), knots.domain()), (4, (0.0, 2.0)));
    /// let refused = KnotVector::new(1, vec![0.0, 0.0, 2.0, 1.0, 3.0, 3.0]);
    /// assert_eq!(refused, Err(NurbsError::KnotDecreasing { index: 3, value: 1.0, previous: 2.0 }));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the degree is 0 or above [`MAX_DEGREE`], the knots are fewer than `2 (degree + 1)`, not
    /// finite, decreasing or repeated too often (at most `degree + 1` times at the two ends of the
    /// vector, `degree` times inside), or the domain is empty.
    pub fn new(degree: usize, knots: Vec<T>) -> Result<Self, NurbsError> {
        let needed = 2 * degree.saturating_add(1).min(MAX_DEGREE + 1);
        let count = knots.len().saturating_sub(degree).saturating_sub(1);
        if degree == 0 || degree > MAX_DEGREE {
            return Err(NurbsError::Degree { degree, count });
        }
        if knots.len() < needed {
            return Err(NurbsError::KnotCount { found: knots.len(), degree, needed });
        }
        if count > MAX_POINTS {
            return Err(NurbsError::TooManyPoints { count });
        }
        check_order(&knots)?;
        check_multiplicity(degree, &knots)?;
        let (lo, hi) = (knots[degree], knots[count]);
        if lo >= hi {
            return Err(NurbsError::EmptyDomain { lo: lo.to_f64(), hi: hi.to_f64() });
        }
        Ok(Self { degree, knots })
    }

    /// `count` control points, the end knots repeated so that the curve starts and ends in its end
    /// points, the inner knots evenly spaced. The domain is 0 to 1.
    ///
    /// # Errors
    /// When `degree` is 0 or not below `count`, or `count` is too large.
    pub fn clamped_uniform(degree: usize, count: usize) -> Result<Self, NurbsError> {
        check_counts(degree, count)?;
        let spans = count - degree;
        let inner: Vec<T> = (1..spans).map(|i| T::from_usize(i) / T::from_usize(spans)).collect();
        Self::clamped(degree, &inner)
    }

    /// Clamped on the domain 0 to 1 with the given inner knots, which makes
    /// `inner.len() + degree + 1` control points.
    ///
    /// ```
    /// use lucerna_nurbs::KnotVector;
    ///
    /// let knots = KnotVector::clamped(2, &[0.5])?;
    /// assert_eq!(knots.as_slice(), [0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When an inner knot decreases, leaves the domain or is repeated too often; indices in the
    /// error count from the start of the whole vector.
    pub fn clamped(degree: usize, inner: &[T]) -> Result<Self, NurbsError> {
        let count = inner.len().saturating_add(degree).saturating_add(1);
        check_counts(degree, count)?;
        let mut knots = vec![T::ZERO; degree + 1];
        knots.extend_from_slice(inner);
        knots.extend(core::iter::repeat_n(T::ONE, degree + 1));
        Self::new(degree, knots)
    }

    /// `count` control points on evenly spaced knots, unclamped: the curve does not reach its end
    /// points. Knot `i` is `i - degree`; the domain is 0 to `count - degree`.
    ///
    /// ```
    /// use lucerna_nurbs::KnotVector;
    ///
    /// let knots = KnotVector::<f64>::uniform(2, 4)?;
    /// assert_eq!(knots.as_slice(), [-2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0]);
    /// assert_eq!(knots.domain(), (0.0, 2.0));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `degree` is 0 or not below `count`, or `count` is too large.
    pub fn uniform(degree: usize, count: usize) -> Result<Self, NurbsError> {
        check_counts(degree, count)?;
        let knots = (0..=count + degree).map(|i| T::from_usize(i) - T::from_usize(degree)).collect();
        Self::new(degree, knots)
    }

    /// Evenly spaced knots for a closed curve of `distinct` control points, the first `degree` of
    /// which are repeated behind the last: [`uniform`](Self::uniform) for `distinct + degree`
    /// points. The domain is 0 to `distinct`.
    ///
    /// # Errors
    /// When `degree` is 0, `distinct` is below `degree`, or too large.
    pub fn periodic(degree: usize, distinct: usize) -> Result<Self, NurbsError> {
        if distinct < degree {
            return Err(NurbsError::Degree { degree, count: distinct });
        }
        Self::uniform(degree, distinct.saturating_add(degree))
    }

    /// The degree.
    #[inline]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The number of control points.
    #[inline]
    pub fn count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// The knots.
    #[inline]
    pub fn as_slice(&self) -> &[T] {
        &self.knots
    }

    /// The parameters between which the curve is defined.
    #[inline]
    pub fn domain(&self) -> (T, T) {
        (self.knots[self.degree], self.knots[self.count()])
    }

    /// The Greville abscissa of control point `index`: the mean of its `degree` inner knots, the
    /// parameter near which the point pulls most. `None` beyond the last point.
    ///
    /// ```
    /// use lucerna_nurbs::KnotVector;
    ///
    /// let knots = KnotVector::<f64>::periodic(3, 8)?;
    /// assert_eq!((knots.greville(0), knots.greville(11)), (Some(-1.0), None));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    pub fn greville(&self, index: usize) -> Option<T> {
        (index < self.count()).then(|| {
            let inner = &self.knots[index + 1..=index + self.degree];
            inner.iter().copied().sum::<T>() / T::from_usize(self.degree)
        })
    }

    /// The span that holds `t`: the index `i` with `knot[i] <= t < knot[i + 1]`, the last span of
    /// the domain for its upper end (The NURBS Book, A2.1).
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain.
    pub fn find_span(&self, t: T) -> Result<usize, NurbsError> {
        self.check("t", t)?;
        Ok(self.span(t))
    }

    /// [`find_span`](Self::find_span) for a parameter known to lie in the domain.
    pub(crate) fn span(&self, t: T) -> usize {
        let (p, n) = (self.degree, self.count());
        let inside = &self.knots[p..n];
        // The first knot of the domain is at or below `t`, and lies below its upper end.
        let above = if t >= self.knots[n] {
            inside.partition_point(|&knot| knot < self.knots[n])
        } else {
            inside.partition_point(|&knot| knot <= t)
        };
        p + above.max(1) - 1
    }

    /// How often `t` occurs among the knots.
    pub fn multiplicity(&self, t: T) -> usize {
        self.knots.partition_point(|&knot| knot <= t) - self.knots.partition_point(|&knot| knot < t)
    }

    /// Whether both ends of the domain occur `degree + 1` times: then a curve starts in its first
    /// point and ends in its last.
    pub fn is_clamped(&self) -> bool {
        let (lo, hi) = self.domain();
        self.knots[0] == lo && self.knots[self.knots.len() - 1] == hi
    }

    /// Carries a parameter into the domain by whole multiples of its length, which is what a
    /// parameter of a closed curve means. The upper end becomes the lower.
    ///
    /// ```
    /// use lucerna_nurbs::KnotVector;
    ///
    /// let knots = KnotVector::<f64>::periodic(3, 8)?;
    /// assert_eq!((knots.wrap(-0.5)?, knots.wrap(17.25)?, knots.wrap(8.0)?), (7.5, 1.25, 0.0));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN or infinite.
    pub fn wrap(&self, t: T) -> Result<T, NurbsError> {
        let (lo, hi) = self.domain();
        if !t.is_finite() {
            return Err(NurbsError::Parameter { name: "t", value: t.to_f64(), lo: f64::MIN, hi: f64::MAX });
        }
        if t >= lo && t < hi {
            return Ok(t);
        }
        let length = hi - lo;
        let inside = t - length * ((t - lo) / length).floor();
        // Rounding, and a length too small to count in a large parameter, must not carry it out.
        Ok(if inside >= lo && inside < hi { inside } else { lo })
    }

    /// The same knots in `f64`.
    pub(crate) fn to_f64(&self) -> KnotVector<f64> {
        KnotVector { degree: self.degree, knots: self.knots.iter().map(|knot| knot.to_f64()).collect() }
    }

    /// The knots that run the other way on the same domain.
    pub(crate) fn reverse(&self) -> Result<Self, NurbsError> {
        let (lo, hi) = self.domain();
        let turn = |&knot: &T| if knot == lo { hi } else { lo + (hi - knot) };
        Self::new(self.degree, self.knots.iter().rev().map(turn).collect())
    }

    /// Refuses NaN and parameters outside the domain.
    pub(crate) fn check(&self, name: &'static str, t: T) -> Result<(), NurbsError> {
        let (lo, hi) = self.domain();
        if t >= lo && t <= hi {
            return Ok(());
        }
        Err(NurbsError::Parameter { name, value: t.to_f64(), lo: lo.to_f64(), hi: hi.to_f64() })
    }
}

fn check_counts(degree: usize, count: usize) -> Result<(), NurbsError> {
    if count > MAX_POINTS {
        return Err(NurbsError::TooManyPoints { count });
    }
    if degree == 0 || degree > MAX_DEGREE || degree >= count {
        return Err(NurbsError::Degree { degree, count });
    }
    Ok(())
}

fn check_order<T: Real>(knots: &[T]) -> Result<(), NurbsError> {
    let limit = T::MAX / T::from_f64(8.0);
    for (index, &knot) in knots.iter().enumerate() {
        if !check::is_within(knot, limit) {
            return Err(NurbsError::KnotValue { index, value: knot.to_f64(), limit: limit.to_f64() });
        }
        if index > 0 && knot < knots[index - 1] {
            return Err(NurbsError::KnotDecreasing {
                index,
                value: knot.to_f64(),
                previous: knots[index - 1].to_f64(),
            });
        }
    }
    Ok(())
}

fn check_multiplicity<T: Real>(degree: usize, knots: &[T]) -> Result<(), NurbsError> {
    let mut index = 0;
    for run in knots.chunk_by(|a, b| a == b) {
        let at_end = index == 0 || index + run.len() == knots.len();
        let allowed = degree + usize::from(at_end);
        if run.len() > allowed {
            return Err(NurbsError::KnotRepeated { index, value: run[0].to_f64(), times: run.len(), allowed });
        }
        index += run.len();
    }
    Ok(())
}
