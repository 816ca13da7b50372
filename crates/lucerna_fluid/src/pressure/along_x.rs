//! The transform along x: from rows of cells to blocks of sixteen modes, and back.

#![allow(clippy::needless_range_loop, reason = "small arrays of vectors are to be unrolled")]

use std::ops::Range;

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::basis::Basis;
use super::lines::{LANES, Lanes, V, accumulate_rows, is_wide};
use crate::limits::MAX_AXIS_CELLS;

/// Rows transformed together, by whether registers hold sixteen numbers.
const ROWS: [usize; 2] = [4, 8];

/// Values from one folded row to the next.
const FOLDED: usize = MAX_AXIS_CELLS + LANES;

/// Rows being folded, values of all.
pub(crate) const FOLDED_ROWS: usize = ROWS[1] * FOLDED;

/// Tables of the transform along x.
pub(crate) struct AlongX {
    count: usize,
    /// Whether rows are folded on the way to the modes.
    is_folded: bool,
    /// Whether rows are unfolded on the way back.
    is_unfolded: bool,
    evens: usize,
    blocks: Vec<Block>,
    /// First cell of each run of sixteen on the way back, and its table by mode.
    outputs: Vec<(usize, Vec<Lanes>)>,
}

/// Sixteen modes.
struct Block {
    /// Which values of a (folded) row they are made of.
    inputs: Range<usize>,
    /// By input.
    table: Vec<Lanes>,
}

impl AlongX {
    pub(crate) fn new(basis: &Basis) -> Self {
        let count = basis.count;
        let [evens, odds] = basis.parts();
        // Without a block that is all even or all odd, folding saves nothing.
        let is_folded = basis.is_symmetric() && evens.len() >= LANES;
        let block = |first: usize| {
            let modes = first..(first + LANES).min(count);
            let inputs = match is_folded {
                true if modes.end <= evens.end => evens.clone(),
                true if modes.start >= odds.start => odds.clone(),
                _ => 0..count,
            };
            let table = inputs.clone().map(|input| {
                let is_difference = is_folded && input >= evens.end;
                let cell = if is_difference { input - evens.end } else { input };
                let value = |mode: usize| {
                    let belongs = !is_folded || (mode >= evens.end) == is_difference;
                    if modes.contains(&mode) && belongs { basis.value(mode, cell) } else { 0.0 }
                };
                Lanes(std::array::from_fn(|lane| value(first + lane)))
            });
            Block { table: table.collect(), inputs }
        };
        let blocks = (0..count).step_by(LANES).map(block).collect();
        let is_unfolded = basis.is_symmetric() && evens.len().div_ceil(LANES) < count.div_ceil(LANES);
        let reach = if is_unfolded { evens.len() } else { count };
        let output = |first: usize| {
            let first = first.min(reach.saturating_sub(LANES));
            let value = |mode: usize, cell: usize| if cell < count { basis.value(mode, cell) } else { 0.0 };
            let row = |mode: usize| Lanes(std::array::from_fn(|lane| value(mode, first + lane)));
            (first, (0..count).map(row).collect())
        };
        let outputs = (0..reach).step_by(LANES).map(output).collect();
        Self { count, is_folded, is_unfolded, evens: evens.end, blocks, outputs }
    }

    /// Fills `out` with the modes of block number `block` of each row of `rows`.
    #[inline(always)]
    pub(crate) fn forward<S: Simd>(&self, simd: S, block: usize, rows: &[f32], out: &mut [Lanes], folded: &mut [f32]) {
        let (n, count) = (self.count, out.len());
        let group = ROWS[usize::from(is_wide::<S>())];
        let mut row = 0;
        while row < count {
            if count < group {
                self.forward_rows::<S, 1>(simd, block, &rows[row * n..], &mut out[row..], folded);
                row += 1;
                continue;
            }
            // The last group reaches back over rows that are already done.
            let first = row.min(count - group);
            let (rows, out) = (&rows[first * n..], &mut out[first..]);
            if is_wide::<S>() {
                self.forward_rows::<S, { ROWS[1] }>(simd, block, rows, out, folded);
            } else {
                self.forward_rows::<S, { ROWS[0] }>(simd, block, rows, out, folded);
            }
            row = first + group;
        }
    }

    #[inline(always)]
    fn forward_rows<S: Simd, const R: usize>(
        &self,
        simd: S,
        block: usize,
        rows: &[f32],
        out: &mut [Lanes],
        folded: &mut [f32],
    ) {
        let n = self.count;
        let Block { inputs, table } = &self.blocks[block];
        let mut sums = [V::splat(simd, 0.0); R];
        if self.is_folded {
            for r in 0..R {
                self.fold(simd, &rows[r * n..(r + 1) * n], inputs, &mut folded[r * FOLDED..(r + 1) * FOLDED]);
            }
            accumulate_rows(simd, &mut sums, folded, FOLDED, table);
        } else {
            accumulate_rows(simd, &mut sums, rows, n, table);
        }
        for r in 0..R {
            out[r].store(sums[r]);
        }
    }

