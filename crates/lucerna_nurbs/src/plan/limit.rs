//! Normals where the product of the tangents vanishes.

use super::GridPlan;
use super::axis::Axis;
use super::axis::Sample;
use super::net::Net;
use crate::Real;
use crate::vector::{add_scaled, cross, largest, scale, sub, unit, unit_cross};

/// The length below which a first derivative of a net of size 1 is rounding.
pub(super) fn flat<T: Real>() -> T {
    T::from_f64(64.0) * T::EPSILON
}

/// A point of the scaled net with its derivatives.
struct Jet<T> {
    s: [T; 3],
    su: [T; 3],
    sv: [T; 3],
    suv: [T; 3],
}

impl<T: Real> GridPlan<T> {
    /// Computes anew the normals of row `j` from vertex `start` on that are not marked as good.
    #[cold]
    pub(super) fn repair(&self, net: &Net<'_, T>, start: usize, j: usize, good: u64, row: &mut [[T; 8]]) {
        for (lane, vertex) in row.iter_mut().enumerate().take(64) {
            if good >> lane & 1 == 0 {
                let [x, y, z] = self.limit_normal(net, start + lane, j);
                (vertex[4], vertex[5], vertex[6]) = (x, y, z);
            }
        }
    }

    /// The control point into which row `j` collapses, when it does.
    pub(super) fn collapsed(&self, net: &Net<'_, T>, j: usize) -> Option<[T; 3]> {
        let column = self.v.only_point(j)?;
        let first = net.points[column];
        let mut rest = net.points[column..].iter().step_by(net.n_v);
        rest.all(|&point| point == first).then_some(first)
    }

    /// The place of sample `i` of row `j`.
    pub(super) fn position(&self, net: &Net<'_, T>, i: usize, j: usize) -> [T; 3] {
        let mut position = net.origin;
        add_scaled(&mut position, &self.jet(net, self.u.sample(i), self.v.sample(j)).s, net.size);
        position
    }

    /// The normal of vertex `i` of row `j` when the fast one cannot be trusted, or is at a pole.
    pub(super) fn limit_normal(&self, net: &Net<'_, T>, i: usize, j: usize) -> [T; 3] {
        let first = j == 0 && self.v.open;
        let last = j == self.options.rows && self.v.open;
        let pole = (first && self.options.pole_v_min) || (last && self.options.pole_v_max);
        let axis = self.middle.as_ref().filter(|_| pole).map_or(&self.u, |middle| &middle.axis);
        let jet = self.jet(net, axis.sample(i), self.v.sample(j));
        let left = i == 0 && self.u.open && !pole;
        let right = i == self.options.columns && self.u.open && !pole;

        let flat_u = largest(jet.su) <= flat();
        let flat_v = largest(jet.sv) <= flat();
        let twisted = largest(jet.suv) > flat();
        let normal = match (flat_u, flat_v) {
            (false, false) => unit_cross(jet.su, jet.sv),
            (true, false) if first && twisted => unit_cross(jet.suv, jet.sv),
            (true, false) if last && twisted => unit_cross(jet.sv, jet.suv),
            (false, true) if left && twisted => unit_cross(jet.su, jet.suv),
            (false, true) if right && twisted => unit_cross(jet.suv, jet.su),
            _ => None,
        };
        let turn = |normal| if self.options.flip { scale(normal, -T::ONE) } else { normal };
        normal
            .or_else(|| self.face_normal(net, i, j, jet.s, pole))
            .map_or_else(|| along(net, self.v.points, first), turn)
    }

