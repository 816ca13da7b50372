//! Grids and adaptive meshes that stay as near to their surface as was asked.

use crate::shapes::{Point, Shape, cross, dot, shapes, sub};
use lucerna_nurbs::{AdaptiveOptions, Closure, GridOptions, GridPlan, KnotVector, Mesh, NurbsError, Surface};
use std::collections::HashMap;

/// The distance of a point from a triangle (Ericson, Real-Time Collision Detection, section 5.1.5, by
/// cases of the nearest feature).
fn distance(p: Point, [a, b, c]: [Point; 3]) -> f64 {
    let along = |a: Point, b: Point| {
        let edge = sub(b, a);
        let t = if dot(edge, edge) > 0.0 { (dot(sub(p, a), edge) / dot(edge, edge)).clamp(0.0, 1.0) } else { 0.0 };
        let d = sub(p, [0, 1, 2].map(|k| a[k] + t * edge[k]));
        dot(d, d).sqrt()
    };
    let normal = cross(sub(b, a), sub(c, a));
    let inside = |a: Point, b: Point| dot(cross(sub(b, a), sub(p, a)), normal) >= 0.0;
    if dot(normal, normal) > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return dot(sub(p, a), normal).abs() / dot(normal, normal).sqrt();
    }
    along(a, b).min(along(b, c)).min(along(c, a))
}

/// The greatest distance of sampled points of the surface from the triangles above them.
fn greatest_distance(surface: &Surface<f64>, start: f64, mesh: &Mesh<f64>) -> f64 {
    let ((u_lo, u_hi), (v_lo, v_hi)) = (surface.knots_u().domain(), surface.knots_v().domain());
    let mut most = 0.0_f64;
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let corners = triangle.map(|index| &mesh.vertices[index as usize]);
        for (i, j) in [(1, 1), (4, 1), (1, 4), (2, 2), (3, 0), (0, 3), (3, 3)] {
            let parts = [f64::from(i) / 6.0, f64::from(j) / 6.0, f64::from(6 - i - j) / 6.0];
            let mix = |of: [f64; 3]| parts[0] * of[0] + parts[1] * of[1] + parts[2] * of[2];
            let mut u = start + (u_hi - u_lo) * mix(corners.map(|corner| corner.u));
            if u < u_lo || u > u_hi {
                u = (u_lo + (u - u_lo).rem_euclid(u_hi - u_lo)).min(u_hi);
            }
            let v = (v_lo + (v_hi - v_lo) * mix(corners.map(|corner| corner.v))).min(v_hi);
            most = most.max(distance(surface.point(u, v).unwrap(), corners.map(|corner| corner.position)));
        }
    }
    most
}

fn start(shape: &Shape) -> f64 {
    match shape.options.closure_u {
        Closure::Periodic { start_row } => shape.exact.knots_u().greville(start_row).unwrap(),
        _ => shape.exact.knots_u().domain().0,
    }
}

/// The uniform mesh of a shape.
fn uniform(shape: &Shape, options: GridOptions) -> Mesh<f64> {
    let plan = GridPlan::new(shape.exact.knots_u(), shape.exact.knots_v(), options).unwrap();
    let mut vertices = Vec::new();
    let emit = |_, vertex| vertices.push(vertex);
    plan.evaluate(shape.exact.points(), shape.exact.weights(), &mut plan.scratch(), emit).unwrap();
    Mesh { vertices, indices: plan.indices().to_vec() }
}

fn size(surface: &Surface<f64>) -> f64 {
    let from = surface.points()[0];
    surface.points().iter().fold(0.0, |most, &p| most.max(dot(sub(p, from), sub(p, from)).sqrt()))
}

/// The shapes whose v is not closed periodically: a surface does not say which rows repeat there.
fn surfaces() -> impl Iterator<Item = Shape> {
    shapes().into_iter().filter(|shape| !matches!(shape.options.closure_v, Closure::Periodic { .. }))
}

#[test]
fn a_grid_for_a_tolerance_keeps_it_and_is_not_far_too_fine() {
    let (mut sum, mut count) = (0.0, 0);
    for shape in surfaces() {
        for part in [1e-2, 2e-3] {
            let tolerance = part * size(&shape.exact);
            let options = shape.exact.grid_for_tolerance(tolerance, shape.options).unwrap();
            let found = greatest_distance(&shape.exact, start(&shape), &uniform(&shape, options)) / tolerance;
            println!("{}, {part}: {} x {} cells, {found:.2} of it", shape.name, options.columns, options.rows);
            assert!(found <= 1.0 + 1e-9, "{}: {found} of {tolerance}", shape.name);
            (sum, count) = (sum + found, count + 1);
        }
    }
    println!("on average {:.2} of the tolerance", sum / f64::from(count));
    assert!(sum / f64::from(count) > 0.2);
}

