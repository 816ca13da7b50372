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
