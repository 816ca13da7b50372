//! Interpolation and least squares (The NURBS Book, chapter 9).
//!
//! Systems are solved in `f64` whatever the scalar type. Their matrices are banded, as wide as the
//! degree, so that the work grows with the number of points and not with its cube.

mod banded;
mod curve;
mod interpolate;
mod least_squares;
mod spacing;
mod surface;

pub use curve::FitSample;
pub(crate) use interpolate::interpolate;
pub use spacing::Spacing;
pub(crate) use spacing::distance;

use alloc::{vec, vec::Vec};

use crate::{KnotVector, NurbsError, Real};

/// Refuses parameters that are not as many as expected, not finite, or not rising.
fn check_parameters<T: Real>(
    name: &'static str,
    parameters: &[T],
    expected: usize,
    strictly: bool,
) -> Result<(), NurbsError> {
    if parameters.len() != expected {
        return Err(NurbsError::ParameterCount { name, found: parameters.len(), expected });
    }
    for (index, &value) in parameters.iter().enumerate() {
        if !value.is_finite() {
            let (lo, hi) = (f64::MIN, f64::MAX);
            return Err(NurbsError::Parameter { name, value: value.to_f64(), lo, hi });
        }
        let Some(previous) = index.checked_sub(1).map(|before| parameters[before]) else { continue };
        if value < previous || (strictly && value == previous) {
            let (value, previous) = (value.to_f64(), previous.to_f64());
            return Err(NurbsError::ParameterOrder { name, index, value, previous });
        }
    }
    Ok(())
}

/// Clamped knots, the inner ones means of `degree` parameters in a row (equation 9.8), for as many
/// points as there are parameters: more than the degree. Rounded to the scalar type: what is solved
/// for is what will be evaluated.
fn averaged<T: Real>(degree: usize, parameters: &[f64]) -> Result<KnotVector<f64>, NurbsError> {
    let (first, last) = (parameters[0], parameters[parameters.len() - 1]);
    let mut knots = vec![first; degree + 1];
    for window in parameters[1..parameters.len() - 1].windows(degree) {
        let mean = window.iter().map(|t| t / degree as f64).sum::<f64>();
        // Rounding must not carry a mean past its neighbours.
        knots.push(T::from_f64(mean).to_f64().max(knots[knots.len() - 1]).min(last));
    }
    knots.extend(vec![last; degree + 1]);
    KnotVector::new(degree, knots)
}

fn to_f64<T: Real>(values: &[T]) -> Vec<f64> {
    values.iter().map(|x| x.to_f64()).collect()
}

fn cast_points<T: Real, const D: usize>(data: &[f64]) -> Vec<[T; D]> {
    data.chunks_exact(D).map(|point| core::array::from_fn(|axis| T::from_f64(point[axis]))).collect()
}

fn cast_knots<T: Real>(knots: &KnotVector<f64>) -> Result<KnotVector<T>, NurbsError> {
    KnotVector::new(knots.degree(), knots.as_slice().iter().map(|&knot| T::from_f64(knot)).collect())
}
