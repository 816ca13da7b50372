//! What Lucerna draws in one frame, as plain data.
//!
//! The simulation fills a [`Frame`] and the renderer draws it; neither knows the other. Anybody who
//! has flames of their own can fill a [`Frame`] too and use the renderer alone.
//!
//! Units are SI (metres, seconds, kelvin), colours are linear and scene-referred, `y` points up and
//! the coordinate system is right-handed.

mod camera;
mod color;
mod flame;
mod look;
mod nets;
mod scene;

pub use camera::Camera;
pub use color::{adaptation, blackbody_chromaticity, blackbody_rgb, unit_luminance_cd_m2};
pub use flame::{FlameDraw, FlameShade, FlameVertex};
pub use look::{Blur, DebugView, GlowLevel, Look, Shading, ToneMap, Transparency};
pub use nets::{FlameGrid, FlameNet, FlameNets};
pub use scene::{Light, LineVertex, MeshVertex, OpaqueMesh};

/// Everything that is drawn in one frame, borrowed from whoever owns it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Frame<'a> {
    /// Simulated time in seconds; it moves the noise inside large flames.
    pub time_s: f32,
    /// The vertices of all flame surfaces, one after the other.
    pub flame_vertices: &'a [FlameVertex],
    /// Triangle indices, relative to each flame's first vertex; flames may share a range.
    pub flame_indices: &'a [u32],
    /// One entry a flame: which vertices and indices it has.
    pub flame_draws: &'a [FlameDraw],
    /// The control nets that the renderer is to make the vertices from. Then `flame_vertices` is empty, and
    /// `flame_draws` count the vertices to be made.
    pub flame_nets: Option<FlameNets<'a>>,
    /// How each flame is shaded, in the order of `flame_draws`.
    pub flame_shades: &'a [FlameShade],
    /// The point lights that stand for the flames' luminous volumes.
    pub lights: &'a [Light],
    /// The opaque scene.
    pub meshes: &'a [OpaqueMesh],
    /// Changes whenever `meshes` does, so that they are uploaded only then.
    pub mesh_revision: u64,
    /// Line segments drawn over the picture (two vertices each), for debugging.
    pub lines: &'a [LineVertex],
}
