//! Trilinear samples of a lattice at eight places at once.
//!
//! What makes sampling slow is fetching the eight corners of each place one by one. Where the
//! flow is smooth, neighbours in a row come from neighbours in a row: their corners are plain
//! loads of eight. Lanes that come from elsewhere are fetched in groups that share their shift.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8, i32x8};

/// Values handled together.
pub(super) const LANES: usize = 8;

/// Eight numbers.
pub(super) type V<S> = f32x8<S>;

/// Values to be sampled, x fastest; places count from the first.
#[derive(Clone, Copy)]
pub(super) struct Lattice<'a> {
    pub(super) data: &'a [f32],
    counts: [usize; 3],
    /// To the next value along each axis; 0 along an axis with a single one.
    steps: [usize; 3],
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
}

/// Where eight samples are to be taken.
#[derive(Clone, Copy)]
pub(super) struct Places<S: Simd> {
    pub(super) wholes: [i32x8<S>; 3],
    base: i32x8<S>,
    pub(super) shares: [V<S>; 3],
}

/// 0 to 7.
#[inline(always)]
pub(super) fn ramp<S: Simd>(simd: S) -> V<S> {
    V::simd_from(simd, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])
}

/// The smaller of two, the same on every level.
#[inline(always)]
pub(super) fn least<S: Simd>(a: V<S>, b: V<S>) -> V<S> {
    a.simd_lt(b).select(a, b)
}

/// The larger of two; `b` where `a` is not a number.
#[inline(always)]
pub(super) fn most<S: Simd>(a: V<S>, b: V<S>) -> V<S> {
    a.simd_gt(b).select(a, b)
}

/// Eight values from `at` on; zeros beyond the end.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, data: &[f32], at: usize) -> V<S> {
    if let Some(values) = data.get(at..at + LANES) {
        return V::from_slice(simd, values);
    }
    let mut values = [0.0; LANES];
    if let Some(rest) = data.get(at..) {
        values.iter_mut().zip(rest).for_each(|(value, rest)| *value = *rest);
    }
    V::simd_from(simd, values)
}

/// Writes as many of the values as there is room for.
#[inline(always)]
pub(super) fn store<S: Simd>(out: &mut [f32], values: V<S>) {
    if let Some(chunk) = out.first_chunk_mut::<LANES>() {
        *chunk = *values.as_array();
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
    let mut wholes = [i32x8::splat(simd, 0); 3];
    let mut shares = [zero; 3];
    for axis in 0..3 {
        let count = lattice.counts[axis];
        let mut place = at[axis];
        if WRAPS && lattice.periods[axis] > 0.0 {
            let period = lattice.periods[axis];
            place -= (place * (1.0 / period)).floor() * period;
        }
        let place = least(most(place, zero), V::splat(simd, (count - 1) as f32));
        let whole: i32x8<S> = place.to_int();
        let last = i32x8::splat(simd, count.saturating_sub(2) as i32);
        let whole = whole.simd_lt(last).select(whole, last);
        let float: V<S> = whole.to_float();
        shares[axis] = place - float;
        wholes[axis] = whole;
    }
    let [x, y, z] = wholes;
    Places { wholes, base: x + (y + z * ny as i32) * nx as i32, shares }
}

/// Values from `from` on, if that many there are.
#[inline(always)]
fn window(data: &[f32], from: i32, span: usize) -> Option<&[f32]> {
    // A negative number becomes one beyond any length.
    let from = from as usize;
    data.get(from..from.wrapping_add(span))
}

/// The eight corners of each place: x fastest, then y, then z. Only the `active` lanes count.
#[inline(always)]
pub(super) fn corners<S: Simd>(simd: S, lattice: &Lattice, places: &Places<S>, active: u64) -> [V<S>; 8] {
    let [dx, dy, dz] = lattice.steps;
    let shifts = [0, dx, dy, dy + dx, dz, dz + dx, dz + dy, dz + dy + dx];
    let span = shifts[7] + LANES;
    let ramp = i32x8::simd_from(simd, [0, 1, 2, 3, 4, 5, 6, 7]);
    let shift = places.base - ramp;
    let shift_of = *shift.as_array();
    let from = shift_of[0];
    let same = shift.simd_eq(i32x8::splat(simd, from)).to_bitmask();
    let mut corners = [V::splat(simd, 0.0); 8];
    if same & active == active
        && let Some(window) = window(lattice.data, from, span)
    {
        for (corner, values) in corners.iter_mut().enumerate() {
            *values = V::from_slice(simd, &window[shifts[corner]..shifts[corner] + LANES]);
        }
        return corners;
    }
    let mut pending = active;
    while pending != 0 {
        let lane = pending.trailing_zeros() as usize % LANES;
        let from = shift_of[lane];
        if let Some(window) = window(lattice.data, from, span) {
            let same = shift.simd_eq(i32x8::splat(simd, from));
            for (corner, values) in corners.iter_mut().enumerate() {
                *values = same.select(V::from_slice(simd, &window[shifts[corner]..shifts[corner] + LANES]), *values);
            }
            pending &= !same.to_bitmask();
        } else {
            // At the very ends of the array.
            let base = (from + lane as i32) as usize;
            for (values, shift) in corners.iter_mut().zip(shifts) {
                values[lane] = lattice.data[base + shift];
            }
            pending &= !(1 << lane);
        }
    }
    corners
}

/// Linear interpolation, exact where both values are the same.
#[inline(always)]
fn mix<S: Simd>(a: V<S>, b: V<S>, share: V<S>) -> V<S> {
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
