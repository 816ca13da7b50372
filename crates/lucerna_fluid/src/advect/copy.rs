//! Copies of lattices with what lies around the corner.

use crate::grid::Grid;

/// Copies `values` with the first plane again behind the last one along each periodic axis other
/// than `own`, along which faces have it already.
pub(super) fn wrapped(grid: &Grid, values: &[f32], counts: [usize; 3], own: Option<usize>, out: &mut Vec<f32>) {
    let more = more(grid, own);
    let [nx, ny, nz] = counts;
    out.clear();
    for k in (0..nz).chain(more[2].then_some(0)) {
        for j in (0..ny).chain(more[1].then_some(0)) {
            let row = &values[nx * (j + ny * k)..][..nx];
            out.extend_from_slice(row);
            if more[0] {
                out.push(row[0]);
            }
        }
    }
}

/// Counts of the copy that [`wrapped`] makes.
pub(super) fn wrapped_counts(grid: &Grid, counts: [usize; 3], own: Option<usize>) -> [usize; 3] {
    let more = more(grid, own);
    std::array::from_fn(|axis| counts[axis] + usize::from(more[axis]))
}

/// Along which axes a copy has the first value again behind the last.
fn more(grid: &Grid, own: Option<usize>) -> [bool; 3] {
    let periodic = grid.periodic();
    std::array::from_fn(|axis| periodic[axis] && own != Some(axis))
}
