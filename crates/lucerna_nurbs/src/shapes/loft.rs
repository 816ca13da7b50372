//! Surfaces through curves (The NURBS Book, section 10.3).

use alloc::{vec, vec::Vec};

use crate::fit::{Spacing, distance, interpolate};
use crate::strip::{lacking, lift, project, transpose};
use crate::{Curve, KnotVector, NurbsError, Real, Surface};

impl<T: Real> Surface<T> {
    /// The surface through curves: skinning. u runs along the curves, v across them with degree
    /// `degree`, both from 0 to 1. Every curve is a curve of constant v, at the mean parameter by
    /// chord length of its points (equation 10.8); those parameters are returned too.
    ///
    /// The curves may differ in degree, knots and domain: they are clamped, elevated and refined
    /// until they agree, which moves none of them.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, Surface};
    ///
    /// // A vase.
    /// let circles: Vec<_> = [(1.0, 0.0), (1.5, 1.0), (0.5, 2.0), (0.8_f64, 3.0)]
    ///     .into_iter()
    ///     .map(|(r, y)| Curve::circle([0.0, y, 0.0], [r, 0.0, 0.0], [0.0, 0.0, -r]))
    ///     .collect::<Result<_, _>>()?;
    /// let (vase, v) = Surface::loft(&circles, 3)?;
    /// let (found, wanted) = (vase.point(0.7, v[2])?, circles[2].point(0.7)?);
    /// assert!((0..3).all(|axis| (found[axis] - wanted[axis]).abs() < 1e-14));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When there are no more curves than the degree, the degree is 0 or above
    /// [`MAX_DEGREE`](crate::MAX_DEGREE), curves that follow each other coincide, or the weights of
    /// rational curves differ so much that those between them would not be positive.
    pub fn loft(sections: &[Curve<T, 3>], degree: usize) -> Result<(Self, Vec<T>), NurbsError> {
        let found = sections.len();
        if degree == 0 || degree > crate::MAX_DEGREE || found <= degree {
            return Err(NurbsError::Sections { found, degree, needed: degree.saturating_add(1).max(2) });
        }
        let curves = compatible(sections)?;
        let (knots_u, rational) = (curves[0].knots().clone(), curves[0].weights().is_some());
        let between = |line: usize, a: usize, b: usize| distance(curves[a].points()[line], curves[b].points()[line]);
        let mut parameters = Spacing::ChordLength.mean(knots_u.count(), found, between)?;
        parameters.iter_mut().for_each(|t| *t = T::from_f64(*t).to_f64());
        for (index, pair) in parameters.windows(2).enumerate() {
            if pair[0] >= pair[1] {
                let (index, value, previous) = (index + 1, pair[1], pair[0]);
                return Err(NurbsError::ParameterOrder { name: "v", index, value, previous });
            }
        }
        let lifted = |curve: &Curve<T, 3>| lift(curve.points(), curve.weights());
        let data: Vec<f64> = curves.iter().flat_map(lifted).map(Real::to_f64).collect();
        let (knots_v, data) = interpolate::<T>(degree, &parameters, &data)?;
        let parts = 3 + usize::from(rational);
        let data: Vec<T> = data.into_iter().map(T::from_f64).collect();
        let (points, weights) = project(&transpose(&data, knots_u.count(), parts), rational);
        let knots_v = KnotVector::new(degree, knots_v.as_slice().iter().map(|&t| T::from_f64(t)).collect())?;
        let parameters = parameters.into_iter().map(T::from_f64).collect();
        Ok((Self::new(knots_u, knots_v, points, weights)?, parameters))
    }
}

/// The same curves with the same degree and knots, clamped, on the domain 0 to 1, all of them
/// rational or none. There is at least one.
pub(super) fn compatible<T: Real>(curves: &[Curve<T, 3>]) -> Result<Vec<Curve<T, 3>>, NurbsError> {
    let degree = curves.iter().map(|curve| curve.knots().degree()).max().unwrap_or_default();
    let rational = curves.iter().any(|curve| curve.weights().is_some());
    let mut all = Vec::with_capacity(curves.len());
    for curve in curves {
        let curve = curve.clamp()?.elevate(degree - curve.knots().degree())?;
        let (lo, hi) = curve.domain();
        let knots = curve.knots().as_slice().iter().map(|&knot| (knot - lo) / (hi - lo)).collect();
        let weights = curve.weights().map(<[T]>::to_vec);
        let weights = weights.or_else(|| rational.then(|| vec![T::ONE; curve.points().len()]));
        all.push((knots, curve.points().to_vec(), weights));
    }
    unite(&mut all.iter_mut().map(|(knots, ..)| knots).collect::<Vec<_>>());
    let mut all: Vec<_> = all
        .into_iter()
        .map(|(knots, points, weights)| Curve::new(KnotVector::new(degree, knots)?, points, weights))
        .collect::<Result<_, _>>()?;
    let mut union: Vec<T> = Vec::new();
    for curve in &all {
        let missing = lacking(&union, curve.knots().as_slice().iter().copied());
        union.extend(missing);
        union.sort_unstable_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    }
    for curve in &mut all {
        *curve = curve.refine(&lacking(curve.knots().as_slice(), union.iter().copied()))?;
    }
    Ok(all)
}

/// Makes knots of different curves equal that differ by rounding only.
fn unite<T: Real>(vectors: &mut [&mut Vec<T>]) {
    let tolerance = T::from_f64(32.0) * T::EPSILON;
    let mut values: Vec<T> = vectors.iter().flat_map(|knots| knots.iter().copied()).collect();
    values.sort_unstable_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    values.dedup_by(|next, kept| *next - *kept <= tolerance);
    for knot in vectors.iter_mut().flat_map(|knots| knots.iter_mut()) {
        let above = values.partition_point(|value| value <= knot).max(1);
        // The ends stay: 0 is the first value, and 1 is not the one below it.
        if *knot != T::ONE {
            *knot = values[above - 1];
        }
    }
}
