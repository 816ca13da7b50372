//! Copies of lattices with what lies around the corner.

use super::sample::LANES;
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

/// Copies `values` with one value more at either end of each axis that has more than one, next
/// to those that [`wrapped`] adds: the last one again, or what lies around the corner. Sixteen
/// zeros more at either end of the array.
pub(super) fn padded(grid: &Grid, values: &[f32], counts: [usize; 3], own: Option<usize>, out: &mut Vec<f32>) {
    let (inner, periodic) = (wrapped_counts(grid, counts, own), grid.periodic());
    let [nx, ny, _] = counts;
    // The index to copy from, for one of the copy along an axis.
    let source = |axis: usize, at: usize| {
        if inner[axis] == 1 {
            return 0;
        }
        let at = at as isize - 1;
        if periodic[axis] {
            at.rem_euclid(grid.cells[axis] as isize) as usize
        } else {
            at.clamp(0, counts[axis] as isize - 1) as usize
        }
    };
    let [px, py, pz] = padded_counts(inner);
    out.clear();
    out.extend([0.0; LANES]);
    for k in 0..pz {
        for j in 0..py {
            let row = &values[nx * (source(1, j) + ny * source(2, k))..][..nx];
            if px == 1 {
                out.push(row[0]);
                continue;
            }
            out.push(row[source(0, 0)]);
            out.extend_from_slice(row);
            out.extend((nx + 1..px).map(|at| row[source(0, at)]));
        }
    }
    out.extend([0.0; LANES]);
}

/// Counts of the copy that [`padded`] makes, from those of the one that [`wrapped`] makes.
pub(super) fn padded_counts(inner: [usize; 3]) -> [usize; 3] {
    inner.map(|count| if count > 1 { count + 2 } else { 1 })
}
