//! The stages of a step that heat, burn and expansion add to moving air.

use crate::combustion::{CombustionReport, Emission, FUEL, OXYGEN, Reaction, SOOT, radiate};
use crate::density::{self, Density};
use crate::fluid::{Fluid, State};
use crate::forces;
use crate::parallel::{Partial, reduce, scan_planes};
use crate::pressure::Projected;
use crate::scalars::{self, ScalarId};
use crate::scratch::Scratch;
use crate::sides::{Walls, fix_sides};
use crate::source::Air;

/// Smagorinsky's constant by which the mixing of fuel by small eddies is found where none are modelled.
const SMAGORINSKY: f32 = 0.17;

impl Fluid {
    /// What heat and mass are added to.
    pub(crate) fn air(&self) -> Air {
        Air {
            ambient_k: self.settings.ambient_k,
            lowest_k: -0.9 * self.settings.ambient_k,
            is_thinned_by_heat: self.settings.physics.density == Density::LowMach,
            cell_volume_m3: self.grid.cell_volume_m3(),
        }
    }

    /// Adds up what sources let expand, before anything moves.
    pub(crate) fn expand(&mut self, scratch: &mut Scratch) {
        let air = self.air();
        let sources = &mut self.sources;
        if sources.placed.expands() || self.settings.physics.expands() {
            sources.expansion.resize(self.grid.count(), 0.0);
            sources.has_expansion = true;
        }
        if sources.has_expansion {
            scratch.expansion.clone_from(&sources.expansion);
            sources.placed.add_expansion(air, &mut scratch.expansion);
        }
    }

    /// Lets the air carry what is in it. Where heat thins it, heat and scalars go as what is
    /// conserved: `dT / T`, and masses a volume. Returns the heat that left the box, kW.
    pub(crate) fn carry_heat(
        &mut self,
        scratch: &mut Scratch,
        dt_s: f32,
        project: impl FnOnce(&mut Self, &mut Scratch) -> Projected,
    ) -> (f32, Option<Projected>) {
        let air = self.air();
        if air.is_thinned_by_heat {
            let kelvin = &self.state.temperature.data;
            for pack in &mut self.state.packs {
                density::weigh(&self.grid, pack, kelvin, air.ambient_k, false);
            }
            density::to_shares(&self.grid, &mut self.state.temperature, air.ambient_k);
        }
        let before = self.temperature_sum(scratch);
        let between = self.carry(scratch, dt_s, project);
        let lost = before - self.temperature_sum(scratch);
        let kelvin = if air.is_thinned_by_heat {
            density::to_kelvin(&self.grid, &mut self.state.temperature, air.ambient_k);
            lost * f64::from(air.ambient_k)
        } else {
            lost
        };
        ((kelvin * air.kilojoules_per_k() / f64::from(dt_s)) as f32, between)
    }

    /// Sum over the cells of what stands for temperature.
    fn temperature_sum(&self, scratch: &mut Scratch) -> f64 {
        let grid = &self.grid;
        scan_planes(grid.exec, &self.state.temperature.data, grid.plane(), &mut scratch.partials).sum
    }

