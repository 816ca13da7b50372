//! Interpolation and least squares.

use crate::nets;
use crate::nets::Noise;
use lucerna_nurbs::{Curve, FitSample, NurbsError, Real, Spacing, Surface};

fn difference<T: Real, const D: usize>(a: [T; D], b: [T; D]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (&a, b)| most.max((a - b).abs().to_f64()))
}

/// A long way through space, with sharp turns.
fn walk(count: usize) -> Vec<[f64; 3]> {
    let mut noise = Noise(11);
    let mut at = [0.0; 3];
    (0..count)
        .map(|_| {
            at = at.map(|x| x + noise.next());
            at
        })
        .collect()
}

#[test]
fn the_curve_of_the_books_example_9_1_is_found() {
    let points = [[0.0, 0.0], [3.0, 4.0], [-1.0, 4.0], [-4.0, 0.0], [-4.0, -3.0_f64]];
    let parameters = Spacing::ChordLength.parameters(&points).unwrap();
    let curve = Curve::interpolate(3, &points, &parameters).unwrap();
    // The book's only inner knot: (5/17 + 9/17 + 14/17) / 3 = 28/51.
    assert!((curve.knots().as_slice()[4] - 28.0 / 51.0).abs() < 1e-15);
    // geomdl 5.4.0, fitting.interpolate_curve(points, 3).
    for (found, wanted) in curve.points().iter().zip(GEOMDL) {
        assert!(difference(*found, wanted) < 1e-12, "{found:?} {wanted:?}");
    }
}

const GEOMDL: [[f64; 2]; 5] = [
    [0.0, 0.0],
    [7.3169635171119936, 3.6867775257587367],
    [-2.958130565851424, 6.678276528176592],
    [-4.494953466891109, -0.6736915062424752],
    [-4.0, -3.0],
];

#[test]
fn a_hundred_points_are_met_at_their_parameters() {
    let points = walk(100);
    let size = nets::size(&points);
    let mut worst = 0.0f64;
    for degree in 1..=7 {
        for spacing in [Spacing::Even, Spacing::ChordLength, Spacing::Centripetal] {
            let parameters = spacing.parameters(&points).unwrap();
            let curve = Curve::interpolate(degree, &points, &parameters).unwrap();
            let largest = nets::size(curve.points());
            for (&t, &point) in parameters.iter().zip(&points) {
                let error = difference(curve.point(t).unwrap(), point);
                assert!(error < 1e-10 * size, "{degree} {spacing:?}: {error:e}, points up to {largest}");
                worst = worst.max(error / size);
            }
            assert_eq!(curve.points()[0], points[0]);
            assert_eq!(curve.points()[99], points[99]);
        }
    }
    println!("100 points are met to {worst:e} of their size");
}

#[test]
fn single_precision_and_many_points_are_met_too() {
    let points: Vec<[f32; 3]> = walk(100).into_iter().map(|p| p.map(|x| x as f32)).collect();
    let parameters = Spacing::Centripetal.parameters(&points).unwrap();
    let curve = Curve::interpolate(3, &points, &parameters).unwrap();
    for (&t, &point) in parameters.iter().zip(&points) {
        assert!(difference(curve.point(t).unwrap(), point) < 2e-5);
    }
    let points = walk(20_000);
    let parameters = Spacing::Centripetal.parameters(&points).unwrap();
    let curve = Curve::interpolate(5, &points, &parameters).unwrap();
    for (&t, &point) in parameters.iter().zip(&points).step_by(100) {
        assert!(difference(curve.point(t).unwrap(), point) < 1e-10 * nets::size(&points));
    }
}

#[test]
fn a_grid_of_points_is_met() {
    let mut noise = Noise(5);
    let points: Vec<[f64; 3]> =
        (0..15 * 9).map(|k| [f64::from(k / 9) + 0.3 * noise.next(), f64::from(k % 9), noise.next()]).collect();
    for (degree_u, degree_v) in [(1, 3), (3, 3), (5, 2), (7, 4)] {
        let (u, v) = Spacing::ChordLength.grid(&points, 9).unwrap();
        let surface = Surface::interpolate(degree_u, degree_v, &points, &u, &v).unwrap();
        for (k, &point) in points.iter().enumerate() {
            assert!(difference(surface.point(u[k / 9], v[k % 9]).unwrap(), point) < 1e-10);
        }
    }
}

