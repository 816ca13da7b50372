//! Transport of scalars through the faces of the cells: what leaves one enters the next.
//!
//! Second order, with the limiter of B. van Leer (J. Comput. Phys. 23, 1977, "monotonized
//! central") and the correction `1 - |c|` of P. Lax and B. Wendroff; see R. J. `LeVeque`, *Finite
//! Volume Methods for Hyperbolic Problems*, 2002, section 6.
//!
//! What is solved is `dT/dt + u . grad T = 0`, as `dT/dt + div (u T) = T div u`: where the flow is
//! free of divergence the total changes only by what passes the sides, and where gas expands with
//! `div u = s` the total grows by the integral of `s T`, so that a uniform field stays uniform.

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::back::Outside;
use super::sample::{LANES, V, least, load, most, store};
use crate::field::Field;
use crate::grid::Grid;
use crate::limits::{MAX_AXIS_CELLS, MAX_HEAT_STEPS};
use crate::parallel::{Partial, PlaneKernel, run_planes};
use crate::sides::Side;

/// A row with two values more at each end, and room for whole vectors.
type Row = [f32; MAX_AXIS_CELLS + 4 + 2 * LANES];

/// Carries `values` for `dt_s`, in as many parts as it takes for no new extremes to appear. A step
/// that would need more than [`MAX_HEAT_STEPS`] carries only as far as that many do. The two
/// arrays are of the same size; the first holds the values before and after.
pub(crate) fn transport(
    grid: &Grid,
    flow: Flow,
    dt_s: f32,
    outside: Outside<'_>,
    [values, spare]: [&mut Vec<f32>; 2],
    partials: &mut [Partial],
) {
    let per_speed = grid.cell_m.map(|edge| dt_s / edge);
    let whole = Pass { grid, flow, per_speed, outside, from: values };
    let needed = run_planes(grid.exec, spare, grid.plane(), partials, &Parts(whole)).high;
    // Rounding must not divide what goes in one part.
    let parts = (needed - 1.0e-5).ceil().clamp(1.0, MAX_HEAT_STEPS);
    let scale = (1.0 / parts).min(1.0 / needed.max(1.0e-30));
    let per_speed = per_speed.map(|per_speed| per_speed * scale);
    for _ in 0..parts as usize {
        let pass = Pass { grid, flow, per_speed, outside, from: values };
        run_planes(grid.exec, spare, grid.plane(), partials, &pass);
        std::mem::swap(values, spare);
    }
}

/// What carries.
#[derive(Clone, Copy)]
pub(crate) struct Flow<'a> {
    pub(crate) velocity: &'a [Field; 3],
    /// Velocity of the grid itself, m/s.
    pub(crate) frame: [f32; 3],
    /// By face: 0 where nothing may pass, as beside solid cells, and 1 elsewhere.
    pub(crate) open: Option<&'a [Vec<f32>; 3]>,
    /// Whether what gas holds is kept where it expands, `dT/dt + div (u T) = 0`, instead of the
    /// value in it.
    pub(crate) thins: bool,
}

/// One part of a step.
#[derive(Clone, Copy)]
struct Pass<'a> {
    grid: &'a Grid,
    flow: Flow<'a>,
    /// Courant number of a velocity of 1 m/s.
    per_speed: [f32; 3],
    outside: Outside<'a>,
    from: &'a [f32],
}

/// Finds into how many parts the step must be divided: the greatest over the cells.
struct Parts<'a>(Pass<'a>);

