//! Sources in their places: for one step, or until they are taken away.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::voxels::Voxels;
use super::{ScalarSource, Shape, Source};
use crate::error::{FluidError, check_vec};
use crate::fluid::Fluid;
use crate::grid::Grid;
use crate::scalars::Scalars;

/// A source that acts until [`Fluid::detach_source`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct SourceId(u64);

/// A source and the cells it acts on.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) source: Source,
    pub(crate) voxels: Voxels,
    /// Where the box was when it was placed.
    origin: Vec3,
}

/// All sources that act in the coming step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Placed {
    /// Their memory is used again.
    once: Vec<Entry>,
    once_used: usize,
    kept: Vec<(SourceId, Entry)>,
    next_id: u64,
}

/// Placed sources without their cells, which follow from the grid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SavedSources {
    once: Vec<(Vec3, Source)>,
    kept: Vec<(SourceId, Vec3, Source)>,
    next_id: u64,
}

impl Placed {
    pub(crate) fn saved(&self) -> SavedSources {
        SavedSources {
            once: self.once[..self.once_used].iter().map(|entry| (entry.origin, entry.source.clone())).collect(),
            kept: self.kept.iter().map(|(id, entry)| (*id, entry.origin, entry.source.clone())).collect(),
            next_id: self.next_id,
        }
    }

    /// Checks and places what was saved.
    pub(crate) fn from_saved(saved: &SavedSources, grid: &Grid, scalars: &Scalars) -> Result<Self, FluidError> {
        let entry = |origin: Vec3, source: &Source| {
            check_source(source, scalars)?;
            check_vec("source origin", origin, 1.0e7, "components within ±1e7 m")?;
            let grid = Grid { origin, ..grid.clone() };
            let mut voxels = Voxels::default();
            voxels.place(&grid, &source.shape)?;
            Ok(Entry { source: source.clone(), voxels, origin })
        };
        let mut placed = Self { once_used: saved.once.len(), next_id: saved.next_id, ..Self::default() };
        if saved.next_id > u64::MAX / 2 {
            return Err(FluidError::UnknownSource { id: saved.next_id });
        }
        for (origin, source) in &saved.once {
            placed.once.push(entry(*origin, source)?);
        }
        for (id, origin, source) in &saved.kept {
            if id.0 >= saved.next_id || placed.find(*id).is_ok() {
                return Err(FluidError::UnknownSource { id: id.0 });
            }
            placed.kept.push((*id, entry(*origin, source)?));
        }
        Ok(placed)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Entry> {
        self.kept.iter().map(|(_, entry)| entry).chain(&self.once[..self.once_used])
    }

    /// Forgets what was added for one step.
    pub(crate) fn clear(&mut self) {
        self.once_used = 0;
    }

    fn find(&mut self, id: SourceId) -> Result<usize, FluidError> {
        self.kept.iter().position(|(known, _)| *known == id).ok_or(FluidError::UnknownSource { id: id.0 })
    }
}

/// Takes over a source without taking new memory for its list of scalars.
fn assign(to: &mut Source, from: &Source) {
    let mut scalars: Vec<ScalarSource> = std::mem::take(&mut to.scalars);
    scalars.clear();
    scalars.extend_from_slice(&from.scalars);
    let Source { shape, acceleration_m_s2, force_n, heat_kw, kelvin_per_s, .. } = from;
    *to = Source {
        shape: shape.clone(),
        acceleration_m_s2: *acceleration_m_s2,
        force_n: *force_n,
        heat_kw: *heat_kw,
        kelvin_per_s: *kelvin_per_s,
        expansion_per_s: from.expansion_per_s,
        inflow_m3_s: from.inflow_m3_s,
        velocity: from.velocity,
        temperature: from.temperature,
        scalars,
    };
}

impl Fluid {
    /// Lets a source act during the coming step. Several add up, in the order of the calls. Its
    /// shape is placed at each call; for a mesh that stays, [`Fluid::attach_source`] is cheaper.
    ///
    /// # Errors
    /// A value that is not finite or out of range, a shape outside the box, a mesh that is empty
    /// or not closed, an unknown scalar; nothing has changed then.
    pub fn add_source(&mut self, source: &Source) -> Result<(), FluidError> {
        check_source(source, &self.scalars)?;
        let placed = &mut self.sources.placed;
        let used = placed.once_used;
        if used == placed.once.len() {
            let source = Source::new(Shape::Point(Vec3::ZERO));
            placed.once.push(Entry { source, voxels: Voxels::default(), origin: Vec3::ZERO });
        }
        let entry = &mut placed.once[used];
        entry.voxels.place(&self.grid, &source.shape)?;
        entry.origin = self.grid.origin;
        assign(&mut entry.source, source);
        placed.once_used += 1;
        Ok(())
    }

    /// Lets a source act in every step from the coming one on. It outlives [`Fluid::reset`].
    ///
    /// # Errors
    /// As [`Fluid::add_source`].
    pub fn attach_source(&mut self, source: Source) -> Result<SourceId, FluidError> {
        check_source(&source, &self.scalars)?;
        let mut voxels = Voxels::default();
        voxels.place(&self.grid, &source.shape)?;
        let placed = &mut self.sources.placed;
        let id = SourceId(placed.next_id);
        placed.next_id += 1;
        placed.kept.push((id, Entry { source, voxels, origin: self.grid.origin }));
        Ok(id)
    }

    /// Replaces an attached source. Its shape is placed anew only if it differs.
    ///
    /// # Errors
    /// As [`Fluid::add_source`], or a source that is not attached; nothing has changed then.
    pub fn set_source(&mut self, id: SourceId, source: Source) -> Result<(), FluidError> {
        let at = self.sources.placed.find(id)?;
        check_source(&source, &self.scalars)?;
        if source.shape != self.sources.placed.kept[at].1.source.shape {
            let mut voxels = Voxels::default();
            voxels.place(&self.grid, &source.shape)?;
            let entry = &mut self.sources.placed.kept[at].1;
            (entry.voxels, entry.origin) = (voxels, self.grid.origin);
        }
        self.sources.placed.kept[at].1.source = source;
        Ok(())
    }

    /// Takes an attached source away and returns it.
    ///
    /// # Errors
    /// A source that is not attached.
    pub fn detach_source(&mut self, id: SourceId) -> Result<Source, FluidError> {
        let at = self.sources.placed.find(id)?;
        Ok(self.sources.placed.kept.remove(at).1.source)
    }

    /// The part of the box that an attached source covers, m³.
    ///
    /// # Errors
    /// A source that is not attached.
    pub fn source_volume_m3(&mut self, id: SourceId) -> Result<f64, FluidError> {
        let at = self.sources.placed.find(id)?;
        Ok(self.sources.placed.kept[at].1.voxels.total * self.grid.cell_volume_m3())
    }
}

fn check_source(source: &Source, scalars: &Scalars) -> Result<(), FluidError> {
    source.check_amounts()?;
    source.scalars.iter().try_for_each(|scalar| scalars.known(scalar.scalar).map(|_| ()))
}
