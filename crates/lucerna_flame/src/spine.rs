//! Spines: lead skeletons as lines about which the rows of a net are shaped.
//!
//! Air that swirls folds chains of particles, curls them up and crowds them together. A spine is the same chain with
//! its points at equal distances, bends no tighter than the flame is wide, and nowhere hanging down.

use glam::{Quat, Vec3};

/// Sharpest turn from one stretch to the next, and from upwards, in radians.
const SHARPEST: f32 = 1.0;
const STEEPEST: f32 = 1.75;

/// A line from root to tip with the length up to each of its points.
pub(crate) struct Spine<'a> {
    pub(crate) points: &'a [Vec3],
    pub(crate) lengths: &'a [f32],
}

/// Writes the lengths of a line up to each point.
pub(crate) fn measure(points: &[Vec3], lengths: &mut [f32]) {
    let mut sum = 0.0;
    for k in 0..points.len() {
        if k > 0 {
            sum += points[k].distance(points[k - 1]);
        }
        lengths[k] = sum;
    }
}

/// What a well-formed line keeps to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// The direction from which it may turn away at its root.
    pub(crate) stands: Vec3,
    /// Least length, m.
    pub(crate) least_m: f32,
    /// Radius of its tightest bend, m.
    pub(crate) bend_m: f32,
    /// The level direction of the wick, along which it leans less; zero for a point-like wick.
    pub(crate) along: Vec3,
}

/// Steepness, up or across over along the wick, that a stretch keeps at least: tongues side by side that lay down on
/// one another would turn the cuts across them over.
const LEAST_RISE: f32 = 0.8;

/// A direction that leans no more along the wick than it may: it is raised.
fn raised(way: Vec3, along: Vec3) -> Vec3 {
    let aside = way.dot(along).abs();
    let across = (way - along * way.dot(along)).with_y(0.0).length();
    let least = LEAST_RISE * aside - across;
    if way.y >= least { way } else { way.with_y(least).normalize_or(Vec3::Y) }
}

/// Makes a line well-formed, its points equally far from their neighbours, and measures it. `scratch` and `lengths`
/// are as long as `points`.
pub(crate) fn straighten(points: &mut [Vec3], lengths: &mut [f32], scratch: &mut [Vec3], limits: Limits) {
    let Limits { stands, least_m, bend_m, along } = limits;
    let last = points.len().max(2) - 1;
    measure(points, lengths);
    // Air that stands still or sinks must not crush the flame to a disc.
    let missing = (least_m - lengths[last]).max(0.0);
    for (k, point) in points.iter_mut().enumerate() {
        point.y += missing * k as f32 / last as f32;
    }
    measure(points, lengths);
    let total = lengths[last];
    let line = Spine { points, lengths };
    for (k, point) in scratch.iter_mut().enumerate() {
        *point = line.at(total * k as f32 / last as f32);
    }
    let stretch = total.max(least_m) / last as f32;
    let sharpest = (2.0 * (0.5 * stretch / bend_m).atan()).min(SHARPEST);
    let mut before = stands;
    for k in 1..points.len() {
        let way = (scratch[k] - scratch[k - 1]).normalize_or(before);
        let way = raised(turned(Vec3::Y, turned(before, way, sharpest), STEEPEST), along);
        points[k] = points[k - 1] + way * stretch;
        lengths[k] = stretch * k as f32;
        before = way;
    }
}

/// The direction `to`, turned back towards `from` where it is more than an angle away.
fn turned(from: Vec3, to: Vec3, most: f32) -> Vec3 {
    if from.dot(to) >= most.cos() {
        return to;
    }
    let across = (to - from * from.dot(to)).normalize_or(from.any_orthonormal_vector());
    from * most.cos() + across * most.sin()
}

impl Spine<'_> {
    /// The length along the line at which it is nearest to `p`, not below the start of segment `from`;
    /// the foot there; the segment.
    pub(crate) fn project(&self, p: Vec3, from: usize) -> (f32, Vec3, usize) {
        let mut best = (self.lengths[from], self.points[from], from);
        let mut least = f32::INFINITY;
        for (i, w) in self.points.windows(2).enumerate().skip(from) {
            let d = w[1] - w[0];
            let t = ((p - w[0]).dot(d) / d.length_squared().max(1e-18)).clamp(0.0, 1.0);
            let foot = w[0] + d * t;
            let distance = p.distance_squared(foot);
            if distance < least {
                least = distance;
                best = (self.lengths[i] + (self.lengths[i + 1] - self.lengths[i]) * t, foot, i);
            }
        }
        best
    }

    /// The length at which the line is nearest to `p`.
    pub(crate) fn length_at(&self, p: Vec3) -> f32 {
        self.project(p, 0).0
    }

    /// The stretch in which a length lies, by its upper end, and how far into it.
    fn stretch(&self, length: f32) -> (usize, f32) {
        let i = self.lengths.partition_point(|&l| l < length).clamp(1, self.lengths.len() - 1);
        let span = self.lengths[i] - self.lengths[i - 1];
        (i, if span > 1e-12 { ((length - self.lengths[i - 1]) / span).clamp(0.0, 1.0) } else { 0.0 })
    }

    pub(crate) fn at(&self, length: f32) -> Vec3 {
        let (i, t) = self.stretch(length);
        self.points[i - 1].lerp(self.points[i], t)
    }

    pub(crate) fn total(&self) -> f32 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// How the line leans at a length: the shortest turn from upwards, so that nothing twists about the line.
    pub(crate) fn lean(&self, length: f32) -> Quat {
        let (i, t) = self.stretch(length);
        Quat::from_rotation_arc(Vec3::Y, way(self.points, i - 1).lerp(way(self.points, i), t).normalize_or(Vec3::Y))
    }

    /// The bend at a length: towards the middle of the circle that fits the line there, one over its radius long.
    pub(crate) fn bend(&self, length: f32) -> Vec3 {
        let at = |k: usize| {
            let k = k.min(self.points.len() - 2);
            let above = self.points[k + 1] - self.points[k];
            // The wick lies level: a flame stands upright on it.
            let below = if k == 0 { Vec3::Y } else { (self.points[k] - self.points[k - 1]).normalize_or_zero() };
            (above.normalize_or_zero() - below) / above.length().max(1e-12)
        };
        let (i, t) = self.stretch(length);
        at(i - 1).lerp(at(i), t)
    }
}

/// The direction of a line at one of its points.
pub(crate) fn direction(line: &[Vec3], k: usize) -> Vec3 {
    (line[(k + 1).min(line.len() - 1)] - line[k.saturating_sub(1)]).normalize_or(Vec3::Y)
}

/// The direction in which a flame stands at one of its points; at the root it is upwards, as the wick lies level.
fn way(line: &[Vec3], k: usize) -> Vec3 {
    if k == 0 { Vec3::Y } else { direction(line, k) }
}
