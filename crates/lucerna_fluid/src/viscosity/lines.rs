//! Many lines solved at once.

use std::ops::Range;

use super::line::Line;
use crate::limits::MAX_AXIS_CELLS;
use crate::sides::Wall;

/// Lines along x solved together.
const LANES: usize = 16;

/// Solves the systems that run across consecutive rows of `width` values; `walls` is what the
/// two ends hold, by place in the row.
#[inline(always)]
pub(crate) fn solve_rows(values: &mut [f32], width: usize, line: &Line, walls: [Wall<'_>; 2]) {
    let count = line.count;
    for (end, wall) in walls.into_iter().enumerate() {
        if line.held[end] != 0.0 {
            add_held(&mut values[[0, (count - 1) * width][end]..][..width], line.held[end], wall);
        }
    }
    values[..width].iter_mut().for_each(|value| *value *= line.scale[0]);
    for node in 1..count {
        let (done, rest) = values.split_at_mut(node * width);
        let (scale, carry) = (line.scale[node], line.carry[node]);
        for (value, below) in rest[..width].iter_mut().zip(&done[(node - 1) * width..]) {
            *value = scale * *value + carry * below;
        }
    }
    for node in (0..count - 1).rev() {
        let (rest, done) = values.split_at_mut((node + 1) * width);
        let back = line.back[node];
        for (value, above) in rest[node * width..].iter_mut().zip(&done[..width]) {
            *value += back * above;
        }
    }
    if let Some(circle) = &line.circle {
        let (first, rest) = values.split_at_mut(width);
        // The first row is needed until all others are done.
        let ends = |first: &f32, last: &f32| first + circle.last * last;
        if count > 1 {
            let (rest, last) = rest[..(count - 1) * width].split_at_mut((count - 2) * width);
            for (rows, share) in rest.chunks_exact_mut(width).zip(&circle.share[1..]) {
                for ((value, first), last) in rows.iter_mut().zip(&*first).zip(&*last) {
                    *value -= share * ends(first, last);
                }
            }
            for (first, last) in first.iter_mut().zip(last) {
                let off = ends(first, last);
                *first -= circle.share[0] * off;
                *last -= circle.share[count - 1] * off;
            }
        }
        if values.len() > count * width {
            values.copy_within(..width, count * width);
        }
    }
}

#[inline(always)]
fn add_held(row: &mut [f32], weight: f32, wall: Wall<'_>) {
    match wall {
        Wall::Same(0.0) => {}
        Wall::Same(held) => row.iter_mut().for_each(|value| *value += weight * held),
        Wall::Each(held) => row.iter_mut().zip(held).for_each(|(value, held)| *value += weight * held),
    }
}

/// Solves the systems along the rows `inner` of a plane, whose values `from` gives; the other
/// rows stay. Rows are turned into lanes, so that one instruction serves many of them.
#[inline(always)]
pub(crate) fn solve_transposed<'a>(
    plane: &mut [f32],
    nx: usize,
    inner: Range<usize>,
    from: impl Fn(usize) -> &'a [f32],
    line: &Line,
    walls: [Wall<'_>; 2],
) {
    // Clearing a long buffer for short lines would cost more than solving them.
    let (mut short, mut middle, mut long);
    let turned: &mut [[f32; LANES]] = if nx <= 40 {
        short = [[0.0; LANES]; 40];
        &mut short[..nx]
    } else if nx <= 136 {
        middle = [[0.0; LANES]; 136];
        &mut middle[..nx]
    } else {
        long = [[0.0; LANES]; MAX_AXIS_CELLS + 1];
        &mut long[..nx]
    };
    let end = inner.end;
    for first in inner.step_by(LANES) {
        let lanes = LANES.min(end - first);
        // Lanes beyond the last row repeat it.
        let rows: [&[f32]; LANES] = std::array::from_fn(|lane| from(first + lane.min(lanes - 1)));
        turn_in(&rows, turned);
        let mut held = [[0.0; LANES]; 2];
        for (held, wall) in held.iter_mut().zip(walls) {
            match wall {
                Wall::Same(value) => held.fill(value),
                Wall::Each(values) => held[..lanes].copy_from_slice(&values[first..first + lanes]),
            }
        }
        let walls = [Wall::Each(&held[0]), Wall::Each(&held[1])];
        solve_rows(turned.as_flattened_mut(), LANES, line, walls);
        turn_out(turned, &mut plane[first * nx..(first + lanes) * nx]);
    }
}

#[inline(always)]
fn turn_in(rows: &[&[f32]; LANES], turned: &mut [[f32; LANES]]) {
    let nx = turned.len();
    let rows: [&[f32]; LANES] = std::array::from_fn(|lane| &rows[lane][..nx]);
    for (i, out) in turned.iter_mut().enumerate() {
        *out = std::array::from_fn(|lane| rows[lane][i]);
    }
}

#[inline(always)]
fn turn_out(turned: &[[f32; LANES]], rows: &mut [f32]) {
    for (lane, row) in rows.chunks_exact_mut(turned.len()).enumerate() {
        for (out, lanes) in row.iter_mut().zip(turned) {
            *out = lanes[lane];
        }
    }
}
