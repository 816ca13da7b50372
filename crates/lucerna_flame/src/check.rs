//! Which settings a flame can be made from.

use crate::error::in_range;
use crate::{FlameError, FlameSettings, Skeletons, SurfaceGrid};
use lucerna_frame::FlameShade;

impl FlameSettings {
    /// Checks every number.
    ///
    /// # Errors
    /// At the first that is out of its range; the error names it.
    pub fn check(&self) -> Result<(), FlameError> {
        self.drive.check()?;
        self.life.check(&self.drive)?;
        self.fuel.check()?;
        self.skeletons.check()?;
        self.surface.check()?;
        check_shade(&self.shade)
    }
}

impl Skeletons {
    fn check(&self) -> Result<(), FlameError> {
        in_range("skeletons.slices", self.slices as f32, 1.0, 64.0, "1 to 64")?;
        in_range("skeletons.particles", self.particles as f32, 3.0, 32.0, "3 to 32")?;
        in_range("skeletons.peripheral_life_s", self.peripheral_life_s, 1e-3, 60.0, "0.001 to 60")?;
        let (life, least) = (self.lead_life_s, self.peripheral_life_s);
        in_range("skeletons.lead_life_s", life, least, 60.0, "peripheral_life_s to 60")?;
        in_range("skeletons.width_m", self.width_m, 1e-5, 100.0, "1e-5 to 100")?;
        in_range("skeletons.expansion_m_s", self.expansion_m_s, 0.0, 100.0, "0 to 100")?;
        for (field, sway) in
            [("skeletons.lead_sway_s", self.lead_sway_s), ("skeletons.peripheral_sway_s", self.peripheral_sway_s)]
        {
            sway.iter().try_for_each(|&s| in_range(field, s, -10.0, 10.0, "-10 to 10"))?;
        }
        in_range("skeletons.shed_per_s", self.shed_per_s, 0.0, 100.0, "0 to 100")?;
        in_range("skeletons.free_life_s", self.free_life_s, 1e-3, 60.0, "0.001 to 60")?;
        in_range("skeletons.taper", self.taper, 0.0, 1.0, "0 to 1")?;
        in_range("skeletons.turbulence_m_s", self.turbulence_m_s, 0.0, 100.0, "0 to 100")?;
        in_range("skeletons.turbulence_m", self.turbulence_m, 1e-4, 100.0, "1e-4 to 100")
    }
}

impl SurfaceGrid {
    fn check(&self) -> Result<(), FlameError> {
        let around = self.around;
        if around % 2 == 1 || !(4..=256).contains(&around) {
            let allowed = "an even number from 4 to 256";
            return Err(FlameError::OutOfRange { field: "surface.around", value: f64::from(around), allowed });
        }
        in_range("surface.up", self.up as f32, 3.0, 256.0, "3 to 256")?;
        in_range("surface.tip_softness", self.tip_softness, 0.0, 1.0, "0 to 1")
    }
}

fn check_shade(shade: &FlameShade) -> Result<(), FlameError> {
    shade.tint.iter().try_for_each(|&t| in_range("shade.tint", t, 0.0, 1e4, "0 to 10000"))?;
    in_range("shade.temperature_k", shade.temperature_k, 500.0, 20_000.0, "500 to 20000")?;
    if shade.soot_full < shade.soot_begin {
        let (value, allowed) = (f64::from(shade.soot_full), "at least soot_begin");
        return Err(FlameError::OutOfRange { field: "shade.soot_full", value, allowed });
    }
    in_range("shade.strength", shade.strength, 0.0, 1.0, "0 to 1")?;
    for (field, value) in [
        ("shade.soot_per_m", shade.soot_per_m),
        ("shade.soot_begin", shade.soot_begin),
        ("shade.soot_full", shade.soot_full),
        ("shade.tip_fade", shade.tip_fade),
        ("shade.blue_per_m", shade.blue_per_m),
        ("shade.blue_end", shade.blue_end),
        ("shade.dark_radius", shade.dark_radius),
        ("shade.dark_end", shade.dark_end),
        ("shade.noise_amount", shade.noise_amount),
        ("shade.noise_per_m", shade.noise_per_m),
        ("shade.noise_rise_m_s", shade.noise_rise_m_s),
    ] {
        in_range(field, value, 0.0, 1e6, "0 to 1e6")?;
    }
    Ok(())
}
