//! Wick and fuel, skeletons and surface of one fire.

use super::fuel_curve;
use super::widgets::{choice, log_slider, pick, row, section, slider, switch, vector};
use egui::Ui;
use lucerna::flame::{Fuel, FuelDistribution, FuelForm, Skeletons, SurfaceGrid, Swing};
use lucerna::scene::{Fire, WickSource};

pub(super) fn show(ui: &mut Ui, fire: &mut Fire, of: &str) {
    section(ui, &format!("Wick and fuel{of}"), false, |ui| {
        fuel(ui, &mut fire.fuel);
        wicks(ui, &mut fire.wicks);
        switch(ui, &mut fire.wick.shown, "Show wicks", "Draws a charred tube along each wick, with a glowing tip.");
    });
    section(ui, &format!("Skeletons{of}"), false, |ui| skeletons(ui, &mut fire.skeletons));
    section(ui, &format!("Surface{of}"), false, |ui| surface(ui, &mut fire.surface));
}

fn wicks(ui: &mut Ui, wicks: &mut [WickSource]) {
    for (index, wick) in wicks.iter_mut().enumerate() {
        let name = |what: &str| format!("Wick {} {what}", index + 1);
        match wick {
            WickSource::Polyline { points, radius_m }
            | WickSource::Curve { points, radius_m, .. }
            | WickSource::Points { points, radius_m } => {
                let tooltip = "Radius of the wick; the fire starts anew.";
                log_slider(ui, radius_m, 0.0005..=0.2, &name("radius"), "m", tooltip);
                for point in points {
                    let tooltip = "A point of the wick's centreline; the fire starts anew.";
                    vector(ui, point, -10.0..=10.0, (&name("point"), "m", 0.001), tooltip);
                }
            }
            WickSource::Ring { center_m, ring_m, .. } => {
                let tooltip = "Middle of the ring; the fire starts anew.";
                vector(ui, center_m, -10.0..=10.0, (&name("middle"), "m", 0.001), tooltip);
                log_slider(ui, ring_m, 0.001..=10.0, &name("ring"), "m", "Radius of the ring; the fire starts anew.");
            }
            WickSource::Mesh { position_m, rotation_deg, scale, .. } => {
                let tooltip = "Where the origin of the wick's file goes; the fire starts anew.";
                vector(ui, position_m, -10.0..=10.0, (&name("position"), "m", 0.001), tooltip);
                let tooltip = "How the wick's file is turned, about x, then y, then z; the fire starts anew.";
                vector(ui, rotation_deg, -360.0..=360.0, (&name("turn"), "°", 1.0), tooltip);
                log_slider(
                    ui,
                    scale,
                    0.01..=100.0,
                    &name("scale"),
                    "x",
                    "Scale of the wick's file; the fire starts anew.",
                );
            }
        }
    }
}

fn fuel(ui: &mut Ui, fuel: &mut Fuel) {
    let tooltip = "Upward acceleration of the air at each root; it fades out at twice the width of the skeletons, or at one \
        cell. Raising it makes flames higher.";
    log_slider(ui, &mut fuel.strength_m_s2, 0.1..=500.0, "Strength", "m/s²", tooltip);
    let tooltip = "Heating of the air at each root: hot air rises and makes flames neck and roll.";
    log_slider(ui, &mut fuel.heat_k_s, 0.0..=100_000.0, "Heat", "K/s", tooltip);
    let mut distributions = vec![
        ("uniform", FuelDistribution::Uniform),
        ("linear", FuelDistribution::Linear),
        ("bilinear", FuelDistribution::Bilinear),
        ("exponential", FuelDistribution::Exponential),
        ("Gaussian", FuelDistribution::Gaussian),
        ("random", FuelDistribution::Random),
    ];
    distributions.push(("drawn", FuelDistribution::Table(fuel_curve::table_of(&fuel.distribution, fuel.form))));
    choice(ui, &mut fuel.distribution, &distributions, "Distribution", "How fuel is spread along the wick.");
    if let FuelDistribution::Table(samples) = &mut fuel.distribution {
        let tooltip = "Drag to draw: how fuel is spread from one end of the wick to the other.";
        row(ui, "Curve", tooltip, |ui| fuel_curve::show(ui, samples));
    }
    let forms = [("maximum 1", FuelForm::Normalised), ("published", FuelForm::Published)];
    let tooltip = "Whether the distribution has maximum 1, or the form that paper 003's authors run.";
    choice(ui, &mut fuel.form, &forms, "Form", tooltip);
    swing(ui, &mut fuel.swing);
}

