//! Monotone cubic samples: Hermite interpolation along one axis after the other, with slopes
//! that never overshoot (F. Fritsch and R. Carlson, SIAM J. Numer. Anal. 17, 1980; R. Fedkiw,
//! J. Stam, H. W. Jensen, *Visual Simulation of Smoke*, SIGGRAPH 2001, appendix B).

use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask32x16};

use super::sample::{I, LANES, Places, V, counted, least};

/// A lattice with one value more before the first and after the last along each axis that has
/// more than one, and sixteen values more at either end of the array.
#[derive(Clone, Copy)]
pub(super) struct Padded<'a> {
    data: &'a [f32],
    counts: [usize; 3],
    steps: [usize; 3],
}

impl<'a> Padded<'a> {
    /// For counts with what was added.
    pub(super) fn new(data: &'a [f32], counts: [usize; 3]) -> Self {
        let strides = [1, counts[0], counts[0] * counts[1]];
        let steps = std::array::from_fn(|axis| if counts[axis] > 1 { strides[axis] } else { 0 });
        Self { data, counts, steps }
    }
}

/// Lanes that are read from the same shift.
struct Groups<S: Simd> {
    count: usize,
    from: [usize; LANES],
    lanes: [mask32x16<S>; LANES],
}

impl<S: Simd> Groups<S> {
    #[inline(always)]
    fn new(simd: S, base: I<S>, active: u64) -> Self {
        let shift = base - counted(simd);
        let shifts = *shift.as_array();
        let none = mask32x16::splat(simd, false);
        let mut groups = Self { count: 0, from: [0; LANES], lanes: [none; LANES] };
        let mut pending = active;
        while pending != 0 {
            let from = shifts[pending.trailing_zeros() as usize % LANES];
            let lanes = shift.simd_eq(I::splat(simd, from));
            groups.from[groups.count] = (from + LANES as i32) as usize;
            groups.lanes[groups.count] = lanes;
            groups.count += 1;
            pending &= !lanes.to_bitmask();
        }
        groups
    }

    /// The values `ahead` of each lane's base.
    #[inline(always)]
    fn load(&self, simd: S, data: &[f32], ahead: usize) -> V<S> {
        let mut values = V::from_slice(simd, &data[self.from[0] + ahead..][..LANES]);
        for group in 1..self.count.min(LANES) {
            let others = V::from_slice(simd, &data[self.from[group] + ahead..][..LANES]);
            values = self.lanes[group].select(others, values);
        }
        values
    }
}

/// Samples at sixteen places of a lattice, of which `padded` is the padded copy.
#[inline(always)]
pub(super) fn sample<S: Simd>(simd: S, padded: &Padded, places: &Places<S>, active: u64) -> V<S> {
    let Places { wholes: [x, y, z], shares: [fx, fy, fz], .. } = *places;
    let [nx, ny, _] = padded.counts;
    // The value before the whole part: its index in the padded copy is the whole part itself.
    let groups = Groups::new(simd, x + (y + z * ny as i32) * nx as i32, active);
    let [dx, dy, dz] = padded.steps;
    let zero = V::splat(simd, 0.0);
    let mut planes = [zero; 4];
    for (k, plane) in planes.iter_mut().enumerate() {
        let mut rows = [zero; 4];
        for (j, row) in rows.iter_mut().enumerate() {
            let mut values = [zero; 4];
            for (i, value) in values.iter_mut().enumerate() {
                *value = groups.load(simd, padded.data, i * dx + j * dy + k * dz);
            }
            *row = hermite(simd, values, fx);
        }
        *plane = hermite(simd, rows, fy);
    }
    hermite(simd, planes, fz)
}

/// Between the second and the third of four values, at `share` of the way; never beyond them.
#[inline(always)]
fn hermite<S: Simd>(simd: S, [before, low, high, after]: [V<S>; 4], share: V<S>) -> V<S> {
    let rise = high - low;
    let start = slope(simd, low - before, rise);
    let end = slope(simd, after - high, rise);
    let curve = start + end - rise * 2.0;
    let bend = rise * 3.0 - start * 2.0 - end;
    let value = low + ((curve * share + bend) * share + start) * share;
    // Rounding may still overshoot.
    let is_rising = rise.simd_gt(V::splat(simd, 0.0));
    let (least_value, most_value) = (is_rising.select(low, high), is_rising.select(high, low));
    let value = value.simd_lt(least_value).select(least_value, value);
    least(value, most_value)
}

/// The mean of two differences, at most three times either; zero at an extreme.
#[inline(always)]
fn slope<S: Simd>(simd: S, beside: V<S>, rise: V<S>) -> V<S> {
    let zero = V::splat(simd, 0.0);
    let mean = (beside + rise) * 0.5;
    let size = least(mean.abs(), least(beside.abs(), rise.abs()) * 3.0);
    let size = (beside * rise).simd_gt(zero).select(size, zero);
    rise.simd_gt(zero).select(size, zero - size)
}
