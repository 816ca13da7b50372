//! A renderer to draw with, a way to look at a fire, and what is read from pictures.

use glam::{Mat4, Vec2, Vec3};
use lucerna::World;
use lucerna::frame::{Camera, Frame, Look, Shading, ToneMap};
use lucerna::render::FireRenderer;
use lucerna_tests::{device, read, read_rgba16f, target};

/// Sides that no reduced copy of the flames divides.
pub(crate) const SIZE: [u32; 2] = [150, 117];
pub(crate) const SHADINGS: [Shading; 2] = [Shading::Volume, Shading::Shell];

/// A renderer with its device.
pub(crate) struct Painter {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) renderer: FireRenderer,
    pub(crate) format: wgpu::TextureFormat,
}

impl Painter {
    pub(crate) fn new(format: wgpu::TextureFormat) -> Self {
        let (device, queue) = device();
        let renderer = FireRenderer::new(&device, &queue, format);
        Self { device, queue, renderer, format }
    }

    /// Draws a frame onto a black target.
    pub(crate) fn paint(&mut self, size: [u32; 2], frame: &Frame<'_>, camera: &Camera, look: &Look) -> wgpu::Texture {
        let Self { device, queue, renderer, format } = self;
        let picture = target(device, size, *format);
        let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
        renderer.prepare(device, queue, size, frame, camera, look).expect("a frame that can be drawn");
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        renderer.render(&mut encoder, &view);
        queue.submit([encoder.finish()]);
        picture
    }

    /// The bytes of a picture of 8 bits a channel.
    pub(crate) fn bytes(&mut self, size: [u32; 2], frame: &Frame<'_>, camera: &Camera, look: &Look) -> Vec<u8> {
        let picture = self.paint(size, frame, camera, look);
        read(&self.device, &self.queue, &picture)
    }

    /// The texels of a picture in `Rgba16Float`.
    pub(crate) fn light(&mut self, size: [u32; 2], frame: &Frame<'_>, camera: &Camera, look: &Look) -> Vec<[f32; 4]> {
        let picture = self.paint(size, frame, camera, look);
        read_rgba16f(&self.device, &self.queue, &picture)
    }

    /// The flames of the last picture before any blur: radiance, and the share of the scene that they hide.
    pub(crate) fn flames(&self) -> Vec<[f32; 4]> {
        read_rgba16f(&self.device, &self.queue, self.renderer.flame_texture().expect("a picture was drawn"))
    }
}

/// The fire of a world and nothing else.
pub(crate) fn flames_alone(world: &World) -> Frame<'_> {
    Frame { meshes: &[], mesh_revision: u64::MAX, ..world.frame() }
}

/// A look at the flames alone, in the dark, with light as it is.
pub(crate) fn measuring(world: &World, shading: Shading) -> Look {
    Look {
        shading,
        exposure_stops: 0.0,
        tone_map: ToneMap::None,
        ambient: [0.0; 3],
        background: [0.0; 3],
        samples: 1,
        ..world.scene().scene.look.clone()
    }
}

/// A flame seen from the front, as high as a third of the picture, so that its glow keeps away from the borders.
pub(crate) fn from_afar(world: &World) -> Camera {
    let (low, high) = extent(world);
    let center = (low + high) / 2.0;
    let distance = 10.0 * (high.y - low.y);
    Camera {
        eye: (center + Vec3::Z * distance).to_array(),
        target: center.to_array(),
        fov_y_deg: 17.0,
        near_m: 0.1 * distance,
        far_m: 10.0 * distance,
    }
}

/// The corners of the box around all flames.
pub(crate) fn extent(world: &World) -> (Vec3, Vec3) {
    let positions = world.frame().flame_vertices.iter().map(|v| Vec3::from(v.position));
    positions.fold((Vec3::MAX, Vec3::MIN), |(low, high), p| (low.min(p), high.max(p)))
}

/// Where a point appears, in pixels from the upper left corner.
pub(crate) fn pixel(camera: &Camera, [width, height]: [u32; 2], point: Vec3) -> Vec2 {
    let (width, height) = (width as f32, height as f32);
    let clip: Mat4 = camera.clip_from_view(width / height) * camera.view_from_world();
    let ndc = clip.project_point3(point);
    Vec2::new((0.5 + 0.5 * ndc.x) * width, (0.5 - 0.5 * ndc.y) * height)
}

/// Linear colours of sRGB bytes.
pub(crate) fn linear(bytes: &[u8]) -> Vec<[f32; 3]> {
    let decode = |byte: u8| {
        let c = f32::from(byte) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    bytes.chunks_exact(4).map(|texel| [decode(texel[0]), decode(texel[1]), decode(texel[2])]).collect()
}

/// The largest difference of two bytes of two pictures.
pub(crate) fn largest_difference(a: &[u8], b: &[u8]) -> u8 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

/// As [`largest_difference`], whatever alpha is.
pub(crate) fn largest_rgb_difference(a: &[u8], b: &[u8]) -> u8 {
    let rgb = |bytes: &[u8]| bytes.chunks_exact(4).flat_map(|texel| texel[..3].to_vec()).collect::<Vec<u8>>();
    largest_difference(&rgb(a), &rgb(b))
}
