//! Rational shapes with known equations: sphere, torus, quarter cylinder.

use crate::nets;
use lucerna_nurbs::{Closure, Curve, GridOptions, GridPlan, GridVertex, KnotVector, Surface};
use std::f64::consts::FRAC_1_SQRT_2 as H;

/// Revolves a profile of `[radius, y, weight]` so that normals point outwards.
fn revolve(knots_v: KnotVector<f64>, profile: &[[f64; 3]]) -> Surface<f64> {
    let mut points = Vec::new();
    let mut weights = Vec::new();
    let (circle_knots, ring) = nets::circle();
    for [x, z, w] in ring {
        for &[radius, y, weight] in profile {
            points.push([radius * x, y, -radius * z]);
            weights.push(w * weight);
        }
    }
    Surface::new(circle_knots, knots_v, points, Some(weights)).unwrap()
}

fn sphere() -> Surface<f64> {
    let profile = [[0.0, -1.0, 1.0], [1.0, -1.0, H], [1.0, 0.0, 1.0], [1.0, 1.0, H], [0.0, 1.0, 1.0]];
    revolve(KnotVector::clamped(2, &[0.5, 0.5]).unwrap(), &profile)
}

fn torus() -> Surface<f64> {
    let (knots, ring) = nets::circle();
    revolve(knots, &ring.map(|[x, y, w]| [3.0 + x, y, w]))
}

/// A quarter circle of radius 1 by its Bezier form, with two derivatives.
fn quarter(t: f64) -> [[f64; 2]; 3] {
    let b = [(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t) * H, t * t];
    let b1 = [2.0 * t - 2.0, (2.0 - 4.0 * t) * H, 2.0 * t];
    let b2 = [2.0, -4.0 * H, 2.0];
    let at = |b: [f64; 3]| ([b[0] + b[1], b[1] + b[2]], b[0] + b[1] + b[2]);
    let ((a, w), (a1, w1), (a2, w2)) = (at(b), at(b1), at(b2));
    let mut out = [[0.0; 2]; 3];
    for k in 0..2 {
        let c = a[k] / w;
        let c1 = (a1[k] - w1 * c) / w;
        out[0][k] = c;
        out[1][k] = c1;
        out[2][k] = (a2[k] - 2.0 * w1 * c1 - w2 * c) / w;
    }
    out
}

fn close(a: [f64; 3], b: [f64; 3], tolerance: f64) {
    for k in 0..3 {
        assert!((a[k] - b[k]).abs() <= tolerance, "{a:?} against {b:?}");
    }
}

#[test]
fn a_quarter_cylinder_has_the_derivatives_of_its_equation() {
    let arc = [[1.0, 0.0, 1.0], [1.0, 1.0, H], [0.0, 1.0, 1.0]];
    let points = arc.iter().flat_map(|p| [[p[0], 0.0, p[1]], [p[0], 2.0, p[1]]]);
    let weights = arc.iter().flat_map(|p| [p[2], p[2]]).collect();
    let surface = Surface::new(
        KnotVector::clamped_uniform(2, 3).unwrap(),
        KnotVector::clamped_uniform(1, 2).unwrap(),
        points.collect(),
        Some(weights),
    )
    .unwrap();
    for i in 0..=40 {
        let (u, v) = (f64::from(i) / 40.0, f64::from((7 * i) % 41) / 40.0);
        let d = surface.derivatives(u, v, 2).unwrap();
        let [c, c1, c2] = quarter(u);
        close(d.get(0, 0).unwrap(), [c[0], 2.0 * v, c[1]], 1e-12);
        close(d.get(1, 0).unwrap(), [c1[0], 0.0, c1[1]], 1e-12);
        close(d.get(0, 1).unwrap(), [0.0, 2.0, 0.0], 1e-12);
        close(d.get(2, 0).unwrap(), [c2[0], 0.0, c2[1]], 1e-10);
        close(d.get(1, 1).unwrap(), [0.0; 3], 1e-10);
        close(d.get(0, 2).unwrap(), [0.0; 3], 1e-10);
        assert_eq!(d.get(2, 1), None);
        let [x, y, _] = surface.point(u, v).unwrap();
        assert_eq!([x, y], [d.get(0, 0).unwrap()[0], d.get(0, 0).unwrap()[1]]);
    }
}

/// A point of the rational circle of nine points, with two derivatives in the parameter.
fn circle(t: f64) -> [[f64; 2]; 3] {
    let arc = ((t * 4.0) as usize).min(3);
    let mut d = quarter(t * 4.0 - arc as f64);
    for (k, d) in d.iter_mut().enumerate() {
        for _ in 0..arc {
            *d = [-d[1], d[0]];
        }
        *d = d.map(|x| x * 4.0_f64.powi(k as i32));
    }
    d
}

#[test]
fn a_torus_has_the_points_and_derivatives_of_its_equation() {
    const SIZE: f64 = 4.0;
    let torus = torus();
    for i in 0..=36 {
        for j in 0..=36 {
            let (u, v) = (f64::from(i) / 36.0, f64::from(j) / 36.0);
            let ([a, a1, a2], [b, b1, b2]) = (circle(u), circle(v));
            let ring = |a: [f64; 2], r: f64, y: f64| [r * a[0], y, -r * a[1]];
            let d = torus.derivatives(u, v, 2).unwrap();
            let r = 3.0 + b[0];
            close(d.get(0, 0).unwrap(), ring(a, r, b[1]), 1e-12);
            close(d.get(1, 0).unwrap(), ring(a1, r, 0.0), SIZE * 1e-12);
            close(d.get(0, 1).unwrap(), ring(a, b1[0], b1[1]), SIZE * 1e-12);
            close(d.get(2, 0).unwrap(), ring(a2, r, 0.0), 1e-10);
            close(d.get(1, 1).unwrap(), ring(a1, b1[0], 0.0), 1e-10);
            close(d.get(0, 2).unwrap(), ring(a, b2[0], b2[1]), 1e-10);
        }
    }
}

