//! The world: a scene that burns.

use crate::air;
use crate::airs::{Airs, Plan};
use crate::detail::{Details, is_view};
use crate::error::WorldError;
use crate::movers::Movers;
use crate::report::{DebugLines, StepSummary};
use crate::save::{SaveError, Saved, fingerprint};
use lucerna_flame::{FlameSettings, Flames, Pose, Surfaces};
use lucerna_fluid::Fluid;
use lucerna_frame::{Camera, Frame, LineVertex};
use lucerna_scene::{Budget, LoadedScene, Scene};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

/// Most fixed steps of one call of [`World::step`]: a slow machine falls behind rather than seize up.
pub const MAX_STEPS: u32 = 8;

/// A number that no other set of meshes of this program has: one renderer can serve several worlds.
fn new_mesh_revision() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

/// A scene that burns.
pub struct World {
    scene: LoadedScene,
    airs: Airs,
    flames: Flames,
    movers: Movers,
    details: Details,
    /// Time that was asked for but not yet stepped, s.
    owed_s: f64,
    surfaces: Surfaces,
    debug: DebugLines,
    lines: Vec<LineVertex>,
    mesh_revision: u64,
}

impl std::fmt::Debug for World {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("World")
            .field("scene", &self.scene.scene.name)
            .field("time_s", &self.time_s())
            .finish_non_exhaustive()
    }
}

impl World {
    /// Lights the fires of a scene.
    ///
    /// # Errors
    /// When the scene says something that is not possible; the error names the field.
    pub fn new(scene: LoadedScene) -> Result<Self, WorldError> {
        let plan = Plan::new(&scene.scene)?;
        let mut flames = Flames::new(settings(&scene, &plan)?, scene.scene.seed)?;
        let movers = Movers::new(&scene)?;
        movers.start(&mut flames)?;
        let details = Details::new(&scene, &plan);
        details.start(&mut flames)?;
        let mut world = Self {
            scene,
            airs: Airs::new(plan)?,
            flames,
            movers,
            details,
            owed_s: 0.0,
            surfaces: Surfaces::default(),
            debug: DebugLines::default(),
            lines: Vec::new(),
            mesh_revision: new_mesh_revision(),
        };
        world.build();
        Ok(world)
    }

    /// Goes on by `dt_s` seconds in fixed steps of the scene's `time_step_s`, and makes the surfaces.
    ///
    /// Time that does not fill a step is kept for the next call; at most [`MAX_STEPS`] are run.
    ///
    /// # Errors
    /// When `dt_s` is negative or not finite, or the air refuses to move.
    pub fn step(&mut self, dt_s: f32) -> Result<StepSummary, WorldError> {
        if !(0.0..=1e6).contains(&dt_s) {
            return Err(WorldError::Time { field: "dt_s", value: dt_s, allowed: "0 to 1e6" });
        }
        let step_s = self.scene.scene.air.time_step_s;
        let owed_s = self.owed_s + f64::from(dt_s);
        // A hair of tolerance: 1/60 s asked for in `f32` is one step of 1/60 s.
        let due = (owed_s / f64::from(step_s) + 1e-4).floor();
        // A step that fails leaves its time owed, and that of the steps after it.
        self.owed_s = owed_s;
        let steps = due.min(f64::from(MAX_STEPS)) as u32;
        let dropped = (due - f64::from(steps)).min(f64::from(u32::MAX)) as u32;
        let mut summary = StepSummary { steps, dropped, ..StepSummary::default() };
        if steps > 0 {
            self.details.choose(&mut self.flames)?;
        }
        for done in 1..=steps {
            let start = Instant::now();
            let time_s = self.flames.time_s() + f64::from(step_s);
            self.movers.advance(&mut self.flames, time_s, steps + 1 - done, step_s)?;
            self.airs.carry(&self.movers, step_s)?;
            self.flames.sources(&self.airs);
            let (divergence, cell_steps) = self.airs.step(&self.flames, &self.details, step_s)?;
            summary.cell_steps += cell_steps;
            summary.divergence = summary.divergence.max(divergence);
            summary.times.fluid_ms += ms_since(start);
            let start = Instant::now();
            self.flames.step(&self.airs, step_s);
            summary.times.skeletons_ms += ms_since(start);
            self.owed_s = (owed_s - f64::from(done) * f64::from(step_s)).max(0.0);
        }
        self.owed_s = (owed_s - due * f64::from(step_s)).max(0.0);
        let start = Instant::now();
        if steps > 0 {
            self.build();
        }
        summary.times.nurbs_ms = ms_since(start);
        Ok(summary)
    }

