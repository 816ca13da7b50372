//! Editing leaves curves and surfaces where they are.

use crate::nets::{parameters, size};
use crate::{nets, oracle};
use lucerna_nurbs::{Curve, Direction, KnotVector, NurbsError, Surface};

/// The largest difference of two curves on the domain of the first, by the size of the second.
fn moved(a: &Curve<f64, 3>, b: &Curve<f64, 3>) -> f64 {
    let mut worst = 0.0f64;
    for t in parameters(a.knots(), 31) {
        let (p, q) = (a.point(t).unwrap(), oracle::curve(b, t)[0]);
        (0..3).for_each(|axis| worst = worst.max((p[axis] - q[axis]).abs()));
    }
    worst / size(b.points())
}

/// The same for surfaces.
fn surface_moved(a: &Surface<f64>, b: &Surface<f64>) -> f64 {
    let mut worst = 0.0f64;
    for u in parameters(a.knots_u(), 7) {
        for v in parameters(a.knots_v(), 5) {
            let (p, q) = (a.point(u, v).unwrap(), b.point(u, v).unwrap());
            (0..3).for_each(|axis| worst = worst.max((p[axis] - q[axis]).abs()));
        }
    }
    worst / size(b.points())
}

/// Some parameters to insert: inside spans, at the knots, at the ends, as often as they may be.
fn insertions(knots: &KnotVector<f64>) -> Vec<f64> {
    let mut all = Vec::new();
    for (k, t) in parameters(knots, 9).into_iter().enumerate() {
        let there = knots.multiplicity(t) + all.iter().filter(|&&other| other == t).count();
        let room = knots.degree().saturating_sub(there);
        all.extend(vec![t; room.min(1 + k % 3)]);
    }
    all
}

#[test]
fn curves_stay_where_they_are() {
    let mut worst = 0.0f64;
    for (name, curve) in nets::curves() {
        let mut check = |what: &str, edited: &Curve<f64, 3>| {
            let moved = moved(edited, &curve);
            assert!(moved <= 1e-12, "{name}, {what}: {moved:e}");
            worst = worst.max(moved);
        };
        let (lo, hi) = curve.domain();
        let middle = lo + (hi - lo) * 0.37;
        let new = insertions(curve.knots());
        let refined = curve.refine(&new).unwrap();
        assert_eq!(refined.points().len(), curve.points().len() + new.len());
        check("refined", &refined);
        let one_by_one = new.iter().fold(curve.clone(), |curve, &t| curve.insert_knot(t, 1).unwrap());
        assert_eq!(one_by_one.knots(), refined.knots());
        check("knots inserted", &one_by_one);
        check("clamped", &curve.clamp().unwrap());
        assert!(curve.clamp().unwrap().knots().is_clamped());
        check("trimmed", &curve.trim(middle, hi).unwrap());
        let (low, high) = curve.split(middle).unwrap();
        assert_eq!((low.domain(), high.domain()), ((lo, middle), (middle, hi)));
        assert_eq!(low.points().last(), high.points().first());
        check("lower part", &low);
        check("upper part", &high);
        for piece in curve.bezier_pieces().unwrap() {
            assert_eq!(piece.points().len(), curve.knots().degree() + 1);
            check("Bezier piece", &piece);
        }
        for by in 1..=3 {
            let elevated = curve.elevate(by).unwrap();
            assert_eq!(elevated.knots().degree(), curve.knots().degree() + by);
            check("elevated", &elevated);
        }
        let back = curve.reverse().unwrap();
        let there = moved(&back.reverse().unwrap(), &curve);
        assert!(there < 1e-12, "{name}: {there:e}");
        for k in 0..=20 {
            let (s, t) = (f64::from(k) / 20.0, 1.0 - f64::from(k) / 20.0);
            let (a, b) = (back.point(lo + (hi - lo) * s).unwrap(), curve.point(lo + (hi - lo) * t).unwrap());
            assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-12 * size(curve.points())), "{name}, reversed");
        }
    }
    println!("moved by {worst:e} of the size at most");
}

