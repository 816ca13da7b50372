//! What is refused, and that nothing panics.

use lucerna_nurbs::{Closure, Curve, GridOptions, GridPlan, KnotVector, NurbsError, Surface, cells_for_error};
use proptest::prelude::*;

#[test]
fn knots_are_refused_by_name() {
    let new = KnotVector::<f64>::new;
    let error = |degree, knots: &[f64]| new(degree, knots.to_vec()).unwrap_err();
    assert_eq!(error(0, &[0.0, 1.0]), NurbsError::Degree { degree: 0, count: 1 });
    assert!(matches!(error(usize::MAX, &[0.0]), NurbsError::Degree { .. }));
    assert!(matches!(error(3, &[]), NurbsError::KnotCount { found: 0, needed: 8, .. }));
    assert_eq!(
        error(1, &[0.0, 0.0, 0.5, 0.4, 1.0, 1.0]),
        NurbsError::KnotDecreasing { index: 3, value: 0.4, previous: 0.5 }
    );
    assert_eq!(
        error(1, &[0.0, 0.0, 0.5, 0.5, 1.0, 1.0]),
        NurbsError::KnotRepeated { index: 2, value: 0.5, times: 2, allowed: 1 }
    );
    assert!(matches!(
        error(1, &[0.0, 0.0, 0.0, 1.0, 1.0]),
        NurbsError::KnotRepeated { index: 0, times: 3, allowed: 2, .. }
    ));
    assert!(matches!(error(1, &[0.0, f64::NAN, 1.0, 1.0]), NurbsError::KnotValue { index: 1, .. }));
    assert_eq!(error(2, &[0.0, 0.5, 1.0, 1.0, 2.0, 3.0]), NurbsError::EmptyDomain { lo: 1.0, hi: 1.0 });
    assert!(KnotVector::<f64>::clamped_uniform(3, 3).is_err());
    assert!(KnotVector::<f64>::clamped_uniform(3, usize::MAX).is_err());
    assert!(KnotVector::<f64>::uniform(usize::MAX, usize::MAX).is_err());
    assert!(KnotVector::<f64>::periodic(3, 2).is_err());
    assert!(KnotVector::<f64>::clamped(2, &[1.5]).is_err());
}

#[test]
fn points_weights_and_parameters_are_refused_by_name() {
    let knots = KnotVector::<f64>::clamped_uniform(1, 2).unwrap();
    let line = |points: &[[f64; 2]], weights: Option<Vec<f64>>| Curve::new(knots.clone(), points.to_vec(), weights);
    let ends = [[0.0, 0.0], [1.0, 1.0]];
    assert_eq!(line(&ends[..1], None).unwrap_err(), NurbsError::PointCount { found: 1, expected: 2 });
    assert!(matches!(
        line(&[[0.0, f64::NAN], ends[1]], None).unwrap_err(),
        NurbsError::PointValue { index: 0, axis: 1, .. }
    ));
    assert_eq!(line(&ends, Some(vec![1.0])).unwrap_err(), NurbsError::WeightCount { found: 1, expected: 2 });
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = line(&ends, Some(vec![1.0, bad])).unwrap_err();
        assert!(matches!(error, NurbsError::Weight { index: 1, .. }), "{error}");
    }
    let curve = line(&ends, None).unwrap();
    for bad in [-0.1, 1.1, f64::NAN] {
        let error = curve.point(bad).unwrap_err();
        assert!(error.to_string().contains("must be 0 to 1"), "{error}");
    }
    assert!(curve.derivatives(0.5, usize::MAX).is_err());
    assert!(Surface::closed_u(3, knots.clone(), vec![], None).is_err());
    assert!(Surface::closed_u(3, knots.clone(), vec![[0.0; 3]; 7], None).is_err());
    let flat = Surface::new(knots.clone(), knots, vec![[1.0; 3]; 4], None).unwrap();
    assert_eq!(flat.normal(0.5, 0.0).unwrap_err(), NurbsError::NoNormal { u: 0.5, v: 0.0 });
}

