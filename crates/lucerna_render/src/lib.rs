//! A wgpu renderer for fire: exact depth peeling, chord shading and two-resolution glow.
//!
//! It takes the caller's device, queue and encoder; it never creates a device and reads no file.

use lucerna_frame::{Camera, Frame, Look};

/// Why a frame could not be prepared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {}

/// The passes of one frame, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The opaque scene, lit by the flames.
    Opaque,
    /// The flames: peeling and shading.
    Peel,
    /// The blurred copies.
    Glow,
    /// Everything into the target.
    Compose,
}

impl Stage {
    /// All stages in the order in which they are recorded.
    pub const ALL: [Stage; 4] = [Stage::Opaque, Stage::Peel, Stage::Glow, Stage::Compose];
}

/// What the GPU counted in the last frame that was drawn with statistics on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Most flame surfaces behind any pixel: the layers that would show everything.
    pub layers: u32,
    /// Pixels times intervals that were still open at the last layer.
    pub open_intervals: u32,
}

/// Draws fire.
#[derive(Debug)]
pub struct FireRenderer {}

impl FireRenderer {
    /// Makes all pipelines for a target of the given format.
    #[must_use]
    pub fn new(_device: &wgpu::Device, _queue: &wgpu::Queue, _target: wgpu::TextureFormat) -> Self {
        Self {}
    }
    /// Uploads a frame; textures are made anew only when the size, the number of layers or of samples changed.
    pub fn prepare(
        &mut self,
        _device: &wgpu::Device,
        _queue: &wgpu::Queue,
        _size_px: [u32; 2],
        _frame: &Frame<'_>,
        _camera: &Camera,
        _look: &Look,
    ) -> Result<(), RenderError> {
        Ok(())
    }
    /// Records one stage; `target` is used by [`Stage::Compose`] only.
    pub fn record(&self, _stage: Stage, _encoder: &mut wgpu::CommandEncoder, _target: &wgpu::TextureView) {}
    /// Records all stages.
    pub fn render(&self, encoder: &mut wgpu::CommandEncoder, target: &wgpu::TextureView) {
        for stage in Stage::ALL {
            self.record(stage, encoder, target);
        }
    }
    /// Counts layers and open intervals from now on (an extra pass), or stops.
    pub fn set_statistics(&mut self, _on: bool) {}
    /// Reads what was counted in the last frame; waits for the GPU.
    pub fn read_statistics(&self, _device: &wgpu::Device, _queue: &wgpu::Queue) -> Result<Statistics, RenderError> {
        Ok(Statistics::default())
    }
}
