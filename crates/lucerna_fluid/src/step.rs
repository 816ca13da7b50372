//! One step: the stages in their order.

use std::time::Instant;

use crate::advect::{Advection, pack, unpack};
use crate::density::{self, Density};
use crate::fluid::Fluid;
use crate::forces;
use crate::gas;
use crate::obstacle::Solids;
use crate::parallel::scan_planes;
use crate::pressure::Projected;
use crate::report::{StageTimes, StepReport};
use crate::scratch::Scratch;
use crate::sides::{Walls, fix_sides, push_wind};
use crate::source::share_from_kelvin;
use crate::viscosity::{Diffusivity, Held, diffuse_scalar, diffuse_velocity};

/// Takes the time of each stage. There is no clock on bare WebAssembly: all times are zero.
pub(crate) struct Clock(Option<Instant>);

impl Clock {
    pub(crate) fn start() -> Self {
        Self((!cfg!(target_arch = "wasm32")).then(Instant::now))
    }

    /// Time since the last call, ms.
    pub(crate) fn lap_ms(&mut self) -> f32 {
        let Some(before) = self.0 else { return 0.0 };
        let now = Instant::now();
        self.0 = Some(now);
        (now - before).as_secs_f32() * 1.0e3
    }
}

impl Fluid {
    /// All stages once. What was added for the step stays: it may be divided into parts.
    pub(crate) fn advance(&mut self, scratch: &mut Scratch, dt_s: f32) -> StepReport {
        let mut clock = Clock::start();
        let mut times = StageTimes::default();
        if let Some(solids) = &self.solids {
            let state = &mut self.state;
            solids.fill(&mut state.velocity, &mut state.temperature, &mut state.packs);
        }
        if self.settings.advection == Advection::Conservative
            && let Some(report) = self.advance_conserving(scratch, dt_s)
        {
            return report;
        }
        self.expand(scratch);
        let (carried_out_kw, between) = self.carry_heat(scratch, dt_s, |fluid, scratch| {
            times.advection_ms = clock.lap_ms();
            let projected = fluid.project(scratch, fluid.sources.has_expansion);
            times.pressure_ms = clock.lap_ms();
            projected
        });
        times.advection_ms += clock.lap_ms();
        let combustion = self.burn(scratch, dt_s);
        self.push(scratch, dt_s, true);
        times.forces_ms = clock.lap_ms();
        self.rub_air(scratch, dt_s);
        self.rub_heat(scratch, dt_s);
        times.viscosity_ms = clock.lap_ms();
        let mut projected = self.press(scratch, dt_s);
        projected.iterations += between.map_or(0, |between| between.iterations);
        times.pressure_ms += clock.lap_ms();
        self.move_box(dt_s);
        let mut report = self.report(scratch, dt_s, projected);
        times.report_ms = clock.lap_ms();
        report.times = times;
        report.carried_out_kw = carried_out_kw;
        report.combustion = combustion;
        report
    }

    /// Adds all that accelerates the air, its lift too if `lifts`.
    pub(crate) fn push(&mut self, scratch: &mut Scratch, dt_s: f32, lifts: bool) {
        let air = self.air();
        let Self { grid, state, settings, sources, given, solids, .. } = self;
        let velocity = &mut state.velocity;
        if settings.vorticity_confinement > 0.0 {
            scratch.confinement.apply(grid, velocity, settings.vorticity_confinement, dt_s);
        }
        if lifts {
            let density = settings.physics.density;
            forces::buoyancy(grid, &mut velocity[1], &state.temperature, density, settings.ambient_k, dt_s);
        }
        for (axis, field) in velocity.iter_mut().enumerate() {
            if sources.has_acceleration[axis] {
                forces::accelerate(grid, field, &sources.acceleration[axis], dt_s);
            }
        }
        sources.placed.push(grid, air, &state.temperature.data, velocity, dt_s);
        velocity.iter_mut().for_each(|field| forces::clamp_speed(grid, field));
        push_wind(grid, velocity, Walls::of(settings, given, solids.as_deref()), dt_s);
    }

    /// Lets viscosity act, and sets the flow through the sides.
    pub(crate) fn rub_air(&mut self, scratch: &mut Scratch, dt_s: f32) {
        let Self { grid, state, settings, given, solids, .. } = self;
        let walls = Walls::of(settings, given, solids.as_deref());
        fix_sides(grid, &mut state.velocity, walls);
        let held = solids.as_deref().map_or(Held::default(), Solids::held);
        let Scratch { next_velocity, next_temperature, coefficients, strain, .. } = scratch;
        let eddies = settings.physics.has_eddies();
        if eddies {
            strain.find_eddies(grid, &state.velocity, &settings.physics, 0.0);
        }
        let is_hot = settings.physics.hot_gas;
        if is_hot {
            let kelvin = (state.temperature.data.as_slice(), settings.ambient_k);
            gas::add_of_hot_gas(grid, &mut strain.viscosity, eddies, kelvin, settings.viscosity_m2_s);
        }
        let eddy_m2_s = (eddies || is_hot).then_some(strain.viscosity.as_slice());
        let mut viscosity = Diffusivity { uniform_m2_s: settings.viscosity_m2_s, eddy_m2_s, density: None };
        if viscosity.acts() {
            if settings.physics.density == Density::LowMach {
                density::relative(grid, &state.temperature.data, settings.ambient_k, &mut next_temperature.data);
                viscosity.density = Some(&next_temperature.data);
            }
            diffuse_velocity(grid, &mut state.velocity, viscosity, dt_s, walls, held, next_velocity, coefficients);
            fix_sides(grid, &mut state.velocity, walls);
        }
    }

