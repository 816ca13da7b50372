//! A plan as bytes, for an evaluator on a graphics device.
//!
//! The bytes are 32-bit words, little endian, as a WGSL `array<u32>` in a storage buffer reads them;
//! numbers that are not counts are `f32`, to be read with `bitcast<f32>`.
//!
//! | word | meaning |
//! |---|---|
//! | 0 | columns of cells |
//! | 1 | rows of cells |
//! | 2 | vertices |
//! | 3 | flags: 1 flip, 2 a pole at the lower end of v, 4 a pole at the upper end, 8 v is open |
//! | 4 | `n_v`, control points along v: point (i, j) of the net is number `i * n_v + j` |
//! | 5 | control points that a sample along u depends on, `p` |
//! | 6 | control points that a sample along v depends on, `q` |
//! | 7 | where the samples along u start, in words: `columns + 1` of them |
//! | 8 | where the samples along v start: `rows + 1` of them |
//! | 9 | where the middles of the columns start: `columns` of them, or 0 without poles |
//! | 10 | control points of a net |
//! | 11 to 15 | 0 |
//!
//! A sample along u takes `1 + 3 p` words: its place, 0 to 1; the numbers of `p` control rows; their
//! `p` values; their `p` slopes, of which only the directions matter. Likewise along v, with `q`.
//!
//! Vertex `k`, one for each thread: the first row has `c = columns + 1` vertices, one less at a pole.
//! Row and column are `0, k` below `c`, else `1 + (k - c) / (columns + 1)` and the remainder. At a
//! pole take the u sample from the middles. With `P` the control points, less one of those that the
//! vertex depends on (differences keep their digits), and `w` their weights, sum up
//! `A = sum N_i M_j w_ij P_ij`, likewise `W` without `P`, and with slopes for values their derivatives
//! along u, along v and along both. Then `S = A / W`, `Su = (Au - Wu S) / W`, likewise `Sv`, and
//! `Suv = (Auv - Wuv S - Wu Sv - Wv Su) / W` (The NURBS Book, A4.4). The normal is that of `Su x Sv`;
//! in the first and last row of an open v, where `Su` vanishes, of `Suv x Sv` and of its opposite.
//! At a pole the position is that of the u sample 0, so that all vertices there agree bit for bit.
//! Seams agree because the samples there do.

use alloc::vec::Vec;

use super::axis::Axis;
use super::{Closure, GridPlan};
use crate::Real;

const HEADER: usize = 16;

impl<T: Real> GridPlan<T> {
    /// The tables as bytes for an evaluator on a graphics device, which then needs of each net only
    /// its control points. Together with [`indices`](Self::indices) they say all about the mesh.
    ///
    /// 32-bit words, little endian: a header of 16, then the samples along u, along v, and the middles
    /// of the columns where there are poles. The header is, in this order: columns and rows of cells,
    /// vertices, flags (1 flip, 2 and 4 a pole at the lower and upper end of v, 8 v is open),
    /// control points along v, control points of a sample along u (`p`) and along v (`q`), the words
    /// at which the samples along u, along v and the middles start, control points of a net, zeros.
    /// A sample is its place, `p` (or `q`) control points, their values, their slopes: `1 + 3 p`
    /// words, places, values and slopes `f32`.
    pub fn tables_as_bytes(&self) -> Vec<u8> {
        let options = &self.options;
        let flags = [options.flip, options.pole_v_min, options.pole_v_max, options.closure_v == Closure::Open];
        let flags = flags.iter().enumerate().map(|(bit, &set)| usize::from(set) << bit).sum();
        let words = |axis: &Axis<T>| axis.places.len() * (1 + 3 * axis.width);
        let start_v = HEADER + words(&self.u);
        let start_middle = self.middle.as_ref().map_or(0, |_| start_v + words(&self.v));
        let mut header = [0; HEADER];
        header[..11].copy_from_slice(&[
            options.columns,
            options.rows,
            self.vertex_count(),
            flags,
            self.v.points,
            self.u.width,
            self.v.width,
            HEADER,
            start_v,
            start_middle,
            self.point_count(),
        ]);
        // All counts are below 2^32: `GridPlan::MAX_VERTICES` and `MAX_POINTS` see to it.
        let mut bytes: Vec<u8> = header.iter().flat_map(|&word| (word as u32).to_le_bytes()).collect();
        for axis in [&self.u, &self.v].into_iter().chain(self.middle.as_ref().map(|middle| &middle.axis)) {
            for (i, place) in axis.places.iter().enumerate() {
                let sample = axis.sample(i);
                let single = |x: &T| (x.to_f64() as f32).to_le_bytes();
                bytes.extend(single(place));
                bytes.extend(sample.indices.iter().flat_map(|&index| (index as u32).to_le_bytes()));
                bytes.extend(sample.values.iter().chain(sample.slopes).flat_map(single));
            }
        }
        bytes
    }
}
