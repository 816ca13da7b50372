//! The long-lived renderer: what is made once, what is uploaded for a frame, and the order of the passes.

use crate::bounds::{bounds, encloses};
use crate::check::{check_camera, check_depth, check_frame, check_look, check_size};
use crate::compose::compose_data;
use crate::data::{FlameData, MAX_GLOW, Storage, View, clip_from_world};
use crate::error::RenderError;
use crate::glow::weights;
use crate::lighting::Lighting;
use crate::pipelines::Pipelines;
use crate::surfaces::Evaluator;
use crate::targets::{Shape, Shared, Targets, group};
use crate::textures;
use crate::upload::GrowBuffer;
use glam::{Vec3, Vec4};
use lucerna_frame::{Camera, DebugView, FlameDraw, FlameVertex, Frame, Look, Shading, Transparency};
use wgpu::{BindingResource, BufferUsages, Device, Queue, TextureView};

/// The passes of one frame, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The flames' vertices, where the frame has control nets.
    Surfaces,
    /// What the lights with a shadow see.
    Shadows,
    /// The opaque scene, lit by the flames.
    Opaque,
    /// The flames: peeling and shading.
    Peel,
    /// The blurred copies.
    Glow,
    /// Everything into the target.
    Compose,
}

impl Stage {
    /// All stages in the order in which they are recorded.
    pub const ALL: [Stage; 6] =
        [Stage::Surfaces, Stage::Shadows, Stage::Opaque, Stage::Peel, Stage::Glow, Stage::Compose];
}

/// Draws fire into the caller's targets with the caller's device.
#[derive(Debug)]
pub struct FireRenderer {
    pub(crate) pipelines: Pipelines,
    storage: Storage,
    view: wgpu::Buffer,
    compose: wgpu::Buffer,
    pub(crate) open_intervals: wgpu::Buffer,
    flames: GrowBuffer,
    pub(crate) lighting: Lighting,
    pub(crate) common_group: wgpu::BindGroup,
    pub(crate) evaluator: Evaluator,
    pub(crate) flame_vertices: GrowBuffer,
    pub(crate) flame_indices: GrowBuffer,
    pub(crate) flame_draws: Vec<FlameDraw>,
    pub(crate) mesh_vertices: GrowBuffer,
    pub(crate) mesh_indices: GrowBuffer,
    pub(crate) mesh_index_count: u32,
    mesh_revision: Option<u64>,
    pub(crate) lines: GrowBuffer,
    pub(crate) line_vertex_count: u32,
    noise: TextureView,
    repeat: wgpu::Sampler,
    clamp: wgpu::Sampler,
    pub(crate) texture_group: wgpu::BindGroup,
    /// The caller's depth, drawn over; without it the renderer draws the scene itself.
    pub(crate) scene_depth: Option<TextureView>,
    pub(crate) targets: Option<Targets>,
    /// Staging for the per-flame data, kept to be refilled.
    flame_data: Vec<FlameData>,
    // What the passes of the prepared frame need to know.
    pub(crate) mode: (Shading, Transparency),
    pub(crate) debug: DebugView,
    pub(crate) background: [f32; 3],
    pub(crate) counts_layers: bool,
    /// Pixels that flames may cover: x, y, width, height.
    pub(crate) flame_bounds: Option<[u32; 4]>,
    pub(crate) glow_radii: [u32; MAX_GLOW],
}