    /// Lets heat and scalars spread, by the eddies that viscosity found.
    pub(crate) fn rub_heat(&mut self, scratch: &mut Scratch, dt_s: f32) {
        let Self { grid, state, settings, given, scalars, solids, .. } = self;
        let held = solids.as_deref().map_or(Held::default(), Solids::held);
        let Scratch { next_temperature, coefficients, strain, scalar, .. } = scratch;
        let eddies = settings.physics.has_eddies();
        if eddies {
            strain.scale(grid, 1.0 / settings.physics.turbulent_prandtl);
        }
        let is_hot = settings.physics.hot_gas;
        if is_hot {
            let kelvin = (state.temperature.data.as_slice(), settings.ambient_k);
            let at_ambient = settings.thermal_diffusivity_m2_s;
            gas::add_of_hot_gas(grid, &mut strain.viscosity, eddies, kelvin, at_ambient);
        }
        let varies = eddies || is_hot;
        let eddy_m2_s = varies.then_some(strain.viscosity.as_slice());
        let conduction = Diffusivity { uniform_m2_s: settings.thermal_diffusivity_m2_s, eddy_m2_s, density: None };
        if conduction.acts() {
            let is_thinned = settings.physics.density == Density::LowMach;
            let ambient_k = settings.ambient_k;
            let (field, mut sides) = (&mut state.temperature, given.temperature_k);
            if is_thinned {
                // What spreads is what is conserved: heat and masses a volume, and with them density. So the velocity
                // stays that of volume (H. Brenner, Physica A 349, 2005) and conduction makes none: were gas to expand
                // as well, masses would be moved twice.
                for pack in &mut state.packs {
                    density::weigh(grid, pack, &field.data, ambient_k, false);
                }
                density::to_shares(grid, field, ambient_k);
                sides = sides.map(|ends| ends.map(|kelvin| kelvin.map(|kelvin| share_from_kelvin(kelvin, ambient_k))));
            }
            diffuse_scalar(grid, field, conduction, dt_s, sides, held, next_temperature, coefficients);
            if is_thinned {
                density::to_kelvin(grid, field, ambient_k);
            }
            if varies || is_thinned {
                for index in 0..scalars.names.len() {
                    unpack(&state.packs, index, &mut scalar.data);
                    let sides = [[None; 2]; 3];
                    diffuse_scalar(grid, scalar, conduction, dt_s, sides, held, next_temperature, coefficients);
                    pack(&mut state.packs, index, &scalar.data);
                }
            }
            if is_thinned {
                for pack in &mut state.packs {
                    density::weigh(grid, pack, &state.temperature.data, ambient_k, true);
                }
            }
        }
    }

    pub(crate) fn report(&mut self, scratch: &mut Scratch, dt_s: f32, projected: Projected) -> StepReport {
        let Self { grid, state, .. } = self;
        let temperature = &state.temperature.data;
        let max_temperature_k = scan_planes(grid.exec, temperature, grid.plane(), &mut scratch.partials).high;
        let max_speed_m_s = projected.speeds.into_iter().fold(0.0, f32::max);
        self.max_speed_m_s = max_speed_m_s;
        let speed = max_speed_m_s.max(projected.speed_before);
        let relative = |rate: f32| if speed > 0.0 { rate * grid.shortest_m() / speed } else { 0.0 };
        let crossed = projected.speeds.into_iter().zip(grid.cell_m).map(|(speed, edge)| speed * dt_s / edge);
        let rms_speed = projected.rms_speed.max(projected.rms_speed_before);
        let rms_relative = |rate: f32| if rms_speed > 0.0 { rate * grid.shortest_m() / rms_speed } else { 0.0 };
        StepReport {
            dt_s,
            pressure_iterations: projected.iterations,
            rms_divergence_before: rms_relative(projected.rms_before),
            rms_divergence_after: rms_relative(projected.rms_after),
            rms_divergence_after_per_s: projected.rms_after,
            rms_speed_m_s: projected.rms_speed,
            pressure_residual: projected.residual,
            divergence_before: relative(projected.max_before),
            divergence_after: relative(projected.max_after),
            divergence_after_per_s: projected.max_after,
            max_speed_m_s,
            cfl: crossed.fold(0.0, f32::max),
            max_temperature_k,
            ..StepReport::default()
        }
    }
}
