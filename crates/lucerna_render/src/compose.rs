//! Everything into the target.

use crate::data::{ComposeData, MAX_GLOW};
use crate::renderer::FireRenderer;
use crate::targets::Targets;
use lucerna_frame::{DebugView, Look};

/// What `compose.wgsl` is told.
pub(crate) fn compose_data(look: &Look) -> ComposeData {
    let mut gains = [0.0; MAX_GLOW];
    for (gain, level) in gains.iter_mut().zip(&look.glow) {
        *gain = level.gain;
    }
    if look.glow.is_empty() {
        gains[0] = 1.0;
    }
    let debug = match look.debug {
        DebugView::Final => [0, 0],
        DebugView::Layer(layer) => [1, layer.min(look.layers - 1)],
        DebugView::LayerCount => [2, 0],
        DebugView::Flames => [3, 0],
        DebugView::Glow(level) => {
            for (index, gain) in gains.iter_mut().enumerate() {
                *gain = f32::from(u8::from(index == level as usize));
            }
            [4, 0]
        }
        DebugView::Opaque => [5, 0],
    };
    ComposeData { gains, debug: [debug[0], debug[1], 0, 0] }
}

impl FireRenderer {
    pub(crate) fn record_compose(
        &self,
        targets: &Targets,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
    ) {
        let over = self.scene_depth.is_some();
        let load = if over { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::BLACK) };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("compose"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipelines.compose[usize::from(over)]);
        pass.set_bind_group(0, &self.common_group, &[]);
        pass.set_bind_group(1, &targets.compose_group, &[]);
        pass.draw(0..3, 0..1);
        if self.line_vertex_count > 0 {
            pass.set_pipeline(&self.pipelines.lines);
            pass.set_vertex_buffer(0, self.lines.buffer.slice(..));
            pass.draw(0..self.line_vertex_count, 0..1);
        }
    }
}
