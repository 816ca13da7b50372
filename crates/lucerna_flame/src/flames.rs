//! All flames of a world, and what is drawn of them.

use crate::air::Airs;
use crate::detail::Recording;
use crate::flame::{Flame, SavedFlame, Source};
use crate::fuel::FuelFunction;
use crate::light::{FlameLight, LightGroup, OwnLight, add_light};
use crate::random::{Fnv, hash};
use crate::surface::{ControlNet, PlanKey, SurfacePlan, Surfaces};
use crate::{FlameError, FlameSettings, combustion};
use lucerna_frame::{FlameDraw, FlameGrid, FlameNet, FlameNets, FlameShade, FlameVertex, Light};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The most flames of one world.
///
/// With twelve free flames each, a renderer can still number all surfaces with 15 bits.
pub const MAX_FLAMES: usize = 2520;

/// A number that no other grids of this program have: one renderer can serve several worlds.
fn new_grid_revision() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

/// The state of flames: plain data, to be written in any format that serde knows. What is read is not trusted.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SavedFlames {
    time_s: f64,
    steps: u64,
    seed: u64,
    flames: Vec<SavedFlame>,
    recordings: Vec<Recording>,
}

/// Flames that burn in one air or in several.
///
/// For every fixed step of the air: [`sources`](Self::sources) before it, [`step`](Self::step) after
/// it; once a frame [`build`](Self::build), then read the slices. Flames are worked on in parallel; the results, and
/// their order, do not depend on the number of threads.
///
/// ```
/// use lucerna_flame::{FlameSettings, Flames, UniformAir, WickShape};
///
/// let wick = WickShape::Polyline { points: vec![[0.0; 3]], radius_m: 0.001 };
/// let mut flames = Flames::new(vec![FlameSettings::new(wick)], 1)?;
/// let up = UniformAir {
///     velocity_m_s: [0.0, 0.4, 0.0].into(),
///     low_m: [-1.0; 3].into(),
///     high_m: [1.0; 3].into(),
/// };
/// for _ in 0..60 {
///     flames.step(&up, 1.0 / 60.0);
/// }
/// flames.build();
/// assert_eq!(flames.draws().len(), 1);
/// assert!(flames.vertices().iter().any(|v| v.position[1] > 0.03));
/// # Ok::<(), lucerna_flame::FlameError>(())
/// ```
#[derive(Debug, Default)]
pub struct Flames {
    pub(crate) flames: Vec<Flame>,
    plans: Vec<(Arc<SurfacePlan>, u32)>,
    /// What a renderer needs of each plan.
    grids: Vec<FlameGrid>,
    grid_revision: u64,
    surfaces: Surfaces,
    seed: u64,
    time_s: f64,
    steps: u64,
    vertices: Vec<FlameVertex>,
    points: Vec<[f32; 4]>,
    nets: Vec<FlameNet>,
    indices: Vec<u32>,
    draws: Vec<FlameDraw>,
    shades: Vec<FlameShade>,
    /// Flames over overlapping wicks share their lights; which group each flame is in.
    light_groups: Vec<LightGroup>,
    group_of: Vec<usize>,
    /// The flames that burn in each air.
    in_air: Vec<Vec<usize>>,
    /// What followers can follow.
    pub(crate) recordings: Vec<Recording>,
    lights: Vec<Light>,
    flame_lights: Vec<FlameLight>,
}

impl Flames {
    /// Lights flames. Everything random is drawn from `seed`.
    ///
    /// # Errors
    /// When there are too many flames, or a setting is out of its range.
    pub fn new(settings: Vec<FlameSettings>, seed: u64) -> Result<Self, FlameError> {
        Self::light(settings, seed, &[])
    }

    /// Lights flames; those whose wick is that of the same flame of `old` take over its centreline.
    fn light(settings: Vec<FlameSettings>, seed: u64, old: &[Flame]) -> Result<Self, FlameError> {
        let mut flames = Self { seed, grid_revision: new_grid_revision(), ..Self::default() };
        if settings.len() > MAX_FLAMES {
            return Err(FlameError::Count { field: "fires.wicks", count: settings.len(), allowed: "up to 2520" });
        }
        for (i, settings) in settings.iter().enumerate() {
            if settings.air >= MAX_FLAMES {
                let (field, value) = ("air", settings.air as f64);
                return Err(FlameError::OutOfRange { field, value, allowed: "below 2520" });
            }
            flames.in_air.resize_with(flames.in_air.len().max(settings.air + 1), Vec::new);
            flames.in_air[settings.air].push(i);
        }
        for flames in &flames.in_air {
            combustion(flames.iter().map(|&flame| &settings[flame].drive)).map_err(|error| match error {
                FlameError::Fuels { flame } => FlameError::Fuels { flame: flames[flame] },
                other => other,
            })?;
        }
        for (i, settings) in settings.into_iter().enumerate() {
            let seed = hash(seed ^ hash(i as u64));
            let known = old.get(i).filter(|old| old.settings.wick == settings.wick);
            let known = known.map(|old| Arc::clone(&old.centreline));
            let flame = Flame::new(settings, seed, known, |key| flames.plan(key))?;
            flames.group(&flame);
            flames.flames.push(flame);
        }
        Ok(flames)
    }

