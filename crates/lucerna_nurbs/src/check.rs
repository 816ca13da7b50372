//! Validation of points and weights, shared by curves, surfaces and grids.

use crate::{MAX_WEIGHT, MIN_WEIGHT, NurbsError, Real};

pub(crate) fn points<T: Real, const D: usize>(points: &[[T; D]], expected: usize) -> Result<(), NurbsError> {
    length(points.len(), expected)?;
    let limit = point_limit();
    for (index, point) in points.iter().enumerate() {
        if let Some(axis) = point.iter().position(|&x| !is_within(x, limit)) {
            return Err(NurbsError::PointValue { index, axis, value: point[axis].to_f64(), limit: limit.to_f64() });
        }
    }
    Ok(())
}

/// The largest magnitude of a coordinate: sums of a few do not overflow.
pub(crate) fn point_limit<T: Real>() -> T {
    T::MAX / T::from_f64(8.0)
}

pub(crate) fn length(found: usize, expected: usize) -> Result<(), NurbsError> {
    if found == expected { Ok(()) } else { Err(NurbsError::PointCount { found, expected }) }
}

pub(crate) fn weights<T: Real>(weights: &[T], expected: usize) -> Result<(), NurbsError> {
    if weights.len() != expected {
        return Err(NurbsError::WeightCount { found: weights.len(), expected });
    }
    let (lo, hi) = (T::from_f64(MIN_WEIGHT), T::from_f64(MAX_WEIGHT));
    match weights.iter().position(|&w| !(w >= lo && w <= hi)) {
        Some(index) => Err(NurbsError::Weight { index, value: weights[index].to_f64() }),
        None => Ok(()),
    }
}

/// Whether the magnitude of `x` is at most `limit`, which NaN is not.
pub(crate) fn is_within<T: Real>(x: T, limit: T) -> bool {
    x.abs() <= limit
}

/// Refuses what is not above zero and finite.
pub(crate) fn positive<T: Real>(name: &'static str, value: T) -> Result<(), NurbsError> {
    if value > T::ZERO && value.is_finite() {
        return Ok(());
    }
    Err(NurbsError::NotPositive { name, value: value.to_f64() })
}
