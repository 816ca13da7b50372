//! The ways to carry velocity and scalars that are compared.

use lucerna_fluid::{Advection, FluidBuilder, ScalarAdvection};

/// A scheme with its name.
pub(crate) struct Scheme {
    pub(crate) name: &'static str,
    pub(crate) set: fn(FluidBuilder) -> FluidBuilder,
}

/// The ways to carry velocity.
pub(crate) const SCHEMES: &[Scheme] = &[
    Scheme { name: "semi-Lagrangian", set: |builder| builder.advection(Advection::SemiLagrangian) },
    Scheme { name: "cubic", set: |builder| builder.advection(Advection::Cubic) },
    Scheme { name: "MacCormack (default)", set: |builder| builder.advection(Advection::MacCormack) },
    Scheme { name: "reflection", set: |builder| builder.advection(Advection::Reflection) },
];

/// The ways to carry a scalar.
pub(crate) const SCALAR_SCHEMES: &[Scheme] = &[
    Scheme { name: "semi-Lagrangian", set: |builder| builder.scalar_advection(ScalarAdvection::SemiLagrangian) },
    Scheme { name: "cubic", set: |builder| builder.scalar_advection(ScalarAdvection::Cubic) },
    Scheme { name: "MacCormack", set: |builder| builder.scalar_advection(ScalarAdvection::MacCormack) },
    Scheme { name: "flux (default)", set: |builder| builder.scalar_advection(ScalarAdvection::Flux) },
];
