//! Scene files, wick and mesh import, presets.

mod model;

pub use model::{Air, AirSides, Fire, LoadedScene, MeshSource, Pressure, Scene, WickSource};
