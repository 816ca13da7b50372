//! What burns, and how a fire drives the air: fuels in physical units.

use crate::FlameError;
use crate::error::in_range;
use lucerna_fluid::{Combustion, Fuel as Gas};
use serde::{Deserialize, Serialize};

/// Volume of a mole of gas at 293.15 K and one atmosphere, m^3/kmol.
const MOLE_M3: f32 = 24.055;

/// How a fire drives the air.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Drive {
    /// A push and some heat at each root (paper 003). How strong they are is set by hand.
    #[default]
    RootForces,
    /// Fuel is let into the air along the wick and burns as it mixes. Nothing pushes: height, puffing, necking and
    /// lean come out of the motion of hot, light gas. Needs air that burns the same fuel ([`combustion`]).
    Combustion {
        /// What burns.
        fuel: FuelKind,
        /// How much of it in all, for each flame.
        rate: Rate,
    },
}

/// How fast fuel is let in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rate {
    /// Heat that it releases as it burns, the radiated share included, kW, 1e-4 to 1e5.
    Kw(f32),
    /// Mass, g/s, so that it releases 1e-4 to 1e5 kW.
    GS(f32),
}

/// What burns.
///
/// Heats of combustion, oxygen, soot and radiated shares are those of `lucerna_fluid::Fuel`, which tells where they come
/// from, and for methanol and ethylene from the same tables: methanol's heat is the liquid's (its vapour, let in as such,
/// would give 21.1 kJ/g), it leaves no soot and radiates 0.21 (R. Buch et al., Combustion and Flame 108, 1997; 0.24 in
/// NIST Technical Note 2162r1, 2024).
///
/// Temperatures of ignition, in air that touches the fuel, are rounded handbook values: autoignition after NFPA 325
/// (other tables differ by up to 60 K: 490 °C for ethylene, 600 °C for methane), for wood the piloted ignition of its
/// surface, 300 to 365 °C by species (V. Babrauskas, *Ignition of Wood*, Interflam 2001).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FuelKind {
    /// CH4, 50.0 kJ/g.
    Methane,
    /// C3H8, 46.3 kJ/g.
    Propane,
    /// CH3OH, 19.9 kJ/g: a blue flame that is hard to see.
    Methanol,
    /// C2H4, 47.2 kJ/g: bright.
    Ethylene,
    /// C7H16, for liquid fuels of its kind, 44.6 kJ/g.
    Heptane,
    /// C25H52, a candle's wax and lamp oil, 43.4 kJ/g.
    Wax,
    /// What hot wood gives off, 17.1 kJ/g (red oak, all that burns; flames over wood release 12 to 15 kJ/g).
    Wood,
    /// One's own.
    Custom {
        /// Heat of combustion, kJ/g, 0.1 to 200.
        heat_kj_g: f32,
        /// Oxygen that a gram uses up, g, 0.01 to 20. About a thirteenth of the heat (W. M. Thornton, 1917).
        oxygen_g_g: f32,
        /// Soot that a gram leaves, g, 0 to 1.
        soot_g_g: f32,
        /// Share of the heat that is radiated, 0 to 1.
        radiated: f32,
        /// Density of the vapour as it is let in, kg/m^3, 0.05 to 100.
        vapour_kg_m3: f32,
        /// Temperature at which it catches fire, K, 300 to 3000.
        ignition_k: f32,
    },
}

impl FuelKind {
    /// What the air's burning needs to know.
    #[must_use]
    pub const fn gas(self) -> Gas {
        match self {
            Self::Methane => Gas::METHANE,
            Self::Propane => Gas::PROPANE,
            Self::Methanol => Gas { heat_kj_kg: 19_900.0, oxygen_kg_kg: 1.498, soot_kg_kg: 0.0, radiated: 0.21 },
            Self::Ethylene => Gas { heat_kj_kg: 47_200.0, oxygen_kg_kg: 3.422, soot_kg_kg: 0.043, radiated: 0.34 },
            Self::Heptane => Gas::HEPTANE,
            Self::Wax => Gas::WAX,
            Self::Wood => Gas::WOOD,
            Self::Custom { heat_kj_g, oxygen_g_g, soot_g_g, radiated, .. } => {
                Gas { heat_kj_kg: 1e3 * heat_kj_g, oxygen_kg_kg: oxygen_g_g, soot_kg_kg: soot_g_g, radiated }
            }
        }
    }

