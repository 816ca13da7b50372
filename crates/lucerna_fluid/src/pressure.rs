//! Projection: the part of the velocity that is free of divergence (or has the prescribed one).

mod basis;
mod direct;
mod gauss_seidel;
mod gemm;

use serde::{Deserialize, Serialize};

use crate::field::Field;
use crate::grid::Grid;
use crate::lanes::{max_abs, sum, sum_squares};
use crate::limits::MAX_SPEED_M_S;
use crate::parallel::{Partial, for_planes, reduce, reduce_planes};
use direct::DirectSolver;

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
        self.subtract_gradient(grid, velocity);
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

    /// Subtracts the gradient of the potential on every face whose flow is not fixed.
    fn subtract_gradient(&self, grid: &Grid, velocity: &mut [Field; 3]) {
        let [nx, ny, nz] = grid.cells;
        let plane = nx * ny;
        let inverse = grid.cell_m.map(|edge| 1.0 / edge);
        let potential = &self.potential;
        let is_open = grid.sides.map(|sides| sides.map(|side| !side.fixes_flow()));
        let [u, v, w] = velocity;
        for_planes(grid.is_parallel, &mut u.data, (nx + 1) * ny, |k, out| {
            let rows = potential[k * plane..(k + 1) * plane].chunks_exact(nx);
            for (out, row) in out.chunks_exact_mut(nx + 1).zip(rows) {
                for (value, pair) in out[1..nx].iter_mut().zip(row.windows(2)) {
                    *value -= (pair[1] - pair[0]) * inverse[0];
                }
                if is_open[0][0] {
                    out[0] -= 2.0 * row[0] * inverse[0];
                }
                if is_open[0][1] {
                    out[nx] += 2.0 * row[nx - 1] * inverse[0];
                }
            }
        });
        for_planes(grid.is_parallel, &mut v.data, nx * (ny + 1), |k, out| {
            let values = &potential[k * plane..(k + 1) * plane];
            let row = |j: usize| &values[j * nx..(j + 1) * nx];
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let (low, high) = (row(j.saturating_sub(1)), row(j.min(ny - 1)));
                subtract_row(out, low, high, inverse[1], j, ny, is_open[1]);
            }
        });
        for_planes(grid.is_parallel, &mut w.data, plane, |k, out| {
            let values = |k: usize| &potential[k * plane..(k + 1) * plane];
            let (low, high) = (values(k.saturating_sub(1)), values(k.min(nz - 1)));
            subtract_row(out, low, high, inverse[2], k, nz, is_open[2]);
        });
    }
}

/// Subtracts the gradient across the faces number `index` of an axis with `count` cells.
fn subtract_row(
    out: &mut [f32],
    low: &[f32],
    high: &[f32],
    inverse_m: f32,
    index: usize,
    count: usize,
    is_open: [bool; 2],
) {
    if index == 0 && is_open[0] {
        out.iter_mut().zip(high).for_each(|(value, high)| *value -= 2.0 * high * inverse_m);
    } else if index == count && is_open[1] {
        out.iter_mut().zip(low).for_each(|(value, low)| *value += 2.0 * low * inverse_m);
    } else if index > 0 && index < count {
        for ((value, low), high) in out.iter_mut().zip(low).zip(high) {
            *value -= (high - low) * inverse_m;
        }
    }
}

/// Divergence of a z-plane of cells, 1/s.
pub(crate) fn divergence_plane(grid: &Grid, velocity: &[Field; 3], k: usize, out: &mut [f32]) {
    let [nx, ny, _] = grid.cells;
    let plane = nx * ny;
    let inverse = grid.cell_m.map(|edge| 1.0 / edge);
    let [u, v, w] = velocity;
    let u_plane = &u.data[k * (nx + 1) * ny..];
    let v_plane = &v.data[k * nx * (ny + 1)..];
    for (j, out) in out.chunks_exact_mut(nx).enumerate() {
        let u_row = &u_plane[j * (nx + 1)..(j + 1) * (nx + 1)];
        let (v_low, v_high) = (&v_plane[j * nx..(j + 1) * nx], &v_plane[(j + 1) * nx..(j + 2) * nx]);
        let at = k * plane + j * nx;
        let (w_low, w_high) = (&w.data[at..at + nx], &w.data[at + plane..at + plane + nx]);
        let (u_low, u_high) = (&u_row[..nx], &u_row[1..]);
        for i in 0..nx {
            out[i] = (u_high[i] - u_low[i]) * inverse[0]
                + (v_high[i] - v_low[i]) * inverse[1]
                + (w_high[i] - w_low[i]) * inverse[2];
        }
    }
}

/// Greatest speed through a face, by axis, m/s.
pub(crate) fn speeds(grid: &Grid, velocity: &[Field; 3], partials: &mut [Partial]) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let field = &velocity[axis];
        let plane = field.plane();
        let largest = |k| Partial { max: max_abs(&field.data[k * plane..(k + 1) * plane]), ..Partial::default() };
        reduce(grid.is_parallel, &mut partials[..field.counts[2]], largest).max
    })
}
