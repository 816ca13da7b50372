//! Wicks of all shapes: where their centrelines run and what is refused.

mod support;

use glam::Vec3;
use lucerna_flame::{Centreline, FlameError, Roots, WickShape};
use support::shapes::tube;

fn line_of(vertices: Vec<[f32; 3]>) -> Vec<Vec3> {
    match WickShape::Vertices(vertices).centreline() {
        Ok(Centreline::Line(line)) => line,
        other => panic!("not a line: {other:?}"),
    }
}

/// Largest distance of the found line from the true one, and of the true ends from the found ones.
fn errors(found: &[Vec3], truth: &impl Fn(f32) -> Vec3) -> (f32, f32) {
    let to_truth = |p: &Vec3| (0..=400).map(|i| truth(i as f32 / 400.0).distance(*p)).fold(f32::INFINITY, f32::min);
    let off = found.iter().map(to_truth).fold(0.0, f32::max);
    let (a, b) = (found[0], found[found.len() - 1]);
    let end = |p: Vec3| a.distance(p).min(b.distance(p));
    (off, end(truth(0.0)).max(end(truth(1.0))))
}

#[test]
fn straight_wicks_are_found_in_any_direction() {
    for (i, to) in [Vec3::X, Vec3::Z, Vec3::new(0.7, 0.3, -0.6), Vec3::new(-0.2, 0.1, 0.9)].into_iter().enumerate() {
        let truth = move |s: f32| Vec3::new(3.0, 1.0, -2.0) + to * (0.4 * s);
        for rings in [2, 5, 60] {
            let (off, ends) = errors(&line_of(tube(truth, rings, 0.01)), &truth);
            assert!(off < 0.006 && ends < 0.012, "wick {i}, {rings} rings: {off} {ends}");
        }
    }
}

#[test]
fn bent_wicks_are_followed() {
    let arc = |s: f32| Vec3::new((s * 3.0).cos(), 0.0, (s * 3.0).sin()) * 0.2;
    let hook = |s: f32| if s < 0.5 { Vec3::X * (0.6 * s) } else { Vec3::new(0.3, 0.0, 0.6 * (s - 0.5)) };
    let wave = |s: f32| Vec3::new(0.5 * s, 0.02 * (9.0 * s).sin(), 0.05 * (6.0 * s).cos());
    let (off, ends) = errors(&line_of(tube(arc, 80, 0.01)), &arc);
    assert!(off < 0.012 && ends < 0.02, "arc: {off} {ends}");
    let (off, ends) = errors(&line_of(tube(hook, 80, 0.01)), &hook);
    assert!(off < 0.02 && ends < 0.02, "hook: {off} {ends}");
    let (off, ends) = errors(&line_of(tube(wave, 80, 0.01)), &wave);
    assert!(off < 0.012 && ends < 0.02, "wave: {off} {ends}");
}

#[test]
fn a_ring_is_cut_open() {
    let truth = |s: f32| {
        let (sin, cos) = (s * std::f32::consts::TAU).sin_cos();
        Vec3::new(0.3 * cos, 0.1, 0.3 * sin)
    };
    let line = line_of(tube(truth, 96, 0.02));
    assert!(errors(&line, &truth).0 < 0.02);
    let length: f32 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    assert!(length > 0.9 * 0.3 * std::f32::consts::TAU, "it runs around: {length}");
}

#[test]
fn upright_and_round_wicks_are_points() {
    let upright = tube(|s| Vec3::new(0.1, 0.02 * s, 0.2), 10, 0.001);
    let ball: Vec<[f32; 3]> = (0..200)
        .map(|i| {
            let y = 1.0 - 2.0 * (i as f32 + 0.5) / 200.0;
            let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
            let r = (1.0 - y * y).sqrt();
            [0.1 + 0.03 * r * cos, 0.01 + 0.03 * y, 0.2 + 0.03 * r * sin]
        })
        .collect();
    for (vertices, slack) in [(upright, 1e-3), (ball, 3e-3), (vec![[0.1, 0.01, 0.2]], 1e-6)] {
        match WickShape::Vertices(vertices).centreline() {
            Ok(Centreline::Point(p)) => assert!(p.distance(Vec3::new(0.1, 0.01, 0.2)) < slack, "{p}"),
            other => panic!("not a point: {other:?}"),
        }
    }
    let wick = WickShape::Polyline { points: vec![[0.0, 0.0, 0.0], [0.001, 0.01, 0.0]], radius_m: 0.001 };
    let roots = Roots::place(&wick.centreline().unwrap(), 3, 0.003);
    assert_eq!((roots.leads.len(), roots.peripherals.len()), (1, 4));
    assert!((roots.leads[0].position - Vec3::new(0.0005, 0.005, 0.0)).length() < 1e-6, "the barycentre");
}

#[test]
fn impossible_wicks_are_refused_by_name() {
    let wick = |points: Vec<[f32; 3]>, radius_m| WickShape::Polyline { points, radius_m }.centreline();
    let line = || vec![[0.0; 3], [1.0, 0.0, 0.0]];
    assert!(matches!(wick(vec![], 0.1), Err(FlameError::Count { field: "wick.points", count: 0, .. })));
    assert!(matches!(wick(line(), 0.0), Err(FlameError::OutOfRange { field: "wick.radius_m", .. })));
    assert!(matches!(wick(line(), f32::NAN), Err(FlameError::OutOfRange { .. })));
    for bad in [f32::NAN, f32::INFINITY, 1e9] {
        let points = vec![[0.0; 3], [0.0, bad, 0.0]];
        assert!(matches!(wick(points, 0.1), Err(FlameError::NotFinite { index: 1, .. })));
    }
    let many = WickShape::Vertices(vec![[0.0; 3]; lucerna_flame::MAX_WICK_POINTS + 1]);
    assert!(matches!(many.centreline(), Err(FlameError::Count { .. })));
    assert!(WickShape::Vertices(vec![[1.0; 3]; 100_000]).centreline().is_ok());
}