    /// Changes the settings. Flames whose wick and skeletons stay the same go on burning.
    ///
    /// # Errors
    /// As [`new`](Self::new); then nothing has changed.
    pub fn set(&mut self, settings: Vec<FlameSettings>) -> Result<(), FlameError> {
        let mut next = Self::light(settings, self.seed, &self.flames)?;
        for (flame, old) in next.flames.iter_mut().zip(&self.flames) {
            flame.inherit(old);
        }
        (next.time_s, next.steps, next.surfaces) = (self.time_s, self.steps, self.surfaces);
        *self = next;
        Ok(())
    }

    /// Puts a flame among those whose wicks it overlaps, or begins a group.
    fn group(&mut self, flame: &Flame) {
        let (center, length_m) = flame.roots.middle_and_length();
        let found = self.light_groups.iter().position(|group| group.takes(center, length_m));
        self.group_of.push(found.unwrap_or(self.light_groups.len()));
        if found.is_none() {
            self.light_groups.push(LightGroup::new(center, length_m));
        }
    }

    /// The plan for surfaces of a size, made once; its triangles go to the shared index buffer.
    fn plan(&mut self, key: PlanKey) -> Result<Arc<SurfacePlan>, FlameError> {
        if let Some((plan, _)) = self.plans.iter().find(|(plan, _)| plan.key == key) {
            return Ok(Arc::clone(plan));
        }
        let plan = Arc::new(SurfacePlan::new(key)?);
        self.plans.push((Arc::clone(&plan), self.indices.len() as u32));
        self.grids.push(plan.tables());
        self.indices.extend_from_slice(plan.indices());
        Ok(plan)
    }

    /// Moves the roots with the airs and finds what they do to them in the coming step.
    pub fn sources(&mut self, airs: &impl Airs) {
        let (time_s, steps) = (self.time_s, self.steps);
        self.flames.par_iter_mut().for_each(|flame| flame.find_sources(airs.air(flame.settings.air), time_s, steps));
    }

    /// What the roots of all flames in an air do to it in the coming step, in the order of the flames: their pushes
    /// and heat.
    pub fn sources_in(&self, air: usize) -> impl Iterator<Item = &Source> {
        self.in_air(air).flat_map(|flame| &flame.doings.sources)
    }

    /// The flames that burn in an air.
    pub(crate) fn in_air(&self, air: usize) -> impl Iterator<Item = &Flame> {
        self.in_air.get(air).into_iter().flatten().map(|&flame| &self.flames[flame])
    }

    fn flame_mut(&mut self, flame: usize) -> Result<&mut Flame, FlameError> {
        let count = self.flames.len();
        self.flames.get_mut(flame).ok_or(FlameError::NoFlame { flame, count })
    }

    /// Sets a flame on fire, by its number in the settings, where it has fuel left. It grows to its strength in
    /// [`Life::kindle_s`](crate::Life::kindle_s).
    ///
    /// # Errors
    /// When there is no such flame.
    pub fn ignite(&mut self, flame: usize) -> Result<(), FlameError> {
        self.flame_mut(flame)?.fire.ignite();
        Ok(())
    }

    /// Puts a flame out; it dies down in [`Life::fade_s`](crate::Life::fade_s). What it has left of its own heat does
    /// not light it again.
    ///
    /// # Errors
    /// When there is no such flame.
    pub fn extinguish(&mut self, flame: usize) -> Result<(), FlameError> {
        self.flame_mut(flame)?.fire.extinguish();
        Ok(())
    }

    /// Whether a flame is lit. One that was just put out is not, though it still fades; nor is one that is not there.
    #[must_use]
    pub fn is_lit(&self, flame: usize) -> bool {
        self.flames.get(flame).is_some_and(|flame| flame.fire.lit)
    }

