//! Wicks as they look: charred tubes along their lines, whose tips glow.

use super::Centreline;
use crate::random::hash;
use crate::{FlameError, WickShape};
use glam::{Quat, Vec3};
use lucerna_frame::{MeshVertex, OpaqueMesh, adaptation, blackbody_rgb};
use serde::{Deserialize, Serialize};

/// Vertices around a wick.
const SIDES: usize = 8;
/// Rings along it at least: the glow fades over some of them.
const RINGS: usize = 16;
/// A wick that rises by more than this share of its length has a tip.
const STEEP: f32 = 0.35;
/// Part of a wick with a tip that is not charred, and the part at the tip that glows.
const FRESH: f32 = 0.3;
const GLOWING: f32 = 0.25;
/// Colour of the part that is not charred: braided cotton, stained by wax or oil.
const COTTON: Vec3 = Vec3::new(0.28, 0.24, 0.17);

/// How the wick of a fire looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WickLook {
    /// Whether it is drawn.
    pub shown: bool,
    /// Radius of the tube, m; the wick's own where nothing is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f32>,
    /// Linear base colour of what is charred, 0 to 1 each.
    pub char_color: [f32; 3],
    /// Temperature of the glowing tip while it burns, K, 500 to 3000.
    pub tip_k: f32,
}

impl Default for WickLook {
    fn default() -> Self {
        Self { shown: false, radius_m: None, char_color: [0.022, 0.019, 0.017], tip_k: 1280.0 }
    }
}

impl WickShape {
    /// The wick as an opaque mesh: a tube with round ends, for a camera whose white is `white_k`. A wick that rises
    /// glows at its tip, one that lies glows in specks. A mesh that is point-like has no line, and no tube.
    ///
    /// # Errors
    /// As [`centreline`](Self::centreline).
    pub fn tube(&self, look: &WickLook, white_k: f32) -> Result<OpaqueMesh, FlameError> {
        let centreline = self.centreline()?;
        let (mut line, own_m) = match self {
            Self::Polyline { points, radius_m } => (points.iter().copied().map(Vec3::from).collect(), *radius_m),
            Self::Vertices(_) => match centreline {
                Centreline::Line(line) => (line, 0.0),
                Centreline::Point(_) => (Vec::new(), 0.0),
            },
        };
        line.dedup_by(|a, b| a.distance(*b) < 1e-6);
        let radius_m = look.radius_m.unwrap_or(own_m);
        let [first, .., last] = line[..] else { return Ok(OpaqueMesh::default()) };
        if radius_m <= 0.0 {
            return Ok(OpaqueMesh::default());
        }
        if last.y < first.y {
            line.reverse();
        }
        let length: f32 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
        let has_tip = (last.y - first.y).abs() > STEEP * length;
        let glow = (adaptation(white_k) * blackbody_rgb(look.tip_k)).max(Vec3::ZERO);
        let charred = Vec3::from(look.char_color);
        let mut tube = OpaqueMesh::default();
        let rings = RINGS.max(2 * line.len());
        let mut side = None;
        let mut before = Vec3::ZERO;
        for ring in 0..=rings {
            let s = ring as f32 / rings as f32;
            let (center, way) = super::along(&line, s);
            // The side turns only as the line bends.
            let across = match side {
                None => way.any_orthonormal_vector(),
                Some(side) => Quat::from_rotation_arc(before, way) * side,
            };
            (side, before) = (Some(across), way);
            // Rounded off over the last radius.
            let from_end = (s.min(1.0 - s) * length / radius_m).min(1.0);
            let round = (1.0 - (1.0 - from_end) * (1.0 - from_end)).max(0.0).sqrt().max(0.02);
            let out = way.cross(across);
            for k in 0..SIDES {
                let (sin, cos) = (std::f32::consts::TAU * k as f32 / SIDES as f32).sin_cos();
                let speck = (hash((ring * SIDES + k) as u64) >> 40) as f32 / (1_u64 << 24) as f32;
                let normal = across * cos + out * sin;
                let lit = match has_tip {
                    true => ((s - 1.0 + GLOWING) / GLOWING).max(0.0) * (0.5 + 0.5 * speck),
                    false => 0.4 * ((speck - 0.75) / 0.25).max(0.0),
                };
                let fresh = if has_tip { ((FRESH - s) / FRESH).max(0.0) } else { 0.0 };
                let tangent = if s < 0.5 { -way } else { way };
                tube.vertices.push(MeshVertex {
                    position: (center + normal * (radius_m * round * (0.9 + 0.2 * speck))).into(),
                    normal: (normal * from_end + tangent * (1.0 - from_end)).normalize_or(normal).into(),
                    color: charred.lerp(COTTON, fresh).into(),
                    emission: (glow * lit).into(),
                    translucency: 0.0,
                });
            }
        }
        for ring in 0..rings {
            for k in 0..SIDES {
                let at = |ring: usize, k: usize| (ring * SIDES + k % SIDES) as u32;
                let (a, b, c, d) = (at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1));
                tube.indices.extend([a, b, c, b, d, c]);
            }
        }
        Ok(tube)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(mesh: &OpaqueMesh) -> f32 {
        let at = |i: u32| Vec3::from(mesh.vertices[i as usize].position);
        mesh.indices.as_chunks::<3>().0.iter().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c)))).sum::<f32>() / 6.0
    }

    #[test]
    fn a_tube_is_as_thick_as_its_wick_and_right_side_out() {
        let points = vec![[0.0, 0.0, 0.0], [0.01, 0.04, 0.0], [0.0, 0.1, 0.03]];
        let wick = WickShape::Polyline { points, radius_m: 0.002 };
        let tube = wick.tube(&WickLook::default(), 3200.0).expect("a tube");
        let expected = std::f32::consts::PI * 0.002 * 0.002 * (0.04123 + 0.06782);
        println!("volume {:.2e} m^3, of a cylinder {expected:.2e}", volume(&tube));
        assert!((volume(&tube) / expected - 1.0).abs() < 0.2);
        let tip = tube.vertices.iter().map(|v| v.position[1]).fold(0.0, f32::max);
        for vertex in &tube.vertices {
            let is_tip = vertex.position[1] > 0.08;
            assert!((vertex.emission[0] > 0.0) == is_tip || (tip - vertex.position[1]) > 0.01, "{vertex:?}");
            assert!(Vec3::from(vertex.normal).is_normalized());
        }
    }

    #[test]
    fn points_and_blobs_have_no_tube() {
        for wick in [
            WickShape::Polyline { points: vec![[0.0; 3]], radius_m: 0.01 },
            WickShape::Vertices(vec![[0.0; 3], [0.0, 0.01, 0.0]]),
        ] {
            assert!(wick.tube(&WickLook::default(), 3200.0).expect("none").vertices.is_empty());
        }
    }
}
