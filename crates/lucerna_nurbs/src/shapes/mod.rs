//! Curves and surfaces with names: lines, arcs, what is swept, revolved or laid through curves.

mod arc;
mod loft;
mod revolve;
mod sweep;

use crate::{NurbsError, Real};

/// The angle of a full turn, and whether `sweep` is one, to rounding; refused when it is none at all.
fn check_sweep<T: Real>(sweep: T) -> Result<bool, NurbsError> {
    let (turn, value) = (core::f64::consts::TAU, sweep.to_f64());
    let slack = turn * 4.0 * T::EPSILON.to_f64();
    if value > 0.0 && value <= turn + slack {
        return Ok(value >= turn - slack);
    }
    Err(NurbsError::Angle { name: "sweep", value })
}
