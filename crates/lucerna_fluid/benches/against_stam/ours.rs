//! Steps of this crate's solver.

use std::time::Instant;

use lucerna_fluid::{
    Advection, Fluid, FluidBatch, FluidBuilder, PressureSolver, ScalarAdvection, Side, Sides, StageTimes, Trace, Vec3,
};

use crate::bounds::{Carrying, Counts};

/// One way to run the solver.
pub(crate) struct Variant {
    pub(crate) name: &'static str,
    pub(crate) set: fn(FluidBuilder) -> FluidBuilder,
    /// What a step has to do at least.
    pub(crate) counts: fn(usize) -> Counts,
}

const EULER: fn(FluidBuilder) -> FluidBuilder = |builder| {
    let builder = builder.advection(Advection::SemiLagrangian).scalar_advection(ScalarAdvection::SemiLagrangian);
    builder.trace(Trace::Euler)
};

pub(crate) const VARIANTS: &[Variant] = &[
    Variant {
        name: "semi-Lagrangian, Euler trace",
        set: EULER,
        counts: |n| Counts::step(n, Carrying::Linear, Carrying::Linear, 1),
    },
    Variant {
        name: "semi-Lagrangian, midpoint trace",
        set: |builder| EULER(builder).trace(Trace::Midpoint),
        counts: |n| Counts::step(n, Carrying::Linear, Carrying::Linear, 2),
    },
    Variant {
        name: "MacCormack",
        set: |builder| builder.advection(Advection::MacCormack).scalar_advection(ScalarAdvection::MacCormack),
        counts: |n| Counts::step(n, Carrying::MacCormack, Carrying::MacCormack, 2),
    },
    Variant {
        name: "MacCormack, flux (default)",
        set: |builder| builder,
        counts: |n| Counts::step(n, Carrying::MacCormack, Carrying::Flux, 2),
    },
    Variant {
        name: "reflection, flux",
        set: |builder| builder.advection(Advection::Reflection),
        counts: |n| Counts::reflection(n, Carrying::Flux),
    },
    Variant {
        name: "cubic",
        set: |builder| builder.advection(Advection::Cubic).scalar_advection(ScalarAdvection::Cubic),
        counts: |n| Counts::step(n, Carrying::Cubic, Carrying::Cubic, 2),
    },
    Variant {
        name: "Euler trace, 20 sweeps",
        set: |builder| EULER(builder).pressure(PressureSolver::GaussSeidel { sweeps: 20 }),
        counts: |_| Counts::step_with_sweeps(20, Carrying::Linear, Carrying::Linear, 1),
    },
];

/// The fastest step of a run.
#[derive(Clone, Copy)]
pub(crate) struct Fastest {
    pub(crate) ms: f64,
    pub(crate) times: StageTimes,
    pub(crate) divergence: f32,
}

impl Fastest {
    pub(crate) const NONE: Self = Self {
        ms: f64::MAX,
        times: StageTimes { advection_ms: 0.0, forces_ms: 0.0, viscosity_ms: 0.0, pressure_ms: 0.0, report_ms: 0.0 },
        divergence: 0.0,
    };

    pub(crate) fn or(self, other: Self) -> Self {
        if other.ms < self.ms { other } else { self }
    }
}

/// A box of `n` cells an axis with a floor, otherwise open, and a hot spot above the floor.
fn plume(n: usize, set: fn(FluidBuilder) -> FluidBuilder) -> Fluid {
    let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
    set(Fluid::builder([n; 3]).sides(sides)).build().expect("a small box")
}

/// Runs `steps` steps of a plume on `threads` threads.
pub(crate) fn run(n: usize, steps: usize, threads: usize, set: fn(FluidBuilder) -> FluidBuilder) -> Fastest {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a few threads");
    pool.install(|| {
        let mut fluid = plume(n, set);
        let mut fastest = Fastest::NONE;
        for _ in 0..steps {
            fluid.add_heat(Vec3::new(0.5, 0.1, 0.5), 0.12, 2000.0).expect("finite heat");
            let start = Instant::now();
            let report = fluid.step(1.0 / 60.0).expect("a valid step");
            let ms = start.elapsed().as_secs_f64() * 1.0e3;
            fastest = fastest.or(Fastest { ms, times: report.times, divergence: report.divergence_after });
        }
        fastest
    })
}

/// Steps a batch of `boxes` small plumes; returns steps of a box per millisecond and thread.
pub(crate) fn run_batch(boxes: usize, steps: usize, threads: usize, set: fn(FluidBuilder) -> FluidBuilder) -> f64 {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a few threads");
    pool.install(|| {
        let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
        let builder = set(Fluid::builder([15; 3]).sides(sides));
        let mut batch: FluidBatch = builder.build_batch(boxes).expect("small boxes");
        let mut best = f64::MAX;
        for _ in 0..steps {
            batch.for_each(|_, fluid| fluid.add_heat(Vec3::new(0.5, 0.1, 0.5), 0.12, 2000.0).expect("finite heat"));
            let start = Instant::now();
            batch.step(1.0 / 60.0).expect("a valid step");
            best = best.min(start.elapsed().as_secs_f64() * 1.0e3);
        }
        boxes as f64 / best / threads as f64
    })
}
