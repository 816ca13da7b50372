//! The window: the fire, and a panel with every parameter in the order in which a picture is made.

mod app;
mod capture;
mod document;
mod meters;
mod orbit;
mod panel;
mod panel_air;
mod panel_camera;
mod panel_fire;
mod panel_picture;
mod panel_scene;
mod panel_shade;
mod panel_statistics;
mod viewport;
mod widgets;

use crate::cli::WindowArgs;
use crate::gpu;
use anyhow::{Result, anyhow, bail};
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetupCreateNew};
use lucerna::scene::LoadedScene;
use std::sync::Arc;

/// Size of a window in points where none is given.
const SIZE: [u32; 2] = [1280, 800];

/// What a window is opened with.
#[derive(Clone, Debug)]
pub struct WindowJob {
    /// Name or path of the scene.
    pub name: String,
    /// What burns.
    pub scene: LoadedScene,
    /// The preset that was applied.
    pub preset: Option<String>,
    /// How the window behaves.
    pub window: WindowArgs,
    /// Size in points.
    pub size: Option<[u32; 2]>,
}

/// Opens a window and returns when it is closed; fails where no window can be opened.
pub fn run(job: WindowJob) -> Result<()> {
    check_display()?;
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = wgpu::Backends::PRIMARY;
    setup.device_descriptor = Arc::new(|_| gpu::device_descriptor());
    let size = job.size.unwrap_or(SIZE).map(|side| side as f32);
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default().with_inner_size(size).with_min_inner_size([400.0, 300.0]),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: WgpuConfiguration { wgpu_setup: setup.into(), ..Default::default() },
        // The fire is dithered where it is composed.
        dithering: false,
        ..Default::default()
    };
    let outcome = Arc::new(std::sync::Mutex::new(Ok(())));
    let app_outcome = Arc::clone(&outcome);
    let title = format!("Lucerna: {}", job.scene.scene.name);
    eframe::run_native(
        &title,
        options,
        Box::new(move |context| Ok(Box::new(app::App::new(context, job, app_outcome).map_err(anyhow::Error::into_boxed_dyn_error)?))),
    )
    .map_err(|error| anyhow!("no window could be opened: {error}"))?;
    std::mem::replace(&mut *outcome.lock().unwrap_or_else(std::sync::PoisonError::into_inner), Ok(()))
}

/// Says early and plainly that there is no display.
fn check_display() -> Result<()> {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(target_os = "linux") && !set("DISPLAY") {
        if set("WAYLAND_DISPLAY") {
            bail!("there is no X11 display: start XWayland and set DISPLAY to open a window");
        }
        bail!("there is no display: DISPLAY is not set");
    }
    Ok(())
}
