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

/// Mass fraction of oxygen in air: 0.2314 in dry air (20.946 % of the volume), rounded up as fire handbooks do.
pub const OXYGEN_IN_AIR: f32 = 0.232;

/// What burns.
///
/// Heats of combustion are net, water staying vapour. Those of methane, propane, methanol, ethylene and heptane follow
/// from standard enthalpies of formation (NASA TP-2002-211556), that of a liquid from the liquid's; oxygen is that of the
/// formula. Soot is what a well-ventilated fire leaves (A. Tewarson's tables, SFPE Handbook of Fire Protection
/// Engineering); over burners of 0.3 m less was measured: 0.005 for propane, 0.017 for heptane (NIST Technical Note
/// 2162r1, 2024).
///
/// Radiated shares are the defaults of the FDS User's Guide (NIST SP 1019, table of radiative fractions, after Tewarson
/// and C. Beyler; 0.29 or 0.30 for propane by version), 0.35 for what it does not list. They grow with the fire: over
/// gas burners of 0.1 to 1 m, 0.05 to 0.26 was measured for methane, 0.06 to 0.31 for propane (A. Hamins, NIST Technical
/// Note 1926, 2016).
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
    /// CH4, 50.03 kJ/g: nearly no soot.
    pub const METHANE: Self = Self { heat_kj_kg: 50_000.0, oxygen_kg_kg: 3.99, soot_kg_kg: 0.0, radiated: 0.20 };
    /// C3H8, 46.35 kJ/g.
    pub const PROPANE: Self = Self { heat_kj_kg: 46_300.0, oxygen_kg_kg: 3.63, soot_kg_kg: 0.024, radiated: 0.30 };
    /// C7H16, for liquid fuels of its kind; 44.6 kJ/g for the liquid.
    pub const HEPTANE: Self = Self { heat_kj_kg: 44_600.0, oxygen_kg_kg: 3.51, soot_kg_kg: 0.037, radiated: 0.40 };
    /// C25H52, a candle's wax: handbooks have 43.1 to 43.8 kJ/g. A candle burns its soot before it gets away, and radiates
    /// 0.17 of its heat (A. Hamins, M. Bundy, S. Dillon, *Characterization of Candle Flames*, J. Fire Protection
    /// Engineering 15, 2005).
    pub const WAX: Self = Self { heat_kj_kg: 43_400.0, oxygen_kg_kg: 3.45, soot_kg_kg: 0.0, radiated: 0.17 };
    /// What hot wood gives off: heat and soot of red oak by Tewarson, a rounded formula of woods, CH1.7 O0.74.
    pub const WOOD: Self = Self { heat_kj_kg: 17_100.0, oxygen_kg_kg: 1.32, soot_kg_kg: 0.015, radiated: 0.35 };
}

/// How fuel burns: give it to [`crate::FluidBuilder::combustion`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Combustion {
    /// What burns.
    pub fuel: Fuel,
    /// How fast eddies mix, 0.01 to 100 times the rates of the FDS Technical Reference Guide, whose constant for small
    /// eddies was set there to Heskestad's heights of flames. Raising it makes shorter, hotter flames. Default: 1.
    pub mixing: f32,
    /// Temperature above ambient below which nothing burns, K, -1e4 to 1e4. Default: -1e4, so
    /// that what mixes burns.
    pub ignition_k: f32,
    /// Temperature above ambient beyond which gas does not burn on until it has cooled or
    /// expanded, K, 100 to 1e4. It stands for the temperature of the flame, which a heat capacity
    /// of cold air would exceed (adiabatic flames in air at 293 K: 2220 K for methane and methanol, 2260 K for propane,
    /// 2370 K for ethylene), and keeps long steps from burning at constant volume. Default: 2000.
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
