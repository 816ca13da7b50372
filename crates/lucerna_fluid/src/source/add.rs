//! What a caller adds for the coming step, one call at a time.

use glam::Vec3;

use super::apply::faces;
use crate::error::{FluidError, check, check_vec};
use crate::fluid::Fluid;
use crate::grid::Grid;
use crate::limits::{MAX_ACCELERATION_M_S2, MAX_EXPANSION_PER_S, MAX_HEATING_K_S};

impl Fluid {
    /// Pushes the air of the cell that holds `point` during the coming step, m/s², components
    /// within ±1e6. Each face of the cell takes half, so that the momentum is that of one cell.
    /// Several calls add up. A point outside the box is ignored.
    ///
    /// # Errors
    /// A value that is not finite or out of range; nothing has changed then.
    pub fn add_acceleration(&mut self, point: Vec3, acceleration_m_s2: Vec3) -> Result<(), FluidError> {
        check_point(point)?;
        let acceleration = check_acceleration(acceleration_m_s2)?.to_array();
        let Some([i, j, k]) = self.grid.cell_of_point(point) else { return Ok(()) };
        let cell = i + self.grid.cells[0] * (j + self.grid.cells[1] * k);
        let faces = [0, 1, 2].map(|axis| faces(&self.grid, axis, cell));
        for axis in 0..3 {
            if acceleration[axis] != 0.0 {
                let values = self.accelerations(axis);
                for at in faces[axis] {
                    values[at] = add_clamped(values[at], 0.5 * acceleration[axis], MAX_ACCELERATION_M_S2);
                }
            }
        }
        Ok(())
    }

    /// Pushes all cells of height index `j` upwards during the coming step, m/s², within ±1e6.
    /// Rows add up: the same value on all rows is a uniform acceleration inside the box.
    ///
    /// # Errors
    /// A row that does not exist, or a value that is not finite or out of range.
    pub fn add_row_acceleration(&mut self, j: usize, acceleration_m_s2: f32) -> Result<(), FluidError> {
        let rows = self.grid.cells[1];
        if j >= rows {
            return Err(FluidError::Row { row: j, rows });
        }
        let acceleration = check_acceleration(Vec3::new(0.0, acceleration_m_s2, 0.0))?.y;
        let [nx, ny, _] = self.grid.face_counts(1);
        let [_, above] = faces(&self.grid, 1, j * nx);
        for plane in self.accelerations(1).chunks_exact_mut(nx * ny) {
            for row in [j * nx, above] {
                for value in &mut plane[row..row + nx] {
                    *value = add_clamped(*value, 0.5 * acceleration, MAX_ACCELERATION_M_S2);
                }
            }
        }
        Ok(())
    }

    /// The accelerations along an axis, of its faces' size, about to be added to.
    pub(super) fn accelerations(&mut self, axis: usize) -> &mut [f32] {
        let sources = &mut self.sources;
        sources.has_acceleration[axis] = true;
        let values = &mut sources.acceleration[axis];
        values.resize(self.grid.face_counts(axis).iter().product(), 0.0);
        values
    }

    /// Heats a smooth ball during the coming step: `kelvin_per_s` (within ±1e6, negative cools)
    /// at its centre, falling as `(1 - d²/r²)²` to zero at `radius_m` (above 0, up to 1e6; taken
    /// as no less than the longest edge of a cell). The part outside the box is ignored.
    ///
    /// # Errors
    /// A value that is not finite or out of range; nothing has changed then.
    pub fn add_heat(&mut self, point: Vec3, radius_m: f32, kelvin_per_s: f32) -> Result<(), FluidError> {
        check_ball(point, radius_m)?;
        let rate = check("kelvin_per_s", kelvin_per_s, -1.0e6, 1.0e6, "within ±1e6 K/s")?;
        self.sources.heat.resize(self.grid.count(), 0.0);
        add_ball(&self.grid, &mut self.sources.heat, point, radius_m, rate, MAX_HEATING_K_S);
        self.sources.has_heat = true;
        Ok(())
    }

    /// Lets gas expand in a smooth ball during the coming step: the flow gets the divergence
    /// `rate_per_s` (within ±1e4, negative shrinks) at the centre, falling as in
    /// [`Fluid::add_heat`]. In a box without an open side only differences from the mean act.
    ///
    /// # Errors
    /// A value that is not finite or out of range; nothing has changed then.
    pub fn add_expansion(&mut self, point: Vec3, radius_m: f32, rate_per_s: f32) -> Result<(), FluidError> {
        check_ball(point, radius_m)?;
        let rate = check("rate_per_s", rate_per_s, -1.0e4, 1.0e4, "within ±1e4 1/s")?;
        self.sources.expansion.resize(self.grid.count(), 0.0);
        add_ball(&self.grid, &mut self.sources.expansion, point, radius_m, rate, MAX_EXPANSION_PER_S);
        self.sources.has_expansion = true;
        Ok(())
    }
}

/// Adds a ball that falls smoothly to zero at its radius; sums stay within `most`.
pub(crate) fn add_ball(grid: &Grid, values: &mut [f32], point: Vec3, radius_m: f32, rate: f32, most: f32) {
    let [longest_x, longest_y, longest_z] = grid.cell_m;
    let radius = radius_m.max(longest_x).max(longest_y).max(longest_z);
    let (low, high) = (grid.cells_from_point(point - radius), grid.cells_from_point(point + radius));
    let range = |axis: usize| {
        let count = grid.cells[axis] as f32;
        // Cells whose centres lie between the two ends; empty when the ball is outside.
        let first = (low[axis] - 0.5).ceil().max(0.0).min(count);
        let end = ((high[axis] - 0.5).floor() + 1.0).max(0.0).min(count);
        first as usize..end as usize
    };
    let [nx, ny, _] = grid.cells;
    let (xs, [x_m, y_m, z_m]) = (range(0), grid.cell_m);
    let from = grid.origin - point;
    let per_square = 1.0 / (radius * radius);
    for k in range(2) {
        let z = from.z + (k as f32 + 0.5) * z_m;
        for j in range(1) {
            let y = from.y + (j as f32 + 0.5) * y_m;
            let row = &mut values[nx * (j + ny * k)..][xs.clone()];
            for (i, value) in xs.clone().zip(row) {
                let x = from.x + (i as f32 + 0.5) * x_m;
                let fall = (1.0 - (x * x + (y * y + z * z)) * per_square).max(0.0);
                *value = add_clamped(*value, rate * fall * fall, most);
            }
        }
    }
}

pub(super) fn add_clamped(value: f32, more: f32, most: f32) -> f32 {
    (value + more).max(-most).min(most)
}

fn check_point(point: Vec3) -> Result<Vec3, FluidError> {
    check_vec("point", point, f32::MAX, "finite")
}

pub(crate) fn check_ball(point: Vec3, radius_m: f32) -> Result<(), FluidError> {
    check_point(point)?;
    check("radius_m", radius_m, f32::MIN_POSITIVE, 1.0e6, "above 0, up to 1e6 m")?;
    Ok(())
}

pub(super) fn check_acceleration(value: Vec3) -> Result<Vec3, FluidError> {
    check_vec("acceleration_m_s2", value, MAX_ACCELERATION_M_S2, "components within ±1e6 m/s²")
}
