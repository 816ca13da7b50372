//! Vorticity confinement: gives back to eddies what the grid takes from them.
//! R. Fedkiw, J. Stam, H. W. Jensen, *Visual Simulation of Smoke*, SIGGRAPH 2001, eq. 9 to 11.
//!
//! Three passes over rows, without a branch inside: vorticity and its size, the force, and the
//! force's mean on each face. Rows along x get a value on either end, so that every cell has
//! two neighbours: the cell's own at a side, the opposite end's where the box is periodic.

use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::slopes::{EMPTY_ROW, is_periodic, neighbours, pad, parts, per_m};

/// Arrays that confinement works in; empty until it is first used.
#[derive(Default)]
pub(crate) struct Confinement {
    /// By z-plane: the vorticity's three components, then its size, 1/s.
    vorticity: Vec<f32>,
    /// By z-plane: the three components of what is added to the velocity, m/s.
    push: Vec<f32>,
    /// One over the distance between the neighbours of a cell, 1/m, by axis and index.
    per_m: [Vec<f32>; 3],
}

impl Confinement {
    /// Adds the acceleration `strength * edge * (N x vorticity)`; `strength` in 1/s.
    pub(crate) fn apply(&mut self, grid: &Grid, velocity: &mut [Field; 3], strength: f32, dt_s: f32) {
        self.make_room(grid);
        let exec = grid.exec;
        let plane = grid.plane();
        let per_m = &self.per_m;
        let faces: &[Field; 3] = velocity;
        for_planes(
            exec,
            &mut self.vorticity,
            4 * plane,
            #[inline(always)]
            |k, out| vorticity_plane(grid, faces, per_m, k, out),
        );
        let vorticity = &self.vorticity;
        let scale = strength * grid.shortest_m() * dt_s;
        for_planes(
            exec,
            &mut self.push,
            3 * plane,
            #[inline(always)]
            |k, out| push_plane(grid, vorticity, per_m, scale, k, out),
        );
        let push = &self.push;
        for (axis, field) in velocity.iter_mut().enumerate() {
            let faces = field.plane();
            for_planes(
                exec,
                &mut field.data,
                faces,
                #[inline(always)]
                |k, out| add_to_faces(grid, push, axis, k, out),
            );
        }
    }

    fn make_room(&mut self, grid: &Grid) {
        if self.vorticity.len() != 4 * grid.count() {
            self.vorticity = vec![0.0; 4 * grid.count()];
            self.push = vec![0.0; 3 * grid.count()];
            self.per_m = per_m(grid);
        }
    }
}

/// Vorticity of one plane from the velocities at the centres, which are means of two faces.
#[inline(always)]
fn vorticity_plane(grid: &Grid, [u, v, w]: &[Field; 3], per_m: &[Vec<f32>; 3], k: usize, out: &mut [f32]) {
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
    // Sums of two faces are twice the value at the centre.
    let per_z = 0.5 * per_m[2][k];
    let [out_x, out_y, out_z, size] = parts(out, plane);
    for (j, per_y) in per_m[1].iter().enumerate() {
        let (j_low, j_high) = neighbours(grid, 1, j);
        let per_y = 0.5 * per_y;
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
        let at = j * nx;
        let (out_x, out_y) = (&mut out_x[at..][..nx], &mut out_y[at..][..nx]);
        let (out_z, size) = (&mut out_z[at..][..nx], &mut size[at..][..nx]);
        for i in 0..nx {
            let dw_dy = ((wc[i] + wd[i]) - (wa[i] + wb[i])) * per_y;
            let dv_dz = ((vc[i] + vd[i]) - (va[i] + vb[i])) * per_z;
            let du_dz = ((uz_high[i] + uz_high[i + 1]) - (uz_low[i] + uz_low[i + 1])) * per_z;
            let dw_dx = (w_row[i + 2] - w_row[i]) * (0.5 * per_x[i]);
            let dv_dx = (v_row[i + 2] - v_row[i]) * (0.5 * per_x[i]);
            let du_dy = ((uy_high[i] + uy_high[i + 1]) - (uy_low[i] + uy_low[i + 1])) * per_y;
            let (x, y, z) = (dw_dy - dv_dz, du_dz - dw_dx, dv_dx - du_dy);
            out_x[i] = x;
            out_y[i] = y;
            out_z[i] = z;
            size[i] = (x * x + y * y + z * z).sqrt();
        }
    }
}

