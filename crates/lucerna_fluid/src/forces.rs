//! What changes temperature and velocity in place: heat, cooling, buoyancy, accelerations,
//! sides, and the bound on energy.

mod heat;
mod push;

use crate::field::Field;
use crate::grid::Grid;
use crate::lanes::sum_squares;
use crate::limits::MAX_SPEED_M_S;
use crate::parallel::{Partial, for_planes, reduce};
use crate::sides::Side;
pub(crate) use heat::heat_and_cool;
pub(crate) use push::{accelerate, buoyancy};

/// Clamps each face velocity to the greatest speed.
pub(crate) fn clamp_speed(grid: &Grid, field: &mut Field) {
    let plane = field.plane();
    for_planes(
        grid.exec,
        &mut field.data,
        plane,
        #[inline(always)]
        |_, out| {
            out.iter_mut().for_each(|value| *value = value.clamp(-MAX_SPEED_M_S, MAX_SPEED_M_S));
        },
    );
}

/// Calls `change` for every face value on one side of the box.
fn for_side(field: &mut Field, axis: usize, end: usize, mut change: impl FnMut(&mut f32)) {
    let [nx, ny, nz] = field.counts;
    let last = if end == 0 { 0 } else { field.counts[axis] - 1 };
    match axis {
        0 => field.data.chunks_exact_mut(nx).for_each(|row| change(&mut row[last])),
        1 => (0..nz).for_each(|k| field.data[nx * (last + ny * k)..][..nx].iter_mut().for_each(&mut change)),
        _ => field.data[nx * ny * last..][..nx * ny].iter_mut().for_each(change),
    }
}

/// Sets the faces whose flow is given: zero on walls, the wind on inflow sides.
pub(crate) fn fix_sides(grid: &Grid, velocity: &mut [Field; 3], wind: [f32; 3]) {
    for (axis, field) in velocity.iter_mut().enumerate() {
        for end in 0..2 {
            match grid.sides[axis][end] {
                Side::FreeSlip | Side::NoSlip => for_side(field, axis, end, |value| *value = 0.0),
                Side::Inflow => for_side(field, axis, end, |value| *value = wind[axis]),
                Side::Open | Side::Periodic => {}
            }
        }
    }
}

/// The wind's ram pressure on open sides that it blows into: the first face follows it within
/// the time in which it crosses a cell, and so the box within the time in which it crosses the box.
pub(crate) fn push_wind(grid: &Grid, velocity: &mut [Field; 3], wind: [f32; 3], dt_s: f32) {
    for (axis, field) in velocity.iter_mut().enumerate() {
        let share = 1.0 - (-wind[axis].abs() * dt_s / grid.cell_m[axis]).exp();
        for (end, blows_in) in [wind[axis] > 0.0, wind[axis] < 0.0].into_iter().enumerate() {
            if blows_in && grid.sides[axis][end] == Side::Open {
                for_side(field, axis, end, |value| *value += share * (wind[axis] - *value));
            }
        }
    }
}

/// Sum of the squared face velocities, those on the sides of the box counted half.
pub(crate) fn energy(grid: &Grid, velocity: &[Field; 3], partials: &mut [Partial]) -> f64 {
    let mut total = 0.0;
    for (axis, field) in velocity.iter().enumerate() {
        let [nx, ny, nz] = field.counts;
        let plane = nx * ny;
        let squares = |k: usize| {
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
            Partial { sum, ..Partial::default() }
        };
        total += reduce(grid.exec, &mut partials[..nz], squares).sum;
    }
    total
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
