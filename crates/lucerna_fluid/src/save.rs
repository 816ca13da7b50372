//! Saving a fluid and loading it again.

mod bytes;
mod check;

use serde::{Deserialize, Serialize};

use crate::builder::FluidBuilder;
use crate::error::FluidError;
use crate::fluid::{Fluid, Settings, Sources, State};
use crate::grid::Grid;
use crate::obstacle::{SavedSolids, Solids};
use crate::sides::GivenSides;
use crate::source::{Placed, SavedSources};

/// Version of what is saved; rises whenever that changes.
const VERSION: u32 = 2;

/// All that makes a fluid go on as it would have: its description, its state, and what has been
/// added for the coming step. Made by [`Fluid::save`]; read by [`Fluid::load`] and
/// [`Fluid::restore`].
///
/// It is plain data, to be written in any format that serde knows, or compactly by
/// [`Snapshot::to_bytes`]. What is read is not trusted: loading checks all of it.
///
/// ```
/// use lucerna_fluid::{Fluid, Snapshot, Vec3};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut fluid = Fluid::builder([8; 3]).build()?;
/// fluid.add_heat(Vec3::splat(0.5), 0.3, 1000.0)?;
/// let bytes = fluid.save().to_bytes();
/// let mut again = Fluid::load(&Snapshot::from_bytes(&bytes)?)?;
/// fluid.step(0.1)?;
/// again.step(0.1)?;
/// assert_eq!(fluid.state_hash(), again.state_hash());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    version: u32,
    setup: FluidBuilder,
    given: GivenSides,
    solids: Option<SavedSolids>,
    state: SavedState,
    pending: Pending,
}

/// Arrays as in [`crate::fluid::State`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct SavedState {
    velocity: [Vec<f32>; 3],
    temperature: Vec<f32>,
    packs: Vec<Vec<[f32; 4]>>,
    potential: Vec<f32>,
    /// Empty unless density varies.
    pressure: Vec<f32>,
    max_speed_m_s: f32,
}

/// What was added for the coming step; empty where nothing was.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Pending {
    acceleration: [Vec<f32>; 3],
    heat: Vec<f32>,
    expansion: Vec<f32>,
    /// One for each scalar, or none at all.
    scalars: Vec<Vec<f32>>,
    placed: SavedSources,
}

/// Why a saved fluid was refused. Nothing has changed then.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The bytes do not start as a saved fluid does, or end before its header does.
    #[error("this is not a saved fluid")]
    NotASnapshot,
    /// It was saved by a version whose layout this one does not know.
    #[error("the fluid was saved in version {found}; known: {VERSION}")]
    Version {
        /// The version that it says.
        found: u32,
    },
    /// The bytes are not those that were saved.
    #[error("the saved fluid is damaged: its checksum does not fit")]
    Checksum,
    /// The bytes cannot be read as a saved fluid.
    #[error("the saved fluid is cut short or malformed")]
    Malformed,
    /// An array has another length than the cells ask for.
    #[error("{field} has {found} values; allowed: {expected}")]
    Length {
        /// Which array.
        field: &'static str,
        /// Its length.
        found: usize,
        /// What it has to be.
        expected: usize,
    },
    /// A number in an array is not finite or out of its range.
    #[error("value {index} of {field} is {value}; allowed: within ±{most}")]
    Value {
        /// Which array.
        field: &'static str,
        /// Which of its values.
        index: usize,
        /// What it is.
        value: f32,
        /// The greatest magnitude allowed.
        most: f32,
    },
    /// The description of the fluid is refused.
    #[error("the saved description is refused: {0}")]
    Setup(#[from] FluidError),
    /// It is of another shape than the fluid that it was to be restored to.
    #[error("the saved fluid has another shape; allowed: the same cells, size, sides, pressure solver and scalars")]
    Shape,
}

impl Fluid {
    /// The description that would make a fluid with the present settings.
    pub(crate) fn setup(&self) -> FluidBuilder {
        // Every field by name: a new one is not to be forgotten.
        let Settings {
            wind_m_s,
            frame_m_s,
            viscosity_m2_s,
            vorticity_confinement,
            ambient_k,
            cooling_per_s,
            thermal_diffusivity_m2_s,
            cfl_limit,
            max_substeps,
            advection,
            trace,
            scalar_advection,
            physics,
        } = self.settings;
        FluidBuilder {
            cells: self.grid.cells,
            origin: self.grid.origin,
            size_m: self.grid.size_m,
            sides: self.sides,
            wind_m_s,
            frame_m_s,
            viscosity_m2_s,
            vorticity_confinement,
            ambient_k,
            cooling_per_s,
            thermal_diffusivity_m2_s,
            cfl_limit,
            max_substeps,
            advection,
            trace,
            scalar_advection,
            pressure: self.pressure,
            simd: self.grid.exec.simd.level(),
            scalars: self.scalars.clone(),
            physics,
        }
    }