    fn build(&mut self) {
        // The wireframe is drawn from vertices.
        let surfaces = if self.debug.wireframe { Surfaces::Vertices } else { self.surfaces };
        self.flames.set_surfaces(surfaces);
        self.flames.build();
        if self.movers.draw(&self.flames, &self.scene.meshes) {
            self.mesh_revision = new_mesh_revision();
        }
        self.draw_lines();
    }

    fn draw_lines(&mut self) {
        self.lines.clear();
        if self.debug.skeletons {
            self.flames.skeleton_lines(&mut self.lines);
        }
        if self.debug.control_nets {
            self.flames.net_lines(&mut self.lines);
        }
        if self.debug.wireframe {
            self.flames.wireframe_lines(&mut self.lines);
        }
        if self.debug.air_box {
            let color = [0.5, 0.5, 0.15];
            let ends = self.airs.iter().flat_map(air::edges).flatten();
            self.lines.extend(ends.map(|p| LineVertex { position: p.to_array(), color }));
        }
    }

    /// Takes over a changed scene: keeps the fire burning where only parameters changed, starts anew where the
    /// grid or the wicks did.
    ///
    /// # Errors
    /// As [`World::new`]; the world is then as it was.
    pub fn set_scene(&mut self, scene: LoadedScene) -> Result<(), WorldError> {
        let (old, new) = (&self.scene.scene, &scene.scene);
        let plan = Plan::new(new)?;
        let settings = settings(&scene, &plan)?;
        let same_fires = self.scene.wicks == scene.wicks && stand_alike(old, new) && old.seed == new.seed;
        let goes_on = same_fires && self.airs.plan.same_grids(&plan);
        let movers = if goes_on {
            self.movers.renewed(&scene, self.scene.meshes == scene.meshes)?
        } else {
            Movers::new(&scene)?
        };
        if goes_on {
            plan.airs.iter().try_for_each(|planned| air::check(&planned.air))?;
            self.flames.set(settings)?;
            self.airs.adjust(plan)?;
        } else {
            let airs = Airs::new(plan)?;
            let mut flames = Flames::new(settings, new.seed)?;
            movers.start(&mut flames)?;
            self.flames = flames;
            self.airs = airs;
            self.owed_s = 0.0;
        }
        let seen = |scene: &Scene| -> Vec<_> { scene.fires.iter().map(|f| (f.wick, f.motion.clone())).collect() };
        let same_wicks = self.scene.wicks == scene.wicks && seen(old) == seen(new);
        if self.scene.meshes != scene.meshes || old.motions != new.motions || !same_wicks {
            self.mesh_revision = new_mesh_revision();
        }
        self.movers = movers;
        self.details = self.details.renewed(&scene, &self.airs.plan);
        self.scene = scene;
        let started = self.details.start(&mut self.flames);
        self.build();
        Ok(started?)
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &LoadedScene {
        &self.scene
    }

    /// Back to time zero.
    pub fn reset(&mut self) {
        // Both were made from these settings before.
        let settings = settings(&self.scene, &self.airs.plan);
        if let Ok(Ok(flames)) = settings.map(|s| Flames::new(s, self.scene.scene.seed)) {
            self.flames = flames;
        }
        if let Ok(airs) = Airs::new(self.airs.plan.clone()) {
            self.airs = airs;
        }
        // They were placed so before.
        if let Ok(movers) = Movers::new(&self.scene)
            && movers.start(&mut self.flames).is_ok()
        {
            self.movers = movers;
        }
        self.details = self.details.renewed(&self.scene, &self.airs.plan);
        let started = self.details.start(&mut self.flames);
        debug_assert!(started.is_ok(), "{started:?}");
        self.owed_s = 0.0;
        self.build();
    }

    /// All that burns, as bytes: with the scene, enough to go on as if the world had never been stopped, bit for bit.
    /// Debug lines, where vertices are made, and functions of the user's ([`set_fuel_function`](Self::set_fuel_function))
    /// are no part of it.
    #[must_use]
    pub fn save(&self) -> Vec<u8> {
        Saved {
            scene: fingerprint(&self.scene),
            owed_s: self.owed_s,
            airs: self.airs.saved(),
            flames: self.flames.save(),
            movers: self.movers.saved(),
            budget: self.details.budget,
            view: self.details.view,
            units: self.details.saved(),
        }
        .to_bytes()
    }

    /// Goes on from what was saved of a world with this scene; camera, look and meshes may differ.
    ///
    /// ```
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// # use lucerna::World;
    /// let mut world = World::new(lucerna::scene::open("candle")?)?;
    /// world.step(0.1)?;
    /// let saved = world.save();
    /// let mut again = World::new(lucerna::scene::open("candle")?)?;
    /// again.restore(&saved)?;
    /// world.step(0.1)?;
    /// again.step(0.1)?;
    /// assert_eq!(world.state_hash(), again.state_hash());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// What is wrong with the bytes; the world is then as it was.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SaveError> {
        let saved = Saved::from_bytes(bytes)?;
        if saved.scene != fingerprint(&self.scene) {
            return Err(SaveError::Scene);
        }
        let sound = (0.0..=1e12).contains(&saved.owed_s);
        let mut airs = Airs::new(self.airs.plan.clone()).map_err(WorldError::from)?;
        airs.restore(&saved.airs)?;
        let mut flames = Flames::new(settings(&self.scene, &airs.plan)?, self.scene.scene.seed)?;
        flames.restore(&saved.flames)?;
        let mut movers = Movers::new(&self.scene)?;
        let mut details = Details::new(&self.scene, &airs.plan);
        let sound = sound && details.restore(&saved.units, saved.budget, saved.view);
        if !movers.restore(&saved.movers) || !sound {
            return Err(SaveError::Malformed);
        }
        details.start(&mut flames)?;
        (self.airs, self.flames, self.movers, self.owed_s) = (airs, flames, movers, saved.owed_s);
        self.details = details;
        self.mesh_revision = new_mesh_revision();
        self.build();
        Ok(())
    }

