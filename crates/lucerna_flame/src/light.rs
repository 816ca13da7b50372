//! The light of a flame: what its luminous volume radiates, as a few point lights.
//!
//! The gas at the relative radius q has the density 1 - q^2, so a slab of cross-section A holds
//! A / 2 of it per length; times the soot's extinction and the black body's radiance this is radiant
//! intensity. Thick flames hide a part of themselves: (1 - e^-tau) / tau gets out.

use crate::section::Section;
use glam::Vec3;
use lucerna_frame::{FlameShade, Light};

/// Lights of a group of flames, from root to tip: enough that each part lights what is near it, not only the middle.
pub(crate) const LIGHTS: usize = 3;

/// The luminous volume of one part of a group, gathered surface by surface.
#[derive(Clone, Copy, Debug, Default)]
struct Part {
    /// Radiant intensity of the black body's luminance 1, and its moments about the group's centre.
    power: f32,
    first: Vec3,
    second: f32,
    color: Vec3,
}

/// Flames over overlapping wicks, which light the scene as one: their light is the sum of theirs, and it costs the
/// renderer no more than that of a single flame.
#[derive(Clone, Debug)]
pub(crate) struct LightGroup {
    /// Middle and length of the group's first wick, m.
    center: Vec3,
    length_m: f32,
    parts: [Part; LIGHTS],
}

impl LightGroup {
    pub(crate) fn new(center: Vec3, length_m: f32) -> Self {
        Self { center, length_m, parts: Default::default() }
    }

    /// True if a wick with this middle and length overlaps the group's first, or lies about a length from it: flames
    /// merge where they are a few times as high as they are apart.
    pub(crate) fn takes(&self, center: Vec3, length_m: f32) -> bool {
        center.distance(self.center) < self.length_m + length_m
    }

    /// Starts anew.
    pub(crate) fn clear(&mut self) {
        self.parts = Default::default();
    }

    fn add(&mut self, part: usize, power: f32, position: Vec3, radius_m: f32, color: Vec3) {
        let from_center = position - self.center;
        let part = &mut self.parts[part];
        part.power += power;
        part.first += from_center * power;
        part.second += (from_center.length_squared() + radius_m * radius_m) * power;
        part.color += color * power;
    }

    /// The parts that shine, each with its number.
    fn bright(&self) -> impl Iterator<Item = (usize, &Part)> {
        self.parts.iter().enumerate().filter(|(_, part)| part.power > 1e-12)
    }

    /// The numbers of the parts that [`lights`](Self::lights) stand for.
    pub(crate) fn bright_parts(&self) -> impl Iterator<Item = usize> + '_ {
        self.bright().map(|(number, _)| number)
    }

    /// Up to three lights; dark parts are left out.
    pub(crate) fn lights(&self) -> impl Iterator<Item = Light> + '_ {
        self.bright().map(|(_, part)| {
            let mean = part.first / part.power;
            // How far the gas lies from the light that stands for it.
            let spread = (part.second / part.power - mean.length_squared()).max(0.0).sqrt();
            Light {
                position: (self.center + mean).to_array(),
                radius_m: spread.max(1e-4),
                intensity: part.color.to_array(),
            }
        })
    }
}

/// Soot at a height, 0 to 1, as `FlameShade` describes it.
fn soot(shade: &FlameShade, height: f32) -> f32 {
    let t = ((height - shade.soot_begin) / (shade.soot_full - shade.soot_begin).max(1e-4)).clamp(0.0, 1.0);
    let tip = ((1.0 - height) / shade.tip_fade.max(1e-4)).clamp(0.0, 1.0).powf(0.6);
    t * t * (3.0 - 2.0 * t) * tip
}

/// What one flame gives off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlameLight {
    /// Whether it is lit; one that was put out fades for a while.
    pub lit: bool,
    /// Volume of the gas that is drawn, m^3, its free flames included.
    pub volume_m3: f32,
    /// Heat radiated, W: the fuel's radiated share of what is let in. None with root forces, which have no heat in
    /// kilowatts.
    pub radiated_w: Option<f32>,
    /// Where the light comes from on average, m; the middle of the wick where it is dark.
    pub centroid: [f32; 3],
    /// Radiant intensity, the same in all directions, linear and scene-referred: as [`Light::intensity`].
    pub intensity: [f32; 3],
}

/// What one flame gives off, gathered surface by surface.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OwnLight {
    /// The middle of the wick, about which moments are taken.
    from: Vec3,
    volume_m3: f32,
    power: f32,
    first: Vec3,
    color: Vec3,
}

impl OwnLight {
    pub(crate) fn new(from: Vec3) -> Self {
        Self { from, ..Self::default() }
    }

    pub(crate) fn finish(self, lit: bool, radiated_w: Option<f32>) -> FlameLight {
        let centroid = if self.power > 1e-12 { self.from + self.first / self.power } else { self.from };
        FlameLight {
            lit,
            volume_m3: self.volume_m3,
            radiated_w,
            centroid: centroid.to_array(),
            intensity: self.color.to_array(),
        }
    }
}

/// Adds the light of one surface, cut from tip to root, to its group and to its flame's own; that of a free flame
/// goes to the group's tip. `body` is the black body's colour at the soot's temperature.
pub(crate) fn add_light(
    sections: &[Section],
    shade: &FlameShade,
    body: Vec3,
    is_free: bool,
    group: &mut LightGroup,
    own: &mut OwnLight,
) {
    let color = body * Vec3::from(shade.tint) * shade.strength;
    for pair in sections.windows(2) {
        let (above, below) = (&pair[0], &pair[1]);
        let volume = (0.5 * (above.area + below.area)).dot(below.middle - above.middle).max(0.0);
        let height = 0.5 * (above.height + below.height);
        let radius = 0.5 * (above.radius_m + below.radius_m);
        let extinction = shade.soot_per_m * soot(shade, height);
        let tau = (extinction * radius).max(1e-6);
        let power = 0.5 * volume * extinction * (-tau).exp_m1() / -tau;
        let part = if is_free { LIGHTS - 1 } else { ((height * LIGHTS as f32) as usize).min(LIGHTS - 1) };
        let middle = 0.5 * (above.middle + below.middle);
        group.add(part, power, middle, radius, color);
        own.volume_m3 += volume;
        own.power += power;
        own.first += (middle - own.from) * power;
        own.color += color * power;
    }
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

    #[test]
    fn a_group_shines_as_its_flames_do_together() {
        let mut group = LightGroup::new(Vec3::new(100.0, 0.0, 0.0), 0.3);
        assert!(group.takes(Vec3::new(100.2, 0.0, 0.0), 0.1) && !group.takes(Vec3::new(100.5, 0.0, 0.0), 0.1));
        for (x, power) in [(99.9, 1.0), (100.1, 3.0)] {
            group.add(0, power, Vec3::new(x, 0.2, 0.0), 0.0, Vec3::ONE);
        }
        let lights: Vec<_> = group.lights().collect();
        assert_eq!(lights.len(), 1);
        assert_eq!(lights[0].intensity, [4.0; 3]);
        assert!(Vec3::from(lights[0].position).distance(Vec3::new(100.05, 0.2, 0.0)) < 1e-4);
        // One and three parts, 0.2 m apart: a standard deviation of 0.2 sqrt(3) / 4.
        assert!((lights[0].radius_m - 0.2 * 3.0_f32.sqrt() / 4.0).abs() < 1e-3, "{}", lights[0].radius_m);
    }
}
