//! Drawing wicks: which point is chosen, and what clicks and keys do to the scene.

use glam::{Quat, Vec2, Vec3};
use lucerna::World;
use lucerna::scene::{Scene, WickSource};

/// How near to a point the mouse chooses it, in points of the window.
const REACH: f32 = 11.0;

/// A point of a wick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Handle {
    pub(super) fire: usize,
    pub(super) wick: usize,
    pub(super) point: usize,
}

/// The state of drawing.
#[derive(Clone, Debug, Default)]
pub(super) struct WickEdit {
    /// Clicks draw, and points are shown.
    pub(super) on: bool,
    /// The fire that new wicks belong to.
    pub(super) fire: usize,
    /// The point that keys act on, and after which the next click adds one.
    pub(super) chosen: Option<Handle>,
    /// The chosen point follows the mouse.
    pub(super) dragging: bool,
}

/// Where the first copy of a fire is in the world now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    rotation: Quat,
    translation: Vec3,
}

impl Stand {
    pub(super) fn of(scene: &Scene, world: &World, fire: usize) -> Self {
        let pose = world.pose(fire).unwrap_or_default();
        let place = scene.fires.get(fire).and_then(|fire| fire.places().next());
        let (at, turn) = place.map_or((Vec3::ZERO, 0.0), |place| (place.at.into(), place.turn_deg.to_radians()));
        Self { rotation: pose.rotation * Quat::from_rotation_y(turn), translation: pose.point(at) }
    }

    pub(super) fn in_world(&self, point: [f32; 3]) -> Vec3 {
        self.rotation * Vec3::from(point) + self.translation
    }

    pub(super) fn in_fire(&self, point: Vec3) -> [f32; 3] {
        (self.rotation.inverse() * (point - self.translation)).into()
    }
}

impl WickEdit {
    /// All points of all wicks that can be moved.
    pub(super) fn handles(scene: &Scene) -> impl Iterator<Item = (Handle, [f32; 3])> + '_ {
        scene.fires.iter().enumerate().flat_map(|(fire, one)| {
            one.wicks.iter().enumerate().flat_map(move |(wick, source)| {
                source.points().iter().enumerate().map(move |(point, at)| (Handle { fire, wick, point }, *at))
            })
        })
    }

    /// The point nearest to the mouse, of those that are near enough; `place` says where each is on the picture.
    pub(super) fn near(scene: &Scene, mouse: Vec2, place: impl Fn(usize, [f32; 3]) -> Option<Vec2>) -> Option<Handle> {
        let distances = Self::handles(scene)
            .filter_map(|(handle, at)| Some((handle, place(handle.fire, at)?.distance(mouse))))
            .filter(|(_, distance)| *distance <= REACH);
        distances.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(handle, _)| handle)
    }

    fn points_of<'a>(&self, scene: &'a mut Scene) -> Option<(&'a mut Vec<[f32; 3]>, Handle)> {
        let chosen = self.chosen?;
        let points = scene.fires.get_mut(chosen.fire)?.wicks.get_mut(chosen.wick)?.points_mut()?;
        (chosen.point < points.len()).then_some((points, chosen))
    }

    /// Forgets a chosen point that is gone, as after undoing.
    pub(super) fn refresh(&mut self, scene: &mut Scene) {
        if self.points_of(scene).is_none() {
            (self.chosen, self.dragging) = (None, false);
        }
        self.fire = self.fire.min(scene.fires.len().saturating_sub(1));
    }

    /// Adds a point after the chosen one, or begins a wick where none is chosen; it is chosen then. A new wick is as
    /// thick as the fire's first.
    pub(super) fn add(&mut self, scene: &mut Scene, at: [f32; 3]) {
        let at = self.inside(scene, at);
        if let Some((points, chosen)) = self.points_of(scene) {
            points.insert(chosen.point + 1, at);
            self.chosen = Some(Handle { point: chosen.point + 1, ..chosen });
            return;
        }
        let Some(fire) = scene.fires.get_mut(self.fire) else { return };
        let radius_m = fire.wicks.iter().find_map(radius_of).unwrap_or(0.002);
        fire.wicks.push(WickSource::Polyline { points: vec![at], radius_m });
        self.chosen = Some(Handle { fire: self.fire, wick: fire.wicks.len() - 1, point: 0 });
    }

    /// Moves the chosen point.
    pub(super) fn drag(&self, scene: &mut Scene, to: [f32; 3]) {
        let to = self.inside(scene, to);
        if let Some((points, chosen)) = self.points_of(scene) {
            points[chosen.point] = to;
        }
    }

    /// Puts a point halfway between the chosen one and the next, or the one before the last.
    pub(super) fn insert(&mut self, scene: &mut Scene) {
        let Some((points, chosen)) = self.points_of(scene) else { return };
        if points.len() < 2 {
            return;
        }
        let at = (chosen.point + 1).min(points.len() - 1);
        let middle = 0.5 * (Vec3::from(points[at - 1]) + Vec3::from(points[at]));
        points.insert(at, middle.into());
        self.chosen = Some(Handle { point: at, ..chosen });
    }

    /// Takes the chosen point away, and with the last one its wick; a fire keeps one wick.
    pub(super) fn delete(&mut self, scene: &mut Scene) {
        let Some((points, chosen)) = self.points_of(scene) else { return };
        if points.len() > 1 {
            points.remove(chosen.point);
            self.chosen = Some(Handle { point: chosen.point.saturating_sub(1), ..chosen });
        } else if scene.fires[chosen.fire].wicks.len() > 1 {
            scene.fires[chosen.fire].wicks.remove(chosen.wick);
            self.chosen = None;
        }
    }

    /// The point of the box of air nearest to `at`: wicks lie inside.
    fn inside(&self, scene: &Scene, at: [f32; 3]) -> [f32; 3] {
        let fire = self.chosen.map_or(self.fire, |chosen| chosen.fire);
        let (mut low, mut size) = (scene.air.origin_m, scene.air.size_m);
        if let Some(fire) = scene.fires.get(fire) {
            if let Some(air) = &fire.air {
                (low, size) = (air.origin_m, air.size_m);
            } else if let Some(place) = fire.places().next().filter(|_| !fire.at.is_empty()) {
                low = std::array::from_fn(|axis| low[axis] - place.at[axis]);
            }
        }
        // A hair inside: sums of the box's numbers are not exact.
        let hair = |axis: usize| 1e-4 * size[axis];
        std::array::from_fn(|axis| at[axis].clamp(low[axis] + hair(axis), low[axis] + size[axis] - hair(axis)))
    }
}

