//! The window: the fire, and a panel with every parameter in the order in which a picture is made.

mod app;
mod capture;
mod document;
mod fuel_curve;
mod history;
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
mod panel_wicks;
mod pick;
mod points;
mod viewport;
mod wick_edit;
mod widgets;

use crate::cli::{SurfacesArg, WindowArgs};
use crate::gpu;
use anyhow::{Result, anyhow, bail};
use app::App;
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetupCreateNew};
use lucerna::scene::LoadedScene;
use std::sync::{Arc, Mutex, PoisonError};

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
    /// Where the vertices of flames are made.
    pub surfaces: SurfacesArg,
    /// How the window behaves.
    pub window: WindowArgs,
    /// Size in points.
    pub size: Option<[u32; 2]>,
}

/// What became of a window.
#[derive(Debug)]
pub enum Outcome {
    /// It was open and has been closed.
    Closed,
    /// It could not be opened, for this reason.
    NotOpened(anyhow::Error),
}

/// Opens a window and returns when it is closed.
pub fn run(job: WindowJob) -> Result<Outcome> {
    if let Err(error) = check_display() {
        return Ok(Outcome::NotOpened(error));
    }
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
    let result = Arc::new(Mutex::new(Ok(())));
    let app_result = Arc::clone(&result);
    let title = format!("Lucerna: {}", job.scene.scene.name);
    let make = move |context: &eframe::CreationContext<'_>| {
        let app = App::new(context, job, app_result).map_err(anyhow::Error::into_boxed_dyn_error)?;
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    match eframe::run_native(&title, options, Box::new(make)) {
        Ok(()) => {
            let mut result = result.lock().unwrap_or_else(PoisonError::into_inner);
            std::mem::replace(&mut *result, Ok(())).map(|()| Outcome::Closed)
        }
        Err(eframe::Error::AppCreation(error)) => Err(anyhow!(error)),
        Err(eframe::Error::WinitEventLoop(_)) => Ok(Outcome::NotOpened(anyhow!("the display cannot be reached"))),
        Err(error) => Ok(Outcome::NotOpened(anyhow!("no window could be opened: {error}"))),
    }
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
