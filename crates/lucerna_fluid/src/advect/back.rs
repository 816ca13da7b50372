//! Semi-Lagrangian advection, and the correction that makes it `MacCormack`'s.

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::corners::corners;
use super::cubic;
use super::sample::{LANES, Lattice, V, active, blend, bounds, least, load, most, places, ramp, store};
use super::trace::Ways;
use crate::grid::Grid;
use crate::lanes::total;
use crate::parallel::{Partial, PlaneKernel};
use crate::sides::{Profile, Side};

/// Where values lie: on the faces across an axis, or at the centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Kind(pub(crate) Option<usize>);

impl Kind {
    pub(crate) const CENTRES: Self = Self(None);

    pub(crate) fn faces(axis: usize) -> Self {
        Self(Some(axis))
    }

    pub(crate) fn counts(self, grid: &Grid) -> [usize; 3] {
        self.0.map_or(grid.cells, |axis| grid.face_counts(axis))
    }
}

/// What comes in from outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outside<'a> {
    pub(crate) value: f32,
    /// What inflow sides were given instead.
    pub(crate) profile: Option<Profile<'a>>,
}

impl Outside<'_> {
    /// The outside's values for air that comes from beyond the lattice.
    #[inline(always)]
    fn values<S: Simd>(self, simd: S, from: [V<S>; 3]) -> V<S> {
        let Some(profile) = self.profile else { return V::splat(simd, self.value) };
        let from = from.map(|places| *places.as_array());
        let lanes: [f32; LANES] = std::array::from_fn(|lane| {
            profile.value([from[0][lane], from[1][lane], from[2][lane]]).unwrap_or(self.value)
        });
        V::simd_from(simd, lanes)
    }
}

/// Takes every value from where its air was.
#[derive(Clone, Copy)]
pub(super) struct Backward<'a, const WRAPS: bool> {
    pub(super) grid: &'a Grid,
    pub(super) ways: &'a Ways,
    pub(super) kind: Kind,
    pub(super) from: Lattice<'a>,
    /// Its second differences, to interpolate cubically.
    pub(super) bends: Option<[Lattice<'a>; 3]>,
    /// Of the values that are written.
    pub(super) counts: [usize; 3],
    pub(super) outside: Outside<'a>,
}

impl<const WRAPS: bool> Backward<'_, WRAPS> {
    /// Places of sixteen values.
    #[inline(always)]
    fn here<S: Simd>(&self, simd: S, [first, j, k]: [usize; 3]) -> [V<S>; 3] {
        [ramp(simd) + first as f32, V::splat(simd, j as f32), V::splat(simd, k as f32)]
    }

    /// Which sides let air in.
    fn inlets(&self) -> Inlets {
        let sides = self.grid.sides.map(|sides| sides.map(Side::lets_in));
        let any = sides.iter().flatten().any(|lets_in| *lets_in);
        Inlets { sides, last: self.counts.map(|count| (count - 1) as f32), any }
    }
}

/// The sides through which air comes in.
#[derive(Clone, Copy)]
struct Inlets {
    sides: [[bool; 2]; 3],
    last: [f32; 3],
    any: bool,
}

impl Inlets {
    /// How far beyond the sides that let air in each place lies, along each axis.
    #[inline(always)]
    fn beyond<S: Simd>(&self, simd: S, at: [V<S>; 3]) -> [V<S>; 3] {
        let zero = V::splat(simd, 0.0);
        let mut beyond = [zero; 3];
        for axis in 0..3 {
            let [low, high] = self.sides[axis];
            let below = if low { most(zero - at[axis], zero) } else { zero };
            let above = if high { most(at[axis] - self.last[axis], zero) } else { zero };
            beyond[axis] = below + above;
        }
        beyond
    }
}

/// How much of each sample comes from outside: nothing on the lattice, all of it from one cell
/// beyond on, where the air outside begins.
#[inline(always)]
fn shares<S: Simd>(simd: S, beyond: [V<S>; 3]) -> V<S> {
    let (zero, one) = (V::splat(simd, 0.0), V::splat(simd, 1.0));
    let [x, y, z] = beyond;
    one - most(one - x, zero) * most(one - y, zero) * most(one - z, zero)
}

