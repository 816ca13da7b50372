//! Setting up a fluid.

use std::sync::Arc;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::advect::{Advection, ScalarAdvection, Trace};
use crate::error::{FluidError, check, check_vec};
use crate::fluid::{Fluid, Settings};
use crate::frame::check_frame;
use crate::grid::Grid;
use crate::limits::{MAX_AXIS_CELLS, MAX_CELLS, MIN_AXIS_CELLS};
use crate::physics::Physics;
use crate::pressure::{PressureSolver, Tables};
use crate::scalars::Scalars;
use crate::scratch::Scratch;
use crate::sides::{Side, Sides};
use crate::simd::{Simd, SimdLevel};

const AXES: [&str; 3] = ["x", "y", "z"];

/// Describes a [`Fluid`]; [`FluidBuilder::build`] checks it all and makes it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[must_use]
pub struct FluidBuilder {
    pub(crate) cells: [usize; 3],
    pub(crate) origin: Vec3,
    pub(crate) size_m: Vec3,
    pub(crate) sides: Sides,
    pub(crate) wind_m_s: Vec3,
    pub(crate) frame_m_s: Vec3,
    pub(crate) viscosity_m2_s: f32,
    pub(crate) vorticity_confinement: f32,
    pub(crate) ambient_k: f32,
    pub(crate) cooling_per_s: f32,
    pub(crate) advection: Advection,
    pub(crate) trace: Trace,
    pub(crate) scalar_advection: ScalarAdvection,
    pub(crate) thermal_diffusivity_m2_s: f32,
    pub(crate) cfl_limit: Option<f32>,
    pub(crate) max_substeps: u32,
    pub(crate) pressure: PressureSolver,
    pub(crate) simd: SimdLevel,
    pub(crate) scalars: Scalars,
    pub(crate) physics: Physics,
}

impl Fluid {
    /// Starts the description of a box of `[nx, ny, nz]` cells: 2 to 512 an axis, or
    /// exactly 1 along one axis for a flow in a plane; 16.7 million in all. Unless said otherwise the box is 1 m along each edge, its low corner at zero, closed.
    pub fn builder(cells: [usize; 3]) -> FluidBuilder {
        FluidBuilder {
            cells,
            origin: Vec3::ZERO,
            size_m: Vec3::ONE,
            sides: Sides::CLOSED,
            wind_m_s: Vec3::ZERO,
            frame_m_s: Vec3::ZERO,
            viscosity_m2_s: 0.0,
            vorticity_confinement: 0.0,
            ambient_k: 293.15,
            cooling_per_s: 0.0,
            advection: Advection::default(),
            trace: Trace::default(),
            scalar_advection: ScalarAdvection::default(),
            thermal_diffusivity_m2_s: 0.0,
            cfl_limit: None,
            max_substeps: 32,
            pressure: PressureSolver::Direct,
            simd: SimdLevel::default(),
            scalars: Scalars::default(),
            physics: Physics::default(),
        }
    }
}

impl FluidBuilder {
    /// Low corner of the box, m; components within ±1e6. Default: zero.
    pub fn origin(mut self, origin: Vec3) -> Self {
        self.origin = origin;
        self
    }

    /// Edges of the box, m, so that cells have 1e-4 to 1e3 m an edge; they need not be cubes.
    /// Default: 1, 1, 1.
    pub fn size_m(mut self, size_m: Vec3) -> Self {
        self.size_m = size_m;
        self
    }

    /// What the six sides do. Default: [`Sides::CLOSED`].
    pub fn sides(mut self, sides: Sides) -> Self {
        self.sides = sides;
        self
    }

    /// Velocity of the air outside, m/s; components within ±100. The air in the box starts with
    /// it, as far as the sides allow. Default: zero.
    pub fn wind(mut self, wind_m_s: Vec3) -> Self {
        self.wind_m_s = wind_m_s;
        self
    }

    /// Kinematic viscosity, m²/s, 0 to 1e3; 1.5e-5 for air at room temperature, which few grids
    /// resolve. Raising it damps small eddies. Default: 0, which skips the work.
    pub fn viscosity_m2_s(mut self, viscosity_m2_s: f32) -> Self {
        self.viscosity_m2_s = viscosity_m2_s;
        self
    }

    /// Strength of vorticity confinement, 1/s, 0 to 100. Raising it livens small eddies; much
    /// of it makes noise. Default: 0, which skips the work.
    pub fn vorticity_confinement(mut self, per_s: f32) -> Self {
        self.vorticity_confinement = per_s;
        self
    }

    /// Temperature of the air around, K, 1 to 1e4: colder air makes the same heat rise faster.
    /// Default: 293.15.
    pub fn ambient_k(mut self, ambient_k: f32) -> Self {
        self.ambient_k = ambient_k;
        self
    }

