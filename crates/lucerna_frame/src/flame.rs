//! Flame surfaces and how their inside glows.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

/// One vertex of a closed flame surface.
///
/// The surface only says where burning gas begins and ends; its normal points out of the gas.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct FlameVertex {
    /// World position in metres.
    pub position: [f32; 3],
    /// Height within the flame, 0 at the root and 1 at the tip.
    pub height: f32,
    /// Unit normal, pointing out of the flame.
    pub normal: [f32; 3],
    /// Local radius of the flame in metres (half its thickness at this height).
    pub radius_m: f32,
    /// Texture coordinates: once around the flame in u, from root (0) to tip (1) in v.
    pub uv: [f32; 2],
    /// Index of the flame in [`Frame::flame_shades`](crate::Frame::flame_shades).
    pub flame: u32,
    /// Unused; keeps the vertex at 48 bytes.
    pub padding: u32,
}

/// The part of the vertex and index buffers that one flame uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FlameDraw {
    /// First vertex; indices are relative to it.
    pub first_vertex: u32,
    /// Number of vertices.
    pub vertex_count: u32,
    /// First index.
    pub first_index: u32,
    /// Number of indices, a multiple of three.
    pub index_count: u32,
}

/// How one flame is shaded. Heights are fractions of the flame's own height.
///
/// In `volume` shading the gas at the relative radius q has the density `1 - q^2`, times what the
/// fields below say about height, and glows like a thin black body.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FlameShade {
    /// Linear colour multiplier of the whole flame; default white. In `shell` shading it tints the texture.
    pub tint: [f32; 3],
    /// Extinction of the soot at full density, 1/m. Small flames are optically thin (candle: 8), a
    /// campfire is not. Raising it makes the flame brighter and, when large, opaque.
    pub soot_per_m: f32,
    /// Temperature of the soot, K (1400 to 1900 physically; up to 3200 artistically).
    pub temperature_k: f32,
    /// Height at which soot begins.
    pub soot_begin: f32,
    /// Height at which soot has reached its full density.
    pub soot_full: f32,
    /// Length of the tip over which soot burns out.
    pub tip_fade: f32,
    /// Emission of the blue zone (CH and C2) at the base, 1/m; 0 for none.
    pub blue_per_m: f32,
    /// Height at which the blue zone ends.
    pub blue_end: f32,
    /// Relative radius of the dark cone of unburnt vapour over the wick at the root; 0 for none.
    pub dark_radius: f32,
    /// Height at which the dark cone closes.
    pub dark_end: f32,
    /// How much noise eats into the gas: 0 smooth (candle), 1 ragged.
    pub noise_amount: f32,
    /// Spatial frequency of the noise, 1/m.
    pub noise_per_m: f32,
    /// Speed at which the noise rises, m/s.
    pub noise_rise_m_s: f32,
    /// Strength as a whole, 0 to 1: free flames burn out through it.
    pub strength: f32,
}

impl Default for FlameShade {
    fn default() -> Self {
        Self {
            tint: [1.0; 3],
            soot_per_m: 8.0,
            temperature_k: 1800.0,
            soot_begin: 0.13,
            soot_full: 0.43,
            tip_fade: 0.22,
            blue_per_m: 0.8,
            blue_end: 0.30,
            dark_radius: 0.62,
            dark_end: 0.52,
            noise_amount: 0.0,
            noise_per_m: 10.0,
            noise_rise_m_s: 1.0,
            strength: 1.0,
        }
    }
}
