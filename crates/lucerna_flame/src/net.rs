//! Control nets: the points that a flame's surface is drawn through (paper 003, section 4.3, equation 1).
//!
//! A row has M + 3 points, in the order of the authors' program: the top of the nearest lead
//! skeleton, M particles of a peripheral skeleton downwards, its root, the root of the lead skeleton.
//! (The paper prints M + 2: it counts the peripheral root among the M particles.)

use glam::Vec3;

/// A line from root to tip with the length up to each of its points.
pub(crate) struct Spine<'a> {
    pub(crate) points: &'a [Vec3],
    pub(crate) lengths: &'a [f32],
}

/// Writes the lengths of a line up to each point, and keeps the line at least `least_m` long.
pub(crate) fn measure(points: &mut [Vec3], lengths: &mut [f32], least_m: f32) {
    let total = |points: &[Vec3]| points.windows(2).map(|w| w[0].distance(w[1])).sum::<f32>();
    // Air that stands still or sinks must not crush the flame to a disc.
    let missing = (least_m - total(points)).max(0.0);
    let last = points.len().max(2) - 1;
    for (k, point) in points.iter_mut().enumerate() {
        point.y += missing * k as f32 / last as f32;
    }
    let mut sum = 0.0;
    for k in 0..points.len() {
        if k > 0 {
            sum += points[k].distance(points[k - 1]);
        }
        lengths[k] = sum;
    }
}

impl Spine<'_> {
    /// The length along the line at which it is nearest to `p`, not below the start of segment `from`;
    /// the foot there; the segment.
    fn project(&self, p: Vec3, from: usize) -> (f32, Vec3, usize) {
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

    pub(crate) fn at(&self, length: f32) -> Vec3 {
        let i = self.lengths.partition_point(|&l| l < length).clamp(1, self.lengths.len() - 1);
        let span = self.lengths[i] - self.lengths[i - 1];
        let t = if span > 1e-12 { ((length - self.lengths[i - 1]) / span).clamp(0.0, 1.0) } else { 0.0 };
        self.points[i - 1].lerp(self.points[i], t)
    }

    pub(crate) fn total(&self) -> f32 {
        self.lengths.last().copied().unwrap_or(0.0)
    }
}

/// How the raw points of a peripheral skeleton become control points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shaping {
    /// Away from the wick.
    pub(crate) outward: Vec3,
    /// Least distance outwards from the spine, m: the surface never turns inside out.
    pub(crate) least_m: f32,
    /// Distances from the spine are bent to stay below this, m.
    pub(crate) most_m: f32,
    /// How far the oldest point is drawn in, 0 to 1.
    pub(crate) taper: f32,
    /// Factor on distances from the spine: a closed cubic through four points passes at 2/3 of their distance.
    pub(crate) spread: f32,
}

/// Highest control point of a peripheral skeleton, as a share of the spine: above it the tip closes.
const HIGHEST: f32 = 0.93;

/// Shapes one peripheral chain (root first) about its spine.
pub(crate) fn shape(spine: &Spine<'_>, row: &mut [Vec3], how: Shaping, heights: &mut [f32]) {
    let last = row.len().max(2) - 1;
    let mut segment = 0;
    let tip = spine.points.len() - 1;
    let end = (spine.points[tip] - spine.points[tip - 1]).normalize_or(Vec3::Y);
    for (point, height) in row.iter_mut().zip(heights.iter_mut()) {
        let (length, foot, at) = spine.project(*point, segment);
        segment = at;
        let mut offset = *point - foot;
        *height = length;
        if length >= spine.total() {
            let beyond = offset.dot(end).max(0.0);
            offset -= end * beyond;
            *height += beyond;
        }
        *point = offset;
    }
    // A chain that overtakes its spine is compressed as a whole, so that its order stays.
    let limit = HIGHEST * spine.total();
    let shrink = if heights[last] > limit { limit / heights[last].max(1e-12) } else { 1.0 };
    for (k, (point, height)) in row.iter_mut().zip(heights.iter()).enumerate() {
        let x = k as f32 / last as f32;
        let narrow = 1.0 - how.taper * x * x;
        let mut offset = *point;
        let least = how.least_m * narrow;
        offset += how.outward * (least - offset.dot(how.outward)).max(0.0);
        // Eddies that tear a chain far away from its spine would stretch the surface to a sheet.
        let far = (offset.length_squared() / (how.most_m * how.most_m)).min(1e12);
        offset /= (1.0 + far * far).sqrt().sqrt();
        *point = spine.at(height * shrink) + offset * (narrow * how.spread);
    }
}

/// Writes one row of the net from the shaped chain and its spine.
pub(crate) fn write_row(out: &mut [[f32; 3]], spine: &Spine<'_>, row: &[Vec3]) {
    let (bottom, top) = (spine.points[0], spine.points[spine.points.len() - 1]);
    let points = std::iter::once(top).chain(row.iter().rev().copied()).chain(std::iter::once(bottom));
    for (to, from) in out.iter_mut().zip(points) {
        *to = from.to_array();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn upright() -> (Vec<Vec3>, Vec<f32>) {
        let mut points: Vec<Vec3> = (0..9).map(|k| Vec3::Y * (0.1 * k as f32)).collect();
        let mut lengths = vec![0.0; 9];
        measure(&mut points, &mut lengths, 0.1);
        (points, lengths)
    }

    #[test]
    fn without_taper_chains_are_taken_as_they_are() {
        let (points, lengths) = upright();
        let spine = Spine { points: &points, lengths: &lengths };
        let raw: Vec<Vec3> = (0..9).map(|k| Vec3::new(0.1, 0.08 * k as f32, 0.0)).collect();
        let mut row = raw.clone();
        let how = Shaping { outward: Vec3::X, least_m: 0.01, most_m: 1e6, taper: 0.0, spread: 1.0 };
        shape(&spine, &mut row, how, &mut [0.0; 9]);
        assert!(row.iter().zip(&raw).all(|(a, b)| (*a - *b).length() < 1e-6), "{row:?}");
        let mut out = [[0.0; 3]; 11];
        write_row(&mut out, &spine, &row);
        assert_eq!((out[0], out[10]), ([0.0, 0.8, 0.0], [0.0; 3]));
        assert_eq!((out[1], out[9]), (row[8].to_array(), row[0].to_array()));
    }

    #[test]
    fn chains_never_cross_or_overtake_their_spine() {
        let (points, lengths) = upright();
        let spine = Spine { points: &points, lengths: &lengths };
        let how = Shaping { outward: Vec3::X, least_m: 0.01, most_m: 0.2, taper: 0.5, spread: 1.0 };
        let mut row: Vec<Vec3> = (0..9).map(|k| Vec3::new(0.1 - 0.05 * k as f32, 0.3 * k as f32, 0.0)).collect();
        shape(&spine, &mut row, how, &mut [0.0; 9]);
        assert!(row.iter().all(|p| p.x > 0.0 && p.y <= 0.8), "{row:?}");
        assert!(row.windows(2).all(|w| w[0].y < w[1].y), "{row:?}");
        let mut flat = [Vec3::ZERO; 9];
        measure(&mut flat, &mut [0.0; 9], 0.1);
        assert!((flat[8].y - 0.1).abs() < 1e-6, "still air leaves a flame of the least height");
    }
}
