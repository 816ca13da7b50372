//! Grids of every size on shapes of every kind: unit normals, also at poles, no triangle without
//! area, no crack.

use crate::shapes::{QUARTERS, Shape, cross, degrees, dot, shapes, sub};
use lucerna_nurbs::{Closure, GridOptions, GridPlan, GridVertex, KnotVector, NurbsError};
use std::collections::HashMap;

/// What a grid of this size must be refused for.
fn refusal(shape: &Shape, columns: usize, rows: usize) -> Option<&'static str> {
    let least = |closure| if closure == Closure::Open { 1 } else { 3 };
    let GridOptions { pole_v_min, pole_v_max, slit_v_min, slit_v_max, .. } = shape.options;
    let ends = usize::from(pole_v_min || slit_v_min) + usize::from(pole_v_max || slit_v_max);
    if columns < least(shape.options.closure_u) {
        return Some("columns");
    }
    (rows < least(shape.options.closure_v).max(ends)).then_some("rows")
}

/// Checks a grid of a shape. Returns the greatest angle between a normal at a pole and its limit.
fn check(shape: &Shape, columns: usize, rows: usize, edges: bool) -> f64 {
    let what = format!("{} with {columns} x {rows} cells", shape.name);
    let options = GridOptions { columns, rows, ..shape.options };
    let plan = match (GridPlan::new(&shape.knots[0], &shape.knots[1], options), refusal(shape, columns, rows)) {
        (Ok(plan), None) => plan,
        (Err(NurbsError::Cells { name, .. }), Some(wanted)) if name == wanted => return 0.0,
        (other, wanted) => panic!("{what}: {:?}, wanted {wanted:?}", other.err()),
    };
    let mut mesh = vec![GridVertex::default(); plan.vertex_count()];
    plan.evaluate_into(&shape.points, shape.weights.as_deref(), &mut plan.scratch(), &mut mesh[..]).unwrap();
    for (k, vertex) in mesh.iter().enumerate() {
        let normal = vertex.normal.map(f64::from);
        assert!((dot(normal, normal) - 1.0).abs() < 1e-5, "{what}: normal {k} is {normal:?}");
    }
    let place = |index: u32| mesh[index as usize].position.map(f64::from);
    for triangle in plan.indices().as_chunks::<3>().0 {
        let [a, b, c] = triangle.map(place);
        let area = cross(sub(b, a), sub(c, a));
        assert!(dot(area, area) > 0.0, "{what}: triangle {triangle:?} has no area");
    }
    let row_start = |j: usize| j * (columns + 1) - usize::from(j > 0 && options.pole_v_min);
    let same = |a: usize, b: usize| {
        assert_eq!(mesh[a].position, mesh[b].position, "{what}: {a} and {b}");
        assert_eq!(mesh[a].normal, mesh[b].normal, "{what}: {a} and {b}");
    };
    let pole = |j: usize| (j == 0 && options.pole_v_min) || (j == rows && options.pole_v_max);
    if options.closure_u != Closure::Open {
        (0..=rows).filter(|&j| !pole(j)).for_each(|j| same(row_start(j), row_start(j) + columns));
    }
    if options.closure_v != Closure::Open {
        (0..=columns).for_each(|i| same(i, row_start(rows) + i));
    }
    if edges && shape.closed {
        check_edges(&mesh, plan.indices(), &what);
    }
    pole_error(shape, &mesh, (0..=rows).filter(|&j| pole(j)).map(|j| (j, row_start(j))), columns)
}

/// Between welded vertices, every edge belongs to two triangles, once in each direction.
fn check_edges(mesh: &[GridVertex<f32>], indices: &[u32], what: &str) {
    let mut places = HashMap::new();
    let welded: Vec<u32> = mesh
        .iter()
        .map(|vertex| {
            let key = vertex.position.map(|x| (x + 0.0).to_bits());
            let next = places.len() as u32;
            *places.entry(key).or_insert(next)
        })
        .collect();
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for triangle in indices.as_chunks::<3>().0 {
        let [a, b, c] = triangle.map(|index| welded[index as usize]);
        for (a, b) in [(a, b), (b, c), (c, a)] {
            *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { 1 << 16 };
        }
    }
    for (edge, count) in edges {
        assert_eq!(count, 1 + (1 << 16), "{what}: edge {edge:?}");
    }
}