/// `scale * (N x vorticity)` of one plane, N the direction in which the vorticity grows.
#[inline(always)]
fn push_plane(grid: &Grid, vorticity: &[f32], per_m: &[Vec<f32>; 3], scale: f32, k: usize, out: &mut [f32]) {
    let nx = grid.cells[0];
    let plane = grid.plane();
    let wraps = is_periodic(grid, 0);
    let (k_low, k_high) = neighbours(grid, 2, k);
    let part = |part: usize, j: usize, k: usize| &vorticity[(4 * k + part) * plane + j * nx..][..nx];
    let mut row = EMPTY_ROW;
    let row = &mut row[..nx + 2];
    let per_x = &per_m[0][..nx];
    let per_z = per_m[2][k];
    let [out_x, out_y, out_z] = parts(out, plane);
    for (j, per_y) in per_m[1].iter().enumerate() {
        let (j_low, j_high) = neighbours(grid, 1, j);
        row[1..=nx].copy_from_slice(part(3, j, k));
        pad(row, wraps);
        let (y_low, y_high) = (part(3, j_low, k), part(3, j_high, k));
        let (z_low, z_high) = (part(3, j, k_low), part(3, j, k_high));
        let (wx, wy, wz) = (part(0, j, k), part(1, j, k), part(2, j, k));
        let at = j * nx;
        let (out_x, out_y, out_z) = (&mut out_x[at..][..nx], &mut out_y[at..][..nx], &mut out_z[at..][..nx]);
        for i in 0..nx {
            let x = (row[i + 2] - row[i]) * per_x[i];
            let y = (y_high[i] - y_low[i]) * per_y;
            let z = (z_high[i] - z_low[i]) * per_z;
            let length = (x * x + y * y + z * z).sqrt();
            // No direction where the vorticity is even.
            let factor = if length > 1.0e-18 { scale / length } else { 0.0 };
            out_x[i] = factor * (y * wz[i] - z * wy[i]);
            out_y[i] = factor * (z * wx[i] - x * wz[i]);
            out_z[i] = factor * (x * wy[i] - y * wx[i]);
        }
    }
}

/// Adds to the faces across `axis` in plane `k` the mean of the cells on either side.
#[inline(always)]
fn add_to_faces(grid: &Grid, push: &[f32], axis: usize, k: usize, out: &mut [f32]) {
    let [nx, ny, _] = grid.cells;
    let plane = grid.plane();
    let part = |j: usize, k: usize| &push[(3 * k + axis) * plane + j * nx..][..nx];
    // The cells below and above a face; at a side of the box, the one there twice.
    let across = |face: usize| {
        let count = grid.cells[axis];
        let wraps = is_periodic(grid, axis) && (face == 0 || face == count);
        if wraps { (count - 1, 0) } else { (face.saturating_sub(1), face.min(count - 1)) }
    };
    match axis {
        0 => {
            for (j, out) in out.chunks_exact_mut(nx + 1).enumerate() {
                let row = part(j, k);
                for (out, pair) in out[1..nx].iter_mut().zip(row.windows(2)) {
                    *out += 0.5 * (pair[0] + pair[1]);
                }
                for face in [0, nx] {
                    let (low, high) = across(face);
                    out[face] += 0.5 * (row[low] + row[high]);
                }
            }
        }
        1 => {
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let (low, high) = across(j);
                add_means(out, part(low, k), part(high, k));
            }
        }
        _ => {
            let (low, high) = across(k);
            for (j, out) in out.chunks_exact_mut(nx).enumerate().take(ny) {
                add_means(out, part(j, low), part(j, high));
            }
        }
    }
}

#[inline(always)]
fn add_means(out: &mut [f32], low: &[f32], high: &[f32]) {
    for ((out, low), high) in out.iter_mut().zip(low).zip(high) {
        *out += 0.5 * (low + high);
    }
}
