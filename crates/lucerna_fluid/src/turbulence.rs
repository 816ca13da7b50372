//! What eddies too small for the grid do: J. Smagorinsky, *General Circulation Experiments with
//! the Primitive Equations*, Monthly Weather Review 91 (1963).
//!
//! They act on larger ones as a viscosity `(C_s w)² |S|`, w the width of a cell and
//! `|S| = sqrt(2 S_ij S_ij)` with the rate of strain S. The diagonal of S is exact on this grid;
//! the rest comes from central differences of the velocities at the centres.

mod deardorff;

use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::physics::Physics;

use crate::slopes::{EMPTY_ROW, is_periodic, neighbours, pad, per_m};

/// Arrays for the rate of strain; empty until first used.
#[derive(Clone, Debug, Default)]
pub(crate) struct Strain {
    /// `|S|` by cell, 1/s.
    values: Vec<f32>,
    /// Viscosity (or diffusivity) of eddies by cell, m²/s.
    pub(crate) viscosity: Vec<f32>,
    per_m: [Vec<f32>; 3],
}

impl Strain {
    /// Fills the values with `|S|` of a velocity whose sides are set.
    fn measure(&mut self, grid: &Grid, velocity: &[Field; 3]) {
        if self.values.len() != grid.count() {
            self.values = vec![0.0; grid.count()];
            self.per_m = per_m(grid);
        }
        let per_m = &self.per_m;
        for_planes(
            grid.exec,
            &mut self.values,
            grid.plane(),
            #[inline(always)]
            |k, out| strain_plane(grid, velocity, per_m, k, out),
        );
    }

    /// Fills the viscosity with that of the model that is chosen; without one by Smagorinsky's with `otherwise`.
    pub(crate) fn find_eddies(&mut self, grid: &Grid, velocity: &[Field; 3], physics: &Physics, otherwise: f32) {
        if physics.deardorff > 0.0 {
            self.become_deardorff(grid, velocity, physics.deardorff);
            return;
        }
        self.measure(grid, velocity);
        let constant = if physics.smagorinsky > 0.0 { physics.smagorinsky } else { otherwise };
        self.become_viscosity(grid, constant);
    }

    /// Makes the eddy viscosity out of the rate of strain.
    fn become_viscosity(&mut self, grid: &Grid, smagorinsky: f32) {
        let width = smagorinsky * width_m(grid);
        let (plane, by) = (grid.plane(), width * width);
        self.viscosity.resize(grid.count(), 0.0);
        let strain = &self.values;
        for_planes(
            grid.exec,
            &mut self.viscosity,
            plane,
            #[inline(always)]
            |k, out| out.iter_mut().zip(&strain[k * plane..]).for_each(|(value, strain)| *value = by * strain),
        );
    }

    /// Multiplies the viscosity.
    pub(crate) fn scale(&mut self, grid: &Grid, factor: f32) {
        for_planes(
            grid.exec,
            &mut self.viscosity,
            grid.plane(),
            #[inline(always)]
            |_, out| out.iter_mut().for_each(|value| *value *= factor),
        );
    }
}

/// Width of a cell, m: the cube root of its volume; in a flow in a plane, the square root of its
/// area there.
pub(crate) fn width_m(grid: &Grid) -> f32 {
    let edges = (0..3).filter(|axis| grid.cells[*axis] > 1);
    let count = edges.clone().count();
    edges.map(|axis| f64::from(grid.cell_m[axis])).product::<f64>().powf(1.0 / count as f64) as f32
}

