//! Shadows: which lights cast them, and the maps of depths around those.

use crate::data::{CasterData, FaceData};
use crate::renderer::FireRenderer;
use crate::targets::group;
use glam::{Mat4, Vec3, Vec4};
use lucerna_frame::{Camera, Light, Look, OpaqueMesh};
use wgpu::{BindingResource, BufferUsages, Device, Queue, TextureView};

/// Most lights with a shadow.
pub(crate) const MAX_SHADOWS: u32 = 32;
/// Faces of a cube.
const FACES: u32 = 6;
/// Where a face's matrix lies: as far apart as any device needs.
const FACE_STRIDE: u32 = 256;
/// Texels beyond a right angle on each side of a face, so that four neighbours are always there.
const GUARD: f32 = 2.0;
/// A light so much stronger than the first without a shadow shows all of its own; a weaker one a part of it.
const FADE: f32 = 0.5;
/// Nothing nearer than this share of a light's radius casts a shadow: wicks stand in their flames.
const NEAR: f32 = 0.8;
/// Triangles that are culled together.
const CHUNK: usize = 256;

/// A part of the meshes.
#[derive(Clone, Copy, Debug)]
struct Chunk {
    center: Vec3,
    radius_m: f32,
    indices: [u32; 2],
}

/// A light with a shadow.
#[derive(Clone, Copy, Debug)]
struct Caster {
    position: Vec3,
    near_m: f32,
}

/// Which lights cast shadows.
#[derive(Debug, Default)]
pub(crate) struct Choice {
    /// How strong each light is as seen, and its number.
    scores: Vec<(f32, u32)>,
    /// The lights with a shadow, strongest first, and how much of it is shown, 0 to 1.
    pub(crate) lights: Vec<(u32, f32)>,
}

impl Choice {
    /// Chooses at most `count` lights. It depends on this frame alone; a light comes and goes with a shadow that is not
    /// shown, so that none pops.
    pub(crate) fn choose(&mut self, lights: &[Light], camera: &Camera, count: u32) {
        let (eye, target) = (Vec3::from(camera.eye), Vec3::from(camera.target));
        let sight = target - eye;
        self.lights.clear();
        self.scores.clear();
        if count == 0 {
            return;
        }
        self.scores.extend(lights.iter().zip(0..).map(|(light, index)| {
            // From the line between the eye and what is looked at.
            let position = Vec3::from(light.position);
            let along = ((position - eye).dot(sight) / sight.length_squared().max(1e-12)).clamp(0.0, 1.0);
            let distance2 = position.distance_squared(eye + along * sight) + light.radius_m * light.radius_m;
            (Vec3::from(light.intensity).element_sum() / distance2.max(1e-12), index)
        }));
        self.scores.retain(|(score, _)| *score > 0.0);
        self.scores.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let first_without = self.scores.get(count as usize).map_or(0.0, |(score, _)| *score);
        let share =
            |score: f32| if first_without > 0.0 { ((score / first_without - 1.0) / FADE).min(1.0) } else { 1.0 };
        let best = self.scores.iter().take(count as usize).map(|&(score, index)| (index, share(score)));
        self.lights.extend(best.take_while(|(_, share)| *share > 0.0));
    }
}

/// The texture of all faces: a row for each light, six columns.
#[derive(Debug)]
struct Atlas {
    size: u32,
    rows: u32,
    view: TextureView,
}

impl Atlas {
    fn new(device: &Device, size: u32, rows: u32) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow maps"),
            size: wgpu::Extent3d { width: FACES * size, height: rows * size, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: crate::pipelines::DEPTH,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        Self { size, rows, view: texture.create_view(&wgpu::TextureViewDescriptor::default()) }
    }
}

/// The lights with a shadow and their maps.
#[derive(Debug)]
pub(crate) struct Shadows {
    choice: Choice,
    /// For each light of the frame whether it has a shadow.
    chosen: Vec<bool>,
    casters: Vec<Caster>,
    chunks: Vec<Chunk>,
    caster_data: Vec<CasterData>,
    face_data: Vec<FaceData>,
    caster_buffer: wgpu::Buffer,
    face_buffer: wgpu::Buffer,
    face_group: wgpu::BindGroup,
    comparison: wgpu::Sampler,
    atlas: Atlas,
}

