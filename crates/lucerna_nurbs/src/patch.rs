//! Bezier patches that can be halved: what searches over curves and surfaces are made of.
//!
//! A curve is a patch with a single point across. Everything is in `f64`.

use alloc::vec::Vec;
use core::cmp::Ordering;

use crate::strip::Strip;
use crate::vector::lerp;
use crate::{Curve, Direction, NurbsError, Real, Surface};

/// Something in a heap that is taken out the greatest `rank` first.
pub(crate) struct Ranked<T> {
    pub(crate) rank: f64,
    pub(crate) item: T,
}

impl<T> Ord for Ranked<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.rank.total_cmp(&other.rank)
    }
}

impl<T> PartialOrd for Ranked<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> PartialEq for Ranked<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<T> Eq for Ranked<T> {}

/// A rational Bezier patch with the parameters it covers.
#[derive(Clone, Debug)]
pub(crate) struct Patch<const D: usize> {
    /// Points along u and v.
    counts: [usize; 2],
    /// Coordinates times weight, row by row.
    points: Vec<[f64; D]>,
    weights: Vec<f64>,
    pub(crate) lo: [f64; 2],
    pub(crate) hi: [f64; 2],
}

impl<const D: usize> Patch<D> {
    /// The Bezier pieces of a curve.
    pub(crate) fn of_curve(curve: &Curve<f64, D>) -> Vec<Self> {
        let rational = curve.weights().is_some();
        let piece = |strip: Strip<f64>| {
            let ((lo, hi), count) = (strip.domain(), strip.count());
            Self::new([count, 1], &strip.data, rational, [lo, 0.0], [hi, 0.0])
        };
        curve.strip().bezier_pieces().into_iter().map(piece).collect()
    }

    fn new(counts: [usize; 2], data: &[f64], rational: bool, lo: [f64; 2], hi: [f64; 2]) -> Self {
        let blocks = data.chunks_exact(D + usize::from(rational));
        let points = blocks.clone().map(|block| core::array::from_fn(|axis| block[axis])).collect();
        let weights = blocks.map(|block| if rational { block[D] } else { 1.0 }).collect();
        Self { counts, points, weights, lo, hi }
    }

    /// Control points along u and v.
    pub(crate) fn counts(&self) -> [usize; 2] {
        self.counts
    }

    /// The control points times their weights, with these.
    pub(crate) fn homogeneous(&self) -> impl Iterator<Item = ([f64; D], f64)> {
        self.points.iter().copied().zip(self.weights.iter().copied())
    }

    /// How often patches like this one may be halved in a search: less often where they have many
    /// points, for the sake of memory.
    pub(crate) fn halvings(patches: &[Self]) -> usize {
        let points = patches.first().map_or(1, |patch| patch.points.len());
        ((1 << 20) / points).clamp(1 << 8, 1 << 14)
    }

    /// The control points.
    pub(crate) fn hull(&self) -> impl Iterator<Item = [f64; D]> {
        self.points.iter().zip(&self.weights).map(|(point, w)| point.map(|x| x / w))
    }

