//! Vector instructions chosen when the program runs.
//!
//! Kernels name their vectors through [`Lanes`] and are compiled once for each level. Nothing is
//! contracted into fused multiply-adds and no sum is reordered, so that all levels give the same
//! bits.

use fearless_simd::{Level, Simd, SimdBase, SimdFloatElement, f32x4, f64x2};
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::{f32x8, f32x16};

/// Which vector instructions a plan uses. All give the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SimdLevel {
    /// The best that the machine has, such as AVX2 or AVX-512. Without the feature `std`, what was
    /// chosen when the program was compiled.
    #[default]
    Best,
    /// AVX2 where the machine has it, though it may have better; otherwise as [`Self::Baseline`].
    Avx2,
    /// What every machine of the target has: SSE2 on x86-64. For comparison.
    Baseline,
}

impl SimdLevel {
    pub(crate) fn level(self) -> Level {
        match self {
            #[cfg(feature = "std")]
            Self::Best => Level::new(),
            #[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
            Self::Avx2 => Level::new().as_avx2().map_or(Level::baseline(), Level::Avx2),
            _ => Level::baseline(),
        }
    }
}

/// A scalar whose vectors can be stored side by side.
pub trait Lanes: SimdFloatElement {
    /// Turns eight vectors into rows of eight, one row for each lane.
    fn store_rows<S: Simd>(simd: S, columns: [Self::Native<S>; 8], rows: &mut [[Self; 8]]);
}

impl Lanes for f32 {
    #[inline(always)]
    fn store_rows<S: Simd>(simd: S, columns: [S::f32s; 8], rows: &mut [[f32; 8]]) {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        match simd.level() {
            Level::Avx2(avx2) => {
                let mut registers = [f32x8::splat(avx2, 0.0); 8];
                for c in 0..8 {
                    registers[c] = f32x8::from_slice(avx2, columns[c].as_slice());
                }
                return x86::store_rows_avx2(avx2, registers, rows);
            }
            Level::Avx512(avx512) => {
                let mut registers = [f32x16::splat(avx512, 0.0); 8];
                for c in 0..8 {
                    registers[c] = f32x16::from_slice(avx512, columns[c].as_slice());
                }
                return x86::store_rows_avx512(avx512, registers, rows);
            }
            _ => {}
        }
        let (quads, _) = rows.as_chunks_mut::<4>();
        for (k, quad) in quads.iter_mut().enumerate().take(S::f32s::LEN / 4) {
            for half in 0..2 {
                let part = |c: usize| f32x4::from_slice(simd, &columns[4 * half + c].as_slice()[4 * k..4 * k + 4]);
                let (xz, yw) = (part(0).interleave(part(2)), part(1).interleave(part(3)));
                let (low, high) = (xz.0.interleave(yw.0), xz.1.interleave(yw.1));
                let to = 4 * half..4 * half + 4;
                low.0.store_slice(&mut quad[0][to.clone()]);
                low.1.store_slice(&mut quad[1][to.clone()]);
                high.0.store_slice(&mut quad[2][to.clone()]);
                high.1.store_slice(&mut quad[3][to]);
            }
        }
    }
}

impl Lanes for f64 {
    #[inline(always)]
    fn store_rows<S: Simd>(simd: S, columns: [S::f64s; 8], rows: &mut [[f64; 8]]) {
        let (pairs, _) = rows.as_chunks_mut::<2>();
        for (k, pair) in pairs.iter_mut().enumerate().take(S::f64s::LEN / 2) {
            for c in [0, 2, 4, 6] {
                let part = |c: usize| f64x2::from_slice(simd, &columns[c].as_slice()[2 * k..2 * k + 2]);
                let (low, high) = part(c).interleave(part(c + 1));
                low.store_slice(&mut pair[0][c..c + 2]);
                high.store_slice(&mut pair[1][c..c + 2]);
            }
        }
    }
}

