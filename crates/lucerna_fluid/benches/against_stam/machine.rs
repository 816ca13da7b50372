//! What the machine can do at most: memory's rate and arithmetic's, one thread each.

use std::hint::black_box;
use std::time::Instant;

use fearless_simd::{Level, Simd, SimdBase, SimdFloat, dispatch};

/// Accumulators: enough to hide the latency of an addition, few enough for the registers.
const CHAINS: usize = 14;

/// Rates of one core.
pub(crate) struct Machine {
    /// Multiply-adds fused, each counted as two, Gflop/s.
    pub(crate) fused: f64,
    /// Multiplications and additions apart, as the solver does them, Gflop/s.
    pub(crate) apart: f64,
}

impl Machine {
    pub(crate) fn measure(rounds: usize) -> Self {
        let rate = |is_fused: bool| {
            let best = shortest(5, || {
                let level = Level::new();
                black_box(dispatch!(level, simd => multiply_add(simd, is_fused, black_box(rounds))));
            });
            let lanes = dispatch!(Level::new(), simd => lanes_of(simd));
            2.0 * (CHAINS * lanes * rounds) as f64 / best * 1.0e-9
        };
        Self { fused: rate(true), apart: rate(false) }
    }
}

/// Rate of the triad `a = b + s c` (STREAM) over three arrays of `bytes` together,
/// GB/s: two values read and one written, what the cache reads before writing not counted.
pub(crate) fn triad(bytes: usize) -> f64 {
    let count = (bytes / 12).max(1024);
    let (mut a, b, c) = (vec![0.0_f32; count], vec![1.0_f32; count], vec![2.0_f32; count]);
    // Some 5 ms at least, so that the clock's grain does not count.
    let repeats = (20_000_000 / count).max(1);
    let best = shortest(7, || {
        for repeat in 0..repeats {
            let scale = black_box(repeat as f32);
            dispatch!(Level::new(), simd => triad_once(simd, &mut a, &b, &c, scale));
            black_box(&mut a);
        }
    });
    12.0 * (count * repeats) as f64 / best * 1.0e-9
}

#[inline(always)]
fn triad_once<S: Simd>(_: S, a: &mut [f32], b: &[f32], c: &[f32], scale: f32) {
    for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
        *a = b + scale * c;
    }
}

#[inline(always)]
fn multiply_add<S: Simd>(simd: S, is_fused: bool, rounds: usize) -> f32 {
    let factor = S::f32s::splat(simd, black_box(0.999));
    let more = S::f32s::splat(simd, black_box(0.001));
    let mut sums = [S::f32s::splat(simd, 1.0); CHAINS];
    if is_fused {
        for _ in 0..rounds {
            for sum in &mut sums {
                *sum = sum.mul_add(factor, more);
            }
        }
    } else {
        for _ in 0..rounds {
            for sum in &mut sums {
                *sum = *sum * factor + more;
            }
        }
    }
    sums.iter().map(|sum| sum.as_slice().iter().sum::<f32>()).sum()
}

#[inline(always)]
fn lanes_of<S: Simd>(_: S) -> usize {
    S::f32s::LEN
}

/// Shortest of some runs, s.
fn shortest(runs: usize, mut work: impl FnMut()) -> f64 {
    let mut best = f64::MAX;
    for _ in 0..runs {
        let start = Instant::now();
        work();
        best = best.min(start.elapsed().as_secs_f64());
    }
    best
}
