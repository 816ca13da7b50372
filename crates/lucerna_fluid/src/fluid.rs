//! The fluid and its step.

use glam::Vec3;

use crate::advect::{advect, trace_back};
use crate::confinement::Confinement;
use crate::error::{FluidError, check};
use crate::field::Field;
use crate::forces;
use crate::grid::Grid;
use crate::limits::MAX_DT_S;
use crate::parallel::{Partial, reduce};
use crate::pressure::{PressureSolver, Projected, Projection};
use crate::report::StepReport;
use crate::sides::Sides;
use crate::transport::transport;
use crate::viscosity::diffuse;

/// What may change while the fluid runs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings {
    pub(crate) wind_m_s: Vec3,
    pub(crate) viscosity_m2_s: f32,
    pub(crate) vorticity_confinement: f32,
    pub(crate) ambient_k: f32,
    pub(crate) cooling_per_s: f32,
}

/// What was added for the coming step, and whether there is any of it.
pub(crate) struct Sources {
    pub(crate) acceleration: [Field; 3],
    pub(crate) has_acceleration: bool,
    /// K/s, by cell.
    pub(crate) heat: Vec<f32>,
    pub(crate) has_heat: bool,
    /// 1/s, by cell.
    pub(crate) expansion: Vec<f32>,
    pub(crate) has_expansion: bool,
}

/// Air in a box. See the [crate's page](crate) for an example and the order of values.
pub struct Fluid {
    pub(crate) grid: Grid,
    pub(crate) sides: Sides,
    pub(crate) settings: Settings,
    pub(crate) velocity: [Field; 3],
    pub(crate) temperature: Field,
    pub(crate) sources: Sources,
    pub(crate) projection: Projection,
    pub(crate) max_speed_m_s: f32,
    pub(crate) next_velocity: [Field; 3],
    pub(crate) next_temperature: Field,
    trace: Vec<f32>,
    confinement: Confinement,
    partials: Vec<Partial>,
}

impl Fluid {
    pub(crate) fn new(grid: Grid, sides: Sides, settings: Settings, pressure: PressureSolver) -> Self {
        let faces = || std::array::from_fn(|axis| Field::on_faces(&grid, axis));
        let mut fluid = Self {
            sides,
            settings,
            velocity: faces(),
            temperature: Field::at_centres(&grid),
            sources: Sources {
                acceleration: faces(),
                has_acceleration: false,
                heat: vec![0.0; grid.count()],
                has_heat: false,
                expansion: vec![0.0; grid.count()],
                has_expansion: false,
            },
            projection: Projection::new(&grid, pressure),
            max_speed_m_s: 0.0,
            next_velocity: faces(),
            next_temperature: Field::at_centres(&grid),
            trace: vec![0.0; 3 * grid.count()],
            confinement: Confinement::new(&grid),
            partials: vec![Partial::default(); grid.cells[2] + 1],
            grid,
        };
        fluid.reset();
        fluid
    }

    /// Back to the start: ambient temperature, the air moving with the wind as far as the sides
    /// allow, nothing added. Settings stay.
    pub fn reset(&mut self) {
        self.temperature.data.fill(0.0);
        self.clear_sources();
        for (field, wind) in self.velocity.iter_mut().zip(self.settings.wind_m_s.to_array()) {
            field.data.fill(wind);
        }
        self.settle();
    }

    /// Makes the present velocity obey the sides, and free of divergence.
    pub(crate) fn settle(&mut self) -> Projected {
        forces::fix_sides(&self.grid, &mut self.velocity, self.settings.wind_m_s.to_array());
        let projected = self.projection.project(&self.grid, &mut self.velocity, None);
        self.max_speed_m_s = projected.speeds.into_iter().fold(0.0, f32::max);
        projected
    }

    fn clear_sources(&mut self) {
        let sources = &mut self.sources;
        if std::mem::take(&mut sources.has_acceleration) {
            sources.acceleration.iter_mut().for_each(|field| field.data.fill(0.0));
        }
        if std::mem::take(&mut sources.has_heat) {
            sources.heat.fill(0.0);
        }
        if std::mem::take(&mut sources.has_expansion) {
            sources.expansion.fill(0.0);
        }
    }

