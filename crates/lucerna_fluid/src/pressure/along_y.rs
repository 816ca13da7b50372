//! The tridiagonal systems along y, one for each pair of modes along x and z.
//!
//! Where y is periodic, a line is folded about its middle: the sums of cells and their mirror
//! images meet their own mirror images at both ends (Neumann), the differences meet their
//! negatives (Dirichlet), so that two open tridiagonal systems of half the length take the place
//! of a cyclic one.

use super::basis::{Basis, Ends};
use super::lines::{LANES, Lanes};

/// Planes of modes solved together, so that one need not wait for the other's sums.
const PLANES: usize = 4;

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
    pub(crate) fn solve(&self, block: usize, modes: &mut [Lanes]) {
        let is_free = self.is_singular && block == 0;
        if is_free {
            self.center(&mut modes[..self.count]);
        }
        if self.is_folded {
            modes.chunks_exact_mut(self.stride).for_each(|plane| fold(&mut plane[..self.count], 0.5));
        }
        let size = self.count * (modes.len() / self.stride);
        let mut tables = &self.reciprocals[block * size..(block + 1) * size];
        let mut planes = modes.chunks_exact_mut(PLANES * self.stride);
        for planes in &mut planes {
            let (table, rest) = tables.split_at(PLANES * self.count);
            tables = rest;
            self.sweep::<PLANES>(planes, table);
        }
        for plane in planes.into_remainder().chunks_exact_mut(self.stride) {
            let (table, rest) = tables.split_at(self.count);
            tables = rest;
            self.sweep::<1>(plane, table);
        }
        if self.is_folded {
            modes.chunks_exact_mut(self.stride).for_each(|plane| fold(&mut plane[..self.count], 1.0));
        }
        if is_free {
            self.center(&mut modes[..self.count]);
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
    fn sweep<const P: usize>(&self, modes: &mut [Lanes], reciprocals: &[Lanes]) {
        let (n, stride) = (self.count, self.stride);
        let mut last = [Lanes::ZERO; P];
        for j in 0..n {
            let lower = self.lower[j];
            for (p, last) in last.iter_mut().enumerate() {
                let (value, reciprocal) = (&mut modes[p * stride + j], &reciprocals[p * n + j]);
                for lane in 0..LANES {
                    let factor = lower * reciprocal.0[lane];
                    last.0[lane] = factor * last.0[lane] - value.0[lane] * reciprocal.0[lane];
                }
                *value = *last;
            }
        }
        for j in (0..n - 1).rev() {
            let upper = self.upper[j];
            for (p, last) in last.iter_mut().enumerate() {
                let (value, reciprocal) = (&mut modes[p * stride + j], &reciprocals[p * n + j]);
                for lane in 0..LANES {
                    let factor = upper * reciprocal.0[lane];
                    last.0[lane] = value.0[lane] + factor * last.0[lane];
                }
                *value = *last;
            }
        }
    }
}

/// Replaces a line by `scale` times the sums with its mirror image, in the first half, and the
/// differences, in the second; done again with another scale, it undoes that.
#[inline(always)]
fn fold(line: &mut [Lanes], scale: f32) {
    let n = line.len();
    let (low, high) = line.split_at_mut(n.div_ceil(2));
    for (a, b) in low.iter_mut().zip(high.iter_mut().rev()) {
        let (sum, difference) = (a.plus(*b), a.minus(*b));
        for lane in 0..LANES {
            a.0[lane] = scale * sum.0[lane];
            b.0[lane] = scale * difference.0[lane];
        }
    }
}
