//! The stage of a step in which the air carries what is in it.

use super::Advection;
use super::back::{Kind, Outside};
use super::carrier::{Job, Scheme};
use super::energy::{energy, limit_energy};
use super::flux::{Flow, transport};
use crate::field::Field;
use crate::fluid::Fluid;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::pressure::Projected;
use crate::scalars::{PACK, Pack};
use crate::scratch::Scratch;
use crate::sides::{Walls, fix_sides};

impl Fluid {
    /// Moves velocity, temperature and scalars with the air. [`Advection::Reflection`] projects
    /// in the middle of it, by `project`.
    pub(crate) fn carry(
        &mut self,
        scratch: &mut Scratch,
        dt_s: f32,
        project: impl FnOnce(&mut Self, &mut Scratch) -> Projected,
    ) -> Option<Projected> {
        let scheme = Scheme::from(self.settings.advection);
        let is_traced = Scheme::of_scalars(self.settings.scalar_advection).is_some();
        // Where hot air expands, what the middle of the step would have to expand by is not known.
        if self.settings.advection != Advection::Reflection || self.settings.physics.expands() {
            self.trace(scratch, dt_s);
            let allowed = self.carry_velocity(scratch, None, scheme);
            self.carry_scalars(scratch, dt_s);
            self.take_velocity(scratch, allowed);
            return None;
        }
        self.trace(scratch, 0.5 * dt_s);
        let allowed = self.carry_velocity(scratch, None, scheme);
        self.take_velocity(scratch, allowed);
        let mut mirror = scratch.carrier.mirror.take().unwrap_or_else(|| self.state.velocity.clone());
        for (mirror, field) in mirror.iter_mut().zip(&self.state.velocity) {
            mirror.data.copy_from_slice(&field.data);
        }
        let projected = project(self, scratch);
        reflect(&self.grid, &self.state.velocity, &mut mirror);
        if is_traced {
            self.trace(scratch, dt_s);
        }
        self.carry_scalars(scratch, dt_s);
        self.trace(scratch, 0.5 * dt_s);
        let allowed = self.carry_velocity(scratch, Some(&mirror), scheme);
        self.take_velocity(scratch, allowed);
        scratch.carrier.mirror = Some(mirror);
        Some(projected)
    }

    /// The flow as the grid sees it.
    fn flow(&self) -> Flow<'_> {
        Flow {
            velocity: &self.state.velocity,
            frame: self.settings.frame_m_s.to_array(),
            open: None,
            thins: self.settings.physics.expands(),
        }
    }

    fn trace(&self, scratch: &mut Scratch, dt_s: f32) {
        let schemes = [Some(Scheme::from(self.settings.advection)), Scheme::of_scalars(self.settings.scalar_advection)];
        let has_forth = schemes.contains(&Some(Scheme::MacCormack));
        let order = self.settings.trace;
        scratch.carrier.trace(&self.grid, self.flow(), dt_s, order, has_forth, &mut scratch.partials);
    }

    /// Carries `from`, by itself the velocity, into the scratch arrays. Returns the sum of
    /// squares that may be found there: what there was, and what flows in.
    fn carry_velocity(&self, scratch: &mut Scratch, from: Option<&[Field; 3]>, scheme: Scheme) -> f64 {
        let Self { grid, settings, .. } = self;
        let Scratch { next_velocity, carrier, partials, .. } = scratch;
        let from = from.unwrap_or(&self.state.velocity);
        let mut allowed = energy(grid, from, partials);
        let wind = settings.wind_m_s.to_array();
        for axis in 0..3 {
            let outside = Outside { value: wind[axis], profile: self.given.profile(grid, axis) };
            let job = Job { kind: Kind::faces(axis), scheme, outside };
            allowed += carrier.carry(grid, &from[axis].data, job, &mut next_velocity[axis].data, partials);
        }
        allowed
    }

    /// Takes the velocity that was carried into the scratch arrays.
    fn take_velocity(&mut self, scratch: &mut Scratch, allowed: f64) {
        let Self { grid, state, .. } = self;
        std::mem::swap(&mut state.velocity, &mut scratch.next_velocity);
        fix_sides(grid, &mut state.velocity, Walls::of(&self.settings, &self.given, self.solids.as_deref()));
        if !self.sources.has_expansion {
            limit_energy(grid, &mut state.velocity, allowed, &mut scratch.partials);
        }
    }

    fn carry_scalars(&mut self, scratch: &mut Scratch, dt_s: f32) {
        let Self { grid, state, settings, scalars, .. } = self;
        let Scratch { next_temperature, scalar, carrier, partials, .. } = scratch;
        // Nothing passes the faces of solid cells, not even those that move.
        let mut open_faces = std::mem::take(&mut carrier.open);
        let open = self.solids.as_deref().map(|solids| {
            solids.close(grid, &mut open_faces);
            &open_faces
        });
        let frame = settings.frame_m_s.to_array();
        let flow = Flow { velocity: &state.velocity, frame, open, thins: settings.physics.expands() };
        let scheme = Scheme::of_scalars(settings.scalar_advection);
        let mut carry = |values: &mut Field, outside: f32| {
            let outside = Outside { value: outside, profile: None };
            if let Some(scheme) = scheme {
                let job = Job { kind: Kind::CENTRES, scheme, outside };
                carrier.carry(grid, &values.data, job, &mut next_temperature.data, partials);
                std::mem::swap(values, next_temperature);
            } else {
                transport(grid, flow, dt_s, outside, [&mut values.data, &mut next_temperature.data], partials);
            }
        };
        carry(&mut state.temperature, 0.0);
        for (index, outside) in scalars.outside.iter().enumerate() {
            unpack(&state.packs, index, &mut scalar.data);
            carry(scalar, *outside);
            pack(&mut state.packs, index, &scalar.data);
        }
        scratch.carrier.open = open_faces;
    }
}

/// Makes twice the projected velocity less the one before out of the one before.
fn reflect(grid: &Grid, projected: &[Field; 3], before: &mut [Field; 3]) {
    for (field, before) in projected.iter().zip(before) {
        let plane = field.plane();
        for_planes(
            grid.exec,
            &mut before.data,
            plane,
            #[inline(always)]
            |k, out| {
                for (out, after) in out.iter_mut().zip(&field.data[k * plane..]) {
                    *out = 2.0 * after - *out;
                }
            },
        );
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
