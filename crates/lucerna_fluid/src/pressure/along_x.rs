//! The transform along x: from rows of cells to blocks of sixteen modes, and back.

use std::ops::Range;

use super::basis::Basis;
use super::lines::{LANES, Lanes, accumulate_rows};
use crate::limits::MAX_AXIS_CELLS;

/// Rows transformed together.
const ROWS: usize = 8;

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
    pub(crate) fn forward(&self, block: usize, rows: &[f32], out: &mut [Lanes]) {
        let count = rows.len() / self.count;
        let mut folded = [0.0; ROWS * MAX_AXIS_CELLS];
        let mut row = 0;
        while row < count {
            if count >= ROWS {
                // The last group reaches back over rows that are already done.
                let first = row.min(count - ROWS);
                self.forward_rows::<ROWS>(block, &rows[first * self.count..], &mut out[first..], &mut folded);
                row = first + ROWS;
            } else {
                self.forward_rows::<1>(block, &rows[row * self.count..], &mut out[row..], &mut folded);
                row += 1;
            }
        }
    }

    #[inline(always)]
    fn forward_rows<const R: usize>(&self, block: usize, rows: &[f32], out: &mut [Lanes], folded: &mut [f32]) {
        let n = self.count;
        let Block { inputs, table } = &self.blocks[block];
        let mut sums = [Lanes::ZERO; R];
        if self.is_folded {
            let width = table.len();
            for (r, out) in folded.chunks_exact_mut(width).take(R).enumerate() {
                self.fold(&rows[r * n..(r + 1) * n], inputs.clone(), out);
            }
            let folded = &*folded;
            accumulate_rows(&mut sums, std::array::from_fn(|r| &folded[r * width..(r + 1) * width]), table);
        } else {
            accumulate_rows(&mut sums, std::array::from_fn(|r| &rows[r * n..(r + 1) * n]), table);
        }
        out[..R].copy_from_slice(&sums);
    }

    /// Sums and differences of the cells of a row and their mirror images; those in `inputs`.
    #[inline(always)]
    fn fold(&self, row: &[f32], inputs: Range<usize>, out: &mut [f32]) {
        let n = self.count;
        let half = n / 2;
        let (low, high) = (&row[..half], &row[n - half..]);
        let out = if inputs.start == 0 {
            let (sums, out) = out.split_at_mut(self.evens);
            for ((sum, a), b) in sums.iter_mut().zip(low).zip(high.iter().rev()) {
                *sum = a + b;
            }
            if n % 2 == 1 {
                sums[half] = row[half];
            }
            out
        } else {
            out
        };
        for ((difference, a), b) in out.iter_mut().zip(low).zip(high.iter().rev()) {
            *difference = a - b;
        }
    }

    /// Fills the rows of `out` from their modes: in `modes`, block after block `stride` apart,
    /// one value a row.
    #[inline(always)]
    pub(crate) fn backward(&self, modes: &[Lanes], stride: usize, out: &mut [f32]) {
        let count = out.len() / self.count;
        let mut row = 0;
        while row < count {
            if count >= ROWS {
                let first = row.min(count - ROWS);
                self.backward_rows::<ROWS>(&modes[first..], stride, &mut out[first * self.count..]);
                row = first + ROWS;
            } else {
                self.backward_rows::<1>(&modes[row..], stride, &mut out[row * self.count..]);
                row += 1;
            }
        }
    }

    #[inline(always)]
    fn backward_rows<const R: usize>(&self, modes: &[Lanes], stride: usize, out: &mut [f32]) {
        let n = self.count;
        for (first, table) in &self.outputs {
            if self.is_unfolded {
                let even = sum_modes::<R>(modes, stride, table, 0..self.evens);
                let odd = sum_modes::<R>(modes, stride, table, self.evens..n);
                for (r, (even, odd)) in even.into_iter().zip(odd).enumerate() {
                    let row = &mut out[r * n..(r + 1) * n];
                    row[*first..first + LANES].copy_from_slice(&even.plus(odd).0);
                    row[n - LANES - first..n - first].copy_from_slice(&even.minus(odd).reversed().0);
                }
            } else {
                let sums = sum_modes::<R>(modes, stride, table, 0..n);
                for (r, sums) in sums.into_iter().enumerate() {
                    let row = &mut out[r * n + first..];
                    if let Some(row) = row.first_chunk_mut::<LANES>() {
                        // Of a row shorter than this, the next one overwrites what is too much.
                        *row = sums.0;
                    } else {
                        row.iter_mut().zip(sums.0).for_each(|(out, sum)| *out = sum);
                    }
                }
            }
        }
    }
}

/// For `R` rows the sum over `range` of modes times their row of the table.
#[inline(always)]
fn sum_modes<const R: usize>(modes: &[Lanes], stride: usize, table: &[Lanes], range: Range<usize>) -> [Lanes; R] {
    let mut sums = [Lanes::ZERO; R];
    let mut mode = range.start;
    while mode < range.end {
        let block = mode / LANES;
        let end = range.end.min((block + 1) * LANES);
        let rows = &modes[block * stride..block * stride + R];
        let rows: [&[f32]; R] = std::array::from_fn(|r| &rows[r].0[mode % LANES..]);
        accumulate_rows(&mut sums, rows, &table[mode..end]);
        mode = end;
    }
    sums
}