fn swing(ui: &mut Ui, swing: &mut Swing) {
    let selected = match swing {
        Swing::Still => 0,
        Swing::Periodic { .. } => 1,
        Swing::Noise { .. } => 2,
        Swing::Random { .. } => 3,
    };
    let amplitude = match *swing {
        Swing::Still => 0.1,
        Swing::Periodic { amplitude, .. } | Swing::Noise { amplitude, .. } | Swing::Random { amplitude } => amplitude,
    };
    let frequency_hz = match *swing {
        Swing::Periodic { frequency_hz, .. } | Swing::Noise { frequency_hz, .. } => frequency_hz,
        Swing::Still | Swing::Random { .. } => 4.0,
    };
    let names = ["still", "periodic", "noise", "random"].into_iter();
    match pick(ui, Some(selected), names, "Flicker", "How the strength swings over time.") {
        Some(0) => *swing = Swing::Still,
        Some(1) => *swing = Swing::Periodic { amplitude, frequency_hz },
        Some(2) => *swing = Swing::Noise { amplitude, frequency_hz },
        Some(_) => *swing = Swing::Random { amplitude },
        None => {}
    }
    let (amplitude, frequency) = match swing {
        Swing::Still => (None, None),
        Swing::Periodic { amplitude, frequency_hz } | Swing::Noise { amplitude, frequency_hz } => {
            (Some(amplitude), Some(frequency_hz))
        }
        Swing::Random { amplitude } => (Some(amplitude), None),
    };
    if let Some(amplitude) = amplitude {
        slider(ui, amplitude, 0.0..=2.0, "Amplitude", "x", "Size of the swing as a fraction of the strength.");
    }
    if let Some(frequency) = frequency {
        slider(
            ui,
            frequency,
            0.1..=20.0,
            "Frequency",
            "Hz",
            "How often the strength swings, or the slowest part of the noise.",
        );
    }
}

fn skeletons(ui: &mut Ui, skeletons: &mut Skeletons) {
    let tooltip = "Slices of the wick: a flame has this plus two lead chains; the fire starts anew.";
    slider(ui, &mut skeletons.slices, 1..=16, "Slices", "", tooltip);
    let tooltip = "Control points along each peripheral chain.";
    slider(ui, &mut skeletons.particles, 3..=32, "Particles", "", tooltip);
    let tooltip = "How long the particles of the middle live: longer than the outer ones, they make the pointed tip.";
    log_slider(ui, &mut skeletons.lead_life_s, 0.01..=2.0, "Lead life", "s", tooltip);
    let tooltip = "How long the outer particles live.";
    log_slider(ui, &mut skeletons.peripheral_life_s, 0.01..=2.0, "Outer life", "s", tooltip);
    let tooltip = "Distance of the outer roots from the wick's centreline.";
    log_slider(ui, &mut skeletons.width_m, 0.0005..=0.5, "Width", "m", tooltip);
    let tooltip = "Speed at which young outer particles are pushed outwards by the expanding gas.";
    slider(ui, &mut skeletons.expansion_m_s, 0.0..=2.0, "Expansion", "m/s", tooltip);
    let tooltip = "How far the middle roots sway with the air: this times the velocity there.";
    vector(ui, &mut skeletons.lead_sway_s, 0.0..=1.0, ("Lead sway", "s", 0.001), tooltip);
    let tooltip = "How far the outer roots sway with the air: this times the velocity there.";
    vector(ui, &mut skeletons.peripheral_sway_s, 0.0..=1.0, ("Outer sway", "s", 0.001), tooltip);
    let tooltip = "Tips that break away, on average, from each flame.";
    slider(ui, &mut skeletons.shed_per_s, 0.0..=20.0, "Tips shed", "1/s", tooltip);
    log_slider(ui, &mut skeletons.free_life_s, 0.01..=2.0, "Free life", "s", "How long a tip that broke away burns.");
}

fn surface(ui: &mut Ui, surface: &mut SurfaceGrid) {
    let mut half = surface.around / 2;
    let tooltip = "Half the samples around the flame: more make it rounder.";
    slider(ui, &mut half, 2..=128, "Half around", "", tooltip);
    if half != surface.around / 2 {
        surface.around = half * 2;
    }
    slider(ui, &mut surface.up, 3..=256, "Up", "", "Samples from root to tip: more make the outline smoother.");
    let tooltip = "How far the first inner knot is raised, in knot intervals: softens the tip.";
    slider(ui, &mut surface.tip_softness, 0.0..=1.0, "Tip softness", "", tooltip);
}
