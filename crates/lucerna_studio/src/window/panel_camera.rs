//! Camera and look.

use super::app::{Command, View};
use super::document::Document;
use super::widgets::{choice, color, log_slider, section, slider, vector};
use egui::Ui;
use lucerna::frame::ToneMap;

pub(super) fn show(ui: &mut Ui, document: &mut Document, view: &mut View) {
    let camera = &mut document.edited.camera;
    section(ui, "Camera", false, |ui| {
        let tooltip = "Where the camera is. Drag with the left button to orbit, with another to pan; the wheel zooms.";
        vector(ui, &mut camera.eye, -1000.0..=1000.0, ("Eye", "m", 0.01), tooltip);
        vector(ui, &mut camera.target, -1000.0..=1000.0, ("Target", "m", 0.01), "The point that the camera looks at.");
        slider(ui, &mut camera.fov_y_deg, 5.0..=120.0, "View", "°", "Vertical angle of view.");
        log_slider(ui, &mut camera.near_m, 0.001..=1.0, "Near", "m", "Nothing nearer is drawn.");
        log_slider(ui, &mut camera.far_m, 2.0..=1000.0, "Far", "m", "Nothing farther is drawn.");
        ui.label("");
        if ui.button("Reset").on_hover_text("Puts the camera where it was (C).").clicked() {
            view.commands.push(Command::ResetCamera);
        }
        ui.end_row();
    });
    let look = &mut document.edited.look;
    section(ui, "Look", true, |ui| {
        let tooltip =
            "Brightness of the picture: one stop doubles it. In shell shading, flames themselves stay as bright.";
        slider(ui, &mut look.exposure_stops, -4.0..=14.0, "Exposure", "EV", tooltip);
        let tooltip = "The colour temperature that appears white: raising it makes fire look warmer.";
        slider(ui, &mut look.white_k, 1500.0..=10_000.0, "White point", "K", tooltip);
        let curves = [("filmic", ToneMap::Filmic), ("none", ToneMap::None)];
        let tooltip = "The curve from scene light to display light: filmic rolls off, none clips.";
        choice(ui, &mut look.tone_map, &curves, "Tone map", tooltip);
        let tooltip = "Gain of the light that flames throw on the scene; 1 is physical.";
        slider(ui, &mut look.light_gain, 0.0..=10.0, "Firelight", "x", tooltip);
        let tooltip = "Lights that together appear no larger than this count as one; 0 adds up every light by itself.";
        slider(ui, &mut look.light_merging, 0.0..=0.5, "Light merging", "rad", tooltip);
        let tooltip = "How many lights cast shadows: the strongest as seen.";
        slider(ui, &mut look.shadows, 0..=16, "Shadows", "", tooltip);
        let sizes = [("128", 128), ("256", 256), ("512", 512)];
        choice(ui, &mut look.shadow_size, &sizes, "Shadow size", "Texels across a face of a shadow's map.");
        slider(
            ui,
            &mut look.shadow_samples,
            4..=64,
            "Shadow taps",
            "",
            "More make the soft edges of shadows smoother.",
        );
        color(ui, &mut look.ambient, "Ambient", "Light that falls on the scene from everywhere.");
        color(ui, &mut look.background, "Background", "Colour behind everything.");
        let samples = [("1", 1), ("4", 4)];
        choice(ui, &mut look.samples, &samples, "Samples", "Samples per pixel on the edges of opaque things.");
    });
}
