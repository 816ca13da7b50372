//! The wicks: drawing them, and undoing, saving.

use super::app::{Command, View};
use super::wick_edit::WickEdit;
use super::widgets::section;
use egui::Ui;
use lucerna::scene::{Scene, WickSource};

pub(super) fn show(ui: &mut Ui, scene: &mut Scene, edit: &mut WickEdit, view: &mut View) {
    ui.horizontal_wrapped(|ui| {
        for (text, tooltip, command) in [
            ("Undo", "Takes the last change back (Ctrl+Z).", Command::Undo),
            ("Redo", "Does it again (Ctrl+Y or Ctrl+Shift+Z).", Command::Redo),
            (
                "Save",
                "Saves the scene: a file in its place, a built-in scene in the current folder (Ctrl+S).",
                Command::Save,
            ),
        ] {
            if ui.button(text).on_hover_text(tooltip).clicked() {
                view.commands.push(command);
            }
        }
        let tooltip = "Shows the points of all wicks; clicks on the scene add some (W).";
        ui.toggle_value(&mut edit.on, "Draw wicks").on_hover_text(tooltip);
    });
    if !edit.on {
        return;
    }
    section(ui, "Wicks", true, |ui| {
        ui.label("Click: a point after the chosen one, on what is there.\nDrag a point: moves it; with Shift along surfaces.");
        ui.end_row();
        ui.horizontal_wrapped(|ui| {
            for (text, tooltip, command) in [
                ("New", "The next click begins another wick (N).", Command::NewWick),
                ("Insert", "A point after the chosen one (I).", Command::InsertPoint),
                ("Delete", "Takes the chosen point away (Delete).", Command::DeletePoint),
            ] {
                if ui.button(text).on_hover_text(tooltip).clicked() {
                    view.commands.push(command);
                }
            }
        });
        ui.end_row();
        if scene.fires.len() > 1 {
            ui.horizontal_wrapped(|ui| {
                for fire in 0..scene.fires.len() {
                    ui.selectable_value(&mut edit.fire, fire, format!("fire {}", fire + 1));
                }
            });
            ui.end_row();
        }
        let Some(chosen) = edit.chosen else { return };
        let Some(wick) = scene.fires.get_mut(chosen.fire).and_then(|fire| fire.wicks.get_mut(chosen.wick)) else {
            return;
        };
        ui.horizontal(|ui| {
            ui.label(format!("Fire {}, wick {}, point {}", chosen.fire + 1, chosen.wick + 1, chosen.point + 1));
            if let WickSource::Polyline { points, radius_m } = wick {
                if ui.small_button("smooth").on_hover_text("A curve through the points.").clicked() {
                    *wick = WickSource::Curve { points: points.clone(), radius_m: *radius_m, closed: false };
                }
            } else if let WickSource::Curve { points, radius_m, closed } = wick {
                ui.checkbox(closed, "closed").on_hover_text("Leads back to its first point: three arcs.");
                if ui.small_button("straight").on_hover_text("Straight from point to point.").clicked() {
                    *wick = WickSource::Polyline { points: points.clone(), radius_m: *radius_m };
                }
            }
        });
        ui.end_row();
    });
}