    /// Spreads a flame's fuel by a function of the user's, in place of [`Fuel::distribution`](crate::Fuel): a factor,
    /// 0 to 1000, by the place u in -1..1 along the wick and the time in s. With root forces it multiplies the
    /// strength; with combustion, the rate of an even spread, so that a function that is 1 everywhere lets in the
    /// rate that was set. It stays while the wick does, and is not part of what is hashed or saved: the same arguments
    /// must give the same number, or replays differ.
    ///
    /// ```
    /// # use lucerna_flame::{FlameSettings, Flames, WickShape};
    /// let wick = WickShape::Polyline { points: vec![[-0.1, 0.0, 0.0], [0.1, 0.0, 0.0]], radius_m: 0.01 };
    /// let mut flames = Flames::new(vec![FlameSettings::new(wick)], 1)?;
    /// // A wave that runs along the wick.
    /// flames.set_fuel_function(0, |u, time_s| 1.0 + 0.5 * (6.0 * u - 3.0 * time_s as f32).sin())?;
    /// # Ok::<(), lucerna_flame::FlameError>(())
    /// ```
    ///
    /// # Errors
    /// When there is no such flame.
    pub fn set_fuel_function(
        &mut self,
        flame: usize,
        function: impl Fn(f32, f64) -> f32 + Send + Sync + 'static,
    ) -> Result<(), FlameError> {
        self.flame_mut(flame)?.function = Some(FuelFunction(Arc::new(function)));
        Ok(())
    }

    /// Back to [`Fuel::distribution`](crate::Fuel).
    ///
    /// # Errors
    /// When there is no such flame.
    pub fn clear_fuel_function(&mut self, flame: usize) -> Result<(), FlameError> {
        self.flame_mut(flame)?.function = None;
        Ok(())
    }

    /// All that makes the flames go on as they would have, together with their settings and the airs. Functions of
    /// the user's are no part of it.
    #[must_use]
    pub fn save(&self) -> SavedFlames {
        let flames = self.flames.iter().map(Flame::save).collect();
        let recordings = self.recordings.clone();
        SavedFlames { time_s: self.time_s, steps: self.steps, seed: self.seed, flames, recordings }
    }

    /// Goes on from what was saved of flames with the same settings and seed.
    ///
    /// # Errors
    /// [`FlameError::Saved`] where it was saved from others, or holds what cannot be. The flames are then of no use.
    pub fn restore(&mut self, saved: &SavedFlames) -> Result<(), FlameError> {
        if saved.seed != self.seed || saved.flames.len() != self.flames.len() || !(0.0..=1e12).contains(&saved.time_s) {
            return Err(FlameError::Saved { flame: None });
        }
        (self.time_s, self.steps) = (saved.time_s, saved.steps);
        let count = self.flames.len();
        for (number, (flame, saved)) in self.flames.iter_mut().zip(&saved.flames).enumerate() {
            if !flame.restore(saved, count) {
                return Err(FlameError::Saved { flame: Some(number) });
            }
        }
        if !self.takes(&saved.recordings) {
            return Err(FlameError::Saved { flame: None });
        }
        self.recordings.clone_from(&saved.recordings);
        Ok(())
    }

    /// Emits, carries and retires particles, after the airs have made a step of `dt_s` seconds.
    pub fn step(&mut self, airs: &impl Airs, dt_s: f32) {
        self.flames.par_iter_mut().for_each(|flame| flame.step(airs.air(flame.settings.air), dt_s));
        self.record_nets(dt_s);
        self.time_s += f64::from(dt_s);
        self.steps += 1;
    }

    /// Chooses where vertices are made, from the next [`build`](Self::build) on. Nothing that burns depends on it.
    pub fn set_surfaces(&mut self, surfaces: Surfaces) {
        self.surfaces = surfaces;
    }

    /// Makes the surfaces and lights of this moment.
    pub fn build(&mut self) {
        let surfaces = self.surfaces;
        self.flames.par_iter_mut().for_each(|flame| flame.build(surfaces));
        if !self.recordings.is_empty() {
            self.show_followed();
            let followers = self.flames.par_iter_mut().filter(|flame| flame.follower.follow.is_some());
            followers.for_each(|flame| flame.build_follower(surfaces));
        }
        self.vertices.clear();
        self.points.clear();
        self.nets.clear();
        self.draws.clear();
        self.shades.clear();
        self.lights.clear();
        self.flame_lights.clear();
        self.light_groups.iter_mut().for_each(LightGroup::clear);
        self.reserve(surfaces);
        let mut first_vertex = 0;
        for (flame, &group) in self.flames.iter().zip(&self.group_of) {
            let mut own = OwnLight::new(flame.roots.middle_and_length().0);
            for (surface, net, shade, free) in flame.surfaces() {
                let plan = flame.drawn_plan(free);
                let grid = self.plans.iter().position(|(p, _)| Arc::ptr_eq(p, plan)).unwrap_or(0);
                let index = self.draws.len() as u32;
                if surfaces == Surfaces::Vertices {
                    self.vertices.extend(surface.vertices.iter().map(|v| FlameVertex { flame: index, ..*v }));
                } else {
                    self.nets.push(FlameNet { grid: grid as u32, first_point: self.points.len() as u32 });
                    let heights = surface.columns.iter().cycle();
                    self.points.extend(net.iter().zip(heights).map(|(&[x, y, z], &height)| [x, y, z, height]));
                }
                self.draws.push(FlameDraw {
                    first_vertex,
                    vertex_count: plan.vertex_count() as u32,
                    first_index: self.plans[grid].1,
                    index_count: plan.indices().len() as u32,
                });
                first_vertex += plan.vertex_count() as u32;
                self.shades.push(shade);
                add_light(&surface.sections, &shade, flame.body, free, &mut self.light_groups[group], &mut own);
            }
            self.flame_lights.push(own.finish(flame.fire.lit, flame.radiated_w()));
        }
        self.lights.extend(self.light_groups.iter().flat_map(LightGroup::lights));
    }

