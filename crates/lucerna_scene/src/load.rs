//! From a file, a name or an edited scene to a [`LoadedScene`].

use crate::assets::{self, Assets};
use crate::validate::{self, Check};
use crate::{LoadedScene, Scene, SceneError, import, place, wick};
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;
use std::path::Path;

/// Largest number of flames in all fires of a scene.
pub(crate) const MAX_FLAMES: usize = lucerna_flame::MAX_FLAMES;

/// Largest number of vertices of all opaque meshes of a scene.
const MAX_SCENE_VERTICES: usize = 8_000_000;

/// Reads a scene file (RON) and the mesh files that it names.
///
/// Paths in the scene are relative to the scene file; a path that starts with `builtin:` names a file of
/// the built-in scenes.
///
/// # Errors
///
/// A [`SceneError`] that names the file, the place in it, and what is allowed there.
pub fn load(path: &Path) -> Result<LoadedScene, SceneError> {
    let bytes = assets::read(path, assets::MAX_TEXT_BYTES)?;
    let text = std::str::from_utf8(&bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        SceneError::Syntax {
            path: path.to_path_buf(),
            line: 1 + before.iter().filter(|byte| **byte == b'\n').count(),
            column: 1 + before.iter().rev().take_while(|byte| **byte != b'\n').count(),
            problem: "is not UTF-8 text".to_owned(),
        }
    })?;
    let scene = parse(text, path)?;
    assemble(scene, path.parent().unwrap_or(Path::new("")), Some(path))
}

/// A built-in scene by name, or else a scene file by path.
///
/// # Errors
///
/// As [`load`]; where the text is neither a name nor a file, [`SceneError::Unknown`] lists the names.
pub fn open(name_or_path: &str) -> Result<LoadedScene, SceneError> {
    if crate::builtin_names().contains(&name_or_path) {
        return crate::builtin(name_or_path);
    }
    let path = Path::new(name_or_path);
    if !path.exists() && path.extension().is_none() {
        return Err(SceneError::Unknown {
            kind: "scene",
            name: name_or_path.to_owned(),
            allowed: format!("{}, or the path of a scene file", crate::builtin_names().join(", ")),
        });
    }
    load(path)
}

/// Reads a scene from RON text without checking its values or reading its files; `path` is for messages.
///
/// # Errors
///
/// [`SceneError::Syntax`] with line and column.
pub fn parse(text: &str, path: &Path) -> Result<Scene, SceneError> {
    ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME).from_str(text).map_err(|error| {
        SceneError::Syntax {
            path: path.to_path_buf(),
            line: error.span.start.line,
            column: error.span.start.col,
            problem: error.code.to_string(),
        }
    })
}

impl Scene {
    /// The scene as the text of a scene file.
    ///
    /// # Errors
    ///
    /// [`SceneError::Write`] where a file name is not Unicode.
    pub fn to_ron(&self) -> Result<String, SceneError> {
        let pretty = PrettyConfig::new().depth_limit(4).indentor("    ").struct_names(false);
        let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
        let mut text = options.to_string_pretty(self, pretty).map_err(|error| SceneError::Write(error.to_string()))?;
        text.push('\n');
        Ok(text)
    }
}

impl LoadedScene {
    /// Checks a scene and reads the files that it names, relative to `base_dir`: for scenes that were made or
    /// edited in memory.
    ///
    /// # Errors
    ///
    /// As [`load`].
    pub fn from_scene(scene: Scene, base_dir: &Path) -> Result<Self, SceneError> {
        assemble(scene, base_dir, None)
    }
}

fn assemble(scene: Scene, base_dir: &Path, file: Option<&Path>) -> Result<LoadedScene, SceneError> {
    let check = Check::new(file);
    validate::scene(&check, &scene)?;
    let assets = Assets::new(base_dir);
    let wicks = wick::shapes(&check, &scene, assets)?;
    let mut meshes = Vec::with_capacity(scene.meshes.len());
    let mut vertices = 0;
    for (index, source) in scene.meshes.iter().enumerate() {
        let mesh = import::opaque_mesh(&assets.resolve(&source.file), &source.placement())?;
        vertices += mesh.vertices.len() * source.at.len().max(1);
        if vertices > MAX_SCENE_VERTICES {
            let field = format!("the number of vertices up to meshes[{index}]");
            return Err(check.fail(field, vertices, format!("at most {MAX_SCENE_VERTICES}")));
        }
        meshes.push(if source.at.is_empty() { mesh } else { place::copies(&mesh, &source.at, &source.turns_deg) });
    }
    Ok(LoadedScene { scene, wicks, meshes })
}
