//! Surfaces of revolution (The NURBS Book, A8.1).

use alloc::vec::Vec;
use core::f64::consts::TAU;

use super::arc::unit_arc;
use crate::vector::{add_scaled, cross, dot, largest, sub, unit};
use crate::{Curve, KnotVector, NurbsError, Real, Surface, check};

impl<T: Real> Curve<T, 3> {
    /// The surface that the curve passes over when it turns by `sweep` radians, counter-clockwise
    /// for an eye that `axis` points to, about the line through `origin` along `axis` (A8.1). u is
    /// along the circles, from 0 to 1, v along the curve.
    ///
    /// Normals point away from the axis where the curve rises along it.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    /// use std::f64::consts::TAU;
    ///
    /// let line = Curve::line([2.0, 0.0, 0.0], [0.0, 3.0, 0.0])?;
    /// let cone = line.revolve([0.0; 3], [0.0, 1.0, 0.0], TAU)?;
    /// assert_eq!(cone.point(0.25, 0.5)?, [0.0, 1.5, -1.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `sweep` is not above 0 and at most 2 pi, `axis` has no direction, or a number is not
    /// finite.
    pub fn revolve(&self, origin: [T; 3], axis: [T; 3], sweep: T) -> Result<Surface<T>, NurbsError> {
        let axis = unit(axis).ok_or(NurbsError::NoDirection { name: "axis" })?;
        let (knots, arc) = unit_arc(T::ZERO, sweep)?;
        let spokes: Vec<_> = self.points().iter().map(|&point| spoke(point, origin, axis)).collect();
        let mut points = Vec::with_capacity(arc.len() * spokes.len());
        let mut weights = Vec::with_capacity(points.capacity());
        for [cos, sin, w] in arc {
            for (i, (foot, x)) in spokes.iter().enumerate() {
                let mut point = *foot;
                add_scaled(&mut point, x, cos);
                add_scaled(&mut point, &cross(axis, *x), sin);
                points.push(point);
                weights.push(w * self.weights().map_or(T::ONE, |weights| weights[i]));
            }
        }
        Surface::new(knots, self.knots().clone(), points, Some(weights))
    }
}

/// The foot of a point on the axis, and the way from there to the point: exactly none for points on
/// the axis to rounding, so that poles are points.
fn spoke<T: Real>(point: [T; 3], origin: [T; 3], axis: [T; 3]) -> ([T; 3], [T; 3]) {
    let from_origin = sub(point, origin);
    let mut foot = origin;
    add_scaled(&mut foot, &axis, dot(from_origin, axis));
    let x = sub(point, foot);
    let size = largest(from_origin).max(largest(origin));
    if largest(x) <= T::from_f64(8.0) * T::EPSILON * size { (point, [T::ZERO; 3]) } else { (foot, x) }
}

impl<T: Real> Surface<T> {
    /// A sphere, exactly: 9 x 5 points, degree 2 in both directions. u runs around the y axis, v
    /// from the lowest point to the highest; normals point outwards, at the poles too.
    ///
    /// ```
    /// use lucerna_nurbs::Surface;
    ///
    /// let sphere = Surface::sphere([0.0, 1.0, 0.0], 2.0_f64)?;
    /// assert_eq!(sphere.point(0.5, 1.0)?, [0.0, 3.0, 0.0]);
    /// assert!((sphere.normal(0.5, 1.0)?[1] - 1.0).abs() < 1e-15);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the radius is not positive and finite, or the centre is not finite.
    pub fn sphere(center: [T; 3], radius: T) -> Result<Self, NurbsError> {
        check::positive("radius", radius)?;
        // The right half of a circle, from below: the first five points of nine.
        let circle = Curve::circle([T::ZERO; 2], [T::ZERO, -radius], [radius, T::ZERO])?;
        let weights = circle.weights().map(|weights| weights[..5].to_vec());
        let knots = KnotVector::clamped(2, &[T::from_f64(0.5); 2])?;
        about_y(&Curve::new(knots, circle.points()[..5].to_vec(), weights)?, center)
    }

    /// A torus, exactly: 9 x 9 points, degree 2 in both directions. `major` is the distance of the
    /// tube's middle from the y axis through `center`, `minor` the radius of the tube. Normals
    /// point out of the tube.
    ///
    /// ```
    /// use lucerna_nurbs::Surface;
    ///
    /// let torus = Surface::torus([0.0; 3], 3.0, 1.0_f64)?;
    /// assert_eq!(torus.point(0.0, 0.25)?, [3.0, 1.0, 0.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a radius is not positive and finite, or the centre is not finite.
    pub fn torus(center: [T; 3], major: T, minor: T) -> Result<Self, NurbsError> {
        check::positive("major", major)?;
        check::positive("minor", minor)?;
        about_y(&Curve::circle([major, T::ZERO], [minor, T::ZERO], [T::ZERO, minor])?, center)
    }

    /// The side of a cylinder, exactly: 9 x 2 points. It stands on the circle about `base` and
    /// reaches `height` up along y; normals point outwards.
    ///
    /// ```
    /// use lucerna_nurbs::Surface;
    ///
    /// let cylinder = Surface::cylinder([0.0; 3], 0.5, 2.0_f64)?;
    /// assert_eq!(cylinder.normal(0.5, 0.3)?, [-1.0, 0.0, 0.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a length is not positive and finite, or the centre is not finite.
    pub fn cylinder(base: [T; 3], radius: T, height: T) -> Result<Self, NurbsError> {
        check::positive("radius", radius)?;
        check::positive("height", height)?;
        about_y(&Curve::line([radius, T::ZERO], [radius, height])?, base)
    }
}

/// Turns a profile of distances and heights about the vertical through `center`.
fn about_y<T: Real>(profile: &Curve<T, 2>, center: [T; 3]) -> Result<Surface<T>, NurbsError> {
    let at = |&[x, y]: &[T; 2]| [center[0] + x, center[1] + y, center[2]];
    let points = profile.points().iter().map(at).collect();
    let weights = profile.weights().map(<[T]>::to_vec);
    let curve = Curve::new(profile.knots().clone(), points, weights)?;
    curve.revolve(center, [T::ZERO, T::ONE, T::ZERO], T::from_f64(TAU))
}
