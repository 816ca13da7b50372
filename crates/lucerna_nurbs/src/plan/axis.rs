//! The tables of one direction of a grid.

use alloc::vec::Vec;

use super::Closure;
use crate::{KnotVector, NurbsError, Real, check};

/// For every sample: its place, the control points it depends on, and their basis functions.
#[derive(Clone, Debug)]
pub(super) struct Axis<T> {
    /// Control points for each sample: the degree plus one.
    pub(super) width: usize,
    /// Distinct control points of the whole direction.
    pub(super) points: usize,
    /// Control points when those repeated for the closure are counted too.
    pub(super) points_repeated: usize,
    /// Whether the samples start and end in different places.
    pub(super) open: bool,
    /// All distinct control points, or the first `width` where these are more.
    pub(super) all: Vec<usize>,
    /// The place of each sample, 0 to 1.
    pub(super) places: Vec<T>,
    indices: Vec<usize>,
    values: Vec<T>,
    slopes: Vec<T>,
}

/// One sample of an [`Axis`].
#[derive(Clone, Copy)]
pub(super) struct Sample<'a, T> {
    /// The control points, in the order in which they are summed up.
    pub(super) indices: &'a [usize],
    /// Their basis functions.
    pub(super) values: &'a [T],
    /// The derivatives of these, divided by the sum of their magnitudes: only directions matter.
    pub(super) slopes: &'a [T],
}

impl<T: Real> Axis<T> {
    /// Samples at the corners of `cells` cells, `cells + 1` in all.
    pub(super) fn corners(knots: &KnotVector<T>, cells: usize, closure: Closure) -> Result<Self, NurbsError> {
        let mut axis = Self::empty(knots, closure)?;
        let mirror = match closure {
            Closure::Periodic { start_row } if is_uniform(knots) => Some(start_row),
            _ => None,
        };
        for i in 0..=cells {
            let place = if i == cells { T::ONE } else { T::from_usize(i) / T::from_usize(cells) };
            if i == cells && !axis.open {
                axis.copy_sample(0, place);
            } else if let Some(row) = mirror.filter(|_| 2 * i > cells) {
                axis.mirror_sample(cells - i, row, place);
            } else {
                let t = parameter(knots, closure, i, cells);
                axis.push(knots, t, place);
            }
        }
        Ok(axis)
    }

    /// Samples at the middles of `cells` cells.
    pub(super) fn middles(knots: &KnotVector<T>, cells: usize, closure: Closure) -> Result<Self, NurbsError> {
        let mut axis = Self::empty(knots, closure)?;
        for i in 0..cells {
            let place = T::from_usize(2 * i + 1) / T::from_usize(2 * cells);
            let t = parameter(knots, closure, 2 * i + 1, 2 * cells);
            axis.push(knots, t, place);
        }
        Ok(axis)
    }

    pub(super) fn sample(&self, i: usize) -> Sample<'_, T> {
        let range = i * self.width..(i + 1) * self.width;
        Sample {
            indices: &self.indices[range.clone()],
            values: &self.values[range.clone()],
            slopes: &self.slopes[range],
        }
    }

    /// The control point in which sample `i` lies, whatever the net: at a clamped end.
    pub(super) fn only_point(&self, i: usize) -> Option<usize> {
        let sample = self.sample(i);
        let at = sample.values.iter().position(|&value| value == T::ONE)?;
        let zeros = sample.values.iter().filter(|&&value| value == T::ZERO);
        (zeros.count() + 1 == self.width).then(|| sample.indices[at])
    }

    fn empty(knots: &KnotVector<T>, closure: Closure) -> Result<Self, NurbsError> {
        let points = match closure {
            Closure::Periodic { start_row } => {
                check_periodic(knots)?;
                let count = knots.count() - knots.degree();
                if start_row >= count {
                    return Err(NurbsError::StartRow { row: start_row, count });
                }
                count
            }
            Closure::Open | Closure::Joined => knots.count(),
        };
        Ok(Self {
            width: knots.degree() + 1,
            points,
            points_repeated: knots.count(),
            open: closure == Closure::Open,
            all: (0..points.max(knots.degree() + 1)).collect(),
            places: Vec::new(),
            indices: Vec::new(),
            values: Vec::new(),
            slopes: Vec::new(),
        })
    }

    fn push(&mut self, knots: &KnotVector<T>, t: T, place: T) {
        let basis = knots.basis(t, 1);
        self.places.push(place);
        self.indices.extend((basis.first()..=basis.span()).map(|i| i % self.points));
        self.values.extend_from_slice(basis.row(0));
        let sum: T = basis.row(1).iter().map(|slope| slope.abs()).sum();
        self.slopes.extend(basis.row(1).iter().map(|&slope| {
            let slope = slope / sum;
            // Spans too short to divide by have no usable slope.
            if slope.is_finite() { slope } else { T::ZERO }
        }));
    }

    fn copy_sample(&mut self, from: usize, place: T) {
        let range = from * self.width..(from + 1) * self.width;
        self.places.push(place);
        self.indices.extend_from_within(range.clone());
        self.values.extend_from_within(range.clone());
        self.slopes.extend_from_within(range);
    }

    /// The mirror image of sample `from` about control point `center`: the same values summed in
    /// the same order, so that mirrored control points give the same bits.
    fn mirror_sample(&mut self, from: usize, center: usize, place: T) {
        self.copy_sample(from, place);
        let start = self.values.len() - self.width;
        for index in &mut self.indices[start..] {
            *index = (2 * center + self.points - *index) % self.points;
        }
        for slope in &mut self.slopes[start..] {
            *slope = -*slope;
        }
    }
}

/// The parameter at `i / cells` of the way, in the domain.
fn parameter<T: Real>(knots: &KnotVector<T>, closure: Closure, i: usize, cells: usize) -> T {
    let (lo, hi) = knots.domain();
    let along = (hi - lo) * (T::from_usize(i) / T::from_usize(cells));
    let t = match closure {
        Closure::Open | Closure::Joined if i == cells => hi,
        Closure::Open | Closure::Joined => lo + along,
        Closure::Periodic { start_row } => {
            let mut t = knots.greville(start_row).unwrap_or(lo) + along;
            while t < lo {
                t += hi - lo;
            }
            while t >= hi {
                t -= hi - lo;
            }
            t
        }
    };
    // Rounding may have carried it past an end.
    if t > hi {
        hi
    } else if t < lo {
        lo
    } else {
        t
    }
}

/// The relative difference of spacings that counts as none.
fn tolerance<T: Real>(knots: &[T]) -> T {
    let largest = knots.iter().fold(T::ZERO, |max, knot| max.max(knot.abs()));
    T::from_f64(16.0) * T::EPSILON * largest
}

fn is_uniform<T: Real>(knots: &KnotVector<T>) -> bool {
    let knots = knots.as_slice();
    let tolerance = tolerance(knots);
    let first = knots[1] - knots[0];
    knots.windows(2).all(|pair| (pair[1] - pair[0] - first).abs() <= tolerance)
}

fn check_periodic<T: Real>(knots: &KnotVector<T>) -> Result<(), NurbsError> {
    let period = knots.count() - knots.degree();
    let knots = knots.as_slice();
    let tolerance = tolerance(knots);
    for index in 0..knots.len() - 1 - period {
        let value = knots[index + 1] - knots[index];
        let repeated = knots[index + period + 1] - knots[index + period];
        if !check::is_within(value - repeated, tolerance) {
            return Err(NurbsError::NotPeriodic { index, value: value.to_f64(), repeated: repeated.to_f64() });
        }
    }
    Ok(())
}