impl FireRenderer {
    /// Makes all pipelines for targets of one format.
    ///
    /// Formats that encode sRGB themselves and those that do not show the same colours; float formats get linear numbers,
    /// not dithered. (Over a caller's picture the two 8-bit kinds differ a little where the glow is faint: the target
    /// blends in its own numbers.)
    #[must_use]
    pub fn new(device: &Device, queue: &Queue, target: wgpu::TextureFormat) -> Self {
        let pipelines = Pipelines::new(device, target);
        let fixed = |label, size: usize, usage| {
            let usage = usage | BufferUsages::COPY_DST;
            let size = size as u64;
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let view = fixed("view", size_of::<View>(), BufferUsages::UNIFORM);
        let compose = fixed("compose", size_of::<crate::data::ComposeData>(), BufferUsages::UNIFORM);
        let open_intervals = fixed("open intervals", 4, BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let growing = |label, usage, bytes| GrowBuffer::new(device, label, usage, bytes);
        let flames = growing("flames", BufferUsages::STORAGE, (size_of::<FlameData>() * 16) as u64);
        let lighting = Lighting::new(device, &pipelines.layouts);
        let common_group = common_group(device, &pipelines, &view, &flames);
        let sampler = |mode| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                address_mode_u: mode,
                address_mode_v: mode,
                address_mode_w: mode,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            })
        };
        let (repeat, clamp) = (sampler(wgpu::AddressMode::Repeat), sampler(wgpu::AddressMode::ClampToEdge));
        let painted = textures::painted_flame(device, queue);
        let texture_group = texture_group(device, &pipelines, &painted);
        Self {
            storage: Storage::of(target),
            evaluator: Evaluator::new(device),
            flame_vertices: growing("flame vertices", VERTEX_USAGE, 1 << 18),
            flame_indices: growing("flame indices", BufferUsages::INDEX, 1 << 16),
            flame_draws: Vec::new(),
            mesh_vertices: growing("mesh vertices", BufferUsages::VERTEX, 256),
            mesh_indices: growing("mesh indices", BufferUsages::INDEX, 256),
            mesh_index_count: 0,
            mesh_revision: None,
            lines: growing("lines", BufferUsages::VERTEX, 256),
            line_vertex_count: 0,
            noise: textures::noise(device, queue),
            repeat,
            clamp,
            texture_group,
            scene_depth: None,
            targets: None,
            flame_data: Vec::new(),
            mode: Default::default(),
            debug: DebugView::Final,
            background: [0.0; 3],
            counts_layers: false,
            flame_bounds: None,
            glow_radii: [0; MAX_GLOW],
            pipelines,
            view,
            compose,
            open_intervals,
            flames,
            lighting,
            common_group,
        }
    }

    /// Draws over the caller's own picture from now on: flames are tested against `depth` and blended onto the
    /// target, and the frame's meshes are left out. `None` goes back to drawing the whole scene.
    ///
    /// `depth` must be of the picture's size, single-sampled, of a format with 0 near and 1 far that can be bound as
    /// a texture. Call it again when that texture is made anew.
    pub fn set_scene_depth(&mut self, depth: Option<&TextureView>) {
        if self.scene_depth.as_ref() != depth {
            self.scene_depth = depth.cloned();
            self.targets = None;
        }
    }

    /// Replaces the painted flame of `shell` shading: sRGB texels with alpha unused, the tip in the first row.
    ///
    /// # Errors
    /// [`RenderError::Size`] for no or too many pixels, [`RenderError::Frame`] if the number of bytes is not
    /// width x height x 4.
    pub fn set_flame_texture(
        &mut self,
        device: &Device,
        queue: &Queue,
        size: [u32; 2],
        texels: &[u8],
    ) -> Result<(), RenderError> {
        check_size(size, device.limits().max_texture_dimension_2d)?;
        let expected = size[0] as usize * size[1] as usize * 4;
        if texels.len() != expected {
            let problem = format!("has {} bytes: must be {} x {} x 4", texels.len(), size[0], size[1]);
            return Err(RenderError::Frame { field: "flame_texture", problem });
        }
        let view = textures::flame_texture(device, queue, size, texels);
        self.texture_group = texture_group(device, &self.pipelines, &view);
        Ok(())
    }

    /// Counts layers and open intervals from now on (an extra pass), or stops.
    pub fn set_statistics(&mut self, on: bool) {
        self.counts_layers = on;
    }

    /// The flames before any blur, `Rgba16Float`: radiance, and the share of what lies behind that the soot hides.
    /// `None` before the first frame.
    #[must_use]
    pub fn flame_texture(&self) -> Option<&wgpu::Texture> {
        self.targets.as_ref().map(|targets| &targets.flame_texture)
    }

    /// The flames' vertices of the last frame, [`FlameVertex`] after [`FlameVertex`]. It can be copied from; where the
    /// frame had control nets they are there once [`Stage::Surfaces`] is done. The buffer stays the same until more is
    /// drawn than ever before.
    #[must_use]
    pub fn flame_vertices(&self) -> &wgpu::Buffer {
        &self.flame_vertices.buffer
    }

    /// Uploads a frame. Textures are made anew only when the size, the layers, the samples or the glow levels changed.
    ///
    /// # Errors
    /// A [`RenderError`] that names the field, if the size, the camera, the look or the frame cannot be drawn.
    pub fn prepare(
        &mut self,
        device: &Device,
        queue: &Queue,
        size_px: [u32; 2],
        frame: &Frame<'_>,
        camera: &Camera,
        look: &Look,
    ) -> Result<(), RenderError> {
        check_size(size_px, device.limits().max_texture_dimension_2d)?;
        check_camera(camera)?;
        check_look(look, device.limits().max_texture_dimension_2d)?;
        check_depth(self.scene_depth.as_ref(), size_px)?;
        let meshes_are_new = self.scene_depth.is_none() && self.mesh_revision != Some(frame.mesh_revision);
        let limits = device.limits();
        check_frame(frame, meshes_are_new, &limits)?;
        let new_grids = self.evaluator.check(frame, &limits)?;

        let layout = &self.pipelines.layouts.evaluate;
        self.evaluator.prepare(device, queue, layout, (frame, new_grids), &mut self.flame_vertices);
        self.flame_data.clear();
        self.flame_data.extend(frame.flame_shades.iter().zip(frame.flame_draws).enumerate().map(
            |(index, (shade, draw))| {
                let inside = if let Some(nets) = &frame.flame_nets {
                    encloses(self.evaluator.points(nets, index).iter().map(control_point), camera, size_px)
                } else {
                    let vertices = &frame.flame_vertices[draw.first_vertex as usize..][..draw.vertex_count as usize];
                    encloses(vertices.iter().map(position), camera, size_px)
                };
                FlameData::new(shade, frame.time_s, inside)
            },
        ));
        if self.flames.write(device, queue, bytemuck::cast_slice(&self.flame_data)) {
            self.common_group = common_group(device, &self.pipelines, &self.view, &self.flames);
        }
        let view = View::new(size_px, frame, camera, look, self.storage);
        queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&view));
        queue.write_buffer(&self.open_intervals, 0, &[0; 4]);

        self.flame_vertices.write(device, queue, bytemuck::cast_slice(frame.flame_vertices));
        self.flame_indices.write(device, queue, bytemuck::cast_slice(frame.flame_indices));
        self.flame_draws.clear();
        self.flame_draws.extend_from_slice(frame.flame_draws);
        // A surface lies in the convex hull of its control points (The NURBS Book, P4.10).
        self.flame_bounds = match &frame.flame_nets {
            Some(nets) => bounds(size_px, nets.points.iter().map(control_point), camera),
            None => bounds(size_px, frame.flame_vertices.iter().map(position), camera),
        };
        self.lines.write(device, queue, bytemuck::cast_slice(frame.lines));
        self.line_vertex_count = frame.lines.len() as u32;
        // Over a caller's picture nothing is lit.
        if self.scene_depth.is_none() {
            self.upload_meshes(device, queue, frame);
            let layout = &self.pipelines.layouts.lighting;
            self.lighting.prepare(device, queue, layout, (frame, camera, look), clip_from_world(size_px, camera));
        }

        self.mode = (look.shading, look.transparency);
        self.debug = look.debug;
        // Background and meshes meet the tone map in the same unit as the flames.
        self.background = look.background;
        if !self.targets.as_ref().is_some_and(|targets| targets.shape.fits(size_px, look)) {
            let shared = Shared {
                layouts: &self.pipelines.layouts,
                noise: &self.noise,
                repeat: &self.repeat,
                clamp: &self.clamp,
                open_intervals: &self.open_intervals,
                compose: &self.compose,
                scene_depth: self.scene_depth.as_ref(),
            };
            self.targets = Some(Targets::new(device, Shape::of(size_px, look), &shared));
        }
        if let Some(targets) = &self.targets {
            Self::upload_kernels(queue, targets, &look.glow);
        }
        for (radius, level) in self.glow_radii.iter_mut().zip(&look.glow) {
            *radius = weights(level.blur, size_px[1], level.divisor).1.unsigned_abs();
        }
        queue.write_buffer(&self.compose, 0, bytemuck::bytes_of(&compose_data(look, size_px)));
        Ok(())
    }

    fn upload_meshes(&mut self, device: &Device, queue: &Queue, frame: &Frame<'_>) {
        if self.mesh_revision == Some(frame.mesh_revision) {
            return;
        }
        self.mesh_revision = Some(frame.mesh_revision);
        self.lighting.set_meshes(frame);
        let mut vertices = Vec::new();
        let mut indices = Vec::new();
        for mesh in frame.meshes {
            let first = vertices.len() as u32;
            vertices.extend_from_slice(&mesh.vertices);
            indices.extend(mesh.indices.iter().map(|index| index + first));
        }
        self.mesh_vertices.write(device, queue, bytemuck::cast_slice(&vertices));
        self.mesh_indices.write(device, queue, bytemuck::cast_slice(&indices));
        self.mesh_index_count = indices.len() as u32;
    }

    /// Records one stage of the prepared frame; `target` is used by [`Stage::Compose`] alone. Stages must follow in
    /// the order of [`Stage::ALL`]. Does nothing before the first [`prepare`](Self::prepare).
    pub fn record(&self, stage: Stage, encoder: &mut wgpu::CommandEncoder, target: &TextureView) {
        let Some(targets) = &self.targets else { return };
        match stage {
            Stage::Surfaces => self.record_surfaces(encoder),
            Stage::Shadows | Stage::Opaque if self.scene_depth.is_some() => {}
            Stage::Shadows => self.record_shadows(encoder),
            Stage::Opaque => self.record_opaque(targets, encoder),
            Stage::Peel => self.record_flames(targets, encoder),
            Stage::Glow => self.record_glow(targets, encoder),
            Stage::Compose => self.record_compose(targets, encoder, target),
        }
    }

    /// Records all stages.
    pub fn render(&self, encoder: &mut wgpu::CommandEncoder, target: &TextureView) {
        for stage in Stage::ALL {
            self.record(stage, encoder, target);
        }
    }
}

/// Drawn from, written by the compute pass and by the CPU, and read back.
const VERTEX_USAGE: BufferUsages = BufferUsages::VERTEX.union(BufferUsages::STORAGE).union(BufferUsages::COPY_SRC);

fn position(vertex: &FlameVertex) -> Vec3 {
    vertex.position.into()
}

fn control_point(point: &[f32; 4]) -> Vec3 {
    Vec4::from(*point).truncate()
}

fn common_group(device: &Device, pipelines: &Pipelines, view: &wgpu::Buffer, flames: &GrowBuffer) -> wgpu::BindGroup {
    let resources = [view, &flames.buffer].map(wgpu::Buffer::as_entire_binding);
    group(device, "common", &pipelines.layouts.common, &resources)
}

fn texture_group(device: &Device, pipelines: &Pipelines, texture: &TextureView) -> wgpu::BindGroup {
    // Around the flame the picture repeats; from root to tip it does not.
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        address_mode_u: wgpu::AddressMode::Repeat,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    });
    let resources = [BindingResource::TextureView(texture), BindingResource::Sampler(&sampler)];
    group(device, "flame texture", &pipelines.layouts.texture, &resources)
}
