//! Values of curves and surfaces by another way: the Cox-de Boor recursion with its derivatives by
//! the product rule, in double-double arithmetic (about 31 digits).

use lucerna_nurbs::{Curve, KnotVector, Surface};
use std::ops::{Add, Div, Mul, Sub};

/// A sum of two numbers, the second below half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Dd(f64, f64);

fn sum(a: f64, b: f64) -> Dd {
    let s = a + b;
    let t = s - a;
    Dd(s, (a - (s - t)) + (b - t))
}

fn product(a: f64, b: f64) -> Dd {
    let split = |x: f64| {
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let (p, (a1, a2), (b1, b2)) = (a * b, split(a), split(b));
    Dd(p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl From<f64> for Dd {
    fn from(x: f64) -> Self {
        Self(x, 0.0)
    }
}

impl From<Dd> for f64 {
    fn from(x: Dd) -> Self {
        x.0 + x.1
    }
}

impl Add for Dd {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (s, t) = (sum(self.0, other.0), sum(self.1, other.1));
        let s = sum(s.0, s.1 + t.0);
        sum(s.0, s.1 + t.1)
    }
}

impl Sub for Dd {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Self(-other.0, -other.1)
    }
}

impl Mul for Dd {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = product(self.0, other.0);
        sum(p.0, p.1 + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Dd {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self - other * Self::from(first);
        let second = rest.0 / other.0;
        let rest = rest - other * Self::from(second);
        sum(first, second) + Self::from(rest.0 / other.0)
    }
}

/// A function of the parameter with two derivatives.
type Jet = [Dd; 3];

/// All basis functions at `t`. The upper end of the domain belongs to the span below it.
pub(crate) fn basis(knots: &[f64], degree: usize, t: f64) -> Vec<Jet> {
    let hi = knots[knots.len() - degree - 1];
    let (zero, one) = (Dd::default(), Dd::from(1.0));
    let inside = |w: &[f64]| if t < hi { w[0] <= t && t < w[1] } else { w[0] < t && t <= w[1] };
    let mut all: Vec<Jet> = knots.windows(2).map(|w| [if inside(w) { one } else { zero }, zero, zero]).collect();
    let difference = |a: f64, b: f64| Dd::from(a) - Dd::from(b);
    // N (t - from) / gap with its derivatives, zero where the gap is.
    let ramp = |n: Jet, from: f64, gap: Dd| {
        if gap.0 == 0.0 {
            return [zero; 3];
        }
        let (f, slope) = (difference(t, from) / gap, one / gap);
        [f * n[0], f * n[1] + slope * n[0], f * n[2] + slope * n[1] + slope * n[1]]
    };
    for p in 1..=degree {
        for i in 0..all.len() - 1 {
            let up = ramp(all[i], knots[i], difference(knots[i + p], knots[i]));
            let down = ramp(all[i + 1], knots[i + p + 1], difference(knots[i + 1], knots[i + p + 1]));
            all[i] = [0, 1, 2].map(|k| up[k] + down[k]);
        }
        all.pop();
    }
    all
}

/// Point, first and second derivative of a curve.
pub(crate) fn curve<const D: usize>(curve: &Curve<f64, D>, t: f64) -> [[f64; D]; 3] {
    let basis = basis(curve.knots().as_slice(), curve.knots().degree(), t);
    let mut a = [[Dd::default(); D]; 3];
    let mut w = [Dd::default(); 3];
    for (i, (n, point)) in basis.iter().zip(curve.points()).enumerate() {
        let weight = Dd::from(curve.weights().map_or(1.0, |w| w[i]));
        for k in 0..3 {
            w[k] = w[k] + n[k] * weight;
            for axis in 0..D {
                a[k][axis] = a[k][axis] + n[k] * weight * Dd::from(point[axis]);
            }
        }
    }
    let mut out = [[0.0; D]; 3];
    for axis in 0..D {
        let c = a[0][axis] / w[0];
        let c1 = (a[1][axis] - w[1] * c) / w[0];
        let c2 = (a[2][axis] - w[1] * c1 - w[1] * c1 - w[2] * c) / w[0];
        (out[0][axis], out[1][axis], out[2][axis]) = (c.into(), c1.into(), c2.into());
    }
    out
}

/// The orders of the derivatives that [`surface`] returns.
pub(crate) const ORDERS: [(usize, usize); 6] = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)];

/// Point and derivatives of a surface, in the order of [`ORDERS`].
pub(crate) fn surface(surface: &Surface<f64>, u: f64, v: f64) -> [[f64; 3]; 6] {
    let of = |knots: &KnotVector<f64>, t| basis(knots.as_slice(), knots.degree(), t);
    let (bu, bv) = (of(surface.knots_u(), u), of(surface.knots_v(), v));
    let mut a = [[Dd::default(); 4]; 6];
    for (i, nu) in bu.iter().enumerate().filter(|(_, n)| n.iter().any(|x| x.0 != 0.0)) {
        for (j, nv) in bv.iter().enumerate().filter(|(_, n)| n.iter().any(|x| x.0 != 0.0)) {
            let index = i * bv.len() + j;
            let [x, y, z] = surface.points()[index].map(Dd::from);
            let weight = Dd::from(surface.weights().map_or(1.0, |w| w[index]));
            for (sum, (k, l)) in a.iter_mut().zip(ORDERS) {
                let factor = nu[k] * nv[l] * weight;
                for (sum, x) in sum.iter_mut().zip([x, y, z, Dd::from(1.0)]) {
                    *sum = *sum + factor * x;
                }
            }
        }
    }
    let [w, wu, wv, wuu, wuv, wvv] = a.map(|a| a[3]);
    let mut out = [[0.0; 3]; 6];
    for axis in 0..3 {
        let [a, au, av, auu, auv, avv] = a.map(|a| a[axis]);
        let s = a / w;
        let su = (au - wu * s) / w;
        let sv = (av - wv * s) / w;
        let suu = (auu - wu * su - wu * su - wuu * s) / w;
        let suv = (auv - wu * sv - wv * su - wuv * s) / w;
        let svv = (avv - wv * sv - wv * sv - wvv * s) / w;
        for (out, x) in out.iter_mut().zip([s, su, sv, suu, suv, svv]) {
            out[axis] = x.into();
        }
    }
    out
}
