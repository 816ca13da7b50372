//! The stage of a step in which temperature and scalars change in place.

use crate::fluid::Fluid;
use crate::forces;
use crate::scalars;
use crate::source::Air;

impl Fluid {
    /// What heat and mass are added to.
    pub(crate) fn air(&self) -> Air {
        Air {
            ambient_k: self.settings.ambient_k,
            lowest_k: -0.9 * self.settings.ambient_k,
            is_thinned_by_heat: false,
            cell_volume_m3: self.grid.cell_volume_m3(),
        }
    }

    /// Adds up what sources let expand, before anything moves.
    pub(crate) fn expand(&mut self) {
        let air = self.air();
        let sources = &mut self.sources;
        if sources.placed.expands() {
            sources.expansion.resize(self.grid.count(), 0.0);
            sources.placed.add_expansion(air, &mut sources.expansion);
            sources.has_expansion = true;
        }
    }

    /// Adds heat and scalars, and cools.
    pub(crate) fn burn(&mut self, dt_s: f32) {
        let air = self.air();
        let Self { grid, state, settings, sources, .. } = self;
        sources.placed.heat(air, &mut state.temperature.data, dt_s);
        let heat = sources.has_heat.then_some(sources.heat.as_slice());
        forces::heat_and_cool(grid, &mut state.temperature, heat, settings.cooling_per_s, air.lowest_k, dt_s);
        if sources.has_scalars {
            scalars::feed(grid, &mut state.packs, &sources.scalars, dt_s);
        }
        sources.placed.feed(air, &state.temperature.data, &mut state.packs, dt_s);
    }
}