    /// Density of its vapour at room temperature, kg/m^3. That of wood is a mixture about as heavy as air.
    #[must_use]
    pub fn vapour_kg_m3(self) -> f32 {
        let molar = match self {
            Self::Custom { vapour_kg_m3, .. } => return vapour_kg_m3,
            Self::Methane => 16.04,
            Self::Propane => 44.10,
            Self::Methanol => 32.04,
            Self::Ethylene => 28.05,
            Self::Heptane => 100.2,
            Self::Wax => 352.7,
            Self::Wood => 29.0,
        };
        molar / MOLE_M3
    }

    /// Temperature of the air at which it catches fire, K.
    #[must_use]
    pub const fn ignition_k(self) -> f32 {
        match self {
            Self::Custom { ignition_k, .. } => ignition_k,
            Self::Methane => 810.0,
            Self::Propane => 723.0,
            Self::Methanol => 737.0,
            Self::Ethylene => 723.0,
            Self::Heptane => 477.0,
            Self::Wax => 518.0,
            Self::Wood => 620.0,
        }
    }

    fn check(self) -> Result<(), FlameError> {
        let gas = self.gas();
        let field = |name| match name {
            0 => "drive.fuel.heat_kj_g",
            1 => "drive.fuel.oxygen_g_g",
            2 => "drive.fuel.soot_g_g",
            3 => "drive.fuel.radiated",
            4 => "drive.fuel.vapour_kg_m3",
            _ => "drive.fuel.ignition_k",
        };
        in_range(field(0), 1e-3 * gas.heat_kj_kg, 0.1, 200.0, "0.1 to 200")?;
        in_range(field(1), gas.oxygen_kg_kg, 0.01, 20.0, "0.01 to 20")?;
        in_range(field(2), gas.soot_kg_kg, 0.0, 1.0, "0 to 1")?;
        in_range(field(3), gas.radiated, 0.0, 1.0, "0 to 1")?;
        in_range(field(4), self.vapour_kg_m3(), 0.05, 100.0, "0.05 to 100")?;
        in_range(field(5), self.ignition_k(), 300.0, 3000.0, "300 to 3000")
    }
}

impl Drive {
    /// Heat released where all burns, kW; none for root forces, which have no such measure.
    #[must_use]
    pub fn power_kw(&self) -> Option<f32> {
        match *self {
            Self::RootForces => None,
            Self::Combustion { rate: Rate::Kw(kilowatts), .. } => Some(kilowatts),
            Self::Combustion { fuel, rate: Rate::GS(grams) } => Some(1e-3 * grams * fuel.gas().heat_kj_kg),
        }
    }

