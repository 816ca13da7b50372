//! Nothing is allocated by a mesh of a size that has been computed before.

use allocation_counter::measure;
use lucerna_nurbs::{Closure, GridOptions, GridPlan, KnotVector, Scratch};

#[test]
fn a_mesh_computed_again_allocates_nothing() {
    let around = KnotVector::<f32>::periodic(3, 16).unwrap();
    let along = KnotVector::clamped_uniform(3, 11).unwrap();
    let net: Vec<[f32; 3]> = (0..16 * 11).map(|k| [(k as f32).sin(), (k % 11) as f32, (k as f32).cos()]).collect();
    let weights: Vec<f32> = (0..net.len()).map(|k| 1.0 + 0.1 * (k % 3) as f32).collect();
    for poles in [false, true] {
        let options = GridOptions {
            closure_u: Closure::Periodic { start_row: 0 },
            pole_v_min: poles,
            pole_v_max: poles,
            ..GridOptions::default()
        };
        let plan = GridPlan::new(&around, &along, options).unwrap();
        let small = GridPlan::new(&around, &along, GridOptions { columns: 7, rows: 5, ..options }).unwrap();
        let mut mesh = vec![[0.0_f32; 8]; plan.vertex_count()];
        let mut sum = 0.0;
        for (name, mut scratch) in [("prepared", plan.scratch()), ("grown", Scratch::new())] {
            let mut evaluate = || {
                for plan in [&plan, &small, &plan] {
                    for weights in [Some(&weights[..]), None] {
                        plan.evaluate_into(&net, weights, &mut scratch, &mut mesh[..]).unwrap();
                        plan.evaluate(&net, weights, &mut scratch, |_, vertex| sum += vertex.position[0]).unwrap();
                    }
                }
            };
            if name == "grown" {
                evaluate();
            }
            let allocated = measure(evaluate).count_total;
            println!("poles {poles}, scratch {name}: {allocated} allocations in 12 meshes");
            assert_eq!(allocated, 0);
        }
        assert!(sum.is_finite());
    }
}

#[test]
fn many_meshes_computed_again_allocate_nothing() {
    let knots = KnotVector::<f32>::clamped_uniform(3, 9).unwrap();
    let plan = GridPlan::new(&knots, &knots, GridOptions::default()).unwrap();
    let nets: Vec<[f32; 3]> = (0..5 * 81).map(|k| [(k / 9) as f32, (k % 9) as f32, (k as f32).sin()]).collect();
    let mut scratches = vec![plan.scratch(); 3];
    let mut meshes = vec![[0.0_f32; 8]; 5 * plan.vertex_count()];
    let mut evaluate = || plan.evaluate_many(&nets, None, &mut scratches, &mut meshes[..]).unwrap();
    evaluate();
    // Tasks of a thread pool are not counted here.
    if cfg!(not(feature = "rayon")) {
        let allocated = measure(evaluate).count_total;
        println!("{allocated} allocations in 5 meshes at once");
        assert_eq!(allocated, 0);
    }
}
