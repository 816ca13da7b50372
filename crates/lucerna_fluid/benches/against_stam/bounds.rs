//! What a step has to do at least, by formula: bytes moved and floating-point operations a cell.
//!
//! Bytes (4 a value), every array read or written once by each pass that cannot be joined with
//! the one before, because it needs values that the other has not made yet:
//! - advection of four fields, forces joined: 4 read, 4 written: 32.
//! - the exact pressure solve in five passes: divergence and transform along x (3 read, 1
//!   written), along z (1, 1), the tridiagonal systems along y with their pivots (2, 1), along z
//!   (1, 1), along x with the gradient (1 + 3, 3): 72.
//! - A Gauss-Seidel sweep: 2 read, 1 written: 12; divergence and gradient: 3, 1 and 4, 3: 44.
//!
//! Operations, comparisons and conversions counted as one each:
//! - a sample: 7 interpolations of 3, and per axis 4 to clamp and split: 33.
//! - a straight trace: the velocity at the place, 8 on a face (two components are means of
//!   four), 6 at a centre (three means of two), and 2 an axis for the place: 14 and 12.
//! - the midpoint adds a sample of all three components and the place: 3 * 33 + 6.
//! - forces (buoyancy, heat): 8. Divergence 8, gradient 9, tridiagonal system 6.
//! - a transform of a line of n by the fast algorithm: 2.5 log2 n a value. (The solver
//!   multiplies by dense matrices, 2 n a value, which vectorise at once and take any n; what it
//!   does beyond the fast algorithm is not counted as achieved.)
//! - a sweep: 8.

/// A step's work a cell.
#[derive(Clone, Copy)]
pub(crate) struct Counts {
    pub(crate) bytes: f64,
    pub(crate) flops: f64,
}

const SAMPLE: f64 = 33.0;
const VELOCITY_TRACE: f64 = 14.0;
const CENTRE_TRACE: f64 = 12.0;
const SECOND_STAGE: f64 = 3.0 * SAMPLE + 6.0;
const FORCES: f64 = 8.0;

/// Arithmetic of carrying three velocity components and a scalar.
fn carrying(trace_order: usize) -> f64 {
    let stages = (trace_order - 1) as f64 * SECOND_STAGE;
    3.0 * (VELOCITY_TRACE + stages + SAMPLE) + CENTRE_TRACE + stages + SAMPLE
}

/// One exact projection.
fn projection(n: usize) -> Counts {
    Counts { bytes: 72.0, flops: 8.0 + 4.0 * 2.5 * (n as f64).log2() + 6.0 + 9.0 }
}

impl Counts {
    fn plus(self, other: Self) -> Self {
        Self { bytes: self.bytes + other.bytes, flops: self.flops + other.flops }
    }

    /// Traces of one or two stages, one exact projection.
    pub(crate) fn semi_lagrangian(n: usize, trace_order: usize) -> Self {
        Self { bytes: 32.0, flops: carrying(trace_order) + FORCES }.plus(projection(n))
    }

    /// Sweeps in place of the exact solve.
    pub(crate) fn with_sweeps(self, sweeps: usize) -> Self {
        let exact = projection(1);
        Self {
            bytes: self.bytes - exact.bytes + 44.0 + 12.0 * sweeps as f64,
            flops: self.flops - exact.flops + 17.0 + 8.0 * sweeps as f64,
        }
    }

    /// Least time a cell, ns, with memory at `gb_s` and arithmetic at `gflop_s`.
    pub(crate) fn bounds_ns(self, gb_s: f64, gflop_s: f64) -> (f64, f64) {
        (self.bytes / gb_s, self.flops / gflop_s)
    }
}