    /// Chooses the debug lines that [`World::frame`] carries.
    pub fn set_debug_lines(&mut self, lines: DebugLines) {
        if self.debug != lines {
            let rebuilds = self.debug.wireframe != lines.wireframe && self.surfaces != Surfaces::Vertices;
            self.debug = lines;
            if rebuilds {
                self.build();
            } else {
                self.draw_lines();
            }
        }
    }

    /// Chooses where the flames' vertices are made: here, which is the default, or by the renderer. While the
    /// wireframe is shown they are made here. Nothing that burns depends on it.
    pub fn set_surfaces(&mut self, surfaces: Surfaces) {
        if self.surfaces != surfaces {
            self.surfaces = surfaces;
            self.build();
        }
    }

    /// The first of [`airs`](Self::airs): the only one, where no fire has an air of its own.
    #[must_use]
    pub fn fluid(&self) -> &Fluid {
        lucerna_flame::Airs::air(&self.airs, 0)
    }

    /// Where the world is looked at from, from the next step on: with a budget, it chooses the level of detail. Until
    /// this is called it is the scene's camera. It is an input as [`place`](Self::place) is: replays must say the same at
    /// the same times.
    ///
    /// # Errors
    /// When nothing can be seen through the camera; the view is then as it was.
    pub fn set_view(&mut self, view: &Camera) -> Result<(), WorldError> {
        if !is_view(view) {
            return Err(WorldError::View);
        }
        self.details.view = *view;
        Ok(())
    }

    /// What the fires may cost, from the next step on; none for all that they need, which is the default unless the
    /// scene says otherwise ([`Scene::detail`](lucerna_scene::Scene::detail)). Fires that are small in the picture then
    /// follow others of their kind and have fewer vertices; they change over within a second, and only once those that
    /// they follow have burned for two seconds. A fire can follow where its copies have an air of their own each, no
    /// motion, and at least three are alike. It is an input, as [`set_view`](Self::set_view) is.
    ///
    /// # Errors
    /// None for a world that was made; the flames' own.
    pub fn set_budget(&mut self, budget: Option<Budget>) -> Result<(), WorldError> {
        if budget.is_none() && self.details.budget.is_some() {
            // Everything it takes: all fires come back.
            self.details.budget = Some(Budget { cell_steps: u64::MAX, vertices: u64::MAX });
        }
        if budget.is_some() {
            self.details.budget = budget;
        }
        Ok(self.details.start(&mut self.flames)?)
    }

    /// All boxes of air: first that of the scene, where a fire burns in it, then those that fires have of their own, in
    /// the order of the fires and their copies. There is at least one.
    pub fn airs(&self) -> impl ExactSizeIterator<Item = &Fluid> {
        self.airs.iter()
    }

    /// The flames.
    #[must_use]
    pub fn flames(&self) -> &Flames {
        &self.flames
    }

    /// Sets a flame on fire, see [`Flames::ignite`]; flames are counted through the wicks of all copies of all fires.
    ///
    /// # Errors
    /// When there is no such flame.
    pub fn ignite(&mut self, flame: usize) -> Result<(), WorldError> {
        Ok(self.flames.ignite(flame)?)
    }

    /// Puts a flame out, see [`Flames::extinguish`].
    ///
    /// # Errors
    /// When there is no such flame.
    pub fn extinguish(&mut self, flame: usize) -> Result<(), WorldError> {
        Ok(self.flames.extinguish(flame)?)
    }