    /// Adds heat and scalars; burns, radiates and cools.
    pub(crate) fn burn(&mut self, scratch: &mut Scratch, dt_s: f32) -> CombustionReport {
        let air = self.air();
        let Self { grid, state, settings, sources, scalars, .. } = self;
        let Scratch { next_temperature, strain, reactor, expansion, partials, .. } = scratch;
        let kelvin = &mut state.temperature;
        if air.is_thinned_by_heat {
            next_temperature.data.copy_from_slice(&kelvin.data);
            density::to_shares(grid, next_temperature, air.ambient_k);
        }
        sources.placed.heat(air, &mut kelvin.data, dt_s);
        if sources.has_heat {
            forces::heat_and_cool(grid, kelvin, Some(&sources.heat), 0.0, air.lowest_k, dt_s);
        }
        if sources.has_scalars {
            scalars::feed(grid, &mut state.packs, &sources.scalars, dt_s);
        }
        sources.placed.feed(air, &kelvin.data, &mut state.packs, dt_s);
        let mut report = CombustionReport::default();
        let slot = |name: &str| scalars.names.iter().position(|known| known == name).map(ScalarId::slot_of);
        if let Some(combustion) = &settings.physics.combustion
            && let (Some(fuel), Some(oxygen), Some(soot)) = (slot(FUEL), slot(OXYGEN), slot(SOOT))
        {
            strain.find_eddies(grid, &state.velocity, &settings.physics, SMAGORINSKY);
            let reaction = Reaction { fuel, oxygen, soot };
            let expands = !air.is_thinned_by_heat && combustion.expansion > 0.0;
            let burnt_kg = reactor.burn(
                grid,
                combustion,
                reaction,
                air,
                &strain.viscosity,
                &mut state.packs,
                &mut kelvin.data,
                expands.then_some(expansion.as_mut_slice()),
                partials,
                dt_s,
            );
            let burnt_kg_s = burnt_kg / f64::from(dt_s);
            let heat_kw = burnt_kg_s * f64::from(combustion.fuel.heat_kj_kg);
            let (plane, pack) = (grid.plane(), &state.packs[fuel.0]);
            let left = reduce(grid.exec, &mut partials[..grid.cells[2]], |k| {
                let values = pack[k * plane..(k + 1) * plane].iter();
                Partial { sum: values.map(|values| f64::from(values[fuel.1])).sum(), ..Partial::default() }
            });
            report = CombustionReport {
                heat_release_kw: heat_kw as f32,
                radiated_kw: (heat_kw * f64::from(combustion.fuel.radiated)) as f32,
                burnt_kg_s: burnt_kg_s as f32,
                fuel_kg: (left.sum * f64::from(air.ambient_density_kg_m3()) * air.cell_volume_m3) as f32,
            };
        }
        if let Some(radiation) = settings.physics.radiation {
            let soot = slot(SOOT).map(|(pack, at)| (state.packs[pack].as_slice(), at));
            let emission = Emission { radiation, air, soot };
            let sent_kj = radiate(grid, emission, &mut kelvin.data, partials, dt_s);
            report.radiated_kw += (sent_kj / f64::from(dt_s)) as f32;
        }
        if settings.cooling_per_s > 0.0 {
            forces::heat_and_cool(grid, kelvin, None, settings.cooling_per_s, air.lowest_k, dt_s);
        }
        if air.is_thinned_by_heat {
            for pack in &mut state.packs {
                density::weigh(grid, pack, &kelvin.data, air.ambient_k, true);
            }
            density::to_shares(grid, kelvin, air.ambient_k);
            density::add_growth(grid, expansion, &next_temperature.data, &kelvin.data, dt_s);
            density::to_kelvin(grid, kelvin, air.ambient_k);
        }
        report
    }

    /// Projects. Where density varies the pressure is weighted by that of the lightest air, and
    /// what the last step's pressure does beyond that is added before.
    pub(crate) fn press(&mut self, scratch: &mut Scratch, dt_s: f32) -> Projected {
        if self.settings.physics.density != Density::LowMach {
            return self.project(scratch, self.sources.has_expansion);
        }
        let ambient_k = self.settings.ambient_k;
        let weight = density::lightest(&self.grid, &self.state.temperature.data, ambient_k, &mut scratch.partials);
        let State { velocity, pressure, temperature, .. } = &mut self.state;
        if pressure.len() == self.grid.count() {
            let kelvin = &temperature.data;
            density::add_baroclinic(&self.grid, velocity, pressure, kelvin, ambient_k, weight, dt_s);
            fix_sides(&self.grid, velocity, Walls::of(&self.settings, &self.given, self.solids.as_deref()));
        }
        let projected = self.project(scratch, true);
        let State { potential, pressure, .. } = &mut self.state;
        pressure.clear();
        let per_s = 1.0 / (weight * dt_s);
        pressure.extend(potential.iter().map(|potential| potential * per_s));
        projected
    }
}
