//! Sixteen lines of the grid side by side, and dense products on them: what the direct solver
//! spends its time in. Products are multiplied, then added, never fused: the bits are the same
//! on every level of vector instructions.

#![allow(clippy::needless_range_loop, reason = "small arrays of vectors are to be unrolled")]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};
use rayon::prelude::*;

use crate::parallel::Execution;
use crate::simd::Kernel;

/// Lines handled together: a register of AVX-512, two of AVX2. The bits do not depend on it.
pub(crate) const LANES: usize = 16;

/// Sixteen numbers.
pub(crate) type V<S> = f32x16<S>;

/// One value of each of sixteen lines; a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Lanes(pub(crate) [f32; LANES]);

impl Lanes {
    pub(crate) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S) -> V<S> {
        V::load_array_ref(simd, &self.0)
    }

    #[inline(always)]
    pub(crate) fn store<S: Simd>(&mut self, value: V<S>) {
        value.store_slice(&mut self.0);
    }
}

/// Whether a register holds sixteen numbers, so that more of them can be kept.
#[inline(always)]
pub(crate) fn is_wide<S: Simd>() -> bool {
    S::f32s::LEN >= LANES
}

/// Adds to each of `R` by `C` sums the products of `factors[step][r]` and the lines number
/// `step * C + c`, over all steps in order.
#[inline(always)]
pub(crate) fn accumulate<S: Simd, const R: usize, const C: usize>(
    simd: S,
    sums: &mut [[V<S>; C]; R],
    factors: &[[f32; R]],
    lines: &[[Lanes; C]],
) {
    for (factors, lines) in factors.iter().zip(lines) {
        let mut values = [V::splat(simd, 0.0); C];
        for c in 0..C {
            values[c] = lines[c].load(simd);
        }
        for r in 0..R {
            let factor = V::splat(simd, factors[r]);
            for c in 0..C {
                sums[r][c] += values[c] * factor;
            }
        }
    }
}

/// As [`accumulate`] with the factors of each row contiguous: those from `first` on of rows
/// `stride` apart, as many as the table has steps.
#[inline(always)]
pub(crate) fn accumulate_rows<S: Simd, const R: usize>(
    simd: S,
    sums: &mut [V<S>; R],
    rows: &[f32],
    stride: usize,
    table: &[Lanes],
) {
    let steps = table.len();
    let mut factors: [&[f32]; R] = [&[]; R];
    for r in 0..R {
        factors[r] = &rows[r * stride..r * stride + steps];
    }
    for step in 0..steps {
        let values = table[step].load(simd);
        for r in 0..R {
            sums[r] += values * V::splat(simd, factors[r][step]);
        }
    }
}

/// What [`run_chunks`] calls for each chunk of an array.
pub(crate) trait ChunkKernel<T>: Sync {
    /// Mark it `#[inline(always)]`, as all that it calls.
    fn run<S: Simd>(&self, simd: S, index: usize, out: &mut [T]);
}

/// One chunk.
struct One<'a, T, K> {
    kernel: &'a K,
    index: usize,
    out: &'a mut [T],
}

impl<T, K: ChunkKernel<T>> Kernel for One<'_, T, K> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        self.kernel.run(simd, self.index, self.out);
    }
}

/// Calls the kernel for each run of `size` values.
pub(crate) fn run_chunks<T: Send, K: ChunkKernel<T>>(exec: Execution, data: &mut [T], size: usize, kernel: &K) {
    // One closure for both, so that it is compiled once.
    let one = |(index, out): (usize, &mut [T])| exec.simd.run_kernel(One { kernel, index, out });
    if exec.is_parallel {
        data.par_chunks_mut(size).enumerate().for_each(one);
    } else {
        data.chunks_mut(size).enumerate().for_each(one);
    }
}
