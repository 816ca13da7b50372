//! Flame surfaces made on the GPU: control nets go up, a compute pass writes the vertices.

use crate::RenderError;
use crate::nets::{GridShape, check_grids, check_nets, vertex_bytes};
use crate::renderer::FireRenderer;
use crate::targets::group;
use crate::upload::GrowBuffer;
use lucerna_frame::{FlameNets, Frame};
use std::num::NonZeroU64;
use wgpu::{BindingResource, BufferUsages, Device, Queue};

/// What the pass reads, and how much of it there is.
#[derive(Debug)]
pub(crate) struct Evaluator {
    tables: GrowBuffer,
    points: GrowBuffer,
    nets: GrowBuffer,
    shapes: Vec<GridShape>,
    revision: Option<u64>,
    /// Staging: `nets` of `evaluate.wgsl`.
    data: Vec<[u32; 4]>,
    /// Rings of the finest grid in use, and flames; nothing to do when there are none.
    workgroups: [u32; 2],
    group: Option<wgpu::BindGroup>,
    /// The vertices that `group` writes.
    vertices: Option<wgpu::Buffer>,
}

impl Evaluator {
    pub(crate) fn new(device: &Device) -> Self {
        let growing = |label, bytes| GrowBuffer::new(device, label, BufferUsages::STORAGE, bytes);
        Self {
            tables: growing("grids", 1 << 14),
            points: growing("control points", 1 << 14),
            nets: growing("nets", 1 << 8),
            shapes: Vec::new(),
            revision: None,
            data: Vec::new(),
            workgroups: [0; 2],
            group: None,
            vertices: None,
        }
    }

    /// Checks the nets of a frame; grids that are new come back for [`prepare`](Self::prepare).
    pub(crate) fn check(
        &self,
        frame: &Frame<'_>,
        limits: &wgpu::Limits,
    ) -> Result<Option<Vec<GridShape>>, RenderError> {
        let Some(nets) = &frame.flame_nets else { return Ok(None) };
        let is_new = self.revision != Some(nets.grid_revision);
        let new = if is_new { Some(check_grids(nets, limits)?) } else { None };
        check_nets(nets, new.as_deref().unwrap_or(&self.shapes), frame, limits)?;
        Ok(new)
    }

    /// Uploads the nets of a frame that was checked, and makes room for the vertices.
    pub(crate) fn prepare(
        &mut self,
        device: &Device,
        queue: &Queue,
        layout: &wgpu::BindGroupLayout,
        (frame, new): (&Frame<'_>, Option<Vec<GridShape>>),
        vertices: &mut GrowBuffer,
    ) {
        self.workgroups = [0; 2];
        let Some(nets) = &frame.flame_nets else { return };
        let mut changed = vertices.reserve(device, vertex_bytes(frame));
        if let Some(shapes) = new {
            let tables: Vec<u8> = nets.grids.iter().flat_map(|grid| &grid.tables).copied().collect();
            changed |= self.tables.write(device, queue, &tables);
            (self.shapes, self.revision) = (shapes, Some(nets.grid_revision));
        }
        self.data.clear();
        for (net, draw) in nets.nets.iter().zip(frame.flame_draws) {
            let shape = self.shapes[net.grid as usize];
            self.data.push([shape.start, net.first_point, draw.first_vertex, 0]);
            self.workgroups = [self.workgroups[0].max(shape.rings), self.data.len() as u32];
        }
        changed |= self.points.write(device, queue, bytemuck::cast_slice(nets.points));
        changed |= self.nets.write(device, queue, bytemuck::cast_slice(&self.data));
        // The vertices' buffer may also have grown in a frame without nets.
        if changed || self.vertices.as_ref() != Some(&vertices.buffer) {
            let bound = vertices.buffer.size().min(device.limits().max_storage_buffer_binding_size);
            let bound = wgpu::BufferBinding { buffer: &vertices.buffer, offset: 0, size: NonZeroU64::new(bound) };
            let [tables, points, nets] =
                [&self.tables, &self.points, &self.nets].map(|buffer| buffer.buffer.as_entire_binding());
            let resources = [tables, points, nets, BindingResource::Buffer(bound)];
            self.group = Some(group(device, "evaluate", layout, &resources));
            self.vertices = Some(vertices.buffer.clone());
        }
    }

    /// The control points of net `index` of a frame that was checked.
    pub(crate) fn points<'a>(&self, nets: &FlameNets<'a>, index: usize) -> &'a [[f32; 4]] {
        let net = nets.nets[index];
        &nets.points[net.first_point as usize..][..self.shapes[net.grid as usize].points as usize]
    }
}

impl FireRenderer {
    pub(crate) fn record_surfaces(&self, encoder: &mut wgpu::CommandEncoder) {
        let [rings, flames] = self.evaluator.workgroups;
        let Some(group) = self.evaluator.group.as_ref().filter(|_| flames > 0) else { return };
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("evaluate"), timestamp_writes: None });
        pass.set_pipeline(&self.pipelines.evaluate);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(rings, flames, 1);
    }
}