#[test]
fn what_is_a_spline_already_is_found_again() {
    let mut noise = Noise(2);
    let points = noise.points(9);
    let dense: Vec<f64> = (0..200).map(|k| f64::from(k) / 199.0).collect();
    // Least squares place their knots by the parameters, so start from a fit.
    let start = Curve::approximate(3, 9, &dense.iter().map(|&t| [t.sin(), t, t * t]).collect::<Vec<_>>(), &dense);
    let spline = Curve::new(start.unwrap().knots().clone(), points, None).unwrap();
    let samples: Vec<[f64; 3]> = dense.iter().map(|&t| spline.point(t).unwrap()).collect();
    let found = Curve::approximate(3, 9, &samples, &dense).unwrap();
    let error = found.points().iter().zip(spline.points()).fold(0.0, |e: f64, (a, b)| e.max(difference(*a, *b)));
    println!("control points found again to {error:e}");
    assert!(error < 1e-10);

    let demands: Vec<FitSample<f64, 3>> = dense.iter().zip(&samples).map(|(&t, &p)| FitSample::point(t, p)).collect();
    let found = Curve::fit(3, 9, &demands).unwrap();
    let error = found.points().iter().zip(spline.points()).fold(0.0, |e: f64, (a, b)| e.max(difference(*a, *b)));
    assert!(error < 1e-10, "{error:e}");
}

#[test]
fn least_squares_are_least() {
    let points = walk(60);
    let parameters = Spacing::ChordLength.parameters(&points).unwrap();
    let curve = Curve::approximate(3, 12, &points, &parameters).unwrap();
    let squares = |net: &[[f64; 3]]| -> f64 {
        let curve = Curve::new(curve.knots().clone(), net.to_vec(), None).unwrap();
        let square = |(&t, p): (&f64, &[f64; 3])| {
            curve.point(t).unwrap().iter().zip(p).map(|(a, b)| (a - b).powi(2)).sum::<f64>()
        };
        parameters.iter().zip(&points).map(square).sum()
    };
    let least = squares(curve.points());
    for k in 1..11 {
        for axis in 0..3 {
            for by in [-1e-3, 1e-3] {
                let mut net = curve.points().to_vec();
                net[k][axis] += by;
                assert!(squares(&net) > least, "point {k}, axis {axis}");
            }
        }
    }
    // Any number of control points will do; with as many as points, the curve passes through them.
    for degree in 1..=5 {
        for count in degree + 1..=60 {
            Curve::approximate(degree, count, &points, &parameters).unwrap();
        }
    }
    let through = Curve::approximate(3, 60, &points, &parameters).unwrap();
    for (&t, &point) in parameters.iter().zip(&points) {
        assert!(difference(through.point(t).unwrap(), point) < 1e-10 * nets::size(&points));
    }
    assert_eq!((curve.points()[0], curve.points()[11]), (points[0], points[59]));
}

#[test]
fn a_surface_of_least_squares_keeps_its_corners_and_comes_close() {
    let height = |x: f64, y: f64| (3.0 * x).sin() * (2.0 * y).cos();
    let at = |k: usize| [(k / 30) as f64 / 39.0, (k % 30) as f64 / 29.0];
    let points: Vec<[f64; 3]> = (0..1200).map(at).map(|[x, y]| [x, y, height(x, y)]).collect();
    let (u, v) = Spacing::Even.grid(&points, 30).unwrap();
    let surface = Surface::approximate([3, 3], [10, 8], &points, &u, &v).unwrap();
    let corners = [(0, 0, 0), (0, 1, 29), (1, 0, 39 * 30), (1, 1, 1199)];
    for (s, t, k) in corners {
        assert!(difference(surface.point(f64::from(s), f64::from(t)).unwrap(), points[k]) < 1e-14);
    }
    let mut worst = 0.0f64;
    for (k, &point) in points.iter().enumerate() {
        worst = worst.max(difference(surface.point(u[k / 30], v[k % 30]).unwrap(), point));
    }
    println!("80 control points for 1200 points: {worst:e}");
    assert!(worst < 1e-3);
}

#[test]
fn exact_samples_are_met_and_weights_pull() {
    let points = walk(40);
    let mut parameters = Spacing::ChordLength.parameters(&points).unwrap();
    parameters[39] = 1.0;
    let make = |weight: f64| {
        let mut samples: Vec<FitSample<f64, 3>> =
            parameters.iter().zip(&points).map(|(&t, &p)| FitSample::point(t, p)).collect();
        for k in [0, 10, 39] {
            samples[k] = samples[k].exact();
        }
        samples[20] = samples[20].weighted(weight);
        samples.push(FitSample::derivative(parameters[10], 1, [5.0, -3.0, 2.0]).exact());
        samples.push(FitSample::derivative(0.0, 2, [1.0, 2.0, 3.0]).weighted(1e-6));
        Curve::fit(4, 14, &samples).unwrap()
    };
    let mut before = f64::INFINITY;
    for weight in [0.1, 1.0, 10.0, 1000.0] {
        let curve = make(weight);
        for k in [0, 10, 39] {
            assert!(difference(curve.point(parameters[k]).unwrap(), points[k]) < 1e-10);
        }
        let slope = curve.derivatives(parameters[10], 1).unwrap()[1];
        assert!(difference(slope, [5.0, -3.0, 2.0]) < 1e-9);
        let p = curve.point(parameters[20]).unwrap();
        let distance: f64 = p.iter().zip(points[20]).map(|(a, b)| (a - b).powi(2)).sum();
        assert!(distance < before, "{weight}: {distance}");
        before = distance;
    }
}

