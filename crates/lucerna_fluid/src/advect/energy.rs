//! The bound on energy.

use crate::field::Field;
use crate::grid::Grid;
use crate::lanes::sum_squares;
use crate::parallel::{Partial, for_planes, reduce};

/// Sum of the squared face velocities, those on the sides of the box counted half.
pub(crate) fn energy(grid: &Grid, velocity: &[Field; 3], partials: &mut [Partial]) -> f64 {
    let mut total = 0.0;
    for (axis, field) in velocity.iter().enumerate() {
        total += reduce(
            grid.exec,
            &mut partials[..field.counts[2]],
            #[inline(always)]
            |k| Partial { sum: energy_plane(field, axis, k), ..Partial::default() },
        )
        .sum;
    }
    total
}

/// The part of plane `k` of the component `axis` in [`energy`].
#[inline(always)]
pub(crate) fn energy_plane(field: &Field, axis: usize, k: usize) -> f64 {
    let [nx, ny, nz] = field.counts;
    let plane = nx * ny;
    let values = &field.data[k * plane..(k + 1) * plane];
    let mut sum = sum_squares(values);
    match axis {
        0 => {
            for row in values.chunks_exact(nx) {
                sum -= 0.5 * f64::from(row[0] * row[0] + row[nx - 1] * row[nx - 1]);
            }
        }
        1 => sum -= 0.5 * (sum_squares(&values[..nx]) + sum_squares(&values[plane - nx..])),
        _ if k == 0 || k + 1 == nz => sum *= 0.5,
        _ => {}
    }
    sum
}

/// Scales the velocity down where advection has made energy out of nothing: a flow free of
/// divergence only moves it about, but long steps sample the same air more than once.
pub(crate) fn limit_energy(grid: &Grid, velocity: &mut [Field; 3], allowed: f64, partials: &mut [Partial]) {
    let found = energy(grid, velocity, partials);
    if found > allowed * (1.0 + 1.0e-6) {
        let scale = (allowed / found).sqrt() as f32;
        for field in velocity {
            let plane = field.plane();
            for_planes(
                grid.exec,
                &mut field.data,
                plane,
                #[inline(always)]
                |_, out| {
                    out.iter_mut().for_each(|value| *value *= scale);
                },
            );
        }
    }
}
