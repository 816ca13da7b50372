//! The few operations on coordinate arrays the crate needs.

use crate::Real;

#[inline]
pub(crate) fn add_scaled<T: Real, const D: usize>(sum: &mut [T; D], a: &[T; D], s: T) {
    for (x, &y) in sum.iter_mut().zip(a) {
        *x += y * s;
    }
}

/// `a` for a `t` of 0, `b` for 1.
#[inline]
pub(crate) fn lerp<T: Real, const D: usize>(a: [T; D], b: [T; D], t: T) -> [T; D] {
    core::array::from_fn(|axis| a[axis] + (b[axis] - a[axis]) * t)
}

#[inline]
pub(crate) fn sub<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
pub(crate) fn dot<T: Real>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(crate) fn cross<T: Real>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline]
pub(crate) fn scale<T: Real>(a: [T; 3], s: T) -> [T; 3] {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// The length of the longest coordinate.
pub(crate) fn largest<T: Real>(a: [T; 3]) -> T {
    a[0].abs().max(a[1].abs()).max(a[2].abs())
}

/// The direction of `a`; `None` where it has none. Scaled first: no overflow, no underflow.
pub(crate) fn unit<T: Real>(a: [T; 3]) -> Option<[T; 3]> {
    let size = largest(a);
    if !(size >= T::MIN_POSITIVE && size.is_finite()) {
        return None;
    }
    let b = [a[0] / size, a[1] / size, a[2] / size];
    let length = dot(b, b).sqrt();
    length.is_finite().then(|| scale(b, T::ONE / length))
}

/// The direction of `a` x `b`; `None` where they are parallel or one has no direction.
pub(crate) fn unit_cross<T: Real>(a: [T; 3], b: [T; 3]) -> Option<[T; 3]> {
    let normal = cross(unit(a)?, unit(b)?);
    if dot(normal, normal) > T::EPSILON { unit(normal) } else { None }
}
