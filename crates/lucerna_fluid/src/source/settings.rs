//! What a caller sets: the outside, the air's properties, whole fields.

use glam::Vec3;

use crate::builder::{
    check_ambient, check_cfl_limit, check_confinement, check_cooling, check_max_substeps, check_viscosity, check_wind,
};
use crate::error::{FluidError, check};
use crate::field::Field;
use crate::fluid::Fluid;
use crate::grid::Grid;
use crate::limits::{MAX_SPEED_M_S, MAX_TEMPERATURE_K};

impl Fluid {
    /// Velocity of the air outside, m/s; components within ±100. Inflow sides follow at once,
    /// the air behind open sides within the time in which the wind crosses the box.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn set_wind(&mut self, wind_m_s: Vec3) -> Result<(), FluidError> {
        self.settings.wind_m_s = check_wind(wind_m_s)?;
        Ok(())
    }

    /// Kinematic viscosity, m²/s, 0 to 1e3.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn set_viscosity_m2_s(&mut self, viscosity_m2_s: f32) -> Result<(), FluidError> {
        self.settings.viscosity_m2_s = check_viscosity(viscosity_m2_s)?;
        Ok(())
    }

    /// Strength of vorticity confinement, 1/s, 0 to 100.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn set_vorticity_confinement(&mut self, per_s: f32) -> Result<(), FluidError> {
        self.settings.vorticity_confinement = check_confinement(per_s)?;
        Ok(())
    }

    /// Share of the excess temperature lost per second, 1/s, 0 to 1e3.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn set_cooling_per_s(&mut self, cooling_per_s: f32) -> Result<(), FluidError> {
        self.settings.cooling_per_s = check_cooling(cooling_per_s)?;
        Ok(())
    }

    /// Temperature of the air around, K, 1 to 1e4. The excess temperatures stay.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn set_ambient_k(&mut self, ambient_k: f32) -> Result<(), FluidError> {
        self.settings.ambient_k = check_ambient(ambient_k)?;
        Ok(())
    }

    /// See [`crate::FluidBuilder::cfl_limit`].
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn set_cfl_limit(&mut self, cfl: Option<f32>) -> Result<(), FluidError> {
        self.settings.cfl_limit = check_cfl_limit(cfl)?;
        Ok(())
    }

    /// See [`crate::FluidBuilder::max_substeps`].
    ///
    /// # Errors
    /// A number that is out of range.
    pub fn set_max_substeps(&mut self, parts: u32) -> Result<(), FluidError> {
        self.settings.max_substeps = check_max_substeps(parts)?;
        Ok(())
    }

    /// Sets the velocity everywhere, from the value of `velocity_m_s` at each face's centre
    /// (components within ±300 m/s), and makes it obey the sides and free of divergence.
    ///
    /// # Errors
    /// A value that is not finite or out of range; nothing has changed then.
    pub fn fill_velocity(&mut self, velocity_m_s: impl Fn(Vec3) -> Vec3) -> Result<(), FluidError> {
        self.with_scratch(|fluid, scratch| {
            for (axis, field) in scratch.next_velocity.iter_mut().enumerate() {
                fill(&fluid.grid, field, |point| {
                    let value = velocity_m_s(point).to_array()[axis];
                    check("velocity_m_s", value, -MAX_SPEED_M_S, MAX_SPEED_M_S, "components within ±300 m/s")
                })?;
            }
            std::mem::swap(&mut fluid.state.velocity, &mut scratch.next_velocity);
            fluid.settle(scratch);
            Ok(())
        })
    }

    /// Sets the temperature above ambient everywhere, K (-0.9 times ambient to 1e4), from its
    /// value at the centre of each cell.
    ///
    /// # Errors
    /// A value that is not finite or out of range; nothing has changed then.
    pub fn fill_temperature(&mut self, kelvin: impl Fn(Vec3) -> f32) -> Result<(), FluidError> {
        let lowest_k = -0.9 * self.settings.ambient_k;
        self.with_scratch(|fluid, scratch| {
            fill(&fluid.grid, &mut scratch.next_temperature, |point| {
                check("kelvin", kelvin(point), lowest_k, MAX_TEMPERATURE_K, "-0.9 times ambient to 1e4 K")
            })?;
            std::mem::swap(&mut fluid.state.temperature, &mut scratch.next_temperature);
            Ok(())
        })
    }
}

/// Fills a field from a function of the point at which each value lies.
pub(crate) fn fill(
    grid: &Grid,
    field: &mut Field,
    value: impl Fn(Vec3) -> Result<f32, FluidError>,
) -> Result<(), FluidError> {
    let [nx, ny, _] = field.counts;
    let offset = Vec3::from_array(field.offset);
    for (at, out) in field.data.iter_mut().enumerate() {
        let index = Vec3::new((at % nx) as f32, (at / nx % ny) as f32, (at / (nx * ny)) as f32);
        *out = value(grid.origin + (index + offset) * Vec3::from_array(grid.cell_m))?;
    }
    Ok(())
}
