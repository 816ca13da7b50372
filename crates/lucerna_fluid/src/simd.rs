//! Vector instructions chosen when the program runs.
//!
//! Kernels are written as plain loops over rows or over small arrays of lanes. [`Simd::run`]
//! compiles its closure once for each level and picks the copy that this machine can execute;
//! the compiler turns the loops into that level's vector instructions. Nothing is contracted
//! into fused multiply-adds and no sum is reordered, so that every level gives the same bits.

#[cfg(not(target_arch = "x86_64"))]
use fearless_simd::dispatch;
use fearless_simd::{Level, Simd as _};
use serde::{Deserialize, Serialize};

/// Which vector instructions a fluid uses. All give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SimdLevel {
    /// The best that the machine has, such as AVX2 or AVX-512.
    #[default]
    Best,
    /// AVX2 where the machine has it, though it may have better; otherwise as [`Self::Baseline`].
    Avx2,
    /// What every machine of the target has: SSE2 on x86-64. For comparison; two to four times
    /// slower.
    Baseline,
}

/// Which vector instructions to use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simd(Option<Level>);

/// Work that names its vectors: called with the token of the level that it is compiled for.
pub(crate) trait Kernel {
    type Output;

    /// Mark it `#[inline(always)]`, as all that it calls.
    fn run<S: fearless_simd::Simd>(self, simd: S) -> Self::Output;
}

impl Simd {
    /// The best that this machine has.
    pub(crate) fn best() -> Self {
        Self(Some(Level::new()))
    }

    /// What a caller chose.
    pub(crate) fn of(level: SimdLevel) -> Self {
        match level {
            SimdLevel::Best => Self::best(),
            SimdLevel::Avx2 => Self(Self::avx2()),
            SimdLevel::Baseline => Self(None),
        }
    }

    /// What a caller chose, again.
    pub(crate) fn level(self) -> SimdLevel {
        match self.0 {
            None => SimdLevel::Baseline,
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Some(Level::Avx2(_)) if Level::new().as_avx512().is_some() => SimdLevel::Avx2,
            Some(_) => SimdLevel::Best,
        }
    }

    fn avx2() -> Option<Level> {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        return Level::new().as_avx2().map(Level::Avx2);
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        None
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

    /// Runs a kernel compiled for this level.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    pub(crate) fn run_kernel<K: Kernel>(self, kernel: K) -> K::Output {
        // One copy less than by `dispatch`: what has no AVX2 runs at the baseline.
        let level = self.0.unwrap_or(Level::baseline());
        if let Some(avx512) = level.as_avx512() {
            return avx512.vectorize(
                #[inline(always)]
                || kernel.run(avx512),
            );
        }
        if let Some(avx2) = level.as_avx2() {
            return avx2.vectorize(
                #[inline(always)]
                || kernel.run(avx2),
            );
        }
        let Some(sse2) = level.as_sse2() else { unreachable!("x86-64 has SSE2") };
        kernel.run(sse2)
    }

    /// Runs a kernel compiled for this level.
    #[cfg(not(target_arch = "x86_64"))]
    #[inline(always)]
    pub(crate) fn run_kernel<K: Kernel>(self, kernel: K) -> K::Output {
        let level = self.0.unwrap_or(Level::baseline());
        dispatch!(level, simd => kernel.run(simd))
    }
}
