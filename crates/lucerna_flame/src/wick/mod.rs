//! From a wick's shape to its centreline (paper 003, section 4.1).
//!
//! The paper slices a wick along its bounding box, which fails for bent wicks; here it is sliced
//! along its own centreline.

mod mesh;
mod parts;
mod tube;

pub use tube::WickLook;

use crate::{FlameError, WickShape};
use glam::Vec3;

/// The most vertices or points a wick may have.
pub const MAX_WICK_POINTS: usize = 2_000_000;

/// Where a wick runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Centreline {
    /// A point-like or upright wick, as a candle's: its barycentre.
    Point(Vec3),
    /// An open line of two or more points, none of which coincide with their neighbours.
    Line(Vec<Vec3>),
}

impl WickShape {
    /// Finds the centreline of the whole shape as one wick: a closed ring is cut open where its angle about its own
    /// axis is zero, and separate parts are joined ([`linear_wicks`](Self::linear_wicks) takes them apart).
    ///
    /// # Errors
    /// When there are no points or too many, one is not finite, or the radius is not above 0.
    pub fn centreline(&self) -> Result<Centreline, FlameError> {
        match self {
            Self::Polyline { points, radius_m } => {
                let points = checked("wick.points", points)?;
                crate::error::in_range("wick.radius_m", *radius_m, 1e-6, 1e3, "1e-6 to 1000")?;
                Ok(classify(points, *radius_m))
            }
            Self::Vertices(vertices) => Ok(mesh::centreline(&checked("wick.vertices", vertices)?)),
        }
    }
}

fn checked(field: &'static str, points: &[[f32; 3]]) -> Result<Vec<Vec3>, FlameError> {
    if points.is_empty() || points.len() > MAX_WICK_POINTS {
        return Err(FlameError::Count { field, count: points.len(), allowed: "1 to 2000000" });
    }
    for (index, p) in points.iter().enumerate() {
        if let Some(bad) = p.iter().find(|v| !(-1e6..=1e6).contains(*v)) {
            return Err(FlameError::NotFinite { field, index, value: f64::from(*bad) });
        }
    }
    Ok(points.iter().copied().map(Vec3::from).collect())
}

/// Decides whether a line of points is long and level enough to carry a row of roots.
fn classify(mut points: Vec<Vec3>, radius_m: f32) -> Centreline {
    let barycentre = barycentre(&points);
    points.dedup_by(|a, b| a.distance(*b) < 1e-6);
    let length = points.windows(2).map(|w| w[0].distance(w[1])).sum::<f32>();
    let (low, high) = points.iter().fold((points[0], points[0]), |(l, h), p| (l.min(*p), h.max(*p)));
    let level = (high - low).with_y(0.0).length();
    if points.len() < 2 || length < 3.0 * radius_m || level < 0.35 * length.min((high - low).length()) {
        return Centreline::Point(barycentre);
    }
    Centreline::Line(points)
}

/// The middle of the line's length, or the mean where it has none.
fn barycentre(points: &[Vec3]) -> Vec3 {
    let (mut sum, mut total) = (Vec3::ZERO, 0.0);
    for w in points.windows(2) {
        let length = w[0].distance(w[1]);
        sum += (w[0] + w[1]) * (0.5 * length);
        total += length;
    }
    if total > 1e-9 { sum / total } else { points.iter().sum::<Vec3>() / points.len() as f32 }
}

/// The point at the fraction `s` of a line's length, and the line's direction there.
pub(crate) fn along(line: &[Vec3], s: f32) -> (Vec3, Vec3) {
    let total: f32 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    let mut left = s.clamp(0.0, 1.0) * total;
    let last = line.len().saturating_sub(2);
    for (i, w) in line.windows(2).enumerate() {
        let length = w[0].distance(w[1]);
        if left <= length || i == last {
            let direction = (w[1] - w[0]).normalize_or_zero();
            return (w[0] + direction * left.min(length), direction);
        }
        left -= length;
    }
    (line.first().copied().unwrap_or_default(), Vec3::ZERO)
}
