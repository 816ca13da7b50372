//! Where wicks come from, and the linear wicks that they are made of.

use crate::assets::Assets;
use crate::import;
use crate::model::{Placement, is_zero, one};
use crate::validate::Check;
use crate::{Fire, Scene, SceneError};
use glam::Vec3;
use lucerna_flame::WickShape;
use lucerna_nurbs::{Curve, Spacing};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Samples between two points of a curve.
const SAMPLES: usize = 8;
/// Moments in which a moving wick is looked for in the air.
const MOMENTS: u32 = 65;
/// Corners of a ring.
const CORNERS: usize = 48;
/// Points of a closed curve that are repeated at either end, so that it closes smoothly.
const LAP: usize = 3;

/// Where a wick comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum WickSource {
    /// A centreline through points, with a radius, in metres. One that ends where it begins is cut into three arcs,
    /// each with a flame of its own.
    Polyline {
        /// World positions, m; one point is a candle's wick.
        points: Vec<[f32; 3]>,
        /// Radius, m.
        radius_m: f32,
    },
    /// A smooth centreline: the cubic through the points, in their order.
    Curve {
        /// World positions, m.
        points: Vec<[f32; 3]>,
        /// Radius, m.
        radius_m: f32,
        /// Whether the last point leads back to the first: then it is three arcs.
        #[serde(default)]
        closed: bool,
    },
    /// A circle: three arcs, each with a flame of its own.
    Ring {
        /// Its middle, m.
        center_m: [f32; 3],
        /// Distance of the wick from the middle, m.
        ring_m: f32,
        /// Across the circle's plane; any length above zero.
        #[serde(default = "up")]
        normal: [f32; 3],
        /// Radius of the wick itself, m.
        radius_m: f32,
    },
    /// Point-like wicks, as those of candles, a flame for each.
    Points {
        /// World positions, m.
        points: Vec<[f32; 3]>,
        /// Radius, m.
        radius_m: f32,
    },
    /// The vertices of a mesh file (OBJ, glTF, GLB): all of them, or those of the group whose name begins with
    /// `wick` where there is one. Each part is a wick, and a ring three arcs.
    Mesh {
        /// The file, relative to the scene file.
        file: PathBuf,
        /// The group, object or node; needed where a file has several whose names begin with `wick`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        group: Option<String>,
        /// Where its origin goes, m.
        #[serde(default)]
        position_m: [f32; 3],
        /// How it is turned about its origin, degrees: about x, then y, then z.
        #[serde(default, skip_serializing_if = "is_zero")]
        rotation_deg: [f32; 3],
        /// Its scale.
        #[serde(default = "one")]
        scale: f32,
        /// What belongs to a part: vertices up to so far apart, m, in the scene. Without it, what faces connect.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        gap_m: Option<f32>,
    },
}

fn up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

impl WickSource {
    /// A mesh file as it stands.
    pub fn mesh(file: impl Into<PathBuf>) -> Self {
        let (position_m, rotation_deg) = ([0.0; 3], [0.0; 3]);
        Self::Mesh { file: file.into(), group: None, position_m, rotation_deg, scale: 1.0, gap_m: None }
    }

    /// The points that can be moved one by one, if it has any.
    #[must_use]
    pub fn points(&self) -> &[[f32; 3]] {
        match self {
            Self::Polyline { points, .. } | Self::Curve { points, .. } | Self::Points { points, .. } => points,
            Self::Ring { .. } | Self::Mesh { .. } => &[],
        }
    }

    /// The same, to be moved.
    pub fn points_mut(&mut self) -> Option<&mut Vec<[f32; 3]>> {
        match self {
            Self::Polyline { points, .. } | Self::Curve { points, .. } | Self::Points { points, .. } => Some(points),
            Self::Ring { .. } | Self::Mesh { .. } => None,
        }
    }
}

/// The shapes of all wicks of a scene that has been checked, one for each flame (outer: fires).
pub(crate) fn shapes(check: &Check<'_>, scene: &Scene, assets: Assets<'_>) -> Result<Vec<Vec<WickShape>>, SceneError> {
    let mut fires = Vec::with_capacity(scene.fires.len());
    let mut count = 0;
    for (f, fire) in scene.fires.iter().enumerate() {
        let mut shapes = Vec::with_capacity(fire.wicks.len());
        for (w, wick) in fire.wicks.iter().enumerate() {
            let field = format!("fires[{f}].wicks[{w}]");
            let linear = linear_wicks(check, (scene, fire), &field, wick, assets)?;
            count += linear.len() * fire.places().len();
            if count > crate::load::MAX_FLAMES {
                let counted = format!("the number of parts and arcs of all copies of all wicks up to {field}");
                return Err(check.fail(counted, count, format!("at most {}", crate::load::MAX_FLAMES)));
            }
            stays_inside(check, scene, f, &field, &linear)?;
            shapes.extend(linear);
        }
        fires.push(shapes);
    }
    Ok(fires)
}

