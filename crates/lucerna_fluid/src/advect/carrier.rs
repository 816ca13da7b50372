//! Carries fields along traced ways, by the scheme asked for.

use super::back::{Backward, Correction, Kind, Outside};
use super::copy::{wrapped, wrapped_counts};
use super::cubic::{Bends, take_bends};
use super::flux::Flow;
use super::sample::Lattice;
use super::trace::{Motion, Ways};
use super::{ScalarAdvection, Trace};
use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::{Partial, run_planes};

/// Ways and the arrays that carrying along them needs; empty until first used.
#[derive(Clone, Debug, Default)]
pub(crate) struct Carrier {
    ways: Ways,
    has_forth: bool,
    /// Copies of the velocities with what lies around the corner of periodic axes.
    velocity: [Vec<f32>; 3],
    /// Such a copy of what is carried.
    from: Vec<f32>,
    /// What interpolates it cubically.
    bends: Bends,
    /// By face, 1 where something may pass and 0 beside solid cells.
    pub(super) open: [Vec<f32>; 3],
    /// What is carried in the second half of a step with a reflection.
    pub(super) mirror: Option<[Field; 3]>,
    /// What the first of the two passes of `MacCormack` finds, and its copy.
    found: Vec<f32>,
    found_copy: Vec<f32>,
}

/// Values to be carried: where they lie, how to carry them, what comes in.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    pub(crate) kind: Kind,
    pub(crate) scheme: Scheme,
    pub(crate) outside: Outside<'a>,
}

/// Interpolation and correction of a back-trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scheme {
    Linear,
    MacCormack,
    Cubic,
}

impl From<super::Advection> for Scheme {
    fn from(scheme: super::Advection) -> Self {
        match scheme {
            super::Advection::SemiLagrangian => Self::Linear,
            super::Advection::MacCormack | super::Advection::Conservative => Self::MacCormack,
            super::Advection::Cubic | super::Advection::Reflection => Self::Cubic,
        }
    }
}

impl Scheme {
    /// Of a scalar; none for what needs no ways.
    pub(crate) fn of_scalars(scheme: ScalarAdvection) -> Option<Self> {
        match scheme {
            ScalarAdvection::Flux => None,
            ScalarAdvection::SemiLagrangian => Some(Self::Linear),
            ScalarAdvection::MacCormack => Some(Self::MacCormack),
            ScalarAdvection::Cubic => Some(Self::Cubic),
        }
    }
}

impl Carrier {
    /// Traces the ways through a flow during `dt_s`; `MacCormack` needs the way on, too.
    pub(crate) fn trace(
        &mut self,
        grid: &Grid,
        flow: Flow,
        dt_s: f32,
        order: Trace,
        has_forth: bool,
        partials: &mut [Partial],
    ) {
        let Flow { velocity, frame, .. } = flow;
        self.has_forth = has_forth;
        let periods = periods(grid);
        let is_periodic = periods != [0.0; 3];
        let lattices = {
            let copies = &mut self.velocity;
            for (axis, (field, copy)) in velocity.iter().zip(copies.iter_mut()).enumerate() {
                if is_periodic {
                    wrapped(grid, &field.data, field.counts, Some(axis), copy);
                }
            }
            let copies = &self.velocity;
            std::array::from_fn(|axis| {
                let field = &velocity[axis];
                if is_periodic {
                    Lattice::new(&copies[axis], wrapped_counts(grid, field.counts, Some(axis)), periods)
                } else {
                    Lattice::new(&field.data, field.counts, periods)
                }
            })
        };
        let motion = Motion { velocity: lattices, frame, dt_s };
        if is_periodic {
            self.ways.trace::<true>(grid, &motion, order, has_forth, partials);
        } else {
            self.ways.trace::<false>(grid, &motion, order, has_forth, partials);
        }
    }

    /// Fills `out` with `values` carried along the ways. Returns the sum of squares that the inflow brings.
    pub(crate) fn carry(
        &mut self,
        grid: &Grid,
        values: &[f32],
        job: Job<'_>,
        out: &mut [f32],
        partials: &mut [Partial],
    ) -> f64 {
        if periods(grid) == [0.0; 3] {
            self.carry_any::<false>(grid, values, job, out, partials)
        } else {
            self.carry_any::<true>(grid, values, job, out, partials)
        }
    }

    fn carry_any<const WRAPS: bool>(
        &mut self,
        grid: &Grid,
        values: &[f32],
        job: Job<'_>,
        out: &mut [f32],
        partials: &mut [Partial],
    ) -> f64 {
        let Job { kind, scheme, outside } = job;
        let counts = kind.counts(grid);
        let plane = counts[0] * counts[1];
        let periods = periods(grid);
        let copy_counts = wrapped_counts(grid, counts, kind.0);
        let from = if WRAPS {
            wrapped(grid, values, counts, kind.0, &mut self.from);
            Lattice::new(&self.from, copy_counts, periods)
        } else {
            Lattice::new(values, counts, periods)
        };
        let bends = (scheme == Scheme::Cubic).then(|| {
            take_bends(grid.exec, &from, &mut self.bends);
            self.bends.each_ref().map(|bends| Lattice::new(bends, copy_counts, periods))
        });
        let back = Backward::<WRAPS> { grid, ways: &self.ways, kind, from, bends, counts, outside };
        if scheme != Scheme::MacCormack || !self.has_forth {
            return run_planes(grid.exec, out, plane, partials, &back).sum;
        }
        self.found.resize(values.len(), 0.0);
        let brought = run_planes(grid.exec, &mut self.found, plane, partials, &back).sum;
        let found = if WRAPS {
            wrapped(grid, &self.found, counts, kind.0, &mut self.found_copy);
            Lattice::new(&self.found_copy, copy_counts, periods)
        } else {
            Lattice::new(&self.found, counts, periods)
        };
        let correction = Correction { back, start: values, found: &self.found, found_lattice: found };
        run_planes(grid.exec, out, plane, partials, &correction);
        brought
    }
}

/// After how many values each axis repeats itself; zero if it does not.
fn periods(grid: &Grid) -> [f32; 3] {
    let periodic = grid.periodic();
    std::array::from_fn(|axis| if periodic[axis] { grid.cells[axis] as f32 } else { 0.0 })
}
