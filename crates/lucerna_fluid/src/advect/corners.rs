//! The eight values around each of sixteen places.
//!
//! What makes sampling slow is fetching them one by one. Where the flow is smooth, neighbours in
//! a row come from neighbours in a row: their corners are plain loads of sixteen. Where the ways
//! of a row differ by no more than a cell along each axis, as nearly everywhere else, the corners
//! are among three such loads along each axis, and every lane selects its own. What is left is
//! fetched in groups of lanes that share their shift.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask32x16};

use super::sample::{I, LANES, Lattice, Places, V, counted};

/// Values from `from` on, if that many there are.
#[inline(always)]
fn window(data: &[f32], from: i32, span: usize) -> Option<&[f32]> {
    // A negative number becomes one beyond any length.
    let from = from as usize;
    data.get(from..from.wrapping_add(span))
}

/// The eight corners of each place: x fastest, then y, then z. Only the `active` lanes count.
#[inline(always)]
pub(super) fn corners<S: Simd>(simd: S, lattice: &Lattice, places: &Places<S>, active: u64) -> [V<S>; 8] {
    let [x, y, z] = places.wholes;
    // What lanes that are all moved alike have in common.
    let along = [x - counted(simd), y, z];
    let mut low = [0_i32; 3];
    let mut is_next = [mask32x16::splat(simd, false); 3];
    let mut any_next = [0_u64; 3];
    let mut far = 0_u64;
    for axis in 0..3 {
        let first = along[axis].as_array()[0];
        let below = along[axis].simd_lt(I::splat(simd, first)).to_bitmask() & active;
        low[axis] = first - i32::from(below != 0);
        let more = along[axis] - low[axis];
        is_next[axis] = more.simd_eq(I::splat(simd, 1));
        any_next[axis] = is_next[axis].to_bitmask() & active;
        far |= !(is_next[axis] | more.simd_eq(I::splat(simd, 0))).to_bitmask();
    }
    let [nx, ny, _] = lattice.counts;
    let from = low[0] + (low[1] + low[2] * ny as i32) * nx as i32;
    if far & active == 0 {
        if any_next == [0; 3] {
            if let Some(corners) = corners_alike(simd, lattice, from) {
                return corners;
            }
        } else if lattice.steps[0] == 1
            && let Some(corners) = corners_near(simd, lattice, from, is_next, any_next.map(|lanes| lanes != 0))
        {
            return corners;
        }
    }
    corners_in_groups(simd, lattice, places, active)
}

/// Where all lanes are moved alike: `from` is the first corner of the first.
#[inline(always)]
fn corners_alike<S: Simd>(simd: S, lattice: &Lattice, from: i32) -> Option<[V<S>; 8]> {
    let [dx, dy, dz] = lattice.steps;
    let window = window(lattice.data, from, dz + dy + dx + LANES)?;
    let mut corners = [V::splat(simd, 0.0); 8];
    for (corner, shift) in [0, dy, dz, dz + dy].into_iter().enumerate() {
        let row = &window[shift..shift + dx + LANES];
        corners[2 * corner] = V::from_slice(simd, &row[..LANES]);
        corners[2 * corner + 1] = V::from_slice(simd, &row[dx..]);
    }
    Some(corners)
}

/// Where lanes are moved alike but for those that come from one cell further along an axis,
/// `is_next`; `has_next` where there are any.
#[inline(always)]
fn corners_near<S: Simd>(
    simd: S,
    lattice: &Lattice,
    from: i32,
    is_next: [mask32x16<S>; 3],
    has_next: [bool; 3],
) -> Option<[V<S>; 8]> {
    let [_, dy, dz] = lattice.steps;
    // What no lane selects may lie beyond the end.
    let ys = [0, dy, dy + if has_next[1] { dy } else { 0 }];
    let zs = [0, dz, dz + if has_next[2] { dz } else { 0 }];
    let length = ys[2] + 2 + LANES;
    let window = window(lattice.data, from, zs[2] + length)?;
    let planes = [&window[..length], &window[zs[1]..zs[1] + length], &window[zs[2]..zs[2] + length]];
    let zero = V::splat(simd, 0.0);
    let mut columns = [[zero; 4]; 3];
    for y in 0..3 {
        let mut rows: [&[f32]; 3] = [&[]; 3];
        for z in 0..3 {
            rows[z] = &planes[z][ys[y]..ys[y] + 2 + LANES];
        }
        for x in 0..3 {
            let mut values = [zero; 3];
            for z in 0..3 {
                values[z] = V::from_slice(simd, &rows[z][x..x + LANES]);
            }
            for z in 0..2 {
                let value = is_next[2].select(values[z + 1], values[z]);
                // The low corner of those that are not moved on, the high one of those that are.
                if y < 2 {
                    columns[x][2 * z] = if y == 0 { value } else { is_next[1].select(value, columns[x][2 * z]) };
                }
                if y > 0 {
                    columns[x][2 * z + 1] =
                        if y == 1 { value } else { is_next[1].select(value, columns[x][2 * z + 1]) };
                }
            }
        }
    }
    let mut corners = [zero; 8];
    for yz in 0..4 {
        for x in 0..2 {
            corners[2 * yz + x] = is_next[0].select(columns[x + 1][yz], columns[x][yz]);
        }
    }
    Some(corners)
}

