//! The scene that is being edited, and the last state of it that is allowed.

use super::history::History;
use crate::cli::SceneArgs;
use crate::scenes;
use anyhow::{Context, Result};
use lucerna::World;
use lucerna::scene::{LoadedScene, Scene};
use std::path::PathBuf;

/// A scene under the sliders.
#[derive(Debug)]
pub(super) struct Document {
    /// Built-in name or path.
    pub(super) name: String,
    /// What the panel shows and changes.
    pub(super) edited: Scene,
    /// Why `edited` is not what burns.
    pub(super) error: Option<String>,
    /// The last allowed state: what burns is also in the world, camera and look are only here.
    active: Scene,
    /// The last state that was tried.
    tried: Scene,
    opened: Scene,
    history: History,
}

impl Document {
    pub(super) fn new(name: String, scene: &Scene) -> Self {
        Self {
            name,
            edited: scene.clone(),
            error: None,
            tried: scene.clone(),
            opened: scene.clone(),
            history: History::new(scene),
            active: scene.clone(),
        }
    }

    /// Opens another scene, and gives what a world is made from.
    pub(super) fn open(name: &str) -> Result<(Self, LoadedScene)> {
        let loaded = scenes::open(name, &SceneArgs::default(), |_| {})?;
        Ok((Self::new(name.into(), &loaded.scene), loaded))
    }

    /// What burns and how it is looked at.
    pub(super) fn active(&self) -> &Scene {
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

    /// Takes the present state down, to come back to it: once a change is complete.
    pub(super) fn record(&mut self) {
        self.history.record(&self.edited);
    }

    /// Takes the last change back.
    pub(super) fn undo(&mut self) {
        self.history.undo(&mut self.edited);
    }

    /// Does again what was undone.
    pub(super) fn redo(&mut self) {
        self.history.redo(&mut self.edited);
    }

    /// Writes the scene: a file in its place, a built-in one to a file of its name in the current folder, which is what
    /// is edited from then on. An old file stays whole until the new one is.
    pub(super) fn save(&mut self) -> Result<PathBuf> {
        lucerna::scene::validate(&self.edited)?;
        let path = match scenes::is_builtin(&self.name) {
            true => free_name(&self.name)?,
            false => PathBuf::from(&self.name),
        };
        let mut unfinished = path.clone().into_os_string();
        unfinished.push(".unfinished");
        let written = std::fs::write(&unfinished, self.edited.to_ron()?);
        written.and_then(|()| std::fs::rename(&unfinished, &path)).with_context(|| path.display().to_string())?;
        self.name = path.display().to_string();
        Ok(path)
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
        if scenes::burn_alike(&self.edited, &self.active) {
            // The frame is drawn with the document's own camera and look: the world need not know.
            lucerna::scene::validate(&self.edited)?;
        } else {
            let base_dir = scenes::base_dir(&self.name);
            world.set_scene(scenes::with_parameters(world.scene(), self.edited.clone(), &base_dir)?)?;
        }
        self.active = self.edited.clone();
        Ok(())
    }
}

/// The first of `NAME.ron`, `NAME_2.ron`, ... that is not there yet.
fn free_name(name: &str) -> Result<PathBuf> {
    let numbered = |number: u32| if number == 1 { format!("{name}.ron") } else { format!("{name}_{number}.ron") };
    let mut paths = (1..1000).map(|number| PathBuf::from(numbered(number)));
    paths.find(|path| !path.exists()).with_context(|| format!("{name}.ron to {name}_999.ron are all taken"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn opened() -> (Document, World) {
        let (document, loaded) = Document::open("candle").unwrap();
        (document, World::new(loaded).unwrap())
    }

    #[test]
    fn camera_and_look_are_taken_over_without_touching_the_world() {
        let (mut document, mut world) = opened();
        let before = world.scene().scene.clone();
        document.edited.camera.fov_y_deg += 1.0;
        document.edited.look.exposure_stops += 1.0;
        document.apply(&mut world);
        assert_eq!(document.error, None);
        assert_eq!(document.active(), &document.edited);
        assert_eq!(world.scene().scene, before);
    }

    #[test]
    fn what_burns_is_taken_over_by_the_world() {
        let (mut document, mut world) = opened();
        world.step(0.1).unwrap();
        document.edited.seed += 1;
        document.apply(&mut world);
        assert_eq!((&document.error, world.time_s()), (&None, 0.0));
        let mut anew = World::new(world.scene().clone()).unwrap();
        for world in [&mut world, &mut anew] {
            world.step(0.1).unwrap();
        }
        assert_eq!(world.state_hash(), anew.state_hash());
    }

    #[test]
    fn what_is_not_allowed_changes_nothing() {
        let (mut document, mut world) = opened();
        let before = document.active().clone();
        document.edited.look.layers = 0;
        document.apply(&mut world);
        assert!(document.error.is_some());
        assert_eq!((document.active(), &world.scene().scene), (&before, &before));
    }

    #[test]
    fn a_scene_that_was_edited_and_saved_opens_as_it_was() {
        let folder = std::env::temp_dir().join(format!("lucerna_studio_save_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let (mut document, mut world) = opened();
        document.name = folder.join("mine.ron").display().to_string();
        let points = document.edited.fires[0].wicks[0].points_mut().unwrap();
        points.push([0.002, 0.009, 0.0]);
        document.apply(&mut world);
        document.record();
        let path = document.save().unwrap();
        assert_eq!(Document::open(&path.display().to_string()).unwrap().0.edited, document.edited);
        document.undo();
        document.apply(&mut world);
        assert_eq!(world.scene().scene.fires[0].wicks[0].points().len(), 3);
        document.redo();
        assert_eq!(document.edited.fires[0].wicks[0].points().len(), 4);
        // What cannot be saved leaves the file as it is.
        document.edited.look.layers = 0;
        assert!(document.save().is_err());
        assert!(Document::open(&path.display().to_string()).is_ok());
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
