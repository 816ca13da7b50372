//! Vorticity confinement: gives back to eddies what the grid takes from them.
//! R. Fedkiw, J. Stam, H. W. Jensen, *Visual Simulation of Smoke*, SIGGRAPH 2001, eq. 9 to 11.

use glam::Vec3;

use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::for_planes;

/// Arrays that confinement works in, one value a cell.
pub(crate) struct Confinement {
    /// Velocity at the centres, then the force.
    vectors: Vec<Vec3>,
    vorticity: Vec<Vec3>,
    size: Vec<f32>,
}

impl Confinement {
    pub(crate) fn new(grid: &Grid) -> Self {
        let count = grid.count();
        Self { vectors: vec![Vec3::ZERO; count], vorticity: vec![Vec3::ZERO; count], size: vec![0.0; count] }
    }

    /// Adds the acceleration `strength * edge * (N x vorticity)`; `strength` in 1/s.
    pub(crate) fn apply(&mut self, grid: &Grid, velocity: &mut [Field; 3], strength: f32, dt_s: f32) {
        let cells = grid.cells;
        let plane = grid.plane();
        let exec = grid.exec;
        let faces: &[Field; 3] = velocity;
        for_planes(
            exec,
            &mut self.vectors,
            plane,
            #[inline(always)]
            |k, out| {
                for (j, row) in out.chunks_exact_mut(cells[0]).enumerate() {
                    centre_velocities(faces, j, k, row);
                }
            },
        );
        let centres = &self.vectors;
        for_planes(
            exec,
            &mut self.vorticity,
            plane,
            #[inline(always)]
            |k, out| {
                for_slopes(grid, k, out, |out, slope| {
                    let (dx, dy, dz) = (slope[0].of(centres), slope[1].of(centres), slope[2].of(centres));
                    *out = Vec3::new(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x);
                });
            },
        );
        let vorticity = &self.vorticity;
        for_planes(
            exec,
            &mut self.size,
            plane,
            #[inline(always)]
            |k, out| {
                for (size, vorticity) in out.iter_mut().zip(&vorticity[k * plane..]) {
                    *size = vorticity.length();
                }
            },
        );
        let size = &self.size;
        let scale = strength * grid.shortest_m() * dt_s;
        for_planes(
            exec,
            &mut self.vectors,
            plane,
            #[inline(always)]
            |k, out| {
                let mut at = k * plane;
                for_slopes(grid, k, out, |out, slope| {
                    let towards =
                        Vec3::new(slope[0].of(size), slope[1].of(size), slope[2].of(size)).normalize_or_zero();
                    *out = scale * towards.cross(vorticity[at]);
                    at += 1;
                });
            },
        );
        let force = &self.vectors;
        let strides = [1, cells[0], plane];
        for (axis, field) in velocity.iter_mut().enumerate() {
            let [nx, ny, _] = field.counts;
            for_planes(
                exec,
                &mut field.data,
                nx * ny,
                #[inline(always)]
                |k, out| {
                    for (j, row) in out.chunks_exact_mut(nx).enumerate() {
                        for (i, out) in row.iter_mut().enumerate() {
                            // The cells on either side of the face; at a side of the box, the one there is twice.
                            let face = [i, j, k];
                            let mut high = face;
                            high[axis] = high[axis].min(cells[axis] - 1);
                            let high_at = high[0] + cells[0] * high[1] + plane * high[2];
                            let is_inside = face[axis] > 0 && face[axis] < cells[axis];
                            let low_at = if is_inside { high_at - strides[axis] } else { high_at };
                            *out += 0.5 * (force[low_at][axis] + force[high_at][axis]);
                        }
                    }
                },
            );
        }
    }
}

/// Velocities at the centres of a row of cells, m/s.
#[inline(always)]
fn centre_velocities([u, v, w]: &[Field; 3], j: usize, k: usize, out: &mut [Vec3]) {
    let row = |field: &Field, j: usize, k: usize| field.counts[0] * (j + field.counts[1] * k);
    let (u, n) = (&u.data[row(u, j, k)..], out.len());
    let (v_low, v_high) = (&v.data[row(v, j, k)..][..n], &v.data[row(v, j + 1, k)..][..n]);
    let (w_low, w_high) = (&w.data[row(w, j, k)..][..n], &w.data[row(w, j, k + 1)..][..n]);
    for (i, out) in out.iter_mut().enumerate() {
        *out = 0.5 * Vec3::new(u[i] + u[i + 1], v_low[i] + v_high[i], w_low[i] + w_high[i]);
    }
}

/// Where to take a slope along one axis: between the neighbours that exist.
#[derive(Clone, Copy)]
struct Slope {
    low: usize,
    high: usize,
    per_m: f32,
}

impl Slope {
    /// Of the cell at `at`, which is `index` of `count` along the axis.
    fn new(at: usize, index: usize, count: usize, stride: usize, cell_m: f32) -> Self {
        let low = if index > 0 { at - stride } else { at };
        let high = if index + 1 < count { at + stride } else { at };
        let span = if index > 0 && index + 1 < count { 2.0 * cell_m } else { cell_m };
        Self { low, high, per_m: 1.0 / span }
    }

    fn of<T>(self, values: &[T]) -> T
    where
        T: Copy + std::ops::Sub<Output = T> + std::ops::Mul<f32, Output = T>,
    {
        (values[self.high] - values[self.low]) * self.per_m
    }
}

/// Calls `each` with every cell of plane `k` and where its slopes along the three axes are to be taken.
#[inline(always)]
fn for_slopes<T>(grid: &Grid, k: usize, out: &mut [T], mut each: impl FnMut(&mut T, [Slope; 3])) {
    let [nx, ny, nz] = grid.cells;
    let plane = grid.plane();
    for (j, row) in out.chunks_exact_mut(nx).enumerate() {
        for (i, out) in row.iter_mut().enumerate() {
            let at = i + nx * j + plane * k;
            let x = Slope::new(at, i, nx, 1, grid.cell_m[0]);
            let y = Slope::new(at, j, ny, nx, grid.cell_m[1]);
            let z = Slope::new(at, k, nz, plane, grid.cell_m[2]);
            each(out, [x, y, z]);
        }
    }
}
