//! Fuel and oxygen react where they are mixed.

use super::Combustion;
use crate::air::AIR_HEAT_CAPACITY_J_KG_K;
use crate::grid::Grid;
use crate::limits::{GRAVITY_M_S2, MAX_EXPANSION_PER_S};
use crate::parallel::{Partial, for_planes, reduce_planes};
use crate::scalars::{PACK, Pack};
use crate::source::{Air, kelvin_from_share, share_from_kelvin};
use crate::turbulence::width_m;

/// Places of the three scalars: pack, and where in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reaction {
    pub(crate) fuel: (usize, usize),
    pub(crate) oxygen: (usize, usize),
    pub(crate) soot: (usize, usize),
}

/// Deardorff's: viscosity over width and speed of small eddies.
const DEARDORFF: f32 = 0.1;
/// Shortest time in which mixed gas burns, s; a round number far below the times of mixing (FDS takes 1e-5 or less).
const CHEMICAL_S: f32 = 1.0e-4;
/// Diffusivity of gas in ambient air, m²/s: about methane's (GRI-Mech 3.0: 2.15e-5; methanol 1.5e-5, propane 1.1e-5).
const GAS_M2_S: f32 = 2.0e-5;

/// Arrays for a reaction; empty until first used.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reactor {
    /// Fuel burnt in this step, kg a kg of gas (of ambient gas where density varies), by cell.
    burnt: Vec<f32>,
}

impl Reactor {
    /// Burns for `dt_s`. `eddies` is the viscosity of small eddies, m²/s. Where heat thins the air, `packs`
    /// hold densities over the density of ambient air, otherwise mass fractions. Returns the fuel
    /// burnt, kg.
    #[expect(clippy::too_many_arguments, reason = "what burns, where, in what, how fast")]
    pub(crate) fn burn(
        &mut self,
        grid: &Grid,
        combustion: &Combustion,
        reaction: Reaction,
        air: Air,
        eddies: &[f32],
        packs: &mut [Pack],
        kelvin: &mut [f32],
        expansion: Option<&mut [f32]>,
        partials: &mut [Partial],
        dt_s: f32,
    ) -> f64 {
        let plane = grid.plane();
        self.burnt.resize(grid.count(), 0.0);
        let warms = warms(combustion, air);
        {
            let packs: &[Pack] = packs;
            let kelvin: &[f32] = kelvin;
            let mixing = Mixing::new(grid, combustion.mixing);
            let (fuel, oxygen) = (&packs[reaction.fuel.0], &packs[reaction.oxygen.0]);
            let per_oxygen = 1.0 / combustion.fuel.oxygen_kg_kg;
            for_planes(grid.exec, &mut self.burnt, plane, |k, out| {
                let first = k * plane;
                for (at, out) in out.iter_mut().enumerate() {
                    let cell = first + at;
                    let (fuel, oxygen) = (fuel[cell][reaction.fuel.1], oxygen[cell][reaction.oxygen.1] * per_oxygen);
                    let there = if fuel < oxygen { fuel } else { oxygen };
                    let warm = kelvin[cell];
                    *out = if there > 0.0 && warm >= combustion.ignition_k {
                        let rate = mixing.rate(eddies[cell], warm, air.ambient_k);
                        let burns = there * -(-rate * dt_s).exp_m1();
                        burns.min(room(warm, combustion.flame_k, air) / warms).max(0.0)
                    } else {
                        0.0
                    };
                }
            });
        }
        let burnt = &self.burnt;
        let parts = [
            (reaction.fuel, -1.0),
            (reaction.oxygen, -combustion.fuel.oxygen_kg_kg),
            (reaction.soot, combustion.fuel.soot_kg_kg),
        ];
        for (index, pack) in packs.iter_mut().enumerate() {
            // What a kilogram of burnt fuel does, and the least that may be left: rounding, here
            // and in transport, must not leave less than nothing of what burning knows.
            let (mut by, mut least) = ([0.0_f32; PACK], [f32::MIN; PACK]);
            for ((pack, at), part) in parts {
                if pack == index {
                    by[at] += part;
                    least[at] = 0.0;
                }
            }
            if least == [f32::MIN; PACK] {
                continue;
            }
            for_planes(
                grid.exec,
                pack,
                plane,
                #[inline(always)]
                |k, out| {
                    for (values, burnt) in out.iter_mut().zip(&burnt[k * plane..]) {
                        for at in 0..PACK {
                            values[at] = (values[at] + by[at] * burnt).max(least[at]);
                        }
                    }
                },
            );
        }
        if let Some(expansion) = expansion {
            let per_s = combustion.expansion * warms / (air.ambient_k * dt_s);
            for_planes(
                grid.exec,
                expansion,
                plane,
                #[inline(always)]
                |k, out| {
                    for (value, burnt) in out.iter_mut().zip(&burnt[k * plane..]) {
                        *value = (*value + per_s * burnt).clamp(-MAX_EXPANSION_PER_S, MAX_EXPANSION_PER_S);
                    }
                },
            );
        }
        let total = reduce_planes(
            grid.exec,
            kelvin,
            plane,
            partials,
            #[inline(always)]
            |k, out| {
                let mut sum = 0.0;
                for (kelvin, burnt) in out.iter_mut().zip(&burnt[k * plane..]) {
                    if *burnt > 0.0 {
                        sum += f64::from(*burnt);
                        *kelvin = if air.is_thinned_by_heat {
                            let share = share_from_kelvin(*kelvin, air.ambient_k) + warms * burnt;
                            kelvin_from_share(share, air.ambient_k)
                        } else {
                            *kelvin + warms * burnt
                        };
                    }
                }
                Partial { sum, ..Partial::default() }
            },
        );
        total.sum * f64::from(air.ambient_density_kg_m3()) * air.cell_volume_m3
    }
}

