//! What a step has to do at least, by formula: bytes moved and floating-point operations a cell.
//!
//! Bytes (4 a value), every array read or written once by each pass that cannot be joined with
//! the one before, because it needs values that the other has not made yet:
//! - carrying by samples, the forces joined: each field read and written once: 8 a field.
//! - cubic samples need second differences along three axes: the field read, they written, then
//!   all four read: 28 more a field.
//! - `MacCormack` goes back from the first result: that and the old values are read, the final
//!   ones written: 12 more a field.
//! - through the faces of the cells: the scalar read and written, three velocities read: 20.
//! - the exact pressure solve in three passes: divergence and transform along x (3 read, 1
//!   written); the other transforms and tridiagonal systems on parts that stay in the cache
//!   (1, 1); along x with the gradient (1 + 3, 3): 52. A reflection reads the velocity before: 12.
//! - a Gauss-Seidel sweep: 2 read, 1 written: 12; divergence and gradient: 3, 1 and 4, 3: 44.
//!
//! Operations, comparisons and conversions counted as one each:
//! - a linear sample: 7 interpolations of 3, and per axis 4 to clamp and split: 33.
//! - a cubic sample: a linear one, 33; second differences, 9; along each axis 6 interpolations of
//!   3 between them and 10 to weigh and add; bounds of eight values 14, clamp 2: 142.
//! - a straight trace: the velocity at the place, 8 on a face (two components are means of
//!   four), 6 at a centre (three means of two), and 2 an axis for the place: 14 and 12.
//! - the midpoint adds a sample of all three components and the place: 3 * 33 + 6.
//! - `MacCormack`'s way back: the mirrored place 6, a sample 33, correction 3, bounds of eight
//!   values 14, clamp 2.
//! - through the faces: a limited slope and flux 15 for each of three faces, and 6 to add up.
//! - forces (buoyancy, heat): 8. Divergence 8, gradient 9, tridiagonal system 6.
//! - a transform of a line of n by the fast algorithm: 2.5 log2 n a value. (The solver
//!   multiplies by dense matrices, which take any n; what it does beyond the fast algorithm is
//!   not counted as achieved.)
//! - a sweep: 8.

/// A step's work a cell.
#[derive(Clone, Copy)]
pub(crate) struct Counts {
    pub(crate) bytes: f64,
    pub(crate) flops: f64,
}

/// How a field is carried.
#[derive(Clone, Copy)]
pub(crate) enum Carrying {
    Linear,
    MacCormack,
    Cubic,
    Flux,
}

const SAMPLE: f64 = 33.0;

impl Carrying {
    /// Work of one field whose trace has `stages` stages and starts with `start` operations.
    fn counts(self, start: f64, stages: usize) -> Counts {
        let trace = start + (stages - 1) as f64 * (3.0 * SAMPLE + 6.0);
        let (bytes, flops) = match self {
            Self::Linear => (8.0, trace + SAMPLE),
            Self::MacCormack => (20.0, trace + SAMPLE + 6.0 + SAMPLE + 3.0 + 14.0 + 2.0),
            Self::Cubic => (36.0, trace + 142.0),
            Self::Flux => (20.0, 51.0),
        };
        Counts { bytes, flops }
    }

    fn velocity(self, stages: usize) -> Counts {
        self.counts(14.0, stages).times(3.0)
    }

    fn scalar(self, stages: usize) -> Counts {
        self.counts(12.0, stages)
    }
}

/// One exact projection.
fn projection(n: usize) -> Counts {
    Counts { bytes: 52.0, flops: 8.0 + 4.0 * 2.5 * (n as f64).log2() + 6.0 + 9.0 }
}

/// One projection by sweeps.
fn swept(sweeps: f64) -> Counts {
    Counts { bytes: 44.0 + 12.0 * sweeps, flops: 17.0 + 8.0 * sweeps }
}

impl Counts {
    fn plus(self, other: Self) -> Self {
        Self { bytes: self.bytes + other.bytes, flops: self.flops + other.flops }
    }

    fn times(self, count: f64) -> Self {
        Self { bytes: count * self.bytes, flops: count * self.flops }
    }

    fn with_forces(self) -> Self {
        self.plus(Self { bytes: 0.0, flops: 8.0 })
    }

    /// Velocity and one scalar carried, forces, one exact projection.
    pub(crate) fn step(n: usize, velocity: Carrying, scalar: Carrying, stages: usize) -> Self {
        velocity.velocity(stages).plus(scalar.scalar(stages)).plus(projection(n)).with_forces()
    }

    /// The same with sweeps in place of the exact solve.
    pub(crate) fn step_with_sweeps(sweeps: usize, velocity: Carrying, scalar: Carrying, stages: usize) -> Self {
        velocity.velocity(stages).plus(scalar.scalar(stages)).plus(swept(sweeps as f64)).with_forces()
    }

    /// Two half steps of cubic samples and two projections, the first with a reflection.
    pub(crate) fn reflection(n: usize, scalar: Carrying) -> Self {
        let half = Carrying::Cubic.velocity(2).plus(projection(n));
        let mirror = Self { bytes: 12.0, flops: 6.0 };
        half.times(2.0).plus(mirror).plus(scalar.scalar(2)).with_forces()
    }

    /// Least time a cell, ns, with memory at `gb_s` and arithmetic at `gflop_s`.
    pub(crate) fn bounds_ns(self, gb_s: f64, gflop_s: f64) -> (f64, f64) {
        (self.bytes / gb_s, self.flops / gflop_s)
    }
}
