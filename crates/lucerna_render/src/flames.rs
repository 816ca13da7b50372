//! The flames: peeled in depth order and shaded, or added in one pass.

use crate::opaque::cleared;
use crate::renderer::FireRenderer;
use crate::targets::Targets;
use lucerna_frame::{DebugView, Shading, Transparency};

/// A colour attachment that starts at zero.
pub(crate) fn blank(view: &wgpu::TextureView) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
    })
}

impl FireRenderer {
    pub(crate) fn record_flames(&self, targets: &Targets, encoder: &mut wgpu::CommandEncoder) {
        let unsorted = self.mode == (Shading::Shell, Transparency::Unsorted);
        if !unsorted || matches!(self.debug, DebugView::Layer(_)) {
            self.record_layers(targets, encoder);
        }
        if self.counts_layers || self.debug == DebugView::LayerCount {
            let mut pass = color_pass(encoder, "count", &targets.count);
            self.draw_flames(&mut pass, &self.pipelines.count, &targets.peel_groups[0]);
        }
        let mut pass = color_pass(encoder, "flames", &targets.flames);
        if unsorted {
            pass.set_bind_group(2, &self.texture_group, &[]);
            self.draw_flames(&mut pass, &self.pipelines.unsorted, &targets.peel_groups[0]);
            return;
        }
        let Some([x, y, width, height]) = self.flame_bounds else { return };
        pass.set_scissor_rect(x, y, width, height);
        pass.set_bind_group(0, &self.common_group, &[]);
        if self.mode.0 == Shading::Shell {
            pass.set_pipeline(&self.pipelines.shell);
            pass.set_bind_group(1, &targets.shell_group, &[]);
            pass.set_bind_group(2, &self.texture_group, &[]);
        } else {
            pass.set_pipeline(&self.pipelines.volume);
            pass.set_bind_group(1, &targets.volume_group, &[]);
        }
        pass.draw(0..3, 0..1);
    }

    fn record_layers(&self, targets: &Targets, encoder: &mut wgpu::CommandEncoder) {
        for layer in 0..targets.layer_depths.len() {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("peel"),
                color_attachments: &[blank(&targets.layer_surfaces[layer])],
                depth_stencil_attachment: Some(cleared(&targets.layer_depths[layer])),
                ..Default::default()
            });
            let pipeline = if layer == 0 { &self.pipelines.peel_first } else { &self.pipelines.peel_next };
            self.draw_flames(&mut pass, pipeline, &targets.peel_groups[layer]);
        }
    }

    fn draw_flames(&self, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline, group: &wgpu::BindGroup) {
        let Some([x, y, width, height]) = self.flame_bounds else { return };
        pass.set_scissor_rect(x, y, width, height);
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.common_group, &[]);
        pass.set_bind_group(1, group, &[]);
        pass.set_vertex_buffer(0, self.flame_vertices.buffer.slice(..));
        pass.set_index_buffer(self.flame_indices.buffer.slice(..), wgpu::IndexFormat::Uint32);
        for draw in &self.flame_draws {
            let indices = draw.first_index..draw.first_index + draw.index_count;
            pass.draw_indexed(indices, draw.first_vertex as i32, 0..1);
        }
    }
}

pub(crate) fn color_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    view: &wgpu::TextureView,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[blank(view)],
        ..Default::default()
    })
}
