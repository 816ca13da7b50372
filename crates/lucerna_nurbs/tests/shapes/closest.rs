//! The closest point, and bounding boxes.

use crate::nets;
use crate::nets::{Noise, size};
use lucerna_nurbs::{Curve, NurbsError, Surface};

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn no_point_of_a_curve_is_closer() {
    let mut noise = Noise(9);
    let (mut worst, mut samples) = (0.0f64, 0);
    for (name, curve) in nets::curves() {
        let size = size(curve.points());
        let on_it: Vec<[f64; 3]> =
            nets::parameters(curve.knots(), 400).iter().map(|&t| curve.point(t).unwrap()).collect();
        for k in 0..12 {
            let scale = [0.3, 1.0, 5.0][k % 3];
            let target = noise.points(1)[0].map(|x| x * scale);
            let closest = curve.closest_point(target).unwrap();
            assert_eq!(closest.point, curve.point(closest.t).unwrap());
            assert!((distance(closest.point, target) - closest.distance).abs() < 1e-14 * (1.0 + scale));
            let least = on_it.iter().fold(f64::INFINITY, |least, &p| least.min(distance(p, target)));
            assert!(closest.distance <= least + 1e-12 * size, "{name} from {target:?}: {closest:?} but {least}");
            // The way there is perpendicular to the curve, or leads to an end or a corner.
            let (lo, hi) = curve.domain();
            let smooth = curve.knots().multiplicity(closest.t) == 0 && closest.t > lo && closest.t < hi;
            if smooth {
                let d = curve.derivatives(closest.t, 1).unwrap()[1];
                let along: f64 = (0..3).map(|axis| d[axis] * (target[axis] - closest.point[axis])).sum();
                let speed = distance(d, [0.0; 3]);
                worst = worst.max(along.abs() / (speed * (size + closest.distance)));
                samples += 1;
            }
        }
    }
    println!("{samples} ways off the perpendicular by {worst:e} at most");
    assert!(samples > 200 && worst < 1e-9);
}

#[test]
fn points_of_a_curve_or_a_surface_are_found_again() {
    let mut worst = 0.0f64;
    for (_, curve) in nets::curves() {
        for t in nets::parameters(curve.knots(), 7) {
            let found = curve.closest_point(curve.point(t).unwrap()).unwrap();
            worst = worst.max(found.distance / size(curve.points()));
        }
    }
    for (_, surface) in nets::surfaces().into_iter().step_by(3) {
        for u in nets::parameters(surface.knots_u(), 2) {
            for v in nets::parameters(surface.knots_v(), 1) {
                let found = surface.closest_point(surface.point(u, v).unwrap()).unwrap();
                worst = worst.max(found.distance / size(surface.points()));
            }
        }
    }
    println!("found again to {worst:e} of the size");
    assert!(worst < 1e-12);
}

#[test]
fn no_point_of_a_surface_is_closer() {
    let mut noise = Noise(10);
    for (name, surface) in nets::surfaces() {
        let size = size(surface.points());
        let mut on_it = Vec::new();
        for u in nets::parameters(surface.knots_u(), 40) {
            on_it.extend(nets::parameters(surface.knots_v(), 40).iter().map(|&v| surface.point(u, v).unwrap()));
        }
        for scale in [0.3, 1.0, 4.0] {
            let target = noise.points(1)[0].map(|x| x * scale * size);
            let closest = surface.closest_point(target).unwrap();
            let least = on_it.iter().fold(f64::INFINITY, |least, &p| least.min(distance(p, target)));
            assert!(closest.distance <= least + 1e-12 * size, "{name} from {target:?}: {closest:?} but {least}");
        }
    }
}

#[test]
fn the_closest_points_of_a_sphere_and_a_torus_are_those_of_their_equations() {
    let (sphere, torus) = (Surface::sphere([1.0, 2.0, 3.0], 2.0).unwrap(), Surface::torus([0.0; 3], 3.0, 1.0).unwrap());
    let mut noise = Noise(4);
    let mut worst = 0.0f64;
    for k in 0..60 {
        let target = noise.points(1)[0].map(|x| 6.0 * x);
        let found = sphere.closest_point(target).unwrap();
        worst = worst.max((found.distance - (distance(target, [1.0, 2.0, 3.0]) - 2.0).abs()).abs());
        let [x, y, z] = if k % 7 == 0 { [target[0], 0.0, 0.0] } else { target };
        let found = torus.closest_point([x, y, z]).unwrap();
        worst = worst.max((found.distance - ((x.hypot(z) - 3.0).hypot(y) - 1.0).abs()).abs());
    }
    // Everywhere equally far, and on the axis.
    let centre = sphere.closest_point([1.0, 2.0, 3.0]).unwrap();
    worst = worst.max((centre.distance - 2.0).abs());
    worst = worst.max((torus.closest_point([0.0; 3]).unwrap().distance - 2.0).abs());
    println!("distances off by {worst:e}");
    assert!(worst < 1e-13);
}

