//! One of the two steps of Euler's.

use super::Conserver;
use super::flux::{add_fluxes, courant, fluxes, mass_from_share};
use super::momentum::Transport;
use super::padded::{Shape, copy_in, for_rows, surround_cells, surround_faces, surround_fluxes, surround_pressure};
use crate::advect::{pack, unpack};
use crate::density::Density;
use crate::fluid::Fluid;
use crate::forces;
use crate::grid::Grid;
use crate::limits::MAX_TEMPERATURE_K;
use crate::parallel::scan_planes;
use crate::scalars::MAX_SCALAR;
use crate::scratch::Scratch;
use crate::sides::{Side, Wall, Walls, fix_sides};

/// Least `1 - rho / rho_a`: a tenth of the ambient temperature.
const LEAST_SHARE: f32 = -9.0;

impl Fluid {
    /// Takes the velocity into the padded arrays. Returns its Courant number.
    pub(super) fn take_flow(&self, scratch: &mut Scratch, room: &mut Conserver, dt_s: f32) -> f32 {
        let Self { grid, state, settings, given, solids, .. } = self;
        let Conserver { shape, velocity, flow, open, .. } = room;
        let shape = *shape;
        for (axis, field) in state.velocity.iter().enumerate() {
            copy_in(grid, shape, &field.data, field.counts, &mut velocity[axis]);
            against_grid(grid, shape, axis, &velocity[axis], settings.frame_m_s[axis], &open[axis], &mut flow[axis]);
        }
        let walls = Walls::of(settings, given, solids.as_deref());
        for (axis, velocity) in velocity.iter_mut().enumerate() {
            surround_faces(grid, shape, axis, velocity, flow, |along, end| match grid.sides[along][end] {
                Side::Open => Wall::Same(walls.wind[axis]),
                _ => walls.at(grid, along, end, axis),
            });
        }
        courant(grid, shape, flow, dt_s, &mut scratch.partials)
    }

    /// A step of Euler's of all that is carried, and of the velocity by weight, pressure and
    /// `push`. The flow must have been taken; where heat thins the air the temperature is told by
    /// `1 - rho / rho_a`, and scalars by their masses a volume.
    pub(super) fn euler(&mut self, scratch: &mut Scratch, room: &mut Conserver, dt_s: f32, is_first: bool) {
        let (now, next) = if is_first { (0, 1) } else { (1, 2) };
        let thins = self.settings.physics.density == Density::LowMach;
        self.carry_gas(scratch, room, dt_s, now, next);
        let Self { grid, state, settings, given, solids, .. } = self;
        let Conserver { shape, velocity, mass, pressure, shares, push, start_temperature, weight, .. } = room;
        let shape = *shape;
        *weight = 1.0;
        if thins {
            let mut high = |share: &[f32]| scan_planes(grid.exec, share, grid.plane(), &mut scratch.partials).high;
            *weight = 1.0 / (1.0 - high(&state.temperature.data).max(high(start_temperature)));
        }
        if thins && state.pressure.len() == grid.count() {
            copy_in(grid, shape, &state.pressure, grid.cells, pressure);
            surround_pressure(grid, shape, pressure);
        } else {
            pressure.fill(0.0);
        }
        let transport = Transport {
            grid,
            shape,
            velocity,
            mass,
            share: &shares[next],
            pressure,
            weight: *weight,
            push: push.as_ref().map(|push| push.each_ref().map(|field| field.data.as_slice())),
            lifts: thins,
            dt_s,
        };
        for (axis, field) in state.velocity.iter_mut().enumerate() {
            transport.run(axis, &mut field.data);
        }
        if !thins {
            let density = settings.physics.density;
            forces::buoyancy(grid, &mut state.velocity[1], &state.temperature, density, settings.ambient_k, dt_s);
        }
        state.velocity.iter_mut().for_each(|field| forces::clamp_speed(grid, field));
        fix_sides(grid, &mut state.velocity, Walls::of(settings, given, solids.as_deref()));
    }

