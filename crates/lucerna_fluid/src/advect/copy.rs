//! Copies of lattices with what lies around the corner.

use crate::grid::Grid;

/// Copies `values` with the first plane again behind the last one along each periodic axis other
/// than `own`, along which faces have it already.
pub(super) fn wrapped(grid: &Grid, values: &[f32], counts: [usize; 3], own: Option<usize>, out: &mut Vec<f32>) {
    let periodic = grid.periodic();
    let [more_x, more_y, more_z] = [0, 1, 2].map(|axis| periodic[axis] && own != Some(axis));
    let [nx, ny, nz] = counts;
    out.clear();
    for k in (0..nz).chain(more_z.then_some(0)) {
        for j in (0..ny).chain(more_y.then_some(0)) {
            let row = &values[nx * (j + ny * k)..][..nx];
            out.extend_from_slice(row);
            if more_x {
                out.push(row[0]);
            }
        }
    }
}