    /// The direction of the sum of the triangles around a vertex.
    fn face_normal(&self, net: &Net<'_, T>, i: usize, j: usize, center: [T; 3], pole: bool) -> Option<[T; 3]> {
        let (columns, rows) = (self.options.columns, self.options.rows);
        let at = |i: Option<usize>, j: Option<usize>| {
            let (u, v) = (self.u.sample(i?), self.v.sample(j?));
            Some(sub(self.jet(net, u, v).s, center))
        };
        let (south, north) = neighbours(&self.v, j, rows);
        let (sum, reach) = if pole {
            // The triangle from the pole to the corners of column `i` in the next row.
            let (west, east) = (at(Some(i), north.or(south)), at(Some(i + 1), north.or(south)));
            let (from, to) = if north.is_some() { (east, west) } else { (west, east) };
            fan(&[from, to])
        } else {
            let (west, east) = neighbours(&self.u, i, columns);
            let (here, level) = (Some(i), Some(j));
            let (e, n, w, s) = (at(east, level), at(here, north), at(west, level), at(here, south));
            let quarters =
                [[e, at(east, north), n], [n, at(west, north), w], [w, at(west, south), s], [s, at(east, south), e]];
            let mut total = ([T::ZERO; 3], T::ZERO);
            for (sum, reach) in quarters.iter().map(|quarter| fan(quarter)) {
                add_scaled(&mut total.0, &sum, T::ONE);
                total.1 = total.1.max(reach);
            }
            total
        };
        if largest(sum) > flat::<T>() * reach { unit(sum) } else { None }
    }

    /// Point and derivatives at any pair of samples, straight from the net.
    fn jet(&self, net: &Net<'_, T>, u: Sample<'_, T>, v: Sample<'_, T>) -> Jet<T> {
        let n_v = self.v.points;
        let mut sums = [[T::ZERO; 4]; 4];
        for (k, &i) in u.indices.iter().enumerate() {
            let row = &net.scaled[i * n_v * net.parts..(i + 1) * n_v * net.parts];
            for (l, &j) in v.indices.iter().enumerate() {
                let mut point = [T::ZERO; 4];
                for (axis, x) in point.iter_mut().take(net.parts).enumerate() {
                    *x = row[j * net.parts + axis];
                }
                add_scaled(&mut sums[0], &point, u.values[k] * v.values[l]);
                add_scaled(&mut sums[1], &point, u.slopes[k] * v.values[l]);
                add_scaled(&mut sums[2], &point, u.values[k] * v.slopes[l]);
                add_scaled(&mut sums[3], &point, u.slopes[k] * v.slopes[l]);
            }
        }
        let [a, au, av, auv] = sums.map(|[x, y, z, _]| [x, y, z]);
        let [w, wu, wv, wuv] = sums.map(|sum| sum[3]);
        if net.parts == 3 {
            return Jet { s: a, su: au, sv: av, suv: auv };
        }
        let by = T::ONE / w;
        let s = scale(a, by);
        let less = |mut a: [T; 3], terms: [([T; 3], T); 3]| {
            for (b, factor) in terms {
                add_scaled(&mut a, &b, -factor);
            }
            scale(a, by)
        };
        let none = ([T::ZERO; 3], T::ZERO);
        let su = less(au, [(s, wu), none, none]);
        let sv = less(av, [(s, wv), none, none]);
        let suv = less(auv, [(s, wuv), (sv, wu), (su, wv)]);
        Jet { s, su, sv, suv }
    }
}

/// Twice the area vectors of the triangles between the origin and neighbouring points, summed up,
/// and the largest coordinate of the points. Points that do not exist are left out.
fn fan<T: Real>(points: &[Option<[T; 3]>]) -> ([T; 3], T) {
    let mut sum = [T::ZERO; 3];
    let mut reach = T::ZERO;
    let mut previous = None;
    for point in points.iter().flatten() {
        if let Some(before) = previous {
            add_scaled(&mut sum, &cross(before, *point), T::ONE);
        }
        reach = reach.max(largest(*point));
        previous = Some(*point);
    }
    (sum, reach)
}

/// The samples before and behind sample `i` of `cells + 1`, around the seam of a closed direction.
fn neighbours<T>(axis: &Axis<T>, i: usize, cells: usize) -> (Option<usize>, Option<usize>) {
    let before = match i.checked_sub(1) {
        None if !axis.open => Some(cells - 1),
        before => before,
    };
    let behind = if i < cells {
        Some(i + 1)
    } else if axis.open {
        None
    } else {
        Some(1)
    };
    (before, behind)
}

/// The direction of the net along v, outwards at its lower end; up when it has none.
fn along<T: Real>(net: &Net<'_, T>, n_v: usize, first: bool) -> [T; 3] {
    let direction = unit(sub(net.points[n_v - 1], net.points[0]));
    match direction {
        Some(direction) if first => scale(direction, -T::ONE),
        Some(direction) => direction,
        None => [T::ZERO, T::ONE, T::ZERO],
    }
}
