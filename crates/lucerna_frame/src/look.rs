//! How the picture is made: shading, layers, glow, exposure.

use serde::{Deserialize, Serialize};

/// What a flame's pixels are made from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shading {
    /// A texture on the surface, layers added (paper 003, section 5).
    Shell,
    /// Emission along the part of the ray inside each flame.
    #[default]
    Volume,
}

/// How overlapping flame surfaces are gathered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Transparency {
    /// Exact depth peeling: the nearest `layers` surfaces of every pixel, in order.
    #[default]
    Peeled,
    /// One additive pass in any order: all surfaces, `shell` shading only.
    Unsorted,
}

/// The curve from scene light to display light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToneMap {
    /// Rolls off brightness while keeping the hue of flames.
    #[default]
    Filmic,
    /// Clips at one.
    None,
}

/// Which target the picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DebugView {
    /// The finished picture.
    #[default]
    Final,
    /// One peeled layer (0 is the nearest), as height and facing.
    Layer(u32),
    /// How many surfaces lie behind each pixel.
    LayerCount,
    /// The flames before any blur.
    Flames,
    /// One blurred image (index into [`Look::glow`]).
    Glow(u32),
    /// The opaque scene without flames.
    Opaque,
}

/// The Gaussian of one blurred copy of the flames. It reaches 63 texels of the copy at most, so that standard deviations
/// above 21 are cut to 21.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Blur {
    /// Standard deviation as a fraction of the picture's height: the same look at every size.
    Height(f32),
    /// Standard deviation in pixels of the blurred image.
    Pixels(f32),
    /// Seven taps of `exp(-x^2 / 1.5^2)`, normalised: what paper 003's authors run.
    Published,
}

/// One blurred copy of the flames, added to the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GlowLevel {
    /// Size of the blurred image: 1 full, 4 a quarter, 16 a sixteenth of the picture's width and height.
    pub divisor: u32,
    /// The Gaussian.
    pub blur: Blur,
    /// Share of the light that goes into this image; gains that add to 1 keep the energy. (For `shell` shading they are
    /// divided by their sum.)
    pub gain: f32,
}

/// How the picture is made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Look {
    /// `shell` or `volume`.
    pub shading: Shading,
    /// `peeled` or `unsorted`.
    pub transparency: Transparency,
    /// Number of depth layers peeled, 1 to 32. More layers show more overlapping flames and cost a pass each.
    pub layers: u32,
    /// The blurred copies, at most four, the sharpest first: it also says how much of the scene the soot hides. The
    /// flames themselves are not shown (paper 003, section 5.2).
    pub glow: Vec<GlowLevel>,
    /// Exposure in stops: +1 doubles the brightness of the scene and of `volume` flames; `shell` flames are painted for
    /// the display.
    pub exposure_stops: f32,
    /// The colour temperature that appears white, K.
    pub white_k: f32,
    /// Artistic gain of the light that flames throw on the scene; 1 is physical.
    pub light_gain: f32,
    /// How many lights cast shadows, 0 to 32: the strongest as seen. Each takes a map of six faces.
    pub shadows: u32,
    /// Texels across a face of a shadow map, 16 to 1024; times `shadows` at most 8192.
    pub shadow_size: u32,
    /// Taps of the filters of shadows, 1 to 64, which the lights of a pixel share by how much they light it: more make soft
    /// edges smoother.
    pub shadow_samples: u32,
    /// How large a group of lights may be, seen from what it lights, to count as one light: an angle in radians, 0 to 1.
    /// 0 adds up every light by itself; up to 16 lights are never merged.
    pub light_merging: f32,
    /// Light that falls on the scene from everywhere, linear.
    pub ambient: [f32; 3],
    /// Colour behind everything, linear.
    pub background: [f32; 3],
    /// The curve from scene light to display light.
    pub tone_map: ToneMap,
    /// Samples per pixel on opaque edges, 1 or 4.
    pub samples: u32,
    /// Steps of the integration inside each interval in `volume` shading, 2 to 32.
    pub volume_steps: u32,
    /// How far `shell` surfaces fade where they turn away from the eye, 0 (paper 003) to 1.
    pub shell_softness: f32,
    /// Which target is shown.
    pub debug: DebugView,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            shading: Shading::Volume,
            transparency: Transparency::Peeled,
            layers: 8,
            glow: vec![
                GlowLevel { divisor: 1, blur: Blur::Height(1.2 / 720.0), gain: 0.80 },
                GlowLevel { divisor: 4, blur: Blur::Height(0.017), gain: 0.13 },
                GlowLevel { divisor: 16, blur: Blur::Height(0.075), gain: 0.07 },
            ],
            exposure_stops: 4.0,
            white_k: 3200.0,
            light_gain: 1.0,
            shadows: 8,
            shadow_size: 512,
            shadow_samples: 16,
            light_merging: 0.07,
            ambient: [0.0; 3],
            background: [0.0; 3],
            tone_map: ToneMap::Filmic,
            samples: 4,
            volume_steps: 8,
            shell_softness: 0.8,
            debug: DebugView::Final,
        }
    }
}
