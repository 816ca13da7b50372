//! The transform along z, on sixteen x modes at a time.

#![allow(clippy::needless_range_loop, reason = "small arrays of vectors are to be unrolled")]

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::basis::Basis;
use super::lines::{Lanes, V, accumulate, is_wide};

/// Modes (or cells) computed together.
const ROWS: usize = 4;
/// Values of y taken together, by whether registers hold sixteen numbers.
const COLUMNS: [usize; 2] = [1, 4];

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
        COLUMNS[1] * count
    }

    /// From cells to modes, in place: `[z][y]`, planes `stride` apart, `ny` values a plane.
    #[inline(always)]
    pub(crate) fn forward<S: Simd>(
        &self,
        simd: S,
        values: &mut [Lanes],
        stride: usize,
        ny: usize,
        spare: &mut [Lanes],
    ) {
        let mut y = 0;
        while y < ny {
            if is_wide::<S>() && ny >= COLUMNS[1] {
                self.forward_columns::<S, { COLUMNS[1] }>(simd, values, stride, [y, ny], spare);
                y += COLUMNS[1];
            } else {
                self.forward_columns::<S, { COLUMNS[0] }>(simd, values, stride, [y, ny], spare);
                y += COLUMNS[0];
            }
        }
    }

    /// From modes to cells.
    #[inline(always)]
    pub(crate) fn backward<S: Simd>(
        &self,
        simd: S,
        values: &mut [Lanes],
        stride: usize,
        ny: usize,
        spare: &mut [Lanes],
    ) {
        let mut y = 0;
        while y < ny {
            if is_wide::<S>() && ny >= COLUMNS[1] {
                self.backward_columns::<S, { COLUMNS[1] }>(simd, values, stride, [y, ny], spare);
                y += COLUMNS[1];
            } else {
                self.backward_columns::<S, { COLUMNS[0] }>(simd, values, stride, [y, ny], spare);
                y += COLUMNS[0];
            }
        }
    }

    #[inline(always)]
    fn forward_columns<S: Simd, const C: usize>(
        &self,
        simd: S,
        values: &mut [Lanes],
        stride: usize,
        [y, ny]: [usize; 2],
        spare: &mut [Lanes],
    ) {
        let n = self.count;
        let columns = columns::<C>(y, ny);
        let (spare, _) = spare.as_chunks_mut::<C>();
        let (sums, differences) = spare[..n].split_at_mut(self.evens);
        if self.is_folded {
            for k in 0..sums.len() {
                for c in 0..C {
                    let low = values[k * stride + columns[c]].load(simd);
                    let high = values[(n - 1 - k) * stride + columns[c]].load(simd);
                    if 2 * k + 1 == n {
                        sums[k][c].store(low);
                    } else {
                        sums[k][c].store(low + high);
                        differences[k][c].store(low - high);
                    }
                }
            }
        } else {
            for k in 0..n {
                for c in 0..C {
                    sums[k][c] = values[k * stride + columns[c]];
                }
            }
        }
        for part in 0..2 {
            let (inputs, end) = if part == 0 { (&*sums, self.evens) } else { (&*differences, n) };
            for (first, factors) in &self.forward[part] {
                let mut sums = [[V::splat(simd, 0.0); C]; ROWS];
                accumulate(simd, &mut sums, factors, inputs);
                for r in 0..ROWS {
                    if first + r < end {
                        for c in 0..C {
                            values[(first + r) * stride + columns[c]].store(sums[r][c]);
                        }
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn backward_columns<S: Simd, const C: usize>(
        &self,
        simd: S,
        values: &mut [Lanes],
        stride: usize,
        [y, ny]: [usize; 2],
        spare: &mut [Lanes],
    ) {
        let n = self.count;
        let columns = columns::<C>(y, ny);
        let (spare, _) = spare.as_chunks_mut::<C>();
        for k in 0..n {
            for c in 0..C {
                spare[k][c] = values[k * stride + columns[c]];
            }
        }
        let (even_modes, odd_modes) = spare[..n].split_at(self.evens);
        for (first, [even_factors, odd_factors]) in &self.backward {
            let mut evens = [[V::splat(simd, 0.0); C]; ROWS];
            accumulate(simd, &mut evens, even_factors, even_modes);
            if self.is_folded {
                let mut odds = [[V::splat(simd, 0.0); C]; ROWS];
                accumulate(simd, &mut odds, odd_factors, odd_modes);
                for r in 0..ROWS {
                    let k = first + r;
                    if k < self.evens {
                        for c in 0..C {
                            values[k * stride + columns[c]].store(evens[r][c] + odds[r][c]);
                            values[(n - 1 - k) * stride + columns[c]].store(evens[r][c] - odds[r][c]);
                        }
                    }
                }
            } else {
                for r in 0..ROWS {
                    if first + r < n {
                        for c in 0..C {
                            values[(first + r) * stride + columns[c]].store(evens[r][c]);
                        }
                    }
                }
            }
        }
    }
}

/// As many columns from `y` on; the last one is taken more than once where there are not enough.
#[inline(always)]
fn columns<const C: usize>(y: usize, ny: usize) -> [usize; C] {
    let mut columns = [0; C];
    for c in 0..C {
        columns[c] = (y + c).min(ny - 1);
    }
    columns
}
