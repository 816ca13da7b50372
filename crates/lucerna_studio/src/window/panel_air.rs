//! The air.

use super::widgets::{choice, log_slider, pick, section, slider, vector};
use egui::Ui;
use lucerna::scene::{Air, AirAdvection, AirSides, HeatAdvection, Pressure};

pub(super) fn show(ui: &mut Ui, air: &mut Air) {
    section(ui, "Air", false, |ui| {
        let tooltip = "Cells along x, y and z. More cells show finer motion and cost more; the fire starts anew.";
        vector(ui, &mut air.cells, 2..=256, ("Cells", "", 0.1), tooltip);
        vector(
            ui,
            &mut air.size_m,
            0.01..=100.0,
            ("Size", "m", 0.005),
            "Size of the box of air; the fire starts anew.",
        );
        vector(ui, &mut air.origin_m, -100.0..=100.0, ("Corner", "m", 0.005), "Lowest corner of the box of air.");
        let tooltip = "Wind through the open sides.";
        vector(ui, &mut air.wind_m_s, -20.0..=20.0, ("Wind", "m/s", 0.01), tooltip);
        let tooltip = "Length of a fixed step: a frame runs as many as it needs.";
        log_slider(ui, &mut air.time_step_s, 0.001..=0.05, "Step", "s", tooltip);
        let tooltip =
            "Kinematic viscosity: raising it makes the air flow calmly. Air has 0.000015, a flame ten times that.";
        log_slider(ui, &mut air.viscosity_m2_s, 0.0..=0.01, "Viscosity", "m²/s", tooltip);
        let tooltip = "Gives back the small eddies that the grid swallows; 0 for none.";
        slider(ui, &mut air.vorticity_confinement, 0.0..=2.0, "Eddies", "", tooltip);
        slider(ui, &mut air.ambient_k, 200.0..=400.0, "Ambient", "K", "Temperature of the air around the fire.");
        slider(ui, &mut air.cooling_per_s, 0.0..=20.0, "Cooling", "1/s", "Rate at which hot air cools.");
        let tooltip =
            "Upward acceleration of row j is this times the number of rows over j (paper 003's authors); 0 for none.";
        slider(ui, &mut air.row_buoyancy_m_s2, 0.0..=5.0, "Row buoyancy", "m/s²", tooltip);
        let sides = [("floor", AirSides::Floor), ("open", AirSides::Open), ("closed", AirSides::Closed)];
        choice(ui, &mut air.sides, &sides, "Sides", "Which sides of the box of air are closed.");
        let schemes = [
            ("semi-Lagrangian", AirAdvection::SemiLagrangian),
            ("MacCormack", AirAdvection::MacCormack),
            ("reflection", AirAdvection::Reflection),
            ("cubic", AirAdvection::Cubic),
            ("conservative", AirAdvection::Conservative),
        ];
        let tooltip =
            "How the air carries its own motion: semi-Lagrangian is the fastest, with reflection eddies live longest.";
        choice(ui, &mut air.advection, &schemes, "Advection", tooltip);
        let schemes = [
            ("semi-Lagrangian", HeatAdvection::SemiLagrangian),
            ("flux", HeatAdvection::Flux),
            ("MacCormack", HeatAdvection::MacCormack),
            ("cubic", HeatAdvection::Cubic),
        ];
        let tooltip = "How the air carries its heat: semi-Lagrangian is the fastest, with flux no heat is lost or made on the way.";
        choice(ui, &mut air.heat_advection, &schemes, "Heat", tooltip);
        pressure(ui, &mut air.pressure);
    });
}

fn pressure(ui: &mut Ui, pressure: &mut Pressure) {
    let selected = usize::from(matches!(pressure, Pressure::GaussSeidel(_)));
    let tooltip = "How the pressure is solved: exactly by transforms, or by sweeps that leave some divergence.";
    match pick(ui, Some(selected), ["direct", "Gauss-Seidel"].into_iter(), "Pressure", tooltip) {
        Some(0) => *pressure = Pressure::Direct,
        Some(_) if selected == 0 => *pressure = Pressure::GaussSeidel(20),
        _ => {}
    }
    if let Pressure::GaussSeidel(sweeps) = pressure {
        slider(ui, sweeps, 1..=200, "Sweeps", "", "More sweeps leave less divergence and cost more.");
    }
}