    /// Share of the excess temperature lost per second, 1/s, 0 to 1e3. Default: 0.
    pub fn cooling_per_s(mut self, cooling_per_s: f32) -> Self {
        self.cooling_per_s = cooling_per_s;
        self
    }

    /// How the velocity carries itself. Default: [`Advection::MacCormack`].
    pub fn advection(mut self, advection: Advection) -> Self {
        self.advection = advection;
        self
    }

    /// How the way of the air is traced. Default: [`Trace::Midpoint`].
    pub fn trace(mut self, trace: Trace) -> Self {
        self.trace = trace;
        self
    }

    /// How temperature and scalars are carried. Default: [`ScalarAdvection::Flux`].
    pub fn scalar_advection(mut self, advection: ScalarAdvection) -> Self {
        self.scalar_advection = advection;
        self
    }

    /// Which vector instructions to use; the bits are the same. Default: [`SimdLevel::Best`].
    pub fn simd(mut self, simd: SimdLevel) -> Self {
        self.simd = simd;
        self
    }

    /// Velocity of the box itself, m/s, components within ±100; see
    /// [`Fluid::set_frame_velocity`]. Default: zero.
    pub fn frame_velocity(mut self, velocity_m_s: Vec3) -> Self {
        self.frame_m_s = velocity_m_s;
        self
    }

    /// Thermal diffusivity, m²/s, 0 to 1e3; see [`Fluid::set_thermal_diffusivity_m2_s`].
    /// Default: 0, which skips the work.
    pub fn thermal_diffusivity_m2_s(mut self, thermal_diffusivity_m2_s: f32) -> Self {
        self.thermal_diffusivity_m2_s = thermal_diffusivity_m2_s;
        self
    }

    /// Divides a step into equal parts, so that the Courant number of the velocity at its start
    /// stays below this, 0.01 to 1000, in each: 1 to 3 keeps what long steps lose. What is added
    /// acts over the whole step. Default: none, one part.
    pub fn cfl_limit(mut self, cfl: Option<f32>) -> Self {
        self.cfl_limit = cfl;
        self
    }

    /// Most parts into which a step is divided, 1 to 1000. Default: 32.
    pub fn max_substeps(mut self, parts: u32) -> Self {
        self.max_substeps = parts;
        self
    }

    /// How the pressure is found. Default: [`PressureSolver::Direct`].
    pub fn pressure(mut self, pressure: PressureSolver) -> Self {
        self.pressure = pressure;
        self
    }

    /// Adds a named scalar that the air carries, up to 64 of them, such as soot; what comes in
    /// from outside has none of it. Find it by [`Fluid::scalar_id`]. Default: none.
    pub fn scalar(self, name: impl Into<String>) -> Self {
        self.scalar_with_outside(name, 0.0)
    }

    /// As [`FluidBuilder::scalar`], with the value (within ±1e6) that the box starts with and that
    /// comes in from outside, such as 0.23 for the mass fraction of oxygen.
    pub fn scalar_with_outside(mut self, name: impl Into<String>, outside: f32) -> Self {
        self.scalars.add(name.into(), outside);
        self
    }

    /// Makes the fluid: checks everything, then takes all the memory that its steps will use.
    ///
    /// # Errors
    /// Cell counts, lengths or settings outside their ranges; inflow without an outlet; names of
    /// scalars that are empty or the same.
    pub fn build(self) -> Result<Fluid, FluidError> {
        let (grid, settings) = self.checked()?;
        Ok(Fluid::new(grid, self.sides, settings, self.pressure, self.scalars))
    }

    /// Makes a box of a batch: it shares tables, and has no arrays of its own to step in.
    pub(crate) fn build_in_batch(self, tables: &Arc<Tables>, scratch: &mut Scratch) -> Result<Fluid, FluidError> {
        let (grid, settings) = self.checked()?;
        let mut fluid = Fluid::unsettled(grid, self.sides, settings, self.pressure, self.scalars, Arc::clone(tables));
        fluid.reset_with(scratch);
        Ok(fluid)
    }

    /// Whether a fluid of the other description has the same tables and arrays of the same sizes.
    pub(crate) fn is_same_shape(&self, other: &Self) -> bool {
        (self.cells, self.size_m, self.sides, self.pressure) == (other.cells, other.size_m, other.sides, other.pressure)
            && self.scalars.names == other.scalars.names
    }

