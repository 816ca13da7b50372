//! The scenes that come with the crate, embedded so that they work from anywhere.

use crate::{LoadedScene, SceneError};
use std::path::Path;

macro_rules! embedded {
    ($($name:literal),+ $(,)?) => {
        /// Every file of the built-in scenes.
        const FILES: &[(&str, &[u8])] = &[$(($name, include_bytes!(concat!("../scenes/", $name)))),+];
    };
}

embedded!(
    "candle.ron",
    "candle.mtl",
    "candle.obj",
    "candle_table.obj",
    "torch.ron",
    "torch.mtl",
    "torch.obj",
    "torch_wall.obj",
    "torch_swung.ron",
    "oil_lamp.ron",
    "chandelier.ron",
    "ring_burner.ron",
    "line_burner.ron",
    "wind.ron",
    "vessels.mtl",
    "oil_lamp.obj",
    "table.obj",
    "chandelier.obj",
    "hall.obj",
    "ring_burner.obj",
    "line_burner.obj",
    "fire_bowl.obj",
    "yard.obj",
    "campfire.ron",
    "campfire.mtl",
    "campfire_logs.obj",
    "campfire_stones.obj",
    "campfire_coals.obj",
    "campfire_ground.obj",
    "hall.ron",
    "hall.mtl",
    "hall_room.obj",
    "hall_candle.obj",
    "hall_torch.obj",
    "hall_chandelier.obj",
);

const NAMES: &[&str] = &[
    "candle",
    "oil_lamp",
    "chandelier",
    "torch",
    "torch_swung",
    "campfire",
    "ring_burner",
    "line_burner",
    "wind",
    "hall",
];

/// The names of the built-in scenes.
#[must_use]
pub fn builtin_names() -> &'static [&'static str] {
    NAMES
}

/// A built-in scene.
///
/// # Errors
///
/// [`SceneError::Unknown`] where there is no scene of that name.
pub fn builtin(name: &str) -> Result<LoadedScene, SceneError> {
    if !NAMES.contains(&name) {
        return Err(SceneError::Unknown { kind: "scene", name: name.to_owned(), allowed: NAMES.join(", ") });
    }
    crate::load::load(Path::new(&format!("{}{name}.ron", crate::assets::BUILTIN_PREFIX)))
}

/// An embedded file.
pub(crate) fn file(name: &str) -> Option<&'static [u8]> {
    FILES.iter().find(|(known, _)| *known == name).map(|(_, bytes)| *bytes)
}
