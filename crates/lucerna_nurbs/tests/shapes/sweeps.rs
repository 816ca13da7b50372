//! Shapes made from curves: arcs, revolution, extrusion, ruled and lofted surfaces.

use crate::nets;
use lucerna_nurbs::{Curve, Direction, KnotVector, NurbsError, Surface};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn close(a: [f64; 3], b: [f64; 3], tolerance: f64) {
    assert!((0..3).all(|k| (a[k] - b[k]).abs() <= tolerance), "{a:?} against {b:?}");
}

#[test]
fn arcs_of_all_lengths_lie_on_their_circle_and_end_at_their_angles() {
    for k in 1..=48 {
        let sweep = if k == 48 { TAU } else { TAU * f64::from(k) / 48.0 };
        for start in [0.0, 1.0, -4.0, 100.0] {
            let arc = Curve::arc([5.0, -1.0], [2.0, 0.0], [0.0, 2.0], start, sweep).unwrap();
            let pieces = (sweep / FRAC_PI_2 - 1e-9).ceil() as usize;
            assert_eq!(arc.points().len(), 2 * pieces + 1);
            for i in 0..=20 {
                let [x, y] = arc.point(f64::from(i) / 20.0).unwrap();
                assert!(((x - 5.0).hypot(y + 1.0) - 2.0).abs() < 1e-14);
            }
            for (t, angle) in [(0.0, start), (0.5, start + 0.5 * sweep), (1.0, start + sweep)] {
                let [x, y] = arc.point(t).unwrap();
                // The middle of the parameter is that of the angle: pieces are alike.
                assert!((x - 5.0 - 2.0 * angle.cos()).abs() < 1e-13 && (y + 1.0 - 2.0 * angle.sin()).abs() < 1e-13);
            }
            let ends = (arc.points()[0], arc.points()[arc.points().len() - 1]);
            assert_eq!(ends.0 == ends.1, k == 48);
        }
    }
    // An ellipse on slanted axes.
    let ellipse = Curve::arc([0.0; 3], [2.0, 0.0, 1.0], [0.0, 1.0, 1.0], 0.3, 2.0).unwrap();
    for i in 0..=20 {
        let [x, y, z] = ellipse.point(f64::from(i) / 20.0).unwrap();
        assert!(((x / 2.0).hypot(y) - 1.0).abs() < 1e-14 && (z - x / 2.0 - y).abs() < 1e-14);
    }
    let full = Curve::circle([0.0; 2], [1.0, 0.0], [0.0, 1.0]).unwrap();
    let (knots, book) = nets::circle();
    assert_eq!(full.knots(), &knots);
    assert_eq!(full.points(), book.map(|[x, y, _]| [x, y]));
    let single = Curve::circle([0.0f32; 2], [1.0, 0.0], [0.0, 1.0]).unwrap();
    assert_eq!(single.point(0.5).unwrap(), [-1.0, 0.0]);
}

#[test]
fn named_surfaces_satisfy_their_equations_and_face_outwards() {
    let centre = [1.0, 2.0, 3.0];
    let shapes = [
        ("sphere", Surface::sphere(centre, 2.0).unwrap()),
        ("torus", Surface::torus(centre, 3.0, 1.0).unwrap()),
        ("cylinder", Surface::cylinder(centre, 2.0, 5.0).unwrap()),
    ];
    for (name, surface) in shapes {
        for (i, j) in (0..=24).flat_map(|i| (0..=24).map(move |j| (i, j))) {
            let (u, v) = (f64::from(i) / 24.0, f64::from(j) / 24.0);
            let p = surface.point(u, v).unwrap();
            let [x, y, z] = [p[0] - 1.0, p[1] - 2.0, p[2] - 3.0];
            let ring = x.hypot(z);
            let (error, normal) = match name {
                "sphere" => (ring.hypot(y) - 2.0, [x / 2.0, y / 2.0, z / 2.0]),
                "torus" => ((ring - 3.0).hypot(y) - 1.0, [x / ring * (ring - 3.0), y, z / ring * (ring - 3.0)]),
                _ => (ring - 2.0, [x / 2.0, 0.0, z / 2.0]),
            };
            assert!(error.abs() < 1e-14, "{name} at {u}, {v}: {error:e}");
            close(surface.normal(u, v).unwrap(), normal, 1e-7);
        }
        let seam = surface.iso_curve(Direction::U, 0.0).unwrap();
        assert_eq!(seam.points(), surface.iso_curve(Direction::U, 1.0).unwrap().points());
    }
}

