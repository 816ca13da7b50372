//! Flames grown from wicks: skeletons, NURBS surfaces and their light.
//!
//! The model is that of Bridault, Rousselle, Renaud and Leblond, *Real-time Animation of Various
//! Flame Shapes* (2006), called paper 003 in this crate: roots along a wick emit chains of particles
//! that the air carries; the chains are the control net of a closed NURBS surface. Here they are
//! read at fixed ages in seconds, so that the look depends on no time step.
//!
//! * [`FlameSettings`]: what a user says; [`Flames`]: what burns and what is drawn of it.
//! * [`Air`]: the air, any field of velocities; `lucerna_fluid::Fluid` is one.

mod air;
mod burning;
mod chains;
mod check;
mod detail;
mod drive;
mod error;
mod flame;
mod flames;
mod free;
mod fuel;
mod life;
mod light;
mod lines;
mod net;
pub mod params;
mod place;
mod random;
mod roots;
mod section;
mod spine;
mod surface;
mod wick;

pub use air::{Air, Airs, Gas, ROOM_K, UniformAir};
pub use burning::{Drive, FuelKind, Rate, combustion};
pub use detail::{Detail, Follow};
pub use error::FlameError;
pub use flame::Source;
pub use flames::{Flames, MAX_FLAMES, SavedFlames};
pub use life::{BlowOut, Life, Supply};
pub use light::FlameLight;
pub use params::{FlameSettings, Fuel, FuelDistribution, FuelForm, Skeletons, SurfaceGrid, Swing, WickShape};
pub use place::Pose;
pub use roots::{LeadRoot, PeripheralRoot, Roots, lead_of_row};
pub use surface::{ControlNet, Surfaces};
pub use wick::{Centreline, MAX_WICK_POINTS, WickLook};
