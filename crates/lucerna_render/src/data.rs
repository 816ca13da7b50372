//! What goes to the GPU, laid out as the shaders read it.

use crate::light_cells::LightCells;
use crate::light_tree::Node;
use crate::shadows::Shadows;
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3};
use lucerna_frame::{Camera, FlameShade, Frame, Light, Look, Shading, ToneMap, adaptation, blackbody_rgb};

/// Most layers that can be peeled.
pub(crate) const MAX_LAYERS: u32 = 32;
/// Most blurred copies.
pub(crate) const MAX_GLOW: usize = 4;
/// Taps of a blur on each side of the centre, the centre included.
pub(crate) const MAX_TAPS: usize = 64;

/// What a target stores, as `common.wgsl` numbers it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Storage {
    /// Linear light, which the target encodes as sRGB by itself.
    Encodes = 0,
    /// sRGB that the shader encodes.
    Encoded = 1,
    /// Plain linear numbers.
    Linear = 2,
}

impl Storage {
    pub(crate) fn of(format: wgpu::TextureFormat) -> Self {
        use wgpu::TextureFormat::{Rg11b10Ufloat, Rgba16Float, Rgba32Float};
        match format {
            Rg11b10Ufloat | Rgba16Float | Rgba32Float => Self::Linear,
            _ if format.is_srgb() => Self::Encodes,
            _ => Self::Encoded,
        }
    }
}

/// `View` in `common.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct View {
    clip_from_world: [[f32; 4]; 4],
    world_from_clip: [[f32; 4]; 4],
    adapt: [[f32; 4]; 3],
    eye_time: [f32; 4],
    forward_near: [f32; 4],
    ambient_gain: [f32; 4],
    background_exposure: [f32; 4],
    size_layers: [u32; 4],
    modes: [u32; 4],
    extra: [f32; 4],
}

/// Light of a shell texel at full brightness, as displayed: shells are painted for the display.
const SHELL_GAIN: f32 = 1.5;

impl View {
    pub(crate) fn new(size: [u32; 2], frame: &Frame<'_>, camera: &Camera, look: &Look, storage: Storage) -> Self {
        let clip_from_world = clip_from_world(size, camera);
        let adapt = adaptation(look.white_k);
        let exposure = look.exposure_stops.exp2();
        let forward = (Vec3::from(camera.target) - Vec3::from(camera.eye)).normalize_or(Vec3::NEG_Z);
        let gains: f32 = if look.glow.is_empty() { 1.0 } else { look.glow.iter().map(|level| level.gain).sum() };
        let volume = look.shading == Shading::Volume;
        Self {
            clip_from_world: clip_from_world.to_cols_array_2d(),
            world_from_clip: clip_from_world.inverse().to_cols_array_2d(),
            adapt: [adapt.x_axis, adapt.y_axis, adapt.z_axis].map(|c| c.extend(0.0).to_array()),
            eye_time: Vec3::from(camera.eye).extend(frame.time_s).to_array(),
            forward_near: forward.extend(camera.near_m).to_array(),
            ambient_gain: Vec3::from(look.ambient).extend(look.light_gain).to_array(),
            background_exposure: Vec3::from(look.background).extend(exposure).to_array(),
            size_layers: [size[0], size[1], look.layers, 0],
            modes: [u32::from(volume), look.volume_steps, storage as u32, u32::from(look.tone_map == ToneMap::Filmic)],
            extra: [
                look.shell_softness,
                if volume { 1.0 } else { SHELL_GAIN / (exposure * gains.max(1e-3)) },
                0.0,
                0.0,
            ],
        }
    }
}

pub(crate) fn clip_from_world(size: [u32; 2], camera: &Camera) -> Mat4 {
    camera.clip_from_view(size[0] as f32 / size[1] as f32) * camera.view_from_world()
}

/// `Flame` in `common.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct FlameData {
    shade: FlameShade,
    hot: [f32; 4],
    cool: [f32; 4],
    blue: [f32; 4],
}

/// How much cooler than its core the thin edge of a flame looks, K.
const EDGE_COOLING_K: f32 = 300.0;
/// Emission of CH and C2 radicals as seen by a camera, linear sRGB.
const BLUE_RGB: [f32; 3] = [0.10, 0.27, 1.0];

