//! The forms that a mesh can be written in, and the instructions that it is computed with.

use lucerna_nurbs::{
    Closure, GridLayout, GridOptions, GridPlan, GridVertex, Interleaved, KnotVector, NurbsError, Real, SimdLevel,
};

/// A net with a pole below, closed around, in which nothing is symmetric.
fn net<T: Real>(rows: usize, columns: usize) -> (Vec<[T; 3]>, Vec<T>) {
    let points = (0..rows * columns).map(|k| {
        let (i, j) = ((k / columns) as f64, (k % columns) as f64);
        let angle = i / rows as f64 * std::f64::consts::TAU;
        let radius = j * (1.3 + (i * 1.7 + j).sin() * 0.2) / columns as f64;
        [radius * angle.cos(), j * 0.3, -radius * angle.sin()].map(T::from_f64)
    });
    (points.collect(), (0..rows * columns).map(|k| T::from_f64(1.0 + 0.3 * (k as f64 * 0.9).cos())).collect())
}

fn plan<T: Real>(columns: usize, rows: usize) -> GridPlan<T> {
    let options = GridOptions {
        columns,
        rows,
        closure_u: Closure::Periodic { start_row: 1 },
        pole_v_min: true,
        ..Default::default()
    };
    let (around, along) = (KnotVector::periodic(3, 9).unwrap(), KnotVector::clamped_uniform(3, 7).unwrap());
    GridPlan::new(&around, &along, options).unwrap()
}

fn vertices<T: Real>(plan: &GridPlan<T>, points: &[[T; 3]], weights: Option<&[T]>) -> Vec<GridVertex<T>> {
    let mut vertices = Vec::new();
    let emit = |index, vertex| {
        assert_eq!(index, vertices.len());
        vertices.push(vertex);
    };
    plan.evaluate(points, weights, &mut plan.scratch(), emit).unwrap();
    assert_eq!(vertices.len(), plan.vertex_count());
    vertices
}

fn compare_levels<T: Real>() {
    for (columns, rows) in [(3, 1), (5, 4), (16, 9), (31, 16), (33, 20), (64, 64)] {
        let (points, weights) = net::<T>(9, 7);
        for weights in [None, Some(&weights[..])] {
            let best = vertices(&plan(columns, rows), &points, weights);
            for level in [SimdLevel::Baseline, SimdLevel::Avx2] {
                assert_eq!(vertices(&plan(columns, rows).with_simd(level), &points, weights), best, "{level:?}");
            }
        }
    }
}

#[test]
fn all_instructions_give_the_same_bits() {
    compare_levels::<f32>();
    compare_levels::<f64>();
}

#[test]
fn all_forms_hold_the_same_vertices() {
    let (points, weights) = net::<f32>(9, 7);
    for (columns, rows) in [(3, 1), (7, 5), (48, 48), (50, 3)] {
        let plan = plan(columns, rows);
        let count = plan.vertex_count();
        let wanted = vertices(&plan, &points, Some(&weights));
        let mut scratch = plan.scratch();

        let mut plain = vec![[9.0; 8]; count + 1];
        plan.evaluate_into(&points, Some(&weights), &mut scratch, &mut plain[..]).unwrap();
        assert_eq!(plain[count], [9.0; 8], "nothing is written behind the mesh");
        let plain: Vec<_> = plain[..count].iter().map(|&vertex| GridVertex::from(vertex)).collect();
        assert_eq!(plain, wanted);

        let mut structs = vec![GridVertex::default(); count];
        plan.evaluate_into(&points, Some(&weights), &mut scratch, &mut structs[..]).unwrap();
        assert_eq!(structs, wanted);

        let layout = GridLayout { stride: 11, position: Some(2), normal: Some(7), uv: Some(5) };
        let mut numbers = vec![9.0; 11 * count];
        let mut output = Interleaved::new(&mut numbers, layout).unwrap();
        plan.evaluate_into(&points, Some(&weights), &mut scratch, &mut output).unwrap();
        for (found, vertex) in numbers.chunks_exact(11).zip(&wanted) {
            let ([x, y, z], [a, b, c]) = (vertex.position, vertex.normal);
            assert_eq!(found, [9.0, 9.0, x, y, z, vertex.u, vertex.v, a, b, c, 9.0]);
        }
        let layout = GridLayout { stride: 3, position: Some(0), normal: None, uv: None };
        let mut numbers = vec![9.0; 3 * count];
        let mut output = Interleaved::new(&mut numbers, layout).unwrap();
        plan.evaluate_into(&points, Some(&weights), &mut scratch, &mut output).unwrap();
        assert!(numbers.as_chunks().0.iter().zip(&wanted).all(|(found, vertex)| *found == vertex.position));
    }
}

#[test]
fn outputs_that_do_not_fit_are_refused_by_name() {
    let (points, _) = net::<f32>(9, 7);
    let plan = plan::<f32>(8, 8);
    let mut short = vec![[9.0; 8]; plan.vertex_count() - 1];
    let error = plan.evaluate_into(&points, None, &mut plan.scratch(), &mut short[..]).unwrap_err();
    assert_eq!(error, NurbsError::Room { found: 79, needed: 80 });
    assert_eq!(short[0], [9.0; 8]);
    let layout = |stride, normal| GridLayout { stride, position: Some(0), normal: Some(normal), uv: None };
    let error = |layout| Interleaved::new(&mut [0.0_f32; 80], layout).unwrap_err();
    assert_eq!(error(layout(5, 3)), NurbsError::Layout { name: "normal", offset: 3, len: 3, stride: 5 });
    assert!(matches!(error(layout(2, usize::MAX)), NurbsError::Layout { name: "position", .. }));
    let none = GridLayout { stride: 0, position: None, normal: None, uv: None };
    assert!(matches!(error(none), NurbsError::Layout { name: "vertex", .. }));
    let mut short = [0.0; 6 * 79];
    let error = plan.evaluate_into(
        &points,
        None,
        &mut plan.scratch(),
        &mut Interleaved::new(&mut short, layout(6, 3)).unwrap(),
    );
    assert_eq!(error.unwrap_err(), NurbsError::Room { found: 79, needed: 80 });
}