    /// Sums and differences of the cells of a row and their mirror images; those in `inputs`.
    #[inline(always)]
    fn fold<S: Simd>(&self, simd: S, row: &[f32], inputs: &Range<usize>, out: &mut [f32]) {
        let n = self.count;
        let has_sums = inputs.start == 0;
        let has_differences = inputs.end == n;
        let differences = if has_sums { self.evens } else { 0 };
        // What is beyond the half is overwritten, or not read.
        let mut first = 0;
        while first < n / 2 {
            let low = V::from_slice(simd, &row[first..first + LANES]);
            let high = V::from_slice(simd, &row[n - LANES - first..n - first]).reverse();
            if has_sums {
                (low + high).store_slice(&mut out[first..first + LANES]);
            }
            first += LANES;
        }
        if has_sums && n % 2 == 1 {
            out[n / 2] = row[n / 2];
        }
        first = 0;
        while has_differences && first < n / 2 {
            let low = V::from_slice(simd, &row[first..first + LANES]);
            let high = V::from_slice(simd, &row[n - LANES - first..n - first]).reverse();
            let at = differences + first;
            (low - high).store_slice(&mut out[at..at + LANES]);
            first += LANES;
        }
    }

    /// Fills the rows of `out` from their modes: in `modes`, block after block `stride` apart,
    /// one value a row.
    #[inline(always)]
    pub(crate) fn backward<S: Simd>(&self, simd: S, modes: &[Lanes], stride: usize, out: &mut [f32]) {
        let (n, count) = (self.count, out.len() / self.count);
        let group = ROWS[usize::from(is_wide::<S>())];
        let mut row = 0;
        while row < count {
            if count < group {
                self.backward_rows::<S, 1>(simd, &modes[row..], stride, &mut out[row * n..]);
                row += 1;
                continue;
            }
            let first = row.min(count - group);
            let (modes, out) = (&modes[first..], &mut out[first * n..]);
            if is_wide::<S>() {
                self.backward_rows::<S, { ROWS[1] }>(simd, modes, stride, out);
            } else {
                self.backward_rows::<S, { ROWS[0] }>(simd, modes, stride, out);
            }
            row = first + group;
        }
    }

    #[inline(always)]
    fn backward_rows<S: Simd, const R: usize>(&self, simd: S, modes: &[Lanes], stride: usize, out: &mut [f32]) {
        let n = self.count;
        for (first, table) in &self.outputs {
            let first = *first;
            if self.is_unfolded {
                let even = sum_modes::<S, R>(simd, modes, stride, table, 0..self.evens);
                let odd = sum_modes::<S, R>(simd, modes, stride, table, self.evens..n);
                for r in 0..R {
                    let row = &mut out[r * n..(r + 1) * n];
                    (even[r] + odd[r]).store_slice(&mut row[first..first + LANES]);
                    (even[r] - odd[r]).reverse().store_slice(&mut row[n - LANES - first..n - first]);
                }
            } else {
                let sums = sum_modes::<S, R>(simd, modes, stride, table, 0..n);
                for r in 0..R {
                    let row = &mut out[r * n + first..];
                    if row.len() >= LANES {
                        // Of a row shorter than this, the next one overwrites what is too much.
                        sums[r].store_slice(&mut row[..LANES]);
                    } else {
                        let mut values = Lanes::ZERO;
                        values.store(sums[r]);
                        let length = row.len();
                        row.copy_from_slice(&values.0[..length]);
                    }
                }
            }
        }
    }
}

/// For `R` rows the sum over `range` of modes times their row of the table.
#[inline(always)]
fn sum_modes<S: Simd, const R: usize>(
    simd: S,
    modes: &[Lanes],
    stride: usize,
    table: &[Lanes],
    range: Range<usize>,
) -> [V<S>; R] {
    let mut sums = [V::splat(simd, 0.0); R];
    let mut mode = range.start;
    while mode < range.end {
        let block = mode / LANES;
        let end = range.end.min((block + 1) * LANES);
        let rows = &modes[block * stride..block * stride + R];
        let lane = mode % LANES;
        let table = &table[mode..end];
        for (step, values) in table.iter().enumerate() {
            let values = values.load(simd);
            for r in 0..R {
                sums[r] += values * V::splat(simd, rows[r].0[(lane + step) % LANES]);
            }
        }
        mode = end;
    }
    sums
}
