//! Level of detail: which fires burn for themselves and which follow another, within a budget.
//!
//! It depends on the camera, the budget and the fires alone, never on measured time, so that a replay with the same
//! calls gives the same bits.

use crate::airs::Plan;
use glam::Vec3;
use lucerna_flame::{Detail, FlameError, Flames, Follow};
use lucerna_frame::Camera;
use lucerna_scene::{Budget, LoadedScene};
use std::ops::Range;

/// A fire follows only where there are at least as many of its kind.
const FEWEST: usize = 3;
/// Height of the picture in which sizes are told, pixels.
const PICTURE_PX: f32 = 1080.0;
/// Flames lower than this have fewer vertices, pixels: a ring of 8 instead of 16 then is off by a quarter of a pixel.
const COARSE_PX: f32 = 24.0;
/// Height of a flame over the distance of its roots from the wick: that of the built-in candles and torches.
const HEIGHT: f32 = 15.0;
/// How much more a fire counts that burns for itself, so that none goes to and fro.
const KEEPS: f32 = 1.25;
/// How much less a fire counts that is behind the camera: its light is still seen.
const BEHIND: f32 = 0.25;
/// Parts into which delays are cut.
const DELAYS: usize = 89;

/// A copy of a fire, or several flames that share a box.
#[derive(Clone, Debug)]
struct Unit {
    middle: Vec3,
    width_m: f32,
    flames: Range<usize>,
    air: usize,
    cells: u64,
    /// First flame of the copy that it can follow; none for those that always burn for themselves.
    kind: Option<usize>,
    /// It burns for itself.
    own: bool,
    is_coarse: bool,
    /// How much it counts now.
    weight: f32,
}

/// All units, and what they may cost.
#[derive(Clone, Debug, Default)]
pub(crate) struct Details {
    pub(crate) budget: Option<Budget>,
    pub(crate) view: Camera,
    units: Vec<Unit>,
    order: Vec<usize>,
    /// By box of air: the first of the flames that sleep with it, where they can.
    sleepers: Vec<Option<usize>>,
    /// Cells of the airs that are always stepped.
    always: u64,
}

impl Details {
    /// Every fire burning for itself.
    pub(crate) fn new(loaded: &LoadedScene, plan: &Plan) -> Self {
        let scene = &loaded.scene;
        let mut shared = vec![0_usize; plan.airs.len()];
        plan.of.iter().flatten().for_each(|&air| shared[air] += 1);
        let cells = |air: usize| plan.airs[air].air.cells.iter().map(|&n| u64::from(n)).product::<u64>();
        let mut units = Vec::new();
        let mut first = 0;
        for ((fire, airs), wicks) in scene.fires.iter().zip(&plan.of).zip(&loaded.wicks) {
            let has_own = |air: usize| fire.air.is_some() && fire.motion.is_none() && shared[air] == 1;
            let candidates = airs.iter().filter(|&&air| has_own(air)).count();
            let mut kind = None;
            for (place, &air) in fire.places().zip(airs) {
                let flames = first..first + wicks.len();
                first = flames.end;
                let can_follow = candidates >= FEWEST && has_own(air);
                units.push(Unit {
                    middle: Vec3::from(place.at),
                    width_m: fire.skeletons.width_m,
                    air,
                    cells: cells(air),
                    kind: kind.filter(|_| can_follow),
                    own: true,
                    is_coarse: false,
                    weight: 0.0,
                    flames: flames.clone(),
                });
                // The first of a kind burns for all.
                if can_follow && kind.is_none() {
                    kind = Some(flames.start);
                }
            }
        }
        let followers: u64 = units.iter().filter(|unit| unit.kind.is_some()).map(|unit| unit.cells).sum();
        let always = (0..plan.airs.len()).map(cells).sum::<u64>() - followers;
        let order = (0..units.len()).collect();
        let mut sleepers = vec![None; plan.airs.len()];
        for unit in units.iter().filter(|unit: &&Unit| unit.kind.is_some()) {
            sleepers[unit.air] = Some(unit.flames.start);
        }
        Self { budget: scene.detail, view: scene.camera_at(0.0), units, order, sleepers, always }
    }

    /// As `new`, with the view as it was; the budget, too, where the scene says none.
    pub(crate) fn renewed(&self, loaded: &LoadedScene, plan: &Plan) -> Self {
        let next = Self::new(loaded, plan);
        Self { budget: next.budget.or(self.budget), view: self.view, ..next }
    }

    /// Whether the box of air is to be stepped.
    pub(crate) fn is_due(&self, flames: &Flames, air: usize) -> bool {
        !self.sleepers.get(air).copied().flatten().is_some_and(|flame| flames.is_asleep(flame))
    }

