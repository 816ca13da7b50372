//! Advection: moving velocity, temperature and scalars with the air.

mod carry;
mod energy;
mod flux;
mod packs;
mod semi_lagrangian;

pub(crate) use energy::energy;