    /// The corners, which are points of the shape, with their parameters.
    pub(crate) fn corners(&self) -> impl Iterator<Item = ([f64; 2], [f64; D])> {
        let [rows, columns] = self.counts;
        [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().filter(move |&(_, b)| b == 0 || columns > 1).map(move |(a, b)| {
            let k = a * (rows - 1) * columns + b * (columns - 1);
            let at = |end: usize, direction: usize| [self.lo, self.hi][end][direction];
            ([at(a, 0), at(b, 1)], self.points[k].map(|x| x / self.weights[k]))
        })
    }

    /// The direction in which the control points are farthest from lying on lines at equal
    /// distances.
    pub(crate) fn bent(&self) -> Direction {
        self.compare(3, |p, axis| p[0][axis] - 2.0 * p[1][axis] + p[2][axis])
    }

    /// The direction in which the lines of control points are longer.
    pub(crate) fn long(&self) -> Direction {
        self.compare(2, |p, axis| p[1][axis] - p[0][axis])
    }

    /// The direction in which the measure, of so many control points in a row, sums up to more.
    fn compare(&self, width: usize, measure: impl Fn(&[[f64; D]], usize) -> f64) -> Direction {
        let [rows, columns] = self.counts;
        let hull: Vec<[f64; D]> = self.hull().collect();
        let sum = |line: Vec<[f64; D]>| {
            let size = |p| (0..D).fold(0.0f64, |most, axis| most.max(measure(p, axis).abs()));
            line.windows(width).map(size).sum::<f64>()
        };
        let along_u = (0..columns).map(|j| sum(hull.iter().copied().skip(j).step_by(columns).collect()));
        let along_v = (0..rows).map(|i| sum(hull[i * columns..(i + 1) * columns].to_vec()));
        if along_v.fold(0.0, f64::max) > along_u.fold(0.0, f64::max) { Direction::V } else { Direction::U }
    }

    /// The two halves, by de Casteljau's rule; `None` when parameters do not tell them apart.
    pub(crate) fn halve(&self, direction: Direction) -> Option<[Self; 2]> {
        let [rows, columns] = self.counts;
        // Lines of `count` points `step` apart, starting `between` apart.
        let (direction, lines, count, step, between) = match direction {
            Direction::U => (0, columns, rows, columns, 1),
            Direction::V => (1, rows, columns, 1, columns),
        };
        let middle = 0.5 * (self.lo[direction] + self.hi[direction]);
        if !(self.lo[direction] < middle && middle < self.hi[direction]) {
            return None;
        }
        let (mut low, mut high) = (self.clone(), self.clone());
        (low.hi[direction], high.lo[direction]) = (middle, middle);
        for line in 0..lines {
            let at = |k: usize| line * between + k * step;
            // In place, the upper half grows from its upper end; the lower one takes the first
            // point of each round.
            for round in 0..count {
                low.points[at(round)] = high.points[at(0)];
                low.weights[at(round)] = high.weights[at(0)];
                for k in 0..count - 1 - round {
                    high.points[at(k)] = lerp(high.points[at(k)], high.points[at(k + 1)], 0.5);
                    high.weights[at(k)] = 0.5 * (high.weights[at(k)] + high.weights[at(k + 1)]);
                }
            }
        }
        Some([low, high])
    }
}

impl Patch<3> {
    /// The Bezier patches of a surface.
    pub(crate) fn of_surface(surface: &Surface<f64>) -> Result<Vec<Self>, NurbsError> {
        let patch = |patch: Surface<f64>| {
            let ((u_lo, u_hi), (v_lo, v_hi)) = (patch.knots_u().domain(), patch.knots_v().domain());
            let counts = [patch.knots_u().count(), patch.knots_v().count()];
            let data = patch.strip(Direction::U).data;
            Self::new(counts, &data, patch.weights().is_some(), [u_lo, v_lo], [u_hi, v_hi])
        };
        Ok(surface.bezier_patches()?.into_iter().map(patch).collect())
    }
}

impl<T: Real, const D: usize> Curve<T, D> {
    /// The same curve in `f64`, its points mapped.
    pub(crate) fn map_f64(&self, map: impl Fn([f64; D]) -> [f64; D]) -> Result<Curve<f64, D>, NurbsError> {
        let points = self.points().iter().map(|point| map(point.map(Real::to_f64))).collect();
        Curve::new(self.knots().to_f64(), points, self.weights().map(to_f64))
    }
}

impl<T: Real> Surface<T> {
    /// The same surface in `f64`, its points mapped.
    pub(crate) fn map_f64(&self, map: impl Fn([f64; 3]) -> [f64; 3]) -> Result<Surface<f64>, NurbsError> {
        let points = self.points().iter().map(|point| map(point.map(Real::to_f64))).collect();
        Surface::new(self.knots_u().to_f64(), self.knots_v().to_f64(), points, self.weights().map(to_f64))
    }
}

fn to_f64<T: Real>(values: &[T]) -> Vec<f64> {
    values.iter().map(|x| x.to_f64()).collect()
}
