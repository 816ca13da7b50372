//! A scalar on a lattice: cell centres, or the faces across one axis.

use crate::grid::Grid;

/// Values with their lattice; x fastest, then y, then z.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub(crate) data: Vec<f32>,
    pub(crate) counts: [usize; 3],
    /// Where value (0,0,0) lies, in cells from the low corner of the box.
    pub(crate) offset: [f32; 3],
}

impl Field {
    /// Zeros at the centres of the cells.
    pub(crate) fn at_centres(grid: &Grid) -> Self {
        Self { data: vec![0.0; grid.count()], counts: grid.cells, offset: [0.5; 3] }
    }

    /// Zeros on the faces across `axis`.
    pub(crate) fn on_faces(grid: &Grid, axis: usize) -> Self {
        let counts = grid.face_counts(axis);
        let mut offset = [0.5; 3];
        offset[axis] = 0.0;
        Self { data: vec![0.0; counts.iter().product()], counts, offset }
    }

    /// Values in a z-plane.
    pub(crate) fn plane(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// Trilinear sample at a place in cells from the low corner; clamped to the lattice.
    #[inline]
    pub(crate) fn sample(&self, at: [f32; 3]) -> f32 {
        let at = [0, 1, 2].map(|axis| [at[axis] - self.offset[axis]; 1]);
        self.sample_lanes(at)[0]
    }

    /// As [`Field::sample`] in a grid whose periodic axes go round.
    pub(crate) fn sample_in(&self, grid: &Grid, at: [f32; 3]) -> f32 {
        let periods = grid.periods();
        if periods == [0; 3] {
            return self.sample(at);
        }
        let [nx, ny, _] = self.counts;
        let at = [0, 1, 2].map(|axis| at[axis] - self.offset[axis]);
        Around::new(at, self.counts, periods).blend(|[i, j, k]| self.data[i + nx * (j + ny * k)])
    }

    /// Trilinear samples at `L` places in lattice coordinates (by axis, then lane); clamped to
    /// the lattice, and what is not a number counts as zero. Lanes keep the arithmetic in
    /// vector registers; only the loads are one by one.
    #[inline(always)]
    pub(crate) fn sample_lanes<const L: usize>(&self, at: [[f32; L]; 3]) -> [f32; L] {
        let [nx, ny, nz] = self.counts;
        let plane = nx * ny;
        let (whole_x, fx) = split(at[0], nx);
        let (whole_y, fy) = split(at[1], ny);
        let (whole_z, fz) = split(at[2], nz);
        let mut corners = [[0.0_f32; L]; 8];
        // Along an axis with a single value there is no next one.
        let [dx, dy, dz] = [(nx, 1), (ny, nx), (nz, plane)].map(|(count, step)| if count > 1 { step } else { 0 });
        for lane in 0..L {
            let base = whole_x[lane] as usize + nx * whole_y[lane] as usize + plane * whole_z[lane] as usize;
            let low = &self.data[base..base + dy + dx + 1];
            let high = &self.data[base + dz..base + dz + dy + dx + 1];
            corners[0][lane] = low[0];
            corners[1][lane] = low[dx];
            corners[2][lane] = low[dy];
            corners[3][lane] = low[dy + dx];
            corners[4][lane] = high[0];
            corners[5][lane] = high[dx];
            corners[6][lane] = high[dy];
            corners[7][lane] = high[dy + dx];
        }
        let [a, b, c, d, e, f, g, h] = corners;
        let low = mix(mix(a, b, fx), mix(c, d, fx), fy);
        let high = mix(mix(e, f, fx), mix(g, h, fx), fy);
        mix(low, high, fz)
    }
}

/// The eight values of a lattice around a place, and the place's shares in them.
pub(crate) struct Around {
    /// Low and high index, by axis.
    ends: [[usize; 2]; 3],
    share: [f32; 3],
}

impl Around {
    /// Around a place counted from the first value. Clamped to the lattice; along an axis with a
    /// period (in values, 0 for none) it goes round. What is not a number counts as zero.
    pub(crate) fn new(at: [f32; 3], counts: [usize; 3], periods: [usize; 3]) -> Self {
        let (mut ends, mut share) = ([[0; 2]; 3], [0.0; 3]);
        for axis in 0..3 {
            let (count, period) = (counts[axis], periods[axis]);
            let last = if period > 0 { period } else { count - 1 };
            let place = if period > 0 { at[axis].rem_euclid(period as f32) } else { at[axis] };
            let place = place.max(0.0).min(last as f32);
            let low = (place as usize).min(if period > 0 { period - 1 } else { count.saturating_sub(2) });
            let high = if low + 1 < count { low + 1 } else { 0 };
            (ends[axis], share[axis]) = ([low, high], place - low as f32);
        }
        Self { ends, share }
    }

    /// Trilinear between the values of the eight.
    #[inline(always)]
    pub(crate) fn blend<T>(&self, value: impl Fn([usize; 3]) -> T) -> T
    where
        T: Copy + std::ops::Add<Output = T> + std::ops::Sub<Output = T> + std::ops::Mul<f32, Output = T>,
    {
        let corner = |i: usize, j: usize, k: usize| value([self.ends[0][i], self.ends[1][j], self.ends[2][k]]);
        let mix = |a: T, b: T, share: f32| a + (b - a) * share;
        let row = |j: usize, k: usize| mix(corner(0, j, k), corner(1, j, k), self.share[0]);
        let plane = |k: usize| mix(row(0, k), row(1, k), self.share[1]);
        mix(plane(0), plane(1), self.share[2])
    }
}

/// Adding it to a number below 2^22 leaves the nearest whole number in the low bits.
const TO_WHOLE: f32 = 12_582_912.0;

/// Whole and fractional part of lattice coordinates, clamped so that the next value exists.
#[inline(always)]
fn split<const L: usize>(at: [f32; L], count: usize) -> ([u32; L], [f32; L]) {
    let (last, last_whole) = ((count - 1) as f32, count.saturating_sub(2) as f32);
    let (mut wholes, mut fractions) = ([0_u32; L], [0.0_f32; L]);
    for lane in 0..L {
        let at = if at[lane] > 0.0 { at[lane] } else { 0.0 };
        let at = if at < last { at } else { last };
        let nearest = (at + TO_WHOLE) - TO_WHOLE;
        let whole = if nearest > at { nearest - 1.0 } else { nearest };
        let whole = if whole < last_whole { whole } else { last_whole };
        wholes[lane] = (whole + TO_WHOLE).to_bits() & 0x003f_ffff;
        fractions[lane] = at - whole;
    }
    (wholes, fractions)
}

/// Linear interpolation, exact where both values are the same.
#[inline(always)]
fn mix<const L: usize>(a: [f32; L], b: [f32; L], share: [f32; L]) -> [f32; L] {
    let mut out = [0.0; L];
    for lane in 0..L {
        out[lane] = a[lane] + share[lane] * (b[lane] - a[lane]);
    }
    out
}
