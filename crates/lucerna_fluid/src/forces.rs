//! What changes temperature and velocity in place: heat, cooling, buoyancy, accelerations.

mod heat;
mod push;

use crate::field::Field;
use crate::grid::Grid;
use crate::limits::MAX_SPEED_M_S;
use crate::parallel::for_planes;
pub(crate) use heat::heat_and_cool;
pub(crate) use push::{accelerate, buoyancy};

/// Clamps each face velocity to the greatest speed.
pub(crate) fn clamp_speed(grid: &Grid, field: &mut Field) {
    let plane = field.plane();
    for_planes(
        grid.exec,
        &mut field.data,
        plane,
        #[inline(always)]
        |_, out| {
            out.iter_mut().for_each(|value| *value = value.clamp(-MAX_SPEED_M_S, MAX_SPEED_M_S));
        },
    );
}
