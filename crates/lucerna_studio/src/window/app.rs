//! One frame of the window: keys, panel, step, draw.

use super::capture::{WindowCapture, free_name};
use super::document::Document;
use super::meters::Meters;
use super::viewport::Viewport;
use super::wick_edit::WickEdit;
use super::{WindowJob, orbit, panel};
use crate::cli::{SurfacesArg, WindowArgs};
use crate::headless::slices;
use crate::limits::SIDE_PX;
use crate::progress::say;
use anyhow::Result;
use egui::{Color32, Event, Key, PointerButton, Rect, Sense, ViewportCommand};
use lucerna::flame::Surfaces;
use lucerna::{DebugLines, World};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// Longest step of a frame, s: a slow machine shows slow fire rather than one that jumps.
const LONGEST_FRAME_S: f64 = 0.1;
/// What one press of S goes on by, s.
const SINGLE_STEP_S: f32 = 1.0 / 60.0;
/// The fire burns this long before it is first shown, s.
const WARMUP_S: f64 = 1.0;

/// What the panel can ask for.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Command {
    /// Goes on by one step.
    Step,
    /// Back to time zero.
    Reset,
    /// Saves a picture of the fire.
    Screenshot,
    /// Puts the camera where it was.
    ResetCamera,
    /// Opens a scene.
    Open(String),
    /// Takes the last change back.
    Undo,
    /// Does it again.
    Redo,
    /// Saves the scene.
    Save,
    /// Lets the next click begin a wick.
    NewWick,
    /// Adds a point after the chosen one.
    InsertPoint,
    /// Takes the chosen point away.
    DeletePoint,
}

/// What is on screen besides the scene itself.
#[derive(Debug, Default)]
pub(super) struct View {
    pub(super) paused: bool,
    pub(super) time_scale: f32,
    pub(super) lines: DebugLines,
    /// The graphics device makes the flames' vertices.
    pub(super) surfaces_on_device: bool,
    pub(super) layers_counted: bool,
    pub(super) preset: Option<String>,
    /// What happened last, such as where a picture went.
    pub(super) notice: Option<String>,
    pub(super) commands: Vec<Command>,
}

/// The window.
pub(super) struct App {
    pub(super) document: Document,
    pub(super) world: World,
    viewport: Viewport,
    meters: Meters,
    pub(super) view: View,
    pub(super) edit: WickEdit,
    window: WindowArgs,
    capture: WindowCapture,
    opened: Instant,
    /// Tells who opened the window why it failed.
    outcome: Arc<Mutex<Result<()>>>,
}

impl App {
    pub(super) fn new(
        context: &eframe::CreationContext<'_>,
        job: WindowJob,
        outcome: Arc<Mutex<Result<()>>>,
    ) -> Result<Self> {
        context.egui_ctx.set_theme(egui::Theme::Dark);
        let viewport = Viewport::new(context)?;
        let document = Document::new(job.name, &job.scene.scene);
        let mut world = World::new(job.scene)?;
        warm_up(&mut world)?;
        Ok(Self {
            world,
            document,
            viewport,
            meters: Meters::default(),
            view: View {
                time_scale: 1.0,
                preset: job.preset,
                surfaces_on_device: job.surfaces == SurfacesArg::Gpu,
                ..View::default()
            },
            edit: WickEdit::default(),
            window: job.window,
            capture: WindowCapture::default(),
            opened: Instant::now(),
            outcome,
        })
    }

    fn keys(&mut self, ui: &egui::Ui) {
        if ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        // A slow frame can end after the key is let go: what counts is what was held when it was pressed.
        let pressed_with = |key: Key, with: bool| {
            ui.input(|input| {
                input.events.iter().find_map(|event| match event {
                    Event::Key { key: found, pressed: true, modifiers, .. }
                        if *found == key && modifiers.command == with =>
                    {
                        Some(modifiers.shift)
                    }
                    _ => None,
                })
            })
        };
        if let Some(shift) = pressed_with(Key::Z, true) {
            self.view.commands.push(if shift { Command::Redo } else { Command::Undo });
        }
        for (key, command) in [(Key::Y, Command::Redo), (Key::S, Command::Save)] {
            if pressed_with(key, true).is_some() {
                self.view.commands.push(command);
            }
        }
        let pressed = |key| pressed_with(key, false).is_some();
        if pressed(Key::W) {
            self.edit.on = !self.edit.on;
        }
        if self.edit.on {
            for (key, asked) in [
                (Key::N, Command::NewWick),
                (Key::I, Command::InsertPoint),
                (Key::Delete, Command::DeletePoint),
                (Key::Backspace, Command::DeletePoint),
            ] {
                if pressed(key) {
                    self.view.commands.push(asked);
                }
            }
        }
        if pressed(Key::Space) {
            self.view.paused = !self.view.paused;
        }
        for (key, command) in [
            (Key::S, Command::Step),
            (Key::R, Command::Reset),
            (Key::P, Command::Screenshot),
            (Key::C, Command::ResetCamera),
        ] {
            if pressed(key) {
                self.view.commands.push(command);
            }
        }
        if pressed(Key::Escape) && self.edit.on {
            self.edit = WickEdit::default();
        } else if pressed(Key::Escape) {
            ui.ctx().send_viewport_cmd(ViewportCommand::Close);
        }
    }