#[test]
fn revolving_about_any_axis_keeps_distances_from_it() {
    let mut noise = nets::Noise(6);
    for (name, curve) in nets::curves().into_iter().step_by(5) {
        let [origin, axis] = [noise.points(1)[0], noise.points(1)[0]];
        for sweep in [0.4, 3.0, TAU] {
            let surface = curve.revolve(origin, axis, sweep).unwrap();
            let along = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
            let split = |p: [f64; 3]| {
                let height = (0..3).map(|k| (p[k] - origin[k]) * axis[k] / along).sum::<f64>();
                let square = (0..3).map(|k| (p[k] - origin[k]).powi(2)).sum::<f64>() - height * height;
                (height, square)
            };
            for t in nets::parameters(curve.knots(), 4) {
                let (height, square) = split(curve.point(t).unwrap());
                close(surface.point(0.0, t).unwrap(), curve.point(t).unwrap(), 1e-12);
                for u in [0.1, 0.5, 1.0] {
                    let (h, s) = split(surface.point(u, t).unwrap());
                    assert!((h - height).abs() < 1e-12 && (s - square).abs() < 1e-11, "{name}");
                }
            }
        }
    }
    let quarter = Curve::line([1.0, 0.0, 0.0], [1.0, 1.0, 0.0]).unwrap().revolve([0.0; 3], [0.0, 5.0, 0.0], FRAC_PI_2);
    close(quarter.unwrap().point(1.0, 0.0).unwrap(), [0.0, 0.0, -1.0], 1e-15);
}

#[test]
fn ruled_and_lofted_surfaces_pass_through_curves_of_every_kind() {
    let curves: Vec<_> = nets::curves().into_iter().map(|(_, curve)| curve).collect();
    let on = |(lo, hi): (f64, f64), x: f64| lo + (hi - lo) * x;
    for pair in curves.windows(2) {
        let surface = Surface::ruled(&pair[0], &pair[1]).unwrap();
        for x in [0.0, 0.21, 0.5, 0.88, 1.0] {
            let ends = [0, 1].map(|k| pair[k].point(on(pair[k].domain(), x)).unwrap());
            close(surface.point(x, 0.0).unwrap(), ends[0], 1e-12);
            close(surface.point(x, 1.0).unwrap(), ends[1], 1e-12);
        }
    }
    let mut worst = 0.0f64;
    for (k, sections) in curves.chunks(4).enumerate() {
        // Rational sections with very different weights may have no surface between them.
        let degree = 1 + k % 3;
        let Ok((surface, v)) = Surface::loft(sections, degree) else { continue };
        for (section, v) in sections.iter().zip(v) {
            for i in 0..=40 {
                let x = f64::from(i) / 40.0;
                let (a, b) = (surface.point(x, v).unwrap(), section.point(on(section.domain(), x)).unwrap());
                worst = (0..3).fold(worst, |worst, axis| worst.max((a[axis] - b[axis]).abs()));
            }
        }
    }
    println!("lofted surfaces miss their sections by {worst:e}");
    assert!(worst < 1e-12);
    let polynomial: Vec<_> = curves.into_iter().filter(|curve| curve.weights().is_none()).collect();
    for degree in 1..=6 {
        assert!(Surface::loft(&polynomial, degree).is_ok());
    }
}

#[test]
fn lofting_circles_gives_a_surface_of_revolution() {
    let circles: Vec<_> = (0..6)
        .map(|k| (1.0 + 0.3 * f64::from(k).sin(), f64::from(k)))
        .map(|(r, y)| Curve::circle([0.0, y, 0.0], [r, 0.0, 0.0], [0.0, 0.0, -r]).unwrap())
        .collect();
    let (vase, _) = Surface::loft(&circles, 3).unwrap();
    for (i, j) in (0..=20).flat_map(|i| (0..=20).map(move |j| (i, j))) {
        let [x, y, z] = vase.point(f64::from(i) / 20.0, f64::from(j) / 20.0).unwrap();
        let [r, level, _] = vase.point(0.0, f64::from(j) / 20.0).unwrap();
        assert!((x.hypot(z) - r).abs() < 1e-13 && (y - level).abs() < 1e-13);
    }
}

