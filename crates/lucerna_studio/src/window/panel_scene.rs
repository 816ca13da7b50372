//! Which scene burns, and time.

use super::app::{Command, View};
use super::document::Document;
use super::widgets::{fact, number, pick, section, slider};
use egui::Ui;

pub(super) fn show(ui: &mut Ui, document: &mut Document, view: &mut View) {
    section(ui, "Scene", true, |ui| {
        let names = lucerna::scene::builtin_names();
        let selected = names.iter().position(|name| *name == document.name);
        let tooltip = "The built-in scenes. A scene file is opened with: lucerna view FILE";
        if selected.is_none() {
            fact(ui, "File", &document.name, "The scene file.");
        }
        if let Some(index) = pick(ui, selected, names.iter().copied(), "Scene", tooltip) {
            view.commands.push(Command::Open(names[index].into()));
        }
        let presets = lucerna::scene::presets();
        let selected = presets.iter().position(|name| Some(*name) == view.preset.as_deref());
        let tooltip = "Starts from the scene as it was opened and changes many parameters at once.";
        if let Some(index) = pick(ui, selected, presets.iter().copied(), "Preset", tooltip) {
            document.apply_preset(presets[index]);
            view.preset = Some(presets[index].into());
        }
        number(ui, &mut document.edited.seed, 0.1, "Seed", "", "Everything random is drawn from it.");
        let tooltip = "Speed of time; 1 is real time.";
        slider(ui, &mut view.time_scale, 0.0..=2.0, "Time", "x", tooltip);
    });
    ui.horizontal_wrapped(|ui| {
        let pause = if view.paused { "Burn" } else { "Pause" };
        if ui.button(pause).on_hover_text("Stops time, or lets it go on (Space).").clicked() {
            view.paused = !view.paused;
        }
        for (text, tooltip, command) in [
            ("Step", "Stops time and goes on by a sixtieth of a second (S).", Command::Step),
            ("Reset", "Back to time zero (R).", Command::Reset),
            ("Screenshot", "Saves the fire as lucerna-NNN.png in the current folder (P).", Command::Screenshot),
            ("Camera", "Puts the camera where it was when the scene was opened (C).", Command::ResetCamera),
        ] {
            if ui.button(text).on_hover_text(tooltip).clicked() {
                view.commands.push(command);
            }
        }
    });
    ui.add_space(4.0);
}