    fn obey(&mut self, command: Command) -> Result<()> {
        match command {
            Command::Step => {
                self.view.paused = true;
                self.world.set_view(&self.document.active().camera)?;
                self.meters.push_step(&self.world.step(SINGLE_STEP_S)?);
            }
            Command::Reset => self.world.reset(),
            Command::ResetCamera => self.document.reset_camera(),
            Command::Undo => self.document.undo(),
            Command::Redo => self.document.redo(),
            Command::NewWick => self.edit.chosen = None,
            Command::InsertPoint => self.edit.insert(&mut self.document.edited),
            Command::DeletePoint => self.edit.delete(&mut self.document.edited),
            Command::Save => {
                let path = self.document.save()?;
                let full = std::path::absolute(&path).unwrap_or(path);
                let line = format!("saved {}", full.display());
                say(&line);
                self.view.notice = Some(line);
            }
            Command::Screenshot => {
                let path = free_name(Path::new(""))?;
                self.viewport.save(&path)?;
                let full = std::path::absolute(&path).unwrap_or(path);
                let line = format!("wrote {}", full.display());
                say(&line);
                self.view.notice = Some(line);
            }
            Command::Open(name) => {
                let (document, loaded) = Document::open(&name)?;
                // The same world goes on, so that its meshes are known to have changed.
                self.world.set_scene(loaded)?;
                // World and document are of the same scene from here on, whatever fails.
                self.document = document;
                self.edit = WickEdit::default();
                self.view.preset = None;
                self.view.notice = None;
                warm_up(&mut self.world)?;
            }
        }
        Ok(())
    }

    /// Goes on by the time that passed.
    fn step(&mut self, seconds: f64) {
        if self.view.paused {
            return;
        }
        let dt_s = (seconds.min(LONGEST_FRAME_S) * f64::from(self.view.time_scale)) as f32;
        // The level of detail is that of the picture.
        let seen = self.world.set_view(&self.document.active().camera);
        match seen.and_then(|()| self.world.step(dt_s)) {
            Ok(step) => self.meters.push_step(&step),
            Err(error) => {
                self.view.paused = true;
                self.view.notice = Some(error.to_string());
            }
        }
    }

    fn fire(&mut self, ui: &mut egui::Ui) {
        let rect = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        self.edit.refresh(&mut self.document.edited);
        let draws = self.edit.on && self.draw_wicks(ui, rect, &response);
        let camera = &mut self.document.edited.camera;
        let drag = glam::Vec2::new(response.drag_delta().x, response.drag_delta().y);
        if draws {
            // The mouse is on a point.
        } else if response.dragged_by(PointerButton::Primary) {
            orbit::orbit(camera, drag);
        } else if response.dragged() {
            orbit::pan(camera, drag, rect.height());
        }
        let scroll = ui.input(|input| input.smooth_scroll_delta().y);
        if response.hovered() && scroll != 0.0 {
            orbit::zoom(camera, scroll);
        }
        // A change is complete when the mouse is let go; points that are dragged do not start the fire anew until then.
        if !self.edit.dragging {
            self.document.apply(&mut self.world);
        }
        if !ui.input(|input| input.pointer.any_down()) {
            self.document.record();
        }
        self.world.set_debug_lines(self.view.lines);
        let on_device = self.view.surfaces_on_device;
        self.world.set_surfaces(if on_device { Surfaces::Nets } else { Surfaces::Vertices });

        let side =
            |points: f32| ((points * ui.pixels_per_point()).round() as u32).clamp(*SIDE_PX.start(), *SIDE_PX.end());
        let size_px = [side(rect.width()), side(rect.height())];
        let scene = self.document.active();
        let (look, counted) = ((&scene.camera, &scene.look), self.view.layers_counted);
        if let Err(error) = self.viewport.draw(size_px, &self.world, look, counted, &mut self.meters) {
            self.view.notice = Some(format!("{error:#}"));
        }
        if let Some(texture) = self.viewport.texture() {
            let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            ui.painter().image(texture, rect, whole, Color32::WHITE);
        }
        if self.edit.on {
            self.show_points(ui, rect);
        }
    }

    /// Closes the window when its time is over, after taking its picture.
    fn exit_in_time(&mut self, context: &egui::Context) {
        let Some(after) = self.window.exit_after else {
            return;
        };
        if self.opened.elapsed().as_secs_f64() < after {
            return;
        }
        if let Some(path) = &self.window.screenshot {
            self.capture.ask(context);
            match self.capture.write(path) {
                Ok(false) => return,
                Ok(true) => say(&format!("wrote {}", path.display())),
                Err(error) => *self.outcome.lock().unwrap_or_else(PoisonError::into_inner) = Err(error),
            }
        }
        context.send_viewport_cmd(ViewportCommand::Close);
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let seconds = self.meters.begin_frame();
        self.keys(ui);
        egui::Panel::right("panel").default_size(370.0).show(ui, |ui| {
            panel::show(
                ui,
                &mut self.document,
                &mut self.edit,
                &mut self.view,
                &self.meters,
                &self.world,
                self.viewport.adapter(),
            );
        });
        for command in std::mem::take(&mut self.view.commands) {
            if let Err(error) = self.obey(command) {
                self.view.notice = Some(format!("{error:#}"));
            }
        }
        self.step(seconds);
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| self.fire(ui));
        self.exit_in_time(ui.ctx());
        ui.ctx().request_repaint();
    }
}

/// Lets the fire grow before it is shown.
fn warm_up(world: &mut World) -> Result<()> {
    let slices = slices(WARMUP_S, f64::from(world.scene().scene.air.time_step_s));
    for _ in 0..slices {
        world.step((WARMUP_S / f64::from(slices)) as f32)?;
    }
    Ok(())
}