#[test]
fn shapes_that_are_none_are_refused_by_name() {
    let line = Curve::line([1.0, 0.0, 0.0], [1.0, 1.0, 0.0]).unwrap();
    for sweep in [0.0, -1.0, 7.0, f64::NAN, f64::INFINITY] {
        let error = Curve::arc([0.0; 2], [1.0, 0.0], [0.0, 1.0], 0.0, sweep).unwrap_err();
        assert!(matches!(error, NurbsError::Angle { name: "sweep", .. }), "{error}");
        assert!(line.revolve([0.0; 3], [0.0, 1.0, 0.0], sweep).is_err());
    }
    let start = Curve::arc([0.0; 2], [1.0, 0.0], [0.0, 1.0], f64::NAN, 1.0).unwrap_err();
    assert!(matches!(start, NurbsError::Angle { name: "start", .. }));
    for axis in [[0.0; 3], [f64::NAN, 1.0, 0.0], [f64::INFINITY, 0.0, 0.0]] {
        assert_eq!(line.revolve([0.0; 3], axis, PI).unwrap_err(), NurbsError::NoDirection { name: "axis" });
    }
    assert!(matches!(line.extrude([0.0, f64::NAN, 0.0]), Err(NurbsError::PointValue { axis: 1, .. })));
    assert_eq!(Surface::sphere([0.0; 3], 0.0).unwrap_err(), NurbsError::NotPositive { name: "radius", value: 0.0 });
    assert!(Surface::torus([0.0; 3], 1.0, -1.0).is_err() && Surface::cylinder([f64::NAN; 3], 1.0, 1.0).is_err());
    let sections = Surface::loft(&[line.clone(), line.clone()], 2).unwrap_err();
    assert_eq!(sections, NurbsError::Sections { found: 2, degree: 2, needed: 3 });
    assert_eq!(Surface::loft(&[line.clone(), line.clone()], 1).unwrap_err(), NurbsError::Coincident);
    assert!(matches!(Surface::<f64>::loft(&[], 0), Err(NurbsError::Sections { .. })));
    let far = line.map_points(|[x, y, z]| [x + 1.0, y, z]).unwrap();
    let twice = Surface::loft(&[line.clone(), line, far], 1).unwrap_err();
    assert!(matches!(twice, NurbsError::ParameterOrder { name: "v", index: 1, .. }), "{twice}");
    assert!(KnotVector::<f64>::clamped(2, &[0.5; 3]).is_err());
}

#[test]
fn knots_that_differ_by_rounding_become_one() {
    let mut noise = nets::Noise(8);
    let mut make = |inner: &[f64], end: f64| {
        let mut knots = vec![0.0; 4];
        knots.extend(inner.iter().map(|t| t * end));
        knots.extend(vec![end; 4]);
        let points = noise.points(inner.len() + 4);
        Curve::new(KnotVector::new(3, knots).unwrap(), points, None).unwrap()
    };
    // Thirds of 7 divided by 7 again are not quite thirds; the last knot all but falls on the end.
    let near = 1.0 - 4.0 * f64::EPSILON;
    let (a, b) = (make(&[0.1, 1.0 / 3.0, near], 1.0), make(&[0.1 + 1e-16, 1.0 / 3.0, 0.7], 7.0));
    let surface = Surface::ruled(&a, &b).unwrap();
    assert_eq!(surface.knots_u().count(), 4 + 4);
    assert_eq!(surface.knots_u().domain(), (0.0, 1.0));
    for x in [0.0, 0.05, 0.2, 0.5, 0.9, 1.0] {
        close(surface.point(x, 0.0).unwrap(), a.point(x).unwrap(), 1e-12);
        close(surface.point(x, 1.0).unwrap(), b.point(7.0 * x).unwrap(), 1e-12);
    }
}