/// Eight columns to rows within quarters of a register, which is what these instructions are good at.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod x86 {
    #[cfg(target_arch = "x86")]
    use core::arch::x86::*;
    #[cfg(target_arch = "x86_64")]
    use core::arch::x86_64::*;
    use fearless_simd::x86::{Avx2, Avx512};
    use fearless_simd::{SimdBase, SimdInto, SimdSplit, f32x8, f32x16, kernel};

    kernel!(
        #[inline(always)]
        pub(super) fn store_rows_avx2(avx2: Avx2, columns: [f32x8<Avx2>; 8], rows: &mut [[f32; 8]]) {
            let mut halves = [[_mm256_setzero_ps(); 4]; 2];
            for half in 0..2 {
                let a: __m256 = columns[4 * half].into();
                let b: __m256 = columns[4 * half + 1].into();
                let c: __m256 = columns[4 * half + 2].into();
                let d: __m256 = columns[4 * half + 3].into();
                let (ac, bd) = (_mm256_unpacklo_ps(a, c), _mm256_unpacklo_ps(b, d));
                let (ac_high, bd_high) = (_mm256_unpackhi_ps(a, c), _mm256_unpackhi_ps(b, d));
                halves[half][0] = _mm256_unpacklo_ps(ac, bd);
                halves[half][1] = _mm256_unpackhi_ps(ac, bd);
                halves[half][2] = _mm256_unpacklo_ps(ac_high, bd_high);
                halves[half][3] = _mm256_unpackhi_ps(ac_high, bd_high);
            }
            let rows = &mut rows[..8];
            for k in 0..4 {
                let low = _mm256_permute2f128_ps::<0x20>(halves[0][k], halves[1][k]);
                let high = _mm256_permute2f128_ps::<0x31>(halves[0][k], halves[1][k]);
                let (low, high): (f32x8<_>, f32x8<_>) = (low.simd_into(avx2), high.simd_into(avx2));
                low.store_slice(&mut rows[k]);
                high.store_slice(&mut rows[k + 4]);
            }
        }
    );

    kernel!(
        #[inline(always)]
        pub(super) fn store_rows_avx512(avx512: Avx512, columns: [f32x16<Avx512>; 8], rows: &mut [[f32; 8]]) {
            let mut halves = [[_mm512_setzero_ps(); 4]; 2];
            for half in 0..2 {
                let a: __m512 = columns[4 * half].into();
                let b: __m512 = columns[4 * half + 1].into();
                let c: __m512 = columns[4 * half + 2].into();
                let d: __m512 = columns[4 * half + 3].into();
                let (ac, bd) = (_mm512_unpacklo_ps(a, c), _mm512_unpacklo_ps(b, d));
                let (ac_high, bd_high) = (_mm512_unpackhi_ps(a, c), _mm512_unpackhi_ps(b, d));
                halves[half][0] = _mm512_unpacklo_ps(ac, bd);
                halves[half][1] = _mm512_unpackhi_ps(ac, bd);
                halves[half][2] = _mm512_unpacklo_ps(ac_high, bd_high);
                halves[half][3] = _mm512_unpackhi_ps(ac_high, bd_high);
            }
            let rows = &mut rows[..16];
            let low = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
            let high = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
            for k in 0..4 {
                let (a, b) = (_mm512_castps_pd(halves[0][k]), _mm512_castps_pd(halves[1][k]));
                let low = _mm512_castpd_ps(_mm512_permutex2var_pd(a, low, b));
                let high = _mm512_castpd_ps(_mm512_permutex2var_pd(a, high, b));
                let (low, high): (f32x16<_>, f32x16<_>) = (low.simd_into(avx512), high.simd_into(avx512));
                let ((first, second), (third, fourth)) = (low.split(), high.split());
                first.store_slice(&mut rows[k]);
                second.store_slice(&mut rows[k + 4]);
                third.store_slice(&mut rows[k + 8]);
                fourth.store_slice(&mut rows[k + 12]);
            }
        }
    );
}
