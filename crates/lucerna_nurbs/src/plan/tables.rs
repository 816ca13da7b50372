//! A plan as bytes, for an evaluator on a graphics device.
//!
//! The layout, and what a thread does with it, is in `docs/nurbs.md`; `tests/grids/tables.rs` does it.
//! At a pole, threads take the position of the u sample 0, so that all agree bit for bit; seams agree
//! because the samples there do.

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
