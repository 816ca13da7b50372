//! What a user says about a fire: wicks, fuel, skeletons, surface. All of it is plain data with serde.

use crate::{Drive, Life};
use serde::{Deserialize, Serialize};

/// The shape of a wick: where fuel comes from (paper 003, section 4.1).
///
/// Wicks from files are read by `lucerna_scene`, which hands over the vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum WickShape {
    /// A centreline through two or more points (one point: a candle's wick) with a radius, in metres.
    Polyline {
        /// World positions in metres.
        points: Vec<[f32; 3]>,
        /// Radius in metres, above 0.
        radius_m: f32,
    },
    /// The vertices of a mesh in world space.
    Vertices(Vec<[f32; 3]>),
}

/// How fuel is spread along the wick: F(u) with u in -1..1 and maximum 1 (paper 003, section 4.2).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FuelDistribution {
    /// The same everywhere.
    Uniform,
    /// (1 + u) / 2.
    Linear,
    /// |u|.
    Bilinear,
    /// e^(u - 1).
    Exponential,
    /// e^(-u^2).
    #[default]
    Gaussian,
    /// A random number in 0..1 for each lead root, drawn once from the seed.
    Random,
    /// The user's own: samples at equal distances of u from -1 to 1, joined by straight lines; at least two.
    Table(Vec<f32>),
}

/// Which form of the fuel functions is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FuelForm {
    /// Maximum 1, so that the strength alone scales the height.
    #[default]
    Normalised,
    /// The forms that the authors of paper 003 run: u + 1, u^2, e^u, (10/9) e^(-u^2).
    Published,
}

/// The swinging term `F_ext` of paper 003, equation 2, as a fraction of the strength.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Swing {
    /// None.
    #[default]
    Still,
    /// A sine.
    Periodic {
        /// Fraction of the strength, 0 or more.
        amplitude: f32,
        /// Hertz.
        frequency_hz: f32,
    },
    /// Smooth noise in several octaves, different for each lead root.
    Noise {
        /// Fraction of the strength, 0 or more.
        amplitude: f32,
        /// Hertz of the lowest octave.
        frequency_hz: f32,
    },
    /// A new random value every step.
    Random {
        /// Fraction of the strength, 0 or more.
        amplitude: f32,
    },
}

/// What burns on a wick and how strongly it drives the air.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Fuel {
    /// F(u).
    pub distribution: FuelDistribution,
    /// Which form of F.
    pub form: FuelForm,
    /// C: vertical acceleration that a root gives to the air around it, m/s^2, fading linearly to zero at twice
    /// [`Skeletons::width_m`] along each axis. Raising it makes flames higher.
    pub strength_m_s2: f32,
    /// `F_ext`.
    pub swing: Swing,
    /// Heating of the air at each lead root, K/s; it rises by buoyancy and makes flames neck and roll. As
    /// [`strength_m_s2`](Self::strength_m_s2), it counts with [`Drive::RootForces`] only.
    pub heat_k_s: f32,
}

impl Default for Fuel {
    fn default() -> Self {
        Self {
            distribution: FuelDistribution::default(),
            form: FuelForm::default(),
            strength_m_s2: 10.0,
            swing: Swing::Still,
            heat_k_s: 25_000.0,
        }
    }
}

/// The particle chains that carry a flame (paper 003, sections 3 and 4.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Skeletons {
    /// Slices of the wick `n_l`, 1 to 64; a flame has `n_l + 2` lead and `2 n_l + 6` peripheral skeletons.
    pub slices: u32,
    /// Control points along each peripheral skeleton, 3 to 32 (paper: below 9).
    pub particles: u32,
    /// Life of a lead particle, s; longer than the peripheral life, it makes the pointed tip.
    pub lead_life_s: f32,
    /// Life of a peripheral particle, s.
    pub peripheral_life_s: f32,
    /// Distance of the peripheral roots from the wick's centreline, m.
    pub width_m: f32,
    /// Speed at which young peripheral particles are pushed outwards by the expanding gas, m/s.
    pub expansion_m_s: f32,
    /// How far roots sway with the air: rest + factor x velocity, s (lead roots; x, y, z).
    pub lead_sway_s: [f32; 3],
    /// The same for peripheral roots.
    pub peripheral_sway_s: [f32; 3],
    /// Tips that break away: expected number per second and flame, 0 for none.
    pub shed_per_s: f32,
    /// Life of a free flame, s.
    pub free_life_s: f32,
    /// How far old peripheral control points are drawn in to the lead skeleton, 0 (the published chains) to 1:
    /// fuel burns up, and the sheet of flame closes in on it. Raising it makes slender, pointed tongues.
    pub taper: f32,
    /// Speed of eddies finer than the air's grid, m/s; 0 for none. Raising it makes flames lick and neck.
    pub turbulence_m_s: f32,
    /// Size of these eddies, m; about the width of a tongue.
    pub turbulence_m: f32,
}

impl Default for Skeletons {
    fn default() -> Self {
        Self {
            slices: 2,
            particles: 8,
            lead_life_s: 0.1,
            peripheral_life_s: 0.097,
            width_m: 0.0026,
            expansion_m_s: 0.13,
            lead_sway_s: [0.0; 3],
            peripheral_sway_s: [0.0; 3],
            shed_per_s: 0.0,
            free_life_s: 0.15,
            taper: 0.66,
            turbulence_m_s: 0.0,
            turbulence_m: 0.02,
        }
    }
}

impl Skeletons {
    /// Time in which the expansion of young gas dies away, s.
    pub(crate) fn expansion_s(&self) -> f32 {
        0.5 * self.peripheral_life_s
    }
}

/// The NURBS surface over the skeletons.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SurfaceGrid {
    /// Samples around the flame, 4 to 256, even.
    pub around: u32,
    /// Samples from root to tip, 3 to 256.
    pub up: u32,
    /// How far the first interior knot upwards is raised, 0 to 1 of a knot interval: softens the tip (authors: 0.9).
    pub tip_softness: f32,
}

impl Default for SurfaceGrid {
    fn default() -> Self {
        Self { around: 32, up: 24, tip_softness: 0.9 }
    }
}

/// One flame: a wick and everything said about it.
#[derive(Clone, Debug, PartialEq)]
pub struct FlameSettings {
    /// The wick's shape.
    pub wick: WickShape,
    /// How it drives the air.
    pub drive: Drive,
    /// How fuel is spread along the wick; how strong root forces are.
    pub fuel: Fuel,
    /// How it begins and ends.
    pub life: Life,
    /// The particle chains.
    pub skeletons: Skeletons,
    /// The surface.
    pub surface: SurfaceGrid,
    /// How it glows.
    pub shade: lucerna_frame::FlameShade,
    /// Which of the airs it burns in, where there are several.
    pub air: usize,
}

impl FlameSettings {
    /// A flame on this wick, everything else by default.
    #[must_use]
    pub fn new(wick: WickShape) -> Self {
        Self {
            wick,
            drive: Drive::default(),
            fuel: Fuel::default(),
            life: Life::default(),
            skeletons: Skeletons::default(),
            surface: SurfaceGrid::default(),
            shade: lucerna_frame::FlameShade::default(),
            air: 0,
        }
    }
}
