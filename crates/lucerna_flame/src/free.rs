//! Free flames: tips that broke away, rise with the air and burn out.

use crate::air::{Air, keep_inside};
use crate::net::{self, Spine};
use crate::random::Fnv;
use crate::surface::Surface;
use glam::Vec3;

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
    /// Five chains of M + 1 points, bottom first: the spine, then the rows.
    points: Vec<Vec3>,
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

    fn count(&self) -> usize {
        self.lengths.len()
    }

    /// Lights it; the caller fills the returned chains: the spine, then the rows, clockwise from above.
    pub(crate) fn light(&mut self, life_s: f32) -> &mut [Vec3] {
        self.burning = true;
        self.age_s = 0.0;
        self.life_s = life_s;
        &mut self.points
    }

    /// Carries it with the air.
    pub(crate) fn step(&mut self, air: &impl Air, dt_s: f32) {
        self.age_s += dt_s;
        self.burning &= self.age_s < self.life_s;
        if self.burning {
            air.carry(&mut self.points, dt_s);
            let (bounds, n) = (air.bounds(), self.count());
            for i in 0..self.points.len() {
                self.points[i] = keep_inside(self.points[i], bounds, self.points[i % n]);
            }
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
                let round = 1.0 - (0.4 + 0.6 * (4.0 * x).min(1.0)) * y * y * y;
                *point = *centre + (row[k] - *centre) * (round * size);
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
            self.points.iter().for_each(|p| fnv.point(*p));
        }
    }
}
