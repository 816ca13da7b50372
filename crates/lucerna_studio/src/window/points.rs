//! The points of wicks on the picture: what the mouse does to them, and how they are shown.

use super::app::App;
use super::pick::Sight;
use super::wick_edit::{Stand, WickEdit};
use egui::{Color32, PointerButton, Rect};

impl App {
    /// Chooses, moves and adds points; says whether the mouse is busy with one.
    pub(super) fn draw_wicks(&mut self, ui: &egui::Ui, rect: Rect, response: &egui::Response) -> bool {
        let camera = self.document.edited.camera;
        let sight = Sight { camera: &camera, size: glam::Vec2::new(rect.width(), rect.height()) };
        let Some(at) = response.interact_pointer_pos() else {
            self.edit.dragging = false;
            return false;
        };
        let at = glam::Vec2::new(at.x - rect.left(), at.y - rect.top());
        let scene = &mut self.document.edited;
        let stands: Vec<Stand> = (0..scene.fires.len()).map(|fire| Stand::of(scene, &self.world, fire)).collect();
        let surface = |at| sight.surface(at, self.world.frame().meshes, 0.0);
        let near = WickEdit::near(scene, at, |fire, point| sight.place(stands[fire].in_world(point)));
        if response.clicked_by(PointerButton::Primary) {
            match near {
                Some(handle) => (self.edit.chosen, self.edit.fire) = (Some(handle), handle.fire),
                None => {
                    let fire = self.edit.chosen.map_or(self.edit.fire, |chosen| chosen.fire);
                    match surface(at) {
                        Some(point) => self.edit.add(scene, stands[fire].in_fire(point)),
                        None => self.view.notice = Some("there is nothing to put a point on".into()),
                    }
                }
            }
        }
        let began = ui.input(|input| input.pointer.press_origin());
        if response.drag_started_by(PointerButton::Primary) {
            let began = began.map_or(at, |at| glam::Vec2::new(at.x - rect.left(), at.y - rect.top()));
            let near = WickEdit::near(scene, began, |fire, point| sight.place(stands[fire].in_world(point)));
            if let Some(handle) = near {
                (self.edit.chosen, self.edit.fire, self.edit.dragging) = (Some(handle), handle.fire, true);
            }
        }
        if !response.dragged_by(PointerButton::Primary) {
            self.edit.dragging = false;
        }
        if let Some(chosen) = self.edit.chosen.filter(|_| self.edit.dragging) {
            let stand = stands[chosen.fire];
            let old = scene.fires[chosen.fire].wicks[chosen.wick].points().get(chosen.point).copied();
            let along_surfaces = ui.input(|input| input.modifiers.shift);
            let to = match (along_surfaces, old) {
                (false, Some(old)) => Some(sight.as_deep_as(at, stand.in_world(old))),
                _ => surface(at),
            };
            if let Some(to) = to {
                self.edit.drag(scene, stand.in_fire(to));
            }
        }
        self.edit.dragging
    }

    /// Shows the wicks' points over the picture.
    pub(super) fn show_points(&self, ui: &egui::Ui, rect: Rect) {
        let scene = &self.document.edited;
        let sight = Sight { camera: &scene.camera, size: glam::Vec2::new(rect.width(), rect.height()) };
        let painter = ui.painter_at(rect);
        let (line, chosen) = (Color32::from_rgb(90, 200, 255), Color32::from_rgb(255, 230, 90));
        let mut before = None;
        for (handle, point) in WickEdit::handles(scene) {
            let in_world = Stand::of(scene, &self.world, handle.fire).in_world(point);
            let at = sight.place(in_world).map(|at| rect.min + egui::vec2(at.x, at.y));
            if let (Some(at), Some((other, from))) = (at, before)
                && handle.point > 0
                && (handle.fire, handle.wick) == other
            {
                painter.line_segment([from, at], egui::Stroke::new(1.5, line));
            }
            if let Some(at) = at {
                let is_chosen = self.edit.chosen == Some(handle);
                painter.circle_filled(at, if is_chosen { 6.0 } else { 4.0 }, if is_chosen { chosen } else { line });
            }
            before = at.map(|at| ((handle.fire, handle.wick), at));
        }
    }
}
