//! The closest point, the global one.
//!
//! Bezier patches are halved, the nearest first, and dropped when a bound from below shows that
//! they cannot come closer than the best point known; that point is polished by Newton's method
//! (The NURBS Book, section 6.1) whenever it is new.

mod newton;

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;

use crate::fit::distance;
use crate::patch::{Patch, Ranked};
use crate::{Curve, NurbsError, Real, Surface, check};
use newton::{Jet, polish};

/// Where a curve comes closest to a point, from [`Curve::closest_point`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint<T, const D: usize> {
    /// The parameter.
    pub t: T,
    /// The point of the curve.
    pub point: [T; D],
    /// Its distance.
    pub distance: T,
}

/// Where a surface comes closest to a point, from [`Surface::closest_point`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint<T> {
    /// The first parameter.
    pub u: T,
    /// The second parameter.
    pub v: T,
    /// The point of the surface.
    pub point: [T; 3],
    /// Its distance.
    pub distance: T,
}

/// By how much of the distance a point that is not the closest may be missed.
const SLACK: f64 = 1e-9;

impl<T: Real, const D: usize> Curve<T, D> {
    /// The point of the curve closest to `target`, of all, not of those nearby; one of them where
    /// there are several.
    ///
    /// No other point is closer by more than a billionth of the distance, unless so much of the
    /// curve is so nearly as close that thousands of pieces do not tell (the centre of a circle).
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// let circle = Curve::circle([0.0; 2], [2.0, 0.0], [0.0, 2.0_f64])?;
    /// let closest = circle.closest_point([3.0, -4.0])?;
    /// assert!((closest.distance - 3.0).abs() < 1e-14);
    /// assert!((closest.point[0] - 1.2).abs() < 1e-14 && (closest.point[1] + 1.6).abs() < 1e-14);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `target` is not finite.
    pub fn closest_point(&self, target: [T; D]) -> Result<CurvePoint<T, D>, NurbsError> {
        check::points(&[target], 1)?;
        let (origin, size) = frame(self.points(), target);
        let curve = self.map_f64(|point| place(point, origin, size))?;
        let (lo, hi) = curve.domain();
        let jet = |[t, _]: [f64; 2]| {
            let d = curve.derivatives(t, 2)?;
            let zero = [0.0; D];
            Ok([d[0], d[1], zero, d[2], zero, zero])
        };
        let [t, _] = search(Patch::of_curve(&curve), [[lo, hi], [0.0; 2]], jet)?;
        let t = T::from_f64(t);
        let point = self.point(t)?;
        Ok(CurvePoint { t, point, distance: T::from_f64(distance(point, target)) })
    }
}

impl<T: Real> Surface<T> {
    /// The point of the surface closest to `target`, of all, not of those nearby; one of them where
    /// there are several.
    ///
    /// No other point is closer by more than a billionth of the distance, unless so much of the
    /// surface is so nearly as close that thousands of patches do not tell (the centre of a sphere).
    ///
    /// ```
    /// use lucerna_nurbs::Surface;
    ///
    /// let torus = Surface::torus([0.0; 3], 3.0, 1.0_f64)?;
    /// let closest = torus.closest_point([0.0, 2.0, -3.0])?;
    /// assert!((closest.distance - 1.0).abs() < 1e-14);
    /// assert!((closest.u - 0.25).abs() < 1e-8 && (closest.v - 0.25).abs() < 1e-8);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `target` is not finite.
    pub fn closest_point(&self, target: [T; 3]) -> Result<SurfacePoint<T>, NurbsError> {
        check::points(&[target], 1)?;
        let (origin, size) = frame(self.points(), target);
        let surface = self.map_f64(|point| place(point, origin, size))?;
        let ((u_lo, u_hi), (v_lo, v_hi)) = (surface.knots_u().domain(), surface.knots_v().domain());
        let jet = |[u, v]: [f64; 2]| {
            let d = surface.derivatives(u, v, 2)?;
            let at = |k, l| d.get(k, l).unwrap_or_default();
            Ok([at(0, 0), at(1, 0), at(0, 1), at(2, 0), at(1, 1), at(0, 2)])
        };
        let [u, v] = search(Patch::of_surface(&surface)?, [[u_lo, u_hi], [v_lo, v_hi]], jet)?;
        let (u, v) = (T::from_f64(u), T::from_f64(v));
        let point = self.point(u, v)?;
        Ok(SurfacePoint { u, v, point, distance: T::from_f64(distance(point, target)) })
    }
}

