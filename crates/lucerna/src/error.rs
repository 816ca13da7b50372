//! What can be wrong with a world.

use lucerna_flame::FlameError;
use lucerna_fluid::FluidError;

/// Why a world could not be made or stepped.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// A flame could not be made.
    #[error("a flame could not be made")]
    Flame(#[from] FlameError),
    /// The air could not be made or moved.
    #[error("the air could not be made or moved")]
    Air(#[from] FluidError),
    /// A length of time that cannot be stepped by.
    #[error("{field} is {value}; allowed is {allowed}")]
    Time {
        /// Which one.
        field: &'static str,
        /// What it is, s.
        value: f32,
        /// What it may be.
        allowed: &'static str,
    },
    /// A camera that nothing can be seen through.
    #[error(
        "the view is not allowed: finite positions, an angle of view of 1 to 170 degrees, a near plane of 1e-6 to 1e6 m"
    )]
    View,
    /// There is no fire of this number.
    #[error("there is no fire {fire}: the scene has {count}, counted from 0")]
    NoFire {
        /// The number asked for.
        fire: usize,
        /// Fires in the scene.
        count: usize,
    },
    /// A fire cannot be placed so.
    #[error("the pose of fire {fire} is not allowed: a unit quaternion, and at most 1e6 m along each axis")]
    Pose {
        /// Which fire.
        fire: usize,
    },
    /// The scene's wicks are not those that were read from its files.
    #[error("the scene has {fires} fires with {wicks} wicks, but {shapes} wick shapes were loaded in {groups} groups")]
    Wicks {
        /// Fires in the scene.
        fires: usize,
        /// Wicks in the scene.
        wicks: usize,
        /// Groups of loaded shapes.
        groups: usize,
        /// Loaded shapes.
        shapes: usize,
    },
}
