//! Curves and surfaces changed without moving them: knots inserted and removed, degrees raised,
//! parts cut out, directions reversed and exchanged.

mod curve;
mod surface;

use alloc::vec::Vec;

use crate::strip::Strip;
use crate::{KnotVector, MAX_DEGREE, MAX_WEIGHT, MIN_WEIGHT, NurbsError, Real};

/// One of the two directions of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Direction {
    /// From row to row of the net.
    U,
    /// Along the rows.
    V,
}

impl Direction {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::U => "u",
            Self::V => "v",
        }
    }
}

/// Sorts knots to be inserted, after making sure that they may be.
fn insertable<T: Real>(knots: &KnotVector<T>, name: &'static str, new: &[T]) -> Result<Vec<T>, NurbsError> {
    for &t in new {
        knots.check(name, t)?;
    }
    let mut new = new.to_vec();
    new.sort_unstable_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    for run in new.chunk_by(|a, b| a == b) {
        let times = run.len() + knots.multiplicity(run[0]);
        if times > knots.degree() {
            let index = knots.as_slice().partition_point(|&knot| knot < run[0]);
            return Err(NurbsError::KnotRepeated { index, value: run[0].to_f64(), times, allowed: knots.degree() });
        }
    }
    Ok(new)
}

/// Refuses an interval that is not in the domain or has no length.
fn check_interval<T: Real>(knots: &KnotVector<T>, name: &'static str, a: T, b: T) -> Result<(), NurbsError> {
    knots.check(name, a)?;
    knots.check(name, b)?;
    if a < b { Ok(()) } else { Err(NurbsError::EmptyDomain { lo: a.to_f64(), hi: b.to_f64() }) }
}

/// Raises the degree, refused where it would become too high.
fn elevate<T: Real>(strip: &mut Strip<T>, by: usize) -> Result<(), NurbsError> {
    let degree = strip.degree.saturating_add(by);
    if degree > MAX_DEGREE {
        return Err(NurbsError::Degree { degree, count: strip.count().saturating_add(by) });
    }
    (0..by).for_each(|_| strip.elevate());
    Ok(())
}

/// Removes a knot up to `times` times, as long as the shape moves by no more than `tolerance` in
/// all and stays valid; returns how often. Points are `parts` scalars, the last of which is the
/// weight where the shape is rational.
fn remove<T: Real>(strip: &mut Strip<T>, t: T, times: usize, tolerance: T, parts: usize, rational: bool) -> usize {
    let mut left = tolerance;
    for removed in 0..times {
        let mut next = strip.clone();
        let Some(moved) = next.remove(t, parts) else { return removed };
        left -= if rational { moved * motion(&strip.data, parts) } else { moved };
        let valid = |block: &[T]| {
            let w = block[parts - 1].to_f64();
            !rational || (MIN_WEIGHT..=MAX_WEIGHT).contains(&w)
        };
        let valid = next.data.iter().all(|x| x.is_finite()) && next.data.chunks_exact(parts).all(valid);
        if !(valid && left >= T::ZERO) {
            return removed;
        }
        *strip = next;
    }
    times
}

/// How far a rational shape moves at most when its homogeneous points move by 1 (equation 5.30).
fn motion<T: Real>(data: &[T], parts: usize) -> T {
    let (mut least, mut farthest) = (T::MAX, T::ZERO);
    for block in data.chunks_exact(parts) {
        let (w, square) = (block[parts - 1], block[..parts - 1].iter().map(|&x| x * x).sum::<T>());
        least = if w < least { w } else { least };
        farthest = farthest.max(square / (w * w));
    }
    (T::ONE + farthest.sqrt()) / least
}
