//! The choices of scheme.

use serde::{Deserialize, Serialize};

/// How the velocity is carried by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Advection {
    /// Every value comes from where its air was one step ago, trilinearly (J. Stam, *Stable
    /// Fluids*, SIGGRAPH 1999). First order in space: the fastest, and the one that damps most.
    SemiLagrangian,
    /// As above, with half the error of going there and back taken out again, clamped to the
    /// eight values first found (A. Selle et al., *An Unconditionally Stable `MacCormack` Method*,
    /// J. Sci. Comput. 35, 2008). Second order.
    #[default]
    MacCormack,
    /// Two half steps of `Cubic` with a projection between them, whose correction is applied
    /// twice (J. Zehnder, R. Narain, B. Thomaszewski, *An Advection-Reflection Solver for
    /// Detail-Preserving Fluid Simulation*, SIGGRAPH 2018). Second order in time, third in space:
    /// the most accurate, it keeps the energy of eddies; costs about twice as much. Where hot air
    /// expands, one step of `Cubic`.
    Reflection,
    /// Semi-Lagrangian with cubic interpolation, clamped to the eight values around the place (R.
    /// Bermejo, A. Staniforth, *The Conversion of Semi-Lagrangian Advection Schemes to
    /// Quasi-Monotone Schemes*, Mon. Weather Rev. 120, 1992). Third order in space where smooth.
    Cubic,
    /// Momentum goes through the faces of volumes with the mass that does, by central differences
    /// and the method of Heun with a projection after each of its two halves: mass, momentum and
    /// kinetic energy are conserved where density jumps, too. For fire with
    /// [`crate::Density::LowMach`]: plumes roll up and puff. Temperature and scalars go by the same
    /// fluxes, whatever [`ScalarAdvection`] says. A step is divided so that air crosses half a cell at
    /// most, up to [`crate::FluidBuilder::max_substeps`] parts; parts that are too long even so go as
    /// with `MacCormack`, which no length upsets.
    Conservative,
}

/// How the way of the air is traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Trace {
    /// Straight back with the velocity at the end of the way. First order: in a turning flow air
    /// spirals outwards, and a third of what it carries is lost in a turn at two cells a step.
    Euler,
    /// With the velocity halfway back (Runge-Kutta, second order).
    #[default]
    Midpoint,
}

/// How temperature and scalars are carried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ScalarAdvection {
    /// Through the faces of the cells, second order with a limiter: what leaves one cell enters
    /// the next, so that nothing is lost or made, and no new extremes appear. Long steps are
    /// divided. The only one for which heat put in is heat found.
    #[default]
    Flux,
    /// As [`Advection::SemiLagrangian`].
    SemiLagrangian,
    /// As [`Advection::MacCormack`].
    MacCormack,
    /// As [`Advection::Cubic`].
    Cubic,
}
