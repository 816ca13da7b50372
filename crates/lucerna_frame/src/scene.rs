//! The opaque scene and the light that falls on it.

use bytemuck::{Pod, Zeroable};

/// A point light that stands for a part of a flame's luminous volume.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light {
    /// World position in metres.
    pub position: [f32; 3],
    /// Radius of the volume that it stands for, in metres; light does not grow without bound inside it.
    pub radius_m: f32,
    /// Linear radiant intensity per colour channel, in the unit of the flames' own radiance times m^2.
    pub intensity: [f32; 3],
}

/// One vertex of the opaque scene.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct MeshVertex {
    /// World position in metres.
    pub position: [f32; 3],
    /// Unit normal.
    pub normal: [f32; 3],
    /// Linear base colour (albedo), 0 to 1.
    pub color: [f32; 3],
    /// Linear radiance that the surface emits by itself (glowing coals, a wick's tip), as the camera sees it.
    pub emission: [f32; 3],
    /// Share of the light that goes on under the surface and comes out beside and behind, 0 (stone) to 1 (wax).
    pub translucency: f32,
}

/// An opaque triangle mesh in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OpaqueMesh {
    /// Vertices.
    pub vertices: Vec<MeshVertex>,
    /// Triangle indices into `vertices`, counter-clockwise seen from outside.
    pub indices: Vec<u32>,
}

/// One end of a debug line.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct LineVertex {
    /// World position in metres.
    pub position: [f32; 3],
    /// Display-referred colour, linear.
    pub color: [f32; 3],
}
