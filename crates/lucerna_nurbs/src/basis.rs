//! B-spline basis functions and their derivatives.

use alloc::{vec, vec::Vec};

use crate::{KnotVector, MAX_DEGREE, NurbsError, Real};

/// The nonzero basis functions at one parameter, with derivatives.
///
/// At a parameter in span `i`, the control points `i - degree ..= i` have nonzero basis functions.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis<T> {
    span: usize,
    width: usize,
    values: Vec<T>,
}

impl<T: Real> Basis<T> {
    /// The span the parameter lies in.
    #[inline]
    pub fn span(&self) -> usize {
        self.span
    }

    /// The first control point with a nonzero basis function.
    #[inline]
    pub fn first(&self) -> usize {
        self.span + 1 - self.width
    }

    /// The derivatives of order `order` of the `degree + 1` nonzero basis functions, the values
    /// themselves for order 0; `None` above the order that was asked for.
    #[inline]
    pub fn derivative(&self, order: usize) -> Option<&[T]> {
        self.values.chunks_exact(self.width).nth(order)
    }

    pub(crate) fn row(&self, order: usize) -> &[T] {
        &self.values[order * self.width..(order + 1) * self.width]
    }
}

impl<T: Real> KnotVector<T> {
    /// The nonzero basis functions at `t` (The NURBS Book, A2.2).
    ///
    /// At a clamped end of the domain the end function is exactly 1, the others exactly 0.
    ///
    /// ```
    /// use lucerna_nurbs::KnotVector;
    ///
    /// let basis = KnotVector::<f64>::clamped_uniform(2, 3)?.basis_functions(0.5)?;
    /// assert_eq!(basis.derivative(0), Some(&[0.25, 0.5, 0.25][..]));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain.
    pub fn basis_functions(&self, t: T) -> Result<Basis<T>, NurbsError> {
        self.basis_derivatives(t, 0)
    }

    /// The nonzero basis functions at `t` with their derivatives up to `order` (A2.3).
    ///
    /// Derivatives above the degree are zero.
    ///
    /// ```
    /// use lucerna_nurbs::KnotVector;
    ///
    /// let basis = KnotVector::<f64>::clamped_uniform(2, 3)?.basis_derivatives(0.5, 2)?;
    /// assert_eq!(basis.derivative(1), Some(&[-1.0, 0.0, 1.0][..]));
    /// assert_eq!(basis.derivative(2), Some(&[2.0, -4.0, 2.0][..]));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain, or `order` is above [`MAX_DEGREE`].
    pub fn basis_derivatives(&self, t: T, order: usize) -> Result<Basis<T>, NurbsError> {
        self.check("t", t)?;
        check_order(order)?;
        Ok(self.basis(t, order))
    }

    /// [`basis_derivatives`](Self::basis_derivatives) for a checked parameter and order.
    pub(crate) fn basis(&self, t: T, order: usize) -> Basis<T> {
        let (p, span, knots) = (self.degree(), self.span(t), self.as_slice());
        let width = p + 1;
        // `ndu[j][r]`, j the row: basis functions of degree j above the diagonal, knot differences
        // below it, as in the book but with both stored as [row * width + column].
        let mut ndu = vec![T::ZERO; width * width];
        let left = |j: usize| t - knots[span + 1 - j];
        let right = |j: usize| knots[span + j] - t;
        ndu[0] = T::ONE;
        for j in 1..=p {
            let mut saved = T::ZERO;
            for r in 0..j {
                let (l, h) = (left(j - r), right(r + 1));
                let gap = h + l;
                ndu[j * width + r] = gap;
                let lower = ndu[r * width + j - 1];
                // The quotients first: at a clamped end they are exactly 0 and 1.
                ndu[r * width + j] = saved + lower * (h / gap);
                saved = lower * (l / gap);
            }
            ndu[j * width + j] = saved;
        }
        let mut values = vec![T::ZERO; (order + 1) * width];
        for j in 0..=p {
            values[j] = ndu[j * width + p];
        }
        differentiate(&ndu, p, order, &mut values);
        Basis { span, width, values }
    }
}

/// The second half of A2.3: derivatives from the triangle of functions and differences.
fn differentiate<T: Real>(ndu: &[T], p: usize, order: usize, values: &mut [T]) {
    let width = p + 1;
    let last = order.min(p);
    let mut a = [vec![T::ZERO; width], vec![T::ZERO; width]];
    for r in 0..=p {
        let (mut now, mut next) = (0, 1);
        a[0][0] = T::ONE;
        for k in 1..=last {
            let mut d = T::ZERO;
            let pk = p - k;
            if r >= k {
                a[next][0] = a[now][0] / ndu[(pk + 1) * width + r - k];
                d = a[next][0] * ndu[(r - k) * width + pk];
            }
            let from = if r + 1 >= k { 1 } else { k - r };
            let to = if r <= pk + 1 { k - 1 } else { p - r };
            for j in from..=to {
                let column = r + j - k;
                a[next][j] = (a[now][j] - a[now][j - 1]) / ndu[(pk + 1) * width + column];
                d += a[next][j] * ndu[column * width + pk];
            }
            if r <= pk {
                a[next][k] = -a[now][k - 1] / ndu[(pk + 1) * width + r];
                d += a[next][k] * ndu[r * width + pk];
            }
            values[k * width + r] = d;
            core::mem::swap(&mut now, &mut next);
        }
    }
    let mut factor = T::from_usize(p);
    for k in 1..=last {
        for value in &mut values[k * width..(k + 1) * width] {
            *value *= factor;
        }
        factor *= T::from_usize(p - k);
    }
}

pub(crate) fn check_order(order: usize) -> Result<(), NurbsError> {
    if order > MAX_DEGREE {
        return Err(NurbsError::Order { order });
    }
    Ok(())
}
