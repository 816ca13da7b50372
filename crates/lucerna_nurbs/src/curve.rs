//! Rational B-spline curves in any number of dimensions.

use alloc::{vec, vec::Vec};

use crate::vector::add_scaled;
use crate::{KnotVector, NurbsError, Real, basis, check};

/// A curve: knots, control points in `D` dimensions and, when it is rational, weights.
///
/// ```
/// use lucerna_nurbs::{Curve, KnotVector};
///
/// // A quarter circle: degree 2, weights 1, 1/sqrt 2, 1.
/// let arc = Curve::new(
///     KnotVector::clamped_uniform(2, 3)?,
///     vec![[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
///     Some(vec![1.0, 0.5_f64.sqrt(), 1.0]),
/// )?;
/// let [x, y] = arc.point(0.3)?;
/// assert!((x * x + y * y - 1.0).abs() < 1e-15);
/// # Ok::<(), lucerna_nurbs::NurbsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::serial::RawCurve<T, D>",
        bound(
            serialize = "T: serde::Serialize, [T; D]: serde::Serialize",
            deserialize = "T: Real + serde::Deserialize<'de>, [T; D]: serde::Deserialize<'de>"
        )
    )
)]
pub struct Curve<T, const D: usize = 3> {
    knots: KnotVector<T>,
    points: Vec<[T; D]>,
    weights: Option<Vec<T>>,
}

impl<T: Real, const D: usize> Curve<T, D> {
    /// Puts a curve together; without weights all of them are 1.
    ///
    /// # Errors
    /// When the counts do not match, a coordinate is not finite or a weight is not positive.
    pub fn new(knots: KnotVector<T>, points: Vec<[T; D]>, weights: Option<Vec<T>>) -> Result<Self, NurbsError> {
        const { assert!(D > 0, "a curve needs at least one dimension") };
        check::points(&points, knots.count())?;
        if let Some(weights) = &weights {
            check::weights(weights, points.len())?;
        }
        Ok(Self { knots, points, weights })
    }

    /// A smooth closed curve through no point in particular: periodic uniform knots, the first
    /// `degree` points repeated at the end. The domain is 0 to the number of points.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// let ring = Curve::closed(2, vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]], None)?;
    /// assert_eq!(ring.domain(), (0.0, 4.0));
    /// assert_eq!(ring.point(0.0)?, ring.point(4.0)?);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`new`](Self::new); also when there are fewer points than `degree`.
    pub fn closed(degree: usize, mut points: Vec<[T; D]>, mut weights: Option<Vec<T>>) -> Result<Self, NurbsError> {
        let knots = KnotVector::periodic(degree, points.len())?;
        if let Some(weights) = &mut weights {
            check::weights(weights, points.len())?;
            weights.extend_from_within(..degree);
        }
        points.extend_from_within(..degree);
        Self::new(knots, points, weights)
    }

    /// The knots.
    pub fn knots(&self) -> &KnotVector<T> {
        &self.knots
    }

    /// The control points.
    pub fn points(&self) -> &[[T; D]] {
        &self.points
    }

    /// The weights, `None` when the curve is not rational.
    pub fn weights(&self) -> Option<&[T]> {
        self.weights.as_deref()
    }

    /// The curve with every control point mapped. An affine map (moving, turning, scaling, shearing)
    /// takes the curve along; other maps bend it in ways of their own.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// let line = Curve::line([0.0, 0.0], [1.0, 2.0])?.map_points(|[x, y]| [3.0 - y, x])?;
    /// assert_eq!(line.points(), [[3.0, 0.0], [1.0, 1.0]]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a mapped coordinate is not finite.
    pub fn map_points(&self, map: impl FnMut([T; D]) -> [T; D]) -> Result<Self, NurbsError> {
        let points = self.points.iter().copied().map(map).collect();
        Self::new(self.knots.clone(), points, self.weights.clone())
    }

    /// The parameters between which the curve is defined.
    pub fn domain(&self) -> (T, T) {
        self.knots.domain()
    }

    /// The point at `t` (The NURBS Book, A3.1 and A4.1).
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain.
    pub fn point(&self, t: T) -> Result<[T; D], NurbsError> {
        Ok(self.derivatives(t, 0)?[0])
    }

    /// The point and the derivatives with respect to `t` up to `order`, `order + 1` vectors in all
    /// (A3.2 and A4.2).
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, KnotVector};
    ///
    /// let parabola = Curve::new(KnotVector::clamped_uniform(2, 3)?, vec![[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]], None)?;
    /// assert_eq!(parabola.derivatives(0.5, 2)?, [[0.5, 0.25], [1.0, 1.0], [0.0, 2.0]]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain, or `order` is above [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn derivatives(&self, t: T, order: usize) -> Result<Vec<[T; D]>, NurbsError> {
        self.knots.check("t", t)?;
        basis::check_order(order)?;
        let basis = self.knots.basis(t, order);
        let range = basis.first()..=basis.span();
        let mut out = vec![[T::ZERO; D]; order + 1];
        let Some(weights) = &self.weights else {
            for (k, sum) in out.iter_mut().enumerate() {
                for (&n, point) in basis.row(k).iter().zip(&self.points[range.clone()]) {
                    add_scaled(sum, point, n);
                }
            }
            return Ok(out);
        };
        // A4.2: C(k) = (A(k) - sum over i >= 1 of binomial(k, i) w(i) C(k - i)) / w.
        let mut w = vec![T::ZERO; order + 1];
        for k in 0..=order {
            let mut sum = [T::ZERO; D];
            for (&n, i) in basis.row(k).iter().zip(range.clone()) {
                add_scaled(&mut sum, &self.points[i], n * weights[i]);
                w[k] += n * weights[i];
            }
            let mut choose = T::ONE;
            for i in 1..=k {
                choose = choose * T::from_usize(k + 1 - i) / T::from_usize(i);
                let lower = out[k - i];
                add_scaled(&mut sum, &lower, -(choose * w[i]));
            }
            out[k] = sum.map(|x| x / w[0]);
        }
        Ok(out)
    }
}
