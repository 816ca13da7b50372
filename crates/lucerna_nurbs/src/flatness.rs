//! How far Bezier patches are from flat.
//!
//! In a cell of sides `h` and `k`, a triangle between points of the surface errs by at most
//! `(h^2 |S_uu| + 2 h k |S_uv| + k^2 |S_vv|) / 8`, wherever in the cell its corners are (Filip,
//! Magedson and Markot, Surface algorithms using bounds on derivatives, 1986). A polynomial patch is
//! bounded by its control points, so its derivatives are by differences of these. Derivatives of a
//! rational patch are rational, `S_uv = N / W^3`, and lie within the quotients of the coefficients of
//! `N` and `W^3`, as these are positive.

use alloc::vec::Vec;

use crate::Real;
use crate::bernstein::Bernstein;
use crate::patch::Patch;
use crate::vector::{dot, largest};

/// Bounds of the second derivatives of a patch whose sides have length one: along u, mixed, along v.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Bend {
    pub(crate) uu: f64,
    pub(crate) uv: f64,
    pub(crate) vv: f64,
}

impl Bend {
    /// The greatest distance of the patch from triangles between any of its points.
    pub(crate) fn distance(&self) -> f64 {
        0.125 * (self.uu + 2.0 * self.uv + self.vv)
    }
}

/// A vector of polynomials.
type Vector = [Bernstein; 3];

impl Patch<3> {
    /// How the patch bends.
    pub(crate) fn bend(&self) -> Bend {
        let (points, weight) = self.polynomials();
        let second = |k: usize, l: usize| points.each_ref().map(|x| x.derivative(k).derivative(l));
        let Some(w) = weight else {
            let size = |v: &Vector| greatest(v, None);
            return Bend { uu: size(&second(0, 0)), uv: size(&second(0, 1)), vv: size(&second(1, 1)) };
        };
        let cube = w.times(&w).times(&w);
        // S_k = G / W^2, then S_kl = (G_l W - 2 G W_l) / W^3.
        let size = |k: usize, l: usize| {
            let g = numerator(&points, &w, k);
            let slope = w.derivative(l);
            let n = g.each_ref().map(|g| g.derivative(l).times(&w).mix(1.0, &g.times(&slope), -2.0));
            greatest(&n, Some(&cube))
        };
        Bend { uu: size(0, 0), uv: size(0, 1), vv: size(1, 1) }
    }

    /// The greatest jump of the first derivative along `direction` from this patch to the next one,
    /// in the unit of its parameter.
    pub(crate) fn jump(&self, next: &Self, direction: usize) -> f64 {
        let edge = |patch: &Self, upper: bool| {
            let rate = 1.0 / (patch.hi[direction] - patch.lo[direction]);
            let (points, weight) = patch.polynomials();
            let Some(w) = weight else {
                let slope = points.each_ref().map(|x| border(&x.derivative(direction), direction, upper));
                return (slope, rate, None);
            };
            let g = numerator(&points, &w, direction);
            let w = border(&w, direction, upper);
            (g.each_ref().map(|g| border(g, direction, upper)), rate, Some(w.times(&w)))
        };
        let ((below, rate_below, square), (above, rate_above, _)) = (edge(self, true), edge(next, false));
        let [x, y, z] = below;
        let jump = [(x, &above[0]), (y, &above[1]), (z, &above[2])]
            .map(|(below, above)| below.mix(rate_below, above, -rate_above));
        greatest(&jump, square.as_ref())
    }

    /// The coordinates times the weight, about the first control point, and the weight, where it is
    /// not the same everywhere.
    fn polynomials(&self) -> (Vector, Option<Bernstein>) {
        let all: Vec<([f64; 3], f64)> = self.homogeneous().collect();
        let (first, scale) = (all[0].0.map(|x| x / all[0].1), all[0].1);
        let constant = all.iter().all(|(_, w)| *w == scale);
        let axis = |k: usize| all.iter().map(move |(p, w)| p[k] - first[k] * w);
        let by = if constant { 1.0 / scale } else { 1.0 };
        let points = [0, 1, 2].map(|k| Bernstein::new(self.counts(), axis(k).map(|x| x * by)));
        (points, (!constant).then(|| Bernstein::new(self.counts(), all.iter().map(|(_, w)| *w))))
    }
}

/// `W^2` times the first derivative of `F / W`: `F_k W - F W_k`.
fn numerator(points: &Vector, w: &Bernstein, k: usize) -> Vector {
    let slope = w.derivative(k);
    points.each_ref().map(|x| x.derivative(k).times(w).mix(1.0, &x.times(&slope), -1.0))
}

/// A polynomial at an end of a direction.
fn border(p: &Bernstein, direction: usize, upper: bool) -> Bernstein {
    let [rows, columns] = p.counts();
    // End coefficients have the binomial one in their direction.
    if direction == 0 {
        let line = if upper { rows - 1 } else { 0 };
        Bernstein::from_scaled([1, columns], p.scaled()[line * columns..(line + 1) * columns].to_vec())
    } else {
        let line = if upper { columns - 1 } else { 0 };
        Bernstein::from_scaled([rows, 1], p.scaled().iter().skip(line).step_by(columns).copied().collect())
    }
}

/// The greatest length of coefficients; of their quotients by those of `by`.
fn greatest(v: &Vector, by: Option<&Bernstein>) -> f64 {
    let elevated = by.map(|by| v.each_ref().map(|x| x.elevated(by.counts())));
    let one;
    let (v, by) = match (&elevated, by) {
        (Some(v), Some(by)) => (v, by),
        _ => {
            let counts = v[0].counts();
            one = Bernstein::new(counts, core::iter::repeat_n(1.0, counts[0] * counts[1]));
            (v, &one)
        }
    };
    let lengths = by.scaled().iter().enumerate().map(|(k, by)| length([0, 1, 2].map(|axis| v[axis].scaled()[k])) / by);
    lengths.fold(0.0, f64::max)
}

pub(crate) fn length(a: [f64; 3]) -> f64 {
    let size = largest(a);
    if size == 0.0 {
        return 0.0;
    }
    let b = [a[0] / size, a[1] / size, a[2] / size];
    size * Real::sqrt(dot(b, b))
}