#[test]
fn tolerances_that_no_mesh_can_keep_are_refused_by_name() {
    let sphere = &shapes()[0];
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = sphere.exact.grid_for_tolerance(bad, sphere.options).unwrap_err();
        assert!(matches!(error, NurbsError::NotPositive { name: "tolerance", .. }), "{error}");
        let error = sphere.exact.adaptive_mesh(AdaptiveOptions { tolerance: bad, flip: false }).unwrap_err();
        assert!(matches!(error, NurbsError::NotPositive { name: "tolerance", .. }), "{error}");
    }
    let error = sphere.exact.grid_for_tolerance(1e-13, sphere.options).unwrap_err();
    assert!(matches!(error, NurbsError::Cells { .. }), "{error}");
    let error = sphere.exact.adaptive_mesh(AdaptiveOptions { tolerance: 1e-13, flip: false }).unwrap_err();
    assert!(matches!(error, NurbsError::Cells { name: "cells", .. }), "{error}");
}

/// The number of edges that do not belong to two triangles, once in each direction; vertices at one
/// place count as one.
fn open_edges(mesh: &Mesh<f64>) -> Vec<[Point; 2]> {
    let key = |index: u32| mesh.vertices[index as usize].position.map(|x| (x + 0.0).to_bits());
    let mut edges: HashMap<_, i32> = HashMap::new();
    for [a, b, c] in mesh.indices.as_chunks::<3>().0 {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            let (a, b) = (key(*a), key(*b));
            *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { 1 << 16 };
        }
    }
    let open = edges.into_iter().filter(|&(_, count)| count != 1 + (1 << 16));
    open.map(|((a, b), _)| [a.map(f64::from_bits), b.map(f64::from_bits)]).collect()
}

/// A sheet that is flat but for a bump and a crease.
fn part() -> Shape {
    let (u, v) = (KnotVector::clamped_uniform(3, 16).unwrap(), KnotVector::clamped(2, &[0.3, 0.5, 0.5, 0.8]).unwrap());
    let net: Vec<Point> = (0..16 * 7)
        .map(|k| {
            let (i, j) = (f64::from(k / 7), f64::from(k % 7));
            let bump = 2.0 * (-(i - 9.0).powi(2) - (j - 2.0).powi(2)).exp();
            [i, j, bump + 0.5 * (j - 3.0).max(0.0)]
        })
        .collect();
    let exact = Surface::new(u, v, net, None).unwrap();
    Shape { name: "part", closed: false, options: GridOptions::default(), exact, ..shapes().swap_remove(2) }
}

#[test]
fn adaptive_meshes_are_closed_near_and_smaller_than_grids() {
    for shape in surfaces().filter(|shape| shape.name != "flame").chain([part()]) {
        let domain = shape.exact.knots_u().domain();
        for part in [1e-2, 2e-3] {
            let tolerance = part * size(&shape.exact);
            let mesh = shape.exact.adaptive_mesh(AdaptiveOptions { tolerance, flip: false }).unwrap();
            let found = greatest_distance(&shape.exact, domain.0, &mesh);
            assert!(found <= tolerance, "{}: {found} of {tolerance}", shape.name);
            let open = open_edges(&mesh);
            if shape.closed {
                assert_eq!(open, [[[0.0; 3]; 2]; 0], "{}", shape.name);
            } else {
                // The boundary, and nothing else, is open: as many edges arrive at a place as leave.
                assert!(!open.is_empty());
                let mut ends: HashMap<_, i32> = HashMap::new();
                open.iter().flatten().for_each(|p| *ends.entry(p.map(f64::to_bits)).or_default() += 1);
                assert!(ends.values().all(|count| count % 2 == 0), "{}", shape.name);
            }
            for vertex in &mesh.vertices {
                assert!((dot(vertex.normal, vertex.normal) - 1.0).abs() < 1e-12, "{}: {vertex:?}", shape.name);
            }
            let mut options = shape.exact.grid_for_tolerance(tolerance, shape.options).unwrap();
            let ratio = options.rows as f64 / options.columns as f64;
            // The coarsest uniform grid of these proportions that is as near.
            let least = shape.options.least_cells();
            let near = |columns: usize| {
                let rows = ((columns as f64 * ratio) as usize).max(least[1]);
                let mesh = uniform(&shape, GridOptions { columns, rows, ..options });
                greatest_distance(&shape.exact, start(&shape), &mesh) <= found
            };
            let all: Vec<usize> = (least[0]..=options.columns).collect();
            options.columns = all.partition_point(|&columns| !near(columns)) + least[0];
            options.rows = ((options.columns as f64 * ratio) as usize).max(least[1]);
            let uniform = uniform(&shape, options).indices.len() / 3;
            let adaptive = mesh.indices.len() / 3;
            println!(
                "{}, {part}: {adaptive} triangles, {:.2} of the tolerance; a grid as near has {uniform}",
                shape.name,
                found / tolerance
            );
            // Evenly bent shapes gain nothing, and halvings are coarse steps.
            let even = ["sphere", "torus", "quarter cylinder", "degrees 1 and 7", "degrees 2 and 6"];
            let most = if even.contains(&shape.name) || shape.name.starts_with("double") { 1.3 } else { 0.75 };
            assert!(adaptive as f64 <= most * uniform as f64, "{}: {adaptive} against {uniform}", shape.name);
        }
    }
}
