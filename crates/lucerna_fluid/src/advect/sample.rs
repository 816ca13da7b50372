//! Trilinear samples of a lattice at sixteen places at once.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, i32x16, mask32x16};

use super::corners::corners;
pub(super) use crate::lanes::{least, most};

/// Values handled together.
pub(super) const LANES: usize = 16;

/// Sixteen numbers.
pub(super) type V<S> = f32x16<S>;

/// Sixteen whole numbers.
pub(super) type I<S> = i32x16<S>;

/// Values to be sampled, x fastest; places count from the first.
#[derive(Clone, Copy)]
pub(super) struct Lattice<'a> {
    pub(super) data: &'a [f32],
    pub(super) counts: [usize; 3],
    /// To the next value along each axis; 0 along an axis with a single one.
    pub(super) steps: [usize; 3],
    /// After how many values an axis repeats itself; 0 if it does not.
    periods: [f32; 3],
}

impl<'a> Lattice<'a> {
    pub(super) fn new(data: &'a [f32], counts: [usize; 3], periods: [f32; 3]) -> Self {
        let strides = [1, counts[0], counts[0] * counts[1]];
        let steps = std::array::from_fn(|axis| if counts[axis] > 1 { strides[axis] } else { 0 });
        Self { data, counts, steps, periods }
    }

    pub(super) fn counts(&self) -> [usize; 3] {
        self.counts
    }

    pub(super) fn is_periodic(&self, axis: usize) -> bool {
        self.periods[axis] > 0.0
    }
}

/// Where sixteen samples are to be taken.
#[derive(Clone, Copy)]
pub(super) struct Places<S: Simd> {
    pub(super) wholes: [I<S>; 3],
    pub(super) base: I<S>,
    pub(super) shares: [V<S>; 3],
    /// Which places lie on the lattice.
    inside: mask32x16<S>,
}

impl<S: Simd> Places<S> {
    /// Whether all of the `active` places lie on the lattice.
    #[inline(always)]
    pub(super) fn are_inside(&self, active: u64) -> bool {
        self.inside.to_bitmask() & active == active
    }
}

/// 0 to 15.
#[inline(always)]
pub(super) fn ramp<S: Simd>(simd: S) -> V<S> {
    counted(simd).to_float()
}

/// The same in whole numbers.
#[inline(always)]
pub(super) fn counted<S: Simd>(simd: S) -> I<S> {
    I::simd_from(simd, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15])
}

/// Sixteen values from `at` on; zeros beyond the end.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, data: &[f32], at: usize) -> V<S> {
    match data.get(at..at + LANES) {
        Some(values) => V::from_slice(simd, values),
        None => V::simd_from(simd, rest(data, at)),
    }
}

/// What there is from `at` on.
#[cold]
fn rest(data: &[f32], at: usize) -> [f32; LANES] {
    let mut values = [0.0; LANES];
    if let Some(rest) = data.get(at..) {
        values.iter_mut().zip(rest).for_each(|(value, rest)| *value = *rest);
    }
    values
}

/// Writes as many of the values as there is room for.
#[inline(always)]
pub(super) fn store<S: Simd>(out: &mut [f32], values: V<S>) {
    if let Some(chunk) = out.get_mut(..LANES) {
        values.store_slice(chunk);
    } else {
        out.iter_mut().zip(values.as_array()).for_each(|(out, value)| *out = *value);
    }
}

/// Bits of the lanes that are used of a row of `count` from `first` on.
#[inline(always)]
pub(super) fn active(count: usize, first: usize) -> u64 {
    let rest = count - first;
    if rest < LANES { (1 << rest) - 1 } else { (1 << LANES) - 1 }
}

/// Clamps places to the lattice (what is not a number counts as zero), or wraps them around.
#[inline(always)]
pub(super) fn places<S: Simd, const WRAPS: bool>(simd: S, lattice: &Lattice, at: [V<S>; 3]) -> Places<S> {
    let [nx, ny, _] = lattice.counts;
    let zero = V::splat(simd, 0.0);
    let mut wholes = [I::splat(simd, 0); 3];
    let mut shares = [zero; 3];
    let mut inside = mask32x16::splat(simd, true);
    for axis in 0..3 {
        let count = lattice.counts[axis];
        let mut place = at[axis];
        if WRAPS && lattice.periods[axis] > 0.0 {
            let period = lattice.periods[axis];
            place -= (place * (1.0 / period)).floor() * period;
        }
        let clamped = least(most(place, zero), V::splat(simd, (count - 1) as f32));
        inside &= clamped.simd_eq(place);
        let whole: I<S> = clamped.to_int();
        let last = I::splat(simd, count.saturating_sub(2) as i32);
        let whole = whole.simd_lt(last).select(whole, last);
        let float: V<S> = whole.to_float();
        shares[axis] = clamped - float;
        wholes[axis] = whole;
    }
    let [x, y, z] = wholes;
    Places { wholes, base: x + (y + z * ny as i32) * nx as i32, shares, inside }
}

/// Linear interpolation, exact where both values are the same.
#[inline(always)]
pub(super) fn mix<S: Simd>(a: V<S>, b: V<S>, share: V<S>) -> V<S> {
    a + share * (b - a)
}

/// Interpolates between corners.
#[inline(always)]
pub(super) fn blend<S: Simd>(corners: [V<S>; 8], places: &Places<S>) -> V<S> {
    let [a, b, c, d, e, f, g, h] = corners;
    let [fx, fy, fz] = places.shares;
    let low = mix(mix(a, b, fx), mix(c, d, fx), fy);
    let high = mix(mix(e, f, fx), mix(g, h, fx), fy);
    mix(low, high, fz)
}

/// Trilinear samples.
#[inline(always)]
pub(super) fn sample<S: Simd, const WRAPS: bool>(simd: S, lattice: &Lattice, at: [V<S>; 3], active: u64) -> V<S> {
    let places = places::<S, WRAPS>(simd, lattice, at);
    blend(corners(simd, lattice, &places, active), &places)
}

/// The least and the greatest corner.
#[inline(always)]
pub(super) fn bounds<S: Simd>(corners: &[V<S>; 8]) -> (V<S>, V<S>) {
    let (mut low, mut high) = (corners[0], corners[0]);
    for corner in &corners[1..] {
        low = least(*corner, low);
        high = most(*corner, high);
    }
    (low, high)
}