#[test]
fn surfaces_stay_where_they_are() {
    let mut worst = 0.0f64;
    for (name, surface) in nets::surfaces() {
        let mut check = |what: &str, edited: &Surface<f64>| {
            let moved = surface_moved(edited, &surface);
            assert!(moved <= 1e-12, "{name}, {what}: {moved:e}");
            worst = worst.max(moved);
        };
        for direction in [Direction::U, Direction::V] {
            let (lo, hi) = surface.knots(direction).domain();
            let middle = lo + (hi - lo) * 0.37;
            check("refined", &surface.refine(direction, &insertions(surface.knots(direction))).unwrap());
            let (low, high) = surface.split(direction, middle).unwrap();
            check("lower part", &low);
            check("upper part", &high);
            check("elevated", &surface.elevate(direction, 2).unwrap());
            let turned = surface.reverse(direction).unwrap().reverse(direction).unwrap();
            check("reversed twice", &turned);
        }
        let clamped = surface.clamp().unwrap();
        assert!(clamped.knots_u().is_clamped() && clamped.knots_v().is_clamped());
        check("clamped", &clamped);
        let patches = surface.bezier_patches().unwrap();
        let size = (surface.knots_u().degree() + 1) * (surface.knots_v().degree() + 1);
        for patch in patches.iter().step_by(1 + patches.len() / 12) {
            assert_eq!(patch.points().len(), size);
            check("Bezier patch", patch);
        }
        assert_eq!(surface.transpose().transpose(), surface);
    }
    println!("moved by {worst:e} of the size at most");
}

