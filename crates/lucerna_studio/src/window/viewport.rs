//! The part of the window in which the fire is drawn: into a texture that egui shows as an image.

use super::meters::Meters;
use crate::gpu::{Gpu, TARGET_FORMAT, Target};
use crate::record::png;
use anyhow::{Context, Result};
use eframe::egui_wgpu::{self, wgpu::FilterMode};
use lucerna::World;
use lucerna::frame::{Camera, Look};
use lucerna::render::{FireRenderer, Stage};
use std::path::Path;
use std::time::Instant;

/// Every so many frames the stages are drawn and waited for one by one, to measure them.
const MEASURE_EVERY: u64 = 15;

/// Draws the fire at the size of the viewport.
pub(super) struct Viewport {
    gpu: Gpu,
    egui: egui_wgpu::RenderState,
    renderer: FireRenderer,
    target: Option<Target>,
    texture: Option<egui::TextureId>,
    frames: u64,
}

impl Viewport {
    pub(super) fn new(context: &eframe::CreationContext<'_>) -> Result<Self> {
        let egui = context.wgpu_render_state.clone().context("the window has no graphics device")?;
        let gpu = Gpu::from_parts(egui.device.clone(), egui.queue.clone(), &egui.adapter.get_info());
        let renderer = FireRenderer::new(&gpu.device, &gpu.queue, TARGET_FORMAT);
        gpu.check()?;
        Ok(Self { gpu, egui, renderer, target: None, texture: None, frames: 0 })
    }

    /// The graphics adapter in words.
    pub(super) fn adapter(&self) -> &str {
        &self.gpu.adapter
    }

    /// The texture that shows what was drawn last.
    pub(super) fn texture(&self) -> Option<egui::TextureId> {
        self.texture
    }

    /// Draws the world as it is now.
    pub(super) fn draw(
        &mut self,
        size_px: [u32; 2],
        world: &World,
        (camera, look): (&Camera, &Look),
        layers_counted: bool,
        meters: &mut Meters,
    ) -> Result<()> {
        self.resize(size_px)?;
        let Some(target) = &self.target else {
            return Ok(());
        };
        let measured = self.frames.is_multiple_of(MEASURE_EVERY);
        self.frames += 1;
        let began = Instant::now();
        self.renderer.set_statistics(layers_counted && measured);
        let gpu = &self.gpu;
        self.renderer.prepare(&gpu.device, &gpu.queue, size_px, &world.frame(), camera, look)?;
        if measured {
            gpu.submit(gpu.encoder());
            gpu.wait()?;
            meters.upload.push(began.elapsed().as_secs_f64() * 1e3);
            for (stage, meter) in Stage::ALL.into_iter().zip(&mut meters.gpu) {
                let began = Instant::now();
                let mut encoder = gpu.encoder();
                self.renderer.record(stage, &mut encoder, &target.view);
                gpu.submit(encoder);
                gpu.wait()?;
                meter.push(began.elapsed().as_secs_f64() * 1e3);
            }
            meters.layers = match layers_counted {
                true => Some(self.renderer.read_statistics(&gpu.device, &gpu.queue)?),
                false => None,
            };
        } else {
            let mut encoder = gpu.encoder();
            self.renderer.render(&mut encoder, &target.view);
            gpu.submit(encoder);
        }
        gpu.check()
    }

    /// Writes what was drawn last.
    pub(super) fn save(&self, path: &Path) -> Result<()> {
        let target = self.target.as_ref().context("nothing has been drawn yet")?;
        let mut rgb = Vec::new();
        target.read(&self.gpu, &mut rgb)?;
        png::write(path, target.size_px(), &rgb)
    }

    /// Makes the texture anew where the size changed.
    fn resize(&mut self, size_px: [u32; 2]) -> Result<()> {
        if self.target.as_ref().is_some_and(|target| target.size_px() == size_px) {
            return Ok(());
        }
        let target = Target::new(&self.gpu, size_px)?;
        let view = target.display_view();
        let mut renderer = self.egui.renderer.write();
        match self.texture {
            Some(id) => {
                renderer.update_egui_texture_from_wgpu_texture(&self.gpu.device, &view, FilterMode::Nearest, id);
            }
            None => self.texture = Some(renderer.register_native_texture(&self.gpu.device, &view, FilterMode::Nearest)),
        }
        self.target = Some(target);
        Ok(())
    }
}
