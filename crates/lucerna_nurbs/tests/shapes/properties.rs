//! Whatever is passed in is taken or refused: nothing panics, and what is taken stays finite.

use lucerna_nurbs::{Curve, Direction, FitSample, KnotVector, NurbsError, Spacing, Surface};
use proptest::collection::vec;
use proptest::prelude::*;

/// Numbers of all kinds, most of them harmless.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -2.0..2.0f64,
        2 => Just(0.0),
        2 => Just(1.0),
        1 => any::<f64>(),
        1 => Just(f64::NAN),
        1 => -1e308..1e308f64,
    ]
}

fn harmless() -> impl Strategy<Value = f64> {
    prop_oneof![4 => -1.0..1.0f64, 1 => Just(0.0), 1 => Just(0.5)]
}

/// Knots that are valid: of a degree, with repetitions, clamped or not.
fn knots() -> impl Strategy<Value = KnotVector<f64>> {
    (1usize..5, vec(1u8..8, 1..8), any::<bool>()).prop_filter_map("too often", |(degree, steps, clamped)| {
        let mut at = 0.0;
        let mut knots = vec![0.0; if clamped { degree + 1 } else { 1 }];
        for step in steps {
            // Of steps of 0, one in four, knots are repeated.
            at += f64::from(step / 2) * 0.25;
            knots.push(at);
        }
        knots.extend(vec![at + 1.0; if clamped { degree + 1 } else { 1 }]);
        KnotVector::new(degree, knots).ok()
    })
}

fn points(count: usize, number: impl Strategy<Value = f64>) -> impl Strategy<Value = Vec<[f64; 3]>> {
    vec(number, 3 * count).prop_map(|flat| flat.as_chunks().0.to_vec())
}

fn weight() -> impl Strategy<Value = f64> {
    prop_oneof![6 => 0.1..10.0f64, 1 => Just(1e-9), 1 => Just(1e9)]
}

fn curve() -> impl Strategy<Value = Curve<f64, 3>> {
    knots().prop_flat_map(|knots| {
        let n = knots.count();
        let parts = (points(n, harmless()), prop::option::of(vec(weight(), n)));
        parts.prop_map(move |(points, weights)| Curve::new(knots.clone(), points, weights).unwrap())
    })
}

fn surface() -> impl Strategy<Value = Surface<f64>> {
    (knots(), knots()).prop_flat_map(|(u, v)| {
        let n = u.count() * v.count();
        let parts = (points(n, harmless()), prop::option::of(vec(weight(), n)));
        parts.prop_map(move |(points, weights)| Surface::new(u.clone(), v.clone(), points, weights).unwrap())
    })
}

