//! The viscosity of eddies by what a filter takes out of the velocity: J. Deardorff, Boundary-Layer
//! Meteorology 18 (1980), with the energy of small eddies found algebraically as in the FDS Technical
//! Reference Guide (NIST SP 1018-1, section on the turbulent viscosity).
//!
//! `C w sqrt(k)`, w the width of a cell, `k = |u - û|² / 2` with the velocities at the centres and
//! their means over a cell and its neighbours, weighted 1, 2, 1 along each axis. A flow that
//! changes linearly has none of it.

use super::{Strain, width_m};
use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::slopes::{EMPTY_ROW, is_periodic, neighbours, pad};

impl Strain {
    /// Fills the viscosity.
    pub(crate) fn become_deardorff(&mut self, grid: &Grid, velocity: &[Field; 3], constant: f32) {
        let by = constant * width_m(grid) * 0.5_f32.sqrt();
        self.viscosity.resize(grid.count(), 0.0);
        for_planes(
            grid.exec,
            &mut self.viscosity,
            grid.plane(),
            #[inline(always)]
            |k, out| viscosity_plane(grid, velocity, by, k, out),
        );
    }
}

#[inline(always)]
fn viscosity_plane(grid: &Grid, velocity: &[Field; 3], by: f32, k: usize, out: &mut [f32]) {
    let nx = grid.cells[0];
    let wraps = is_periodic(grid, 0);
    let mut means = EMPTY_ROW;
    let means = &mut means[..nx + 2];
    let (k_low, k_high) = neighbours(grid, 2, k);
    for (j, out) in out.chunks_exact_mut(nx).enumerate() {
        let (j_low, j_high) = neighbours(grid, 1, j);
        out.fill(0.0);
        for (axis, field) in velocity.iter().enumerate() {
            let [fx, fy, _] = field.counts;
            let stride = [1, fx, fx * fy][axis];
            // Velocities through the faces below and above the cells of a row.
            let faces = |j: usize, k: usize| {
                let row = &field.data[fx * (j + fy * k)..];
                (&row[..nx], &row[stride..stride + nx])
            };
            means.fill(0.0);
            for (k, weight_z) in [(k_low, 0.25), (k, 0.5), (k_high, 0.25)] {
                for (j, weight_y) in [(j_low, 0.25), (j, 0.5), (j_high, 0.25)] {
                    let weight = 0.5 * weight_z * weight_y;
                    let (low, high) = faces(j, k);
                    for i in 0..nx {
                        means[i + 1] += weight * (low[i] + high[i]);
                    }
                }
            }
            pad(means, wraps);
            let (low, high) = faces(j, k);
            for i in 0..nx {
                let mean = 0.5 * means[i + 1] + 0.25 * (means[i] + means[i + 2]);
                let off = 0.5 * (low[i] + high[i]) - mean;
                out[i] += off * off;
            }
        }
        out.iter_mut().for_each(|value| *value = by * value.sqrt());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sides::Side;
    use glam::Vec3;

    /// The viscosity in a plane in which the velocity along y changes with x only.
    fn viscosity(of: impl Fn(f32) -> f32) -> Vec<f32> {
        let grid = Grid::new([16, 4, 4], Vec3::ZERO, Vec3::new(1.6, 0.4, 0.4), [[Side::Periodic; 2]; 3]);
        let mut velocity = [0, 1, 2].map(|axis| Field::on_faces(&grid, axis));
        for (at, value) in velocity[1].data.iter_mut().enumerate() {
            *value = of((at % 16) as f32);
        }
        let mut strain = Strain::default();
        strain.become_deardorff(&grid, &velocity, 0.1);
        strain.viscosity[..16].to_vec()
    }

    #[test]
    fn only_what_the_filter_takes_out_makes_eddies() {
        for value in &viscosity(|x| 0.3 * x)[1..15] {
            assert!(value.abs() < 1.0e-6, "a linear flow has {value}");
        }
        // Of a wave over four cells the filter leaves half.
        let wave = |x: f32| (std::f32::consts::FRAC_PI_2 * x).sin();
        for (x, value) in viscosity(wave).iter().enumerate() {
            let expected = 0.1 * 0.1 * (0.5 * 0.25_f32).sqrt() * wave(x as f32).abs();
            assert!((value - expected).abs() < 1.0e-6, "{value} against {expected}");
        }
    }
}
