//! The stage of a step in which the air carries what is in it.

use super::energy::{energy, limit_energy};
use super::flux::transport;
use super::packs::advect_pack;
use super::semi_lagrangian::{advect, trace_back};
use crate::fluid::Fluid;
use crate::scratch::Scratch;
use crate::sides::{Walls, fix_sides};

impl Fluid {
    /// Moves velocity, temperature and scalars with the air.
    pub(crate) fn carry(&mut self, scratch: &mut Scratch, dt_s: f32) {
        let Self { grid, state, .. } = self;
        let Scratch { next_velocity, next_temperature, next_pack, trace, partials, .. } = scratch;
        let wind = self.settings.wind_m_s.to_array();
        trace_back(grid, &state.velocity, dt_s, trace);
        let mut allowed = energy(grid, &state.velocity, partials);
        for axis in 0..3 {
            let (from, to) = (&state.velocity[axis], &mut next_velocity[axis]);
            allowed += advect(grid, from, axis, trace, wind[axis], to, partials);
        }
        for (index, pack) in state.packs.iter_mut().enumerate() {
            next_pack.resize(pack.len(), [0.0; 4]);
            advect_pack(grid, pack, trace, self.scalars.outside(index), next_pack);
            std::mem::swap(pack, next_pack);
        }
        transport(grid, &state.velocity, dt_s, &mut state.temperature, next_temperature, partials);
        std::mem::swap(&mut state.velocity, next_velocity);
        fix_sides(grid, &mut state.velocity, Walls::of(&self.settings, &self.given));
        if !self.sources.has_expansion {
            limit_energy(grid, &mut state.velocity, allowed, partials);
        }
    }
}
