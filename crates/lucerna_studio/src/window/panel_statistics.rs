//! What a frame costs and contains.

use super::app::View;
use super::meters::Meters;
use super::widgets::{fact, section, switch};
use crate::report::triangles;
use egui::Ui;
use lucerna::World;

pub(super) fn show(ui: &mut Ui, meters: &Meters, world: &World, view: &mut View, adapter: &str) {
    section(ui, "Statistics", true, |ui| {
        let frame_ms = meters.frame.ms();
        let fps = if frame_ms > 0.0 { 1e3 / frame_ms } else { 0.0 };
        fact(ui, "Frame", &format!("{frame_ms:7.2} ms {fps:5.0} fps"), "From one frame to the next.");
        let [surfaces, shadows, opaque, peel, glow, compose] = meters.gpu;
        for (name, meter, tooltip) in [
            ("Air", meters.fluid, "Fluid steps, on the processor."),
            ("Skeletons", meters.skeletons, "Chains of particles, on the processor."),
            ("Nets", meters.nurbs, "Control nets, and NURBS surfaces unless the graphics device makes them."),
            ("Upload", meters.upload, "Vertices or control points, lights and settings to the graphics device."),
            ("Surfaces", surfaces, "NURBS surfaces made on the graphics device."),
            ("Shadows", shadows, "The maps of the lights that cast shadows."),
            ("Opaque", opaque, "The lit scene, on the graphics device."),
            ("Flames", peel, "Peeling and shading, on the graphics device."),
            ("Glow", glow, "Blurred copies, on the graphics device."),
            ("Compose", compose, "Everything into the picture, on the graphics device."),
        ] {
            fact(ui, name, &format!("{:7.2} ms", meter.ms()), tooltip);
        }
        let frame = world.frame();
        fact(ui, "Time", &format!("{:7.2} s", world.time_s()), "Simulated time.");
        fact(ui, "Flames", &format!("{:7}", frame.flame_draws.len()), "Closed flame surfaces, free ones included.");
        fact(ui, "Triangles", &format!("{:7}", triangles(&frame)), "Triangles of all flames.");
        fact(ui, "Lights", &format!("{:7}", frame.lights.len()), "Point lights that stand for the flames.");
        let tooltip = "Fixed steps since the window was opened, and steps that a slow machine dropped.";
        fact(ui, "Steps", &format!("{:7} ({} dropped)", meters.steps, meters.dropped), tooltip);
        let tooltip = "Largest dimensionless divergence that the last step left.";
        fact(ui, "Divergence", &format!("{:7.1e}", meters.divergence), tooltip);
        let tooltip = "Counts the flame surfaces behind every pixel, now and then.";
        switch(ui, &mut view.layers_counted, "Count layers", tooltip);
        if let Some(counted) = meters.layers {
            let tooltip = "Most flame surfaces behind any pixel: so many layers would show everything.";
            fact(ui, "Layers", &format!("{:7}", counted.layers), tooltip);
            let tooltip = "Pixels times flames that were entered but not left at the last peeled layer. Surfaces beyond it are not \
                counted: compare Layers with the layers that are peeled.";
            fact(ui, "Open", &format!("{:7}", counted.open_intervals), tooltip);
        }
    });
    ui.small(adapter).on_hover_text("The graphics device that draws.");
}
