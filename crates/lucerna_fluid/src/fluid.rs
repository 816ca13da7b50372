//! The fluid: what it is made of, and how it starts.

use std::sync::Arc;

use glam::Vec3;

use crate::advect::{Advection, ScalarAdvection, Trace};
use crate::error::{FluidError, check};
use crate::field::Field;
use crate::grid::Grid;
use crate::limits::MAX_DT_S;
use crate::obstacle::Solids;
use crate::physics::Physics;
use crate::pressure::{PressureSolver, Projected, Projection, Tables};
use crate::report::StepReport;
use crate::scalars::{Pack, Scalars};
use crate::scratch::Scratch;
use crate::sides::{GivenSides, Sides, Walls, fix_sides};
use crate::source::Placed;

/// What may change while the fluid runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Settings {
    pub(crate) wind_m_s: Vec3,
    /// Velocity of the box.
    pub(crate) frame_m_s: Vec3,
    pub(crate) viscosity_m2_s: f32,
    pub(crate) vorticity_confinement: f32,
    pub(crate) ambient_k: f32,
    pub(crate) cooling_per_s: f32,
    pub(crate) thermal_diffusivity_m2_s: f32,
    pub(crate) advection: Advection,
    pub(crate) trace: Trace,
    pub(crate) scalar_advection: ScalarAdvection,
    pub(crate) cfl_limit: Option<f32>,
    pub(crate) max_substeps: u32,
    pub(crate) physics: Physics,
}

/// What time changes.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// Velocity through the faces across x, y and z, m/s.
    pub(crate) velocity: [Field; 3],
    /// Temperature above ambient at the centres, K.
    pub(crate) temperature: Field,
    /// Named scalars at the centres, four to a pack.
    pub(crate) packs: Vec<Pack>,
    /// Velocity potential of the last projection, m²/s.
    pub(crate) potential: Vec<f32>,
    /// Pressure over ambient density of the last step, m²/s²; empty unless density varies.
    pub(crate) pressure: Vec<f32>,
}

/// What was added for the coming step, and whether there is any of it. An array is empty until
/// it is first used.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sources {
    pub(crate) acceleration: [Vec<f32>; 3],
    /// By axis.
    pub(crate) has_acceleration: [bool; 3],
    /// K/s, by cell.
    pub(crate) heat: Vec<f32>,
    pub(crate) has_heat: bool,
    /// 1/s, by cell.
    pub(crate) expansion: Vec<f32>,
    pub(crate) has_expansion: bool,
    /// 1/s, by scalar and cell; without scalars, or for one without a source, empty.
    pub(crate) scalars: Vec<Vec<f32>>,
    pub(crate) has_scalars: bool,
    pub(crate) placed: Placed,
}

impl Sources {
    pub(crate) fn clear(&mut self) {
        self.placed.clear();
        for (values, is_there) in self.acceleration.iter_mut().zip(&mut self.has_acceleration) {
            if std::mem::take(is_there) {
                values.fill(0.0);
            }
        }
        if std::mem::take(&mut self.has_heat) {
            self.heat.fill(0.0);
        }
        if std::mem::take(&mut self.has_expansion) {
            self.expansion.fill(0.0);
        }
        if std::mem::take(&mut self.has_scalars) {
            self.scalars.iter_mut().for_each(|values| values.fill(0.0));
        }
    }
}

/// Air in a box. See the [crate's page](crate) for an example and the order of values.
pub struct Fluid {
    pub(crate) grid: Grid,
    pub(crate) sides: Sides,
    pub(crate) settings: Settings,
    pub(crate) scalars: Scalars,
    pub(crate) pressure: PressureSolver,
    /// Tables of the pressure solver; fluids of a batch share them.
    pub(crate) tables: Arc<Tables>,
    pub(crate) state: State,
    pub(crate) sources: Sources,
    /// Velocities and temperatures given for sides.
    pub(crate) given: GivenSides,
    /// Obstacles; none where there are none.
    pub(crate) solids: Option<Box<Solids>>,
    pub(crate) max_speed_m_s: f32,
    /// Arrays that only a step uses. Fluids of a batch borrow those of their worker instead.
    pub(crate) scratch: Option<Box<Scratch>>,
}

impl Fluid {
    /// At rest or with the wind, with tables and scratch arrays of its own.
    pub(crate) fn new(
        grid: Grid,
        sides: Sides,
        settings: Settings,
        pressure: PressureSolver,
        scalars: Scalars,
    ) -> Self {
        let tables = Arc::new(Tables::new(&grid, pressure));
        let scratch = Box::new(Scratch::new(&grid));
        let mut fluid = Self::unsettled(grid, sides, settings, pressure, scalars, tables);
        fluid.scratch = Some(scratch);
        fluid.reset();
        fluid
    }