    /// Whether anything may sleep at all.
    pub(crate) fn is_on(&self) -> bool {
        self.budget.is_some()
    }

    /// Starts to record what may be followed.
    pub(crate) fn start(&self, flames: &mut Flames) -> Result<(), FlameError> {
        if self.budget.is_some() {
            for unit in &self.units {
                // All flames of the copy that is followed: as many as this one has.
                let Some(kind) = unit.kind else { continue };
                (kind..kind + unit.flames.len()).try_for_each(|flame| flames.record(flame))?;
            }
        }
        Ok(())
    }

    /// Chooses who burns and who follows, and how finely each is drawn.
    pub(crate) fn choose(&mut self, flames: &mut Flames) -> Result<(), FlameError> {
        let Some(budget) = self.budget else { return Ok(()) };
        let eye = Vec3::from(self.view.eye);
        let forward = (Vec3::from(self.view.target) - eye).normalize_or(Vec3::NEG_Z);
        let pixels = PICTURE_PX / (2.0 * (0.5 * self.view.fov_y_deg.to_radians()).tan());
        let size_px = |unit: &Unit| {
            let way = unit.middle - eye;
            let size = HEIGHT * unit.width_m * pixels / way.length().max(self.view.near_m);
            if way.dot(forward) < 0.0 { BEHIND * size } else { size }
        };
        for unit in &mut self.units {
            unit.weight = size_px(unit) * if unit.own { KEEPS } else { 1.0 };
        }
        let units = &self.units;
        self.order.sort_unstable_by(|&a, &b| units[b].weight.total_cmp(&units[a].weight).then(a.cmp(&b)));
        let mut cells = budget.cell_steps.saturating_sub(self.always);
        let least: u64 = units.iter().map(|unit| counts(flames, unit)[1]).sum();
        let mut vertices = budget.vertices.saturating_sub(least);
        for i in 0..self.order.len() {
            let unit = &self.units[self.order[i]];
            // Large enough to be seen, and paid for.
            let [fine, coarse] = counts(flames, unit);
            let large = size_px(unit) > if unit.is_coarse { KEEPS * COARSE_PX } else { COARSE_PX };
            let more = fine.saturating_sub(coarse);
            let is_coarse = !large || more > vertices;
            if !is_coarse {
                vertices -= more;
            }
            let mut own = true;
            if let Some(kind) = unit.kind {
                let burns = unit.flames.clone().all(|flame| flames.is_steady(flame));
                let ready =
                    burns && (0..unit.flames.len()).all(|i| flames.is_recorded(kind + i) && flames.is_steady(kind + i));
                own = !ready || unit.cells <= cells;
                if own {
                    cells = cells.saturating_sub(unit.cells);
                }
            }
            let number = self.order[i];
            let unit = &mut self.units[number];
            (unit.own, unit.is_coarse) = (own, is_coarse);
            for (i, flame) in unit.flames.clone().enumerate() {
                let follows = unit.kind.filter(|_| !own).map(|kind| Follow {
                    flame: kind + i,
                    // Scattered evenly over the recording, whatever the number of copies.
                    delay: ((number * 55) % DELAYS) as f32 / DELAYS as f32,
                    quarter_turns: (number % 4) as u8,
                });
                flames.set_detail(flame, Detail { follows, is_coarse })?;
            }
        }
        Ok(())
    }

    /// Which units burn for themselves, and which are coarse.
    pub(crate) fn saved(&self) -> Vec<(bool, bool)> {
        self.units.iter().map(|unit| (unit.own, unit.is_coarse)).collect()
    }

    /// Takes over what was saved; says no where that cannot be.
    pub(crate) fn restore(&mut self, saved: &[(bool, bool)], budget: Option<Budget>, view: Camera) -> bool {
        let fits = saved.len() == self.units.len() && is_view(&view);
        if fits {
            for (unit, saved) in self.units.iter_mut().zip(saved) {
                (unit.own, unit.is_coarse) = *saved;
            }
            (self.budget, self.view) = (budget, view);
        }
        fits
    }
}

/// Vertices of a unit's attached flames: fine and coarse.
fn counts(flames: &Flames, unit: &Unit) -> [u64; 2] {
    flames.vertex_counts(unit.flames.start).map(|count| (count * unit.flames.len()) as u64)
}

/// Whether a camera can be looked through.
pub(crate) fn is_view(view: &Camera) -> bool {
    let numbers = view.eye.iter().chain(&view.target);
    numbers.copied().all(f32::is_finite)
        && (1.0..=170.0).contains(&view.fov_y_deg)
        && (1e-6..=1e6).contains(&view.near_m)
}
