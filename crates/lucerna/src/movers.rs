//! What moves in a world: fires and meshes along the scene's motions, or where the program puts them.

use crate::error::WorldError;
use lucerna_flame::{Flames, Pose};
use lucerna_frame::OpaqueMesh;
use lucerna_scene::{LoadedScene, MotionPath};
use std::ops::Range;

/// Fastest that the air's box goes along with a motion, along each axis, m/s.
const FASTEST_BOX_M_S: f32 = 100.0;

/// What moves together: a motion of the scene, or a fire that has none.
#[derive(Clone, Debug)]
struct Group {
    path: MotionPath,
    /// Where the program wants it from now on.
    asked: Option<Pose>,
    now: Pose,
    /// Where its meshes were last drawn.
    drawn: Pose,
}

/// All that moves.
#[derive(Clone, Debug, Default)]
pub(crate) struct Movers {
    groups: Vec<Group>,
    of_fire: Vec<usize>,
    of_mesh: Vec<Option<usize>>,
    of_air: Option<usize>,
    /// The flames of each fire.
    flames: Vec<Range<usize>>,
    /// The wicks that are shown, at rest, glowing; they are drawn behind the meshes of the scene.
    wicks: Vec<OpaqueMesh>,
    /// The flame of each of these wicks, and whether it was lit when it was drawn.
    lit: Vec<(usize, bool)>,
    /// The meshes and wicks where they are now; none where nothing moves and no wick is shown.
    meshes: Vec<OpaqueMesh>,
}

impl Movers {
    /// Everything at its place at time zero.
    pub(crate) fn new(loaded: &LoadedScene) -> Result<Self, WorldError> {
        let scene = &loaded.scene;
        let group = |path: MotionPath| {
            let now = path.pose(0.0);
            Group { path, asked: None, now, drawn: Pose::REST }
        };
        let mut groups: Vec<Group> = scene.motions.iter().map(|motion| group(motion.path.clone())).collect();
        let named = |name: &Option<String>| {
            let name = name.as_ref()?;
            scene.motions.iter().position(|motion| motion.name == *name)
        };
        let mut of_fire = Vec::with_capacity(scene.fires.len());
        let mut flames = Vec::with_capacity(scene.fires.len());
        let mut first = 0;
        for (fire, wicks) in scene.fires.iter().zip(&loaded.wicks) {
            of_fire.push(named(&fire.motion).unwrap_or_else(|| {
                groups.push(group(MotionPath::Still));
                groups.len() - 1
            }));
            let count = wicks.len() * fire.places().len();
            flames.push(first..first + count);
            first += count;
        }
        let mut of_mesh: Vec<Option<usize>> = scene.meshes.iter().map(|mesh| named(&mesh.motion)).collect();
        let (mut wicks, mut lit) = (Vec::new(), Vec::new());
        for ((fire, shapes), (group, range)) in scene.fires.iter().zip(&loaded.wicks).zip(of_fire.iter().zip(&flames)) {
            if !fire.wick.shown {
                continue;
            }
            let copies = fire.places().flat_map(|place| shapes.iter().map(move |shape| place.wick(shape)));
            for (shape, flame) in copies.zip(range.clone()) {
                wicks.push(shape.tube(&fire.wick, scene.look.white_k)?);
                of_mesh.push(Some(*group));
                lit.push((flame, true));
            }
        }
        let of_air = named(&scene.air.follows);
        Ok(Self { groups, of_fire, of_mesh, of_air, flames, wicks, lit, meshes: Vec::new() })
    }

    /// As `new`, but what the program has placed stays there, and so does what has been drawn, where the scene's meshes
    /// are still the same.
    pub(crate) fn renewed(&self, loaded: &LoadedScene, same_meshes: bool) -> Result<Self, WorldError> {
        let mut next = Self::new(loaded)?;
        let goes_on = same_meshes && next.wicks == self.wicks && next.of_mesh == self.of_mesh;
        if goes_on {
            next.meshes.clone_from(&self.meshes);
            next.lit.clone_from(&self.lit);
        }
        for (group, old) in next.groups.iter_mut().zip(&self.groups) {
            (group.asked, group.now) = (old.asked, old.now);
            if goes_on {
                group.drawn = old.drawn;
            }
        }
        Ok(next)
    }

    /// Puts the flames where they begin.
    pub(crate) fn start(&self, flames: &mut Flames) -> Result<(), WorldError> {
        // In no time: they jump there, and take no air along.
        self.place_all(flames, 1e-6)
    }

    fn place_all(&self, flames: &mut Flames, dt_s: f32) -> Result<(), WorldError> {
        for (&group, range) in self.of_fire.iter().zip(&self.flames) {
            let pose = self.groups[group].now;
            range.clone().try_for_each(|flame| flames.place(flame, pose, dt_s))?;
        }
        Ok(())
    }

    /// Asks for a fire to be at a pose, with all that shares its motion.
    pub(crate) fn ask(&mut self, fire: usize, pose: Pose) -> Result<(), WorldError> {
        let count = self.of_fire.len();
        let group = *self.of_fire.get(fire).ok_or(WorldError::NoFire { fire, count })?;
        if !pose.is_allowed() {
            return Err(WorldError::Pose { fire });
        }
        self.groups[group].asked = Some(pose);
        Ok(())
    }

