//! Microseconds for one 48 x 48 mesh of a 16 x 11 bicubic net.

use lucerna_nurbs::{Closure, GridOptions, GridPlan, KnotVector, NurbsError};
use std::hint::black_box;
use std::time::Instant;

fn main() -> Result<(), NurbsError> {
    let around = KnotVector::<f32>::periodic(3, 16)?;
    let along = KnotVector::clamped_uniform(3, 11)?;
    let options =
        GridOptions { columns: 47, rows: 47, closure_u: Closure::Periodic { start_row: 0 }, ..GridOptions::default() };
    let plan = GridPlan::new(&around, &along, options)?;
    let mut scratch = plan.scratch();
    let net: Vec<[f32; 3]> = (0..16 * 11)
        .map(|k| {
            let (sin, cos) = ((k / 11) as f32 / 16.0 * std::f32::consts::TAU).sin_cos();
            let y = (k % 11) as f32 * 0.1;
            [(1.2 - y) * cos, y * 3.0, -(1.2 - y) * sin]
        })
        .collect();
    let weights: Vec<f32> = (0..net.len()).map(|k| 1.0 + 0.1 * (k % 3) as f32).collect();
    let mut mesh = vec![[0.0f32; 8]; plan.vertex_count()];
    for (name, weights) in [("polynomial", None), ("rational", Some(&weights[..]))] {
        let mut best = f64::INFINITY;
        for _ in 0..200 {
            let start = Instant::now();
            for _ in 0..20 {
                plan.evaluate(black_box(&net), weights, &mut scratch, |index, vertex| {
                    let ([x, y, z], [nx, ny, nz]) = (vertex.position, vertex.normal);
                    mesh[index] = [x, y, z, vertex.u, nx, ny, nz, vertex.v];
                })?;
                black_box(&mut mesh);
            }
            best = best.min(start.elapsed().as_secs_f64() / 20.0);
        }
        println!("{name}: {:.1} us, {} vertices", best * 1e6, plan.vertex_count());
    }
    Ok(())
}
