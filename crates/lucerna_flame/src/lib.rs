//! Flames grown from wicks: skeletons, NURBS surfaces and their light.

pub mod params;

pub use params::{FlameSettings, Fuel, FuelDistribution, FuelForm, Skeletons, SurfaceGrid, Swing, WickShape};
