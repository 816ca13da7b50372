//! Choices of physics: density, turbulence, burning, radiation.

use serde::{Deserialize, Serialize};

use crate::advect::ScalarAdvection;
use crate::builder::FluidBuilder;
use crate::combustion::{Combustion, FUEL, OXYGEN, OXYGEN_IN_AIR, Radiation, SOOT};
use crate::density::Density;
use crate::error::{FluidError, check};
use crate::grid::Grid;
use crate::scalars::Scalars;

/// What is beyond the plain equations of moving air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Physics {
    pub(crate) density: Density,
    pub(crate) smagorinsky: f32,
    pub(crate) deardorff: f32,
    pub(crate) turbulent_prandtl: f32,
    pub(crate) hot_gas: bool,
    pub(crate) combustion: Option<Combustion>,
    pub(crate) radiation: Option<Radiation>,
}

impl Default for Physics {
    fn default() -> Self {
        Self {
            density: Density::Boussinesq,
            smagorinsky: 0.0,
            deardorff: 0.0,
            turbulent_prandtl: 0.7,
            hot_gas: false,
            combustion: None,
            radiation: None,
        }
    }
}

impl Physics {
    /// Whether eddies too small for the grid act.
    pub(crate) fn has_eddies(&self) -> bool {
        self.smagorinsky > 0.0 || self.deardorff > 0.0
    }

    /// Whether heat makes the air expand.
    pub(crate) fn expands(&self) -> bool {
        self.density == Density::LowMach || self.combustion.is_some_and(|combustion| combustion.expansion > 0.0)
    }

    pub(crate) fn check(&self, grid: &Grid, scalars: &Scalars, advection: ScalarAdvection) -> Result<(), FluidError> {
        check("smagorinsky", self.smagorinsky, 0.0, 1.0, "0 to 1")?;
        check("deardorff", self.deardorff, 0.0, 1.0, "0 to 1")?;
        check("turbulent_prandtl", self.turbulent_prandtl, 0.1, 10.0, "0.1 to 10")?;
        if self.density == Density::LowMach && grid.is_sealed() {
            return Err(FluidError::SealedLowMach);
        }
        if self.density == Density::LowMach && advection != ScalarAdvection::Flux {
            return Err(FluidError::UnevenLowMach);
        }
        if let Some(combustion) = &self.combustion {
            combustion.check()?;
            for name in [FUEL, OXYGEN, SOOT] {
                if !scalars.names.iter().any(|known| known == name) {
                    return Err(FluidError::CombustionScalar { name });
                }
            }
        }
        self.radiation.map_or(Ok(()), Radiation::check)
    }
}

impl FluidBuilder {
    /// How density answers to temperature. Default: [`Density::Boussinesq`].
    pub fn density(mut self, density: Density) -> Self {
        self.physics.density = density;
        self
    }

    /// Smagorinsky's constant `C_s`, 0 to 1; 0.1 (near walls, shear) to 0.2 (free turbulence) are
    /// usual. Eddies too small for the grid then act as a viscosity `(C_s w)² |S|`, w the width
    /// of a cell and |S| the rate of strain. Default: 0, which skips the work.
    pub fn smagorinsky(mut self, constant: f32) -> Self {
        self.physics.smagorinsky = constant;
        self
    }

    /// Deardorff's constant `C_v`, 0 to 1; 0.1 is usual. Eddies too small for the grid then act as a
    /// viscosity `C_v w sqrt(k)`, w the width of a cell and k half the square of what the velocity
    /// differs by from its mean over a cell and its neighbours (FDS Technical Reference Guide): none
    /// where it changes linearly. Takes the place of Smagorinsky's. Default: 0, which skips the work.
    pub fn deardorff(mut self, constant: f32) -> Self {
        self.physics.deardorff = constant;
        self
    }

    /// How much less small eddies spread heat than momentum, 0.1 to 10: their viscosity over
    /// their diffusivity, which is that of scalars, too. Default: 0.7.
    pub fn turbulent_prandtl(mut self, number: f32) -> Self {
        self.physics.turbulent_prandtl = number;
        self
    }

    /// Lets viscosity and thermal diffusivity, which are those at ambient temperature then, grow with
    /// temperature as those of air do: as its power of 1.7 (within 5 % up to 2000 K). Scalars spread as heat does. It decides
    /// whether small flames stay steady. Default: they do not grow.
    pub fn hot_gas(mut self, grows: bool) -> Self {
        self.physics.hot_gas = grows;
        self
    }

    /// Lets fuel burn. Adds the scalars `fuel`, `oxygen` (0.232 outside) and `soot`, mass
    /// fractions, where the fluid has none of that name yet. Let fuel in by a
    /// [`crate::Source`]. Default: nothing burns.
    pub fn combustion(mut self, combustion: Combustion) -> Self {
        self.physics.combustion = Some(combustion);
        for (name, outside) in [(FUEL, 0.0), (OXYGEN, OXYGEN_IN_AIR), (SOOT, 0.0)] {
            if !self.scalars.names.iter().any(|known| known == name) {
                self.scalars.add(name.into(), outside);
            }
        }
        self
    }

    /// Lets hot air radiate by the fourth power of its temperature. Default: it does not.
    pub fn radiation(mut self, radiation: Radiation) -> Self {
        self.physics.radiation = Some(radiation);
        self
    }
}