impl<const WRAPS: bool> PlaneKernel<f32> for Backward<'_, WRAPS> {
    #[inline(always)]
    fn plane<S: Simd>(&self, simd: S, k: usize, out: &mut [f32]) -> Partial {
        let [nx, ny, _] = self.counts;
        let inlets = self.inlets();
        let zero = V::splat(simd, 0.0);
        let mut brought = zero;
        for j in 0..ny {
            let ways = self.ways.of_row(self.kind, 0, j, k);
            for block in 0..nx.div_ceil(LANES) {
                let first = LANES * block;
                let (here, way) = (self.here(simd, [first, j, k]), ways.load(simd, first));
                let at = [here[0] - way[0], here[1] - way[1], here[2] - way[2]];
                let lanes = active(nx, first);
                let places = places::<S, WRAPS>(simd, &self.from, at);
                let mut values = match &self.bends {
                    Some(bends) => cubic::sample(simd, &self.from, bends, &places, lanes),
                    None => blend(corners(simd, &self.from, &places, lanes), &places),
                };
                if inlets.any && !places.are_inside(lanes) {
                    let beyond = inlets.beyond(simd, at);
                    if (beyond[0] + beyond[1] + beyond[2]).simd_gt(zero).any_true() {
                        let share = shares(simd, beyond);
                        let outside = self.outside.values(simd, at);
                        values += share * (outside - values);
                        let is_active = ramp(simd).simd_lt(V::splat(simd, (nx - first) as f32));
                        brought += is_active.select(share * outside * outside, zero);
                    }
                }
                // What is too much of a row, the next one overwrites.
                store(&mut out[j * nx + first..], values);
            }
        }
        Partial { sum: total(brought), ..Partial::default() }
    }
}

/// Takes half of the error of going there and back out of what was found.
pub(super) struct Correction<'a, const WRAPS: bool> {
    pub(super) back: Backward<'a, WRAPS>,
    /// Values at the start.
    pub(super) start: &'a [f32],
    /// Values found going back.
    pub(super) found: &'a [f32],
    pub(super) found_lattice: Lattice<'a>,
}

impl<const WRAPS: bool> PlaneKernel<f32> for Correction<'_, WRAPS> {
    #[inline(always)]
    fn plane<S: Simd>(&self, simd: S, k: usize, out: &mut [f32]) -> Partial {
        let [nx, ny, _] = self.back.counts;
        let inlets = self.back.inlets();
        for j in 0..ny {
            let ways = self.back.ways.of_row(self.back.kind, 0, j, k);
            let ways_on = self.back.ways.of_row(self.back.kind, 3, j, k);
            for block in 0..nx.div_ceil(LANES) {
                let first = LANES * block;
                let lanes = active(nx, first);
                let (here, way) = (self.back.here(simd, [first, j, k]), ways.load(simd, first));
                let at = [here[0] - way[0], here[1] - way[1], here[2] - way[2]];
                let before = places::<S, WRAPS>(simd, &self.back.from, at);
                let (low, high) = bounds(&corners(simd, &self.back.from, &before, lanes));
                let forth = ways_on.load(simd, first);
                let to = [here[0] + forth[0], here[1] + forth[1], here[2] + forth[2]];
                let after = places::<S, WRAPS>(simd, &self.found_lattice, to);
                let again = blend(corners(simd, &self.found_lattice, &after, lanes), &after);
                let index = first + nx * (j + ny * k);
                let found = load(simd, self.found, index);
                let corrected = found + (load(simd, self.start, index) - again) * 0.5;
                let mut values = most(least(corrected, high), low);
                if inlets.any && !(before.are_inside(lanes) && after.are_inside(lanes)) {
                    // Where the way leads out there is nothing to compare with.
                    let (there, here) = (inlets.beyond(simd, at), inlets.beyond(simd, to));
                    let beyond = there[0] + there[1] + there[2] + here[0] + here[1] + here[2];
                    values = beyond.simd_gt(V::splat(simd, 0.0)).select(found, values);
                }
                store(&mut out[j * nx + first..], values);
            }
        }
        Partial::default()
    }
}
