//! What the six sides of the box do to the air.

mod fixed;
mod given;

use serde::{Deserialize, Serialize};

pub(crate) use fixed::{fix_sides, push_wind};
pub(crate) use given::{GivenSides, Profile, Wall, Walls};

/// One side of the box.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// A wall without friction: nothing passes, air slides along it.
    #[default]
    FreeSlip,
    /// A wall with friction: nothing passes, and viscosity makes the air at the wall move with
    /// it: at rest, or with the velocity given by [`crate::Fluid::set_side_velocity`]. Without
    /// viscosity it acts as [`Side::FreeSlip`].
    NoSlip,
    /// Free air: zero pressure on the face. Air leaves with the velocity that it has, and what
    /// comes in has the wind's velocity and ambient temperature. Where the wind blows in, it
    /// pushes with its ram pressure, so that the box takes on the wind within the time in which
    /// the wind crosses it.
    Open,
    /// Air enters (or leaves) with a given velocity: the wind's, or what
    /// [`crate::Fluid::set_side_velocity`] says for each face. It enters at ambient temperature.
    Inflow,
    /// What leaves here enters at the opposite side, which must be periodic too.
    Periodic,
}

impl Side {
    /// Whether the velocity through the face is given, so that the pressure has no say in it.
    pub(crate) fn fixes_flow(self) -> bool {
        !matches!(self, Side::Open | Side::Periodic)
    }

    /// Whether air can come from outside.
    pub(crate) fn lets_in(self) -> bool {
        matches!(self, Side::Open | Side::Inflow)
    }
}

/// Which of the six sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SideAt {
    /// The low end of x.
    Left,
    /// The high end of x.
    Right,
    /// The low end of y.
    Bottom,
    /// The high end of y.
    Top,
    /// The low end of z.
    Back,
    /// The high end of z.
    Front,
}

impl SideAt {
    /// All six.
    pub const ALL: [Self; 6] = [Self::Left, Self::Right, Self::Bottom, Self::Top, Self::Back, Self::Front];

    /// Axis, and end of it: 0 low, 1 high.
    pub(crate) fn axis_and_end(self) -> (usize, usize) {
        match self {
            Self::Left => (0, 0),
            Self::Right => (0, 1),
            Self::Bottom => (1, 0),
            Self::Top => (1, 1),
            Self::Back => (2, 0),
            Self::Front => (2, 1),
        }
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Bottom => "bottom",
            Self::Top => "top",
            Self::Back => "back",
            Self::Front => "front",
        }
    }
}

/// The six sides: for each axis the one at its low end and the one at its high end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Sides {
    /// Left and right.
    pub x: [Side; 2],
    /// Bottom and top.
    pub y: [Side; 2],
    /// Back and front.
    pub z: [Side; 2],
}

impl Sides {
    /// Walls without friction all around. The default.
    pub const CLOSED: Self = Self::all(Side::FreeSlip);
    /// Periodic along all axes.
    pub const PERIODIC: Self = Self::all(Side::Periodic);
    /// Free air all around.
    pub const OPEN: Self = Self::all(Side::Open);

    /// The same on all six sides.
    #[must_use]
    pub const fn all(side: Side) -> Self {
        Self { x: [side; 2], y: [side; 2], z: [side; 2] }
    }

    /// By axis: x, y, z.
    pub(crate) fn by_axis(self) -> [[Side; 2]; 3] {
        [self.x, self.y, self.z]
    }
}