/// Whether wicks that move stay in the air, looked at in so many moments.
fn stays_inside(
    check: &Check<'_>,
    scene: &Scene,
    fire: usize,
    field: &str,
    wicks: &[WickShape],
) -> Result<(), SceneError> {
    let Some(name) = &scene.fires[fire].motion else { return Ok(()) };
    let Some(motion) = scene.motions.iter().find(|motion| motion.name == *name) else { return Ok(()) };
    let fire = &scene.fires[fire];
    if fire.air.is_some() || scene.air.follows.as_ref() == Some(name) {
        return Ok(());
    }
    let (from_s, to_s) = motion.path.times_s();
    for moment in 0..MOMENTS {
        let time_s = from_s + (to_s - from_s) * f64::from(moment) / f64::from(MOMENTS - 1);
        let pose = motion.path.pose(time_s);
        for shape in wicks {
            let (WickShape::Polyline { points, .. } | WickShape::Vertices(points)) = shape;
            let few = || points.iter().step_by(points.len().div_ceil(64));
            for placed in fire.places().flat_map(|place| few().map(move |point| place.point(*point))) {
                let moved = pose.point(placed.into()).to_array();
                let field = format!("{field} at {time_s:.2} s of its motion");
                crate::validate::inside_air(check, &scene.air, &field, moved)?;
            }
        }
    }
    Ok(())
}

fn linear_wicks(
    check: &Check<'_>,
    (scene, fire): (&Scene, &Fire),
    field: &str,
    wick: &WickSource,
    assets: Assets<'_>,
) -> Result<Vec<WickShape>, SceneError> {
    let line = |points: Vec<[f32; 3]>, radius_m: f32| WickShape::Polyline { points, radius_m };
    let (whole, gap_m) = match wick {
        WickSource::Polyline { points, radius_m } => (vec![line(points.clone(), *radius_m)], None),
        WickSource::Curve { points, radius_m, closed } => {
            let points = curve(points, *closed).map_err(|problem| {
                check.fail(format!("{field}.points"), problem, "points that a cubic can be laid through")
            })?;
            (vec![line(points, *radius_m)], None)
        }
        WickSource::Ring { center_m, ring_m, normal, radius_m } => {
            (vec![line(circle((*center_m).into(), *ring_m, (*normal).into()), *radius_m)], None)
        }
        WickSource::Points { points, radius_m } => {
            (points.iter().map(|point| line(vec![*point], *radius_m)).collect(), None)
        }
        WickSource::Mesh { file, group, position_m, rotation_deg, scale, gap_m } => {
            let placement = Placement { position_m: *position_m, rotation_deg: *rotation_deg, scale: *scale };
            let path = assets.resolve(file);
            let parts = import::wick_parts(&path, group.as_deref(), &placement, gap_m.is_none())?;
            (parts.into_iter().map(WickShape::Vertices).collect(), *gap_m)
        }
    };
    let mut linear = Vec::with_capacity(whole.len());
    for shape in whole {
        let (WickShape::Polyline { points, .. } | WickShape::Vertices(points)) = &shape;
        crate::validate::wick_inside_air(check, &scene.air, fire, field, points)?;
        // What faces connect is one part, however far its vertices are from one another.
        let gap_m = gap_m.unwrap_or_else(|| 2.0 * diagonal(points).max(1e-3));
        let wicks = shape
            .linear_wicks(gap_m)
            .map_err(|fault| check.fail(field, format!("no wick ({fault})"), "a wick that roots can be placed on"))?;
        linear.extend(wicks);
    }
    Ok(linear)
}

fn diagonal(points: &[[f32; 3]]) -> f32 {
    let all = || points.iter().copied().map(Vec3::from);
    all().fold(Vec3::NEG_INFINITY, Vec3::max).distance(all().fold(Vec3::INFINITY, Vec3::min))
}

/// Samples of the cubic through points.
fn curve(points: &[[f32; 3]], closed: bool) -> Result<Vec<[f32; 3]>, String> {
    let mut through = points.to_vec();
    through.dedup();
    let closed = closed && through.len() > 2;
    let count = through.len();
    if count < 2 {
        return Ok(through);
    }
    if closed {
        // Once around, and a few points more on either side.
        let from = (count * LAP - LAP) % count;
        let lap = |i: usize| points_at(&through, from + i);
        through = (0..=count + 2 * LAP).map(lap).collect();
    }
    let spacing = Spacing::ChordLength;
    let parameters = spacing.parameters(&through).map_err(|error| error.to_string())?;
    let degree = 3.min(through.len() - 1);
    let curve = Curve::interpolate(degree, &through, &parameters).map_err(|error| error.to_string())?;
    let inner = if closed { &parameters[LAP..=LAP + count] } else { &parameters[..] };
    let mut samples = Vec::with_capacity(SAMPLES * inner.len());
    for pair in inner.windows(2) {
        for i in 0..SAMPLES {
            let t = pair[0] + (pair[1] - pair[0]) * i as f32 / SAMPLES as f32;
            samples.push(curve.point(t).map_err(|error| error.to_string())?);
        }
    }
    samples.push(if closed { samples[0] } else { through[through.len() - 1] });
    Ok(samples)
}

fn points_at(points: &[[f32; 3]], i: usize) -> [f32; 3] {
    points[i % points.len()]
}

/// A closed polygon around a circle.
fn circle(center: Vec3, ring_m: f32, normal: Vec3) -> Vec<[f32; 3]> {
    let normal = normal.normalize_or(Vec3::Y);
    let (a, b) = normal.any_orthonormal_pair();
    let corner = |i: usize| {
        let (sin, cos) = (std::f32::consts::TAU * (i % CORNERS) as f32 / CORNERS as f32).sin_cos();
        (center + (a * cos + b * sin) * ring_m).to_array()
    };
    (0..=CORNERS).map(corner).collect()
}
