//! Curves through and near points.

use alloc::vec::Vec;

use super::least_squares::{self, Demand};
use super::{cast_knots, cast_points, check_parameters, interpolate, to_f64};
use crate::{Curve, NurbsError, Real, basis, check};

/// What [`Curve::fit`] shall bring about at one parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitSample<T, const D: usize> {
    t: T,
    order: usize,
    value: [T; D],
    weight: Option<T>,
}

impl<T: Real, const D: usize> FitSample<T, D> {
    /// The curve shall come near a point, with weight 1.
    pub fn point(t: T, point: [T; D]) -> Self {
        Self::derivative(t, 0, point)
    }

    /// The derivative of the given order shall come near a value, with weight 1.
    pub fn derivative(t: T, order: usize, value: [T; D]) -> Self {
        Self { t, order, value, weight: Some(T::ONE) }
    }

    /// Squares count `weight` times, above zero.
    #[must_use]
    pub fn weighted(self, weight: T) -> Self {
        Self { weight: Some(weight), ..self }
    }

    /// Not near: there.
    #[must_use]
    pub fn exact(self) -> Self {
        Self { weight: None, ..self }
    }
}

impl<T: Real, const D: usize> Curve<T, D> {
    /// The curve with as many control points as there are `points`, which passes through each at
    /// its parameter (The NURBS Book, A9.1).
    ///
    /// [`Spacing::parameters`](crate::Spacing::parameters) makes parameters; the domain is from the
    /// first to the last.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, Spacing};
    ///
    /// let points = [[0.0, 0.0], [3.0, 4.0], [-1.0, 4.0], [-4.0, 0.0], [-4.0, -3.0_f64]];
    /// let parameters = Spacing::ChordLength.parameters(&points)?;
    /// let curve = Curve::interpolate(3, &points, &parameters)?;
    /// for (t, point) in parameters.into_iter().zip(points) {
    ///     let found = curve.point(t)?;
    ///     assert!((found[0] - point[0]).abs() < 1e-14 && (found[1] - point[1]).abs() < 1e-14);
    /// }
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When there are no more points than the degree, a coordinate is not finite, the parameters
    /// are not as many as the points or do not rise (points that coincide with their neighbour have
    /// the same), or lie too close together to be told apart.
    pub fn interpolate(degree: usize, points: &[[T; D]], parameters: &[T]) -> Result<Self, NurbsError> {
        check::points(points, points.len())?;
        check_parameters("t", parameters, points.len(), true)?;
        let data = to_f64(points.as_flattened());
        let (knots, data) = interpolate::<T>(degree, &to_f64(parameters), &data)?;
        Self::new(cast_knots(&knots)?, cast_points(&data), None)
    }

    /// The curve with `count` control points that starts and ends in the first and last of the
    /// points and comes closest to the others, measured by the sum of squared distances at their
    /// parameters (section 9.4.1).
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, Spacing};
    ///
    /// let points: Vec<[f64; 2]> = (0..50).map(|k| k as f64 / 49.0).map(|x| [x, (3.0 * x).sin()]).collect();
    /// let parameters = Spacing::ChordLength.parameters(&points)?;
    /// let curve = Curve::approximate(3, 9, &points, &parameters)?;
    /// assert_eq!(curve.points().len(), 9);
    /// let [x, y] = curve.point(0.4)?;
    /// assert!((y - (3.0 * x).sin()).abs() < 0.003);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `count` is not above the degree or above the number of points, a coordinate is not
    /// finite, the parameters are not as many as the points or fall, or too many of them lie in one
    /// place.
    pub fn approximate(degree: usize, count: usize, points: &[[T; D]], parameters: &[T]) -> Result<Self, NurbsError> {
        check::points(points, points.len())?;
        check_parameters("t", parameters, points.len(), false)?;
        let data = to_f64(points.as_flattened());
        let (knots, data) = super::surface::approximate::<T>(degree, count, &to_f64(parameters), &data)?;
        Self::new(cast_knots(&knots)?, cast_points(&data), None)
    }

    /// The curve with `count` control points that meets the exact ones of the samples and comes
    /// closest to the others, measured by the weighted sum of squares (A9.6).
    ///
    /// The domain is from the least to the largest parameter.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, FitSample};
    ///
    /// // Near three points, from one that is fixed, setting out horizontally.
    /// let samples = [
    ///     FitSample::point(0.0, [0.0, 0.0]).exact(),
    ///     FitSample::derivative(0.0, 1, [2.0, 0.0_f64]).exact(),
    ///     FitSample::point(0.4, [0.8, 0.5]),
    ///     FitSample::point(0.7, [1.0, 1.1]).weighted(10.0),
    ///     FitSample::point(1.0, [1.0, 2.0]),
    /// ];
    /// let curve = Curve::fit(2, 4, &samples)?;
    /// let start = curve.derivatives(0.0, 1)?;
    /// assert!(start[0][1].abs() < 1e-14 && start[1][1].abs() < 1e-14);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `count` is not above the degree, a value or parameter is not finite, a weight not
    /// positive and finite, an order above [`MAX_DEGREE`](crate::MAX_DEGREE), all parameters are the
    /// same, the samples do not determine the points, or exact ones contradict or repeat each other.
    pub fn fit(degree: usize, count: usize, samples: &[FitSample<T, D>]) -> Result<Self, NurbsError> {
        let values: Vec<[T; D]> = samples.iter().map(|sample| sample.value).collect();
        check::points(&values, values.len().max(1))?;
        let mut parameters = Vec::new();
        let mut demands = Vec::new();
        for sample in samples {
            check_parameters("t", &[sample.t], 1, false)?;
            basis::check_order(sample.order)?;
            if let Some(weight) = sample.weight {
                check::positive("weight", weight)?;
            }
            let (t, weight) = (sample.t.to_f64(), sample.weight.map(Real::to_f64));
            parameters.push(t);
            demands.push(Demand { t, order: sample.order, weight });
        }
        parameters.sort_unstable_by(f64::total_cmp);
        if count > samples.len() {
            return Err(NurbsError::FitCount { found: count, max: samples.len() });
        }
        let knots = least_squares::knots::<T>(degree, count, &parameters)?;
        let data = least_squares::solve(&knots, &demands, &to_f64(values.as_flattened()), D)?;
        Self::new(cast_knots(&knots)?, cast_points(&data), None)
    }
}
