//! Many nets of one plan.

use super::{GridOutput, GridPlan, Scratch};
use crate::{NurbsError, Real, check};
#[cfg(feature = "rayon")]
use rayon::prelude::*;

impl<T: Real> GridPlan<T> {
    /// Computes the meshes of many nets, one behind the other in `nets`, `weights` and `output`:
    /// net `k` starts at `k * point_count()`, its mesh at `k * vertex_count()`. Points repeated to
    /// close a direction are left out.
    ///
    /// The nets are dealt out evenly among `scratches`. With the feature `rayon`, each of these
    /// shares is a task of the current thread pool: have about four scratches for each thread.
    ///
    /// ```
    /// use lucerna_nurbs::{GridOptions, GridPlan, KnotVector};
    ///
    /// let knots = KnotVector::<f32>::clamped_uniform(1, 2)?;
    /// let plan = GridPlan::new(&knots, &knots, GridOptions { columns: 1, rows: 1, ..Default::default() })?;
    /// let nets = [
    ///     [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]],
    ///     [[0., 0., 5.], [0., 1., 5.], [1., 0., 5.], [1., 1., 5.]],
    /// ];
    /// let mut meshes = vec![[0.0; 8]; 2 * plan.vertex_count()];
    /// plan.evaluate_many(nets.as_flattened(), None, &mut [plan.scratch()], &mut meshes)?;
    /// assert_eq!(meshes[5], [1.0, 0.0, 5.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`evaluate_into`](Self::evaluate_into), indices counted from the start of `nets`; also
    /// when `nets` is not a multiple of [`point_count`](Self::point_count) or there is no scratch.
    /// When a value is refused, the meshes of other nets may have been written.
    pub fn evaluate_many<V: Send>(
        &self,
        nets: &[[T; 3]],
        weights: Option<&[T]>,
        scratches: &mut [Scratch<T>],
        output: &mut [V],
    ) -> Result<(), NurbsError>
    where
        [V]: GridOutput<T>,
    {
        let (points, vertices) = (self.point_count(), self.vertex_count());
        check::length(nets.len(), nets.len().next_multiple_of(points))?;
        if let Some(found) = weights.map(<[T]>::len).filter(|&found| found != nets.len()) {
            return Err(NurbsError::WeightCount { found, expected: nets.len() });
        }
        let count = nets.len() / points;
        if output.len() < count * vertices {
            return Err(NurbsError::Room { found: output.len(), needed: count * vertices });
        }
        if scratches.is_empty() {
            return Err(NurbsError::Cells { name: "scratches", found: 0, min: 1, max: usize::MAX });
        }
        if count == 0 {
            return Ok(());
        }
        let share = count.div_ceil(scratches.len());
        let work = |first: usize, scratch: &mut Scratch<T>, nets: &[[T; 3]], output: &mut [V]| {
            let meshes = output.chunks_exact_mut(vertices);
            for ((net, mesh), start) in nets.chunks_exact(points).zip(meshes).zip((first * points..).step_by(points)) {
                let weights = weights.map(|weights| &weights[start..start + points]);
                self.evaluate_into(net, weights, scratch, mesh).map_err(|error| shift(error, start))?;
            }
            Ok(())
        };
        #[cfg(feature = "rayon")]
        return scratches
            .par_iter_mut()
            .zip(nets.par_chunks(share * points))
            .zip(output.par_chunks_mut(share * vertices))
            .enumerate()
            .try_for_each(|(k, ((scratch, nets), output))| work(k * share, scratch, nets, output));
        #[cfg(not(feature = "rayon"))]
        return scratches
            .iter_mut()
            .zip(nets.chunks(share * points))
            .zip(output.chunks_mut(share * vertices))
            .enumerate()
            .try_for_each(|(k, ((scratch, nets), output))| work(k * share, scratch, nets, output));
    }
}

/// The same error with the index counted from the start of all nets.
fn shift(error: NurbsError, start: usize) -> NurbsError {
    match error {
        NurbsError::PointValue { index, axis, value, limit } => {
            NurbsError::PointValue { index: start + index, axis, value, limit }
        }
        NurbsError::Weight { index, value } => NurbsError::Weight { index: start + index, value },
        error => error,
    }
}
