//! The step: two steps of Euler's and their mean, then heat and burning.

use super::mean::{difference, mean, mean_by_mass, mean_of_packs};
use super::{Conserver, MOST_COURANT};
use crate::density::{self, Density};
use crate::field::Field;
use crate::fluid::Fluid;
use crate::parallel::{for_planes, scan_planes};
use crate::pressure::{Projected, divergence_plane, slices};
use crate::report::{StageTimes, StepReport};
use crate::scratch::Scratch;
use crate::sides::{Walls, fix_sides};
use crate::step::Clock;

impl Fluid {
    /// The Courant number of a step, summed over the axes: what limits this scheme.
    pub(crate) fn courant(&self, scratch: &mut Scratch, dt_s: f32) -> f32 {
        let mut room = self.take_room(scratch);
        let courant = self.take_flow(scratch, &mut room, dt_s);
        scratch.conserver = room;
        courant
    }

    /// All stages once, as [`Fluid::advance`]; none where the air goes too far in `dt_s`.
    pub(crate) fn advance_conserving(&mut self, scratch: &mut Scratch, dt_s: f32) -> Option<StepReport> {
        let mut clock = Clock::start();
        let mut times = StageTimes::default();
        let mut room = self.take_room(scratch);
        if self.take_flow(scratch, &mut room, dt_s) > MOST_COURANT {
            scratch.conserver = room;
            return None;
        }
        let (carried_out_kw, first) = self.carry_conserving(scratch, &mut room, dt_s);
        times.advection_ms = clock.lap_ms();
        self.expand(scratch);
        let combustion = self.burn(scratch, dt_s);
        times.forces_ms = clock.lap_ms();
        self.rub_heat(scratch, dt_s);
        times.viscosity_ms = clock.lap_ms();
        let mut projected = self.project(scratch, self.sources.has_expansion);
        // What a projection of part of a step leaves is a potential of that part.
        let whole = 1.0 / room.part;
        self.state.potential.iter_mut().for_each(|value| *value *= whole);
        scratch.conserver = room;
        projected.iterations += first.iterations;
        times.pressure_ms = clock.lap_ms();
        self.move_box(dt_s);
        let mut report = self.report(scratch, dt_s, projected);
        times.report_ms = clock.lap_ms();
        report.times = times;
        report.carried_out_kw = carried_out_kw;
        report.combustion = combustion;
        Some(report)
    }

    /// The working arrays, in shape.
    fn take_room(&self, scratch: &mut Scratch) -> Conserver {
        let mut room = std::mem::take(&mut scratch.conserver);
        room.fit(&self.grid);
        match self.solids.as_deref() {
            Some(solids) => solids.close(&self.grid, &mut room.open),
            None => room.open.iter_mut().for_each(Vec::clear),
        }
        room
    }

    /// Velocity, temperature and scalars. Returns the heat that left the box, kW, and the first
    /// projection. Temperatures are above ambient again at the end; where heat thins the air,
    /// scalars are masses a volume still.
    fn carry_conserving(&mut self, scratch: &mut Scratch, room: &mut Conserver, dt_s: f32) -> (f32, Projected) {
        let air = self.air();
        let plane = self.grid.plane();
        self.find_push(scratch, room, dt_s);
        if air.is_thinned_by_heat {
            for pack in &mut self.state.packs {
                density::weigh(&self.grid, pack, &self.state.temperature.data, air.ambient_k, false);
            }
            density::to_shares(&self.grid, &mut self.state.temperature, air.ambient_k);
        }
        room.start_temperature.clone_from(&self.state.temperature.data);
        room.start_packs.clone_from(&self.state.packs);
        let before = scan_planes(self.grid.exec, &self.state.temperature.data, plane, &mut scratch.partials).sum;
        self.find_divergence(scratch);
        self.euler(scratch, room, dt_s, true);
        let projected = self.project(scratch, true);
        self.keep_pressure(room.weight * dt_s);
        room.part = 1.0;
        if self.take_flow(scratch, room, dt_s) <= MOST_COURANT {
            self.euler(scratch, room, dt_s, false);
            self.take_mean(room);
            room.part = 0.5;
        }
        let after = scan_planes(self.grid.exec, &self.state.temperature.data, plane, &mut scratch.partials).sum;
        let mut lost_k = before - after;
        if air.is_thinned_by_heat {
            density::to_kelvin(&self.grid, &mut self.state.temperature, air.ambient_k);
            lost_k *= f64::from(air.ambient_k);
        }
        ((lost_k * air.kilojoules_per_k() / f64::from(dt_s)) as f32, projected)
    }

    /// Finds what accelerates the air besides weight and pressure; keeps the velocity.
    fn find_push(&mut self, scratch: &mut Scratch, room: &mut Conserver, dt_s: f32) {
        let mut start = room.start.take().unwrap_or_else(|| self.state.velocity.clone());
        let mut push = room.push.take().unwrap_or_else(|| self.state.velocity.clone());
        copy_fields(&self.state.velocity, &mut start);
        self.push(scratch, dt_s, false);
        self.rub_air(scratch, dt_s);
        for ((push, now), start) in push.iter_mut().zip(&self.state.velocity).zip(&start) {
            difference(&self.grid, now.plane(), &now.data, &start.data, &mut push.data);
        }
        copy_fields(&start, &mut self.state.velocity);
        (room.start, room.push) = (Some(start), Some(push));
    }

    /// What the flow expands by at the start is what it expands by in the middle of the step.
    fn find_divergence(&mut self, scratch: &mut Scratch) {
        let (grid, velocity) = (&self.grid, slices(&self.state.velocity));
        scratch.expansion.resize(grid.count(), 0.0);
        for_planes(
            grid.exec,
            &mut scratch.expansion,
            grid.plane(),
            #[inline(always)]
            |k, out| divergence_plane(grid, velocity, k, out),
        );
    }

    /// Makes the state the mean of what it was at the start and what it is.
    fn take_mean(&mut self, room: &mut Conserver) {
        let Self { grid, state, settings, given, solids, .. } = self;
        let Conserver { shape, shares, start, start_temperature, start_packs, .. } = room;
        if let Some(start) = start {
            for (axis, (field, start)) in state.velocity.iter_mut().zip(start.iter()).enumerate() {
                mean_by_mass(grid, *shape, axis, &start.data, [&shares[0], &shares[2]], &mut field.data);
            }
        }
        mean(grid, start_temperature, &mut state.temperature.data);
        for (pack, start) in state.packs.iter_mut().zip(start_packs.iter()) {
            mean_of_packs(grid, start, pack);
        }
        fix_sides(grid, &mut state.velocity, Walls::of(settings, given, solids.as_deref()));
    }

    /// Where density varies, keeps the pressure over ambient density of the first projection. That
    /// of the last one would hold the jerk by which gas starts to expand, too.
    fn keep_pressure(&mut self, weight_s: f32) {
        let state = &mut self.state;
        state.pressure.clear();
        if self.settings.physics.density == Density::LowMach {
            let per = 1.0 / weight_s;
            state.pressure.extend(state.potential.iter().map(|potential| potential * per));
        }
    }
}

fn copy_fields(from: &[Field; 3], to: &mut [Field; 3]) {
    for (from, to) in from.iter().zip(to) {
        to.data.copy_from_slice(&from.data);
    }
}