    /// Advances by `dt_s` seconds, above 0 and up to 1e3, and uses up what was added since the
    /// last step. Any such step is stable; for accuracy keep [`StepReport::cfl`] below about 3.
    ///
    /// # Errors
    /// A length of step out of its range; nothing has changed then.
    pub fn step(&mut self, dt_s: f32) -> Result<StepReport, FluidError> {
        check("dt_s", dt_s, f32::MIN_POSITIVE, MAX_DT_S, "above 0, up to 1e3 s")?;
        if self.grid.is_parallel {
            // Enter the thread pool once, not once for each pass over the planes.
            Ok(rayon::scope(|_| self.advance(dt_s)))
        } else {
            Ok(self.advance(dt_s))
        }
    }

    fn advance(&mut self, dt_s: f32) -> StepReport {
        self.carry(dt_s);
        self.push(dt_s);
        let wind = self.settings.wind_m_s.to_array();
        if self.settings.viscosity_m2_s > 0.0 {
            let viscosity_dt = f64::from(self.settings.viscosity_m2_s) * f64::from(dt_s);
            forces::fix_sides(&self.grid, &mut self.velocity, wind);
            diffuse(&self.grid, &mut self.velocity, viscosity_dt, wind);
        }
        forces::fix_sides(&self.grid, &mut self.velocity, wind);
        let expansion = self.sources.has_expansion.then_some(self.sources.expansion.as_slice());
        let projected = self.projection.project(&self.grid, &mut self.velocity, expansion);
        self.clear_sources();
        self.report(dt_s, projected)
    }

    /// Moves velocity and temperature with the air; then heats and cools.
    fn carry(&mut self, dt_s: f32) {
        let Self { grid, velocity, temperature, next_velocity, next_temperature, trace, partials, .. } = self;
        let wind = self.settings.wind_m_s.to_array();
        trace_back(grid, velocity, dt_s, trace);
        let mut allowed = forces::energy(grid, velocity, partials);
        for axis in 0..3 {
            let (from, to) = (&velocity[axis], &mut next_velocity[axis]);
            allowed += advect(grid, from, axis, trace, wind[axis], to, partials);
        }
        transport(grid, velocity, dt_s, temperature, next_temperature, partials);
        std::mem::swap(velocity, next_velocity);
        forces::fix_sides(grid, velocity, wind);
        if !self.sources.has_expansion {
            forces::limit_energy(grid, velocity, allowed, partials);
        }
        let heat = self.sources.has_heat.then_some(self.sources.heat.as_slice());
        let lowest_k = -0.9 * self.settings.ambient_k;
        forces::heat_and_cool(grid, temperature, heat, self.settings.cooling_per_s, lowest_k, dt_s);
    }

    /// Adds all that accelerates the air.
    fn push(&mut self, dt_s: f32) {
        let Self { grid, velocity, temperature, settings, sources, .. } = self;
        if settings.vorticity_confinement > 0.0 {
            self.confinement.apply(grid, velocity, settings.vorticity_confinement, dt_s);
        }
        forces::buoyancy(grid, &mut velocity[1], temperature, settings.ambient_k, dt_s);
        if sources.has_acceleration {
            for (field, acceleration) in velocity.iter_mut().zip(&sources.acceleration) {
                forces::accelerate(grid, field, acceleration, dt_s);
            }
        }
        velocity.iter_mut().for_each(|field| forces::clamp_speed(grid, field));
        forces::push_wind(grid, velocity, settings.wind_m_s.to_array(), dt_s);
    }

    fn report(&mut self, dt_s: f32, projected: Projected) -> StepReport {
        let Self { grid, temperature, partials, .. } = self;
        let plane = grid.plane();
        let hottest = |k: usize| Partial {
            max: temperature.data[k * plane..(k + 1) * plane].iter().fold(0.0, |most, value| most.max(*value)),
            ..Partial::default()
        };
        let max_temperature_k = reduce(grid.is_parallel, &mut partials[..grid.cells[2]], hottest).max;
        let max_speed_m_s = projected.speeds.into_iter().fold(0.0, f32::max);
        self.max_speed_m_s = max_speed_m_s;
        let speed = max_speed_m_s.max(projected.speed_before);
        let relative = |rate: f32| if speed > 0.0 { rate * grid.shortest_m() / speed } else { 0.0 };
        let crossed = projected.speeds.into_iter().zip(grid.cell_m).map(|(speed, edge)| speed * dt_s / edge);
        StepReport {
            dt_s,
            pressure_residual: projected.residual,
            divergence_before: relative(projected.max_before),
            divergence_after: relative(projected.max_after),
            divergence_after_per_s: projected.max_after,
            max_speed_m_s,
            cfl: crossed.fold(0.0, f32::max),
            max_temperature_k,
        }
    }
}
