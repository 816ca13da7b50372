//! Many boxes of one shape, stepped together.

use std::ops::{Index, IndexMut};
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use crate::builder::FluidBuilder;
use crate::error::FluidError;
use crate::fluid::{Fluid, check_dt};
use crate::pressure::Tables;
use crate::report::StepReport;
use crate::scratch::Scratch;

/// Boxes that a thread takes at a time: enough that handing them out costs nothing, few enough
/// that the last ones do not keep the others waiting.
const CHUNK: usize = 4;

/// Many boxes of one shape, such as one for each of a thousand flames.
///
/// They share the tables of the pressure solver, and the arrays that a step works in: those
/// exist once a thread. A box itself keeps 20 bytes a cell (70 KB for 15^3), and what was first
/// added for a step (12 bytes a cell for accelerations, 4 for heat, 4 for expansion).
///
/// Boxes differ in where they lie, in their settings, and in what is added to them. Each gives
/// the same bits as the same [`Fluid`] alone, on any number of threads.
///
/// ```
/// use lucerna_fluid::{Fluid, FluidBatch, Sides, Vec3};
///
/// # fn main() -> Result<(), lucerna_fluid::FluidError> {
/// let torch = Fluid::builder([15; 3]).size_m(Vec3::splat(0.3)).sides(Sides::OPEN);
/// let mut batch = FluidBatch::new((0..20).map(|i| torch.clone().origin(Vec3::X * i as f32)))?;
/// for (i, fluid) in batch.iter_mut().enumerate() {
///     fluid.add_heat(Vec3::new(i as f32 + 0.15, 0.05, 0.15), 0.05, 3000.0)?;
/// }
/// let reports = batch.step(1.0 / 60.0)?;
/// assert!(reports.iter().all(|report| report.divergence_after < 1e-3));
/// assert!(batch[7].velocity(Vec3::new(7.15, 0.15, 0.15)).y > 0.0);
/// # Ok(())
/// # }
/// ```
pub struct FluidBatch {
    fluids: Vec<Fluid>,
    reports: Vec<StepReport>,
    /// One a thread. A thread only ever asks for its own, so that nobody waits.
    scratch: Vec<Mutex<Scratch>>,
    cells: [usize; 3],
}

impl FluidBuilder {
    /// Makes `count` boxes as described, to be stepped together; none is allowed.
    ///
    /// # Errors
    /// As [`FluidBuilder::build`].
    pub fn build_batch(self, count: usize) -> Result<FluidBatch, FluidError> {
        FluidBatch::new(std::iter::repeat_n(self, count))
    }
}

impl FluidBatch {
    /// Makes a box for each description. All must have the same counts of cells, size, sides,
    /// pressure solver and names of scalars; origin, wind and the other settings may differ.
    ///
    /// # Errors
    /// As [`FluidBuilder::build`], and a box of another shape than the first.
    pub fn new(builders: impl IntoIterator<Item = FluidBuilder>) -> Result<Self, FluidError> {
        let mut builders = builders.into_iter();
        let Some(first) = builders.next() else {
            return Ok(Self { fluids: Vec::new(), reports: Vec::new(), scratch: Vec::new(), cells: [0; 3] });
        };
        let fluid = first.clone().build()?;
        let tables: Arc<Tables> = Arc::clone(&fluid.tables);
        let cells = fluid.grid.cells;
        let mut scratch = Scratch::new(&fluid.grid);
        let mut fluids = vec![Fluid { scratch: None, ..fluid }];
        for (at, builder) in builders.enumerate() {
            if !builder.is_same_shape(&first) {
                return Err(FluidError::BatchShape { index: at + 1 });
            }
            fluids.push(builder.build_in_batch(&tables, &mut scratch)?);
        }
        let reports = vec![StepReport::default(); fluids.len()];
        Ok(Self { fluids, reports, scratch: vec![Mutex::new(scratch)], cells })
    }

    /// Advances every box by `dt_s` seconds, above 0 and up to 1e3, and returns a report for
    /// each, in their order. See [`Fluid::step`].
    ///
    /// # Errors
    /// A length of step out of its range; nothing has changed then.
    pub fn step(&mut self, dt_s: f32) -> Result<&[StepReport], FluidError> {
        self.step_where(dt_s, |_| true)
    }