/// The target, and the largest coordinate of a control point seen from there.
fn frame<T: Real, const D: usize>(points: &[[T; D]], target: [T; D]) -> ([f64; D], f64) {
    let origin = target.map(Real::to_f64);
    let reach =
        |point: &[T; D]| (0..D).fold(0.0, |most: f64, axis| most.max((point[axis].to_f64() - origin[axis]).abs()));
    let size = points.iter().map(reach).fold(0.0, f64::max);
    (origin, if size > 0.0 { size } else { 1.0 })
}

/// Moves the target to the origin and scales the shape to size 1.
fn place<const D: usize>(point: [f64; D], origin: [f64; D], size: f64) -> [f64; D] {
    core::array::from_fn(|axis| (point[axis] - origin[axis]) / size)
}

fn length<const D: usize>(a: [f64; D]) -> f64 {
    Real::sqrt(a.iter().map(|x| x * x).sum::<f64>())
}

/// What the points of a patch are away from the origin at least: the control points lie in a box, and behind a plane
/// across the way to their middle; so do all points of the patch.
fn least_distance<const D: usize>(patch: &Patch<D>) -> f64 {
    let (mut min, mut max, mut middle) = ([f64::MAX; D], [-f64::MAX; D], [0.0; D]);
    for point in patch.hull() {
        for axis in 0..D {
            min[axis] = min[axis].min(point[axis]);
            max[axis] = max[axis].max(point[axis]);
            middle[axis] += point[axis];
        }
    }
    let to_box = length::<D>(core::array::from_fn(|axis| min[axis].max(0.0).max(-max[axis])));
    let far = length(middle);
    let along = |point: [f64; D]| point.iter().zip(middle).map(|(a, b)| a * (b / far)).sum::<f64>();
    let to_plane = if far > 0.0 { patch.hull().map(along).fold(f64::MAX, f64::min) } else { 0.0 };
    to_box.max(to_plane)
}

/// The parameters at which the shape comes closest to the origin.
fn search<const D: usize>(
    patches: Vec<Patch<D>>,
    domain: [[f64; 2]; 2],
    jet: impl Fn([f64; 2]) -> Result<Jet<D>, NurbsError>,
) -> Result<[f64; 2], NurbsError> {
    let halvings = Patch::halvings(&patches);
    let start = [domain[0][0], domain[1][0]];
    let nearest = |patch: &Patch<D>| {
        let corners = patch.corners().map(|(at, point)| (at, length(point)));
        corners.fold((start, f64::INFINITY), |a, b| if b.1 < a.1 { b } else { a })
    };
    let corners = patches.iter().map(nearest);
    let best = corners.fold((start, f64::INFINITY), |a, b| if b.1 < a.1 { b } else { a });
    let mut best = polish(best, domain, &jet)?;
    let nearest_first = |patch: Patch<D>| Ranked { rank: -least_distance(&patch), item: patch };
    let mut heap: BinaryHeap<_> = patches.into_iter().map(nearest_first).collect();
    for _ in 0..halvings {
        let Some(Ranked { rank, item: patch }) = heap.pop() else { break };
        if -rank >= best.1 * (1.0 - SLACK) - f64::EPSILON {
            break;
        }
        for half in patch.halve(patch.long()).into_iter().flatten() {
            let corner = nearest(&half);
            if corner.1 < best.1 {
                best = polish(corner, domain, &jet)?;
            }
            heap.push(nearest_first(half));
        }
    }
    Ok(best.0)
}
