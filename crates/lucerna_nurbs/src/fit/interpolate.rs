//! Interpolation of points of any width (The NURBS Book, A9.1).

use alloc::vec::Vec;

use super::averaged;
use super::banded::Banded;
use crate::{KnotVector, MAX_DEGREE, NurbsError, Real};

/// The knots and points of the curve that passes through `data` at strictly rising `parameters`.
pub(crate) fn interpolate<T: Real>(
    degree: usize,
    parameters: &[f64],
    data: &[f64],
) -> Result<(KnotVector<f64>, Vec<f64>), NurbsError> {
    let count = parameters.len();
    if degree == 0 || degree > MAX_DEGREE || degree >= count {
        return Err(NurbsError::Degree { degree, count });
    }
    let knots = averaged::<T>(degree, parameters)?;
    let mut matrix = Banded::zero(count, degree);
    for (k, &t) in parameters.iter().enumerate() {
        let basis = knots.basis(t, 0);
        for (&n, j) in basis.row(0).iter().zip(basis.first()..) {
            if n == 0.0 {
                continue;
            }
            // Functions farther off vanish there, unless rounding has moved a knot past.
            if j.abs_diff(k) > degree {
                return Err(NurbsError::Undetermined { index: k });
            }
            matrix.add(k, j, n);
        }
    }
    matrix.factor()?;
    let mut points = data.to_vec();
    matrix.solve(&mut points, data.len() / count);
    Ok((knots, points))
}
