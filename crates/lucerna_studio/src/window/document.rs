//! The scene that is being edited, and the last state of it that is allowed.

use crate::cli::SceneArgs;
use crate::scenes;
use anyhow::Result;
use lucerna::World;
use lucerna::scene::{LoadedScene, Scene};

/// A scene under the sliders.
#[derive(Debug)]
pub(super) struct Document {
    /// Built-in name or path.
    pub(super) name: String,
    /// What the panel shows and changes.
    pub(super) edited: Scene,
    /// Why `edited` is not what burns.
    pub(super) error: Option<String>,
    /// The last allowed state.
    active: LoadedScene,
    /// The last state that was tried.
    tried: Scene,
    opened: Scene,
}

impl Document {
    pub(super) fn new(name: String, loaded: LoadedScene) -> Self {
        Self {
            name,
            edited: loaded.scene.clone(),
            error: None,
            tried: loaded.scene.clone(),
            opened: loaded.scene.clone(),
            active: loaded,
        }
    }

    /// Opens another scene.
    pub(super) fn open(name: &str) -> Result<Self> {
        Ok(Self::new(name.into(), scenes::open(name, &SceneArgs::default(), |_| {})?))
    }

    /// What burns and how it is looked at.
    pub(super) fn active(&self) -> &LoadedScene {
        &self.active
    }

    /// Changes the scene, as it was opened, by a preset; seed and camera stay as they are now.
    pub(super) fn apply_preset(&mut self, preset: &str) {
        let mut scene = self.opened.clone();
        (scene.seed, scene.camera) = (self.edited.seed, self.edited.camera);
        match lucerna::scene::apply_preset(&mut scene, preset) {
            Ok(()) => self.edited = scene,
            Err(error) => self.error = Some(error.to_string()),
        }
    }

    /// Puts the camera where it was when the scene was opened.
    pub(super) fn reset_camera(&mut self) {
        self.edited.camera = self.opened.camera;
    }

    /// Takes over what was edited since the last call, where it is allowed; else says why not and goes on as before.
    pub(super) fn apply(&mut self, world: &mut World) {
        if self.edited == self.tried {
            return;
        }
        self.tried = self.edited.clone();
        self.error = self.try_apply(world).err().map(|error| format!("{error:#}"));
    }

    fn try_apply(&mut self, world: &mut World) -> Result<()> {
        let loaded = scenes::with_parameters(&self.active, self.edited.clone(), &scenes::base_dir(&self.name))?;
        if !scenes::burn_alike(&loaded.scene, &self.active.scene) {
            world.set_scene(loaded.clone())?;
            if loaded.scene.seed != self.active.scene.seed {
                world.reset();
            }
        }
        self.active = loaded;
        Ok(())
    }
}
