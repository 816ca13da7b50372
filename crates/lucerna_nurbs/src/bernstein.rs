//! Polynomials in two variables on the unit square, in Bernstein form.
//!
//! Coefficients are kept times their binomials, which makes products plain convolutions (Farouki and
//! Rajan, 1988).

use alloc::vec;
use alloc::vec::Vec;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bernstein {
    /// Coefficients along u and v: the degrees plus one.
    counts: [usize; 2],
    scaled: Vec<f64>,
}

impl Bernstein {
    /// From Bezier coefficients, row by row.
    pub(crate) fn new(counts: [usize; 2], coefficients: impl Iterator<Item = f64>) -> Self {
        let (u, v) = (binomials(counts[0]), binomials(counts[1]));
        let factors = u.iter().flat_map(|a| v.iter().map(move |b| a * b));
        Self { counts, scaled: coefficients.zip(factors).map(|(x, factor)| x * factor).collect() }
    }

    /// From coefficients times their binomials.
    pub(crate) fn from_scaled(counts: [usize; 2], scaled: Vec<f64>) -> Self {
        Self { counts, scaled }
    }

    /// The coefficients times their binomials.
    pub(crate) fn scaled(&self) -> &[f64] {
        &self.scaled
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let counts = [0, 1].map(|k| self.counts[k] + other.counts[k] - 1);
        let mut scaled = vec![0.0; counts[0] * counts[1]];
        for (i, row) in self.scaled.chunks_exact(self.counts[1]).enumerate() {
            for (k, other) in other.scaled.chunks_exact(other.counts[1]).enumerate() {
                for (j, a) in row.iter().enumerate() {
                    let start = (i + k) * counts[1] + j;
                    for (sum, b) in scaled[start..].iter_mut().zip(other) {
                        *sum += a * b;
                    }
                }
            }
        }
        Self { counts, scaled }
    }

    /// `self * own + other * factor`, of equal degrees.
    pub(crate) fn mix(mut self, own: f64, other: &Self, factor: f64) -> Self {
        self.scaled.iter_mut().zip(&other.scaled).for_each(|(a, b)| *a = *a * own + b * factor);
        self
    }

    /// The derivative along u (0) or v (1); zero, of degree zero, where the degree is zero.
    pub(crate) fn derivative(&self, direction: usize) -> Self {
        let degree = self.counts[direction] - 1;
        let mut counts = self.counts;
        counts[direction] = degree.max(1);
        let mut scaled = Vec::with_capacity(counts[0] * counts[1]);
        for i in 0..counts[0] {
            for j in 0..counts[1] {
                let (k, next) = if direction == 0 { (i, [i + 1, j]) } else { (j, [i, j + 1]) };
                let at = |[i, j]: [usize; 2]| self.scaled[i * self.counts[1] + j];
                scaled.push(if degree == 0 {
                    0.0
                } else {
                    at(next) * (k + 1) as f64 - at([i, j]) * (degree - k) as f64
                });
            }
        }
        Self { counts, scaled }
    }

    /// The same polynomial with so many coefficients.
    pub(crate) fn elevated(&self, counts: [usize; 2]) -> Self {
        let ones = [0, 1].map(|k| counts[k] + 1 - self.counts[k]);
        self.times(&Self::new(ones, core::iter::repeat_n(1.0, ones[0] * ones[1])))
    }

    pub(crate) fn counts(&self) -> [usize; 2] {
        self.counts
    }
}

/// A row of Pascal's triangle.
fn binomials(count: usize) -> Vec<f64> {
    let mut row = vec![1.0];
    for k in 1..count {
        row.push(row[k - 1] * (count - k) as f64 / k as f64);
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(p: &Bernstein, u: f64, v: f64) -> f64 {
        let [rows, columns] = p.counts;
        let power = |x: f64, k: usize, count: usize| x.powi(k as i32) * (1.0 - x).powi((count - 1 - k) as i32);
        (0..rows * columns).map(|k| p.scaled[k] * power(u, k / columns, rows) * power(v, k % columns, columns)).sum()
    }

    #[test]
    fn products_sums_and_derivatives_are_those_of_the_values() {
        let a = Bernstein::new([4, 3], (0..12).map(|k| (f64::from(k) * 1.3).sin()));
        let b = Bernstein::new([2, 5], (0..10).map(|k| (f64::from(k) * 0.7).cos()));
        for (u, v) in [(0.0, 0.0), (0.3, 0.8), (1.0, 0.25), (0.5, 1.0)] {
            let close = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
            close(value(&a.times(&b), u, v), value(&a, u, v) * value(&b, u, v));
            let sum = a.elevated([5, 5]).mix(1.0, &b.elevated([5, 5]), -2.0);
            close(value(&sum, u, v), value(&a, u, v) - 2.0 * value(&b, u, v));
        }
        let h = 1e-5;
        let slope = (value(&a, 0.3 + h, 0.6) - value(&a, 0.3 - h, 0.6)) / (2.0 * h);
        assert!((value(&a.derivative(0), 0.3, 0.6) - slope).abs() < 1e-8);
        let slope = (value(&a, 0.3, 0.6 + h) - value(&a, 0.3, 0.6 - h)) / (2.0 * h);
        assert!((value(&a.derivative(1), 0.3, 0.6) - slope).abs() < 1e-8);
        assert_eq!(a.derivative(1).derivative(1).derivative(1).scaled(), [0.0; 4]);
    }
}