impl Shadows {
    pub(crate) fn new(device: &Device, faces: &wgpu::BindGroupLayout) -> Self {
        let buffer = |label, size: u64, usage| {
            let usage = usage | BufferUsages::COPY_DST;
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let casters = u64::from(MAX_SHADOWS) * size_of::<CasterData>() as u64;
        let face_buffer = buffer("faces", u64::from(MAX_SHADOWS * FACES * FACE_STRIDE), BufferUsages::UNIFORM);
        let one = wgpu::BufferBinding {
            buffer: &face_buffer,
            offset: 0,
            size: std::num::NonZeroU64::new(size_of::<FaceData>() as u64),
        };
        let face_group = group(device, "face", faces, &[BindingResource::Buffer(one)]);
        Self {
            choice: Choice::default(),
            chosen: Vec::new(),
            casters: Vec::new(),
            chunks: Vec::new(),
            caster_data: Vec::new(),
            face_data: Vec::new(),
            caster_buffer: buffer("casters", casters, BufferUsages::STORAGE),
            face_buffer,
            face_group,
            comparison: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadows"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                // Depths are near / distance: what is lit is as near as what is nearest, or nearer.
                compare: Some(wgpu::CompareFunction::GreaterEqual),
                ..Default::default()
            }),
            atlas: Atlas::new(device, 1, 1),
        }
    }

    /// Parts of new meshes, to be culled one by one.
    pub(crate) fn set_meshes(&mut self, meshes: &[OpaqueMesh]) {
        self.chunks.clear();
        let mut first = 0;
        for mesh in meshes {
            for indices in mesh.indices.chunks(3 * CHUNK) {
                let places = || indices.iter().map(|index| Vec3::from(mesh.vertices[*index as usize].position));
                let (low, high) = places().fold((Vec3::MAX, Vec3::MIN), |(l, h), p| (l.min(p), h.max(p)));
                let center = 0.5 * (low + high);
                let radius_m = places().map(|p| p.distance_squared(center)).fold(0.0, f32::max).sqrt();
                let end = first + indices.len() as u32;
                self.chunks.push(Chunk { center, radius_m, indices: [first, end] });
                first = end;
            }
        }
    }

    /// Chooses the lights with a shadow and uploads what their maps need; true if the maps are new ones, which bind groups
    /// must take up.
    pub(crate) fn prepare(
        &mut self,
        device: &Device,
        queue: &Queue,
        lights: &[Light],
        (camera, look): (&Camera, &Look),
        seen: impl Fn(&Light) -> Vec3,
    ) -> bool {
        self.choice.choose(lights, camera, look.shadows);
        let spread = spread(look.shadow_size);
        self.chosen.clear();
        self.chosen.resize(lights.len(), false);
        self.casters.clear();
        self.caster_data.clear();
        self.face_data.clear();
        for &(index, share) in &self.choice.lights {
            self.chosen[index as usize] = true;
            let light = &lights[index as usize];
            let caster = Caster { position: light.position.into(), near_m: (NEAR * light.radius_m).max(1e-5) };
            self.casters.push(caster);
            self.caster_data.push(CasterData::new(light, seen(light), share, caster.near_m));
            self.face_data.extend((0..FACES).map(|face| FaceData::new(caster.clip_from_world(face, spread))));
        }
        queue.write_buffer(&self.caster_buffer, 0, bytemuck::cast_slice(&self.caster_data));
        queue.write_buffer(&self.face_buffer, 0, bytemuck::cast_slice(&self.face_data));
        // No more rows than lights ever had a shadow, so that little is cleared in small scenes.
        let (size, rows) = match self.casters.len() as u32 {
            0 => return false,
            count => (look.shadow_size, count.next_power_of_two().min(look.shadows)),
        };
        let fits = self.atlas.size == size && (rows..=look.shadows).contains(&self.atlas.rows);
        if !fits {
            self.atlas = Atlas::new(device, size, rows);
        }
        !fits
    }

    /// True if this light of the prepared frame has a shadow.
    pub(crate) fn is_chosen(&self, index: usize) -> bool {
        self.chosen[index]
    }

    pub(crate) fn count(&self) -> u32 {
        self.casters.len() as u32
    }

    /// Texels across a face, the tangent of half its field, and the size of one texel in the whole.
    pub(crate) fn shape(&self) -> [f32; 4] {
        let Atlas { size, rows, .. } = self.atlas;
        [size as f32, spread(size), 1.0 / (FACES * size) as f32, 1.0 / (rows * size) as f32]
    }

    /// What the opaque pass reads.
    pub(crate) fn resources(&self) -> [BindingResource<'_>; 4] {
        use BindingResource::{Sampler, TextureView as View};
        let maps = &self.atlas.view;
        [self.caster_buffer.as_entire_binding(), View(maps), View(maps), Sampler(&self.comparison)]
    }
}

/// The tangent of half the field of a face: a little more than one.
fn spread(size: u32) -> f32 {
    size as f32 / (size as f32 - 2.0 * GUARD).max(1.0)
}

impl Caster {
    /// The view through one face: x and y across it, depth near / distance, which is 1 at the near plane and 0 in the
    /// infinite: floats are as fine there as here.
    fn clip_from_world(&self, face: u32, spread: f32) -> Mat4 {
        let [ahead, across, up] = axes(face);
        let rows = [across / spread, -up / spread, Vec3::ZERO, ahead];
        let moved = |row: Vec3| row.extend(-row.dot(self.position));
        let near = Vec4::new(0.0, 0.0, 0.0, self.near_m);
        Mat4::from_cols(moved(rows[0]), moved(rows[1]), near, moved(rows[3])).transpose()
    }