#[test]
fn a_sphere_has_radius_one_and_radial_normals_up_to_its_poles() {
    let sphere = sphere();
    for i in 0..=48 {
        for j in 0..=24 {
            let (u, v) = (f64::from(i) / 48.0, f64::from(j) / 24.0);
            let p = sphere.point(u, v).unwrap();
            let n = sphere.normal(u, v).unwrap();
            assert!((p.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12);
            close(n, p, (0.1_f64.to_radians()).min(1e-9));
            let d = sphere.derivatives(u, v, 1).unwrap();
            let (profile, ring) = (v * 2.0, circle(u));
            let arc = usize::from(profile >= 1.0);
            let mut q = quarter(profile - arc as f64)[1].map(|x| 2.0 * x);
            // The profile starts at the south pole: a quarter turn back.
            q = if arc == 0 { [q[1], -q[0]] } else { q };
            let along = [q[0] * ring[0][0], q[1], -q[0] * ring[0][1]];
            close(d.get(0, 1).unwrap(), along, 1e-12);
        }
    }
}

#[test]
fn collapsed_edges_of_u_have_normals_too() {
    // The sphere with its directions exchanged: poles at the ends of u, normals inwards.
    let sphere = sphere();
    let (n_u, n_v) = (9, 5);
    let order = (0..n_v).flat_map(|j| (0..n_u).map(move |i| i * n_v + j));
    let points = order.clone().map(|k| sphere.points()[k]).collect();
    let weights = order.map(|k| sphere.weights().unwrap()[k]).collect();
    let turned = Surface::new(sphere.knots_v().clone(), sphere.knots_u().clone(), points, Some(weights)).unwrap();
    for i in 0..=16 {
        let along = f64::from(i) / 16.0;
        close(turned.normal(0.0, along).unwrap(), [0.0, 1.0, 0.0], 1e-9);
        close(turned.normal(1.0, along).unwrap(), [0.0, -1.0, 0.0], 1e-9);
    }
}

#[test]
fn a_circle_keeps_its_curvature() {
    let (knots, ring) = nets::circle();
    let points = ring.map(|[x, y, _]| [x, y]).to_vec();
    let weights = ring.map(|[_, _, w]| w).to_vec();
    let curve = Curve::new(knots, points, Some(weights)).unwrap();
    for i in 0..=64 {
        let t = f64::from(i) / 64.0;
        let d = curve.derivatives(t, 2).unwrap();
        let cross = d[1][0] * d[2][1] - d[1][1] * d[2][0];
        let speed = d[1][0].hypot(d[1][1]);
        assert!((cross / speed.powi(3) - 1.0).abs() < 1e-12);
        let [c, c1, c2] = circle(t);
        for k in 0..2 {
            assert!((d[0][k] - c[k]).abs() < 1e-12);
            assert!((d[1][k] - c1[k]).abs() < 1e-12);
            assert!((d[2][k] - c2[k]).abs() < 1e-10);
        }
    }
}

/// The vertices of a surface, and the volume its triangles enclose.
fn mesh(surface: &Surface<f64>, options: GridOptions) -> (Vec<GridVertex<f64>>, f64) {
    let plan = GridPlan::new(surface.knots_u(), surface.knots_v(), options).unwrap();
    let mut mesh = Vec::new();
    let emit = |_, vertex| mesh.push(vertex);
    plan.evaluate(surface.points(), surface.weights(), &mut plan.scratch(), emit).unwrap();
    let volume = plan.indices().chunks_exact(3).map(|triangle| {
        let [a, b, c] = [0, 1, 2].map(|k| mesh[triangle[k] as usize].position);
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    });
    let volume = volume.sum::<f64>() / 6.0;
    (mesh, volume)
}

#[test]
fn the_mesh_of_a_sphere_has_radial_normals_at_declared_and_undeclared_poles() {
    for poles in [false, true] {
        let options =
            GridOptions { closure_u: Closure::Joined, pole_v_min: poles, pole_v_max: poles, ..GridOptions::default() };
        let (mesh, volume) = mesh(&sphere(), options);
        for vertex in &mesh {
            close(vertex.normal, vertex.position, 1e-9);
        }
        assert!((volume / (4.0 / 3.0 * std::f64::consts::PI) - 1.0).abs() < 0.01, "{volume}");
    }
}

#[test]
fn the_mesh_of_a_torus_closes_bit_for_bit_both_ways() {
    let options = GridOptions {
        columns: 60,
        rows: 40,
        closure_u: Closure::Joined,
        closure_v: Closure::Joined,
        ..GridOptions::default()
    };
    let (mesh, volume) = mesh(&torus(), options);
    let same = |a: usize, b: usize| {
        assert_eq!(mesh[a].position, mesh[b].position);
        assert_eq!(mesh[a].normal, mesh[b].normal);
    };
    (0..=40).for_each(|j| same(j * 61, j * 61 + 60));
    (0..=60).for_each(|i| same(i, 40 * 61 + i));
    let exact = 2.0 * std::f64::consts::PI.powi(2) * 3.0;
    assert!((volume / exact - 1.0).abs() < 0.02, "{volume} against {exact}");
}
