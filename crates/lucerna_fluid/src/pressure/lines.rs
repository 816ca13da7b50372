//! Sixteen lines of the grid side by side, and dense products on them: what the direct solver
//! spends its time in.

/// Lines handled together: a register of AVX-512, two of AVX2. The bits do not depend on it.
pub(crate) const LANES: usize = 16;

/// One value of each of sixteen lines; a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Lanes(pub(crate) [f32; LANES]);

impl Lanes {
    pub(crate) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(crate) fn zip(self, other: Self, combine: impl Fn(f32, f32) -> f32) -> Self {
        let mut out = [0.0; LANES];
        for (lane, out) in out.iter_mut().enumerate() {
            *out = combine(self.0[lane], other.0[lane]);
        }
        Self(out)
    }

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    #[inline(always)]
    pub(crate) fn minus(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    /// Last lane first.
    #[inline(always)]
    pub(crate) fn reversed(self) -> Self {
        Self(std::array::from_fn(|lane| self.0[LANES - 1 - lane]))
    }
}

/// Adds to each of `R` by `V` sums the products of `factors[step][r]` and `values[step][v]`, over
/// all steps in order.
#[inline(always)]
pub(crate) fn accumulate<const R: usize, const V: usize>(
    sums: &mut [[Lanes; V]; R],
    factors: &[[f32; R]],
    values: &[[Lanes; V]],
) {
    for (factors, values) in factors.iter().zip(values) {
        for (sums, factor) in sums.iter_mut().zip(factors) {
            for (sum, value) in sums.iter_mut().zip(values) {
                for lane in 0..LANES {
                    sum.0[lane] += factor * value.0[lane];
                }
            }
        }
    }
}

/// As [`accumulate`] with the factors of each row contiguous; as many steps as `values` has.
#[inline(always)]
pub(crate) fn accumulate_rows<const R: usize>(sums: &mut [Lanes; R], rows: [&[f32]; R], values: &[Lanes]) {
    let rows = rows.map(|row| &row[..values.len()]);
    for (step, value) in values.iter().enumerate() {
        for (sum, row) in sums.iter_mut().zip(rows) {
            let factor = row[step];
            for lane in 0..LANES {
                sum.0[lane] += factor * value.0[lane];
            }
        }
    }
}
