//! Banded linear systems.
//!
//! The matrices here are totally positive or positive definite: elimination without exchanging rows
//! is stable for both (C. de Boor and A. Pinkus, *Backward error analysis for totally positive
//! linear systems*, Numerische Mathematik 27, 1977), and keeps the band.

use alloc::{vec, vec::Vec};

use crate::NurbsError;

/// A square matrix that is zero farther than `half` from its diagonal.
#[derive(Debug)]
pub(super) struct Banded {
    size: usize,
    half: usize,
    /// Row after row, `2 half + 1` entries each, the diagonal in the middle.
    rows: Vec<f64>,
}

impl Banded {
    pub(super) fn zero(size: usize, half: usize) -> Self {
        let half = half.min(size.saturating_sub(1));
        Self { size, half, rows: vec![0.0; size * (2 * half + 1)] }
    }

    fn index(&self, i: usize, j: usize) -> usize {
        i * (2 * self.half + 1) + j + self.half - i
    }

    /// Adds to an entry inside the band.
    pub(super) fn add(&mut self, i: usize, j: usize, value: f64) {
        let index = self.index(i, j);
        self.rows[index] += value;
    }

    /// Replaces the matrix by its factors, a lower one with ones on its diagonal and an upper one.
    ///
    /// # Errors
    /// When a pivot vanishes beside what its row was.
    pub(super) fn factor(&mut self) -> Result<(), NurbsError> {
        let largest = |row: &[f64]| row.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let scales: Vec<f64> = self.rows.chunks_exact(2 * self.half + 1).map(largest).collect();
        for (k, scale) in scales.into_iter().enumerate() {
            let pivot = self.rows[self.index(k, k)];
            let last = (k + self.half).min(self.size - 1);
            if !(pivot > (1e-13 * scale).max(f64::MIN_POSITIVE) && pivot.is_finite()) {
                return Err(NurbsError::Undetermined { index: k });
            }
            for i in k + 1..=last {
                let factor = self.rows[self.index(i, k)] / pivot;
                let (row, above) = (self.index(i, k), self.index(k, k));
                self.rows[row] = factor;
                for offset in 1..=last - k {
                    self.rows[row + offset] -= factor * self.rows[above + offset];
                }
            }
        }
        Ok(())
    }

    /// Solves for right sides of `width` numbers a row, in place; the matrix has been factored.
    pub(super) fn solve(&self, rhs: &mut [f64], width: usize) {
        for i in 0..self.size {
            self.subtract(rhs, width, i, i.saturating_sub(self.half)..i);
        }
        for i in (0..self.size).rev() {
            self.subtract(rhs, width, i, i + 1..(i + self.half + 1).min(self.size));
            let pivot = self.rows[self.index(i, i)];
            rhs[i * width..(i + 1) * width].iter_mut().for_each(|x| *x /= pivot);
        }
    }

    /// Row `i` less its entries in these columns times the rows there.
    fn subtract(&self, rhs: &mut [f64], width: usize, i: usize, columns: core::ops::Range<usize>) {
        for j in columns {
            let factor = self.rows[self.index(i, j)];
            for k in 0..width {
                rhs[i * width + k] -= factor * rhs[j * width + k];
            }
        }
    }
}
