//! Surfaces through and near grids of points (The NURBS Book, A9.4 and A9.7).

use alloc::vec::Vec;

use super::least_squares::{self, Demand};
use super::{cast_knots, cast_points, check_parameters, interpolate, to_f64};
use crate::strip::transpose;
use crate::{KnotVector, NurbsError, Real, Surface, check};

/// Knots and points of the curve of least squares through points of any width, its ends fixed.
pub(super) fn approximate<T: Real>(
    degree: usize,
    count: usize,
    parameters: &[f64],
    data: &[f64],
) -> Result<(KnotVector<f64>, Vec<f64>), NurbsError> {
    let m = parameters.len();
    if count > m {
        return Err(NurbsError::FitCount { found: count, max: m });
    }
    if count == m {
        return interpolate::<T>(degree, parameters, data);
    }
    let knots = least_squares::knots::<T>(degree, count, parameters)?;
    let width = data.len() / m;
    let weight = |k: usize| (k > 0 && k + 1 < m).then_some(1.0);
    let demand = |(k, &t): (usize, &f64)| Demand { t, order: 0, weight: weight(k) };
    let demands: Vec<Demand> = parameters.iter().enumerate().map(demand).collect();
    let mut points = least_squares::solve(&knots, &demands, data, width)?;
    // To the last bit.
    let last = points.len() - width;
    points[..width].copy_from_slice(&data[..width]);
    points[last..].copy_from_slice(&data[data.len() - width..]);
    Ok((knots, points))
}

impl<T: Real> Surface<T> {
    /// The surface with as many control points as there are `points`, which passes through each:
    /// point `i * v.len() + j` at the parameters `u[i]`, `v[j]` (A9.4).
    ///
    /// [`Spacing::grid`](crate::Spacing::grid) makes parameters.
    ///
    /// ```
    /// use lucerna_nurbs::{Spacing, Surface};
    ///
    /// let points: Vec<[f64; 3]> = (0..30)
    ///     .map(|k| [(k / 6) as f64, (k % 6) as f64])
    ///     .map(|[x, y]| [x, y, (x * 0.7).sin() * y])
    ///     .collect();
    /// let (u, v) = Spacing::ChordLength.grid(&points, 6)?;
    /// let surface = Surface::interpolate(3, 3, &points, &u, &v)?;
    /// let (found, wanted) = (surface.point(u[2], v[4])?, points[2 * 6 + 4]);
    /// assert!((0..3).all(|axis| (found[axis] - wanted[axis]).abs() < 1e-13));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Curve::interpolate`](crate::Curve::interpolate), in each direction.
    pub fn interpolate(
        degree_u: usize,
        degree_v: usize,
        points: &[[T; 3]],
        u: &[T],
        v: &[T],
    ) -> Result<Self, NurbsError> {
        check_grid(points, u, v, true)?;
        Self::by_direction(points, u, v, [degree_u, degree_v], interpolate::<T>)
    }

    /// The surface with `counts` control points along u and v that meets the corners of the grid of
    /// points and comes close to the others: least squares along u, then along v (A9.7).
    ///
    /// ```
    /// use lucerna_nurbs::{Spacing, Surface};
    ///
    /// let points: Vec<[f64; 3]> = (0..400)
    ///     .map(|k| [(k / 20) as f64 / 19.0, (k % 20) as f64 / 19.0])
    ///     .map(|[x, y]| [x, y, (4.0 * x).sin() * y])
    ///     .collect();
    /// let (u, v) = Spacing::Even.grid(&points, 20)?;
    /// let surface = Surface::approximate([3, 2], [7, 5], &points, &u, &v)?;
    /// assert_eq!(surface.points().len(), 35);
    /// let [x, y, z] = surface.point(0.3, 0.6)?;
    /// assert!((z - (4.0 * x).sin() * y).abs() < 0.005);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Curve::approximate`](crate::Curve::approximate), in each direction.
    pub fn approximate(
        degrees: [usize; 2],
        counts: [usize; 2],
        points: &[[T; 3]],
        u: &[T],
        v: &[T],
    ) -> Result<Self, NurbsError> {
        check_grid(points, u, v, false)?;
        let mut counts = counts.into_iter();
        let fit = |degree, parameters: &[f64], data: &[f64]| {
            approximate::<T>(degree, counts.next().unwrap_or_default(), parameters, data)
        };
        Self::by_direction(points, u, v, degrees, fit)
    }

    /// Fits along u all columns at once, then along v all rows of the result.
    fn by_direction(
        points: &[[T; 3]],
        u: &[T],
        v: &[T],
        [degree_u, degree_v]: [usize; 2],
        mut fit: impl FnMut(usize, &[f64], &[f64]) -> Result<(KnotVector<f64>, Vec<f64>), NurbsError>,
    ) -> Result<Self, NurbsError> {
        let (knots_u, data) = fit(degree_u, &to_f64(u), &to_f64(points.as_flattened()))?;
        let data = transpose(&data, v.len(), 3);
        let (knots_v, data) = fit(degree_v, &to_f64(v), &data)?;
        let data = transpose(&data, knots_u.count(), 3);
        Self::new(cast_knots(&knots_u)?, cast_knots(&knots_v)?, cast_points(&data), None)
    }
}

fn check_grid<T: Real>(points: &[[T; 3]], u: &[T], v: &[T], strictly: bool) -> Result<(), NurbsError> {
    check_parameters("u", u, u.len().max(2), strictly)?;
    check_parameters("v", v, v.len().max(2), strictly)?;
    check::points(points, u.len() * v.len())
}
