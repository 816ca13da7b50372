//! What can be wrong with what a caller asks for.

use crate::limits::{MAX_AXIS_CELLS, MAX_CELLS, MIN_AXIS_CELLS};
use crate::scalars::MAX_SCALARS;

/// A request that was refused. The fluid is as it was before the call.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FluidError {
    /// An axis has too few or too many cells.
    #[error("{axis} has {cells} cells; allowed: {MIN_AXIS_CELLS} to {MAX_AXIS_CELLS}, or 1 along one axis")]
    AxisCells {
        /// Which axis: `x`, `y` or `z`.
        axis: &'static str,
        /// The number of cells asked for.
        cells: usize,
    },
    /// The axis along which there is one cell, so that nothing moves, has a side that lets air move.
    #[error("the {axis} axis has one cell, and a side that is not free_slip; allowed: free_slip on both")]
    FlatSides {
        /// Which axis: `x`, `y` or `z`.
        axis: &'static str,
    },
    /// Only one of two opposite sides is periodic.
    #[error("the {axis} axis has one periodic side; allowed: both or none")]
    HalfPeriodic {
        /// Which axis: `x`, `y` or `z`.
        axis: &'static str,
    },
    /// The grid as a whole has too many cells.
    #[error("the grid has {cells} cells; allowed: up to {MAX_CELLS}")]
    TooManyCells {
        /// The number of cells asked for.
        cells: usize,
    },
    /// A number is not finite or out of its range.
    #[error("{field} is {value}; allowed: {allowed}")]
    Value {
        /// Name of the parameter.
        field: &'static str,
        /// What was passed; of a vector, its first offending component.
        value: f32,
        /// What is allowed, with units.
        allowed: &'static str,
    },
    /// A row of cells that does not exist.
    #[error("row {row} does not exist; allowed: below {rows}")]
    Row {
        /// The row asked for.
        row: usize,
        /// The number of rows, which is the number of cells along y.
        rows: usize,
    },
    /// Too many named scalars.
    #[error("{count} scalars; allowed: up to {MAX_SCALARS}")]
    TooManyScalars {
        /// The number of scalars asked for.
        count: usize,
    },
    /// A scalar has a name that cannot be used.
    #[error("the name of scalar {index} is {problem}; allowed: names that differ, none of them empty")]
    ScalarName {
        /// Which scalar, in the order in which they were given.
        index: usize,
        /// What is wrong with its name.
        problem: &'static str,
    },
    /// A scalar of another fluid.
    #[error("scalar {index} does not exist; allowed: below {count}")]
    UnknownScalar {
        /// The scalar asked for.
        index: usize,
        /// The number of scalars of this fluid.
        count: usize,
    },
    /// An obstacle touches no cell of the box.
    #[error("obstacle {index} lies wholly outside the box; allowed: obstacles that reach into it")]
    ObstacleOutside {
        /// Which obstacle, in the order in which they were given.
        index: usize,
    },
    /// The flags of solid cells are not one a cell.
    #[error("obstacle {index} has flags for {cells} cells; allowed: the {expected} of the box")]
    ObstacleVoxels {
        /// Which obstacle, in the order in which they were given.
        index: usize,
        /// The number of flags.
        cells: usize,
        /// The number of cells.
        expected: usize,
    },
    /// A velocity was given for a side that has none of its own.
    #[error("the {side} side is neither no_slip nor inflow; allowed: a velocity for a side that is")]
    SideVelocity {
        /// Which side: `left`, `right`, `bottom`, `top`, `back` or `front`.
        side: &'static str,
    },
    /// A temperature was given for a side that has no wall.
    #[error("the {side} side is periodic; allowed: a temperature for a side that is not")]
    SideTemperature {
        /// Which side: `left`, `right`, `bottom`, `top`, `back` or `front`.
        side: &'static str,
    },
    /// No part of a source's shape is inside the box.
    #[error("the source lies outside the box; allowed: a shape with a part inside")]
    SourceOutside,
    /// A source that is not attached, or no longer.
    #[error("source {id} is not attached; allowed: what attach_source returned")]
    UnknownSource {
        /// The number of the source.
        id: u64,
    },
    /// Variable density in a box that nothing can leave.
    #[error("density is low_mach in a box without an open side; allowed: low_mach with an open side")]
    SealedLowMach,
    /// Variable density with a scheme for scalars that does not keep their mass.
    #[error(
        "density is low_mach, and scalars are not carried through the faces; allowed: low_mach with the scheme flux"
    )]
    UnevenLowMach,
    /// Combustion without one of the scalars that it needs.
    #[error("combustion lacks the scalar {name}; allowed: what FluidBuilder::combustion sets up")]
    CombustionScalar {
        /// Which one: `fuel`, `oxygen` or `soot`.
        name: &'static str,
    },
    /// A mesh that cannot be the shape of a source.
    #[error("the mesh {problem}; allowed: triangles between existing corners, closed if their inside is meant")]
    Mesh {
        /// What is wrong with it.
        problem: &'static str,
    },
    /// Wind enters by one side of an axis and can leave nowhere.
    #[error(
        "the {axis} axis has one inflow side and no side of the box is open; allowed: two inflow sides, or an open side anywhere"
    )]
    NoOutlet {
        /// Which axis: `x`, `y` or `z`.
        axis: &'static str,
    },
    /// Two slices that belong together have different lengths.
    #[error("{field} has {found} values; allowed: {expected}")]
    Length {
        /// Which slice.
        field: &'static str,
        /// Its length.
        found: usize,
        /// What it has to be.
        expected: usize,
    },
    /// A box of a batch has another shape than the first.
    #[error(
        "box {index} of the batch differs from the first; allowed: the same cells, size, sides, pressure solver and names of scalars"
    )]
    BatchShape {
        /// Which box, counted from zero.
        index: usize,
    },
}

/// Refuses a number outside `low..=high`, or not a number.
pub(crate) fn check(
    field: &'static str,
    value: f32,
    low: f32,
    high: f32,
    allowed: &'static str,
) -> Result<f32, FluidError> {
    // A comparison with NaN is false, so that NaN is refused too.
    if value >= low && value <= high { Ok(value) } else { Err(FluidError::Value { field, value, allowed }) }
}

/// Refuses a vector with a component outside `-high..=high`, or not a number.
pub(crate) fn check_vec(
    field: &'static str,
    value: glam::Vec3,
    high: f32,
    allowed: &'static str,
) -> Result<glam::Vec3, FluidError> {
    for component in value.to_array() {
        check(field, component, -high, high, allowed)?;
    }
    Ok(value)
}
