//! Projection: the part of the velocity that is free of divergence (or has the prescribed one).

mod basis;
mod direct;
mod gauss_seidel;
mod gemm;
#[allow(dead_code, reason = "obstacles make it")]
mod mask;
mod operators;
#[allow(dead_code, reason = "obstacles make it")]
mod regions;

use serde::{Deserialize, Serialize};

use crate::field::Field;
use crate::grid::Grid;
use crate::lanes::{max_abs, sum, sum_squares};
use crate::limits::MAX_SPEED_M_S;
use crate::parallel::{Partial, reduce_planes};
use direct::DirectSolver;
use operators::subtract_gradient;
pub(crate) use operators::{divergence_plane, speeds};

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

/// What a solver computes once for a grid.
pub(crate) struct Tables {
    direct: Option<DirectSolver>,
}

impl Tables {
    pub(crate) fn new(grid: &Grid, method: PressureSolver) -> Self {
        Self { direct: (method == PressureSolver::Direct).then(|| DirectSolver::new(grid)) }
    }
}

/// A projection about to be made.
pub(crate) struct Projection<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) method: PressureSolver,
    pub(crate) tables: &'a Tables,
    /// One value a cell, as `spare`.
    pub(crate) divergence: &'a mut [f32],
    pub(crate) spare: &'a mut [f32],
    /// One a plane of faces.
    pub(crate) partials: &'a mut [Partial],
}

impl Projection<'_> {
    /// Subtracts the gradient that makes `div velocity = expansion`. In a sealed box the mean of
    /// the expansion is left out: nothing can get away. `potential` is the velocity potential,
    /// pressure times dt over density, m²/s.
    pub(crate) fn project(
        &mut self,
        velocity: &mut [Field; 3],
        expansion: Option<&[f32]>,
        potential: &mut [f32],
    ) -> Projected {
        let grid = self.grid;
        let speed_before = speeds(grid, velocity, self.partials).into_iter().fold(0.0, f32::max);
        let mut before = self.measure(velocity, expansion, 0.0);
        let mut mean = 0.0;
        if grid.is_sealed() {
            mean = (before.sum / grid.count() as f64) as f32;
            before = self.measure(velocity, expansion, mean);
        }
        match (&self.tables.direct, self.method) {
            (None, PressureSolver::GaussSeidel { sweeps }) => {
                gauss_seidel::solve(grid, self.divergence, potential, sweeps);
            }
            (Some(direct), _) => {
                potential.copy_from_slice(self.divergence);
                direct.solve(grid, potential, self.spare);
            }
            (None, PressureSolver::Direct) => {}
        }
        subtract_gradient(grid, potential, velocity);
        let mut speeds = speeds(grid, velocity, self.partials);
        let fastest = speeds.into_iter().fold(0.0, f32::max);
        if fastest > MAX_SPEED_M_S {
            let scale = MAX_SPEED_M_S / fastest;
            velocity.iter_mut().flat_map(|field| &mut field.data).for_each(|value| *value *= scale);
            speeds = speeds.map(|speed| speed * scale);
        }
        let after = self.measure(velocity, expansion, mean);
        let residual = if before.squares > 0.0 { (after.squares / before.squares).sqrt() as f32 } else { 0.0 };
        Projected { residual, max_before: before.max, max_after: after.max, speed_before, speeds }
    }

    /// Fills `divergence` with `div velocity - expansion - mean`; returns its sums and maximum.
    fn measure(&mut self, velocity: &[Field; 3], expansion: Option<&[f32]>, mean: f32) -> Partial {
        let grid = self.grid;
        let plane = grid.plane();
        reduce_planes(
            grid.exec,
            self.divergence,
            plane,
            self.partials,
            #[inline(always)]
            |k, out| {
                divergence_plane(grid, velocity, k, out);
                if let Some(expansion) = expansion {
                    let rates = &expansion[k * plane..(k + 1) * plane];
                    out.iter_mut().zip(rates).for_each(|(value, rate)| *value -= rate);
                }
                if mean != 0.0 {
                    out.iter_mut().for_each(|value| *value -= mean);
                }
                Partial { sum: sum(out), squares: sum_squares(out), max: max_abs(out) }
            },
        )
    }
}
