//! What changes temperature and velocity in place: heat, cooling, buoyancy, accelerations, sides.

mod heat;
mod push;

use crate::field::Field;
use crate::grid::Grid;
use crate::limits::MAX_SPEED_M_S;
use crate::parallel::for_planes;
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
