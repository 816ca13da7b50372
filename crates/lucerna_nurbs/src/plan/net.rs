//! A net made ready for evaluation.

use crate::vector::{largest, sub};
use crate::{NurbsError, Real, check};

/// What is known about a net before its vertices are computed.
pub(super) struct Net<'a, T> {
    pub(super) points: &'a [[T; 3]],
    /// The net about its origin, divided by its size; in homogeneous coordinates when it has
    /// weights, these divided by the greatest.
    pub(super) scaled: &'a [T],
    /// 3, or 4 with weights.
    pub(super) parts: usize,
    /// Control points along v.
    pub(super) n_v: usize,
    pub(super) origin: [T; 3],
    pub(super) size: T,
}

impl<'a, T: Real> Net<'a, T> {
    /// Fills `scaled`, which has the right length. Weights have been checked, points not.
    pub(super) fn new(
        scaled: &'a mut [T],
        points: &'a [[T; 3]],
        weights: Option<&[T]>,
        n_v: usize,
    ) -> Result<Self, NurbsError> {
        let origin = points[0];
        let limit = check::point_limit();
        let (mut allowed, mut reach) = (true, [T::ZERO; 3]);
        for &point in points {
            for axis in 0..3 {
                allowed &= check::is_within(point[axis], limit);
                let x = (point[axis] - origin[axis]).abs();
                reach[axis] = if x > reach[axis] { x } else { reach[axis] };
            }
        }
        if !allowed {
            check::points(points, points.len())?;
        }
        let size = largest(reach);
        let by = T::ONE / size;
        let by = if by.is_finite() { by } else { T::ZERO };
        let parts = if let Some(weights) = weights {
            let greatest = weights.iter().fold(T::MIN_POSITIVE, |most, &w| if w > most { w } else { most });
            let (rows, weight_by) = (scaled.as_chunks_mut::<4>().0, T::ONE / greatest);
            for ((to, &point), &weight) in rows.iter_mut().zip(points).zip(weights) {
                let ([x, y, z], weight) = (sub(point, origin), weight * weight_by);
                *to = [x * by * weight, y * by * weight, z * by * weight, weight];
            }
            4
        } else {
            for (to, &point) in scaled.as_chunks_mut::<3>().0.iter_mut().zip(points) {
                let [x, y, z] = sub(point, origin);
                *to = [x * by, y * by, z * by];
            }
            3
        };
        Ok(Self { points, scaled, parts, n_v, origin, size })
    }
}