fn is_finite(points: &[[f64; 3]]) -> bool {
    points.as_flattened().iter().all(|x| x.is_finite())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() })]

    #[test]
    fn wrong_nets_are_refused_by_the_entry_that_is_wrong(
        u in knots(), v in knots(), fault in 0usize..8, place in any::<prop::sample::Index>(),
    ) {
        let n = u.count() * v.count();
        let k = place.index(n);
        let (mut net, mut weights) = (vec![[0.5; 3]; n], vec![1.0; n]);
        let bad = match fault {
            0 => { net.pop(); None }
            1 => { net.push([0.0; 3]); None }
            2 => { weights.pop(); None }
            3 => { net[k][k % 3] = f64::NAN; None }
            4 => Some(0.0),
            5 => Some(-1.0),
            6 => Some(f64::NAN),
            _ => { net.clear(); None }
        };
        bad.into_iter().for_each(|bad| weights[k] = bad);
        let (found, m) = (net.len(), weights.len());
        let error = Surface::new(u.clone(), v.clone(), net.clone(), Some(weights.clone())).unwrap_err();
        let named = match error {
            NurbsError::PointCount { found: f, expected } => f == found && expected == n && [0, 1, 7].contains(&fault),
            NurbsError::WeightCount { found: f, expected } => f == m && expected == n && fault == 2,
            NurbsError::PointValue { index, axis, .. } => (index, axis) == (k, k % 3) && fault == 3,
            NurbsError::Weight { index, .. } => index == k && (4..7).contains(&fault),
            _ => false,
        };
        prop_assert!(named, "{fault}: {error}");
    }

    #[test]
    fn wrong_knots_are_refused_by_the_entry_that_is_wrong(
        knots in knots(), fault in 0usize..4, place in any::<prop::sample::Index>(),
    ) {
        let (p, mut all) = (knots.degree(), knots.as_slice().to_vec());
        let k = 1 + place.index(all.len() - 1);
        let error = match fault {
            0 => {
                all[k] = all[k - 1] - 0.5;
                KnotVector::new(p, all).unwrap_err()
            }
            1 => {
                all[k] = f64::INFINITY;
                KnotVector::new(p, all).unwrap_err()
            }
            2 => {
                let inner = all[0] + 0.01;
                let at = all.partition_point(|&knot| knot < inner);
                all.splice(at..at, vec![inner; p + 1]);
                KnotVector::new(p, all).unwrap_err()
            }
            _ => KnotVector::new(all.len() - 1, all).unwrap_err(),
        };
        let named = match error {
            NurbsError::KnotDecreasing { index, .. } => index == k && fault == 0,
            NurbsError::KnotValue { index, .. } => index == k && fault == 1,
            NurbsError::KnotRepeated { value, .. } => value == knots.as_slice()[0] + 0.01 && fault == 2,
            NurbsError::KnotCount { .. } | NurbsError::Degree { .. } => fault == 3,
            _ => false,
        };
        prop_assert!(named, "{fault}: {error}");
    }

    #[test]
    fn curves_take_or_refuse_any_parameter(
        curve in curve(), t in number(), s in number(), times in 0usize..9, tolerance in number(),
    ) {
        let (lo, hi) = curve.domain();
        let inside = |t: f64| t >= lo && t <= hi;
        let evaluated = curve.derivatives(t, times);
        prop_assert_eq!(evaluated.is_ok(), inside(t));
        prop_assert_eq!(curve.trim(t, s).is_ok(), inside(t) && inside(s) && t < s);
        prop_assert_eq!(curve.split(t).is_ok(), inside(t) && t > lo && t < hi);
        let room = curve.knots().degree().saturating_sub(curve.knots().multiplicity(t));
        prop_assert_eq!(curve.insert_knot(t, times).is_ok(), inside(t) && (times <= room || times == 0));
        if let Ok((curve, removed)) = curve.remove_knot(t, times, tolerance) {
            prop_assert!(removed <= times && is_finite(curve.points()));
        }
        if let Ok(wrapped) = curve.knots().wrap(t) {
            prop_assert!(inside(wrapped));
        }
        let _ = curve.elevate(times).unwrap();
        if let Ok(point) = curve.closest_point([t, s, tolerance]) {
            prop_assert!(inside(point.t) && !point.distance.is_nan());
        }
        prop_assert_eq!(curve.tight_bounds(tolerance).is_ok(), tolerance > 0.0 && tolerance.is_finite());
        let _ = curve.revolve([t; 3], [s, t, 1.0], tolerance);
        let _ = curve.extrude([t, s, tolerance]);
    }

    #[test]
    fn surfaces_take_or_refuse_any_parameter(surface in surface(), t in number(), s in number(), times in 0usize..4) {
        for direction in [Direction::U, Direction::V] {
            let _ = surface.insert_knot(direction, t, times);
            let _ = surface.trim(direction, t, s);
            let _ = surface.split(direction, t);
            let _ = surface.iso_curve(direction, t);
            let _ = surface.remove_knot(direction, t, times, s);
            prop_assert!(is_finite(surface.elevate(direction, times).unwrap().points()));
            prop_assert!(is_finite(surface.reverse(direction).unwrap().points()));
        }
        let (u, v) = (surface.knots_u().domain(), surface.knots_v().domain());
        let inside = t >= u.0 && t <= u.1 && s >= v.0 && s <= v.1;
        prop_assert_eq!(surface.derivatives(t, s, times).is_ok(), inside);
        if let Ok(normal) = surface.normal(t, s) {
            prop_assert!((normal.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn any_points_are_fitted_or_refused(
        points in (0usize..12).prop_flat_map(|n| points(n, number())),
        parameters in vec(number(), 0..12),
        degree in 0usize..6,
        count in 0usize..14,
        weights in vec(number(), 12),
    ) {
        for spacing in [Spacing::Even, Spacing::ChordLength, Spacing::Centripetal] {
            let Ok(parameters) = spacing.parameters(&points) else { continue };
            for curve in [
                Curve::interpolate(degree, &points, &parameters),
                Curve::approximate(degree, count, &points, &parameters),
            ].into_iter().flatten() {
                prop_assert!(is_finite(curve.points()));
            }
            if let Ok((u, v)) = spacing.grid(&points, count) {
                let _ = Surface::interpolate(degree, 1, &points, &u, &v);
                let _ = Surface::approximate([1, degree], [2, count], &points, &u, &v);
            }
        }
        let _ = Curve::interpolate(degree, &points, &parameters);
        let _ = Curve::approximate(degree, count, &points, &parameters);
        let samples = points.iter().zip(&parameters).zip(&weights).enumerate();
        let samples: Vec<FitSample<f64, 3>> = samples
            .map(|(k, ((&point, &t), &weight))| match k % 4 {
                0 => FitSample::point(t, point).exact(),
                1 => FitSample::point(t, point).weighted(weight),
                2 => FitSample::derivative(t, k / 4, point),
                _ => FitSample::point(t, point),
            })
            .collect();
        if let Ok(curve) = Curve::fit(degree, count, &samples) {
            prop_assert!(is_finite(curve.points()));
        }
    }

    #[test]
    fn any_curves_are_joined_to_a_surface_or_refused(a in curve(), b in curve(), c in curve(), degree in 0usize..4) {
        prop_assert!(is_finite(Surface::ruled(&a, &b).unwrap().points()));
        if let Ok((surface, v)) = Surface::loft(&[a, b, c], degree) {
            prop_assert!(is_finite(surface.points()));
            prop_assert_eq!((v[0], v[2]), (0.0, 1.0));
        }
    }
}