    /// All zero, without scratch arrays.
    pub(crate) fn unsettled(
        grid: Grid,
        sides: Sides,
        settings: Settings,
        pressure: PressureSolver,
        scalars: Scalars,
        tables: Arc<Tables>,
    ) -> Self {
        Self {
            sides,
            settings,
            pressure,
            tables,
            state: State {
                velocity: std::array::from_fn(|axis| Field::on_faces(&grid, axis)),
                temperature: Field::at_centres(&grid),
                packs: vec![vec![[0.0; 4]; grid.count()]; scalars.packs()],
                potential: vec![0.0; grid.count()],
                pressure: Vec::new(),
            },
            sources: Sources::default(),
            given: GivenSides::default(),
            solids: None,
            max_speed_m_s: 0.0,
            scratch: None,
            scalars,
            grid,
        }
    }

    /// Back to the start: ambient temperature, scalars as outside, the air moving with the wind
    /// as far as the sides allow, nothing added. Settings stay.
    pub fn reset(&mut self) {
        self.with_scratch(Self::reset_with);
    }

    /// As [`Fluid::reset`], in arrays that fit.
    pub(crate) fn reset_with(&mut self, scratch: &mut Scratch) {
        self.state.temperature.data.fill(0.0);
        for (index, pack) in self.state.packs.iter_mut().enumerate() {
            pack.fill(self.scalars.outside(index));
        }
        self.state.potential.fill(0.0);
        self.state.pressure.clear();
        self.sources.clear();
        for (field, wind) in self.state.velocity.iter_mut().zip(self.settings.wind_m_s.to_array()) {
            field.data.fill(wind);
        }
        self.settle(scratch);
    }

    /// Makes the present velocity obey the sides, and free of divergence.
    pub(crate) fn settle(&mut self, scratch: &mut Scratch) -> Projected {
        fix_sides(&self.grid, &mut self.state.velocity, Walls::of(&self.settings, &self.given, self.solids.as_deref()));
        let projected = self.project(scratch, false);
        self.max_speed_m_s = projected.speeds.into_iter().fold(0.0, f32::max);
        projected
    }

    /// Subtracts the gradient that leaves the divergence asked for.
    pub(crate) fn project(&mut self, scratch: &mut Scratch, with_expansion: bool) -> Projected {
        let expansion = with_expansion.then_some(scratch.expansion.as_slice());
        let mut projection = Projection {
            grid: &self.grid,
            tables: &self.tables,
            mask: self.solids.as_ref().map(|solids| solids.mask()),
            spare: &mut scratch.pressure,
        };
        projection.project(&mut self.state.velocity, expansion, &mut self.state.potential)
    }

    /// Calls `work` with the fluid's own scratch arrays; one that has none, in a batch, makes
    /// them for this call.
    pub(crate) fn with_scratch<R>(&mut self, work: impl FnOnce(&mut Self, &mut Scratch) -> R) -> R {
        let Some(mut scratch) = self.scratch.take() else {
            return work(self, &mut Scratch::new(&self.grid));
        };
        let result = work(self, &mut scratch);
        self.scratch = Some(scratch);
        result
    }

    /// Advances by `dt_s` seconds, above 0 and up to 1e3, and uses up what was added since the
    /// last step. Any such step is stable; for accuracy keep [`StepReport::cfl`] below about 3, or let
    /// [`crate::FluidBuilder::cfl_limit`] divide the step.
    ///
    /// # Errors
    /// A length of step out of its range; nothing has changed then.
    pub fn step(&mut self, dt_s: f32) -> Result<StepReport, FluidError> {
        check_dt(dt_s)?;
        Ok(self.with_scratch(|fluid, scratch| fluid.step_with(scratch, dt_s)))
    }

    /// A step of a length that is in its range, in arrays that fit.
    pub(crate) fn step_with(&mut self, scratch: &mut Scratch, dt_s: f32) -> StepReport {
        if self.grid.exec.is_parallel {
            // Enter the thread pool once, not once for each pass over the planes.
            rayon::scope(|_| self.advance_in_parts(scratch, dt_s))
        } else {
            self.advance_in_parts(scratch, dt_s)
        }
    }
}

pub(crate) fn check_dt(dt_s: f32) -> Result<f32, FluidError> {
    check("dt_s", dt_s, f32::MIN_POSITIVE, MAX_DT_S, "above 0, up to 1e3 s")
}