    /// Checks everything.
    pub(crate) fn checked(&self) -> Result<(Grid, Settings), FluidError> {
        check_counts(self.cells, self.sides)?;
        let cells = self.cells.iter().product();
        if cells > MAX_CELLS {
            return Err(FluidError::TooManyCells { cells });
        }
        check_vec("origin", self.origin, 1.0e6, "components within ±1e6 m")?;
        for (size, cells) in self.size_m.to_array().into_iter().zip(self.cells) {
            let cells = cells as f32;
            check("size_m", size, 1.0e-4 * cells, 1.0e3 * cells, "cells of 1e-4 to 1e3 m an edge")?;
        }
        check_outlet(self.sides)?;
        let settings = Settings {
            wind_m_s: check_wind(self.wind_m_s)?,
            frame_m_s: check_frame(self.frame_m_s, self.cells)?,
            viscosity_m2_s: check_viscosity(self.viscosity_m2_s)?,
            vorticity_confinement: check_confinement(self.vorticity_confinement)?,
            ambient_k: check_ambient(self.ambient_k)?,
            cooling_per_s: check_cooling(self.cooling_per_s)?,
            advection: self.advection,
            trace: self.trace,
            scalar_advection: self.scalar_advection,
            thermal_diffusivity_m2_s: check_thermal_diffusivity(self.thermal_diffusivity_m2_s)?,
            cfl_limit: check_cfl_limit(self.cfl_limit)?,
            max_substeps: check_max_substeps(self.max_substeps)?,
            physics: self.physics,
        };
        if let PressureSolver::GaussSeidel { sweeps } = self.pressure {
            check("pressure sweeps", sweeps as f32, 1.0, 1.0e4, "1 to 10000")?;
        }
        self.scalars.check()?;
        let mut grid = Grid::new(self.cells, self.origin, self.size_m, self.sides.by_axis());
        grid.exec.simd = Simd::of(self.simd);
        self.physics.check(&grid, &self.scalars, self.scalar_advection)?;
        Ok((grid, settings))
    }
}

/// Two cells or more along each axis, or exactly one along one of them: a flow in a plane.
fn check_counts(cells: [usize; 3], sides: Sides) -> Result<(), FluidError> {
    let flat_axes = cells.into_iter().filter(|cells| *cells == 1).count();
    for ((axis, cells), sides) in AXES.into_iter().zip(cells).zip(sides.by_axis()) {
        let is_flat = cells == 1 && flat_axes == 1;
        if !is_flat && !(MIN_AXIS_CELLS..=MAX_AXIS_CELLS).contains(&cells) {
            return Err(FluidError::AxisCells { axis, cells });
        }
        if is_flat && sides != [Side::FreeSlip; 2] {
            return Err(FluidError::FlatSides { axis });
        }
        if (sides[0] == Side::Periodic) != (sides[1] == Side::Periodic) {
            return Err(FluidError::HalfPeriodic { axis });
        }
    }
    Ok(())
}

/// One inflow side without an opposite one needs an open side, or air would have to vanish.
fn check_outlet(sides: Sides) -> Result<(), FluidError> {
    let sides = sides.by_axis();
    if sides.iter().flatten().any(|side| *side == Side::Open) {
        return Ok(());
    }
    for (axis, ends) in AXES.into_iter().zip(sides) {
        if (ends[0] == Side::Inflow) != (ends[1] == Side::Inflow) {
            return Err(FluidError::NoOutlet { axis });
        }
    }
    Ok(())
}

pub(crate) fn check_wind(value: Vec3) -> Result<Vec3, FluidError> {
    check_vec("wind", value, 100.0, "components within ±100 m/s")
}

pub(crate) fn check_viscosity(value: f32) -> Result<f32, FluidError> {
    check("viscosity_m2_s", value, 0.0, 1.0e3, "0 to 1e3 m²/s")
}

pub(crate) fn check_confinement(value: f32) -> Result<f32, FluidError> {
    check("vorticity_confinement", value, 0.0, 100.0, "0 to 100 1/s")
}

pub(crate) fn check_ambient(value: f32) -> Result<f32, FluidError> {
    check("ambient_k", value, 1.0, 1.0e4, "1 to 1e4 K")
}

pub(crate) fn check_cooling(value: f32) -> Result<f32, FluidError> {
    check("cooling_per_s", value, 0.0, 1.0e3, "0 to 1e3 1/s")
}

pub(crate) fn check_thermal_diffusivity(value: f32) -> Result<f32, FluidError> {
    check("thermal_diffusivity_m2_s", value, 0.0, 1.0e3, "0 to 1e3 m²/s")
}

pub(crate) fn check_cfl_limit(value: Option<f32>) -> Result<Option<f32>, FluidError> {
    value.map(|value| check("cfl_limit", value, 0.01, 1.0e3, "0.01 to 1000")).transpose()
}

pub(crate) fn check_max_substeps(value: u32) -> Result<u32, FluidError> {
    check("max_substeps", value as f32, 1.0, 1.0e3, "1 to 1000").map(|_| value)
}
