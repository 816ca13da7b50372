//! Parameters for points (The NURBS Book, section 9.2.1 and A9.3).

use alloc::{vec, vec::Vec};

use crate::{NurbsError, Real, check};

/// How far apart the parameters of neighbouring points lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Spacing {
    /// Equally far, wherever the points are (equation 9.3).
    Even,
    /// As far as the points (equation 9.5): right for most.
    #[default]
    ChordLength,
    /// As the square roots of the distances (E. T. Y. Lee; equation 9.6): better at sharp turns.
    Centripetal,
}

impl Spacing {
    /// A parameter for each point, from 0 to 1.
    ///
    /// Points that coincide with their neighbour get the same parameter, unless the spacing is even.
    ///
    /// ```
    /// use lucerna_nurbs::Spacing;
    ///
    /// // Equation 9.5 on the points of the book's Ex. 9.1.
    /// let points = [[0.0, 0.0], [3.0, 4.0], [-1.0, 4.0], [-4.0, 0.0], [-4.0, -3.0_f64]];
    /// let parameters = Spacing::ChordLength.parameters(&points)?;
    /// for (t, wanted) in parameters.into_iter().zip([0.0, 5.0, 9.0, 14.0, 17.0]) {
    ///     assert!((t - wanted / 17.0).abs() < 1e-15);
    /// }
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When there are fewer than two points, a coordinate is not finite, or all points coincide.
    pub fn parameters<T: Real, const D: usize>(self, points: &[[T; D]]) -> Result<Vec<T>, NurbsError> {
        check::points(points, points.len().max(2))?;
        let lengths = self.lengths(points.len(), |a, b| distance(points[a], points[b]));
        Ok(cast(&share(&lengths).ok_or(NurbsError::Coincident)?))
    }

    /// Parameters for a grid of points, `columns` in a row: one for each row (along u) and one for
    /// each column (along v), the means over all columns and rows. Rows and columns whose points
    /// all coincide do not count.
    ///
    /// ```
    /// use lucerna_nurbs::Spacing;
    ///
    /// let points = [[0.0, 0.0], [0.0, 2.0], [1.0, 0.0], [1.0, 2.0], [4.0, 0.0], [4.0, 2.0_f64]];
    /// let (u, v) = Spacing::ChordLength.grid(&points, 2)?;
    /// assert_eq!((u, v), (vec![0.0, 0.25, 1.0], vec![0.0, 1.0]));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the points do not fill whole rows, there are fewer than two rows or columns, a
    /// coordinate is not finite, or all points of every row or of every column coincide.
    pub fn grid<T: Real, const D: usize>(
        self,
        points: &[[T; D]],
        columns: usize,
    ) -> Result<(Vec<T>, Vec<T>), NurbsError> {
        let rows = points.len() / columns.max(1);
        check::points(points, rows.max(2).saturating_mul(columns.max(2)))?;
        let between = |a: usize, b: usize| distance(points[a], points[b]);
        let u = self.mean(columns, rows, |column, a, b| between(a * columns + column, b * columns + column))?;
        let v = self.mean(rows, columns, |row, a, b| between(row * columns + a, row * columns + b))?;
        Ok((cast(&u), cast(&v)))
    }

    /// The mean of the parameters of several lines of `count` points each.
    pub(crate) fn mean(
        self,
        lines: usize,
        count: usize,
        distance: impl Fn(usize, usize, usize) -> f64,
    ) -> Result<Vec<f64>, NurbsError> {
        let mut sum = vec![0.0; count];
        let mut used = 0.0;
        for line in 0..lines {
            if let Some(parameters) = share(&self.lengths(count, |a, b| distance(line, a, b))) {
                used += 1.0;
                sum.iter_mut().zip(parameters).for_each(|(sum, t)| *sum += t);
            }
        }
        if used == 0.0 {
            return Err(NurbsError::Coincident);
        }
        Ok(sum.into_iter().map(|t| t / used).collect())
    }

    fn lengths(self, count: usize, distance: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let length = |k: usize| match self {
            Self::Even => 1.0,
            Self::ChordLength => distance(k - 1, k),
            Self::Centripetal => Real::sqrt(distance(k - 1, k)),
        };
        (1..count).map(length).collect()
    }
}

/// From lengths to parameters; `None` when all are zero.
fn share(lengths: &[f64]) -> Option<Vec<f64>> {
    let largest = lengths.iter().fold(0.0, |a: f64, &b| a.max(b));
    if largest < f64::MIN_POSITIVE {
        return None;
    }
    let total: f64 = lengths.iter().map(|x| x / largest).sum();
    let mut at = 0.0;
    let mut parameters = vec![0.0];
    for (k, length) in lengths.iter().enumerate() {
        at += length / largest;
        // The last is 1 even where the sums differ by rounding.
        parameters.push(if k + 1 == lengths.len() { 1.0 } else { (at / total).min(1.0) });
    }
    Some(parameters)
}

/// The distance, without overflow.
pub(crate) fn distance<T: Real, const D: usize>(a: [T; D], b: [T; D]) -> f64 {
    let difference: [f64; D] = core::array::from_fn(|axis| a[axis].to_f64() - b[axis].to_f64());
    let size = difference.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    if size == 0.0 {
        return 0.0;
    }
    let square: f64 = difference.iter().map(|x| (x / size) * (x / size)).sum();
    size * Real::sqrt(square)
}

fn cast<T: Real>(values: &[f64]) -> Vec<T> {
    values.iter().map(|&x| T::from_f64(x)).collect()
}
