//! Everything into the target.

use crate::data::{ComposeData, MAX_GLOW};
use crate::renderer::FireRenderer;
use crate::targets::Targets;
use lucerna_frame::{DebugView, Look};

/// What `compose.wgsl` is told.
pub(crate) fn compose_data(look: &Look, size: [u32; 2]) -> ComposeData {
    let mut gains = [0.0; MAX_GLOW];
    for (gain, level) in gains.iter_mut().zip(&look.glow) {
        *gain = level.gain;
    }
    if look.glow.is_empty() {
        gains[0] = 1.0;
    }
    // A copy of n texels shows n times its divisor pixels, which may be more than the picture has.
    let mut uv_per_pixel = [[0.0; 4]; MAX_GLOW];
    for (index, uv) in uv_per_pixel.iter_mut().enumerate() {
        let divisor = look.glow.get(index).map_or(1, |level| level.divisor);
        let [x, y] = size.map(|side| 1.0 / (side.div_ceil(divisor) * divisor) as f32);
        *uv = [x, y, 0.0, 0.0];
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
    ComposeData { gains, debug: [debug[0], debug[1], 0, 0], uv_per_pixel }
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
        pass.set_bind_group(0, &self.common_group, &[]);
        pass.set_bind_group(1, &targets.compose_group, &[]);
        if self.debug != DebugView::Final {
            pass.set_pipeline(&self.pipelines.debug);
            pass.draw(0..3, 0..1);
        } else {
            if !over {
                // Where no glow reaches there is only the scene.
                pass.set_pipeline(&self.pipelines.compose.scene);
                pass.draw(0..3, 0..1);
            }
            if let Some([x, y, width, height]) = self.glow_reach(targets) {
                let levels = &self.pipelines.compose.levels[targets.glow.len().max(1) - 1];
                let sharpest_is_full = targets.glow.first().is_none_or(|level| level.divisor == 1);
                pass.set_scissor_rect(x, y, width, height);
                pass.set_pipeline(&levels[usize::from(over)][usize::from(sharpest_is_full)]);
                pass.draw(0..3, 0..1);
                pass.set_scissor_rect(0, 0, targets.shape.size[0], targets.shape.size[1]);
            }
        }
        if self.line_vertex_count > 0 {
            pass.set_pipeline(&self.pipelines.lines);
            pass.set_vertex_buffer(0, self.lines.buffer.slice(..));
            pass.draw(0..self.line_vertex_count, 0..1);
        }
    }
}

impl FireRenderer {
    /// The pixels that any blurred copy reaches: x, y, width, height.
    fn glow_reach(&self, targets: &Targets) -> Option<[u32; 4]> {
        let [x, y, width, height] = self.flame_bounds?;
        let reach = |(level, radius): (&crate::targets::GlowTarget, u32)| level.divisor * (radius + 2);
        let border = targets.glow.iter().zip(self.glow_radii).map(reach).max().unwrap_or(0);
        let [right, bottom] = [x + width + border, y + height + border];
        let (x, y) = (x.saturating_sub(border), y.saturating_sub(border));
        Some([x, y, right.min(targets.shape.size[0]) - x, bottom.min(targets.shape.size[1]) - y])
    }
}