#[test]
fn what_does_not_determine_a_curve_is_refused_by_name() {
    let points = walk(6);
    let chord = Spacing::ChordLength;
    assert_eq!(chord.parameters(&[[1.0, 2.0]; 4]).unwrap_err(), NurbsError::Coincident);
    assert_eq!(chord.parameters(&points[..1]).unwrap_err(), NurbsError::PointCount { found: 1, expected: 2 });
    assert!(matches!(chord.parameters(&[[0.0], [f64::NAN]]).unwrap_err(), NurbsError::PointValue { index: 1, .. }));
    assert!(matches!(chord.grid(&points, usize::MAX), Err(NurbsError::PointCount { .. })));
    assert!(matches!(chord.grid(&points, 0), Err(NurbsError::PointCount { .. })));
    assert_eq!(chord.grid(&[[0.0]; 6], 3).unwrap_err(), NurbsError::Coincident);

    let even = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0];
    let mut twice = points.clone();
    twice[3] = twice[2];
    let repeated = chord.parameters(&twice).unwrap();
    let error = Curve::interpolate(3, &twice, &repeated).unwrap_err();
    assert!(matches!(error, NurbsError::ParameterOrder { name: "t", index: 3, .. }), "{error}");
    assert_eq!(Curve::interpolate(6, &points, &even).unwrap_err(), NurbsError::Degree { degree: 6, count: 6 });
    assert!(matches!(Curve::interpolate(0, &points, &even), Err(NurbsError::Degree { .. })));
    assert!(matches!(Curve::<f64, 3>::interpolate(3, &[], &[]), Err(NurbsError::Degree { .. })));
    let error = Curve::interpolate(3, &points, &even[1..]).unwrap_err();
    assert_eq!(error, NurbsError::ParameterCount { name: "t", found: 5, expected: 6 });
    assert!(Curve::interpolate(3, &points, &[0.0, 0.1, f64::NAN, 0.3, 0.4, 0.5]).is_err());

    assert_eq!(Curve::approximate(3, 7, &points, &even).unwrap_err(), NurbsError::FitCount { found: 7, max: 6 });
    assert!(matches!(Curve::approximate(3, 3, &points, &even), Err(NurbsError::Degree { .. })));
    assert!(matches!(Curve::<f64, 3>::approximate(1, 0, &[], &[]), Err(NurbsError::Degree { .. })));
    // All but the ends in one place: nothing tells the inner points apart.
    let error = Curve::approximate(2, 5, &points, &[0.0, 0.5, 0.5, 0.5, 0.5, 1.0]).unwrap_err();
    assert!(matches!(error, NurbsError::Undetermined { .. } | NurbsError::KnotRepeated { .. }), "{error}");

    let sample = |t: f64| FitSample::point(t, [t]);
    assert!(matches!(
        Curve::fit(1, 2, &[sample(0.0), sample(1.0).weighted(-1.0)]),
        Err(NurbsError::NotPositive { .. })
    ));
    let twice = [sample(0.0).exact(), sample(0.5), sample(0.5).exact(), sample(0.5).exact(), sample(1.0)];
    assert_eq!(Curve::fit(2, 3, &twice).unwrap_err(), NurbsError::Contradiction);
    assert!(matches!(Curve::<f64, 1>::fit(1, 2, &[]), Err(NurbsError::PointCount { .. })));
    assert!(matches!(Curve::fit(1, 2, &[sample(0.5), sample(0.5)]), Err(NurbsError::EmptyDomain { .. })));
    let orders = [sample(0.0), FitSample::derivative(1.0, usize::MAX, [0.0])];
    assert!(matches!(Curve::fit(1, 2, &orders), Err(NurbsError::Order { .. })));
    let surface = Surface::interpolate(1, 1, &points, &[0.0, 1.0], &[0.0, 1.0]);
    assert_eq!(surface.unwrap_err(), NurbsError::PointCount { found: 6, expected: 4 });
}
