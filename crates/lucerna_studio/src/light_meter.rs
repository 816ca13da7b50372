//! How bright the picture is: the mean luminance of its linear light.

use crate::gpu::{Gpu, Target};
use anyhow::Result;
use lucerna::World;
use lucerna::frame::{DebugView, ToneMap};
use lucerna::render::FireRenderer;

/// Numbers that do not encode, so that nothing is tone mapped, cut off or dithered.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Luminance of linear sRGB (IEC 61966-2-1).
const LUMINANCE: [f32; 3] = [0.212_639, 0.715_168_7, 0.072_192_32];

/// Draws what a world's camera sees once more, and adds up the light.
#[derive(Debug)]
pub struct LightMeter {
    target: Target,
    renderer: FireRenderer,
}

impl LightMeter {
    /// A meter whose picture has this size; the mean hardly depends on it.
    pub fn new(gpu: &Gpu, size_px: [u32; 2]) -> Result<Self> {
        let target = Target::with_format(gpu, size_px, FORMAT)?;
        let renderer = FireRenderer::new(&gpu.device, &gpu.queue, FORMAT);
        gpu.check()?;
        Ok(Self { target, renderer })
    }

    /// Mean luminance of the picture with its glow, before exposure and tone mapping: 1 is what appears white at
    /// exposure 0.
    pub fn read(&mut self, gpu: &Gpu, world: &World) -> Result<f64> {
        let scene = &world.scene().scene;
        let mut look = scene.look.clone();
        (look.tone_map, look.debug) = (ToneMap::None, DebugView::Final);
        let camera = scene.camera_at(world.time_s());
        let size_px = self.target.size_px();
        self.renderer.prepare(&gpu.device, &gpu.queue, size_px, &world.frame(), &camera, &look)?;
        let mut encoder = gpu.encoder();
        self.renderer.render(&mut encoder, &self.target.view);
        gpu.submit(encoder);
        let mut sum = 0.0;
        self.target.read_rows(gpu, |row| {
            for pixel in row.as_chunks::<8>().0 {
                for (channel, weight) in pixel.as_chunks::<2>().0.iter().zip(LUMINANCE) {
                    sum += f64::from(weight * half(*channel));
                }
            }
        })?;
        let pixels = f64::from(size_px[0]) * f64::from(size_px[1]);
        Ok(sum / pixels / f64::from(look.exposure_stops).exp2())
    }
}

/// The value of a half float (IEEE 754 binary16) that is finite.
fn half(bytes: [u8; 2]) -> f32 {
    let bits = u16::from_le_bytes(bytes);
    let (exponent, fraction) = ((bits >> 10) & 0x1f, f32::from(bits & 0x3ff) / 1024.0);
    let size = match exponent {
        0 => fraction * 2.0_f32.powi(-14),
        _ => (1.0 + fraction) * 2.0_f32.powi(i32::from(exponent) - 15),
    };
    if bits >> 15 == 0 { size } else { -size }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_floats_are_read() {
        for (bits, value) in [
            (0x0000, 0.0),
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x7bff, 65504.0),
            (0x3555, 0.333_251_95),
            (0x0001, 5.960_464_5e-8),
        ] {
            assert_eq!(half(u16::to_le_bytes(bits)), value, "{bits:#x}");
        }
    }
}
