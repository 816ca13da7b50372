//! Free flames: tips that broke away, rise with the air and burn out.

use crate::air::{Air, keep_inside};
use crate::net;
use crate::random::Fnv;
use crate::spine::{self, Limits, Spine, direction};
use crate::surface::{Surface, SurfacePlan};
use glam::{Mat3, Quat, Vec3};
use serde::{Deserialize, Serialize};

/// Time over which a broken tip draws back and its free flame appears, s.
pub(crate) const BREAK_S: f32 = 0.04;

/// Least length of a free flame and radius of its tightest bend, as a share of its greatest width.
const SHORTEST: f32 = 0.5;
const TIGHTEST: f32 = 1.0;

/// Rows of a free flame's net.
pub(crate) const ROWS: usize = 4;

/// One free flame: the upper part of a lead skeleton with four chains around it.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Free {
    pub(crate) burning: bool,
    age_s: f32,
    life_s: f32,
    /// Five chains of M + 1 points, bottom first: the spine, then the rows in the frame of the spine (see `frame`).
    points: Vec<Vec3>,
    /// The side to which the frame's first axis points.
    side: Vec3,
    #[serde(skip)]
    lengths: Vec<f32>,
    #[serde(skip)]
    shaped: Vec<Vec3>,
    #[serde(skip)]
    pub(crate) net: Vec<[f32; 3]>,
    #[serde(skip)]
    raw_net: Vec<[f32; 3]>,
    #[serde(skip)]
    pub(crate) surface: Surface,
}

impl Free {
    /// Memory for chains of `points` points, and for a surface.
    pub(crate) fn new(points: usize, plan: &SurfacePlan) -> Self {
        Self {
            points: vec![Vec3::ZERO; (ROWS + 1) * points],
            lengths: vec![0.0; points],
            shaped: vec![Vec3::ZERO; points],
            net: vec![[0.0; 3]; ROWS * (points + 2)],
            raw_net: Vec::with_capacity(ROWS * (points + 2)),
            surface: Surface::of_size(plan),
            ..Self::default()
        }
    }

    /// Goes on where `old`, of as many points, burns.
    pub(crate) fn inherit(&mut self, old: &Self) {
        (self.burning, self.age_s, self.life_s, self.side) = (old.burning, old.age_s, old.life_s, old.side);
        self.points.clone_from(&old.points);
    }

    /// Its spine.
    pub(crate) fn spine(&self) -> &[Vec3] {
        &self.points[..self.count()]
    }

    /// What has to be saved of it.
    pub(crate) fn saved(&self) -> Self {
        let mut saved = Self::default();
        saved.inherit(self);
        saved
    }

    /// Whether it can be inherited by `other`: of the same size, with numbers that are finite.
    pub(crate) fn fits(&self, other: &Self) -> bool {
        let times = [self.age_s, self.life_s].iter().all(|time_s| (0.0..=1e3).contains(time_s));
        let points = self.points.iter().chain([&self.side]);
        times
            && (!self.burning || self.life_s > 0.0)
            && self.points.len() == other.points.len()
            && points.copied().all(Vec3::is_finite)
    }

    fn count(&self) -> usize {
        self.lengths.len()
    }

    /// Lights it, whole at once where its parent is cut `at_once`; the caller fills the returned chains: the spine, then
    /// the four rows in its frame, clockwise seen from its tip.
    pub(crate) fn light(&mut self, life_s: f32, side: Vec3, at_once: bool) -> &mut [Vec3] {
        self.side = side;
        self.burning = true;
        self.age_s = if at_once { BREAK_S } else { 0.0 };
        self.life_s = life_s;
        &mut self.points
    }

