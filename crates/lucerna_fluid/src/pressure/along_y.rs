//! The tridiagonal systems along y, one for each pair of modes along x and z.
//!
//! Where y is periodic, a line is folded about its middle: the sums of cells and their mirror
//! images meet their own mirror images at both ends (Neumann), the differences meet their
//! negatives (Dirichlet), so that two open tridiagonal systems of half the length take the place
//! of a cyclic one.

#![allow(clippy::needless_range_loop, reason = "small arrays of vectors are to be unrolled")]

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::basis::{Basis, Ends};
use super::lines::{LANES, Lanes, V, is_wide};

/// Planes of modes solved together, so that one need not wait for the other's sums; by whether
/// registers hold sixteen numbers.
const PLANES: [usize; 2] = [2, 4];

/// Tables of the systems along y.
pub(crate) struct AlongY {
    count: usize,
    /// Values from one plane of modes to the next: an odd number of cache lines, so that the
    /// planes do not fall into the same sets of the cache.
    pub(crate) stride: usize,
    is_folded: bool,
    /// Whether the constant mode is free, as in a sealed box.
    is_singular: bool,
    /// Minus the entries left and right of the diagonal, 1/m².
    lower: Vec<f32>,
    upper: Vec<f32>,
    /// Reciprocal pivots, m²: `[block of x modes][z mode][y]`.
    reciprocals: Vec<Lanes>,
}

impl AlongY {
    pub(crate) fn new(count: usize, cell_m: f32, ends: Ends, along_x: &Basis, along_z: &Basis) -> Self {
        let coupling = 1.0 / f64::from(cell_m).powi(2);
        let half = count.div_ceil(2);
        let (mut lower, mut upper) = (vec![coupling; count], vec![coupling; count]);
        (lower[0], upper[count - 1]) = (0.0, 0.0);
        let mut diagonal = vec![2.0 * coupling; count];
        match ends {
            Ends::Fixed(is_fixed) => {
                for (end, cell) in [0, count - 1].into_iter().enumerate() {
                    diagonal[cell] += if is_fixed[end] { -coupling } else { coupling };
                }
            }
            Ends::Periodic => {
                // Sums in cells 0 to half, differences in the others, from the middle outwards.
                diagonal[0] -= coupling;
                upper[half - 1] = 0.0;
                if count.is_multiple_of(2) {
                    diagonal[half - 1] -= coupling;
                    diagonal[half] += coupling;
                } else {
                    // The cell in the middle is its own image: both its neighbours are one.
                    lower[half - 1] *= 2.0;
                }
                if half < count {
                    lower[half] = 0.0;
                    diagonal[count - 1] += coupling;
                }
            }
        }
        let is_constant_free = along_x.eigenvalues[0] + along_z.eigenvalues[0] == 0.0;
        let is_singular = is_constant_free && !matches!(ends, Ends::Fixed([false, _] | [_, false]));
        let stride = count | 1;
        let blocks = along_x.count.div_ceil(LANES);
        let mut reciprocals = vec![Lanes::ZERO; blocks * along_z.count * count];
        for (plane, rows) in reciprocals.chunks_exact_mut(count).enumerate() {
            let (block, kz) = (plane / along_z.count, plane % along_z.count);
            for (lane, x_rate) in along_x.eigenvalues[block * LANES..].iter().take(LANES).enumerate() {
                let modes = x_rate + along_z.eigenvalues[kz];
                let mut previous = f64::INFINITY;
                for (j, row) in rows.iter_mut().enumerate() {
                    let above = if j > 0 { upper[j - 1] } else { 0.0 };
                    let pivot = modes + diagonal[j] - lower[j] * above / previous;
                    // The last pivot of the constant mode of a sealed box is zero: pin its pressure.
                    let is_zero = pivot <= 1e-9 * coupling;
                    row.0[lane] = if is_zero { 0.0 } else { (1.0 / pivot) as f32 };
                    previous = if is_zero { f64::INFINITY } else { pivot };
                }
            }
        }
        let narrow = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
        Self {
            count,
            stride,
            is_folded: ends == Ends::Periodic,
            is_singular,
            lower: narrow(lower),
            upper: narrow(upper),
            reciprocals,
        }
    }

    /// Solves the systems of a block of x modes in place: `[z mode][y]`, planes `stride` apart.
    #[inline(always)]
    pub(crate) fn solve<S: Simd>(&self, simd: S, block: usize, modes: &mut [Lanes]) {
        let (n, stride) = (self.count, self.stride);
        let planes = modes.len() / stride;
        let is_free = self.is_singular && block == 0;
        if is_free {
            self.center(&mut modes[..n]);
        }
        if self.is_folded {
            for plane in modes.chunks_exact_mut(stride) {
                fold(simd, &mut plane[..n], 0.5);
            }
        }
        let tables = &self.reciprocals[block * planes * n..(block + 1) * planes * n];
        let group = PLANES[usize::from(is_wide::<S>())];
        let mut plane = 0;
        while plane < planes {
            let (values, table) = (&mut modes[plane * stride..], &tables[plane * n..]);
            if planes - plane < group {
                self.sweep::<S, 1>(simd, values, table);
                plane += 1;
                continue;
            }
            if is_wide::<S>() {
                self.sweep::<S, { PLANES[1] }>(simd, values, table);
            } else {
                self.sweep::<S, { PLANES[0] }>(simd, values, table);
            }
            plane += group;
        }
        if self.is_folded {
            for plane in modes.chunks_exact_mut(stride) {
                fold(simd, &mut plane[..n], 1.0);
            }
        }
        if is_free {
            self.center(&mut modes[..n]);
        }
    }

    /// Takes the mean out of the constant mode: a sealed box has no answer to it.
    #[inline(always)]
    fn center(&self, column: &mut [Lanes]) {
        let mean = column.iter().map(|row| f64::from(row.0[0])).sum::<f64>() / self.count as f64;
        column.iter_mut().for_each(|row| row.0[0] -= mean as f32);
    }

    /// Thomas's algorithm on `P` planes at once, for the negated systems.
    #[inline(always)]
    fn sweep<S: Simd, const P: usize>(&self, simd: S, modes: &mut [Lanes], reciprocals: &[Lanes]) {
        let (n, stride) = (self.count, self.stride);
        let mut last = [V::splat(simd, 0.0); P];
        for j in 0..n {
            let lower = V::splat(simd, self.lower[j]);
            for p in 0..P {
                let value = &mut modes[p * stride + j];
                let reciprocal = reciprocals[p * n + j].load(simd);
                last[p] = (lower * reciprocal) * last[p] - value.load(simd) * reciprocal;
                value.store(last[p]);
            }
        }
        let mut j = n - 1;
        while j > 0 {
            j -= 1;
            let upper = V::splat(simd, self.upper[j]);
            for p in 0..P {
                let value = &mut modes[p * stride + j];
                let reciprocal = reciprocals[p * n + j].load(simd);
                last[p] = value.load(simd) + (upper * reciprocal) * last[p];
                value.store(last[p]);
            }
        }
    }
}

/// Replaces a line by `scale` times the sums with its mirror image, in the first half, and the
/// differences, in the second; done again with another scale, it undoes that.
#[inline(always)]
fn fold<S: Simd>(simd: S, line: &mut [Lanes], scale: f32) {
    let n = line.len();
    let scale = V::splat(simd, scale);
    for j in 0..n / 2 {
        let (low, high) = (line[j].load(simd), line[n - 1 - j].load(simd));
        line[j].store(scale * (low + high));
        line[n - 1 - j].store(scale * (low - high));
    }
}
