//! The transform along z, on sixteen x modes at a time.

use super::basis::Basis;
use super::lines::{Lanes, accumulate};

/// Modes (or cells) computed together.
const ROWS: usize = 4;
/// Values of y taken together.
const COLUMNS: usize = 4;

/// Factors of [`ROWS`] modes or cells, by step.
type Factors = Vec<[f32; ROWS]>;

/// Tables of the transform along z.
pub(crate) struct AlongZ {
    count: usize,
    /// Number of even modes; all of them where lines cannot be folded.
    evens: usize,
    is_folded: bool,
    /// For each group of modes of the even part, then of the odd part: the first one, and the
    /// factors of each value of the folded line.
    forward: [Vec<(usize, Factors)>; 2],
    /// For each group of cells the first one, and the factors of the even and of the odd modes.
    backward: Vec<(usize, [Factors; 2])>,
}

impl AlongZ {
    pub(crate) fn new(basis: &Basis) -> Self {
        let count = basis.count;
        let is_folded = basis.is_symmetric();
        let parts = basis.parts();
        // Of the odd part the differences count from zero as cells do.
        let value = |mode: usize, cell: usize| {
            if mode < count && cell < count { basis.value(mode, cell) } else { 0.0 }
        };
        let forward = parts.clone().map(|part| {
            let group = |first: usize| {
                let value = |mode: usize, cell: usize| if mode < part.end { value(mode, cell) } else { 0.0 };
                let row = |cell: usize| std::array::from_fn(|r| value(first + r, cell));
                (first, (0..part.len()).map(row).collect())
            };
            part.clone().step_by(ROWS).map(group).collect()
        });
        let reach = if is_folded { basis.evens } else { count };
        let group = |first: usize| {
            let row = |mode: usize| std::array::from_fn(|r| value(mode, first + r));
            (first, parts.clone().map(|part| part.map(row).collect()))
        };
        let backward = (0..reach).step_by(ROWS).map(group).collect();
        Self { count, evens: basis.evens, is_folded, forward, backward }
    }

    /// Values that [`AlongZ::forward`] and [`AlongZ::backward`] need to work in.
    pub(crate) fn spare(count: usize) -> usize {
        COLUMNS * count
    }

    /// From cells to modes, in place: `[z][y]`, planes `stride` apart, `ny` values a plane.
    #[inline(always)]
    pub(crate) fn forward(&self, values: &mut [Lanes], stride: usize, ny: usize, spare: &mut [Lanes]) {
        if ny >= COLUMNS {
            (0..ny).step_by(COLUMNS).for_each(|y| self.forward_columns::<COLUMNS>(values, stride, ny, y, spare));
        } else {
            (0..ny).for_each(|y| self.forward_columns::<1>(values, stride, ny, y, spare));
        }
    }

    /// From modes to cells.
    #[inline(always)]
    pub(crate) fn backward(&self, values: &mut [Lanes], stride: usize, ny: usize, spare: &mut [Lanes]) {
        if ny >= COLUMNS {
            (0..ny).step_by(COLUMNS).for_each(|y| self.backward_columns::<COLUMNS>(values, stride, ny, y, spare));
        } else {
            (0..ny).for_each(|y| self.backward_columns::<1>(values, stride, ny, y, spare));
        }
    }

    #[inline(always)]
    fn forward_columns<const C: usize>(
        &self,
        values: &mut [Lanes],
        stride: usize,
        ny: usize,
        y: usize,
        spare: &mut [Lanes],
    ) {
        let n = self.count;
        // The last columns are taken more than once where there are not enough.
        let columns: [usize; C] = std::array::from_fn(|c| (y + c).min(ny - 1));
        let (spare, _) = spare.as_chunks_mut::<C>();
        let (sums, differences) = spare[..n].split_at_mut(self.evens);
        if self.is_folded {
            for (k, sums) in sums.iter_mut().enumerate() {
                for (sum, column) in sums.iter_mut().zip(columns) {
                    let (a, b) = (values[k * stride + column], values[(n - 1 - k) * stride + column]);
                    *sum = if 2 * k + 1 == n { a } else { a.plus(b) };
                }
            }
            for (k, differences) in differences.iter_mut().enumerate() {
                for (difference, column) in differences.iter_mut().zip(columns) {
                    *difference = values[k * stride + column].minus(values[(n - 1 - k) * stride + column]);
                }
            }
        } else {
            for (k, sums) in sums.iter_mut().enumerate() {
                *sums = columns.map(|column| values[k * stride + column]);
            }
        }
        for ((groups, inputs), end) in self.forward.iter().zip([&*sums, &*differences]).zip([self.evens, n]) {
            for (first, factors) in groups {
                let mut sums = [[Lanes::ZERO; C]; ROWS];
                accumulate(&mut sums, factors, inputs);
                for (mode, sums) in (*first..end).zip(sums) {
                    for (sum, column) in sums.into_iter().zip(columns) {
                        values[mode * stride + column] = sum;
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn backward_columns<const C: usize>(
        &self,
        values: &mut [Lanes],
        stride: usize,
        ny: usize,
        y: usize,
        spare: &mut [Lanes],
    ) {
        let n = self.count;
        let columns: [usize; C] = std::array::from_fn(|c| (y + c).min(ny - 1));
        let (spare, _) = spare.as_chunks_mut::<C>();
        for (mode, spare) in spare[..n].iter_mut().enumerate() {
            *spare = columns.map(|column| values[mode * stride + column]);
        }
        let (even_modes, odd_modes) = spare[..n].split_at(self.evens);
        for (first, [even_factors, odd_factors]) in &self.backward {
            let mut evens = [[Lanes::ZERO; C]; ROWS];
            accumulate(&mut evens, even_factors, even_modes);
            if self.is_folded {
                let mut odds = [[Lanes::ZERO; C]; ROWS];
                accumulate(&mut odds, odd_factors, odd_modes);
                for (cell, (evens, odds)) in (*first..self.evens).zip(evens.into_iter().zip(odds)) {
                    for ((even, odd), column) in evens.into_iter().zip(odds).zip(columns) {
                        values[cell * stride + column] = even.plus(odd);
                        values[(n - 1 - cell) * stride + column] = even.minus(odd);
                    }
                }
            } else {
                for (cell, evens) in (*first..n).zip(evens) {
                    for (even, column) in evens.into_iter().zip(columns) {
                        values[cell * stride + column] = even;
                    }
                }
            }
        }
    }
}
