//! Takes whatever the bytes are for knots, nets, weights and parameters; what is accepted must go
//! through every operation without a panic, and stay where it is when it is edited.

#![no_main]

use libfuzzer_sys::fuzz_target;
use lucerna_nurbs::{Curve, Direction, GridOptions, GridPlan, KnotVector, Spacing, Surface};

/// Bytes, taken one number after the other; zeros when there are none left.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn byte(&mut self) -> u8 {
        let (&first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        first
    }

    /// A number of any kind; most often one of few, so that knots repeat and points coincide.
    fn number(&mut self) -> f64 {
        match self.byte() {
            0 => f64::NAN,
            1 => f64::from_le_bytes([0; 8].map(|_: u8| self.byte())),
            2 => f64::MAX,
            3 => f64::MIN_POSITIVE,
            small => f64::from(small / 4) / 8.0 - 3.0,
        }
    }

    fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    fn knots(&mut self) -> Option<KnotVector<f64>> {
        let degree = usize::from(self.byte() % 8);
        let count = usize::from(self.byte() % 24);
        let mut knots = self.numbers(count);
        if self.byte() % 4 > 0 {
            knots.sort_by(f64::total_cmp);
        }
        KnotVector::new(degree, knots).ok()
    }

    fn points(&mut self, count: usize) -> Vec<[f64; 3]> {
        (0..count).map(|_| [self.number(), self.number(), self.number()]).collect()
    }

    fn weights(&mut self, count: usize) -> Option<Vec<f64>> {
        (self.byte() % 2 > 0).then(|| self.numbers(count))
    }
}

/// Whether edited points are where they were, for coordinates and weights of ordinary size.
fn check_same(points: &[[f64; 3]], weights: Option<&[f64]>, a: [f64; 3], b: [f64; 3]) {
    let ordinary = points.as_flattened().iter().all(|x| x.abs() < 1e3);
    if ordinary && weights.is_none_or(|weights| weights.iter().all(|w| (0.01..100.0).contains(w))) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6), "{a:?} {b:?}");
    }
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let Some(knots) = bytes.knots() else { return };
    let (n, t, s) = (knots.count(), bytes.number(), bytes.number());
    let (points, weights) = (bytes.points(n), bytes.weights(n));
    for spacing in [Spacing::Even, Spacing::ChordLength, Spacing::Centripetal] {
        if let Ok(parameters) = spacing.parameters(&points) {
            let _ = Curve::interpolate(knots.degree(), &points, &parameters);
            let _ = Curve::approximate(knots.degree(), n.div_ceil(2), &points, &parameters);
        }
    }
    let Ok(curve) = Curve::new(knots.clone(), points, weights) else { return };
    let times = usize::from(bytes.byte() % 9);
    let edited = [
        curve.insert_knot(t, times),
        curve.trim(t, s),
        curve.clamp(),
        curve.elevate(times % 3),
        curve.split(t).map(|(low, _)| low),
    ];
    for edited in edited.into_iter().flatten() {
        let (lo, hi) = edited.domain();
        for t in [lo, lo + (hi - lo) * 0.3, hi] {
            if let (Ok(a), Ok(b)) = (edited.point(t), curve.point(t)) {
                check_same(curve.points(), curve.weights(), a, b);
            }
        }
    }
    let _ = (curve.remove_knot(t, times, s), curve.closest_point([t, s, 0.0]), curve.tight_bounds(s));
    let _ = (curve.reverse(), curve.bezier_pieces(), knots.wrap(t), curve.derivatives(t, times));
    let _ = curve.revolve([s, t, 0.0], [t, 1.0, s], t);

    let Some(knots_v) = bytes.knots() else { return };
    let n = n * knots_v.count();
    let (points, weights) = (bytes.points(n), bytes.weights(n));
    let Ok(surface) = Surface::new(knots, knots_v, points, weights) else { return };
    let _ = (surface.normal(t, s), surface.derivatives(t, s, times), surface.closest_point([t, s, 0.0]));
    for direction in [Direction::U, Direction::V] {
        let _ = (surface.insert_knot(direction, t, times), surface.split(direction, t));
        let _ = (surface.remove_knot(direction, t, times, s), surface.elevate(direction, times % 3));
        let _ = (surface.reverse(direction), surface.iso_curve(direction, t));
    }
    let options = GridOptions { columns: 5, rows: 4, ..GridOptions::default() };
    let plan = GridPlan::new(surface.knots_u(), surface.knots_v(), options).expect("a size that is allowed");
    let normals = |vertex: lucerna_nurbs::GridVertex<f64>| assert!(vertex.normal.iter().all(|x| x.is_finite()));
    let _ = plan.evaluate(surface.points(), surface.weights(), &mut plan.scratch(), |_, vertex| normals(vertex));
});
