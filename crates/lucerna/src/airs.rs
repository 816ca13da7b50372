//! All boxes of air of a world: which there are, which fires share one, and how they are stepped together.

use crate::air;
use crate::detail::Details;
use crate::error::WorldError;
use crate::movers::Movers;
use glam::Vec3;
use lucerna_flame::Flames;
use lucerna_fluid::{Combustion, Fluid, FluidBatch, FluidError, Snapshot, SnapshotError};
use lucerna_scene::{Air, FireAir, Scene};
use std::sync::{Mutex, PoisonError};

/// Which boxes of air a scene has, and in which of them each copy of each fire burns.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plan {
    /// Every box; first the scene's own, where a fire burns in it.
    pub(crate) airs: Vec<Planned>,
    /// By fire and copy: the number of its box.
    pub(crate) of: Vec<Vec<usize>>,
}

/// One box of air.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Planned {
    /// As if it were the only air of a scene.
    pub(crate) air: Air,
    /// What it has to burn.
    burning: Option<Combustion>,
    /// The fire that it goes along with; none for the air of the scene.
    fire: Option<usize>,
}

impl Planned {
    /// Whether the two need the same grid, so that the air can go on as it is.
    fn same_grid(&self, other: &Self) -> bool {
        air::same_grid(&self.air, &other.air) && self.burning == other.burning && self.fire == other.fire
    }
}

impl Plan {
    /// Fires that have an air of their own get a box for each copy. Boxes with the same cells that overlap become
    /// one, which holds both, until none overlap: fires that are near influence each other.
    ///
    /// # Errors
    /// Fires with different fuels in a box.
    pub(crate) fn new(scene: &Scene) -> Result<Self, WorldError> {
        let mut airs = Vec::new();
        let mut of: Vec<Vec<usize>> = scene.fires.iter().map(|fire| vec![0; fire.places().len()]).collect();
        if scene.fires.iter().any(|fire| fire.air.is_none()) {
            airs.push((scene.air.clone(), None));
        }
        let mut boxes = Vec::new();
        for (f, fire) in scene.fires.iter().enumerate() {
            let Some(own) = &fire.air else { continue };
            for (copy, place) in fire.places().enumerate() {
                boxes.push(OwnBox {
                    air: own.air(&scene.air, place.at),
                    own: *own,
                    motion: &fire.motion,
                    holds: vec![(f, copy)],
                });
            }
        }
        for own in joined(boxes) {
            let goes_with = own.holds[0].0;
            for (fire, copy) in own.holds {
                of[fire][copy] = airs.len();
            }
            airs.push((own.air, Some(goes_with)));
        }
        let planned = |(number, (air, fire)): (usize, (Air, Option<usize>))| {
            let fires = scene.fires.iter().zip(&of).filter(|(_, of)| of.contains(&number));
            let burning = lucerna_flame::combustion(fires.map(|(fire, _)| &fire.drive))?;
            Ok(Planned { air, burning, fire })
        };
        let airs = airs.into_iter().enumerate().map(planned).collect::<Result<_, WorldError>>()?;
        Ok(Self { airs, of })
    }

    /// Whether the two need the same grids, so that the airs can go on as they are.
    pub(crate) fn same_grids(&self, other: &Self) -> bool {
        self.of == other.of
            && self.airs.len() == other.airs.len()
            && self.airs.iter().zip(&other.airs).all(|(a, b)| a.same_grid(b))
    }
}

/// The box of one fire or of several.
struct OwnBox<'a> {
    air: Air,
    own: FireAir,
    /// What carries it.
    motion: &'a Option<String>,
    /// Fires and copies.
    holds: Vec<(usize, usize)>,
}

impl OwnBox<'_> {
    fn cell(own: &FireAir) -> [f32; 3] {
        std::array::from_fn(|axis| own.size_m[axis] / own.cells[axis] as f32)
    }

    fn low_and_high(&self) -> (Vec3, Vec3) {
        let low = Vec3::from(self.air.origin_m);
        (low, low + Vec3::from(self.air.size_m))
    }

    /// Whether both can be one: they overlap, and what is said of them is the same but for their place and size.
    fn joins(&self, other: &Self) -> bool {
        let ((low, high), (other_low, other_high)) = (self.low_and_high(), other.low_and_high());
        let rest = |own: &FireAir| (own.sides, own.vorticity_confinement, own.cooling_per_s);
        low.cmplt(other_high).all()
            && other_low.cmplt(high).all()
            && Self::cell(&self.own) == Self::cell(&other.own)
            && rest(&self.own) == rest(&other.own)
            && self.motion == other.motion
    }

    /// Grows by whole cells until it holds the other.
    fn take(&mut self, other: Self) {
        let ((low, high), (other_low, other_high)) = (self.low_and_high(), other.low_and_high());
        let (low, high) = (low.min(other_low), high.max(other_high));
        let cell = Self::cell(&self.own);
        self.air.origin_m = low.to_array();
        for (axis, cell_m) in cell.into_iter().enumerate() {
            // A hair less than a cell more is still none: sizes are not exact.
            let cells = ((high - low)[axis] / cell_m - 1e-3).ceil().max(1.0);
            (self.air.cells[axis], self.air.size_m[axis]) = (cells as u32, cells * cell_m);
        }
        self.holds.extend(other.holds);
    }
}