impl Pass<'_> {
    /// Courant numbers of sixteen cells' faces: low and high one along x, y and z.
    #[inline(always)]
    fn courant<S: Simd>(&self, simd: S, first: usize, j: usize, k: usize) -> [V<S>; 6] {
        let [nx, ny, _] = self.grid.cells;
        let [u, v, w] = self.flow.velocity;
        let [at_u, at_v, at_w] =
            [first + (nx + 1) * (j + ny * k), first + nx * (j + (ny + 1) * k), first + nx * (j + ny * k)];
        let faces = [
            load(simd, &u.data, at_u),
            load(simd, &u.data, at_u + 1),
            load(simd, &v.data, at_v),
            load(simd, &v.data, at_v + nx),
            load(simd, &w.data, at_w),
            load(simd, &w.data, at_w + nx * ny),
        ];
        let mut courant = faces;
        for face in 0..6 {
            courant[face] = (faces[face] - self.flow.frame[face / 2]) * self.per_speed[face / 2];
        }
        if let Some([u, v, w]) = self.flow.open {
            courant[0] *= load(simd, u, at_u);
            courant[1] *= load(simd, u, at_u + 1);
            courant[2] *= load(simd, v, at_v);
            courant[3] *= load(simd, v, at_v + nx);
            courant[4] *= load(simd, w, at_w);
            courant[5] *= load(simd, w, at_w + nx * ny);
        }
        courant
    }

    /// The row of values (j, k) and what follows it, so that whole vectors can be read; beyond the
    /// sides the outside, or at walls the row there.
    #[inline(always)]
    fn row<'b>(&'b self, [j, k]: [isize; 2], outside: &'b Row) -> &'b [f32] {
        let [nx, ny, nz] = self.grid.cells;
        let (Some(j), Some(k)) = (self.inside(1, j, ny), self.inside(2, k, nz)) else {
            return outside;
        };
        &self.from[nx * (j + ny * k)..]
    }

    /// The index to read along an axis; none where the air is the outside's.
    #[inline(always)]
    fn inside(&self, axis: usize, index: isize, count: usize) -> Option<usize> {
        let last = count as isize - 1;
        if index >= 0 && index <= last {
            return Some(index as usize);
        }
        match self.grid.sides[axis][usize::from(index > 0)] {
            Side::Periodic => Some(index.rem_euclid(count as isize) as usize),
            side if side.lets_in() => None,
            _ => Some(index.clamp(0, last) as usize),
        }
    }

    /// Whether nothing around a row differs from its first value, so that nothing changes.
    #[inline(always)]
    fn is_even<S: Simd>(&self, simd: S, rows: &[&[f32]; 9], outside: f32) -> bool {
        let value = rows[0][0];
        let reaches_out = self.grid.sides[0].iter().any(|side| side.lets_in());
        if reaches_out && outside != value {
            return false;
        }
        let even = V::splat(simd, value);
        for row in rows {
            let (chunks, rest) = row[..self.grid.cells[0]].as_chunks::<LANES>();
            for chunk in chunks {
                if !V::simd_from(simd, *chunk).simd_eq(even).all_true() {
                    return false;
                }
            }
            if rest.iter().any(|other| *other != value) {
                return false;
            }
        }
        true
    }
}

/// Value that passes a face with the Courant number `c`, between the second and the third of
/// four values in a line.
#[inline(always)]
fn face<S: Simd>(simd: S, c: V<S>, [before, low, high, after]: [V<S>; 4]) -> V<S> {
    let zero = V::splat(simd, 0.0);
    let is_up = c.simd_gt(zero);
    let upwind = is_up.select(low, high);
    let ahead = is_up.select(high - low, low - high);
    let behind = is_up.select(low - before, high - after);
    // The least in size of twice either difference and of their mean; zero at an extreme.
    let (size_ahead, size_behind) = (ahead.abs(), behind.abs());
    let steepest = least(size_ahead, size_behind) * 2.0;
    let slope = least(steepest, (ahead + behind).abs() * 0.5);
    let slope = (ahead * behind).simd_gt(zero).select(slope, zero);
    let slope = ahead.simd_gt(zero).select(slope, zero - slope);
    upwind + slope * ((V::splat(simd, 1.0) - c.abs()) * 0.5)
}

