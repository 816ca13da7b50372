//! Grids against the pointwise evaluation of the same surface.

use lucerna_nurbs::{Closure, GridOptions, GridPlan, KnotVector, Real, Surface};

/// Numbers in -1 to 1 that look random.
fn noise(k: usize) -> f64 {
    let x = (k as f64 * 12.9898 + 4.1).sin() * 43758.5453;
    2.0 * (x - x.floor()) - 1.0
}

/// A wavy tube of `n_u` rows and `n_v` columns.
fn tube<T: Real>(n_u: usize, n_v: usize) -> (Vec<[T; 3]>, Vec<T>) {
    let point = |k: usize| {
        let angle = (k / n_v) as f64 / n_u as f64 * std::f64::consts::TAU;
        let radius = 1.0 + 0.2 * noise(k);
        let y = (k % n_v) as f64 / n_v as f64 * 3.0 + 0.1 * noise(k + 999);
        [radius * angle.cos(), y, -radius * angle.sin()].map(T::from_f64)
    };
    let weights = (0..n_u * n_v).map(|k| T::from_f64(1.5 + noise(k + 7)));
    ((0..n_u * n_v).map(point).collect(), weights.collect())
}

fn compare<T: Real>(degree_u: usize, degree_v: usize, closure_u: Closure, tolerance: f64) {
    let (n_u, n_v) = (9, 8);
    let (points, weights) = tube::<T>(n_u, n_v);
    let knots_v = KnotVector::clamped_uniform(degree_v, n_v).unwrap();
    for weights in [None, Some(weights)] {
        let surface = if let Closure::Periodic { .. } = closure_u {
            Surface::closed_u(degree_u, knots_v.clone(), points.clone(), weights).unwrap()
        } else {
            let knots_u = KnotVector::clamped_uniform(degree_u, n_u).unwrap();
            Surface::new(knots_u, knots_v.clone(), points.clone(), weights).unwrap()
        };
        let options = GridOptions { columns: 13, rows: 11, closure_u, ..GridOptions::default() };
        let plan = GridPlan::new(surface.knots_u(), surface.knots_v(), options).unwrap();
        let (lo, hi) = surface.knots_u().domain();
        let mut count = 0;
        let emit = |index, vertex: lucerna_nurbs::GridVertex<T>| {
            assert_eq!(index, count);
            count += 1;
            let mut u = lo + (hi - lo) * vertex.u;
            if let Closure::Periodic { start_row } = closure_u {
                u += surface.knots_u().greville(start_row).unwrap() - lo;
                u += if u < lo { hi - lo } else { T::ZERO };
                u = if u > hi { u - (hi - lo) } else { u };
            }
            let point = surface.point(u, vertex.v).unwrap();
            let normal = surface.normal(u, vertex.v).unwrap();
            for axis in 0..3 {
                let error = (point[axis] - vertex.position[axis]).to_f64().abs();
                assert!(error <= tolerance * 3.0, "{index}: point off by {error:e}");
                let error = (normal[axis] - vertex.normal[axis]).to_f64().abs();
                assert!(error <= tolerance * 500.0, "{index}: normal off by {error:e}");
            }
        };
        let mut scratch = plan.scratch();
        plan.evaluate(surface.points(), surface.weights(), &mut scratch, emit).unwrap();
        assert_eq!(count, plan.vertex_count());
    }
}

#[test]
fn a_plan_gives_the_surface_point_by_point() {
    for (p, q) in [(1, 2), (2, 3), (3, 3), (4, 1), (5, 7), (7, 5)] {
        for closure in [Closure::Open, Closure::Periodic { start_row: 2 }] {
            compare::<f64>(p, q, closure, 1e-12);
            // Degree 1 has creases, where rounding chooses the side in f32.
            if p > 1 && q > 1 {
                compare::<f32>(p, q, closure, 2e-6);
            }
        }
    }
}

#[test]
fn scratch_that_was_used_for_another_plan_changes_nothing() {
    let around = KnotVector::<f32>::periodic(3, 9).unwrap();
    let along = KnotVector::clamped_uniform(3, 8).unwrap();
    let plan = |columns| {
        let options = GridOptions { columns, closure_u: Closure::Periodic { start_row: 0 }, ..GridOptions::default() };
        GridPlan::new(&around, &along, options).unwrap()
    };
    let (points, weights) = tube::<f32>(9, 8);
    let mesh = |scratch: &mut lucerna_nurbs::Scratch<f32>, weights: Option<&[f32]>| {
        let mut mesh = Vec::new();
        let emit = |_, vertex| mesh.push(vertex);
        plan(17).evaluate(&points, weights, scratch, emit).unwrap();
        mesh
    };
    let mut used = lucerna_nurbs::Scratch::new();
    let other = plan(40);
    other.evaluate(&points, Some(&weights), &mut used, |_, _| ()).unwrap();
    assert_eq!(mesh(&mut used, None), mesh(&mut lucerna_nurbs::Scratch::new(), None));
}

#[test]
fn repeated_rows_may_be_given_or_left_out_and_flip_turns_over() {
    let along = KnotVector::<f64>::clamped_uniform(3, 8).unwrap();
    let (points, _) = tube::<f64>(9, 8);
    let surface = Surface::closed_u(3, along, points.clone(), None).unwrap();
    let options = GridOptions { closure_u: Closure::Periodic { start_row: 0 }, ..GridOptions::default() };
    let mesh = |net: &[[f64; 3]], flip| {
        let options = GridOptions { flip, ..options };
        let plan = GridPlan::new(surface.knots_u(), surface.knots_v(), options).unwrap();
        let mut mesh = Vec::new();
        let emit = |_, vertex| mesh.push(vertex);
        plan.evaluate(net, None, &mut plan.scratch(), emit).unwrap();
        (mesh, plan.indices().to_vec())
    };
    let (mesh_long, triangles) = mesh(surface.points(), false);
    let (mesh_short, _) = mesh(&points, false);
    assert_eq!(mesh_long, mesh_short);
    let (turned, turned_triangles) = mesh(&points, true);
    for (a, b) in mesh_short.iter().zip(&turned) {
        assert_eq!(a.position, b.position);
        assert_eq!(a.normal, b.normal.map(|x| -x));
    }
    for (a, b) in triangles.chunks(3).zip(turned_triangles.chunks(3)) {
        assert_eq!([a[0], a[2], a[1]], [b[0], b[1], b[2]]);
    }
}