/// How much the noise is drawn out upwards, how much finer its second octave is, and how fast that one rises by itself:
/// `noise_at` in `volume.wgsl`.
const NOISE_STRETCH: f64 = 0.45;
const NOISE_OCTAVE: f64 = 2.3;
const NOISE_BOIL_PER_S: f64 = 0.6;

impl FlameData {
    pub(crate) fn new(shade: &FlameShade, time_s: f32, eye_may_be_inside: bool) -> Self {
        // The noise repeats after one period: only the rest matters, which stays exact however long the fire burns.
        let time_s = f64::from(time_s);
        let coarse = time_s * f64::from(shade.noise_rise_m_s) * f64::from(shade.noise_per_m) * NOISE_STRETCH;
        let fine = coarse * NOISE_OCTAVE + time_s * NOISE_BOIL_PER_S;
        let hot = blackbody_rgb(shade.temperature_k);
        // Cooler in hue only: the edge is thin, and its optical depth already makes it dim.
        let cool = blackbody_rgb(shade.temperature_k - EDGE_COOLING_K);
        let luminance = |c: Vec3| c.dot(Vec3::new(0.2126, 0.7152, 0.0722)).max(1e-9);
        let cool = cool * (luminance(hot) / luminance(cool));
        Self {
            shade: *shade,
            hot: hot.extend(f32::from(u8::from(eye_may_be_inside))).to_array(),
            cool: cool.extend(coarse.rem_euclid(1.0) as f32).to_array(),
            blue: Vec3::from(BLUE_RGB).extend(fine.rem_euclid(1.0) as f32).to_array(),
        }
    }
}

/// `Light` in `opaque.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct LightData {
    position_radius2: [f32; 4],
    intensity: [f32; 4],
}

impl LightData {
    pub(crate) fn new(light: &Node) -> Self {
        Self {
            position_radius2: light.position.extend(light.radius2).to_array(),
            intensity: light.intensity.extend(0.0).to_array(),
        }
    }
}

/// `Lighting` in `opaque.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct LightingData {
    origin_scale: [f32; 4],
    counts: [u32; 4],
    shadow: [f32; 4],
    taps: [u32; 4],
}

impl LightingData {
    pub(crate) fn new(cells: &LightCells, shadows: &Shadows, look: &Look) -> Self {
        Self {
            origin_scale: cells.origin.extend(1.0 / cells.edge_m).to_array(),
            counts: cells.used.extend(shadows.count()).to_array(),
            shadow: shadows.shape(),
            taps: [look.shadow_samples, 0, 0, 0],
        }
    }
}

/// `Caster` in `shadows.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct CasterData {
    position_radius2: [f32; 4],
    intensity_share: [f32; 4],
    near: [f32; 4],
}

impl CasterData {
    /// A light with its intensity as the camera sees it, how much of its shadow is shown, and where its faces begin.
    pub(crate) fn new(light: &Light, seen: Vec3, share: f32, near_m: f32) -> Self {
        Self {
            position_radius2: Vec3::from(light.position).extend(light.radius_m * light.radius_m).to_array(),
            intensity_share: seen.extend(share).to_array(),
            near: [near_m, 0.0, 0.0, 0.0],
        }
    }
}

/// `Face` in `shadow_map.wgsl`, as far apart as dynamic offsets must be.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct FaceData {
    clip_from_world: [[f32; 4]; 4],
    gap: [[f32; 4]; 12],
}

impl FaceData {
    pub(crate) fn new(clip_from_world: Mat4) -> Self {
        Self { clip_from_world: clip_from_world.to_cols_array_2d(), gap: [[0.0; 4]; 12] }
    }
}

/// `Kernel` in `blur.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Kernel {
    pub(crate) direction_radius: [i32; 4],
    pub(crate) weights: [f32; MAX_TAPS],
}

/// `Compose` in `compose.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct ComposeData {
    pub(crate) gains: [f32; MAX_GLOW],
    pub(crate) debug: [u32; 4],
    pub(crate) uv_per_pixel: [[f32; 4]; MAX_GLOW],
}
