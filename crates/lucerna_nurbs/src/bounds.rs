//! Bounding boxes.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;

use crate::patch::{Patch, Ranked};
use crate::{Curve, NurbsError, Real, Surface, check};

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<T, const D: usize> {
    /// The smallest coordinates.
    pub min: [T; D],
    /// The largest.
    pub max: [T; D],
}

impl<T: Real, const D: usize> Bounds<T, D> {
    fn of(points: impl Iterator<Item = [T; D]>) -> Self {
        let mut bounds = Self { min: [T::MAX; D], max: [-T::MAX; D] };
        points.for_each(|point| bounds.include(point));
        bounds
    }

    fn include(&mut self, point: [T; D]) {
        for ((min, max), x) in self.min.iter_mut().zip(&mut self.max).zip(point) {
            *min = if x < *min { x } else { *min };
            *max = if x > *max { x } else { *max };
        }
    }

    /// How far another box reaches out of this one.
    fn excess(&self, other: &Self) -> T {
        (0..D).fold(T::ZERO, |most, axis| {
            most.max(self.min[axis] - other.min[axis]).max(other.max[axis] - self.max[axis])
        })
    }
}

impl<T: Real, const D: usize> Curve<T, D> {
    /// The box around the control points, in which the curve lies.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    ///
    /// let arc = Curve::arc([0.0; 2], [1.0, 0.0], [0.0, 1.0_f64], 0.0, 3.0)?;
    /// assert!(arc.bounds().max[1] > 1.01);
    /// let tight = arc.tight_bounds(1e-9)?;
    /// assert!((tight.max[1] - 1.0).abs() < 1e-9);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    pub fn bounds(&self) -> Bounds<T, D> {
        Bounds::of(self.points().iter().copied())
    }

    /// A box in which the curve lies, to rounding, and which exceeds the smallest such box by no
    /// more than `tolerance` at each side.
    ///
    /// # Errors
    /// When the tolerance is not positive and finite, or coordinates are so large that sums
    /// overflow.
    pub fn tight_bounds(&self, tolerance: T) -> Result<Bounds<T, D>, NurbsError> {
        check::positive("tolerance", tolerance)?;
        let pieces = Patch::of_curve(&self.map_f64(|point| point)?);
        Ok(tighten(pieces, tolerance.to_f64()))
    }
}

impl<T: Real> Surface<T> {
    /// The box around the control points, in which the surface lies.
    ///
    /// ```
    /// use lucerna_nurbs::Surface;
    ///
    /// let bounds = Surface::sphere([0.0, 1.0, 0.0], 2.0_f64)?.bounds();
    /// assert_eq!((bounds.min, bounds.max), ([-2.0, -1.0, -2.0], [2.0, 3.0, 2.0]));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    pub fn bounds(&self) -> Bounds<T, 3> {
        Bounds::of(self.points().iter().copied())
    }

    /// A box in which the surface lies, to rounding, and which exceeds the smallest such box by no
    /// more than `tolerance` at each side, or by a little more where thousands of patches do not
    /// suffice: for tolerances near rounding where the surface touches the box along a curve.
    ///
    /// ```
    /// use lucerna_nurbs::Surface;
    ///
    /// let sphere = Surface::sphere([1.0, 0.0, 0.0], 2.0_f64)?;
    /// let bounds = sphere.tight_bounds(1e-6)?;
    /// assert_eq!(bounds.max, [3.0, 2.0, 2.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the tolerance is not positive and finite, or coordinates are so large that sums
    /// overflow.
    pub fn tight_bounds(&self, tolerance: T) -> Result<Bounds<T, 3>, NurbsError> {
        check::positive("tolerance", tolerance)?;
        let patches = Patch::of_surface(&self.map_f64(|point| point)?)?;
        Ok(tighten(patches, tolerance.to_f64()))
    }
}

/// A patch whose control points reach out of the known box.
struct Candidate<const D: usize> {
    hull: Bounds<f64, D>,
    patch: Patch<D>,
}

/// Halves the patch that reaches out farthest until none does by more than the tolerance.
fn tighten<T: Real, const D: usize>(patches: Vec<Patch<D>>, tolerance: f64) -> Bounds<T, D> {
    let halvings = Patch::halvings(&patches);
    // Around points that the shape certainly has.
    let mut known = Bounds::of(patches.iter().flat_map(Patch::corners).map(|(_, point)| point));
    let candidate = |patch: Patch<D>, known: &Bounds<f64, D>| {
        let hull = Bounds::of(patch.hull());
        Ranked { rank: known.excess(&hull), item: Candidate { hull, patch } }
    };
    let mut heap: BinaryHeap<_> = patches.into_iter().map(|patch| candidate(patch, &known)).collect();
    let mut settled = Vec::new();
    for _ in 0..halvings {
        let Some(Ranked { item: farthest, .. }) = heap.pop() else { break };
        // The known box may have grown since.
        if known.excess(&farthest.hull) <= tolerance {
            settled.push(farthest.hull);
            continue;
        }
        let Some(halves) = farthest.patch.halve(farthest.patch.bent()) else {
            settled.push(farthest.hull);
            continue;
        };
        for half in halves {
            half.corners().for_each(|(_, point)| known.include(point));
            heap.push(candidate(half, &known));
        }
    }
    for hull in settled.into_iter().chain(heap.into_iter().map(|candidate| candidate.item.hull)) {
        known.include(hull.min);
        known.include(hull.max);
    }
    Bounds { min: known.min.map(T::from_f64), max: known.max.map(T::from_f64) }
}
