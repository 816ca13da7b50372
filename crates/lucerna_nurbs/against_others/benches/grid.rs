//! A 48 x 48 mesh, positions and normals, of a 16 x 11 bicubic rational net: Lucerna, curvo, truck.
//!
//! `cargo bench` prints Criterion's times, then the ratios of interleaved runs, then times of a
//! thousand different surfaces on one and on two threads.

use criterion::Criterion;
use lucerna_nurbs::{NurbsError, SimdLevel};
use lucerna_nurbs_against_others::{SAMPLES, Shape, run_curvo, run_truck};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// What the arithmetic takes at least, with AVX2 and with the best (AVX-512), and what writing 32-byte
/// vertices at 30 GB/s does.
const LEAST_US: [(SimdLevel, f64); 2] = [(SimdLevel::Avx2, 2.8), (SimdLevel::Best, 1.4)];
const LEAST_MEMORY_US: f64 = 2.5;

fn main() -> Result<(), NurbsError> {
    let shape = Shape::new(0)?;
    with_criterion(&shape)?;
    ratios(&shape)?;
    thousand()
}

fn with_criterion(shape: &Shape) -> Result<(), NurbsError> {
    let mut criterion = Criterion::default()
        .configure_from_args()
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2));
    let (curvo, truck) = (shape.curvo(), shape.truck());
    let mut group = criterion.benchmark_group("48 x 48");
    for level in [SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Best] {
        let mut grid = shape.lucerna(level)?;
        group.bench_function(format!("lucerna f32 {level:?}"), |b| b.iter(|| black_box(&mut grid).run()));
        let mut grid = shape.lucerna_f64(level)?;
        group.bench_function(format!("lucerna f64 {level:?}"), |b| b.iter(|| black_box(&mut grid).run()));
    }
    group.sample_size(20);
    group.bench_function("curvo", |b| b.iter(|| run_curvo(black_box(&curvo))));
    group.bench_function("truck", |b| b.iter(|| run_truck(black_box(&truck))));
    group.finish();
    Ok(())
}

/// The shortest of some runs, in microseconds.
fn shorten(best: &mut f64, times: u32, mut work: impl FnMut()) {
    let start = Instant::now();
    (0..times).for_each(|_| work());
    *best = best.min(start.elapsed().as_secs_f64() / f64::from(times) * 1e6);
}

fn ratios(shape: &Shape) -> Result<(), NurbsError> {
    let (curvo, truck) = (shape.curvo(), shape.truck());
    let levels = [SimdLevel::Baseline, SimdLevel::Avx2, SimdLevel::Best];
    let mut single = levels.map(|level| shape.lucerna(level));
    let mut double = levels.map(|level| shape.lucerna_f64(level));
    let (mut curvo_us, mut truck_us) = (f64::INFINITY, f64::INFINITY);
    let mut us = [[f64::INFINITY; 2]; 3];
    for _ in 0..60 {
        shorten(&mut curvo_us, 2, || drop(black_box(run_curvo(black_box(&curvo)))));
        shorten(&mut truck_us, 1, || drop(black_box(run_truck(black_box(&truck)))));
        for (k, us) in us.iter_mut().enumerate() {
            if let (Ok(single), Ok(double)) = (&mut single[k], &mut double[k]) {
                shorten(&mut us[0], 50, || drop(black_box(black_box(&mut *single).run())));
                shorten(&mut us[1], 50, || drop(black_box(black_box(&mut *double).run())));
            }
        }
    }
    println!("\nthe shortest times of interleaved runs: curvo {curvo_us:.0} us, truck {truck_us:.0} us");
    for (level, us) in levels.iter().zip(us) {
        for (width, us) in ["f32", "f64"].iter().zip(us) {
            let (curvo, truck) = (curvo_us / us, truck_us / us);
            println!("lucerna {width} {level:?}: {us:.1} us, {curvo:.0} times curvo, {truck:.0} times truck");
        }
    }
    for ((level, least), us) in LEAST_US.iter().zip(&us[1..]) {
        let part = |least: f64| 100.0 * least / us[0];
        let (arithmetic, memory) = (part(*least), part(LEAST_MEMORY_US));
        println!(
            "f32 {level:?} is at {arithmetic:.0} % of the bound of its arithmetic, {memory:.0} % of that of memory"
        );
    }
    Ok(())
}

fn thousand() -> Result<(), NurbsError> {
    const COUNT: usize = 1000;
    let grids: Result<Vec<_>, _> = (0..COUNT).map(|k| Shape::new(k)?.lucerna(SimdLevel::Best)).collect();
    let mut grids = grids?;
    let nets: Vec<[f32; 3]> = grids.iter().flat_map(|grid| grid.points.clone()).collect();
    let weights: Vec<f32> = grids.iter().flat_map(|grid| grid.weights.clone()).collect();
    let plan = grids[0].plan.clone();
    let mut meshes = vec![[0.0_f32; 8]; COUNT * SAMPLES * SAMPLES];
    let mut single = f64::INFINITY;
    let mut pools = [1, 2].map(|threads| {
        let scratches: Vec<_> = (0..4 * threads).map(|_| plan.scratch()).collect();
        (rayon::ThreadPoolBuilder::new().num_threads(threads).build(), scratches, f64::INFINITY)
    });
    for _ in 0..30 {
        shorten(&mut single, 200, || drop(black_box(grids[0].run())));
        for (pool, scratches, us) in &mut pools {
            if let Ok(pool) = pool {
                let meshes = &mut meshes;
                pool.install(|| {
                    shorten(us, 1, || {
                        drop(black_box(plan.evaluate_many(&nets, Some(&weights), scratches, &mut meshes[..])));
                    });
                });
            }
        }
    }
    let [one, two] = [pools[0].2, pools[1].2].map(|us| us / COUNT as f64);
    println!("\n{COUNT} different surfaces: {one:.2} us each on one thread, {two:.2} us on two");
    println!("{:.2} times the {single:.2} us of one alone; {:.2} times faster on two threads", one / single, one / two);
    Ok(())
}
