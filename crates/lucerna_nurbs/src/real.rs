//! The scalar type: `f32` or `f64`.

use core::fmt::{Debug, Display};
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

mod sealed {
    pub trait Sealed: crate::simd::Lanes {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A floating point scalar, `f32` or `f64`. Everything in this crate is generic over it.
///
/// The trait is sealed: the tolerances are chosen for these two types.
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + Display
    + PartialOrd
    + Send
    + Sync
    + Sum
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<Output = Self>
    + MulAssign
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// Zero.
    const ZERO: Self;
    /// One.
    const ONE: Self;
    /// The distance from one to the next larger value.
    const EPSILON: Self;
    /// The largest finite value.
    const MAX: Self;
    /// The smallest positive normal value.
    const MIN_POSITIVE: Self;

    /// The nearest value to `value`.
    fn from_f64(value: f64) -> Self;
    /// The nearest value to a count.
    fn from_usize(value: usize) -> Self;
    /// The same value as `f64`, exactly.
    fn to_f64(self) -> f64;
    /// The square root, NaN below zero.
    fn sqrt(self) -> Self;
    /// The largest whole number that is not above.
    fn floor(self) -> Self;
    /// Sine and cosine of an angle in radians, the same bits on every platform.
    fn sin_cos(self) -> (Self, Self);
    /// The absolute value.
    fn abs(self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// The larger of two values; the other one where one is NaN.
    fn max(self, other: Self) -> Self;
}

macro_rules! real {
    ($t:ident) => {
        #[allow(clippy::cast_lossless, reason = "one body for both widths: f64 to f64 and f32 to f64")]
        impl Real for $t {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const EPSILON: Self = $t::EPSILON;
            const MAX: Self = $t::MAX;
            const MIN_POSITIVE: Self = $t::MIN_POSITIVE;

            #[inline]
            fn from_f64(value: f64) -> Self {
                value as $t
            }
            #[inline]
            fn from_usize(value: usize) -> Self {
                value as $t
            }
            #[inline]
            fn to_f64(self) -> f64 {
                self as f64
            }
            #[inline]
            fn sqrt(self) -> Self {
                #[cfg(feature = "std")]
                return self.sqrt();
                #[cfg(not(feature = "std"))]
                return libm::sqrt(self as f64) as $t;
            }
            #[inline]
            fn floor(self) -> Self {
                #[cfg(feature = "std")]
                return self.floor();
                #[cfg(not(feature = "std"))]
                return libm::floor(self as f64) as $t;
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = libm::sincos(self as f64);
                (sin as $t, cos as $t)
            }
            #[inline]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline]
            fn is_finite(self) -> bool {
                self.is_finite()
            }
            #[inline]
            fn max(self, other: Self) -> Self {
                self.max(other)
            }
        }
    };
}

real!(f32);
real!(f64);
