//! Free flames: tips that broke away, rise with the air and burn out.

use crate::air::{Air, keep_inside};
use crate::net::{self, Spine};
use crate::random::Fnv;
use crate::surface::Surface;
use glam::{Mat3, Vec3};

/// Time over which a broken tip draws back and its free flame appears, s.
pub(crate) const BREAK_S: f32 = 0.04;

/// Rows of a free flame's net.
pub(crate) const ROWS: usize = 4;

/// One free flame: the upper part of a lead skeleton with four chains around it.
#[derive(Debug, Default)]
pub(crate) struct Free {
    pub(crate) burning: bool,
    age_s: f32,
    life_s: f32,
    /// Five chains of M + 1 points, bottom first: the spine, then the rows in the frame of the spine (see `frame`).
    points: Vec<Vec3>,
    /// The side to which the frame's first axis points.
    side: Vec3,
    lengths: Vec<f32>,
    shaped: Vec<Vec3>,
    pub(crate) net: Vec<[f32; 3]>,
    pub(crate) surface: Surface,
}

impl Free {
    /// Memory for chains of `points` points.
    pub(crate) fn new(points: usize) -> Self {
        Self {
            points: vec![Vec3::ZERO; (ROWS + 1) * points],
            lengths: vec![0.0; points],
            shaped: vec![Vec3::ZERO; points],
            net: vec![[0.0; 3]; ROWS * (points + 2)],
            ..Self::default()
        }
    }

    /// Goes on where `old`, of as many points, burns.
    pub(crate) fn inherit(&mut self, old: &Self) {
        (self.burning, self.age_s, self.life_s, self.side) = (old.burning, old.age_s, old.life_s, old.side);
        self.points.clone_from(&old.points);
    }

    fn count(&self) -> usize {
        self.lengths.len()
    }

    /// Lights it; the caller fills the returned chains: the spine, then the four rows in its frame, clockwise
    /// seen from its tip.
    pub(crate) fn light(&mut self, life_s: f32, side: Vec3) -> &mut [Vec3] {
        self.side = side;
        self.burning = true;
        self.age_s = 0.0;
        self.life_s = life_s;
        &mut self.points
    }

    /// Carries it with the air. Only the spine moves freely: left to themselves the slower rows would fall
    /// behind and turn so short a flame inside out.
    pub(crate) fn step(&mut self, air: &impl Air, dt_s: f32) {
        self.age_s += dt_s;
        self.burning &= self.age_s < self.life_s;
        if self.burning {
            let n = self.count();
            let spine = &mut self.points[..n];
            air.carry(spine, dt_s);
            let bounds = air.bounds();
            spine.iter_mut().for_each(|p| *p = keep_inside(*p, bounds, bounds.1));
        }
    }

    /// How much of it is left, 1 to 0; it is born over `birth_s`, while its parent draws back.
    pub(crate) fn strength(&self) -> f32 {
        let left = (1.0 - self.age_s / self.life_s).clamp(0.0, 1.0);
        (self.age_s / BREAK_S).clamp(0.0, 1.0) * left
    }

    /// Makes the net: closed at both ends, shrinking onto its spine as it burns out.
    pub(crate) fn build_net(&mut self) {
        let n = self.count();
        let x = (self.age_s / self.life_s).clamp(0.0, 1.0);
        let size = (1.0 - x * x).max(0.02);
        let (spine, rows) = self.points.split_at_mut(n);
        net::measure(spine, &mut self.lengths, 1e-4);
        let spine = Spine { points: spine, lengths: &self.lengths };
        let middle = spine.points[n / 2];
        for (r, row) in rows.chunks_exact(n).enumerate() {
            for (k, (point, centre)) in self.shaped.iter_mut().zip(spine.points).enumerate() {
                // The cut rounds itself off soon after it was made.
                let y = 1.0 - k as f32 / (n - 1) as f32;
                let round = 1.0 - (0.6 + 0.4 * (5.0 * x).min(1.0)) * y * y;
                *point = *centre + frame(direction(spine.points, k), self.side) * row[k] * (round * size);
            }
            let out = &mut self.net[r * (n + 2)..][..n + 2];
            net::write_row(out, &spine, &self.shaped);
            // Burning out also shortens it, towards its middle.
            for point in out {
                *point = middle.lerp(Vec3::from(*point), 0.5 + 0.5 * size).to_array();
            }
        }
    }

    pub(crate) fn hash(&self, fnv: &mut Fnv) {
        fnv.word(u64::from(self.burning));
        if self.burning {
            fnv.float(self.age_s);
            fnv.float(self.life_s);
            fnv.point(self.side);
            self.points.iter().for_each(|p| fnv.point(*p));
        }
    }
}

/// The direction of a line at one of its points.
pub(crate) fn direction(line: &[Vec3], k: usize) -> Vec3 {
    (line[(k + 1).min(line.len() - 1)] - line[k.saturating_sub(1)]).normalize_or(Vec3::Y)
}

/// Axes about a spine: across it towards `side`, across it the other way, along it.
pub(crate) fn frame(along: Vec3, side: Vec3) -> Mat3 {
    let across = side.reject_from_normalized(along).normalize_or(along.any_orthonormal_vector());
    Mat3::from_cols(across, along.cross(across), along)
}
