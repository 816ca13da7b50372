//! The flow through sides where it is given, and the push of the wind on open ones.

use crate::field::Field;
use crate::grid::Grid;
use crate::sides::Side;
use crate::sides::given::{Wall, Walls};

/// Calls `change` with the number and the value of every face on one side of the box, counted
/// along the two other axes, the faster one first.
fn for_side(field: &mut Field, axis: usize, end: usize, mut change: impl FnMut(usize, &mut f32)) {
    let [nx, ny, nz] = field.counts;
    let last = if end == 0 { 0 } else { field.counts[axis] - 1 };
    match axis {
        0 => field.data.chunks_exact_mut(nx).enumerate().for_each(|(at, row)| change(at, &mut row[last])),
        1 => (0..nz).for_each(|k| {
            let row = &mut field.data[nx * (last + ny * k)..][..nx];
            row.iter_mut().enumerate().for_each(|(i, value)| change(i + nx * k, value));
        }),
        _ => field.data[nx * ny * last..][..nx * ny].iter_mut().enumerate().for_each(|(at, value)| change(at, value)),
    }
}

/// Sets the faces whose flow is given: walls move with the grid, inflow sides as they are told,
/// and the last face of a periodic axis is the first one again. Then those on and in solids.
///
/// Where no side is open, nothing can make up for inflow sides that do not balance: the same
/// small velocity is then added to all their faces, so that as much leaves as enters.
pub(crate) fn fix_sides(grid: &Grid, velocity: &mut [Field; 3], walls: Walls<'_>) {
    for (axis, field) in velocity.iter_mut().enumerate() {
        for end in 0..2 {
            if grid.sides[axis][end].fixes_flow() {
                match walls.at(grid, axis, end, axis) {
                    Wall::Same(given) => for_side(field, axis, end, |_, value| *value = given),
                    Wall::Each(given) => for_side(field, axis, end, |at, value| *value = given[at]),
                }
            }
        }
        if grid.sides[axis][0] == Side::Periodic {
            close_the_circle(field, axis);
        }
    }
    if let Some(solids) = walls.solids {
        solids.fix(velocity);
    }
    if grid.is_sealed() && walls.may_be_uneven() {
        balance(grid, velocity);
    }
}

/// Copies the first face of an axis to its last.
fn close_the_circle(field: &mut Field, axis: usize) {
    let [nx, ny, nz] = field.counts;
    match axis {
        0 => field.data.chunks_exact_mut(nx).for_each(|row| row[nx - 1] = row[0]),
        1 => field.data.chunks_exact_mut(nx * ny).for_each(|plane| plane.copy_within(..nx, nx * (ny - 1))),
        _ => field.data.copy_within(..nx * ny, nx * ny * (nz - 1)),
    }
}

/// Makes as much leave through the inflow sides of a sealed box as enters through all sides.
fn balance(grid: &Grid, velocity: &mut [Field; 3]) {
    let volume = grid.cell_m.map(f64::from).into_iter().product::<f64>();
    let (mut entering, mut area) = (0.0_f64, 0.0_f64);
    for (axis, field) in velocity.iter_mut().enumerate() {
        let face = volume / f64::from(grid.cell_m[axis]);
        for (end, sign) in [1.0, -1.0].into_iter().enumerate() {
            let side = grid.sides[axis][end];
            if side.fixes_flow() {
                for_side(field, axis, end, |_, value| {
                    entering += sign * face * f64::from(*value);
                    area += if side == Side::Inflow { face } else { 0.0 };
                });
            }
        }
    }
    if area > 0.0 && entering != 0.0 {
        let less = (entering / area) as f32;
        for (axis, field) in velocity.iter_mut().enumerate() {
            for (end, less) in [less, -less].into_iter().enumerate() {
                if grid.sides[axis][end] == Side::Inflow {
                    for_side(field, axis, end, |_, value| *value -= less);
                }
            }
        }
    }
}

/// The wind's ram pressure on open sides that it blows into: the first face follows it within
/// the time in which it crosses a cell, and so the box within the time in which it crosses the box.
pub(crate) fn push_wind(grid: &Grid, velocity: &mut [Field; 3], walls: Walls<'_>, dt_s: f32) {
    for (axis, field) in velocity.iter_mut().enumerate() {
        let wind = walls.wind[axis];
        let through = wind - walls.frame[axis];
        let share = 1.0 - (-through.abs() * dt_s / grid.cell_m[axis]).exp();
        for (end, blows_in) in [through > 0.0, through < 0.0].into_iter().enumerate() {
            if blows_in && grid.sides[axis][end] == Side::Open {
                for_side(field, axis, end, |_, value| *value += share * (wind - *value));
            }
        }
    }
}
