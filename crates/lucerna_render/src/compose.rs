//! Everything into the target.

use crate::data::{ComposeData, MAX_GLOW};
use crate::renderer::FireRenderer;
use crate::targets::Targets;
use lucerna_frame::{DebugView, Look};

/// A rectangle that no pixel is in.
const NOWHERE: [f32; 4] = [1.0, 1.0, -1.0, -1.0];

/// What `compose.wgsl` is told: `bounds` are the pixels of the flames, `radii` the reach of the blurs in texels.
pub(crate) fn compose_data(look: &Look, bounds: Option<[u32; 4]>, radii: &[u32; MAX_GLOW]) -> ComposeData {
    let mut gains = [0.0; MAX_GLOW];
    let mut reach = [NOWHERE; MAX_GLOW];
    for (index, level) in look.glow.iter().enumerate() {
        gains[index] = level.gain;
        reach[index] = grown(bounds, level.divisor * (radii[index] + 2));
    }
    if look.glow.is_empty() {
        gains[0] = 1.0;
        reach[0] = grown(bounds, 1);
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
    ComposeData { gains, debug: [debug[0], debug[1], 0, 0], reach }
}

/// First and last pixel of the flames' bounds with a border.
fn grown(bounds: Option<[u32; 4]>, border: u32) -> [f32; 4] {
    let Some([x, y, width, height]) = bounds else { return NOWHERE };
    let border = border as f32;
    [x as f32 - border, y as f32 - border, (x + width) as f32 + border, (y + height) as f32 + border]
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
        let which = if self.debug == DebugView::Final { usize::from(over) } else { 2 };
        pass.set_pipeline(&self.pipelines.compose[which]);
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
