//! What lights the scene: the lights of a frame, merged where they are far, on the GPU.

use crate::data::{LightData, LightingData};
use crate::layouts::Layouts;
use crate::light_cells::{FEW_LIGHTS, LightCells};
use crate::light_tree::{LightTree, Node};
use crate::shadows::Shadows;
use crate::targets::group;
use crate::upload::GrowBuffer;
use glam::{Mat4, Vec3};
use lucerna_frame::{Camera, Frame, Light, Look, adaptation};
use wgpu::{BufferUsages, Device, Queue};

/// The lights of the prepared frame.
#[derive(Debug)]
pub(crate) struct Lighting {
    tree: LightTree,
    cells: LightCells,
    data: Vec<LightData>,
    uniform: wgpu::Buffer,
    lights: GrowBuffer,
    lists: GrowBuffer,
    pub(crate) shadows: Shadows,
    pub(crate) group: wgpu::BindGroup,
}

impl Lighting {
    pub(crate) fn new(device: &Device, layouts: &Layouts) -> Self {
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("lighting"),
            size: size_of::<LightingData>() as u64,
            usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let lights = GrowBuffer::new(device, "lights", BufferUsages::STORAGE, (size_of::<LightData>() * 64) as u64);
        let lists = GrowBuffer::new(device, "lists of lights", BufferUsages::STORAGE, 1 << 10);
        let shadows = Shadows::new(device, &layouts.face);
        let group = bind(device, &layouts.lighting, &uniform, [&lights, &lists], &shadows);
        let (tree, cells, data) = Default::default();
        Self { tree, cells, data, uniform, lights, lists, shadows, group }
    }

    /// Lays the cells around new meshes.
    pub(crate) fn set_meshes(&mut self, frame: &Frame<'_>) {
        self.cells.lay(frame.meshes);
        self.shadows.set_meshes(frame.meshes);
    }

    /// True if a pixel is so dear that what is hidden is better found out first.
    pub(crate) fn is_dear(&self) -> bool {
        self.shadows.count() > 0 || self.tree.light_count() > FEW_LIGHTS
    }

    /// Merges and uploads the lights of a frame.
    pub(crate) fn prepare(
        &mut self,
        device: &Device,
        queue: &Queue,
        layout: &wgpu::BindGroupLayout,
        (frame, camera, look): (&Frame<'_>, &Camera, &Look),
        clip_from_world: Mat4,
    ) {
        let adapt = adaptation(look.white_k);
        let seen = |light: &Light| (adapt * Vec3::from(light.intensity)).max(Vec3::ZERO);
        let new_maps = self.shadows.prepare(device, queue, frame.lights, (camera, look), seen);
        // Those with a shadow stay by themselves.
        let others = frame.lights.iter().enumerate().filter(|(index, _)| !self.shadows.is_chosen(*index));
        self.tree.build(others.map(|(_, light)| Node::light(light.position.into(), light.radius_m, seen(light))));
        self.data.clear();
        self.data.extend(self.tree.nodes().iter().map(LightData::new));
        let lights_grew = self.lights.write(device, queue, bytemuck::cast_slice(&self.data));
        let lists = self.cells.fill(&self.tree, look.light_merging, clip_from_world);
        let lists_grew = self.lists.write(device, queue, bytemuck::cast_slice(lists));
        if lights_grew || lists_grew || new_maps {
            self.group = bind(device, layout, &self.uniform, [&self.lights, &self.lists], &self.shadows);
        }
        let data = LightingData::new(&self.cells, &self.shadows, look);
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&data));
    }
}

fn bind(
    device: &Device,
    layout: &wgpu::BindGroupLayout,
    uniform: &wgpu::Buffer,
    [lights, lists]: [&GrowBuffer; 2],
    shadows: &Shadows,
) -> wgpu::BindGroup {
    let [casters, plain, compared, comparison] = shadows.resources();
    let [uniform, lights, lists] = [uniform, &lights.buffer, &lists.buffer].map(wgpu::Buffer::as_entire_binding);
    group(device, "lighting", layout, &[uniform, lights, lists, casters, plain, compared, comparison])
}
