//! Advection: moving velocity, temperature and scalars with the air.

mod back;
mod carrier;
mod carry;
mod copy;
mod corners;
mod cubic;
mod energy;
mod flux;
mod sample;
mod scheme;
mod trace;

pub(crate) use back::{Kind, Outside};
pub(crate) use carrier::{Carrier, Job, Scheme};
pub(crate) use carry::{pack, unpack};
pub(crate) use energy::side_squares;
pub(crate) use flux::{Flow, transport};
pub use scheme::{Advection, ScalarAdvection, Trace};