#[test]
fn removing_inserted_knots_restores_the_net() {
    let mut worst = 0.0f64;
    for (name, curve) in nets::curves() {
        let size = size(curve.points());
        let (lo, hi) = curve.domain();
        let t = lo + (hi - lo) * 0.43;
        let degree = curve.knots().degree();
        let (back, removed) = curve.insert_knot(t, degree).unwrap().remove_knot(t, degree + 3, 1e-9 * size).unwrap();
        assert_eq!(removed, degree, "{name}");
        assert_eq!(back.knots(), curve.knots(), "{name}");
        for (a, b) in back.points().iter().zip(curve.points()) {
            (0..3).for_each(|axis| worst = worst.max((a[axis] - b[axis]).abs() / size));
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
    println!("curves: points restored to {worst:e}");
    for (name, surface) in nets::surfaces() {
        let size = size(surface.points());
        for direction in [Direction::U, Direction::V] {
            let (lo, hi) = surface.knots(direction).domain();
            let t = lo + (hi - lo) * 0.43;
            let refined = surface.insert_knot(direction, t, 1).unwrap();
            let (back, removed) = refined.remove_knot(direction, t, 1, 1e-9 * size).unwrap();
            assert_eq!(removed, 1, "{name}");
            for (a, b) in back.points().iter().zip(surface.points()) {
                (0..3).for_each(|axis| worst = worst.max((a[axis] - b[axis]).abs() / size));
            }
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
    println!("surfaces: points restored to {worst:e}");
}

#[test]
fn a_knot_is_removed_only_within_the_tolerance() {
    for (name, curve) in nets::curves() {
        for &t in curve.knots().as_slice() {
            let (lo, hi) = curve.domain();
            if t < lo || t > hi {
                continue;
            }
            for tolerance in [1e-9, 0.1, 0.5] {
                let (removed, times) = curve.remove_knot(t, 9, tolerance).unwrap();
                assert_eq!(removed.points().len() + times, curve.points().len(), "{name}");
                let moved = moved(&removed, &curve) * size(curve.points());
                assert!(moved <= tolerance, "{name} at {t}: {moved} with {tolerance}");
            }
        }
    }
    let zigzag = Curve::new(KnotVector::clamped(1, &[0.5]).unwrap(), vec![[0.0], [1.0], [0.0]], None).unwrap();
    assert_eq!(zigzag.remove_knot(0.5, 1, 0.99).unwrap().1, 0);
    let (line, times) = zigzag.remove_knot(0.5, 1, 1.01).unwrap();
    assert_eq!((line.points(), times), (&[[0.0], [0.0]][..], 1));
}

#[test]
fn iso_curves_lie_on_their_surfaces() {
    for (name, surface) in nets::surfaces() {
        let size = size(surface.points());
        for u in parameters(surface.knots_u(), 5) {
            let along_v = surface.iso_curve(Direction::U, u).unwrap();
            for v in parameters(surface.knots_v(), 5) {
                let along_u = surface.iso_curve(Direction::V, v).unwrap();
                let p = surface.point(u, v).unwrap();
                for q in [along_v.point(v).unwrap(), along_u.point(u).unwrap()] {
                    assert!((0..3).all(|axis| (p[axis] - q[axis]).abs() < 1e-12 * size), "{name} at {u}, {v}");
                }
            }
        }
    }
}

#[test]
fn what_cannot_be_done_is_refused_by_name() {
    let curve = Curve::new(KnotVector::clamped(2, &[0.5]).unwrap(), vec![[0.0]; 4], None).unwrap();
    let repeated = |index, value, times| NurbsError::KnotRepeated { index, value, times, allowed: 2 };
    assert_eq!(curve.insert_knot(0.5, 2).unwrap_err(), repeated(3, 0.5, 3));
    assert_eq!(curve.insert_knot(0.0, 1).unwrap_err(), repeated(0, 0.0, 4));
    assert_eq!(curve.insert_knot(0.25, usize::MAX).unwrap_err(), repeated(3, 0.25, 3));
    assert!(matches!(curve.refine(&[0.1, f64::NAN]).unwrap_err(), NurbsError::Parameter { name: "t", .. }));
    assert_eq!(curve.split(1.0).unwrap_err(), NurbsError::EmptyDomain { lo: 1.0, hi: 1.0 });
    assert_eq!(curve.trim(0.75, 0.25).unwrap_err(), NurbsError::EmptyDomain { lo: 0.75, hi: 0.25 });
    assert!(matches!(curve.elevate(usize::MAX).unwrap_err(), NurbsError::Degree { .. }));
    assert_eq!(curve.remove_knot(0.0, 1, 1.0).unwrap().1, 0);
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = curve.remove_knot(0.5, 1, tolerance).unwrap_err();
        assert!(matches!(error, NurbsError::NotPositive { name: "tolerance", .. }));
    }
    let surface = nets::flame(4, 8);
    let error = surface.insert_knot(Direction::V, 1.5, 1).unwrap_err();
    assert_eq!(error, NurbsError::Parameter { name: "v", value: 1.5, lo: 0.0, hi: 1.0 });
    assert!(surface.iso_curve(Direction::U, -1.0).is_err());
    assert!(curve.knots().wrap(f64::INFINITY).is_err());
}

#[test]
fn parameters_wrap_around_closed_curves() {
    let curve = Curve::closed(3, nets::Noise(1).points(6), None).unwrap();
    for k in -40..=40 {
        let t = f64::from(k) * 0.7;
        let wrapped = curve.knots().wrap(t).unwrap();
        assert!((0.0..6.0).contains(&wrapped));
        assert!(((t - wrapped) / 6.0 - ((t - wrapped) / 6.0).round()).abs() < 1e-12);
    }
    assert_eq!(curve.knots().wrap(-1e-300).unwrap(), 0.0);
    assert_eq!(curve.knots().wrap(1e300).unwrap(), 0.0);
}

#[test]
fn single_precision_keeps_its_digits() {
    let mut worst = 0.0f64;
    for (name, curve) in nets::curves() {
        let single = |x: &f64| *x as f32;
        let knots = KnotVector::new(curve.knots().degree(), curve.knots().as_slice().iter().map(single).collect());
        let points = curve.points().iter().map(|point| point.map(|x| x as f32)).collect();
        let weights = curve.weights().map(|weights| weights.iter().map(single).collect());
        let rounded = Curve::new(knots.unwrap(), points, weights).unwrap();
        let (lo, hi) = rounded.domain();
        let at = |x: f32| lo + (hi - lo) * x;
        let edited = rounded.clamp().unwrap().elevate(2).unwrap().insert_knot(at(0.3), 2).unwrap();
        for k in 0..=32 {
            let t = at(k as f32 / 32.0);
            let (a, b) = (edited.point(t).unwrap(), rounded.point(t).unwrap());
            let error = (0..3).fold(0.0f64, |most, axis| most.max(f64::from((a[axis] - b[axis]).abs())));
            worst = worst.max(error / size(curve.points()));
        }
        assert!(worst < 1e-5, "{name}: {worst:e}");
    }
    println!("moved by {worst:e} of the size at most");
}