/// The greatest angle in degrees between normals at poles and those of the surface a little inside.
fn pole_error(
    shape: &Shape,
    mesh: &[GridVertex<f32>],
    poles: impl Iterator<Item = (usize, usize)>,
    columns: usize,
) -> f64 {
    let ((u_lo, u_hi), (v_lo, v_hi)) = (shape.exact.knots_u().domain(), shape.exact.knots_v().domain());
    let start = match shape.options.closure_u {
        Closure::Periodic { start_row } => shape.exact.knots_u().greville(start_row).unwrap() - u_lo,
        _ => 0.0,
    };
    let mut worst: f64 = 0.0;
    for (j, first) in poles {
        let inside = 1e-6 * (v_hi - v_lo);
        let v = if j == 0 { v_lo + inside } else { v_hi - inside };
        for vertex in &mesh[first..first + columns] {
            let u = u_lo + (start + (u_hi - u_lo) * f64::from(vertex.u)).rem_euclid(u_hi - u_lo);
            let d = shape.exact.derivatives(u, v, 1).unwrap();
            let limit = cross(d.get(1, 0).unwrap(), d.get(0, 1).unwrap());
            worst = worst.max(degrees(vertex.normal.map(f64::from), limit));
        }
    }
    worst
}

#[test]
fn grids_of_all_sizes_have_normals_areas_and_no_cracks() {
    let counts = [1, 2, 3, 4, 5, 6, 7, 8, 9, 15, 16, 17, 31, 33, 48, 64];
    for shape in shapes() {
        let mut worst: f64 = 0.0;
        for columns in counts {
            for rows in counts {
                worst = worst.max(check(&shape, columns, rows, columns * rows < 1000));
            }
        }
        for (columns, rows) in [(200, 200), (199, 101), (1, 200), (200, 2), (127, 199)] {
            worst = worst.max(check(&shape, columns, rows, false));
        }
        println!("{}: normals at poles within {worst:.4} degrees", shape.name);
        assert!(worst < 0.1, "{}: {worst}", shape.name);
    }
}

#[test]
#[ignore = "every grid from 1 x 1 to 200 x 200: minutes"]
fn all_grids_there_are_have_normals_areas_and_no_cracks() {
    for shape in shapes() {
        let mut worst: f64 = 0.0;
        for columns in 1..=200 {
            for rows in 1..=200 {
                worst = worst.max(check(&shape, columns, rows, columns * rows <= 2500));
            }
        }
        println!("{}: normals at poles within {worst:.4} degrees", shape.name);
        assert!(worst < 0.1, "{}: {worst}", shape.name);
    }
}

#[test]
fn edges_that_collapse_along_v_have_their_limit_normals() {
    // The sphere with its directions exchanged: its poles are the ends of u, undeclared.
    let sphere = &shapes()[0].exact;
    let order = || (0..5).flat_map(|j| (0..9).map(move |i| i * 5 + j));
    let points: Vec<[f32; 3]> = order().map(|k| sphere.points()[k].map(|x| x as f32)).collect();
    let weights: Vec<f32> = order().map(|k| sphere.weights().unwrap()[k] as f32).collect();
    let (u, v) =
        (KnotVector::clamped(2, &[0.5, 0.5]).unwrap(), KnotVector::clamped(2, &QUARTERS.map(|x| x as f32)).unwrap());
    let options = GridOptions { columns: 30, rows: 17, closure_v: Closure::Joined, flip: true, ..Default::default() };
    let plan = GridPlan::new(&u, &v, options).unwrap();
    let mut worst: f64 = 0.0;
    let emit = |_, vertex: GridVertex<f32>| {
        worst = worst.max(degrees(vertex.normal.map(f64::from), vertex.position.map(f64::from)));
    };
    plan.evaluate(&points, Some(&weights), &mut plan.scratch(), emit).unwrap();
    println!("a sphere with poles at the ends of u: normals within {worst:.4} degrees");
    assert!(worst < 0.1, "{worst}");
}
