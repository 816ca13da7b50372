//! Many nets at once, and what goes with their meshes.

use lucerna_nurbs::{Closure, GridOptions, GridPlan, KnotVector, NurbsError};

fn plan() -> GridPlan<f32> {
    let options = GridOptions {
        columns: 12,
        rows: 5,
        closure_u: Closure::Periodic { start_row: 0 },
        pole_v_max: true,
        ..GridOptions::default()
    };
    GridPlan::new(&KnotVector::periodic(3, 6).unwrap(), &KnotVector::clamped_uniform(3, 5).unwrap(), options).unwrap()
}

fn nets(count: usize) -> (Vec<[f32; 3]>, Vec<f32>) {
    let points = (0..count * 30).map(|k| {
        let angle = (k / 5 % 6) as f32 * std::f32::consts::TAU / 6.0;
        let radius = (4 - k % 5) as f32 + 0.3 * (k as f32).sin();
        [radius * angle.cos(), (k % 5) as f32, -radius * angle.sin()]
    });
    (points.collect(), (0..count * 30).map(|k| 1.0 + 0.2 * (k as f32 * 0.7).cos()).collect())
}

#[test]
fn many_nets_give_the_mesh_of_each_however_they_are_shared_out() {
    let plan = plan();
    let (points, weights) = nets(7);
    let vertices = plan.vertex_count();
    for weights in [None, Some(&weights[..])] {
        let mut wanted = vec![[0.0; 8]; 7 * vertices];
        for (k, mesh) in wanted.chunks_exact_mut(vertices).enumerate() {
            let weights = weights.map(|weights| &weights[30 * k..30 * k + 30]);
            plan.evaluate_into(&points[30 * k..30 * k + 30], weights, &mut plan.scratch(), mesh).unwrap();
        }
        for shares in [1, 2, 3, 4, 7, 20] {
            let mut scratches = vec![plan.scratch(); shares];
            let mut meshes = vec![[9.0; 8]; 7 * vertices + 1];
            plan.evaluate_many(&points, weights, &mut scratches, &mut meshes[..]).unwrap();
            assert_eq!(meshes[..7 * vertices], wanted[..], "{shares} shares");
            assert_eq!(meshes[7 * vertices], [9.0; 8]);
        }
    }
    plan.evaluate_many::<[f32; 8]>(&[], None, &mut [plan.scratch()], &mut []).unwrap();
}

#[test]
fn nets_that_do_not_fit_are_refused_by_name() {
    let plan = plan();
    let (mut points, mut weights) = nets(3);
    let mut meshes = vec![[0.0_f32; 8]; 3 * plan.vertex_count()];
    let many = |points: &[[f32; 3]], weights: Option<&[f32]>, scratches: usize, meshes: usize| {
        let mut scratches = vec![plan.scratch(); scratches];
        let mut meshes = vec![[0.0; 8]; meshes];
        plan.evaluate_many(points, weights, &mut scratches, &mut meshes[..]).unwrap_err()
    };
    let room = meshes.len();
    assert_eq!(many(&points[1..], None, 1, room), NurbsError::PointCount { found: 89, expected: 90 });
    let count = NurbsError::WeightCount { found: 60, expected: 90 };
    assert_eq!(many(&points, Some(&weights[..60]), 1, room), count);
    assert!(matches!(many(&points, None, 1, room - 1), NurbsError::Room { .. }));
    assert!(matches!(many(&points, None, 0, room), NurbsError::Cells { name: "scratches", .. }));
    points[70][1] = f32::NAN;
    assert!(matches!(many(&points, None, 2, room), NurbsError::PointValue { index: 70, axis: 1, .. }));
    points[70][1] = 0.0;
    weights[31] = -1.0;
    assert!(matches!(many(&points, Some(&weights), 2, room), NurbsError::Weight { index: 31, .. }));
    weights[31] = 1.0;
    plan.evaluate_many(&points, Some(&weights), &mut [plan.scratch()], &mut meshes[..]).unwrap();
}

#[test]
fn short_indices_are_the_same_and_are_refused_where_they_cannot_be() {
    let plan = plan();
    let short = plan.indices_u16().unwrap();
    assert!(short.iter().map(|&index| u32::from(index)).eq(plan.indices().iter().copied()));
    let line = KnotVector::<f32>::clamped_uniform(1, 2).unwrap();
    let of = |columns| GridPlan::new(&line, &line, GridOptions { columns, rows: 255, ..Default::default() }).unwrap();
    assert_eq!(of(255).indices_u16().unwrap().iter().max(), Some(&u16::MAX));
    let error = of(256).indices_u16().unwrap_err();
    assert_eq!(error, NurbsError::Cells { name: "vertices", found: 65792, min: 1, max: 65536 });
}

#[test]
fn slits_are_refused_where_there_can_be_none() {
    let (ring, line) = (KnotVector::<f32>::periodic(3, 6).unwrap(), KnotVector::clamped_uniform(3, 6).unwrap());
    let around = Closure::Periodic { start_row: 0 };
    let slit = GridOptions { closure_u: around, slit_v_min: true, ..GridOptions::default() };
    assert!(GridPlan::new(&ring, &line, slit).is_ok());
    assert!(GridPlan::new(&ring, &line, GridOptions { pole_v_max: true, ..slit }).is_ok());
    for wrong in [
        GridOptions { closure_u: Closure::Open, ..slit },
        GridOptions { closure_v: Closure::Joined, ..slit },
        GridOptions { pole_v_min: true, ..slit },
    ] {
        assert_eq!(GridPlan::new(&ring, &line, wrong).unwrap_err(), NurbsError::Slit);
    }
    let flat = GridOptions { slit_v_max: true, rows: 1, ..slit };
    assert!(matches!(GridPlan::new(&ring, &line, flat), Err(NurbsError::Cells { name: "rows", min: 2, .. })));
}
