//! Undoing: the states that the scene was in.

use lucerna::scene::Scene;

/// Most states that are kept.
const MOST: usize = 200;

/// What was and what will be again.
#[derive(Debug)]
pub(super) struct History {
    past: Vec<Scene>,
    /// The state that is shown, as it was recorded.
    now: Scene,
    future: Vec<Scene>,
}

impl History {
    pub(super) fn new(scene: &Scene) -> Self {
        Self { past: Vec::new(), now: scene.clone(), future: Vec::new() }
    }

    /// Takes a state down, where it is not the last one; where the camera is does not count.
    pub(super) fn record(&mut self, scene: &Scene) {
        if same(scene, &mut self.now) {
            return;
        }
        self.past.push(std::mem::replace(&mut self.now, scene.clone()));
        if self.past.len() > MOST {
            self.past.remove(0);
        }
        self.future.clear();
    }

    /// Puts the scene back to the state before, with its camera where it is.
    pub(super) fn undo(&mut self, scene: &mut Scene) {
        self.record(scene);
        if let Some(before) = self.past.pop() {
            self.future.push(std::mem::replace(&mut self.now, before));
            self.show(scene);
        }
    }

    /// Takes an undo back.
    pub(super) fn redo(&mut self, scene: &mut Scene) {
        self.record(scene);
        if let Some(after) = self.future.pop() {
            self.past.push(std::mem::replace(&mut self.now, after));
            self.show(scene);
        }
    }

    fn show(&self, scene: &mut Scene) {
        *scene = Scene { camera: scene.camera, ..self.now.clone() };
    }
}

/// Whether two states differ in nothing but the camera, which is taken over.
fn same(scene: &Scene, recorded: &mut Scene) -> bool {
    recorded.camera = scene.camera;
    scene == recorded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_undone_can_be_done_again_until_something_else_is_done() {
        let first = lucerna::scene::builtin("candle").unwrap().scene;
        let (mut scene, mut history) = (first.clone(), History::new(&first));
        for seed in [10, 11, 12] {
            scene.seed = seed;
            history.record(&scene);
            history.record(&scene);
        }
        scene.camera.fov_y_deg = 50.0;
        history.undo(&mut scene);
        assert_eq!((scene.seed, scene.camera.fov_y_deg), (11, 50.0));
        // What was not yet recorded can be undone, too.
        scene.name = "other".into();
        history.undo(&mut scene);
        assert_eq!((scene.seed, &scene.name), (11, &first.name));
        history.redo(&mut scene);
        assert_eq!(scene.name, "other");
        (0..9).for_each(|_| history.undo(&mut scene));
        assert_eq!(Scene { camera: first.camera, ..scene.clone() }, first);
        scene.seed = 99;
        history.record(&scene);
        history.redo(&mut scene);
        assert_eq!(scene.seed, 99, "nothing to do again");
    }
}
