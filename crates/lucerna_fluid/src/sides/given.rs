//! Velocities and temperatures that a caller gives for a side.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::builder::check_thermal_diffusivity;
use crate::error::{FluidError, check, check_vec};
use crate::fluid::{Fluid, Settings};
use crate::grid::Grid;
use crate::limits::MAX_TEMPERATURE_K;
use crate::obstacle::Solids;
use crate::sides::{Side, SideAt};

/// The values of one side, by component: where the component's lines of values meet the side,
/// counted along the two other axes, the faster one first.
type SideValues = [Vec<f32>; 3];

/// What was given, by axis and end; nothing for a side that only follows the wind or stands still.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct GivenSides {
    velocity: [[Option<Box<SideValues>>; 2]; 3],
    /// Temperature above ambient, K; insulated where there is none.
    pub(crate) temperature_k: [[Option<f32>; 2]; 3],
}

/// The velocity of one component on one side.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Wall<'a> {
    Same(f32),
    Each(&'a [f32]),
}

impl Wall<'_> {
    /// The part of a row or plane of lines that starts at `first`.
    #[inline(always)]
    pub(crate) fn part(self, first: usize, count: usize) -> Self {
        match self {
            Self::Same(_) => self,
            Self::Each(values) => Wall::Each(&values[first..first + count]),
        }
    }
}

/// What comes in where inflow sides were given it: one component, by axis and end, on a lattice
/// of these counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Profile<'a> {
    by_side: [[Option<&'a [f32]>; 2]; 3],
    counts: [usize; 3],
}

impl Profile<'_> {
    /// What comes from a place beyond the lattice: the nearest value of the side that is
    /// farthest behind it, if it was given any.
    pub(crate) fn value(&self, at: [f32; 3]) -> Option<f32> {
        let mut farthest = (0.0, None);
        for (axis, (at, count)) in at.into_iter().zip(self.counts).enumerate() {
            for (end, beyond) in [-at, at - (count - 1) as f32].into_iter().enumerate() {
                if beyond > farthest.0 {
                    farthest = (beyond, Some((axis, end)));
                }
            }
        }
        let (axis, end) = farthest.1?;
        let values = self.by_side[axis][end]?;
        let [first, second] = [[1, 2], [0, 2], [0, 1]][axis];
        // The conversion saturates at zero.
        let nearest = |axis: usize| ((at[axis] + 0.5) as usize).min(self.counts[axis] - 1);
        values.get(nearest(first) + self.counts[first] * nearest(second)).copied()
    }
}

impl GivenSides {
    /// What comes in of a velocity component; none where all of it is the wind's.
    pub(crate) fn profile(&self, grid: &Grid, component: usize) -> Option<Profile<'_>> {
        let by_side = [0, 1, 2].map(|axis| {
            [0, 1].map(|end| {
                let given = self.velocity[axis][end].as_ref().filter(|_| grid.sides[axis][end] == Side::Inflow);
                given.map(|values| values[component].as_slice())
            })
        });
        let counts = grid.face_counts(component);
        by_side.iter().flatten().any(Option::is_some).then_some(Profile { by_side, counts })
    }
}

/// What moves at the sides, and within.
#[derive(Clone, Copy)]
pub(crate) struct Walls<'a> {
    pub(crate) wind: [f32; 3],
    /// Velocity of the grid, with which walls move.
    pub(crate) frame: [f32; 3],
    pub(crate) given: &'a GivenSides,
    pub(crate) solids: Option<&'a Solids>,
}

impl<'a> Walls<'a> {
    pub(crate) fn of(settings: &Settings, given: &'a GivenSides, solids: Option<&'a Solids>) -> Self {
        Self { wind: settings.wind_m_s.to_array(), frame: settings.frame_m_s.to_array(), given, solids }
    }

    /// The velocity component on a side that is a wall or an inflow.
    pub(crate) fn at(&self, grid: &Grid, axis: usize, end: usize, component: usize) -> Wall<'a> {
        let given = self.given.velocity[axis][end].as_ref().map(|values| values[component].as_slice());
        match (grid.sides[axis][end], given) {
            (Side::Inflow, None) => Wall::Same(self.wind[component]),
            (Side::Inflow, Some(values)) => Wall::Each(values),
            (Side::NoSlip, Some(values)) if component != axis => Wall::Each(values),
            _ => Wall::Same(self.frame[component]),
        }
    }

    /// Whether what enters may not be what leaves.
    pub(crate) fn may_be_uneven(&self) -> bool {
        self.frame != [0.0; 3] || self.given.velocity.iter().flatten().any(Option::is_some)
    }
}

