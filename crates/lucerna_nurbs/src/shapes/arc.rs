//! Circular and elliptic arcs (The NURBS Book, A7.1).

use alloc::{vec, vec::Vec};
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, TAU};

use super::check_sweep;
use crate::{Curve, KnotVector, NurbsError, Real};

/// An arc of the unit circle as a curve of degree 2 in one to four pieces: for each control point
/// cosine and sine parts and weight. A full turn ends where it starts to the last bit.
pub(super) fn unit_arc<T: Real>(start: T, sweep: T) -> Result<(KnotVector<T>, Vec<[T; 3]>), NurbsError> {
    let full = check_sweep(sweep)?;
    if !start.is_finite() {
        return Err(NurbsError::Angle { name: "start", value: start.to_f64() });
    }
    let sweep = if full { TAU } else { sweep.to_f64() };
    // The quarters it takes, rounded up.
    let pieces = -Real::floor(-(sweep / FRAC_PI_2 - 1e-9));
    let pieces = pieces.clamp(1.0, 4.0);
    let half = sweep / (2.0 * pieces);
    // Where tangents at the ends of a piece meet, and the weight there.
    let weight = if full { FRAC_1_SQRT_2 } else { Real::sin_cos(half).1 };
    let count = 2 * pieces as usize + 1;
    let mut points = Vec::with_capacity(count);
    for k in 0..count {
        let (sin, cos) = direction(start.to_f64(), half * k as f64, full.then_some(k));
        let (w, reach) = if k % 2 == 0 { (1.0, 1.0) } else { (weight, 1.0 / weight) };
        points.push([cos * reach, sin * reach, w].map(T::from_f64));
    }
    if full {
        points[count - 1] = points[0];
    }
    let inner = (1..pieces as usize).flat_map(|k| vec![T::from_usize(k) / T::from_f64(pieces); 2]);
    Ok((KnotVector::clamped(2, &inner.collect::<Vec<T>>())?, points))
}

/// Sine and cosine of `start + angle`; where the angle is a number of eighths of a turn, exact zeros
/// and ones.
fn direction(start: f64, angle: f64, eighth: Option<usize>) -> (f64, f64) {
    const H: f64 = FRAC_1_SQRT_2;
    const EIGHTHS: [(f64, f64); 8] =
        [(0.0, 1.0), (H, H), (1.0, 0.0), (H, -H), (0.0, -1.0), (-H, -H), (-1.0, 0.0), (-H, H)];
    let Some(eighth) = eighth else { return Real::sin_cos(start + angle) };
    let ((s, c), (sin, cos)) = (Real::sin_cos(start), EIGHTHS[eighth % 8]);
    (s * cos + c * sin, c * cos - s * sin)
}

impl<T: Real, const D: usize> Curve<T, D> {
    /// The straight line from `a` to `b`, on the domain 0 to 1.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// assert_eq!(Curve::line([0.0, 0.0], [4.0, 2.0])?.point(0.25)?, [1.0, 0.5]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a coordinate is not finite.
    pub fn line(a: [T; D], b: [T; D]) -> Result<Self, NurbsError> {
        Self::new(KnotVector::clamped_uniform(1, 2)?, vec![a, b], None)
    }

    /// The arc `center + x cos a + y sin a` for angles `a`, in radians, from `start` to
    /// `start + sweep`: circular where `x` and `y` are perpendicular and of the same length, the
    /// radius; elliptic otherwise (A7.1). Degree 2, one piece for each quarter of a turn, on the
    /// domain 0 to 1.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    /// use std::f64::consts::FRAC_PI_3;
    ///
    /// let arc = Curve::arc([1.0, 0.0], [2.0, 0.0], [0.0, 2.0], 0.0, FRAC_PI_3)?;
    /// let [x, y] = arc.point(1.0)?;
    /// assert!((x - 2.0).abs() < 1e-15 && (y - 3.0_f64.sqrt()).abs() < 1e-15);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `sweep` is not above 0 and at most 2 pi, or another number is not finite.
    pub fn arc(center: [T; D], x: [T; D], y: [T; D], start: T, sweep: T) -> Result<Self, NurbsError> {
        let (knots, arc) = unit_arc(start, sweep)?;
        let point =
            |&[cos, sin, _]: &[T; 3]| core::array::from_fn(|axis| center[axis] + (x[axis] * cos + y[axis] * sin));
        Self::new(knots, arc.iter().map(point).collect(), Some(arc.iter().map(|point| point[2]).collect()))
    }

    /// The full circle or ellipse of [`arc`](Self::arc), from `center + x` on, in nine points. It
    /// ends where it starts to the last bit.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// let circle = Curve::circle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0_f64])?;
    /// assert_eq!(circle.point(0.25)?, [0.0, 0.0, -1.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a number is not finite.
    pub fn circle(center: [T; D], x: [T; D], y: [T; D]) -> Result<Self, NurbsError> {
        Self::arc(center, x, y, T::ZERO, T::from_f64(TAU))
    }
}
