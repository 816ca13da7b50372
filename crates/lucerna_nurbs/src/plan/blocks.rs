//! The tables along u, a register's worth of samples at a time.

use alloc::{vec, vec::Vec};

use super::axis::Axis;
use crate::Real;

/// Samples side by side: for each block of `lanes` samples, the control rows that any of them
/// depends on, and for each row a factor for every lane, zero where it does not.
///
/// Each lane meets its own control rows in the order of its [`Axis`] sample, and a zero added in
/// between changes no sum; so samples with equal tables give equal bits whatever block they are in.
#[derive(Clone, Debug)]
pub(super) struct Blocks<T> {
    /// Samples in a block.
    pub(super) lanes: usize,
    /// The place of each sample, the last one repeated to fill its block.
    pub(super) places: Vec<T>,
    /// For each block, where its rows end.
    ends: Vec<usize>,
    rows: Vec<usize>,
    /// For each row: values, then slopes.
    factors: Vec<T>,
}

impl<T: Real> Blocks<T> {
    pub(super) fn new(axis: &Axis<T>, lanes: usize) -> Self {
        let samples = axis.places.len();
        let mut blocks = Self { lanes, places: Vec::new(), ends: Vec::new(), rows: Vec::new(), factors: Vec::new() };
        for start in (0..samples).step_by(lanes) {
            let chosen: Vec<usize> = (start..start + lanes).map(|i| i.min(samples - 1)).collect();
            blocks.places.extend(chosen.iter().map(|&i| axis.places[i]));
            // Samples rise or, mirrored, fall: one of the two orders merges them well.
            let rising = merge(axis, &chosen, chosen.iter().copied());
            let falling = merge(axis, &chosen, chosen.iter().rev().copied());
            let rows = if rising.len() <= falling.len() { rising } else { falling };
            blocks.fill(axis, &chosen, &rows);
        }
        blocks
    }

    /// Blocks.
    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The control rows of a block, and their values and slopes.
    #[inline(always)]
    pub(super) fn block(&self, index: usize) -> (&[usize], &[T]) {
        let range = if index == 0 { 0 } else { self.ends[index - 1] }..self.ends[index];
        (&self.rows[range.clone()], &self.factors[range.start * 2 * self.lanes..range.end * 2 * self.lanes])
    }

    fn fill(&mut self, axis: &Axis<T>, chosen: &[usize], rows: &[usize]) {
        let mut done = vec![0; chosen.len()];
        for &row in rows {
            let mut slopes = Vec::with_capacity(chosen.len());
            for (&i, done) in chosen.iter().zip(&mut done) {
                let sample = axis.sample(i);
                let uses = sample.indices.get(*done) == Some(&row);
                self.factors.push(if uses { sample.values[*done] } else { T::ZERO });
                slopes.push(if uses { sample.slopes[*done] } else { T::ZERO });
                *done += usize::from(uses);
            }
            self.factors.extend(slopes);
        }
        self.rows.extend_from_slice(rows);
        self.ends.push(self.rows.len());
    }
}

/// A sequence of control rows that holds the rows of every chosen sample, in the order of each;
/// the samples that come first in `order` are served first.
fn merge<T: Real>(axis: &Axis<T>, chosen: &[usize], order: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut done = vec![0; axis.places.len()];
    let mut rows = Vec::new();
    for first in order {
        while let Some(&row) = axis.sample(first).indices.get(done[first]) {
            rows.push(row);
            let mut before = None;
            for &i in chosen {
                // The last sample may be chosen more than once.
                if before != Some(i) && axis.sample(i).indices.get(done[i]) == Some(&row) {
                    done[i] += 1;
                }
                before = Some(i);
            }
        }
    }
    rows
}