#[test]
fn grids_are_refused_by_name() {
    let knots = KnotVector::<f32>::clamped_uniform(3, 5).unwrap();
    let ring = KnotVector::<f32>::periodic(3, 5).unwrap();
    let around = |start_row| Closure::Periodic { start_row };
    let new = |u, options| GridPlan::new(u, &knots, options).unwrap_err();
    let base = GridOptions::default();
    let error = new(&knots, GridOptions { columns: 0, ..base });
    assert!(matches!(error, NurbsError::Cells { name: "columns", found: 0, min: 1, .. }));
    let error = new(&knots, GridOptions { columns: 8192, rows: 8192, ..base });
    assert!(matches!(error, NurbsError::Cells { name: "vertices", .. }));
    let poles = GridOptions { rows: 1, pole_v_min: true, pole_v_max: true, ..base };
    assert!(matches!(new(&knots, poles), NurbsError::Cells { name: "rows", min: 2, .. }));
    let closed = GridOptions { closure_v: Closure::Joined, pole_v_min: true, ..base };
    assert_eq!(new(&knots, closed), NurbsError::PoleOnClosed);
    let periodic = GridOptions { closure_u: around(0), ..base };
    assert!(matches!(new(&knots, periodic), NurbsError::NotPeriodic { .. }));
    let far = GridOptions { closure_u: around(5), ..base };
    assert_eq!(new(&ring, far), NurbsError::StartRow { row: 5, count: 5 });

    let plan = GridPlan::new(&ring, &knots, periodic).unwrap();
    assert_eq!(plan.point_count(), 25);
    let mut net = vec![[0.0f32; 3]; 25];
    let mut called = false;
    let mut evaluate = |net: &[[f32; 3]], weights: Option<&[f32]>| {
        plan.evaluate(net, weights, &mut plan.scratch(), |_, _| called = true)
    };
    assert_eq!(evaluate(&net[1..], None).unwrap_err(), NurbsError::PointCount { found: 24, expected: 25 });
    assert!(evaluate(&net, Some(&[1.0; 24])).is_err());
    assert!(evaluate(&net, Some(&[0.0; 25])).is_err());
    net[24][2] = f32::INFINITY;
    assert!(evaluate(&net, None).is_err());
    assert!(!called);
    assert!(cells_for_error(0.0, 1.0).is_err() && cells_for_error(1.0, f64::NAN).is_err());
    assert_eq!(cells_for_error(1e300, 1e-300), Ok(8192));
}

fn value() -> impl Strategy<Value = f32> {
    prop_oneof![-2.0f32..2.0, Just(0.0), Just(1.0), any::<f32>(),]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    #[test]
    fn knots_of_any_kind_are_taken_or_refused(
        degree in 0usize..5,
        mut knots in prop::collection::vec(value(), 0..16),
        sorted in any::<bool>(),
        t in value(),
    ) {
        if sorted {
            knots.sort_by(f32::total_cmp);
        }
        if let Ok(knots) = KnotVector::new(degree, knots) {
            let (lo, hi) = knots.domain();
            for t in [lo, hi, lo + (hi - lo) * 0.5, t] {
                if let Ok(basis) = knots.basis_derivatives(t, 2) {
                    let sum: f32 = basis.derivative(0).unwrap().iter().sum();
                    prop_assert!((sum - 1.0).abs() < 1e-5);
                }
            }
            let points = vec![[1.0f32; 3]; knots.count().pow(2)];
            let plan = GridPlan::new(&knots, &knots, GridOptions { columns: 5, rows: 3, ..Default::default() }).unwrap();
            let mut finite = true;
            plan.evaluate(&points, None, &mut plan.scratch(), |_, vertex| {
                finite &= vertex.position.iter().chain(&vertex.normal).all(|x| x.is_finite());
            }).unwrap();
            prop_assert!(finite);
        }
    }

    #[test]
    fn nets_of_any_kind_give_finite_meshes(
        net in prop::collection::vec(prop::array::uniform3(value()), 30),
        weights in prop::option::of(prop::collection::vec(prop_oneof![0.1f32..10.0, Just(1e-9), Just(1e9)], 30)),
        same in 0usize..30,
        columns in 3usize..9,
        rows in 2usize..7,
        bits in 0u8..16,
    ) {
        let mut net = net;
        let copied = net[0];
        net[..same].fill(copied);
        let ring = KnotVector::<f32>::periodic(3, 6).unwrap();
        let along = KnotVector::<f32>::clamped(3, &[0.1]).unwrap();
        let options = GridOptions {
            columns,
            rows,
            closure_u: if bits & 8 > 0 { Closure::Periodic { start_row: 1 } } else { Closure::Open },
            pole_v_min: bits & 1 > 0,
            pole_v_max: bits & 2 > 0,
            flip: bits & 4 > 0,
            ..Default::default()
        };
        let plan = GridPlan::new(&ring, &along, options).unwrap();
        let points = if bits & 8 > 0 { net } else { (0..45).map(|k| net[k % 30]).collect() };
        let weights = weights.map(|w| (0..points.len()).map(|k| w[k % 30]).collect::<Vec<_>>());
        let mut worst = 0.0f32;
        let result = plan.evaluate(&points, weights.as_deref(), &mut plan.scratch(), |_, vertex| {
            let length = vertex.normal.iter().map(|x| x * x).sum::<f32>().sqrt();
            worst = worst.max((length - 1.0).abs());
            if !vertex.position.iter().chain(&[vertex.u, vertex.v, length]).all(|x| x.is_finite()) {
                worst = f32::INFINITY;
            }
        });
        match result {
            Ok(()) => prop_assert!(worst < 1e-4, "{worst}"),
            Err(NurbsError::PointValue { .. }) => {}
            Err(error) => prop_assert!(false, "{error}"),
        }
    }
}