    /// Where a fire is.
    pub(crate) fn pose(&self, fire: usize) -> Option<Pose> {
        self.of_fire.get(fire).map(|&group| self.groups[group].now)
    }

    /// Moves everything on to where it is at `time_s`, after the first of `left` fixed steps.
    pub(crate) fn advance(
        &mut self,
        flames: &mut Flames,
        time_s: f64,
        left: u32,
        step_s: f32,
    ) -> Result<(), WorldError> {
        for group in &mut self.groups {
            group.now = match &group.asked {
                Some(pose) => group.now.towards(pose, 1.0 / left.max(1) as f32),
                None => group.path.pose(time_s),
            };
        }
        self.place_all(flames, step_s)
    }

    /// How fast a box of air that rests at `rest` and is at `origin` moves in the coming step, m/s, where it goes along:
    /// the air of the scene with a motion, the air of a fire with the fire.
    pub(crate) fn air_velocity(
        &self,
        fire: Option<usize>,
        origin: glam::Vec3,
        (rest, size): ([f32; 3], [f32; 3]),
        step_s: f32,
    ) -> Option<glam::Vec3> {
        let pose = self.groups[fire.map_or(self.of_air, |fire| self.of_fire.get(fire).copied())?].now;
        let rest = glam::Vec3::from(rest);
        let middle = rest + 0.5 * glam::Vec3::from(size);
        // What has not moved is to stay to the bit.
        let target = if pose == Pose::REST { rest } else { rest + pose.point(middle) - middle };
        let most = glam::Vec3::splat(FASTEST_BOX_M_S);
        Some(((target - origin) / step_s).clamp(-most, most))
    }

    /// Moves the meshes to where they are now, lets the tips of wicks that burn glow, and says whether any has changed.
    pub(crate) fn draw(&mut self, flames: &Flames, rest: &[OpaqueMesh]) -> bool {
        let moved = self.draw_moved(rest);
        let mut changed = moved;
        for (i, (flame, was_lit)) in self.lit.iter_mut().enumerate() {
            let is_lit = flames.is_lit(*flame);
            if is_lit == *was_lit && !moved {
                continue;
            }
            *was_lit = is_lit;
            changed = true;
            for (vertex, rest) in self.meshes[rest.len() + i].vertices.iter_mut().zip(&self.wicks[i].vertices) {
                vertex.emission = if is_lit { rest.emission } else { [0.0; 3] };
            }
        }
        changed
    }

    fn draw_moved(&mut self, rest: &[OpaqueMesh]) -> bool {
        let has_moved = |group: usize| self.groups[group].drawn != self.groups[group].now;
        let is_new = self.meshes.len() != rest.len() + self.wicks.len() && !self.wicks.is_empty();
        if !is_new && !self.of_mesh.iter().flatten().any(|&group| has_moved(group)) {
            return false;
        }
        if self.meshes.len() != rest.len() + self.wicks.len() {
            self.meshes = rest.iter().chain(&self.wicks).cloned().collect();
        }
        for ((mesh, rest), group) in self.meshes.iter_mut().zip(rest.iter().chain(&self.wicks)).zip(&self.of_mesh) {
            let Some(group) = group else { continue };
            let pose = self.groups[*group].now;
            for (vertex, rest) in mesh.vertices.iter_mut().zip(&rest.vertices) {
                vertex.position = pose.point(rest.position.into()).into();
                vertex.normal = (pose.rotation * glam::Vec3::from(rest.normal)).into();
            }
        }
        self.groups.iter_mut().for_each(|group| group.drawn = group.now);
        true
    }

    /// The meshes where they are now.
    pub(crate) fn meshes<'a>(&'a self, rest: &'a [OpaqueMesh]) -> &'a [OpaqueMesh] {
        if self.meshes.is_empty() { rest } else { &self.meshes }
    }

    /// Where everything is, and where the program wants it.
    pub(crate) fn saved(&self) -> Vec<(Pose, Option<Pose>)> {
        self.groups.iter().map(|group| (group.now, group.asked)).collect()
    }

    /// Puts everything where it was saved; says no where that cannot be.
    pub(crate) fn restore(&mut self, saved: &[(Pose, Option<Pose>)]) -> bool {
        let sound =
            |(now, asked): &(Pose, Option<Pose>)| now.is_allowed() && asked.as_ref().is_none_or(Pose::is_allowed);
        let fits = saved.len() == self.groups.len() && saved.iter().all(sound);
        if fits {
            for (group, saved) in self.groups.iter_mut().zip(saved) {
                (group.now, group.asked) = *saved;
            }
        }
        fits
    }

    /// Numbers that the next step depends on: where the program wants things.
    pub(crate) fn asked(&self) -> impl Iterator<Item = u64> + '_ {
        self.groups.iter().enumerate().filter_map(|(i, group)| Some((i, group.asked?))).flat_map(|(i, pose)| {
            let numbers = pose.rotation.to_array().into_iter().chain(pose.translation.to_array());
            std::iter::once(i as u64).chain(numbers.map(|x| u64::from(x.to_bits())))
        })
    }
}
