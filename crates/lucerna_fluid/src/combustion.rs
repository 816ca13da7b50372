//! Burning: fuel and oxygen that mix, heat, soot, radiation.
//!
//! One step of reaction, as fast as fuel and oxygen mix (B. F. Magnussen, B. H. Hjertager, *On
//! Mathematical Modeling of Turbulent Combustion*, Symp. (Int.) on Combustion 16, 1977), with the
//! mixing time of the FDS Technical Reference Guide (NIST SP 1018-1, chapter on combustion).

mod radiation;
mod react;

use serde::{Deserialize, Serialize};

use crate::error::{FluidError, check};
pub use radiation::Radiation;
pub(crate) use radiation::{Emission, radiate};
pub(crate) use react::{Reaction, Reactor};

/// Name of the scalar that holds fuel, kg a kg.
pub(crate) const FUEL: &str = "fuel";
/// Name of the scalar that holds oxygen, kg a kg.
pub(crate) const OXYGEN: &str = "oxygen";
/// Name of the scalar that holds soot, kg a kg.
pub(crate) const SOOT: &str = "soot";

/// Mass fraction of oxygen in air.
pub const OXYGEN_IN_AIR: f32 = 0.232;

/// What burns. Heats of combustion, formulas and soot yields are from the SFPE Handbook of Fire
/// Protection Engineering (tables of A. Tewarson and of V. Babrauskas); radiated shares are
/// those that the FDS User's Guide takes by default.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fuel {
    /// Heat of combustion, kJ/kg, 1 to 2e5. Raising it makes the same gas a bigger fire.
    pub heat_kj_kg: f32,
    /// Oxygen used up by a kilogram of fuel, kg, 0.01 to 20.
    pub oxygen_kg_kg: f32,
    /// Soot made of a kilogram of fuel, kg, 0 to 1.
    pub soot_kg_kg: f32,
    /// Share of the heat that is radiated and does not warm the gas, 0 to 1.
    pub radiated: f32,
}

impl Fuel {
    /// CH4: nearly no soot.
    pub const METHANE: Self = Self { heat_kj_kg: 50_000.0, oxygen_kg_kg: 3.99, soot_kg_kg: 0.0, radiated: 0.20 };
    /// C3H8.
    pub const PROPANE: Self = Self { heat_kj_kg: 46_300.0, oxygen_kg_kg: 3.63, soot_kg_kg: 0.024, radiated: 0.30 };
    /// C7H16, for liquid fuels of its kind.
    pub const HEPTANE: Self = Self { heat_kj_kg: 44_600.0, oxygen_kg_kg: 3.51, soot_kg_kg: 0.037, radiated: 0.40 };
    /// C25H52, a candle's wax. A candle burns its soot before it gets away.
    pub const WAX: Self = Self { heat_kj_kg: 43_400.0, oxygen_kg_kg: 3.45, soot_kg_kg: 0.0, radiated: 0.20 };
    /// What hot wood gives off, CH1.7 O0.74: red oak.
    pub const WOOD: Self = Self { heat_kj_kg: 17_100.0, oxygen_kg_kg: 1.32, soot_kg_kg: 0.015, radiated: 0.35 };
}

/// How fuel burns: give it to [`crate::FluidBuilder::combustion`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Combustion {
    /// What burns.
    pub fuel: Fuel,
    /// How fast eddies mix, 0.01 to 100 times the rates of the FDS Technical Reference Guide.
    /// Raising it makes shorter, hotter flames. Default: 1.
    pub mixing: f32,
    /// Temperature above ambient below which nothing burns, K, -1e4 to 1e4. Default: -1e4, so
    /// that what mixes burns.
    pub ignition_k: f32,
    /// Temperature above ambient beyond which gas does not burn on until it has cooled or
    /// expanded, K, 100 to 1e4. It stands for the temperature of the flame, which a heat capacity
    /// of cold air would exceed, and keeps long steps from burning at constant volume. Default:
    /// 2000.
    pub flame_k: f32,
    /// Share of the gas's expansion by the heat of burning that acts on the flow, 0 to 1. With
    /// [`crate::Density::LowMach`] it is always 1. Default: 1.
    pub expansion: f32,
}

impl Combustion {
    /// The defaults for a fuel.
    #[must_use]
    pub const fn new(fuel: Fuel) -> Self {
        Self { fuel, mixing: 1.0, ignition_k: -1.0e4, flame_k: 2000.0, expansion: 1.0 }
    }

    pub(crate) fn check(&self) -> Result<(), FluidError> {
        let Fuel { heat_kj_kg, oxygen_kg_kg, soot_kg_kg, radiated } = self.fuel;
        check("heat_kj_kg", heat_kj_kg, 1.0, 2.0e5, "1 to 2e5 kJ/kg")?;
        check("oxygen_kg_kg", oxygen_kg_kg, 0.01, 20.0, "0.01 to 20")?;
        check("soot_kg_kg", soot_kg_kg, 0.0, 1.0, "0 to 1")?;
        check("radiated", radiated, 0.0, 1.0, "0 to 1")?;
        check("mixing", self.mixing, 0.01, 100.0, "0.01 to 100")?;
        check("ignition_k", self.ignition_k, -1.0e4, 1.0e4, "within ±1e4 K")?;
        check("flame_k", self.flame_k, 100.0, 1.0e4, "100 to 1e4 K")?;
        check("expansion", self.expansion, 0.0, 1.0, "0 to 1")?;
        Ok(())
    }
}

/// What burnt and radiated in a step; part of [`crate::StepReport`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CombustionReport {
    /// Heat released, radiated share included, kW.
    pub heat_release_kw: f32,
    /// Heat radiated, kW: the fuel's share, and what [`Radiation`] takes.
    pub radiated_kw: f32,
    /// Fuel burnt, kg/s.
    pub burnt_kg_s: f32,
    /// Fuel in the box after the step, kg.
    pub fuel_kg: f32,
}