#[inline(always)]
fn strain_plane(grid: &Grid, [u, v, w]: &[Field; 3], per_m: &[Vec<f32>; 3], k: usize, out: &mut [f32]) {
    let [nx, ny, _] = grid.cells;
    let plane = grid.plane();
    let wraps = is_periodic(grid, 0);
    let (k_low, k_high) = neighbours(grid, 2, k);
    let (mut v_row, mut w_row) = (EMPTY_ROW, EMPTY_ROW);
    let (v_row, w_row) = (&mut v_row[..nx + 2], &mut w_row[..nx + 2]);
    let u_at = |j: usize, k: usize| &u.data[(nx + 1) * (j + ny * k)..][..nx + 1];
    let v_at = |j: usize, k: usize| v.data[nx * (j + (ny + 1) * k)..][..2 * nx].split_at(nx);
    let w_at = |j: usize, k: usize| (&w.data[nx * j + plane * k..][..nx], &w.data[nx * j + plane * (k + 1)..][..nx]);
    let per_x = &per_m[0][..nx];
    let inverse = grid.cell_m.map(|edge| 1.0 / edge);
    // Sums of two faces are twice the value at the centre.
    let per_z = 0.5 * per_m[2][k];
    for (j, (per_y, out)) in per_m[1].iter().zip(out.chunks_exact_mut(nx)).enumerate() {
        let (j_low, j_high) = neighbours(grid, 1, j);
        let per_y = 0.5 * per_y;
        let u_row = u_at(j, k);
        let (v_low, v_high) = v_at(j, k);
        let (w_low, w_high) = w_at(j, k);
        for i in 0..nx {
            v_row[i + 1] = v_low[i] + v_high[i];
            w_row[i + 1] = w_low[i] + w_high[i];
        }
        pad(v_row, wraps);
        pad(w_row, wraps);
        let ((wa, wb), (wc, wd)) = (w_at(j_low, k), w_at(j_high, k));
        let ((va, vb), (vc, vd)) = (v_at(j, k_low), v_at(j, k_high));
        let (uy_low, uy_high, uz_low, uz_high) = (u_at(j_low, k), u_at(j_high, k), u_at(j, k_low), u_at(j, k_high));
        for i in 0..nx {
            let xx = (u_row[i + 1] - u_row[i]) * inverse[0];
            let yy = (v_high[i] - v_low[i]) * inverse[1];
            let zz = (w_high[i] - w_low[i]) * inverse[2];
            let dw_dy = ((wc[i] + wd[i]) - (wa[i] + wb[i])) * per_y;
            let dv_dz = ((vc[i] + vd[i]) - (va[i] + vb[i])) * per_z;
            let du_dz = ((uz_high[i] + uz_high[i + 1]) - (uz_low[i] + uz_low[i + 1])) * per_z;
            let dw_dx = (w_row[i + 2] - w_row[i]) * (0.5 * per_x[i]);
            let dv_dx = (v_row[i + 2] - v_row[i]) * (0.5 * per_x[i]);
            let du_dy = ((uy_high[i] + uy_high[i + 1]) - (uy_low[i] + uy_low[i + 1])) * per_y;
            let (yz, zx, xy) = (dw_dy + dv_dz, du_dz + dw_dx, dv_dx + du_dy);
            out[i] = (2.0 * (xx * xx + yy * yy + zz * zz) + (yz * yz + zx * zx + xy * xy)).sqrt();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn linear_flows_have_the_strain_of_the_books() {
        let sides = [[crate::sides::Side::Open; 2]; 3];
        let grid = Grid::new([6, 7, 8], Vec3::ZERO, Vec3::new(0.6, 0.35, 1.6), sides);
        // Rows of the velocity's gradient: plain shear, pure turning, straining, all together.
        let shear = [[0.0, 3.0, 0.0], [0.0; 3], [0.0; 3]];
        let turn = [[0.0, -2.0, 0.0], [2.0, 0.0, 0.0], [0.0; 3]];
        let strain = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -2.0]];
        let mixed = [[1.0, 0.5, -2.0], [0.3, -1.5, 0.7], [2.2, -0.1, 0.5]];
        for (gradient, expected) in [(shear, 3.0), (turn, 0.0), (strain, 12.0_f32.sqrt()), (mixed, f32::NAN)] {
            let velocity = [0, 1, 2].map(|axis| {
                let mut field = Field::on_faces(&grid, axis);
                let [nx, ny, _] = field.counts;
                for (at, value) in field.data.iter_mut().enumerate() {
                    let index = [at % nx, at / nx % ny, at / (nx * ny)];
                    let place = |along: usize| (index[along] as f32 + field.offset[along]) * grid.cell_m[along];
                    *value = (0..3).map(|along| gradient[axis][along] * place(along)).sum();
                }
                field
            });
            let pairs = (0..9).map(|at| (at / 3, at % 3));
            let squares: f32 = pairs.map(|(i, j)| 0.5 * (gradient[i][j] + gradient[j][i]).powi(2)).sum();
            let expected = if expected.is_nan() { squares.sqrt() } else { expected };
            let mut measured = Strain::default();
            measured.measure(&grid, &velocity);
            for value in &measured.values {
                assert!((value - expected).abs() < 1.0e-4, "{value} against {expected}");
            }
            measured.become_viscosity(&grid, 0.2);
            let width = (0.1_f32 * 0.05 * 0.2).cbrt();
            assert!((measured.viscosity[7] - 0.04 * width * width * expected).abs() < 1.0e-6);
        }
    }
}