/// Wherever the lanes come from.
#[inline(always)]
fn corners_in_groups<S: Simd>(simd: S, lattice: &Lattice, places: &Places<S>, active: u64) -> [V<S>; 8] {
    let [dx, dy, dz] = lattice.steps;
    let shifts = [0, dx, dy, dy + dx, dz, dz + dx, dz + dy, dz + dy + dx];
    let span = shifts[7] + LANES;
    let shift = places.base - counted(simd);
    let shift_of = *shift.as_array();
    let mut corners = [V::splat(simd, 0.0); 8];
    let mut pending = active;
    while pending != 0 {
        let lane = pending.trailing_zeros() as usize % LANES;
        let from = shift_of[lane];
        if let Some(window) = window(lattice.data, from, span) {
            let same = shift.simd_eq(I::splat(simd, from));
            for (corner, values) in corners.iter_mut().enumerate() {
                *values = same.select(V::from_slice(simd, &window[shifts[corner]..shifts[corner] + LANES]), *values);
            }
            pending &= !same.to_bitmask();
        } else {
            // At the very ends of the array.
            let base = (from + lane as i32) as usize;
            for (values, shift) in corners.iter_mut().zip(shifts) {
                values[lane] = lattice.data[base + shift];
            }
            pending &= !(1 << lane);
        }
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SimdLevel;
    use crate::advect::sample::places;
    use crate::simd::{self, Kernel};

    /// Corners of sixteen places; by corner, then lane.
    struct Fetch<'a> {
        lattice: Lattice<'a>,
        at: [[f32; LANES]; 3],
        active: u64,
    }

    impl Kernel for Fetch<'_> {
        type Output = [[f32; LANES]; 8];

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> Self::Output {
            let at = self.at.map(|at| V::simd_from(simd, at));
            let places = places::<S, false>(simd, &self.lattice, at);
            corners(simd, &self.lattice, &places, self.active).map(|corner| *corner.as_array())
        }
    }

    /// 0 to 1, without end.
    fn random() -> impl FnMut() -> f32 {
        let mut state = 1_u64;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1 << 24) as f32
        }
    }

    #[test]
    fn every_lane_finds_its_own_corners_wherever_its_air_comes_from() {
        let mut random = random();
        let mut checked = 0;
        for counts in [[33, 5, 4], [16, 16, 3], [15, 2, 9], [2, 3, 2], [1, 7, 6], [40, 1, 5], [70, 9, 1]] {
            let [nx, ny, nz] = counts;
            let data: Vec<f32> = (0..nx * ny * nz).map(|at| at as f32).collect();
            let lattice = Lattice::new(&data, counts, [0.0; 3]);
            // Cells that neighbours' ways differ by: not at all, within one, several.
            for spread in [0.0, 0.3, 1.0, 1.9, 8.0] {
                for (j, k) in (0..ny).flat_map(|j| (0..nz).map(move |k| (j, k))) {
                    for first in (0..nx).step_by(LANES) {
                        let way = [0; 3].map(|_| 6.0 * (random() - 0.5));
                        let here = |axis: usize, lane: usize| [first + lane, j, k][axis] as f32;
                        let at = [0, 1, 2].map(|axis| {
                            std::array::from_fn(|lane| here(axis, lane) + way[axis] + spread * (random() - 0.5))
                        });
                        let lanes = LANES.min(nx - first);
                        for level in [SimdLevel::Best, SimdLevel::Avx2, SimdLevel::Baseline] {
                            let fetch = Fetch { lattice, at, active: (1 << lanes) - 1 };
                            let found = simd::Simd::of(level).run_kernel(fetch);
                            for lane in 0..lanes {
                                let low = [0, 1, 2].map(|axis| {
                                    let last = counts[axis].saturating_sub(2);
                                    (at[axis][lane].clamp(0.0, (counts[axis] - 1) as f32) as usize).min(last)
                                });
                                for (corner, found) in found.iter().enumerate() {
                                    let next = |axis: usize| (low[axis] + (corner >> axis & 1)).min(counts[axis] - 1);
                                    let expected = next(0) + nx * (next(1) + ny * next(2));
                                    assert_eq!(found[lane], expected as f32, "{counts:?} {spread} {at:?} {lane}");
                                    checked += 1;
                                }
                            }
                        }
                    }
                }
            }
        }
        println!("{checked} corners");
    }
}