    /// Temperature and scalars; leaves the fluxes of mass behind.
    fn carry_gas(&mut self, scratch: &mut Scratch, room: &mut Conserver, dt_s: f32, now: usize, next: usize) {
        let Self { grid, state, settings, scalars, .. } = self;
        let Conserver { shape, flow, mass, fluxes: through, values, shares, .. } = room;
        let shape = *shape;
        let thins = settings.physics.density == Density::LowMach;
        let kelvin = &mut state.temperature.data;
        if thins {
            let most = MAX_TEMPERATURE_K / (settings.ambient_k + MAX_TEMPERATURE_K);
            copy_in(grid, shape, kelvin, grid.cells, &mut shares[now]);
            surround_cells(grid, shape, &mut shares[now], flow, 0.0);
            for axis in 0..3 {
                fluxes(grid, shape, axis, &flow[axis], &shares[now], &mut mass[axis]);
            }
            add_fluxes(grid, shape, mass, None, dt_s, [LEAST_SHARE, most], kelvin);
            for axis in 0..3 {
                mass_from_share(grid, shape, axis, &flow[axis], &mut mass[axis]);
            }
            copy_in(grid, shape, kelvin, grid.cells, &mut shares[next]);
            surround_cells(grid, shape, &mut shares[next], flow, 0.0);
        } else {
            for (mass, flow) in mass.iter_mut().zip(flow.iter()) {
                mass.copy_from_slice(flow);
            }
        }
        for (axis, mass) in mass.iter_mut().enumerate() {
            surround_fluxes(grid, shape, axis, mass);
        }
        // Where gas expands, what it holds is kept; elsewhere the value in it.
        let keeps_values = !settings.physics.expands();
        let mut carry = |field: &mut [f32], outside: f32, most: f32| {
            copy_in(grid, shape, field, grid.cells, values);
            if thins {
                divide_by_density(grid, shape, &shares[now], values);
            }
            surround_cells(grid, shape, values, flow, outside);
            for axis in 0..3 {
                fluxes(grid, shape, axis, &mass[axis], values, &mut through[axis]);
            }
            let kept = keeps_values.then_some((values.as_slice(), &*mass));
            add_fluxes(grid, shape, through, kept, dt_s, [-most, most], field);
        };
        if !thins {
            carry(kelvin, 0.0, MAX_TEMPERATURE_K);
        }
        for (index, outside) in scalars.outside.iter().enumerate() {
            let field = &mut scratch.scalar.data;
            unpack(&state.packs, index, field);
            carry(field, *outside, MAX_SCALAR);
            pack(&mut state.packs, index, field);
        }
    }
}

/// Fills `flow` with the velocity against a grid that moves, zero in and beside solid cells.
fn against_grid(
    grid: &Grid,
    shape: Shape,
    axis: usize,
    velocity: &[f32],
    frame_m_s: f32,
    open: &[f32],
    flow: &mut [f32],
) {
    for_rows(
        grid,
        shape,
        grid.face_counts(axis),
        flow,
        #[inline(always)]
        |at, place, out| {
            for (out, velocity) in out.iter_mut().zip(&velocity[at..]) {
                *out = velocity - frame_m_s;
            }
            if !open.is_empty() {
                for (out, open) in out.iter_mut().zip(&open[place..]) {
                    *out *= open;
                }
            }
        },
    );
}

/// Turns masses a volume into shares of the mass there. Both are padded.
fn divide_by_density(grid: &Grid, shape: Shape, share: &[f32], values: &mut [f32]) {
    for_rows(
        grid,
        shape,
        grid.cells,
        values,
        #[inline(always)]
        |at, _, out| {
            for (value, share) in out.iter_mut().zip(&share[at..]) {
                *value /= 1.0 - share;
            }
        },
    );
}
