//! Peeling, debug views and glow.

use super::app::View;
use super::widgets::{choice, pick, section, slider, switch, table};
use egui::Ui;
use lucerna::frame::{Blur, DebugView, GlowLevel, Look, Shading, Transparency};

/// Most blurred copies.
const MOST_LEVELS: usize = 4;

pub(super) fn show(ui: &mut Ui, look: &mut Look, view: &mut View) {
    section(ui, "Peeling", true, |ui| peeling(ui, look, view));
    section(ui, "Debug views", false, |ui| debug(ui, look, view));
    egui::CollapsingHeader::new(egui::RichText::new("Glow").strong()).show(ui, |ui| glow(ui, look));
}

fn peeling(ui: &mut Ui, look: &mut Look, view: &mut View) {
    let shadings = [("shell", Shading::Shell), ("volume", Shading::Volume)];
    let tooltip = "Shell: a texture on the surface. Volume: light emitted along the part of the ray inside each flame.";
    choice(ui, &mut look.shading, &shadings, "Shading", tooltip);
    if look.shading == Shading::Volume {
        look.transparency = Transparency::Peeled;
    }
    let all = [("peeled", Transparency::Peeled), ("unsorted", Transparency::Unsorted)];
    let transparencies = if look.shading == Shading::Volume { &all[..1] } else { &all[..] };
    let tooltip = "Peeled: the nearest layers in order. Unsorted: one additive pass, for shell shading only.";
    choice(ui, &mut look.transparency, transparencies, "Transparency", tooltip);
    let tooltip = "Depth layers that are peeled. More show more flames behind one another and cost a pass each.";
    slider(ui, &mut look.layers, 1..=32, "Layers", "", tooltip);
    let tooltip = "Steps of the integration inside each flame in volume shading.";
    slider(ui, &mut look.volume_steps, 2..=32, "Volume steps", "", tooltip);
    let tooltip = "The graphics device makes the surfaces from control points; otherwise the processor does.";
    switch(ui, &mut view.surfaces_on_device, "Device surfaces", tooltip);
}

fn debug(ui: &mut Ui, look: &mut Look, view: &mut View) {
    let selected = match look.debug {
        DebugView::Final => 0,
        DebugView::Layer(_) => 1,
        DebugView::LayerCount => 2,
        DebugView::Flames => 3,
        DebugView::Glow(_) => 4,
        DebugView::Opaque => 5,
    };
    let names =
        ["final", "one peeled layer", "number of layers", "flames unblurred", "one blurred image", "opaque only"];
    let views = [
        DebugView::Final,
        DebugView::Layer(0),
        DebugView::LayerCount,
        DebugView::Flames,
        DebugView::Glow(0),
        DebugView::Opaque,
    ];
    if let Some(index) = pick(ui, Some(selected), names.into_iter(), "Show", "Which target the picture shows.") {
        look.debug = views[index];
    }
    let last_level = look.glow.len().saturating_sub(1) as u32;
    match &mut look.debug {
        DebugView::Layer(layer) => {
            slider(ui, layer, 0..=look.layers.saturating_sub(1), "Layer", "", "Which layer; 0 is the nearest.");
        }
        DebugView::Glow(level) => slider(ui, level, 0..=last_level, "Level", "", "Which level of the glow."),
        _ => {}
    }
    let lines = &mut view.lines;
    switch(ui, &mut lines.skeletons, "Skeletons", "The chains of particles that carry the flames.");
    switch(ui, &mut lines.control_nets, "Control nets", "The nets that the surfaces are made from.");
    switch(ui, &mut lines.wireframe, "Wireframe", "The edges of the flames' triangles.");
    switch(ui, &mut lines.air_box, "Air box", "The box of the air.");
}

fn glow(ui: &mut Ui, look: &mut Look) {
    let mut removed = None;
    for (index, level) in look.glow.iter_mut().enumerate() {
        ui.horizontal(|ui| {
            ui.label(format!("Level {}", index + 1));
            if ui.small_button("remove").on_hover_text("Removes this blurred copy.").clicked() {
                removed = Some(index);
            }
        });
        table(ui, &format!("glow level {index}"), |ui| one_level(ui, level));
    }
    if let Some(index) = removed {
        look.glow.remove(index);
        if let DebugView::Glow(level) = &mut look.debug {
            *level = (*level).min(look.glow.len().saturating_sub(1) as u32);
        }
    }
    let room = look.glow.len() < MOST_LEVELS;
    let add = ui.add_enabled(room, egui::Button::new("Add a level"));
    if add.on_hover_text("Adds a blurred copy of the flames; at most four.").clicked() {
        look.glow.push(GlowLevel { divisor: 4, blur: Blur::Height(0.04), gain: 0.1 });
    }
    let sum: f32 = look.glow.iter().map(|level| level.gain).sum();
    let tooltip = "In volume shading, gains that add up to 1 keep the light's energy; in shell shading, they are divided by \
        their sum.";
    ui.label(format!("The gains add up to {sum:.2}")).on_hover_text(tooltip);
}

fn one_level(ui: &mut Ui, level: &mut GlowLevel) {
    let divisors = [("full", 1), ("1/4", 4), ("1/16", 16)];
    choice(ui, &mut level.divisor, &divisors, "Size", "Size of the blurred image: smaller costs less.");
    let selected = match level.blur {
        Blur::Height(_) => 0,
        Blur::Pixels(_) => 1,
        Blur::Published => 2,
    };
    let names = ["share of height", "pixels", "published"].into_iter();
    let tooltip = "In what the width of the blur is measured; published: the seven taps of paper 003's authors.";
    match pick(ui, Some(selected), names, "Blur", tooltip) {
        Some(0) => level.blur = Blur::Height(0.02),
        Some(1) => level.blur = Blur::Pixels(2.0),
        Some(_) => level.blur = Blur::Published,
        None => {}
    }
    let tooltip =
        "Standard deviation of the Gaussian, in shares of the picture's height or in pixels of the blurred image.";
    match &mut level.blur {
        Blur::Height(sigma) => super::widgets::log_slider(ui, sigma, 0.0005..=0.2, "Width", "h", tooltip),
        Blur::Pixels(sigma) => slider(ui, sigma, 0.2..=30.0, "Width", "px", tooltip),
        Blur::Published => {}
    }
    let tooltip = "Share of the light that goes into this level; in shell shading, relative to the other levels.";
    slider(ui, &mut level.gain, 0.0..=1.0, "Gain", "x", tooltip);
}
