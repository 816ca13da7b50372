//! Vorticity confinement: gives back to eddies what the grid takes from them.
//! R. Fedkiw, J. Stam, H. W. Jensen, *Visual Simulation of Smoke*, SIGGRAPH 2001, eq. 9 to 11.

use glam::Vec3;

use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::for_planes;

/// Arrays that confinement works in, one value a cell.
pub(crate) struct Confinement {
    vorticity: Vec<Vec3>,
    force: Vec<Vec3>,
}

impl Confinement {
    pub(crate) fn new(grid: &Grid) -> Self {
        Self { vorticity: vec![Vec3::ZERO; grid.count()], force: vec![Vec3::ZERO; grid.count()] }
    }

    /// Adds the acceleration `strength * edge * (N x vorticity)`; `strength` in 1/s.
    pub(crate) fn apply(&mut self, grid: &Grid, velocity: &mut [Field; 3], strength: f32, dt_s: f32) {
        let cells = grid.cells;
        let plane = grid.plane();
        let is_parallel = grid.is_parallel;
        let faces: &[Field; 3] = velocity;
        for_planes(is_parallel, &mut self.vorticity, plane, |k, out| {
            for (at, out) in out.iter_mut().enumerate() {
                let cell = [at % cells[0], at / cells[0], k];
                // d velocity / d axis, between the neighbours that exist.
                let gradient = |axis: usize| slope(grid, cell, axis, |cell| centre_velocity(faces, cell));
                let (dx, dy, dz) = (gradient(0), gradient(1), gradient(2));
                *out = Vec3::new(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x);
            }
        });
        let vorticity = &self.vorticity;
        let scale = strength * grid.shortest_m() * dt_s;
        for_planes(is_parallel, &mut self.force, plane, |k, out| {
            for (at, out) in out.iter_mut().enumerate() {
                let cell = [at % cells[0], at / cells[0], k];
                let size = |axis: usize| {
                    let size_at =
                        |[i, j, k]: [usize; 3]| Vec3::splat(vorticity[i + cells[0] * (j + cells[1] * k)].length());
                    slope(grid, cell, axis, size_at).x
                };
                let towards = Vec3::new(size(0), size(1), size(2)).normalize_or_zero();
                *out = scale * towards.cross(vorticity[k * plane + at]);
            }
        });
        let force = &self.force;
        for (axis, field) in velocity.iter_mut().enumerate() {
            let [nx, ny, _] = field.counts;
            for_planes(is_parallel, &mut field.data, nx * ny, |k, out| {
                for (at, out) in out.iter_mut().enumerate() {
                    let face = [at % nx, at / nx, k];
                    let mut low = face;
                    low[axis] = low[axis].saturating_sub(1);
                    let mut high = face;
                    high[axis] = high[axis].min(cells[axis] - 1);
                    let force_at = |[i, j, k]: [usize; 3]| force[i + cells[0] * (j + cells[1] * k)][axis];
                    *out += 0.5 * (force_at(low) + force_at(high));
                }
            });
        }
    }
}

/// Velocity at the centre of a cell, m/s.
fn centre_velocity(velocity: &[Field; 3], [i, j, k]: [usize; 3]) -> Vec3 {
    let mean = |field: &Field, stride: usize| {
        let at = i + field.counts[0] * (j + field.counts[1] * k);
        0.5 * (field.data[at] + field.data[at + stride])
    };
    let [u, v, w] = velocity;
    Vec3::new(mean(u, 1), mean(v, v.counts[0]), mean(w, w.plane()))
}

/// Slope of a cell quantity along an axis: central inside, one-sided at the sides.
fn slope(grid: &Grid, cell: [usize; 3], axis: usize, value: impl Fn([usize; 3]) -> Vec3) -> Vec3 {
    let (mut low, mut high) = (cell, cell);
    low[axis] = low[axis].saturating_sub(1);
    high[axis] = (high[axis] + 1).min(grid.cells[axis] - 1);
    let span = (high[axis] - low[axis]) as f32 * grid.cell_m[axis];
    (value(high) - value(low)) / span
}
