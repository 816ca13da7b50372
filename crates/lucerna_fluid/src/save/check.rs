//! What a saved fluid must be before anything of it is used.

use crate::fluid::Settings;
use crate::limits::{MAX_ACCELERATION_M_S2, MAX_EXPANSION_PER_S, MAX_HEATING_K_S, MAX_SPEED_M_S, MAX_TEMPERATURE_K};
use crate::scalars::{MAX_SCALAR, MAX_SCALAR_RATE};

use super::{Pending, SavedState, Snapshot, SnapshotError, VERSION};

/// Fields are clamped before the last rounding of a step.
const ROUNDING: f32 = 1.01;

impl Snapshot {
    /// Checks everything; allocates nothing.
    pub(super) fn check(&self) -> Result<Settings, SnapshotError> {
        if self.version != VERSION {
            return Err(SnapshotError::Version { found: self.version });
        }
        let (grid, settings) = self.setup.checked()?;
        let (count, faces) = (grid.count(), [0, 1, 2].map(|axis| grid.face_counts(axis).iter().product()));
        let SavedState { velocity, temperature, packs, potential, pressure, max_speed_m_s } = &self.state;
        for (values, faces) in velocity.iter().zip(faces) {
            array("velocity", values, faces, ROUNDING * MAX_SPEED_M_S)?;
        }
        array("temperature", temperature, count, ROUNDING * MAX_TEMPERATURE_K)?;
        length("scalars", packs.len(), self.setup.scalars.packs())?;
        for pack in packs {
            length("scalars", pack.len(), count)?;
            finite("scalars", pack.as_flattened(), ROUNDING * MAX_SCALAR)?;
        }
        array("potential", potential, count, f32::MAX)?;
        array("pressure", pressure, if pressure.is_empty() { 0 } else { count }, f32::MAX)?;
        array("max_speed_m_s", &[*max_speed_m_s], 1, ROUNDING * MAX_SPEED_M_S)?;
        self.given.check(&grid)?;
        if let Some(solids) = &self.solids {
            solids.check(&grid)?;
        }
        // Placed sources are checked as they are placed.
        let Pending { acceleration, heat, expansion, scalars, placed: _ } = &self.pending;
        for (values, faces) in acceleration.iter().zip(faces) {
            let faces = if values.is_empty() { 0 } else { faces };
            array("acceleration", values, faces, MAX_ACCELERATION_M_S2)?;
        }
        array("heat", heat, if heat.is_empty() { 0 } else { count }, MAX_HEATING_K_S)?;
        array("expansion", expansion, if expansion.is_empty() { 0 } else { count }, MAX_EXPANSION_PER_S)?;
        length("scalar sources", scalars.len(), if scalars.is_empty() { 0 } else { self.setup.scalars.names.len() })?;
        for rates in scalars {
            array("scalar sources", rates, if rates.is_empty() { 0 } else { count }, MAX_SCALAR_RATE)?;
        }
        Ok(settings)
    }
}

/// Refuses an array of another length, or with a number beyond `±most` or not a number.
fn array(field: &'static str, values: &[f32], expected: usize, most: f32) -> Result<(), SnapshotError> {
    length(field, values.len(), expected)?;
    finite(field, values, most)
}

fn length(field: &'static str, found: usize, expected: usize) -> Result<(), SnapshotError> {
    if found == expected { Ok(()) } else { Err(SnapshotError::Length { field, found, expected }) }
}

fn finite(field: &'static str, values: &[f32], most: f32) -> Result<(), SnapshotError> {
    let is_good = |value: f32| value >= -most && value <= most;
    match values.iter().position(|value| !is_good(*value)) {
        Some(index) => Err(SnapshotError::Value { field, index, value: values[index], most }),
        None => Ok(()),
    }
}