    pub(crate) fn fuel(&self) -> Option<FuelKind> {
        match *self {
            Self::RootForces => None,
            Self::Combustion { fuel, .. } => Some(fuel),
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// At the first that is out of its range; the error names it.
    pub fn check(&self) -> Result<(), FlameError> {
        let Self::Combustion { fuel, rate } = *self else { return Ok(()) };
        fuel.check()?;
        let kilowatts = self.power_kw().unwrap_or(0.0);
        match rate {
            Rate::Kw(_) => in_range("drive.rate.kw", kilowatts, 1e-4, 1e5, "1e-4 to 1e5"),
            Rate::GS(grams) if (1e-4..=1e5).contains(&kilowatts) && grams.is_finite() => Ok(()),
            Rate::GS(grams) => Err(FlameError::OutOfRange {
                field: "drive.rate.g_s",
                value: f64::from(grams),
                allowed: "what releases 1e-4 to 1e5 kW",
            }),
        }
    }
}

/// The burning that the air of these flames has to do; none where all are driven by root forces.
///
/// # Errors
/// [`FlameError::Fuels`] where flames burn different fuels: one air burns one.
pub fn combustion<'a>(drives: impl IntoIterator<Item = &'a Drive>) -> Result<Option<Combustion>, FlameError> {
    let mut known: Option<FuelKind> = None;
    for (flame, fuel) in drives.into_iter().enumerate().filter_map(|(i, drive)| Some((i, drive.fuel()?))) {
        match known {
            Some(known) if known != fuel => return Err(FlameError::Fuels { flame }),
            _ => known = Some(fuel),
        }
    }
    Ok(known.map(|fuel| Combustion::new(fuel.gas())))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMED: [FuelKind; 7] = [
        FuelKind::Methane,
        FuelKind::Propane,
        FuelKind::Methanol,
        FuelKind::Ethylene,
        FuelKind::Heptane,
        FuelKind::Wax,
        FuelKind::Wood,
    ];

    #[test]
    fn a_gram_of_oxygen_releases_thirteen_kilojoules_whatever_burns() {
        // C. Huggett, Fire and Materials 4, 1980: 13.1 kJ/g within 5 % for organic fuels; ethylene 13.8.
        for fuel in NAMED {
            let gas = fuel.gas();
            let per_oxygen = 1e-3 * gas.heat_kj_kg / gas.oxygen_kg_kg;
            println!("{fuel:?}: {per_oxygen:.2} kJ for a gram of oxygen");
            assert!((per_oxygen / 13.1 - 1.0).abs() < 0.06, "{fuel:?}: {per_oxygen}");
            assert!(fuel.check().is_ok() && gas.radiated > 0.1 && gas.radiated < 0.5);
        }
    }

    #[test]
    fn grams_and_kilowatts_mean_the_same() {
        let of = |rate| Drive::Combustion { fuel: FuelKind::Propane, rate }.power_kw().expect("it burns");
        assert!((of(Rate::GS(1.0)) - of(Rate::Kw(46.3))).abs() < 1e-4);
    }

    #[test]
    fn impossible_fuel_is_refused() {
        let good = [0.5, 1.0, 0.0, 0.2, 1.2, 600.0];
        let drive = |v: [f32; 6], rate| Drive::Combustion {
            fuel: FuelKind::Custom {
                heat_kj_g: v[0],
                oxygen_g_g: v[1],
                soot_g_g: v[2],
                radiated: v[3],
                vapour_kg_m3: v[4],
                ignition_k: v[5],
            },
            rate,
        };
        assert!(drive(good, Rate::Kw(1.0)).check().is_ok());
        let fields = ["heat_kj_g", "oxygen_g_g", "soot_g_g", "radiated", "vapour_kg_m3", "ignition_k"];
        for (i, name) in fields.into_iter().enumerate() {
            for bad in [-1.0, f32::NAN, f32::INFINITY] {
                let mut values = good;
                values[i] = bad;
                let error = drive(values, Rate::Kw(1.0)).check().expect_err(name).to_string();
                assert!(error.starts_with(&format!("drive.fuel.{name} is")), "{error}");
            }
        }
        for bad in [0.0, -1.0, f32::NAN, 1e9] {
            for (rate, name) in [(Rate::Kw(bad), "drive.rate.kw"), (Rate::GS(bad), "drive.rate.g_s")] {
                let error = drive(good, rate).check().expect_err("a rate").to_string();
                assert!(error.starts_with(name), "{error}");
            }
        }
        let two = [FuelKind::Wax, FuelKind::Wood].map(|fuel| Drive::Combustion { fuel, rate: Rate::Kw(1.0) });
        assert_eq!(combustion(&two), Err(FlameError::Fuels { flame: 1 }));
        assert_eq!(combustion(&[Drive::RootForces]), Ok(None));
    }
}
