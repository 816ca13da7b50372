//! The ways to carry velocity that are compared.

use lucerna_fluid::FluidBuilder;

/// A scheme with its name.
pub(crate) struct Scheme {
    pub(crate) name: &'static str,
    pub(crate) set: fn(FluidBuilder) -> FluidBuilder,
}

pub(crate) const SCHEMES: &[Scheme] = &[Scheme { name: "semi-Lagrangian", set: |builder| builder }];