    /// Spreads a flame's fuel by a function of the user's, see [`Flames::set_fuel_function`].
    ///
    /// # Errors
    /// When there is no such flame.
    pub fn set_fuel_function(
        &mut self,
        flame: usize,
        function: impl Fn(f32, f64) -> f32 + Send + Sync + 'static,
    ) -> Result<(), WorldError> {
        Ok(self.flames.set_fuel_function(flame, function)?)
    }

    /// Simulated time, s.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.flames.time_s()
    }

    /// Puts a fire, by its number in the scene, to a pose from now on, seen from where the scene places it: its wicks,
    /// and the meshes and fires that share its motion, are there after the next [`step`](Self::step). They move evenly
    /// during its fixed steps, so that the flame leans and trails and the air is stirred; a way that would need more
    /// than 30 m/s is jumped. Replays must place at the same times.
    ///
    /// ```
    /// # use lucerna::{World, flame::Pose};
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut world = World::new(lucerna::scene::open("torch")?)?;
    /// for frame in 1..=30 {
    ///     // Carried along at 0.3 m/s.
    ///     let translation = [0.3 * frame as f32 / 60.0, 0.0, 0.0].into();
    ///     world.place(0, Pose { translation, ..Pose::REST })?;
    ///     world.step(1.0 / 60.0)?;
    /// }
    /// assert_eq!(world.pose(0).map(|pose| pose.translation.x), Some(0.15));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// When there is no such fire, or the pose is not allowed ([`Pose::is_allowed`]).
    pub fn place(&mut self, fire: usize, pose: Pose) -> Result<(), WorldError> {
        self.movers.ask(fire, pose)
    }

    /// Where a fire is, seen from where the scene places it; nothing where there is no such fire.
    #[must_use]
    pub fn pose(&self, fire: usize) -> Option<Pose> {
        self.movers.pose(fire)
    }

    /// A hash of all state that the next step depends on.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        let parts = [self.flames.state_hash(), self.owed_s.to_bits()];
        self.airs().map(Fluid::state_hash).chain(parts).chain(self.movers.asked()).fold(
            0xcbf2_9ce4_8422_2325,
            |hash, part| {
                part.to_le_bytes()
                    .into_iter()
                    .fold(hash, |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
            },
        )
    }

    /// What to draw now.
    #[must_use]
    pub fn frame(&self) -> Frame<'_> {
        Frame {
            time_s: self.flames.time_s() as f32,
            flame_vertices: self.flames.vertices(),
            flame_indices: self.flames.indices(),
            flame_draws: self.flames.draws(),
            flame_nets: self.flames.nets(),
            flame_shades: self.flames.shades(),
            lights: self.flames.lights(),
            meshes: self.movers.meshes(&self.scene.meshes),
            mesh_revision: self.mesh_revision,
            lines: &self.lines,
        }
    }
}

/// Whether the fires of two scenes stand at the same places.
fn stand_alike(a: &Scene, b: &Scene) -> bool {
    a.fires.iter().map(|fire| (&fire.at, &fire.turns_deg)).eq(b.fires.iter().map(|fire| (&fire.at, &fire.turns_deg)))
}

/// One flame for each wick of each copy of each fire; checks what is not checked by flames and air.
fn settings(scene: &LoadedScene, plan: &Plan) -> Result<Vec<FlameSettings>, WorldError> {
    let step_s = scene.scene.air.time_step_s;
    if !(1e-5..=10.0).contains(&step_s) {
        return Err(WorldError::Time { field: "air.time_step_s", value: step_s, allowed: "1e-5 to 10" });
    }
    let fires = &scene.scene.fires;
    let matches = fires.len() == scene.wicks.len()
        && fires.iter().zip(&scene.wicks).all(|(fire, shapes)| fire.wicks.len() <= shapes.len());
    if !matches {
        return Err(WorldError::Wicks {
            fires: fires.len(),
            wicks: fires.iter().map(|f| f.wicks.len()).sum(),
            groups: scene.wicks.len(),
            shapes: scene.wicks.iter().map(Vec::len).sum(),
        });
    }
    let mut flames = Vec::new();
    for ((fire, wicks), airs) in fires.iter().zip(&scene.wicks).zip(&plan.of) {
        for (place, &air) in fire.places().zip(airs) {
            flames.extend(wicks.iter().map(|wick| FlameSettings {
                wick: place.wick(wick),
                drive: fire.drive,
                life: fire.life,
                fuel: fire.fuel.clone(),
                skeletons: fire.skeletons.clone(),
                surface: fire.surface,
                shade: fire.shade,
                air,
            }));
        }
    }
    Ok(flames)
}

fn ms_since(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