    /// A copy of all that makes this fluid go on as it would. Obstacles are saved as the cells
    /// that they cover. Allocates 20 bytes a cell, 4 for each scalar, and what was added for the
    /// coming step.
    #[must_use]
    pub fn save(&self) -> Snapshot {
        let State { velocity, temperature, packs, potential, pressure } = &self.state;
        let Sources {
            acceleration,
            has_acceleration,
            heat,
            has_heat,
            expansion,
            has_expansion,
            scalars,
            has_scalars,
            placed,
        } = &self.sources;
        let when = |is_there: &bool, values: &Vec<f32>| if *is_there { values.clone() } else { Vec::new() };
        Snapshot {
            version: VERSION,
            setup: self.setup(),
            given: self.given.clone(),
            solids: self.solids.as_ref().map(|solids| solids.saved()),
            state: SavedState {
                velocity: velocity.each_ref().map(|field| field.data.clone()),
                temperature: temperature.data.clone(),
                packs: packs.clone(),
                potential: potential.clone(),
                pressure: pressure.clone(),
                max_speed_m_s: self.max_speed_m_s,
            },
            pending: Pending {
                acceleration: [0, 1, 2].map(|axis| when(&has_acceleration[axis], &acceleration[axis])),
                heat: when(has_heat, heat),
                expansion: when(has_expansion, expansion),
                scalars: if *has_scalars { scalars.clone() } else { Vec::new() },
                placed: placed.saved(),
            },
        }
    }

    /// Makes the fluid that was saved: every step from here on gives the same bits as if it had
    /// never been stopped.
    ///
    /// # Errors
    /// A version that is not known, a description that [`FluidBuilder::build`] would refuse,
    /// arrays of other lengths than the cells ask for, and numbers that are not finite or out of
    /// their ranges. All of that is looked at before memory is taken for the fluid.
    pub fn load(snapshot: &Snapshot) -> Result<Self, SnapshotError> {
        snapshot.check()?;
        let mut fluid = snapshot.setup.clone().build()?;
        let placed = Placed::from_saved(&snapshot.pending.placed, &fluid.grid, &fluid.scalars)?;
        snapshot.copy_into(&mut fluid, placed);
        Ok(fluid)
    }

    /// Goes back to what was saved from this fluid or from one of the same shape: the same
    /// counts of cells, size, sides, pressure solver and scalars. As [`Fluid::load`], but keeps the
    /// tables and arrays, and so also works for a box of a [`crate::FluidBatch`].
    ///
    /// # Errors
    /// As [`Fluid::load`], and another shape; nothing has changed then.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), SnapshotError> {
        if !snapshot.setup.is_same_shape(&self.setup()) {
            return Err(SnapshotError::Shape);
        }
        let settings = snapshot.check()?;
        let grid = Grid { origin: snapshot.setup.origin, ..self.grid.clone() };
        let placed = Placed::from_saved(&snapshot.pending.placed, &grid, &self.scalars)?;
        self.grid = grid;
        self.settings = settings;
        self.scalars.clone_from(&snapshot.setup.scalars);
        snapshot.copy_into(self, placed);
        Ok(())
    }
}

impl Snapshot {
    /// Copies arrays that have been checked into a fluid of their shape.
    fn copy_into(&self, fluid: &mut Fluid, placed: Placed) {
        let SavedState { velocity, temperature, packs, potential, pressure, max_speed_m_s } = &self.state;
        for (field, saved) in fluid.state.velocity.iter_mut().zip(velocity) {
            field.data.copy_from_slice(saved);
        }
        fluid.state.temperature.data.copy_from_slice(temperature);
        fluid.state.packs.clone_from(packs);
        fluid.state.potential.copy_from_slice(potential);
        fluid.state.pressure.clone_from(pressure);
        fluid.max_speed_m_s = *max_speed_m_s;
        fluid.given.clone_from(&self.given);
        fluid.solids = self.solids.as_ref().map(|solids| Box::new(Solids::from_saved(solids, &fluid.grid)));
        let Pending { acceleration, heat, expansion, scalars, placed: _ } = self.pending.clone();
        fluid.sources = Sources {
            has_acceleration: acceleration.each_ref().map(|values| !values.is_empty()),
            acceleration,
            has_heat: !heat.is_empty(),
            heat,
            has_expansion: !expansion.is_empty(),
            expansion,
            has_scalars: !scalars.is_empty(),
            scalars,
            placed,
        };
    }
}
