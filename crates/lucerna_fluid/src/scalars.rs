//! Named quantities that the air carries besides its temperature: soot, fuel, oxygen, dye.
//!
//! They are packed four to a cell, so that one way back and eight loads of 16 bytes move four of
//! them. What a value means is the caller's business; for transport it is an amount per volume
//! of air (or a mass fraction, which is the same thing where the density is constant).

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::error::{FluidError, check};
use crate::field::Around;
use crate::fluid::Fluid;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::source::{add_ball, check_ball, fill};

/// Most scalars that a fluid carries.
pub const MAX_SCALARS: usize = 64;

/// Greatest magnitude of a scalar; sources are clamped to it.
pub const MAX_SCALAR: f32 = 1.0e6;

/// Greatest rate at which a scalar's sources change it, per second.
pub(crate) const MAX_SCALAR_RATE: f32 = 1.0e7;

/// Scalars in a pack.
pub(crate) const PACK: usize = 4;

/// Values of four scalars, x fastest, then y, then z.
pub(crate) type Pack = Vec<[f32; PACK]>;

/// One of the scalars of a fluid, found by [`Fluid::scalar_id`]. It means the same in every fluid
/// built with the same names in the same order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct ScalarId(usize);

impl ScalarId {
    /// The pack it is in, and where in it.
    pub(crate) fn slot(self) -> (usize, usize) {
        Self::slot_of(self.0)
    }

    /// The same for an index.
    pub(crate) fn slot_of(index: usize) -> (usize, usize) {
        (index / PACK, index % PACK)
    }
}

/// What the scalars of a fluid are called, and what comes in with the wind.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Scalars {
    pub(crate) names: Vec<String>,
    pub(crate) outside: Vec<f32>,
}

impl Scalars {
    pub(crate) fn add(&mut self, name: String, outside: f32) {
        self.names.push(name);
        self.outside.push(outside);
    }

    pub(crate) fn check(&self) -> Result<(), FluidError> {
        if self.names.len() > MAX_SCALARS {
            return Err(FluidError::TooManyScalars { count: self.names.len() });
        }
        for (index, name) in self.names.iter().enumerate() {
            if name.is_empty() {
                return Err(FluidError::ScalarName { index, problem: "empty" });
            }
            if self.names[..index].contains(name) {
                return Err(FluidError::ScalarName { index, problem: "taken by one before it" });
            }
        }
        self.outside.iter().try_for_each(|value| check_value(*value))
    }

    /// Number of packs that hold them all.
    pub(crate) fn packs(&self) -> usize {
        self.names.len().div_ceil(PACK)
    }

    /// The outside's values for one pack; zero for what it has no scalar for.
    pub(crate) fn outside(&self, pack: usize) -> [f32; PACK] {
        std::array::from_fn(|at| self.outside.get(PACK * pack + at).copied().unwrap_or(0.0))
    }

    /// Refuses an id that another fluid gave out.
    pub(crate) fn known(&self, id: ScalarId) -> Result<usize, FluidError> {
        let count = self.names.len();
        if id.0 < count { Ok(id.0) } else { Err(FluidError::UnknownScalar { index: id.0, count }) }
    }
}

/// Adds the rates (per second, by scalar and cell; empty: none), and clamps.
pub(crate) fn feed(grid: &Grid, packs: &mut [Pack], rates: &[Vec<f32>], dt_s: f32) {
    let plane = grid.plane();
    for (index, rates) in rates.iter().enumerate() {
        if rates.is_empty() {
            continue;
        }
        let at = index % PACK;
        for_planes(
            grid.exec,
            &mut packs[index / PACK],
            plane,
            #[inline(always)]
            |k, out| {
                for (values, rate) in out.iter_mut().zip(&rates[k * plane..]) {
                    values[at] = (values[at] + dt_s * rate).clamp(-MAX_SCALAR, MAX_SCALAR);
                }
            },
        );
    }
}

impl Fluid {
    /// The scalar of that name, given to the builder by [`crate::FluidBuilder::scalar`].
    #[must_use]
    pub fn scalar_id(&self, name: &str) -> Option<ScalarId> {
        self.scalars.names.iter().position(|known| known == name).map(ScalarId)
    }

