//! Microseconds for one 48 x 48 mesh of a 16 x 11 bicubic net.

use lucerna_nurbs::{Closure, GridOptions, GridPlan, KnotVector, NurbsError, SimdLevel};
use std::hint::black_box;
use std::time::Instant;

/// The shortest time of 200 runs of `work`, in microseconds.
fn best_us(mut work: impl FnMut() -> Result<(), NurbsError>) -> Result<f64, NurbsError> {
    let mut best = f64::INFINITY;
    for _ in 0..200 {
        let start = Instant::now();
        for _ in 0..20 {
            work()?;
        }
        best = best.min(start.elapsed().as_secs_f64() / 20.0 * 1e6);
    }
    Ok(best)
}

fn main() -> Result<(), NurbsError> {
    let around = KnotVector::<f32>::periodic(3, 16)?;
    let along = KnotVector::clamped_uniform(3, 11)?;
    let net: Vec<[f32; 3]> = (0..16 * 11)
        .map(|k| {
            let (sin, cos) = ((k / 11) as f32 / 16.0 * std::f32::consts::TAU).sin_cos();
            let y = (k % 11) as f32 * 0.1;
            [(1.2 - y) * cos, y * 3.0, -(1.2 - y) * sin]
        })
        .collect();
    let weights: Vec<f32> = (0..net.len()).map(|k| 1.0 + 0.1 * (k % 3) as f32).collect();
    for poles in [false, true] {
        let options = GridOptions {
            columns: 47,
            rows: 47,
            closure_u: Closure::Periodic { start_row: 0 },
            pole_v_min: poles,
            pole_v_max: poles,
            ..GridOptions::default()
        };
        for level in [SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Best] {
            let plan = GridPlan::new(&around, &along, options)?.with_simd(level);
            let mut scratch = plan.scratch();
            let mut mesh = vec![[0.0_f32; 8]; plan.vertex_count()];
            for (name, weights) in [("polynomial", None), ("rational", Some(&weights[..]))] {
                let plain = best_us(|| {
                    plan.evaluate_into(black_box(&net), weights, &mut scratch, &mut black_box(&mut mesh)[..])
                })?;
                let closure = best_us(|| {
                    let mesh = black_box(&mut mesh);
                    plan.evaluate(black_box(&net), weights, &mut scratch, |index, vertex| {
                        let ([x, y, z], [a, b, c]) = (vertex.position, vertex.normal);
                        mesh[index] = [x, y, z, vertex.u, a, b, c, vertex.v];
                    })
                })?;
                println!("{name}, poles {poles}, {level:?}: {plain:.1} us in place, {closure:.1} us by a closure");
            }
        }
    }
    Ok(())
}