    /// Memory for all that can burn at once, so that nothing is allocated when a tip breaks away.
    fn reserve(&mut self, surfaces: Surfaces) {
        let counts = self.flames.iter().map(Flame::most);
        let [draws, vertices, points] = counts.fold([0; 3], |sum, most| std::array::from_fn(|i| sum[i] + most[i]));
        self.draws.reserve(draws);
        self.shades.reserve(draws);
        self.flame_lights.reserve(self.flames.len());
        self.lights.reserve(3 * self.light_groups.len());
        if surfaces == Surfaces::Vertices {
            self.vertices.reserve(vertices);
        } else {
            self.nets.reserve(draws);
            self.points.reserve(points);
        }
    }

    /// Simulated time, s.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.time_s
    }
    /// The vertices of all surfaces, one after the other; none where the renderer is to make them.
    #[must_use]
    pub fn vertices(&self) -> &[FlameVertex] {
        &self.vertices
    }
    /// The control nets of all surfaces, where the renderer is to make the vertices.
    #[must_use]
    pub fn nets(&self) -> Option<FlameNets<'_>> {
        (self.surfaces == Surfaces::Nets).then_some(FlameNets {
            grids: &self.grids,
            grid_revision: self.grid_revision,
            points: &self.points,
            nets: &self.nets,
        })
    }
    /// The control nets of all surfaces after [`build`](Self::build), wherever the vertices are made, in the order of
    /// [`draws`](Self::draws).
    pub fn control_nets(&self) -> impl Iterator<Item = ControlNet<'_>> {
        self.flames.iter().flat_map(|flame| {
            flame.surfaces().map(move |(_, net, _, is_free)| flame.drawn_plan(is_free).net(net, is_free))
        })
    }
    /// Triangle indices, relative to each flame's first vertex.
    #[must_use]
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }
    /// One entry for each surface: attached flames and free ones.
    #[must_use]
    pub fn draws(&self) -> &[FlameDraw] {
        &self.draws
    }
    /// How each surface is shaded, in the order of [`draws`](Self::draws).
    #[must_use]
    pub fn shades(&self) -> &[FlameShade] {
        &self.shades
    }
    /// Up to three lights, from root to tip, for each group of flames whose wicks overlap.
    #[must_use]
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }
    /// What each flame gives off, in the order of the settings, its free flames included.
    #[must_use]
    pub fn flame_lights(&self) -> &[FlameLight] {
        &self.flame_lights
    }
    /// For each of [`lights`](Self::lights): its group of flames, and its part of the group, from 0 at the root to 2 at
    /// the tip.
    pub fn light_parts(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let groups = self.light_groups.iter().enumerate();
        groups.flat_map(|(group, lights)| lights.bright_parts().map(move |part| [group, part]))
    }
    /// A hash of all state that the next step depends on.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        let mut fnv = Fnv::new();
        fnv.word(self.seed);
        fnv.word(self.time_s.to_bits());
        fnv.word(self.steps);
        self.flames.iter().for_each(|f| f.hash(&mut fnv));
        fnv.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::WickShape;

    fn flame(x: f32) -> FlameSettings {
        FlameSettings::new(WickShape::Vertices(vec![[0.0; 3], [x, 0.0, 0.0]]))
    }

    #[test]
    fn a_wick_that_stays_is_not_traced_again() {
        let mut flames = Flames::new(vec![flame(0.1), flame(0.2)], 1).expect("flames");
        let before: Vec<_> = flames.flames.iter().map(|f| Arc::clone(&f.centreline)).collect();
        let mut wider = flame(0.1);
        wider.skeletons.width_m *= 2.0;
        flames.set(vec![wider, flame(0.3)]).expect("set");
        let same = |i: usize| Arc::ptr_eq(&before[i], &flames.flames[i].centreline);
        assert!(same(0) && !same(1));
    }

    #[test]
    fn surfaces_can_be_numbered() {
        let most = (1 << 15) - 2;
        assert!(MAX_FLAMES * (1 + crate::flame::MAX_FREE) <= most);
        let settings = vec![flame(0.1); MAX_FLAMES + 1];
        let error = Flames::new(settings, 1).expect_err("too many").to_string();
        assert!(error.contains(&MAX_FLAMES.to_string()), "{error}");
    }
}
