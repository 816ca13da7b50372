//! Cooling by radiation of thin gas: what it sends out is not absorbed again.

use serde::{Deserialize, Serialize};

use crate::air::AIR_HEAT_CAPACITY_J_KG_K;
use crate::error::{FluidError, check};
use crate::grid::Grid;
use crate::limits::MAX_TEMPERATURE_K;
use crate::parallel::{Partial, reduce_planes};
use crate::source::{Air, share_from_kelvin};

/// Stefan and Boltzmann's constant, W/(m² K⁴).
const STEFAN_BOLTZMANN: f64 = 5.670_374e-8;

/// Cooling by the fourth power of the temperature: a volume loses `4 k s (T⁴ - T_a⁴)` W/m³, s
/// Stefan and Boltzmann's constant. This is for optically thin gas, which small fires are.
///
/// A burning fluid loses the fuel's radiated share besides: set [`super::Fuel::radiated`] to
/// zero to have one of them only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Radiation {
    /// Absorption constant k of the gas, 1/m, 0 to 1e3. Raising it cools faster.
    pub absorption_per_m: f32,
    /// What soot adds to k, 1/(m K), 0 to 1e5: this times the share of the volume that is soot
    /// (of 1800 kg/m³) times the temperature. About 1300: `3.72 C0 / C2` with `C2` = 0.01439 m K and
    /// `C0` = 5, which is 2 to 6 by the soot's refractive index (C. Tien, K. Lee, A. Stretton,
    /// *Radiation Heat Transfer*, SFPE Handbook). Needs the scalar `soot`.
    pub soot_per_m_k: f32,
}

impl Radiation {
    pub(crate) fn check(self) -> Result<(), FluidError> {
        check("absorption_per_m", self.absorption_per_m, 0.0, 1.0e3, "0 to 1e3 1/m")?;
        check("soot_per_m_k", self.soot_per_m_k, 0.0, 1.0e5, "0 to 1e5 1/(m K)")?;
        Ok(())
    }
}

/// What a step's radiation needs to know.
#[derive(Clone, Copy)]
pub(crate) struct Emission<'a> {
    pub(crate) radiation: Radiation,
    pub(crate) air: Air,
    /// Pack that holds soot, and where in it.
    pub(crate) soot: Option<(&'a [[f32; 4]], usize)>,
}