/// Joins boxes that overlap, from the first on.
fn joined(mut boxes: Vec<OwnBox<'_>>) -> Vec<OwnBox<'_>> {
    let mut at = 0;
    while at < boxes.len() {
        // One that grew can overlap with any: look from the start again.
        match (0..at).find(|&other| boxes[other].joins(&boxes[at])) {
            Some(other) => {
                let taken = boxes.remove(at);
                boxes[other].take(taken);
                at = other;
            }
            None => at += 1,
        }
    }
    boxes
}

/// All boxes of air. Those of a shape are stepped together.
pub(crate) struct Airs {
    pub(crate) plan: Plan,
    batches: Vec<FluidBatch>,
    /// For each batch: the numbers of its boxes.
    numbers: Vec<Vec<usize>>,
    /// For each box: its batch, and its place there.
    places: Vec<(usize, usize)>,
}

impl lucerna_flame::Airs for Airs {
    type Air = Fluid;

    fn air(&self, number: usize) -> &Fluid {
        let (batch, at) = self.places[number.min(self.places.len() - 1)];
        &self.batches[batch][at]
    }
}

impl Airs {
    /// Makes the airs, at rest or moving with the wind.
    pub(crate) fn new(plan: Plan) -> Result<Self, FluidError> {
        let mut numbers: Vec<Vec<usize>> = Vec::new();
        let mut places = Vec::with_capacity(plan.airs.len());
        for (number, planned) in plan.airs.iter().enumerate() {
            let alike = |numbers: &Vec<usize>| {
                let first = &plan.airs[numbers[0]];
                air::same_shape(&first.air, &planned.air) && first.burning == planned.burning
            };
            let batch = numbers.iter().position(alike).unwrap_or(numbers.len());
            if batch == numbers.len() {
                numbers.push(Vec::new());
            }
            places.push((batch, numbers[batch].len()));
            numbers[batch].push(number);
        }
        let batch = |numbers: &Vec<usize>| {
            let planned = numbers.iter().map(|&number| &plan.airs[number]);
            FluidBatch::new(planned.map(|planned| air::builder(&planned.air, planned.burning)))
        };
        let batches = numbers.iter().map(batch).collect::<Result<_, _>>()?;
        Ok(Self { plan, batches, numbers, places })
    }

    /// All boxes in their order.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = &Fluid> {
        self.places.iter().map(|&(batch, at)| &self.batches[batch][at])
    }

    /// Adds to the airs that are due what flames and the rows' buoyancy do to them in the coming step, and makes it.
    ///
    /// Returns the largest dimensionless divergence that is left, and how many cells were advanced, once for each part
    /// of the step.
    pub(crate) fn step(&mut self, flames: &Flames, details: &Details, dt_s: f32) -> Result<(f32, u64), FluidError> {
        let (mut divergence, mut cell_steps) = (0.0_f32, 0);
        let is_due = |number: usize| !details.is_on() || details.is_due(flames, number);
        for (batch, numbers) in self.batches.iter_mut().zip(&self.numbers) {
            // The first box that refuses, whichever thread is first to find one.
            let refused = Mutex::new(None::<(usize, FluidError)>);
            let airs = &self.plan.airs;
            batch.for_each(|at, fluid| {
                let number = numbers[at];
                if !is_due(number) {
                    return;
                }
                let driven =
                    flames.drive_air(number, fluid).and_then(|()| air::add_row_buoyancy(fluid, &airs[number].air));
                if let Err(error) = driven {
                    let mut first = refused.lock().unwrap_or_else(PoisonError::into_inner);
                    if first.as_ref().is_none_or(|(before, _)| number < *before) {
                        *first = Some((number, error));
                    }
                }
            });
            if let Some((_, error)) = refused.into_inner().unwrap_or_else(PoisonError::into_inner) {
                return Err(error);
            }
            let reports = batch.step_where(dt_s, |at| is_due(numbers[at]))?;
            divergence = reports.iter().fold(divergence, |most, report| most.max(report.divergence_after));
            let due = reports.iter().zip(numbers).filter(|(_, number)| is_due(**number));
            let parts: u64 = due.map(|(report, _)| u64::from(report.substeps.max(1))).sum();
            cell_steps += parts * airs[numbers[0]].air.cells.iter().map(|n| u64::from(*n)).product::<u64>();
        }
        Ok((divergence, cell_steps))
    }

    /// Lets the boxes go along with what carries them in the coming step.
    pub(crate) fn carry(&mut self, movers: &Movers, step_s: f32) -> Result<(), FluidError> {
        for (&(batch, at), Planned { air, fire, .. }) in self.places.iter().zip(&self.plan.airs) {
            let fluid = &mut self.batches[batch][at];
            let rest = (air.origin_m, air.size_m);
            if let Some(velocity) = movers.air_velocity(*fire, fluid.origin(), rest, step_s) {
                fluid.set_frame_velocity(velocity)?;
            }
        }
        Ok(())
    }

    /// The state of every box.
    pub(crate) fn saved(&self) -> Vec<Snapshot> {
        self.iter().map(Fluid::save).collect()
    }

    /// Puts every box back to what was saved of it.
    pub(crate) fn restore(&mut self, saved: &[Snapshot]) -> Result<(), SnapshotError> {
        if saved.len() != self.places.len() {
            return Err(SnapshotError::Shape);
        }
        let places = self.places.iter().zip(saved);
        places.into_iter().try_for_each(|(&(batch, at), saved)| self.batches[batch][at].restore(saved))
    }

    /// Takes over what can change while the air moves, from a plan with the same grids.
    pub(crate) fn adjust(&mut self, plan: Plan) -> Result<(), FluidError> {
        for (&(batch, at), Planned { air, .. }) in self.places.iter().zip(&plan.airs) {
            air::adjust(&mut self.batches[batch][at], air)?;
        }
        self.plan = plan;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(at: &[[f32; 3]]) -> Scene {
        let mut scene = lucerna_scene::builtin("candle").expect("candle").scene;
        scene.fires[0].at = at.to_vec();
        scene.fires[0].air = Some(FireAir {
            origin_m: [-0.05, -0.01, -0.05],
            size_m: [0.1, 0.2, 0.1],
            cells: [8, 16, 8],
            sides: None,
            vorticity_confinement: None,
            cooling_per_s: None,
        });
        scene
    }

    fn plan(scene: &Scene) -> Plan {
        Plan::new(scene).expect("a plan")
    }

    #[test]
    fn copies_apart_have_a_box_each_and_copies_that_overlap_share_one_that_holds_both() {
        let apart = plan(&scene(&[[0.0; 3], [0.1, 0.0, 0.0], [0.5, 0.0, 0.0]]));
        assert_eq!((apart.airs.len(), &apart.of), (3, &vec![vec![0, 1, 2]]));
        // The first and the last meet only through the one between them.
        let near = plan(&scene(&[[0.0; 3], [0.5, 0.0, 0.0], [0.15, 0.01, 0.0], [0.08, 0.0, 0.03]]));
        assert_eq!(near.of, [[0, 1, 0, 0]]);
        assert_eq!(near.airs.len(), 2);
        let (air, cell) = (&near.airs[0].air, 0.0125);
        assert_eq!(air.cells, [20, 17, 11]);
        for axis in 0..3 {
            assert!((air.size_m[axis] - air.cells[axis] as f32 * cell).abs() < 1e-6, "{air:?}");
        }
        assert!((air.origin_m[0] + 0.05).abs() < 1e-6 && (air.origin_m[2] + 0.05).abs() < 1e-6);
        assert_eq!(near.airs[1].air.cells, [8, 16, 8]);
    }

    #[test]
    fn boxes_of_another_kind_stay_apart() {
        let mut two = scene(&[]);
        let mut other = two.fires[0].clone();
        other.air.as_mut().expect("air").cells = [10, 20, 10];
        two.fires.push(other);
        assert_eq!(plan(&two).of, [[0], [1]]);
    }

    #[test]
    fn the_common_air_is_there_only_where_a_fire_burns_in_it() {
        let mut scene = scene(&[]);
        assert_eq!(plan(&scene).airs[0].air.cells, [8, 16, 8]);
        let mut other = scene.fires[0].clone();
        other.air = None;
        scene.fires.push(other);
        let plan = plan(&scene);
        assert_eq!((plan.of.as_slice(), plan.airs.len()), ([vec![1], vec![0]].as_slice(), 2));
        assert_eq!(plan.airs[0].air, scene.air);
    }
}