    /// Names of the scalars, in the order in which the builder got them.
    pub fn scalar_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.scalars.names.iter().map(String::as_str)
    }

    /// A scalar at a point, trilinear between the cells' centres. Outside the box, the value at
    /// the nearest place inside, along periodic axes the box repeated; zero for an id that this fluid does not know.
    #[must_use]
    pub fn scalar(&self, id: ScalarId, point: Vec3) -> f32 {
        let (pack, at) = id.slot();
        let Some(pack) = self.state.packs.get(pack) else { return 0.0 };
        let [nx, ny, _] = self.grid.cells;
        let place = self.grid.cells_from_point(point).map(|place| place - 0.5);
        let around = Around::new(place, self.grid.cells, self.grid.periods());
        around.blend(|[i, j, k]| pack[i + nx * (j + ny * k)][at])
    }

    /// A scalar by cell, x fastest; nothing for an id that this fluid does not know.
    pub fn scalar_values(&self, id: ScalarId) -> impl Iterator<Item = f32> {
        let (pack, at) = id.slot();
        self.state.packs.get(pack).into_iter().flatten().map(move |values| values[at])
    }

    /// A scalar's sum over the cells times the volume of a cell, m³ times the scalar's unit.
    #[must_use]
    pub fn scalar_total(&self, id: ScalarId) -> f64 {
        let volume: f64 = self.grid.cell_m.iter().map(|edge| f64::from(*edge)).product();
        volume * self.scalar_values(id).map(f64::from).sum::<f64>()
    }

    /// Sets a scalar everywhere (within ±1e6), from its value at the centre of each cell.
    ///
    /// # Errors
    /// A value that is not finite or out of range, or an unknown scalar; nothing has changed then.
    pub fn fill_scalar(&mut self, id: ScalarId, value: impl Fn(Vec3) -> f32) -> Result<(), FluidError> {
        self.scalars.known(id)?;
        let (pack, at) = id.slot();
        self.with_scratch(|fluid, scratch| {
            let checked = |point| {
                let value = value(point);
                check_value(value).map(|()| value)
            };
            fill(&fluid.grid, &mut scratch.next_temperature, checked)?;
            for (values, value) in fluid.state.packs[pack].iter_mut().zip(&scratch.next_temperature.data) {
                values[at] = *value;
            }
            Ok(())
        })
    }

    /// Adds to a scalar in a smooth ball during the coming step: `rate_per_s` (within ±1e6) at
    /// its centre, falling as in [`Fluid::add_heat`].
    ///
    /// # Errors
    /// A value that is not finite or out of range, or an unknown scalar; nothing has changed then.
    pub fn add_scalar(&mut self, id: ScalarId, point: Vec3, radius_m: f32, rate_per_s: f32) -> Result<(), FluidError> {
        let index = self.scalars.known(id)?;
        check_ball(point, radius_m)?;
        let rate = check("rate_per_s", rate_per_s, -1.0e6, 1.0e6, "within ±1e6 per s")?;
        let sources = &mut self.sources;
        sources.scalars.resize(self.scalars.names.len(), Vec::new());
        let rates = &mut sources.scalars[index];
        rates.resize(self.grid.count(), 0.0);
        add_ball(&self.grid, rates, point, radius_m, rate, MAX_SCALAR_RATE);
        sources.has_scalars = true;
        Ok(())
    }

    /// What comes in from outside, within ±1e6. What is in the box stays.
    ///
    /// # Errors
    /// A value that is not finite or out of range, or an unknown scalar; nothing has changed then.
    pub fn set_scalar_outside(&mut self, id: ScalarId, value: f32) -> Result<(), FluidError> {
        let index = self.scalars.known(id)?;
        check_value(value)?;
        self.scalars.outside[index] = value;
        Ok(())
    }
}

fn check_value(value: f32) -> Result<(), FluidError> {
    check("scalar", value, -MAX_SCALAR, MAX_SCALAR, "within ±1e6").map(|_| ())
}
