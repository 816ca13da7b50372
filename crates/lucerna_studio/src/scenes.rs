//! Scenes by name or path, and the changes that the command line or the panel make to them.

use crate::cli::SceneArgs;
use anyhow::Result;
use lucerna::frame::Shading;
use lucerna::scene::{Fire, LoadedScene, Scene, WickSource};
use std::path::{Path, PathBuf};

/// Opens a scene and changes it: first `adjust`, then the preset, then what the command line names.
pub fn open(name_or_path: &str, changes: &SceneArgs, adjust: impl FnOnce(&mut Scene)) -> Result<LoadedScene> {
    let mut loaded = lucerna::scene::open(name_or_path)?;
    adjust(&mut loaded.scene);
    if let Some(preset) = &changes.preset {
        lucerna::scene::apply_preset(&mut loaded.scene, preset)?;
    }
    let scene = &mut loaded.scene;
    scene.seed = changes.seed.unwrap_or(scene.seed);
    scene.look.shading = changes.shading.map_or(scene.look.shading, Shading::from);
    scene.look.layers = changes.layers.unwrap_or(scene.look.layers);
    Ok(LoadedScene::from_scene(loaded.scene, &base_dir(name_or_path))?)
}

/// The folder that the files of a scene are relative to; built-in scenes bring their own.
#[must_use]
pub fn base_dir(name_or_path: &str) -> PathBuf {
    if is_builtin(name_or_path) {
        return PathBuf::new();
    }
    Path::new(name_or_path).parent().map(Path::to_path_buf).unwrap_or_default()
}

/// Whether a scene comes with the library.
#[must_use]
pub fn is_builtin(name: &str) -> bool {
    lucerna::scene::builtin_names().contains(&name)
}

/// The loaded scene with other parameters, checked. Files are read again only where wicks or meshes
/// changed, or the box of air that the wicks of files must lie in.
pub fn with_parameters(loaded: &LoadedScene, scene: Scene, base_dir: &Path) -> Result<LoadedScene> {
    let wicks = |scene: &Scene| scene.fires.iter().map(wicks_and_places).collect::<Vec<_>>();
    let (air, old) = (&scene.air, &loaded.scene.air);
    let moved = (air.origin_m, air.size_m) != (old.origin_m, old.size_m);
    let from_file = |fire: &Fire| fire.wicks.iter().any(|wick| matches!(wick, WickSource::Mesh { .. }));
    let unchecked = moved && scene.fires.iter().any(from_file);
    if unchecked || scene.meshes != loaded.scene.meshes || wicks(&scene) != wicks(&loaded.scene) {
        return Ok(LoadedScene::from_scene(scene, base_dir)?);
    }
    lucerna::scene::validate(&scene)?;
    Ok(LoadedScene { scene, wicks: loaded.wicks.clone(), meshes: loaded.meshes.clone() })
}

/// What decides which files of wicks are read, and where their wicks are.
fn wicks_and_places(fire: &Fire) -> impl PartialEq + use<> {
    (fire.wicks.clone(), fire.at.clone(), fire.turns_deg.clone(), fire.air)
}

/// Whether two scenes differ in what burns, rather than only in how it is looked at.
#[must_use]
pub fn burn_alike(a: &Scene, b: &Scene) -> bool {
    (a.seed, &a.air, &a.fires, &a.meshes, &a.motions) == (b.seed, &b.air, &b.fires, &b.meshes, &b.motions)
}
