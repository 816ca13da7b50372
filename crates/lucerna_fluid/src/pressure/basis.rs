//! Eigenvectors of the one-dimensional discrete Laplacian, for any number of cells and each
//! pair of end conditions. G. Strang, *The Discrete Cosine Transform*, SIAM Review 41, 1999.

use std::f64::consts::PI;

use crate::sides::Side;

/// Whether each end of an axis fixes the flow (the pressure is even about the face, Neumann);
/// otherwise the pressure is zero on the face (odd about it, Dirichlet).
pub(crate) fn ends(sides: [Side; 2]) -> [bool; 2] {
    sides.map(Side::fixes_flow)
}

/// Orthonormal eigenvectors and eigenvalues along one axis.
pub(crate) struct Basis {
    /// `analysis[k][i]`: value of eigenvector `k` in cell `i`.
    pub(crate) analysis: Vec<f32>,
    /// Its transpose, `synthesis[i][k]`.
    pub(crate) synthesis: Vec<f32>,
    /// Eigenvalues of minus the Laplacian, 1/m², rising; all at least zero.
    pub(crate) eigenvalues: Vec<f64>,
}

impl Basis {
    /// For `count` cells of `cell_m` metres; `is_fixed` as [`ends`] gives it.
    pub(crate) fn new(count: usize, cell_m: f32, is_fixed: [bool; 2]) -> Self {
        let n = count as f64;
        let mut analysis = vec![0.0_f32; count * count];
        let mut synthesis = vec![0.0_f32; count * count];
        let mut eigenvalues = Vec::with_capacity(count);
        for k in 0..count {
            // Half waves across the box.
            let half_waves = k as f64
                + match is_fixed {
                    [true, true] => 0.0,
                    [false, false] => 1.0,
                    [true, false] | [false, true] => 0.5,
                };
            let angle = PI * half_waves / n;
            let value = |i: usize| {
                let phase = angle * (i as f64 + 0.5);
                if is_fixed[0] { phase.cos() } else { phase.sin() }
            };
            let length = (0..count).map(|i| value(i) * value(i)).sum::<f64>().sqrt();
            for i in 0..count {
                let component = (value(i) / length) as f32;
                analysis[k * count + i] = component;
                synthesis[i * count + k] = component;
            }
            let rate = 2.0 * (0.5 * angle).sin() / f64::from(cell_m);
            eigenvalues.push(rate * rate);
        }
        Self { analysis, synthesis, eigenvalues }
    }
}

#[cfg(test)]
mod tests {
    use super::Basis;

    /// Applies minus the Laplacian with its ends, and compares with the eigenvalue.
    #[test]
    fn vectors_are_orthonormal_eigenvectors_of_the_laplacian() {
        for count in [2, 3, 15, 16, 31] {
            for is_fixed in [[true, true], [false, false], [true, false], [false, true]] {
                let basis = Basis::new(count, 0.5, is_fixed);
                for k in 0..count {
                    let vector = &basis.analysis[k * count..(k + 1) * count];
                    let ghost = |end: usize, inside: f32| if is_fixed[end] { inside } else { -inside };
                    for i in 0..count {
                        let low = if i == 0 { ghost(0, vector[0]) } else { vector[i - 1] };
                        let high = if i + 1 == count { ghost(1, vector[i]) } else { vector[i + 1] };
                        let applied = (2.0 * vector[i] - low - high) / 0.25;
                        let expected = basis.eigenvalues[k] as f32 * vector[i];
                        assert!((applied - expected).abs() < 2e-5, "{count} {is_fixed:?} {k} {i}");
                    }
                    for other in 0..count {
                        let other_vector = &basis.analysis[other * count..(other + 1) * count];
                        let dot: f32 = vector.iter().zip(other_vector).map(|(a, b)| a * b).sum();
                        let expected = if other == k { 1.0 } else { 0.0 };
                        assert!((dot - expected).abs() < 2e-6, "{count} {is_fixed:?} {k} {other}: {dot}");
                    }
                }
            }
        }
    }
}
