//! What a caller changes: settings, and what is added to the air.

mod add;
mod settings;

pub(crate) use add::{add_ball, check_ball};
pub(crate) use settings::fill;
