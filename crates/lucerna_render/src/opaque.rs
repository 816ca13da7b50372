//! The opaque scene: colour with soft edges, and the single depth that the flames are tested against.

use crate::renderer::FireRenderer;
use crate::targets::Targets;

impl FireRenderer {
    pub(crate) fn record_opaque(&self, targets: &Targets, encoder: &mut wgpu::CommandEncoder) {
        let [r, g, b] = self.background.map(f64::from);
        let (color, depth, resolve) = match &targets.multisampled {
            Some((color, depth)) => (color, depth, Some(&targets.opaque)),
            None => (&targets.opaque, &targets.scene_depth, None),
        };
        let is_multisampled = usize::from(resolve.is_some());
        // Where light is dear, only what is seen is lit.
        let depth_is_known = self.lighting.is_dear();
        if depth_is_known {
            self.record_depth(encoder, depth, &self.pipelines.depth[is_multisampled]);
        }
        let depth_load = if depth_is_known { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(1.0) };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("opaque"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: color,
                depth_slice: None,
                resolve_target: resolve,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 }),
                    store: if resolve.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store },
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth,
                depth_ops: Some(wgpu::Operations { load: depth_load, store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        let shadows = usize::from(self.lighting.shadows.count() > 0);
        self.draw_meshes(&mut pass, &self.pipelines.opaque[is_multisampled][shadows]);
        drop(pass);
        if targets.multisampled.is_some() {
            // Several depths a pixel cannot be compared with one: the flames get a depth of their own.
            self.record_depth(encoder, &targets.scene_depth, &self.pipelines.depth[0]);
        }
    }

    fn record_depth(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        depth: &wgpu::TextureView,
        pipeline: &wgpu::RenderPipeline,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene depth"),
            depth_stencil_attachment: Some(cleared(depth)),
            ..Default::default()
        });
        self.draw_meshes(&mut pass, pipeline);
    }

    fn draw_meshes(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
        if self.mesh_index_count == 0 {
            return;
        }
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.common_group, &[]);
        pass.set_bind_group(1, &self.lighting.group, &[]);
        pass.set_vertex_buffer(0, self.mesh_vertices.buffer.slice(..));
        pass.set_index_buffer(self.mesh_indices.buffer.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.mesh_index_count, 0, 0..1);
    }
}

/// A depth attachment that starts at the far plane.
pub(crate) fn cleared(view: &wgpu::TextureView) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}