impl PlaneKernel<f32> for Parts<'_> {
    #[inline(always)]
    fn plane<S: Simd>(&self, simd: S, k: usize, _: &mut [f32]) -> Partial {
        let [nx, ny, _] = self.0.grid.cells;
        let zero = V::splat(simd, 0.0);
        let mut parts = zero;
        for j in 0..ny {
            for block in 0..nx.div_ceil(LANES) {
                let first = LANES * block;
                let courant = self.0.courant(simd, first, j, k);
                let (mut passed, mut squares, mut greatest) = (zero, zero, zero);
                for (face, c) in courant.into_iter().enumerate() {
                    let leaves = if face % 2 == 0 { most(zero - c, zero) } else { most(c, zero) };
                    passed += c.abs();
                    squares += leaves * leaves;
                    greatest = most(c.abs(), greatest);
                }
                // A new value lies between old ones if passed / p - squares / p² is at most 1.
                let root = most(passed * passed - squares * 4.0, zero).sqrt();
                let mut needed = most((passed + root) * 0.5, greatest);
                if first + LANES > nx {
                    for lane in nx - first..LANES {
                        needed[lane] = 0.0;
                    }
                }
                parts = most(needed, parts);
            }
        }
        Partial { high: parts.as_array().iter().fold(0.0, |most, one| most.max(*one)), ..Partial::default() }
    }
}

impl PlaneKernel<f32> for Pass<'_> {
    #[inline(always)]
    fn plane<S: Simd>(&self, simd: S, k: usize, out: &mut [f32]) -> Partial {
        let [nx, ny, _] = self.grid.cells;
        let mut outside: Row = [0.0; MAX_AXIS_CELLS + 4 + 2 * LANES];
        outside[..nx].fill(self.outside.value);
        let mut padded: Row = [0.0; MAX_AXIS_CELLS + 4 + 2 * LANES];
        let k_at = k as isize;
        for j in 0..ny {
            let j_at = j as isize;
            let rows = [
                self.row([j_at, k_at], &outside),
                self.row([j_at - 2, k_at], &outside),
                self.row([j_at - 1, k_at], &outside),
                self.row([j_at + 1, k_at], &outside),
                self.row([j_at + 2, k_at], &outside),
                self.row([j_at, k_at - 2], &outside),
                self.row([j_at, k_at - 1], &outside),
                self.row([j_at, k_at + 1], &outside),
                self.row([j_at, k_at + 2], &outside),
            ];
            if !self.flow.thins && self.is_even(simd, &rows, self.outside.value) {
                out[j * nx..(j + 1) * nx].copy_from_slice(&rows[0][..nx]);
                continue;
            }
            padded[2..nx + 2].copy_from_slice(&rows[0][..nx]);
            for at in [0, 1, nx + 2, nx + 3] {
                let index = self.inside(0, at as isize - 2, nx);
                padded[at] = index.map_or(self.outside.value, |index| rows[0][index]);
            }
            for block in 0..nx.div_ceil(LANES) {
                let first = LANES * block;
                let [u_low, u_high, v_low, v_high, w_low, w_high] = self.courant(simd, first, j, k);
                let mut x = [load(simd, &padded, first); 5];
                for (shift, x) in x.iter_mut().enumerate() {
                    *x = load(simd, &padded, first + shift);
                }
                let here = x[2];
                let mut around = [here; 9];
                for at in 1..9 {
                    around[at] = load(simd, rows[at], first);
                }
                let [_, y0, y1, y3, y4, z0, z1, z3, z4] = around;
                let along_x = u_low * (face(simd, u_low, [x[0], x[1], here, x[3]]) - here)
                    - u_high * (face(simd, u_high, [x[1], here, x[3], x[4]]) - here);
                let along_y = v_low * (face(simd, v_low, [y0, y1, here, y3]) - here)
                    - v_high * (face(simd, v_high, [y1, here, y3, y4]) - here);
                let along_z = w_low * (face(simd, w_low, [z0, z1, here, z3]) - here)
                    - w_high * (face(simd, w_high, [z1, here, z3, z4]) - here);
                let mut change = along_y + (along_x + along_z);
                if self.flow.thins {
                    change += here * ((v_low - v_high) + ((u_low - u_high) + (w_low - w_high)));
                }
                // What is too much of a row, the next one overwrites.
                store(&mut out[j * nx + first..], here + change);
            }
        }
        Partial::default()
    }
}
