//! Reductions over many values.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16};

use crate::parallel::Partial;
use crate::simd::{self, Kernel};

const LANES: usize = 16;
/// Values whose sums are kept in `f32` before they go into an `f64`.
const SUMMED: usize = 2048;

/// The smaller of two, the same on every level; `b` where either is not a number.
#[inline(always)]
pub(crate) fn least<S: Simd>(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
    // One instruction where that is what it does.
    if cfg!(target_arch = "x86_64") { a.min(b) } else { a.simd_lt(b).select(a, b) }
}

/// The larger of two; `b` where either is not a number.
#[inline(always)]
pub(crate) fn most<S: Simd>(a: f32x16<S>, b: f32x16<S>) -> f32x16<S> {
    if cfg!(target_arch = "x86_64") { a.max(b) } else { a.simd_gt(b).select(a, b) }
}

/// Sums and extremes; what is not a number is no extreme.
pub(crate) fn scan(simd: simd::Simd, values: &[f32]) -> Partial {
    simd.run_kernel(Scanner(values))
}

struct Scanner<'a>(&'a [f32]);

impl Kernel for Scanner<'_> {
    type Output = Partial;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Partial {
        scan_with(simd, self.0)
    }
}

/// Sixteen sums and extremes.
struct Chain<S: Simd> {
    sum: f32x16<S>,
    squares: f32x16<S>,
    low: f32x16<S>,
    high: f32x16<S>,
}

impl<S: Simd> Chain<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = f32x16::splat(simd, 0.0);
        Self { sum: zero, squares: zero, low: zero, high: zero }
    }

    #[inline(always)]
    fn add(&mut self, value: f32x16<S>) {
        self.sum += value;
        self.squares += value * value;
        self.low = least(value, self.low);
        self.high = most(value, self.high);
    }
}

/// As [`scan`], on the level of the caller.
#[inline(always)]
pub(crate) fn scan_with<S: Simd>(simd: S, values: &[f32]) -> Partial {
    let mut all = Partial::default();
    for values in values.chunks(SUMMED) {
        let (mut even, mut odd) = (Chain::new(simd), Chain::new(simd));
        let (groups, rest) = values.as_chunks::<{ 2 * LANES }>();
        for group in groups {
            even.add(f32x16::from_slice(simd, &group[..LANES]));
            odd.add(f32x16::from_slice(simd, &group[LANES..]));
        }
        if !rest.is_empty() {
            let mut values = [0.0; 2 * LANES];
            values[..rest.len()].copy_from_slice(rest);
            even.add(f32x16::from_slice(simd, &values[..LANES]));
            odd.add(f32x16::from_slice(simd, &values[LANES..]));
        }
        all.sum += total(even.sum + odd.sum);
        all.squares += total(even.squares + odd.squares);
        all.low = all.low.min(extreme(least(odd.low, even.low), |a, b| a < b));
        all.high = all.high.max(extreme(most(odd.high, even.high), |a, b| a > b));
    }
    all
}

/// Sum of a few values, on the level of the caller.
#[inline(always)]
pub(crate) fn sum(row: &[f32]) -> f64 {
    let mut lanes = [0.0_f32; 8];
    let (chunks, rest) = row.as_chunks::<8>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane += value;
        }
    }
    let lanes: f64 = lanes.iter().map(|lane| f64::from(*lane)).sum();
    lanes + rest.iter().map(|value| f64::from(*value)).sum::<f64>()
}

/// The lane that goes before all others, found pair by pair.
#[inline(always)]
fn extreme<S: Simd>(lanes: f32x16<S>, goes_before: impl Fn(f32, f32) -> bool) -> f32 {
    let mut lanes = *lanes.as_array();
    for half in [8, 4, 2, 1] {
        for at in 0..half {
            let other = lanes[at + half];
            lanes[at] = if goes_before(other, lanes[at]) { other } else { lanes[at] };
        }
    }
    lanes[0]
}

/// Sum of the lanes, pair by pair.
#[inline(always)]
pub(crate) fn total<S: Simd>(lanes: f32x16<S>) -> f64 {
    let mut sums = [0.0_f64; LANES];
    for (sum, lane) in sums.iter_mut().zip(lanes.as_array()) {
        *sum = f64::from(*lane);
    }
    for half in [8, 4, 2, 1] {
        for at in 0..half {
            sums[at] += sums[at + half];
        }
    }
    sums[0]
}
