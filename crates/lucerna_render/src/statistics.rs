//! What the GPU counts on request.

use crate::error::RenderError;
use crate::renderer::FireRenderer;
use std::time::Duration;

/// What the GPU counted in the last frame that was drawn with statistics on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Most flame surfaces behind any pixel: the layers that would show everything.
    pub layers: u32,
    /// Flames that were entered but not left when the layers ran out, over all pixels (`volume` shading). Surfaces beyond
    /// the last layer are not counted: compare `layers`.
    pub open_intervals: u32,
}

/// How long the GPU may take to answer.
const PATIENCE: Duration = Duration::from_secs(30);

impl FireRenderer {
    /// Reads what was counted in the last frame that was drawn after [`set_statistics`](Self::set_statistics).
    ///
    /// Waits for the GPU and makes buffers: not for every frame.
    ///
    /// # Errors
    /// [`RenderError::Timeout`] if the GPU does not answer.
    pub fn read_statistics(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Statistics, RenderError> {
        let Some(targets) = &self.targets else { return Ok(Statistics::default()) };
        let [width, height] = targets.shape.size;
        let row = (width * 2).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = |size| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("statistics"),
                size,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let (counts, open) = (buffer(u64::from(row * height)), buffer(4));
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            targets.count_texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &counts,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        encoder.copy_buffer_to_buffer(&self.open_intervals, 0, &open, 0, 4);
        queue.submit([encoder.finish()]);
        for buffer in [&counts, &open] {
            buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
        }
        let timeout = || RenderError::Timeout { seconds: PATIENCE.as_secs() };
        device.poll(wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) }).map_err(|_| timeout())?;
        let counted = counts.slice(..).get_mapped_range().map_err(|_| timeout())?;
        // Positive halves are ordered like their bits.
        let most = bytemuck::cast_slice::<u8, u16>(&counted).iter().copied().max().unwrap_or(0);
        let open = open.slice(..).get_mapped_range().map_err(|_| timeout())?;
        let open_intervals = bytemuck::pod_read_unaligned::<u32>(&open);
        Ok(Statistics { layers: half_to_count(most), open_intervals })
    }
}

/// A whole number from 0 to 2048 out of its half-precision bits.
fn half_to_count(bits: u16) -> u32 {
    let (exponent, mantissa) = (i32::from(bits >> 10) - 15, u32::from(bits & 0x3ff) | 0x400);
    match exponent {
        0..=10 => mantissa >> (10 - exponent),
        11.. => mantissa << (exponent - 10),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn halves_become_counts() {
        for (bits, count) in [(0u16, 0), (0x3c00, 1), (0x4000, 2), (0x4200, 3), (0x4880, 9), (0x6800, 2048)] {
            assert_eq!(super::half_to_count(bits), count);
        }
    }
}
