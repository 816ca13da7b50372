//! The stage of a step in which the air carries what is in it.

use super::back::{Kind, Outside};
use super::carrier::{Job, Scheme};
use super::energy::{energy, limit_energy};
use super::flux::{Flow, transport};
use crate::fluid::Fluid;
use crate::scalars::{PACK, Pack};
use crate::scratch::Scratch;
use crate::sides::{Walls, fix_sides};

impl Fluid {
    /// Moves velocity, temperature and scalars with the air.
    pub(crate) fn carry(&mut self, scratch: &mut Scratch, dt_s: f32) {
        let Self { grid, state, settings, scalars, .. } = self;
        let Scratch { next_velocity, next_temperature, scalar, carrier, partials, .. } = scratch;
        let wind = settings.wind_m_s.to_array();
        let scheme = Scheme::from(settings.advection);
        let scalar_scheme = Scheme::of_scalars(settings.scalar_advection);
        let has_forth = [Some(scheme), scalar_scheme].contains(&Some(Scheme::MacCormack));
        let flow = Flow {
            velocity: &state.velocity,
            frame: settings.frame_m_s.to_array(),
            open: None,
            thins: settings.physics.expands(),
        };
        carrier.trace(grid, flow, dt_s, settings.trace, has_forth, partials);
        let mut allowed = energy(grid, &state.velocity, partials);
        for axis in 0..3 {
            let outside = Outside { value: wind[axis], profile: self.given.profile(grid, axis) };
            let job = Job { kind: Kind::faces(axis), scheme, outside };
            let (from, out) = (&state.velocity[axis].data, &mut next_velocity[axis].data);
            allowed += carrier.carry(grid, from, job, out, partials);
        }
        let outsides = std::iter::once(0.0).chain(scalars.outside.iter().copied());
        for (index, outside) in outsides.enumerate() {
            let values = if index == 0 { &mut state.temperature } else { &mut *scalar };
            if index > 0 {
                unpack(&state.packs, index - 1, &mut values.data);
            }
            let outside = Outside { value: outside, profile: None };
            if let Some(scheme) = scalar_scheme {
                let job = Job { kind: Kind::CENTRES, scheme, outside };
                carrier.carry(grid, &values.data, job, &mut next_temperature.data, partials);
                std::mem::swap(values, next_temperature);
            } else {
                let fields = [&mut values.data, &mut next_temperature.data];
                transport(grid, flow, dt_s, outside, fields, partials);
            }
            if index > 0 {
                pack(&mut state.packs, index - 1, &values.data);
            }
        }
        std::mem::swap(&mut state.velocity, next_velocity);
        fix_sides(grid, &mut state.velocity, Walls::of(&self.settings, &self.given, self.solids.as_deref()));
        if !self.sources.has_expansion {
            limit_energy(grid, &mut state.velocity, allowed, partials);
        }
    }
}

/// Copies a scalar out of its pack.
pub(crate) fn unpack(packs: &[Pack], index: usize, out: &mut Vec<f32>) {
    let pack = &packs[index / PACK];
    out.clear();
    out.extend(pack.iter().map(|values| values[index % PACK]));
}

/// Copies a scalar into its pack.
pub(crate) fn pack(packs: &mut [Pack], index: usize, values: &[f32]) {
    for (packed, value) in packs[index / PACK].iter_mut().zip(values) {
        packed[index % PACK] = *value;
    }
}