fn radius_of(wick: &WickSource) -> Option<f32> {
    match wick {
        WickSource::Polyline { radius_m, .. }
        | WickSource::Curve { radius_m, .. }
        | WickSource::Points { radius_m, .. }
        | WickSource::Ring { radius_m, .. } => Some(*radius_m),
        WickSource::Mesh { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn torch() -> Scene {
        lucerna::scene::builtin("torch").unwrap().scene
    }

    fn points(scene: &Scene, wick: usize) -> &[[f32; 3]] {
        scene.fires[0].wicks[wick].points()
    }

    #[test]
    fn clicks_draw_a_wick_and_keys_change_it() {
        let (mut scene, mut edit) = (torch(), WickEdit::default());
        let before = scene.fires[0].wicks.len();
        for x in [0.0, 0.1, 0.2] {
            edit.add(&mut scene, [x, 0.05, 0.0]);
        }
        assert_eq!(scene.fires[0].wicks.len(), before + 1);
        assert_eq!(points(&scene, before), [[0.0, 0.05, 0.0], [0.1, 0.05, 0.0], [0.2, 0.05, 0.0]]);
        lucerna::scene::validate(&scene).unwrap();
        edit.chosen = Some(Handle { fire: 0, wick: before, point: 0 });
        edit.insert(&mut scene);
        assert_eq!(points(&scene, before)[1], [0.05, 0.05, 0.0]);
        edit.drag(&mut scene, [0.06, 0.07, 0.01]);
        assert_eq!(points(&scene, before)[1], [0.06, 0.07, 0.01]);
        // A point far away is brought back into the air.
        edit.drag(&mut scene, [9.0, -9.0, 0.0]);
        lucerna::scene::validate(&scene).unwrap();
        for left in (0..4).rev() {
            edit.delete(&mut scene);
            assert_eq!(scene.fires[0].wicks.get(before).map_or(0, |wick| wick.points().len()), left);
        }
        assert_eq!((scene.fires[0].wicks.len(), edit.chosen), (before, None));
        // The last wick stays.
        scene.fires[0].wicks = vec![WickSource::Polyline { points: vec![[0.0; 3]], radius_m: 0.01 }];
        edit.chosen = Some(Handle { fire: 0, wick: 0, point: 0 });
        edit.delete(&mut scene);
        assert_eq!(points(&scene, 0).len(), 1);
    }

    #[test]
    fn the_nearest_point_within_reach_is_chosen() {
        let scene = torch();
        let flat = |_: usize, at: [f32; 3]| Some(Vec2::new(at[0], at[1]) * 1000.0);
        let [x, y, _] = points(&scene, 2)[2];
        let mouse = Vec2::new(x, y) * 1000.0;
        let found = WickEdit::near(&scene, mouse, flat).expect("a point");
        assert_eq!(points(&scene, found.wick)[found.point][0], x);
        assert_eq!(WickEdit::near(&scene, mouse + Vec2::new(500.0, 0.0), flat), None);
    }

    #[test]
    fn points_of_fires_that_stand_or_move_elsewhere_are_met_there() {
        let mut scene = torch();
        scene.fires[0].at = vec![[0.1, 0.0, 0.05]];
        scene.fires[0].turns_deg = vec![30.0];
        let mut world =
            World::new(lucerna::scene::LoadedScene::from_scene(scene.clone(), "".as_ref()).unwrap()).unwrap();
        let pose =
            lucerna::flame::Pose { translation: Vec3::new(0.02, 0.1, 0.0), rotation: Quat::from_rotation_z(0.3) };
        world.place(0, pose).unwrap();
        world.step(1.0 / 60.0).unwrap();
        let stand = Stand::of(&scene, &world, 0);
        let place = scene.fires[0].places().next().unwrap();
        for at in scene.fires[0].wicks[0].points() {
            let expected = pose.point(place.point(*at).into());
            assert!(stand.in_world(*at).distance(expected) < 1e-5);
            assert!(Vec3::from(stand.in_fire(expected)).distance(Vec3::from(*at)) < 1e-5);
        }
    }

    #[test]
    fn a_chosen_point_that_is_gone_is_forgotten() {
        let (mut scene, mut edit) = (torch(), WickEdit { fire: 7, ..WickEdit::default() });
        edit.chosen = Some(Handle { fire: 0, wick: 99, point: 0 });
        edit.refresh(&mut scene);
        assert_eq!((edit.chosen, edit.fire), (None, 0));
    }
}