#[test]
fn far_near_and_single_targets_and_single_precision_are_no_trouble() {
    let circle = Curve::circle([0.0f32; 2], [1.0, 0.0], [0.0, 1.0]).unwrap();
    for scale in [1e-30, 1e-3, 1.0, 1e6, 1e30] {
        let found = circle.closest_point([3.0 * scale, 4.0 * scale]).unwrap();
        let wanted = (5.0 * scale - 1.0).abs();
        assert!((found.distance - wanted).abs() <= 1e-6 * wanted.max(1.0), "{scale}: {found:?}");
    }
    let dot = Surface::ruled(&Curve::line([1.0; 3], [1.0; 3]).unwrap(), &Curve::line([1.0; 3], [1.0; 3]).unwrap());
    let dot: Surface<f64> = dot.unwrap();
    assert_eq!(dot.closest_point([1.0, 1.0, 4.0]).unwrap().distance, 3.0);
    assert_eq!(dot.closest_point([1.0; 3]).unwrap().distance, 0.0);
    assert!(matches!(dot.closest_point([f64::NAN, 0.0, 0.0]), Err(NurbsError::PointValue { axis: 0, .. })));
    let huge = Curve::line([-1e307, 0.0], [1e307, 1e300]).unwrap();
    assert!(huge.closest_point([0.0, 2e307_f64]).unwrap().distance.is_finite());
}

#[test]
fn tight_boxes_hold_the_shape_and_touch_it() {
    let mut noise = Noise(21);
    for (name, curve) in nets::curves() {
        let (hull, tight) = (curve.bounds(), curve.tight_bounds(1e-6).unwrap());
        let (mut min, mut max) = ([f64::MAX; 3], [f64::MIN; 3]);
        for t in nets::parameters(curve.knots(), 3000) {
            let p = curve.point(t).unwrap();
            for axis in 0..3 {
                assert!(p[axis] >= tight.min[axis] - 1e-13 && p[axis] <= tight.max[axis] + 1e-13, "{name}");
                (min[axis], max[axis]) = (min[axis].min(p[axis]), max[axis].max(p[axis]));
            }
        }
        for axis in 0..3 {
            assert!(hull.min[axis] <= tight.min[axis] + 1e-13 && tight.max[axis] <= hull.max[axis] + 1e-13, "{name}");
            assert!(min[axis] - tight.min[axis] < 1e-4 && tight.max[axis] - max[axis] < 1e-4, "{name}");
        }
    }
    for (name, surface) in nets::surfaces() {
        let tight = surface.tight_bounds(1e-3).unwrap();
        for _ in 0..500 {
            let at = |(lo, hi): (f64, f64), x: f64| lo + (hi - lo) * (0.5 + 0.5 * x);
            let (u, v) = (at(surface.knots_u().domain(), noise.next()), at(surface.knots_v().domain(), noise.next()));
            let p = surface.point(u, v).unwrap();
            assert!((0..3).all(|k| p[k] >= tight.min[k] - 1e-13 && p[k] <= tight.max[k] + 1e-13), "{name}");
        }
    }
    let torus = Surface::torus([0.0; 3], 3.0, 1.0).unwrap();
    let tight = torus.tight_bounds(1e-5).unwrap();
    for (found, wanted) in tight.max.into_iter().zip([4.0, 1.0, 4.0_f64]) {
        assert!((found - wanted).abs() < 1e-5, "{tight:?}");
    }
    assert!(torus.tight_bounds(f64::NAN).is_err() && torus.tight_bounds(0.0).is_err());
    // The arc of a parabola: its box is not that of its control points.
    let curve = Curve::new(
        lucerna_nurbs::KnotVector::clamped_uniform(2, 3).unwrap(),
        vec![[0.0, 0.0], [1.0, 2.0], [2.0, 0.0_f64]],
        None,
    );
    assert!((curve.unwrap().tight_bounds(1e-9).unwrap().max[1] - 1.0).abs() < 1e-9);
}