/// Cools for `dt_s`; returns the heat sent out, kJ.
///
/// Where heat thins the air, `dT/dt = -a T (T⁴ - 1)` in ambient temperatures is a logistic
/// equation for T⁴ and solved exactly. Where it does not, `dT/dt = -a (T⁴ - 1)` is solved with the
/// factor `(T + 1)(T² + 1)` of the middle of the way: no step overshoots.
pub(crate) fn radiate(
    grid: &Grid,
    emission: Emission<'_>,
    kelvin: &mut [f32],
    partials: &mut [Partial],
    dt_s: f32,
) -> f64 {
    const SOOT_KG_M3: f32 = 1800.0;
    let Emission { radiation, air, soot } = emission;
    let plane = grid.plane();
    let ambient_k = air.ambient_k;
    let density = air.ambient_density_kg_m3();
    let capacity = f64::from(density * AIR_HEAT_CAPACITY_J_KG_K);
    // 4 s T_a³ dt / (rho_a c_p): times the absorption constant it is `a dt`.
    let by = (4.0 * STEFAN_BOLTZMANN * f64::from(ambient_k).powi(3) * f64::from(dt_s) / capacity) as f32;
    let total = reduce_planes(grid.exec, kelvin, plane, partials, |k, out| {
        let mut sum = 0.0;
        for (at, kelvin) in out.iter_mut().enumerate() {
            // Below a thousandth of a kelvin nothing is worth the logarithms.
            if kelvin.abs() < 1.0e-3 {
                continue;
            }
            let hot = 1.0 + *kelvin / ambient_k;
            let mut absorption = radiation.absorption_per_m;
            if let Some((pack, slot)) = soot {
                let thin = if air.is_thinned_by_heat { 1.0 } else { hot };
                let volume = pack[k * plane + at][slot].max(0.0) * density / (thin * SOOT_KG_M3);
                absorption += radiation.soot_per_m_k * volume * hot * ambient_k;
            }
            let rate = by * absorption;
            let before = *kelvin;
            if air.is_thinned_by_heat {
                // w = 1 - T⁻⁴ decays as exp(-4 a t).
                let inverse = 1.0 / (hot * hot);
                let left = (1.0 - inverse * inverse) * (-4.0 * rate).exp();
                *kelvin = (ambient_k * (1.0 / (1.0 - left).sqrt().sqrt() - 1.0)).min(MAX_TEMPERATURE_K);
                sum += f64::from(share_from_kelvin(before, ambient_k) - share_from_kelvin(*kelvin, ambient_k));
            } else {
                let factor = |hot: f32| (hot + 1.0) * (hot * hot + 1.0);
                let after = (hot - 1.0) * (-rate * factor(hot)).exp();
                let middle = 1.0 + 0.5 * ((hot - 1.0) + after);
                *kelvin = before * (-rate * factor(middle)).exp();
                sum += f64::from((before - *kelvin) / ambient_k);
            }
        }
        Partial { sum, ..Partial::default() }
    });
    total.sum * f64::from(ambient_k) * air.kilojoules_per_k()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sides::Side;
    use glam::Vec3;

    /// Cooling of one cell by the classic Runge-Kutta method in `f64`, in small steps.
    fn expected(kelvin: f64, air: Air, absorption: f64, seconds: f64) -> f64 {
        let ambient = f64::from(air.ambient_k);
        let capacity = f64::from(air.ambient_density_kg_m3() * AIR_HEAT_CAPACITY_J_KG_K);
        let slope = |kelvin: f64| {
            let hot = 1.0 + kelvin / ambient;
            let thin = if air.is_thinned_by_heat { hot } else { 1.0 };
            -4.0 * absorption * STEFAN_BOLTZMANN * ambient.powi(4) * (hot.powi(4) - 1.0) * thin / capacity
        };
        let (mut kelvin, steps) = (kelvin, 200_000);
        let dt = seconds / f64::from(steps);
        for _ in 0..steps {
            let a = slope(kelvin);
            let b = slope(kelvin + 0.5 * dt * a);
            let c = slope(kelvin + 0.5 * dt * b);
            let d = slope(kelvin + dt * c);
            kelvin += dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        }
        kelvin
    }

    #[test]
    fn radiation_cools_by_the_fourth_power() {
        let grid = Grid::new([2, 2, 2], Vec3::ZERO, Vec3::ONE, [[Side::FreeSlip; 2]; 3]);
        for (is_thinned_by_heat, most) in [(false, 0.02), (true, 1.0e-4)] {
            let air = Air { ambient_k: 293.15, lowest_k: -260.0, is_thinned_by_heat, cell_volume_m3: 0.125 };
            let radiation = Radiation { absorption_per_m: 1.5, soot_per_m_k: 0.0 };
            for start in [1500.0_f32, 300.0, -100.0] {
                let mut kelvin = vec![start; 8];
                for _ in 0..50 {
                    let emission = Emission { radiation, air, soot: None };
                    radiate(&grid, emission, &mut kelvin, &mut [Partial::default(); 3], 0.01);
                }
                let exact = expected(f64::from(start), air, 1.5, 0.5);
                println!("from {start} K above ambient: {} K, by theory {exact:.2} K", kelvin[0]);
                assert!((f64::from(kelvin[0]) / exact - 1.0).abs() < most, "{start}: {} {exact}", kelvin[0]);
                // The longest step ends at ambient temperature, on the same side of it.
                let emission = Emission { radiation, air, soot: None };
                radiate(&grid, emission, &mut kelvin, &mut [Partial::default(); 3], 1.0e3);
                assert!(kelvin[0].abs() < 0.01 && kelvin[0] * start >= 0.0, "{}", kelvin[0]);
            }
        }
    }
}
