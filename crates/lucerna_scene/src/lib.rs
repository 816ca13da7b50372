//! Scene files, wick and mesh import, presets.
//!
//! A scene says what burns where, in which air, and how it is looked at. It is plain data ([`Scene`]) in a
//! RON file; `docs/scene_format.md` describes every field. [`open`] takes the name of a built-in scene or a
//! path, [`load`] a path; both check every value and read the wick and mesh files that the scene names. What
//! they give, a [`LoadedScene`], is what a world is made from.
//!
//! ```
//! let mut loaded = lucerna_scene::open("candle")?;
//! lucerna_scene::apply_preset(&mut loaded.scene, "draft")?;
//! // The edited scene is checked again, and its files are read again.
//! let loaded = lucerna_scene::LoadedScene::from_scene(loaded.scene, "".as_ref())?;
//! assert_eq!(loaded.wicks.len(), 1);
//! # Ok::<(), lucerna_scene::SceneError>(())
//! ```

mod assets;
mod builtin;
mod camera;
mod error;
mod import;
mod load;
mod model;
mod motion;
mod place;
mod presets;
mod validate;
mod wick;

pub use builtin::{builtin, builtin_names};
pub use camera::CameraKey;
pub use error::SceneError;
pub use load::{load, open, parse};
pub use model::{Air, AirAdvection, AirSides, Budget, Fire, HeatAdvection, LoadedScene, MeshSource, Pressure, Scene};
pub use motion::{Motion, MotionKey, MotionPath};
pub use place::{FireAir, Place};
pub use presets::{apply_preset, presets};
pub use validate::validate;
pub use wick::WickSource;
