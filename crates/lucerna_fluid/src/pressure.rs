//! Projection: the part of the velocity that is free of divergence (or has the prescribed one).

mod along_x;
mod along_y;
mod along_z;
mod basis;
mod conjugate;
mod direct;
mod figures;
mod gauss_seidel;
mod lines;
mod mask;
mod operators;
mod poisson;
mod regions;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::field::Field;
use crate::grid::Grid;
use crate::limits::MAX_SPEED_M_S;
use direct::DirectSolver;
use figures::{Figures, measure, measure_divergence};
use lines::Lanes;
pub(crate) use mask::Mask;
use operators::subtract_gradient;
pub(crate) use operators::{divergence_plane, slices, speeds};
pub use poisson::PoissonSolver;

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
    pub(crate) iterations: u32,
    /// Greatest divergence, 1/s.
    pub(crate) max_before: f32,
    pub(crate) max_after: f32,
    /// Root mean square divergence over the cells of air, 1/s.
    pub(crate) rms_before: f32,
    pub(crate) rms_after: f32,
    /// Root mean square speeds, m/s.
    pub(crate) rms_speed_before: f32,
    pub(crate) rms_speed: f32,
    pub(crate) speed_before: f32,
    /// Greatest speed through a face, by axis.
    pub(crate) speeds: [f32; 3],
}

/// Root mean square divergence, times the shortest edge of a cell, over the root mean square
/// speed, that conjugate gradients stop at; half of it is rounding.
const TOLERANCE: f64 = 5.0e-6;

/// What a solver computes once for a grid.
pub(crate) struct Tables(Method);

enum Method {
    Direct(DirectSolver),
    /// The mask of a box without obstacles.
    GaussSeidel {
        empty: Mask,
        sweeps: u32,
    },
}

impl Tables {
    pub(crate) fn new(grid: &Grid, method: PressureSolver) -> Self {
        Self(match method {
            PressureSolver::Direct => Method::Direct(DirectSolver::new(grid)),
            PressureSolver::GaussSeidel { sweeps } => Method::GaussSeidel { empty: Mask::new(grid, &[]), sweeps },
        })
    }
}

/// Arrays that a projection works in.
pub(crate) struct Spare {
    divergence: Vec<f32>,
    modes: Vec<Lanes>,
    /// One a plane of cells.
    figures: Vec<Figures>,
    conjugate: conjugate::Spare,
}

impl Spare {
    pub(crate) fn new(grid: &Grid) -> Self {
        Self {
            divergence: vec![0.0; grid.count()],
            modes: direct::mode_space(grid),
            figures: vec![Figures::default(); grid.cells[2]],
            conjugate: conjugate::Spare::default(),
        }
    }
}

/// A projection about to be made.
pub(crate) struct Projection<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) tables: &'a Tables,
    /// Cells that obstacles fill. Faces beside them keep the velocity that they have.
    pub(crate) mask: Option<&'a Mask>,
    pub(crate) spare: &'a mut Spare,
}

impl Projection<'_> {
    /// Subtracts the gradient that makes `div velocity = expansion`. In a region without an open
    /// side the mean of what is missing is left out: nothing can get away. `potential` is the
    /// velocity potential, pressure times dt over density, m²/s.
    pub(crate) fn project(
        &mut self,
        velocity: &mut [Field; 3],
        expansion: Option<&[f32]>,
        potential: &mut [f32],
    ) -> Projected {
        let grid = self.grid;
        let mut before = self.measure(slices(velocity), expansion, 0.0);
        let mut mean = 0.0;
        let mask = match &self.tables.0 {
            Method::GaussSeidel { empty, .. } => Some(self.mask.unwrap_or(empty)),
            Method::Direct(_) => self.mask,
        };
        let cells = mask.map_or(grid.count(), Mask::fluid_cells).max(1) as f64;
        let fluid_rms = |figures: &Figures| (figures.squares / cells).sqrt();
        if let Some(mask) = mask {
            self.keep_fluid(mask, &mut before);
        } else if grid.is_sealed() {
            mean = before.sum / cells;
            // Taking it out of the sum of squares will do where it is small.
            if mean.powi(2) * cells > 1.0e-3 * before.squares {
                before = self.measure(slices(velocity), expansion, mean);
            } else {
                before.squares -= mean.powi(2) * cells;
                (before.low, before.high) = (before.low - mean as f32, before.high - mean as f32);
            }
        }
        let rms_speed_before = before.rms_speed(grid);
        let mut iterations = 0;
        let Spare { divergence, modes, conjugate, .. } = &mut *self.spare;
        match (&self.tables.0, mask) {
            (Method::GaussSeidel { sweeps, .. }, Some(mask)) => {
                gauss_seidel::solve(grid, mask, divergence, potential, *sweeps);
                iterations = *sweeps;
            }
            (Method::Direct(direct), Some(mask)) => {
                let tolerance = TOLERANCE * rms_speed_before / f64::from(grid.shortest_m());
                let problem = conjugate::Problem { grid, mask, direct, tolerance };
                iterations = conjugate::solve(&problem, divergence, potential, modes, conjugate);
            }
            (Method::Direct(direct), None) => {
                direct.analyze(grid, divergence, modes);
                direct.synthesize(grid, modes, potential);
            }
            (Method::GaussSeidel { .. }, None) => {}
        }
        subtract_gradient(grid, potential, mask, velocity.each_mut().map(|field| field.data.as_mut_slice()));
        let mut after = self.measure(slices(velocity), expansion, mean);
        let fastest = after.speeds.into_iter().fold(0.0, f32::max);
        if fastest > MAX_SPEED_M_S {
            let scale = MAX_SPEED_M_S / fastest;
            velocity.iter_mut().flat_map(|field| &mut field.data).for_each(|value| *value *= scale);
            after = self.measure(slices(velocity), expansion, mean);
        }
        if let Some(mask) = mask {
            self.keep_fluid(mask, &mut after);
        }
        let residual = if before.squares > 0.0 { (after.squares / before.squares).sqrt() as f32 } else { 0.0 };
        Projected {
            residual,
            iterations,
            max_before: before.greatest(),
            max_after: after.greatest(),
            rms_before: fluid_rms(&before) as f32,
            rms_after: fluid_rms(&after) as f32,
            rms_speed_before: rms_speed_before as f32,
            rms_speed: after.rms_speed(grid) as f32,
            speed_before: before.speeds.into_iter().fold(0.0, f32::max),
            speeds: after.speeds,
        }
    }

    /// Fills the divergence with `div velocity - expansion - mean`; measures it and the velocity.
    fn measure(&mut self, velocity: [&[f32]; 3], expansion: Option<&[f32]>, mean: f64) -> Figures {
        let Spare { divergence, figures, .. } = &mut *self.spare;
        measure(self.grid, velocity, expansion, mean, divergence, figures)
    }

    /// Clears the divergence of solid cells and the means of sealed regions; measures what is left.
    fn keep_fluid(&mut self, mask: &Mask, figures: &mut Figures) {
        let Spare { divergence, figures: planes, conjugate, .. } = &mut *self.spare;
        mask.clear_solid(self.grid, divergence);
        mask.regions().remove_means(self.grid, divergence, &mut conjugate.sums);
        let Figures { sum, squares, low, high, .. } = measure_divergence(self.grid, divergence, planes);
        *figures = Figures { sum, squares, low, high, ..*figures };
    }
}
