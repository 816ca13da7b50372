//! Particle chains: what every skeleton of a flame has emitted and the air has carried.
//!
//! All skeletons of a flame emit together, so the particles form a table: one row an emission, one
//! column a skeleton. Chains are read at fixed ages, between particles too: nothing pops when one is
//! born or retired, and the shape does not depend on how many there are.

use crate::air::{Air, keep_inside};
use crate::random::Fnv;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Emissions kept at most; with short steps particles are emitted every few steps only.
const SLOTS: usize = 48;

/// The particles of one flame.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Chains {
    skeletons: usize,
    life_s: f32,
    /// Current roots: the particles of age zero.
    roots: Vec<Vec3>,
    /// How far the roots have come in this step: particles are emitted where it began. None while they stand still.
    ways: Vec<Vec3>,
    /// Ring of emissions; `head` is the newest.
    ages_s: Vec<f32>,
    points: Vec<Vec3>,
    head: usize,
    len: usize,
    since_s: f32,
}

impl Chains {
    /// Chains as long as `height_m`, straight up: the spark that a flame grows from.
    pub(crate) fn new(roots: Vec<Vec3>, life_s: f32, height_m: f32) -> Self {
        let skeletons = roots.len();
        let slots = SLOTS + 3;
        let mut chains = Self {
            skeletons,
            life_s,
            ages_s: vec![0.0; slots],
            points: vec![Vec3::ZERO; slots * skeletons],
            roots,
            ways: Vec::new(),
            head: slots - 1,
            len: 0,
            since_s: 0.0,
        };
        for i in (1..=6).rev() {
            let share = i as f32 / 6.0;
            chains.push(life_s * share, Vec3::Y * (height_m * share));
        }
        chains
    }

    /// Whether it can take the place of `other`: of the same size, every number finite, every age within `most_s`.
    pub(crate) fn fits(&self, other: &Self, most_s: f32) -> bool {
        let points = [&self.roots, &self.ways, &self.points].into_iter().flatten();
        self.skeletons == other.skeletons
            && self.roots.len() == other.roots.len()
            && (self.ways.is_empty() || self.ways.len() == self.roots.len())
            && self.ages_s.len() == other.ages_s.len()
            && self.points.len() == other.points.len()
            && self.head < self.ages_s.len()
            && (1..=self.ages_s.len()).contains(&self.len)
            && points.copied().all(Vec3::is_finite)
            && self.ages_s.iter().chain([&self.since_s]).all(|age_s| (0.0..=most_s).contains(age_s))
            && (0.0..=most_s).contains(&self.life_s)
    }

    /// How many chains there are.
    pub(crate) fn skeletons(&self) -> usize {
        self.skeletons
    }
    /// Age of the oldest particles, s.
    pub(crate) fn oldest_s(&self) -> f32 {
        if self.len > 0 { self.ages_s[self.slot(self.len - 1)] } else { 0.0 }
    }
    pub(crate) fn roots_mut(&mut self) -> &mut [Vec3] {
        &mut self.roots
    }
    pub(crate) fn root(&self, skeleton: usize) -> Vec3 {
        self.roots[skeleton]
    }
    /// Longest life of a particle, s.
    pub(crate) fn set_life(&mut self, life_s: f32) {
        self.life_s = life_s;
    }

    /// Says how far each root comes in the coming step.
    pub(crate) fn set_ways(&mut self, ways: impl Iterator<Item = Vec3>) {
        self.ways.clear();
        self.ways.extend(ways);
    }

    /// Moves all particles, as when their wick jumps.
    pub(crate) fn carry_along(&mut self, way: Vec3) {
        self.points.iter_mut().for_each(|point| *point += way);
    }

    fn slot(&self, i: usize) -> usize {
        (self.head + i) % self.ages_s.len()
    }

    fn push(&mut self, age_s: f32, offset: Vec3) {
        self.head = (self.head + self.ages_s.len() - 1) % self.ages_s.len();
        self.len = (self.len + 1).min(self.ages_s.len());
        self.ages_s[self.head] = age_s;
        let row = &mut self.points[self.head * self.skeletons..][..self.skeletons];
        let ways = self.ways.iter().copied().chain(std::iter::repeat(Vec3::ZERO));
        for ((point, root), way) in row.iter_mut().zip(&self.roots).zip(ways) {
            *point = *root - way + offset;
        }
    }