    /// As [`FluidBatch::step`], but only the boxes whose index `is_due`; the others stay as they are, with the reports
    /// of their last step.
    ///
    /// # Errors
    /// A length of step out of its range; nothing has changed then.
    pub fn step_where(
        &mut self,
        dt_s: f32,
        is_due: impl Fn(usize) -> bool + Sync + Send,
    ) -> Result<&[StepReport], FluidError> {
        check_dt(dt_s)?;
        let Some(first) = self.fluids.first() else { return Ok(&[]) };
        let threads = rayon::current_num_threads();
        let is_large = first.grid.exec.is_parallel;
        if self.scratch.len() < threads {
            self.scratch.resize_with(threads, || Mutex::new(Scratch::new(&first.grid)));
        }
        let (cells, scratch) = (self.cells, &self.scratch);
        let step = |thread: usize, from: usize, fluids: &mut [Fluid], reports: &mut [StepReport], is_shared: bool| {
            let mut scratch = scratch[thread].lock().unwrap_or_else(PoisonError::into_inner);
            for (index, (fluid, report)) in fluids.iter_mut().zip(reports).enumerate() {
                if is_due(from + index) {
                    *report = step_one(fluid, &mut scratch, cells, dt_s, is_shared);
                }
            }
        };
        if threads == 1 || (is_large && self.fluids.len() < threads) {
            // Few boxes that are large: one after the other, each on all threads.
            step(0, 0, &mut self.fluids, &mut self.reports, true);
        } else {
            let chunks = self.fluids.par_chunks_mut(CHUNK).zip(self.reports.par_chunks_mut(CHUNK));
            chunks.enumerate().for_each(|(chunk, (fluids, reports))| {
                step(rayon::current_thread_index().unwrap_or(0), chunk * CHUNK, fluids, reports, false);
            });
        }
        Ok(&self.reports)
    }

    /// Calls `work` with each box and its index, on all threads: for adding sources to many.
    pub fn for_each(&mut self, work: impl Fn(usize, &mut Fluid) + Sync + Send) {
        self.fluids.par_iter_mut().with_min_len(CHUNK).enumerate().for_each(|(index, fluid)| work(index, fluid));
    }

    /// The reports of the last step, one a box; all zero before the first.
    #[must_use]
    pub fn reports(&self) -> &[StepReport] {
        &self.reports
    }

    /// Number of boxes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.fluids.len()
    }

    /// Whether there is no box at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.fluids.is_empty()
    }

    /// One box; none if there are not as many.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<&Fluid> {
        self.fluids.get(index)
    }

    /// One box, to be changed; none if there are not as many.
    pub fn get_mut(&mut self, index: usize) -> Option<&mut Fluid> {
        self.fluids.get_mut(index)
    }

    /// All boxes in their order.
    pub fn iter(&self) -> std::slice::Iter<'_, Fluid> {
        self.fluids.iter()
    }

    /// All boxes in their order, to be changed.
    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, Fluid> {
        self.fluids.iter_mut()
    }
}

/// Steps a box in the thread's arrays; one that a caller has put here from elsewhere in its own.
fn step_one(fluid: &mut Fluid, scratch: &mut Scratch, cells: [usize; 3], dt_s: f32, is_shared: bool) -> StepReport {
    let was_parallel = fluid.grid.exec.is_parallel;
    // A thread that waited for others would go and find more boxes while it holds its arrays.
    fluid.grid.exec.is_parallel &= is_shared;
    let report = if fluid.scratch.is_none() && fluid.grid.cells == cells {
        fluid.step_with(scratch, dt_s)
    } else {
        fluid.with_scratch(|fluid, scratch| fluid.step_with(scratch, dt_s))
    };
    fluid.grid.exec.is_parallel = was_parallel;
    report
}

/// As with slices, an index beyond the last box panics; [`FluidBatch::get`] does not.
impl Index<usize> for FluidBatch {
    type Output = Fluid;

    fn index(&self, index: usize) -> &Fluid {
        &self.fluids[index]
    }
}

impl IndexMut<usize> for FluidBatch {
    fn index_mut(&mut self, index: usize) -> &mut Fluid {
        &mut self.fluids[index]
    }
}

impl<'a> IntoIterator for &'a FluidBatch {
    type Item = &'a Fluid;
    type IntoIter = std::slice::Iter<'a, Fluid>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<'a> IntoIterator for &'a mut FluidBatch {
    type Item = &'a mut Fluid;
    type IntoIter = std::slice::IterMut<'a, Fluid>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter_mut()
    }
}
