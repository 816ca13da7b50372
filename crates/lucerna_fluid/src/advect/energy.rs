//! The bound on energy.

use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::{Partial, for_planes, scan_planes};

/// Sum of the squared face velocities, those on the sides of the box counted half.
pub(crate) fn energy(grid: &Grid, velocity: &[Field; 3], partials: &mut [Partial]) -> f64 {
    let mut total = 0.0;
    for (axis, field) in velocity.iter().enumerate() {
        let squares = scan_planes(grid.exec, &field.data, field.plane(), partials).squares;
        total += squares - 0.5 * side_squares(field, axis);
    }
    total
}

/// Sum of the squares of a component's first and last values along its own axis.
pub(crate) fn side_squares(field: &Field, axis: usize) -> f64 {
    let [nx, ny, _] = field.counts;
    let plane = nx * ny;
    let squares = |values: &[f32]| values.iter().map(|value| f64::from(value * value)).sum::<f64>();
    match axis {
        0 => field.data.chunks_exact(nx).map(|row| f64::from(row[0] * row[0] + row[nx - 1] * row[nx - 1])).sum(),
        1 => field
            .data
            .chunks_exact(plane)
            .map(|plane| squares(&plane[..nx]) + squares(&plane[plane.len() - nx..]))
            .sum(),
        _ => squares(&field.data[..plane]) + squares(&field.data[field.data.len() - plane..]),
    }
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