    /// Emits, carries and retires. `push_of(skeleton, age, point)` is a displacement on top of the air's.
    pub(crate) fn step(&mut self, air: &impl Air, dt_s: f32, push_of: impl Fn(usize, f32, Vec3) -> Vec3) {
        let interval = self.life_s / SLOTS as f32;
        if self.since_s >= interval * 0.999 {
            self.push(0.0, Vec3::ZERO);
            self.since_s = 0.0;
        }
        self.since_s += dt_s;
        // The ring's live part is at most two pieces.
        let (slots, n) = (self.ages_s.len(), self.skeletons);
        let end = self.head + self.len;
        air.carry(&mut self.points[self.head * n..end.min(slots) * n], dt_s);
        if end > slots {
            air.carry(&mut self.points[..(end - slots) * n], dt_s);
        }
        let bounds = air.bounds();
        for i in 0..self.len {
            let slot = self.slot(i);
            let age = self.ages_s[slot];
            for (k, point) in self.points[slot * n..][..n].iter_mut().enumerate() {
                *point = keep_inside(*point + push_of(k, age, *point), bounds, self.roots[k]);
            }
            self.ages_s[slot] = age + dt_s;
        }
        // One particle beyond the end of life stays: the last stretch is read between it and its neighbour.
        while self.len > 1 && self.ages_s[self.slot(self.len - 2)] >= self.life_s {
            self.len -= 1;
        }
    }

    /// Reads a chain at the ages 0, s, 2 s, ...; `out` receives as many points as it holds.
    pub(crate) fn sample(&self, skeleton: usize, spacing_s: f32, out: &mut [Vec3]) {
        let at = |i: usize| {
            let slot = self.slot(i);
            (self.ages_s[slot], self.points[slot * self.skeletons + skeleton])
        };
        let mut younger = (0.0, self.roots[skeleton]);
        let mut next = 0;
        for (k, point) in out.iter_mut().enumerate() {
            let age = k as f32 * spacing_s;
            while next + 1 < self.len && at(next).0 < age {
                younger = at(next);
                next += 1;
            }
            let older = at(next);
            let span = older.0 - younger.0;
            let t = if span > 1e-9 { ((age - younger.0) / span).clamp(0.0, 1.0) } else { 1.0 };
            *point = younger.1.lerp(older.1, t);
        }
    }

    /// The particles of one skeleton from its root upwards.
    pub(crate) fn particles(&self, skeleton: usize) -> impl Iterator<Item = Vec3> + '_ {
        let carried = (0..self.len).map(move |i| self.points[self.slot(i) * self.skeletons + skeleton]);
        std::iter::once(self.roots[skeleton]).chain(carried)
    }

    pub(crate) fn hash(&self, fnv: &mut Fnv) {
        fnv.float(self.since_s);
        for k in 0..self.skeletons {
            self.particles(k).for_each(|p| fnv.point(p));
        }
        (0..self.len).for_each(|i| fnv.float(self.ages_s[self.slot(i)]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::UniformAir;

    const BOX: f32 = 100.0;

    fn rising(speed: f32) -> UniformAir {
        let high = Vec3::splat(BOX);
        UniformAir { velocity_m_s: Vec3::Y * speed, low_m: -high, high_m: high }
    }

    #[test]
    fn a_chain_in_steady_air_is_the_same_for_any_time_step() {
        for dt in [1e-4, 1e-3, 0.01, 0.03, 0.1, 0.5] {
            let mut chains = Chains::new(vec![Vec3::ZERO, Vec3::X], 0.2, 0.01);
            for _ in 0..(1.0 / dt) as usize + 2 {
                chains.step(&rising(2.0), dt, |_, _, _| Vec3::ZERO);
            }
            let mut points = [Vec3::ZERO; 9];
            chains.sample(1, 0.2 / 8.0, &mut points);
            for (k, p) in points.iter().enumerate() {
                let want = Vec3::new(1.0, 2.0 * 0.2 * k as f32 / 8.0, 0.0);
                assert!((*p - want).length() < 1e-4, "dt {dt}: point {k} is {p}, not {want}");
            }
        }
    }

    #[test]
    fn particles_stay_in_the_box_and_finite() {
        let air = UniformAir { velocity_m_s: Vec3::new(1e30, f32::NAN, -1e30), ..rising(0.0) };
        let mut chains = Chains::new(vec![Vec3::ONE], 0.2, 0.01);
        for _ in 0..20 {
            chains.step(&air, 10.0, |_, _, _| Vec3::ZERO);
        }
        assert!(chains.particles(0).all(|p| p.is_finite() && p.abs().max_element() <= BOX));
    }
}
