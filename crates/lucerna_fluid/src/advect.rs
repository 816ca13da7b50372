//! Advection: moving velocity, temperature and scalars with the air.

mod back;
mod carrier;
mod carry;
mod copy;
mod energy;
mod flux;
mod sample;
mod scheme;
mod trace;

pub(crate) use carrier::Carrier;
pub(crate) use carry::{pack, unpack};
pub(crate) use energy::energy_plane;
pub use scheme::{Advection, ScalarAdvection, Trace};
