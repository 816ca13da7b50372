//! Projection: the part of the velocity that is free of divergence (or has the prescribed one).

mod basis;
mod direct;
mod gauss_seidel;
mod gemm;
mod operators;

use serde::{Deserialize, Serialize};

use crate::field::Field;
use crate::grid::Grid;
use crate::lanes::{max_abs, sum, sum_squares};
use crate::limits::MAX_SPEED_M_S;
use crate::parallel::{Partial, reduce_planes};
use direct::DirectSolver;
pub(crate) use operators::divergence_plane;
use operators::{speeds, subtract_gradient};

/// How the pressure is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PressureSolver {
    /// Exactly, by eigenvectors of the box: the default, and at these sizes the fastest too.
    #[default]
    Direct,
    /// By sweeps over the cells, for comparison with the classic method: most of the large-scale
    /// divergence stays. Runs on one thread.
    GaussSeidel {
        /// Number of sweeps, 1 to 10000; 20 is what is commonly used.
        sweeps: u32,
    },
}

/// What the projection found and left.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Projected {
    pub(crate) residual: f32,
    pub(crate) max_before: f32,
    pub(crate) max_after: f32,
    pub(crate) speed_before: f32,
    /// Greatest speed through a face, by axis.
    pub(crate) speeds: [f32; 3],
}

/// The solver with its arrays.
pub(crate) struct Projection {
    method: PressureSolver,
    direct: Option<DirectSolver>,
    /// Velocity potential, m²/s: pressure times dt over density.
    pub(crate) potential: Vec<f32>,
    divergence: Vec<f32>,
    partials: Vec<Partial>,
}

impl Projection {
    pub(crate) fn new(grid: &Grid, method: PressureSolver) -> Self {
        Self {
            method,
            direct: (method == PressureSolver::Direct).then(|| DirectSolver::new(grid)),
            potential: vec![0.0; grid.count()],
            divergence: vec![0.0; grid.count()],
            partials: vec![Partial::default(); grid.cells[2] + 1],
        }
    }

    /// Subtracts the gradient that makes `div velocity = expansion`. In a sealed box the mean of
    /// the expansion is left out: nothing can get away.
    pub(crate) fn project(&mut self, grid: &Grid, velocity: &mut [Field; 3], expansion: Option<&[f32]>) -> Projected {
        let speed_before = speeds(grid, velocity, &mut self.partials).into_iter().fold(0.0, f32::max);
        let mut before = self.measure(grid, velocity, expansion, 0.0);
        let mut mean = 0.0;
        if grid.is_sealed() {
            mean = (before.sum / grid.count() as f64) as f32;
            before = self.measure(grid, velocity, expansion, mean);
        }
        match (&self.direct, self.method) {
            (None, PressureSolver::GaussSeidel { sweeps }) => {
                gauss_seidel::solve(grid, &self.divergence, &mut self.potential, sweeps);
            }
            (Some(direct), _) => {
                direct.solve(grid, &mut self.divergence, &mut self.potential);
                std::mem::swap(&mut self.divergence, &mut self.potential);
            }
            (None, PressureSolver::Direct) => {}
        }
        subtract_gradient(grid, &self.potential, velocity);
        let mut speeds = speeds(grid, velocity, &mut self.partials);
        let fastest = speeds.into_iter().fold(0.0, f32::max);
        if fastest > MAX_SPEED_M_S {
            let scale = MAX_SPEED_M_S / fastest;
            velocity.iter_mut().flat_map(|field| &mut field.data).for_each(|value| *value *= scale);
            speeds = speeds.map(|speed| speed * scale);
        }
        let after = self.measure(grid, velocity, expansion, mean);
        let residual = if before.squares > 0.0 { (after.squares / before.squares).sqrt() as f32 } else { 0.0 };
        Projected { residual, max_before: before.max, max_after: after.max, speed_before, speeds }
    }

    /// Fills `divergence` with `div velocity - expansion - mean`; returns its sums and maximum.
    fn measure(&mut self, grid: &Grid, velocity: &[Field; 3], expansion: Option<&[f32]>, mean: f32) -> Partial {
        let plane = grid.plane();
        reduce_planes(grid.is_parallel, &mut self.divergence, plane, &mut self.partials, |k, out| {
            divergence_plane(grid, velocity, k, out);
            if let Some(expansion) = expansion {
                let rates = &expansion[k * plane..(k + 1) * plane];
                out.iter_mut().zip(rates).for_each(|(value, rate)| *value -= rate);
            }
            if mean != 0.0 {
                out.iter_mut().for_each(|value| *value -= mean);
            }
            Partial { sum: sum(out), squares: sum_squares(out), max: max_abs(out) }
        })
    }
}
