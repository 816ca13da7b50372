//! The light of a flame: what its luminous volume radiates, as a few point lights.
//!
//! The gas at the relative radius q has the density 1 - q^2, so a slab of cross-section A holds
//! A / 2 of it per length; times the soot's extinction and the black body's radiance this is radiant
//! intensity. Thick flames hide a part of themselves: (1 - e^-tau) / tau gets out.

use crate::surface::{Surface, SurfacePlan};
use glam::Vec3;
use lucerna_frame::{FlameShade, Light};

/// Lights of an attached flame: enough that shadows follow its parts, not only its middle.
pub(crate) const LIGHTS: usize = 3;

/// Soot at a height, 0 to 1, as `FlameShade` describes it.
fn soot(shade: &FlameShade, height: f32) -> f32 {
    let t = ((height - shade.soot_begin) / (shade.soot_full - shade.soot_begin).max(1e-4)).clamp(0.0, 1.0);
    let tip = ((1.0 - height) / shade.tip_fade.max(1e-4)).clamp(0.0, 1.0).powf(0.6);
    t * t * (3.0 - 2.0 * t) * tip
}

/// Adds the lights of one surface. `body` is the black body's colour at the soot's temperature.
pub(crate) fn add_lights(
    surface: &Surface,
    plan: &SurfacePlan,
    shade: &FlameShade,
    body: Vec3,
    count: usize,
    out: &mut Vec<Light>,
) {
    let mut sums = [(0.0_f32, Vec3::ZERO, 0.0_f32); LIGHTS];
    let count = count.clamp(1, LIGHTS);
    let up = plan.key.up;
    let mut above = section(surface, plan, 0);
    for ring in 1..=up {
        let below = section(surface, plan, ring);
        // Rings run clockwise seen from above, so their area vectors point down, as the rings follow each other.
        let volume = (0.5 * (above.1 + below.1)).dot(below.0 - above.0).max(0.0);
        let height = 0.5 * (surface.rings[ring - 1][0] + surface.rings[ring][0]);
        let radius = 0.5 * (surface.rings[ring - 1][1] + surface.rings[ring][1]);
        let extinction = shade.soot_per_m * soot(shade, height);
        let tau = (extinction * radius).max(1e-6);
        let power = 0.5 * volume * extinction * (-tau).exp_m1() / -tau;
        let part = ((height * count as f32) as usize).min(count - 1);
        let sum = &mut sums[part];
        *sum = (sum.0 + power, sum.1 + 0.5 * (above.0 + below.0) * power, sum.2 + radius * power);
        above = below;
    }
    let color = body * Vec3::from(shade.tint) * shade.strength;
    for (power, position, radius) in &sums[..count] {
        if *power > 1e-12 {
            out.push(Light {
                position: (*position / *power).to_array(),
                radius_m: (radius / power).max(1e-4),
                intensity: (color * *power).to_array(),
            });
        }
    }
}

/// The mean point and the area vector of a ring of vertices.
fn section(surface: &Surface, plan: &SurfacePlan, ring: usize) -> (Vec3, Vec3) {
    let ring = &surface.vertices[plan.ring(ring)];
    // The last vertex repeats the first.
    let once = &ring[1..];
    let middle = once.iter().map(|v| Vec3::from(v.position)).sum::<Vec3>() / once.len() as f32;
    let twice = ring.windows(2).map(|w| (Vec3::from(w[0].position) - middle).cross(Vec3::from(w[1].position) - middle));
    (middle, 0.5 * twice.sum::<Vec3>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn soot_grows_above_the_blue_zone_and_burns_out_at_the_tip() {
        let shade = FlameShade::default();
        assert_eq!((soot(&shade, 0.0), soot(&shade, 0.13), soot(&shade, 0.6), soot(&shade, 1.0)), (0.0, 0.0, 1.0, 0.0));
        assert!((soot(&shade, 0.28) - 0.5).abs() < 1e-3);
    }
}
