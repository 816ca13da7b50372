//! Vector instructions chosen when the program runs.
//!
//! Kernels are written as plain loops over rows or over small arrays of lanes. [`Simd::run`]
//! compiles its closure once for each level and picks the copy that this machine can execute;
//! the compiler turns the loops into that level's vector instructions. Nothing is contracted
//! into fused multiply-adds and no sum is reordered, so that every level gives the same bits.

use fearless_simd::{Level, Simd as _};

/// Which vector instructions to use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simd(Option<Level>);

impl Simd {
    /// The best that this machine has.
    pub(crate) fn best() -> Self {
        Self(Some(Level::new()))
    }

    /// What every machine of the target has: SSE2 on x86-64.
    #[allow(dead_code, reason = "what every level is to be compared with")]
    pub(crate) fn baseline() -> Self {
        Self(None)
    }

    /// Runs `work` compiled for this level. Pass a closure marked `#[inline(always)]`, and mark
    /// the functions that it calls likewise: what is not inlined runs at the baseline.
    #[inline(always)]
    pub(crate) fn run<R>(self, work: impl FnOnce() -> R) -> R {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(level) = self.0 {
            if let Some(avx512) = level.as_avx512() {
                return avx512.vectorize(work);
            }
            if let Some(avx2) = level.as_avx2() {
                return avx2.vectorize(work);
            }
        }
        work()
    }
}