impl GivenSides {
    /// Refuses what the setters would have refused.
    pub(crate) fn check(&self, grid: &Grid) -> Result<(), FluidError> {
        for side in SideAt::ALL {
            let (axis, end) = side.axis_and_end();
            if let Some(kelvin) = self.temperature_k[axis][end] {
                if grid.sides[axis][end] == Side::Periodic {
                    return Err(FluidError::SideTemperature { side: side.name() });
                }
                check("side temperature", kelvin, -MAX_TEMPERATURE_K, MAX_TEMPERATURE_K, "within ±1e4 K")?;
            }
            let Some(values) = &self.velocity[axis][end] else { continue };
            if !matches!(grid.sides[axis][end], Side::NoSlip | Side::Inflow) {
                return Err(FluidError::SideVelocity { side: side.name() });
            }
            for (component, values) in values.iter().enumerate() {
                let counts = grid.face_counts(component);
                let (found, expected) = (values.len(), counts[(axis + 1) % 3] * counts[(axis + 2) % 3]);
                if found != expected {
                    return Err(FluidError::Length { field: "side velocity", found, expected });
                }
                for value in values {
                    check("side velocity", *value, -100.0, 100.0, "components within ±100 m/s")?;
                }
            }
        }
        Ok(())
    }
}

impl Fluid {
    /// Gives a [`Side::NoSlip`] wall its velocity along itself (a moving lid; what it has across
    /// is ignored), or a [`Side::Inflow`] side the profile with which air enters or leaves:
    /// `velocity_m_s` at points of the side, components within ±100 m/s. Holds from the next
    /// step on, in place of rest and of the wind, until given again.
    ///
    /// In a box without an open side as much must leave as enters: what inflow sides leave over
    /// is taken off evenly from all their faces.
    ///
    /// # Errors
    /// A side of another kind, or a value that is not finite or out of range; nothing has
    /// changed then.
    pub fn set_side_velocity(&mut self, side: SideAt, velocity_m_s: impl Fn(Vec3) -> Vec3) -> Result<(), FluidError> {
        let (axis, end) = side.axis_and_end();
        let grid = &self.grid;
        if !matches!(grid.sides[axis][end], Side::NoSlip | Side::Inflow) {
            return Err(FluidError::SideVelocity { side: side.name() });
        }
        let [first, second] = [[1, 2], [0, 2], [0, 1]][axis];
        let mut values = SideValues::default();
        for (component, values) in values.iter_mut().enumerate() {
            let counts = grid.face_counts(component);
            let mut at = [0.5_f32; 3];
            for second_index in 0..counts[second] {
                for first_index in 0..counts[first] {
                    at[first] = first_index as f32 + if first == component { 0.0 } else { 0.5 };
                    at[second] = second_index as f32 + if second == component { 0.0 } else { 0.5 };
                    at[axis] = (end * grid.cells[axis]) as f32;
                    let point = grid.origin + Vec3::from_array(at) * Vec3::from_array(grid.cell_m);
                    let value = check_vec("side velocity", velocity_m_s(point), 100.0, "components within ±100 m/s")?;
                    values.push(value.to_array()[component]);
                }
            }
        }
        self.given.velocity[axis][end] = Some(Box::new(values));
        Ok(())
    }

    /// Holds a side at a temperature above ambient (K, -0.9 times ambient to 1e4), which
    /// conduction passes on to the air, or insulates it again (the start). Acts where
    /// [`Fluid::set_thermal_diffusivity_m2_s`] is above 0.
    ///
    /// # Errors
    /// A periodic side, or a value that is not finite or out of range; nothing has changed then.
    pub fn set_side_temperature(&mut self, side: SideAt, kelvin: Option<f32>) -> Result<(), FluidError> {
        let (axis, end) = side.axis_and_end();
        if self.grid.sides[axis][end] == Side::Periodic {
            return Err(FluidError::SideTemperature { side: side.name() });
        }
        if let Some(kelvin) = kelvin {
            let lowest_k = -0.9 * self.settings.ambient_k;
            check("side temperature", kelvin, lowest_k, MAX_TEMPERATURE_K, "-0.9 times ambient to 1e4 K")?;
        }
        self.given.temperature_k[axis][end] = kelvin;
        Ok(())
    }

    /// Thermal diffusivity, m²/s, 0 to 1e3: the air conducts heat, also to and from sides with a
    /// temperature. 2.1e-5 for air at room temperature. Starts at 0, which skips the work.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn set_thermal_diffusivity_m2_s(&mut self, thermal_diffusivity_m2_s: f32) -> Result<(), FluidError> {
        self.settings.thermal_diffusivity_m2_s = check_thermal_diffusivity(thermal_diffusivity_m2_s)?;
        Ok(())
    }
}
