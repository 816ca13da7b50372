//! What can be wrong with a fire's description.

/// Why a flame could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlameError {
    /// A number is outside of its range.
    #[error("{field} is {value}; allowed is {allowed}")]
    OutOfRange {
        /// The field, as it is called in a scene.
        field: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        allowed: &'static str,
    },
    /// A list has the wrong length.
    #[error("{field} has {count} entries; allowed is {allowed}")]
    Count {
        /// The list.
        field: &'static str,
        /// How long it is.
        count: usize,
        /// How long it may be.
        allowed: &'static str,
    },
    /// A position or an entry of a list is NaN or infinite.
    #[error("entry {index} of {field} is {value}; allowed are finite numbers up to 1e6")]
    NotFinite {
        /// The list.
        field: &'static str,
        /// Which entry, from 0.
        index: usize,
        /// The first bad number in it.
        value: f64,
    },
    /// Flames in one air burn different fuels.
    #[error("flame {flame} burns another fuel than those before it; one air burns one fuel")]
    Fuels {
        /// The first that does, from 0.
        flame: usize,
    },
    /// There is no such flame.
    #[error("there is no flame {flame}; there are {count}, counted from 0")]
    NoFlame {
        /// The one asked for.
        flame: usize,
        /// How many there are.
        count: usize,
    },
    /// A supply of fuel is given in a measure that the drive does not have.
    #[error("life.supply is given in {unit}; with root forces it can only be in seconds")]
    Supply {
        /// `grams` or `kilojoules`.
        unit: &'static str,
    },
    /// The surface could not be laid out.
    #[error("the flame's surface could not be laid out")]
    Surface(#[from] lucerna_nurbs::NurbsError),
    /// A flame cannot follow another.
    #[error(
        "flame {flame} cannot follow flame {followed}: that must be another, recorded, with the same skeletons, surface and shedding, and the delay 0 to 1"
    )]
    Follow {
        /// The flame.
        flame: usize,
        /// The one that it is to follow.
        followed: usize,
    },
    /// What was saved is not of these flames, or not as it was saved.
    #[error("the saved flames do not fit{}", flame.map(|flame| format!(": flame {flame}")).unwrap_or_default())]
    Saved {
        /// The first that does not; none where it is all of them.
        flame: Option<usize>,
    },
}

/// Fails unless `low <= value <= high` (so NaN fails).
pub(crate) fn in_range(
    field: &'static str,
    value: f32,
    low: f32,
    high: f32,
    allowed: &'static str,
) -> Result<(), FlameError> {
    if value >= low && value <= high {
        Ok(())
    } else {
        Err(FlameError::OutOfRange { field, value: f64::from(value), allowed })
    }
}
