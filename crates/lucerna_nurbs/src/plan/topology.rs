//! How vertices are numbered and joined to triangles.

use alloc::vec::Vec;

use super::GridOptions;

/// The number of vertices in row `j`.
pub(super) fn row_len(options: &GridOptions, j: usize) -> usize {
    let pole = (j == 0 && options.pole_v_min) || (j == options.rows && options.pole_v_max);
    options.columns + usize::from(!pole)
}

/// The index of the first vertex of row `j`.
pub(super) fn row_start(options: &GridOptions, j: usize) -> usize {
    j * (options.columns + 1) - usize::from(j > 0 && options.pole_v_min)
}

/// The index behind the last vertex of row `j`.
pub(super) fn row_end(options: &GridOptions, j: usize) -> usize {
    row_start(options, j) + row_len(options, j)
}

pub(super) fn vertex_count(options: &GridOptions) -> usize {
    row_end(options, options.rows)
}

/// Triangles, counter-clockwise seen against dS/du x dS/dv.
pub(super) fn triangles(options: &GridOptions) -> Vec<u32> {
    let poles = usize::from(options.pole_v_min) + usize::from(options.pole_v_max);
    let mut indices = Vec::with_capacity(3 * options.columns * (2 * options.rows - poles));
    // Vertices are few enough for `u32`, see `GridPlan::MAX_VERTICES`.
    let mut push = |a: usize, b: usize, c: usize| {
        let [b, c] = if options.flip { [c, b] } else { [b, c] };
        indices.extend([a as u32, b as u32, c as u32]);
    };
    for j in 0..options.rows {
        let (low, high) = (row_start(options, j), row_start(options, j + 1));
        for i in 0..options.columns {
            if j == 0 && options.pole_v_min {
                push(low + i, high + i + 1, high + i);
            } else if j + 1 == options.rows && options.pole_v_max {
                push(low + i, low + i + 1, high + i);
            } else {
                // Where the two vertices of an edge meet, the triangle on it has no area.
                let turn = 2 * i + 1 == options.columns;
                if !(turn && j == 0 && options.slit_v_min) {
                    push(low + i, low + i + 1, high + i + 1);
                }
                if !(turn && j + 1 == options.rows && options.slit_v_max) {
                    push(low + i, high + i + 1, high + i);
                }
            }
        }
    }
    indices
}