    /// False if a ball lies outside of the view through one face.
    fn sees(&self, face: u32, spread: f32, center: Vec3, radius_m: f32) -> bool {
        let [ahead, across, up] = axes(face);
        let (to, tilt) = (center - self.position, (1.0 + spread * spread).sqrt());
        let depth = to.dot(ahead);
        let beyond = |side: f32| (side.abs() - spread * depth) / tilt > radius_m;
        depth + radius_m >= self.near_m && !beyond(to.dot(across)) && !beyond(to.dot(up))
    }
}

/// Ahead, across and up of the faces +x, -x, +y, -y, +z, -z.
fn axes(face: u32) -> [Vec3; 3] {
    let axis = |index: u32| Vec3::AXES[(index % 3) as usize];
    let side = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
    [side * axis(face / 2), axis(face / 2 + 1), axis(face / 2 + 2)]
}

impl FireRenderer {
    pub(crate) fn record_shadows(&self, encoder: &mut wgpu::CommandEncoder) {
        let shadows = &self.lighting.shadows;
        if shadows.casters.is_empty() {
            return;
        }
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadows"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &shadows.atlas.view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipelines.shadow);
        pass.set_vertex_buffer(0, self.mesh_vertices.buffer.slice(..));
        pass.set_index_buffer(self.mesh_indices.buffer.slice(..), wgpu::IndexFormat::Uint32);
        let (size, spread) = (shadows.atlas.size as f32, spread(shadows.atlas.size));
        for (row, caster) in (0..).zip(&shadows.casters) {
            for face in 0..FACES {
                pass.set_viewport(face as f32 * size, row as f32 * size, size, size, 0.0, 1.0);
                pass.set_bind_group(0, &shadows.face_group, &[(row * FACES + face) * FACE_STRIDE]);
                let seen = |chunk: &&Chunk| caster.sees(face, spread, chunk.center, chunk.radius_m);
                let mut pending = 0..0;
                for chunk in shadows.chunks.iter().filter(seen) {
                    let [first, end] = chunk.indices;
                    if first != pending.end {
                        draw(&mut pass, pending);
                        pending = first..first;
                    }
                    pending.end = end;
                }
                draw(&mut pass, pending);
            }
        }
    }
}

fn draw(pass: &mut wgpu::RenderPass<'_>, indices: std::ops::Range<u32>) {
    if !indices.is_empty() {
        pass.draw_indexed(indices, 0, 0..1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn light(x: f32, power: f32) -> Light {
        Light { position: [x, 0.0, 0.0], radius_m: 0.01, intensity: [power; 3] }
    }

    #[test]
    fn shadows_come_and_go_with_none_shown() {
        let camera = Camera { eye: [0.0, 0.0, 5.0], target: [0.0; 3], ..Default::default() };
        let mut choice = Choice::default();
        let mut last: Vec<f32> = Vec::new();
        let (mut changes, mut largest) = (0, 0.0f32);
        for step in 0..=2000 {
            // One grows past the others.
            let lights =
                [light(-1.0, 1.0), light(1.0, 1.5), light(1.4, 0.002 * step as f32), light(3.0, 2.0), light(0.0, 0.0)];
            choice.choose(&lights, &camera, 2);
            assert!(choice.lights.len() <= 2);
            let shares: Vec<f32> = (0..5)
                .map(|i| choice.lights.iter().find(|(index, _)| *index == i).map_or(0.0, |(_, share)| *share))
                .collect();
            assert_eq!(shares[4], 0.0, "a dark light has a shadow");
            for (before, now) in last.iter().zip(&shares) {
                largest = largest.max((before - now).abs());
                changes += usize::from((*before > 0.0) != (*now > 0.0));
            }
            last = shares;
        }
        println!("{changes} shadows came or went, by steps of {largest}");
        assert!(changes >= 2 && largest < 0.02, "{changes} changes, steps of {largest}");
        choice.choose(&[light(1.0, 1.0), light(2.0, 0.1)], &camera, 2);
        assert_eq!(choice.lights, [(0, 1.0), (1, 1.0)]);
    }

    #[test]
    fn every_point_is_seen_through_the_face_that_it_lies_in() {
        let caster = Caster { position: Vec3::new(3.0, -2.0, 1.0), near_m: 0.01 };
        let spread = spread(64);
        for face in 0..FACES {
            let [ahead, across, up] = axes(face);
            for (x, y) in [(0.0, 0.0), (0.9, -0.4), (-0.7, 0.9)] {
                let point = caster.position + 2.0 * (ahead + x * across + y * up);
                let clip = caster.clip_from_world(face, spread) * point.extend(1.0);
                let ndc = clip.truncate() / clip.w;
                assert!(ndc.distance(Vec3::new(x / spread, -y / spread, 0.005)) < 1e-5, "face {face}: {ndc}");
                for other in 0..FACES {
                    assert_eq!(caster.sees(other, spread, point, 0.0), other == face, "face {other} of {face}");
                    assert!(caster.sees(other, spread, point, 6.0));
                }
            }
        }
    }
}