    /// Carries it with the air. Only the spine moves freely: left to themselves the slower rows would fall
    /// behind and turn so short a flame inside out.
    ///
    /// One that has gas left to burn (`lasts`) stays young until that is used up.
    pub(crate) fn step(&mut self, air: &impl Air, dt_s: f32, lasts: bool) {
        self.age_s += dt_s;
        if lasts {
            self.age_s = self.age_s.min(BREAK_S);
        }
        self.burning &= self.age_s < self.life_s;
        if self.burning {
            let n = self.count();
            let spine = &mut self.points[..n];
            air.carry(spine, dt_s);
            let bounds = air.bounds();
            spine.iter_mut().for_each(|p| *p = keep_inside(*p, bounds, bounds.1));
            let (spine, rows) = self.points.split_at_mut(n);
            let widest = rows.iter().map(|p| p.length_squared()).fold(0.0, f32::max).sqrt().max(1e-5);
            let stands = (spine[1] - spine[0]).normalize_or(Vec3::Y);
            let limits = Limits { stands, least_m: SHORTEST * widest, bend_m: TIGHTEST * widest, along: Vec3::ZERO };
            spine::straighten(spine, &mut self.lengths, &mut self.shaped, limits);
            // The side turns with the flame: were it to stay, a flame that leans towards it would twist.
            self.side = frame(direction(spine, 0), self.side).x_axis;
        }
    }

    /// How much of it is left, 1 to 0; it is born over [`BREAK_S`], while its parent draws back.
    pub(crate) fn strength(&self) -> f32 {
        let left = (1.0 - self.age_s / self.life_s).clamp(0.0, 1.0);
        (self.age_s / BREAK_S).clamp(0.0, 1.0) * left
    }

    /// Makes the net: closed at both ends, shrinking onto its spine as it burns out.
    pub(crate) fn build_net(&mut self, plan: &SurfacePlan) {
        let n = self.count();
        let x = (self.age_s / self.life_s).clamp(0.0, 1.0);
        let size = (1.0 - x * x).max(0.05);
        let (spine, rows) = self.points.split_at_mut(n);
        spine::measure(spine, &mut self.lengths);
        let spine = Spine { points: spine, lengths: &self.lengths };
        let middle = spine.points[n / 2];
        // The cut rounds itself off soon after it was made.
        let round = |k: usize| {
            let y = 1.0 - k as f32 / (n - 1) as f32;
            size * (1.0 - (0.6 + 0.4 * (5.0 * x).min(1.0)) * y * y)
        };
        // Burning out also shortens it, towards its middle.
        let shorten = |point: Vec3| middle.lerp(point, 0.5 + 0.5 * size);
        for (r, row) in rows.chunks_exact(n).enumerate() {
            let axes = frames(spine.points, self.side);
            for (k, ((point, centre), axes)) in self.shaped.iter_mut().zip(spine.points).zip(axes).enumerate() {
                *point = *centre + axes * row[k] * round(k);
            }
            let out = &mut self.net[r * (n + 2)..][..n + 2];
            net::write_row(out, &spine, &self.shaped);
            for point in out {
                *point = shorten(Vec3::from(*point)).to_array();
            }
        }
        // As thick, but straight and round, for where the air bends and shears it too much.
        let (bottom, tip) = (spine.points[0], spine.points[n - 1]);
        let along = (tip - bottom).normalize_or(Vec3::Y);
        let axes = frame(along, self.side);
        let around = [axes.y_axis, axes.x_axis, -axes.y_axis, -axes.x_axis];
        let straight = |i: usize| {
            let (row, column) = (i / (n + 2), i % (n + 2));
            let k = n.saturating_sub(column).min(n - 1);
            let mean = (0..ROWS).map(|r| rows[r * n + k].length()).sum::<f32>() / ROWS as f32;
            let inside = (1..=n).contains(&column);
            let across = if inside { around[row] * (mean * round(k)) } else { Vec3::ZERO };
            shorten(bottom + along * (spine.total() * k as f32 / (n - 1) as f32) + across)
        };
        let surface = &mut self.surface;
        net::calm(&mut self.net, &mut self.raw_net, straight, |net| surface.is_right_side_out(plan, net));
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

/// Axes about a spine: across it towards `side`, across it the other way, along it.
pub(crate) fn frame(along: Vec3, side: Vec3) -> Mat3 {
    let across = side.reject_from_normalized(along).normalize_or(along.any_orthonormal_vector());
    Mat3::from_cols(across, along.cross(across), along)
}

/// The frames at the points of a line: the first towards `side`, each next turned only as the line bends.
pub(crate) fn frames(line: &[Vec3], side: Vec3) -> impl Iterator<Item = Mat3> + '_ {
    let mut axes = frame(direction(line, 0), side);
    (0..line.len()).map(move |k| {
        axes = Mat3::from_quat(Quat::from_rotation_arc(axes.z_axis, direction(line, k))) * axes;
        axes
    })
}
