//! How the gas of one fire glows.

use super::widgets::{color, log_slider, section, slider};
use egui::Ui;
use lucerna::frame::FlameShade;

pub(super) fn show(ui: &mut Ui, shade: &mut FlameShade, of: &str) {
    section(ui, &format!("Shading{of}"), false, |ui| {
        color(ui, &mut shade.tint, "Tint", "Multiplies the colour of the whole flame.");
        let tooltip = "Strength of the flame as a whole.";
        slider(ui, &mut shade.strength, 0.0..=1.0, "Strength", "x", tooltip);
        let tooltip = "Extinction of the soot at full density. Raising it makes the flame brighter and at last opaque.";
        log_slider(ui, &mut shade.soot_per_m, 0.1..=200.0, "Soot", "1/m", tooltip);
        let tooltip = "Temperature of the soot: hotter is brighter and whiter. Real flames have 1400 to 1900 K.";
        slider(ui, &mut shade.temperature_k, 1000.0..=3200.0, "Temperature", "K", tooltip);
        let tooltip = "Height at which soot begins, as a share of the flame.";
        slider(ui, &mut shade.soot_begin, 0.0..=1.0, "Soot begins", "h", tooltip);
        let tooltip = "Height at which soot has its full density, as a share of the flame.";
        slider(ui, &mut shade.soot_full, 0.0..=1.0, "Soot is full", "h", tooltip);
        let tooltip = "Length of the tip over which soot burns out, as a share of the flame.";
        slider(ui, &mut shade.tip_fade, 0.0..=1.0, "Tip fades", "h", tooltip);
        let tooltip = "Emission of the blue zone at the base; 0 for none.";
        slider(ui, &mut shade.blue_per_m, 0.0..=10.0, "Blue", "1/m", tooltip);
        let tooltip = "Height at which the blue zone ends, as a share of the flame.";
        slider(ui, &mut shade.blue_end, 0.0..=1.0, "Blue ends", "h", tooltip);
        let tooltip = "Radius of the dark cone of unburnt vapour over the wick, as a share of the flame's; 0 for none.";
        slider(ui, &mut shade.dark_radius, 0.0..=1.0, "Dark cone", "r", tooltip);
        let tooltip = "Height at which the dark cone closes, as a share of the flame.";
        slider(ui, &mut shade.dark_end, 0.0..=1.0, "Dark ends", "h", tooltip);
        let tooltip = "How much noise eats into the gas: 0 smooth, 1 ragged.";
        slider(ui, &mut shade.noise_amount, 0.0..=1.0, "Noise", "x", tooltip);
        let tooltip = "Spatial frequency of the noise: raising it makes finer holes.";
        log_slider(ui, &mut shade.noise_per_m, 0.1..=200.0, "Noise grain", "1/m", tooltip);
        let tooltip = "Speed at which the noise rises.";
        slider(ui, &mut shade.noise_rise_m_s, 0.0..=5.0, "Noise rises", "m/s", tooltip);
    });
}