/// What a kilogram of fuel a kilogram of gas warms it by: K, or where heat thins the air the
/// growth of `dT / T` (a kilogram of ambient gas then).
fn warms(combustion: &Combustion, air: Air) -> f32 {
    let joules = 1.0e3 * combustion.fuel.heat_kj_kg * (1.0 - combustion.fuel.radiated);
    let kelvin = (joules / AIR_HEAT_CAPACITY_J_KG_K).max(1.0e-3);
    if air.is_thinned_by_heat { kelvin / air.ambient_k } else { kelvin }
}

/// What is left to the temperature of the flame, in the measure of [`warms`].
#[inline(always)]
fn room(kelvin: f32, flame_k: f32, air: Air) -> f32 {
    if air.is_thinned_by_heat {
        share_from_kelvin(flame_k, air.ambient_k) - share_from_kelvin(kelvin, air.ambient_k)
    } else {
        flame_k - kelvin
    }
}

/// How fast gas mixes in a cell: the fastest of molecular diffusion, small eddies, and buoyancy
/// across the cell (FDS Technical Reference Guide, section on the mixing time scale).
struct Mixing {
    width_m: f32,
    factor: f32,
    /// Rate of buoyant mixing, 1/s: one over `sqrt(2 w / g)`.
    buoyant: f32,
}

impl Mixing {
    fn new(grid: &Grid, factor: f32) -> Self {
        let width_m = width_m(grid);
        Self { width_m, factor, buoyant: (0.5 * GRAVITY_M_S2 / width_m).sqrt() }
    }

    /// 1/s, from the viscosity of small eddies.
    #[inline(always)]
    fn rate(&self, eddy_m2_s: f32, kelvin: f32, ambient_k: f32) -> f32 {
        let area = self.width_m * self.width_m;
        let hot = 1.0 + kelvin / ambient_k;
        // Gases spread as the temperature to the power of 1.75; 2 is near enough and cheap.
        let diffusion = GAS_M2_S * hot * hot / area;
        // u' = sqrt(2/3 k), sqrt(k) = viscosity / (C w); time 0.4 w / u'.
        let eddies = 0.816_497 * eddy_m2_s / (0.4 * DEARDORFF * area);
        let fastest = self.factor * diffusion.max(eddies).max(self.buoyant);
        fastest.min(1.0 / CHEMICAL_S)
    }
}
