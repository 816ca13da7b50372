//! Extrusion, and surfaces between two curves.

use alloc::{vec, vec::Vec};

use super::loft::compatible;
use crate::{Curve, KnotVector, NurbsError, Real, Surface};

impl<T: Real> Curve<T, 3> {
    /// The surface that the curve passes over when it is moved by `by`: u along the curve, v from 0
    /// to 1 along `by`.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// let wall = Curve::line([0.0; 3], [4.0, 0.0, 0.0])?.extrude([0.0, 2.0, 0.0])?;
    /// assert_eq!(wall.point(0.25, 0.5)?, [1.0, 1.0, 0.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `by` is not finite.
    pub fn extrude(&self, by: [T; 3]) -> Result<Surface<T>, NurbsError> {
        let moved = |point: [T; 3]| [point[0] + by[0], point[1] + by[1], point[2] + by[2]];
        let points = self.points().iter().flat_map(|&point| [point, moved(point)]).collect();
        let weights = self.weights().map(|weights| weights.iter().flat_map(|&w| [w, w]).collect());
        Surface::new(self.knots().clone(), KnotVector::clamped_uniform(1, 2)?, points, weights)
    }
}

impl<T: Real> Surface<T> {
    /// The surface of straight lines between points of two curves that are as far along their
    /// domains: u along the curves, v from the first to the second, both from 0 to 1.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, Surface};
    ///
    /// let low = Curve::circle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0_f64])?;
    /// let high = Curve::line([-1.0, 2.0, -1.0], [1.0, 2.0, 1.0])?;
    /// let surface = Surface::ruled(&low, &high)?;
    /// assert_eq!(surface.point(0.5, 0.0)?, low.point(0.5)?);
    /// assert_eq!(surface.point(0.5, 1.0)?, high.point(0.5)?);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the coordinates are so large that sums overflow.
    pub fn ruled(first: &Curve<T, 3>, second: &Curve<T, 3>) -> Result<Self, NurbsError> {
        let curves = compatible(&[first.clone(), second.clone()])?;
        let (a, b) = (&curves[0], &curves[1]);
        let pairs = a.points().iter().zip(b.points());
        let points: Vec<_> = pairs.flat_map(|(&a, &b)| vec![a, b]).collect();
        let weights = a.weights().zip(b.weights());
        let weights = weights.map(|(a, b)| a.iter().zip(b).flat_map(|(&a, &b)| [a, b]).collect());
        Self::new(a.knots().clone(), KnotVector::clamped_uniform(1, 2)?, points, weights)
    }
}
