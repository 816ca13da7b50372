//! Least squares with weights and constraints (The NURBS Book, section 9.4, A9.6).

use alloc::{vec, vec::Vec};

use super::averaged;
use super::banded::Banded;
use crate::{KnotVector, MAX_DEGREE, NurbsError, Real};

/// What is asked of a curve at a parameter, without the value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Demand {
    pub(super) t: f64,
    /// 0 for a point, above for a derivative.
    pub(super) order: usize,
    /// `None` when it must be met exactly.
    pub(super) weight: Option<f64>,
}

/// Clamped knots for `count` points: the means (equation 9.8) of `count` parameters chosen evenly
/// from the given ones. With as many points as parameters these are the knots of interpolation;
/// the knots of equation 9.69 then leave some points all but undetermined.
pub(super) fn knots<T: Real>(degree: usize, count: usize, parameters: &[f64]) -> Result<KnotVector<f64>, NurbsError> {
    if degree == 0 || degree > MAX_DEGREE || degree >= count {
        return Err(NurbsError::Degree { degree, count });
    }
    let last = parameters.len() - 1;
    if parameters[0] >= parameters[last] {
        return Err(NurbsError::EmptyDomain { lo: parameters[0], hi: parameters[last] });
    }
    let chosen = |k: usize| {
        let place = (k * last) as f64 / (count - 1) as f64;
        let i = (place as usize).min(last - 1);
        parameters[i] + (parameters[i + 1] - parameters[i]) * (place - i as f64)
    };
    averaged::<T>(degree, &(0..count).map(chosen).collect::<Vec<_>>())
}

/// One row of the system: the first point it depends on, and the factors from there.
struct Row {
    first: usize,
    factors: Vec<f64>,
}

/// The points that meet the exact demands and come closest to the others. `values` holds `width`
/// numbers for each demand.
pub(super) fn solve(
    knots: &KnotVector<f64>,
    demands: &[Demand],
    values: &[f64],
    width: usize,
) -> Result<Vec<f64>, NurbsError> {
    let count = knots.count();
    let mut matrix = Banded::zero(count, knots.degree());
    let mut points = vec![0.0; count * width];
    let mut exact: Vec<(Row, &[f64], f64)> = Vec::new();
    for (demand, value) in demands.iter().zip(values.chunks_exact(width)) {
        let basis = knots.basis(demand.t, demand.order);
        let row = Row { first: basis.first(), factors: basis.row(demand.order).to_vec() };
        // What must be met exactly is added to the squares too, scaled to be of size 1: it makes
        // no difference where it is met, and without it the squares alone may not suffice.
        let norm: f64 = row.factors.iter().map(|x| x * x).sum();
        let weight = demand.weight.unwrap_or(if norm > 0.0 { 1.0 / norm } else { 0.0 });
        for (a, i) in row.factors.iter().zip(row.first..) {
            row.factors.iter().zip(row.first..).for_each(|(b, j)| matrix.add(i, j, weight * a * b));
            (0..width).for_each(|k| points[i * width + k] += weight * a * value[k]);
        }
        if demand.weight.is_none() {
            exact.push((row, value, Real::sqrt(weight)));
        }
    }
    matrix.factor()?;
    matrix.solve(&mut points, width);
    if !exact.is_empty() {
        constrain(&matrix, &exact, &mut points, width)?;
    }
    Ok(points)
}

/// Moves the minimum of the squares to where the exact demands are met, by Lagrange multipliers.
fn constrain(
    matrix: &Banded,
    exact: &[(Row, &[f64], f64)],
    points: &mut [f64],
    width: usize,
) -> Result<(), NurbsError> {
    let (m, count) = (exact.len(), points.len() / width);
    // The influence of each multiplier on each point.
    let mut influence = vec![0.0; count * m];
    for (c, (row, _, scale)) in exact.iter().enumerate() {
        row.factors.iter().zip(row.first..).for_each(|(a, i)| influence[i * m + c] = a * scale);
    }
    matrix.solve(&mut influence, m);
    let mut system = Banded::zero(m, m);
    let mut multipliers = vec![0.0; m * width];
    for (c, (row, value, scale)) in exact.iter().enumerate() {
        for (a, i) in row.factors.iter().zip(row.first..) {
            (0..m).for_each(|d| system.add(c, d, a * scale * influence[i * m + d]));
            (0..width).for_each(|k| multipliers[c * width + k] += a * scale * points[i * width + k]);
        }
        (0..width).for_each(|k| multipliers[c * width + k] -= scale * value[k]);
    }
    system.factor().map_err(|_| NurbsError::Contradiction)?;
    system.solve(&mut multipliers, width);
    for i in 0..count {
        for c in 0..m {
            (0..width).for_each(|k| points[i * width + k] -= influence[i * m + c] * multipliers[c * width + k]);
        }
    }
    Ok(())
}
