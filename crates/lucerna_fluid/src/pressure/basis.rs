//! Eigenvectors of the one-dimensional discrete Laplacian, for any number of cells and each
//! pair of end conditions. G. Strang, *The Discrete Cosine Transform*, SIAM Review 41, 1999.
//!
//! Where both ends are alike, each eigenvector is even or odd about the middle of the box. A
//! line is then folded into its even and its odd part, and each part transformed by a matrix of
//! half the size: half the work.

use std::f64::consts::PI;
use std::ops::Range;

use crate::sides::Side;

/// What the pressure does at the two ends of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ends {
    /// For each end whether the flow through it is given (the pressure is even about the face,
    /// Neumann); otherwise the pressure is zero on the face (odd about it, Dirichlet).
    Fixed([bool; 2]),
    /// The first cell follows the last.
    Periodic,
}

impl Ends {
    pub(crate) fn new(sides: [Side; 2]) -> Self {
        if sides[0] == Side::Periodic { Self::Periodic } else { Self::Fixed(sides.map(Side::fixes_flow)) }
    }
}

/// Orthonormal eigenvectors along one axis: first the even ones, then the odd ones, each by
/// rising eigenvalue; without symmetry all by rising eigenvalue.
pub(crate) struct Basis {
    pub(crate) count: usize,
    /// Number of even eigenvectors; `count` where there is no symmetry.
    pub(crate) evens: usize,
    /// Value of eigenvector `k` in cell `i` at `k * count + i`.
    vectors: Vec<f64>,
    /// Eigenvalues of minus the Laplacian, 1/m², all at least zero.
    pub(crate) eigenvalues: Vec<f64>,
}

impl Basis {
    /// For `count` cells of `cell_m` metres.
    pub(crate) fn new(count: usize, cell_m: f32, ends: Ends) -> Self {
        let is_symmetric = !matches!(ends, Ends::Fixed([true, false] | [false, true]));
        let evens = if is_symmetric { count.div_ceil(2) } else { count };
        let mut vectors = Vec::with_capacity(count * count);
        let mut eigenvalues = Vec::with_capacity(count);
        for mode in 0..count {
            // `rank` counts the even or the odd ones.
            let (is_even, rank) = if mode < evens { (true, mode) } else { (false, mode - evens) };
            let (half_waves, is_cosine) = match ends {
                Ends::Fixed([true, true]) => ((2 * rank + usize::from(!is_even)) as f64, true),
                Ends::Fixed([false, false]) => ((2 * rank + 1 + usize::from(!is_even)) as f64, false),
                Ends::Fixed([is_fixed, _]) => (rank as f64 + 0.5, is_fixed),
                Ends::Periodic => ((2 * (rank + usize::from(!is_even))) as f64, is_even),
            };
            let angle = PI * half_waves / count as f64;
            let values = (0..count).map(|i| {
                let phase = angle * (i as f64 + 0.5);
                if is_cosine { phase.cos() } else { phase.sin() }
            });
            let values: Vec<f64> = values.collect();
            let length = values.iter().map(|value| value * value).sum::<f64>().sqrt();
            vectors.extend(values.into_iter().map(|value| value / length));
            let rate = 2.0 * (0.5 * angle).sin() / f64::from(cell_m);
            eigenvalues.push(rate * rate);
        }
        Self { count, evens, vectors, eigenvalues }
    }

    /// Value of an eigenvector in a cell.
    pub(crate) fn value(&self, mode: usize, cell: usize) -> f32 {
        self.vectors[mode * self.count + cell] as f32
    }

    /// Whether lines can be folded.
    pub(crate) fn is_symmetric(&self) -> bool {
        self.evens < self.count || self.count == 1
    }

    /// The modes that are even, and those that are odd. The values of a folded line are numbered
    /// likewise: sums of a cell and its mirror image first, then differences.
    pub(crate) fn parts(&self) -> [Range<usize>; 2] {
        [0..self.evens, self.evens..self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::{Basis, Ends};

    /// Applies minus the Laplacian with its ends, and compares with the eigenvalue.
    #[test]
    fn vectors_are_orthonormal_eigenvectors_of_the_laplacian() {
        let ends = [
            Ends::Fixed([true, true]),
            Ends::Fixed([false, false]),
            Ends::Fixed([true, false]),
            Ends::Fixed([false, true]),
            Ends::Periodic,
        ];
        for count in [1, 2, 3, 4, 15, 16, 31] {
            for ends in ends {
                let basis = Basis::new(count, 0.5, ends);
                for k in 0..count {
                    let vector = |i: usize| basis.value(k, i);
                    let ghost = |end: usize| match ends {
                        Ends::Fixed(is_fixed) => {
                            let inside = vector(end * (count - 1));
                            if is_fixed[end] { inside } else { -inside }
                        }
                        Ends::Periodic => vector((1 - end) * (count - 1)),
                    };
                    for i in 0..count {
                        let low = if i == 0 { ghost(0) } else { vector(i - 1) };
                        let high = if i + 1 == count { ghost(1) } else { vector(i + 1) };
                        let applied = (2.0 * vector(i) - low - high) / 0.25;
                        let expected = basis.eigenvalues[k] as f32 * vector(i);
                        assert!((applied - expected).abs() < 2e-5, "{count} {ends:?} {k} {i}");
                    }
                    for other in 0..count {
                        let dot: f32 = (0..count).map(|i| vector(i) * basis.value(other, i)).sum();
                        let expected = if other == k { 1.0 } else { 0.0 };
                        assert!((dot - expected).abs() < 2e-6, "{count} {ends:?} {k} {other}: {dot}");
                    }
                    if basis.is_symmetric() {
                        let sign = if k < basis.evens { 1.0 } else { -1.0 };
                        for i in 0..count {
                            assert!((vector(i) - sign * vector(count - 1 - i)).abs() < 1e-6, "{count} {ends:?} {k}");
                        }
                    }
                }
            }
        }
    }
}
