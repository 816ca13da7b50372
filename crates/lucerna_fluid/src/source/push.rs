//! Pushes that are spread over the cells around a point.

use std::ops::Range;

use glam::Vec3;

use super::add::{add_clamped, check_acceleration, check_ball};
use super::apply::faces;
use crate::error::FluidError;
use crate::fluid::Fluid;
use crate::limits::{MAX_ACCELERATION_M_S2, MAX_AXIS_CELLS};

/// Cells along an axis, and their shares of a push.
struct Tent {
    cells: Range<usize>,
    shares: [f32; MAX_AXIS_CELLS],
}

impl Fluid {
    /// Pushes the air around `point` during the coming step with the momentum of a cube of air of
    /// the edge `reach_m` (above 0, up to 1e6) that is accelerated by `acceleration_m_s2` (components
    /// within ±1e6), whatever the grid. The push falls linearly to zero at `reach_m`, or a cell's
    /// edge if that is more, along each axis. All of it goes to cells inside the box; where none is
    /// within reach it is ignored.
    ///
    /// ```
    /// use lucerna_fluid::{Fluid, Vec3};
    ///
    /// let mut fluid = Fluid::builder([8, 8, 8]).size_m(Vec3::ONE).build()?;
    /// fluid.add_push(Vec3::new(0.5, 0.3, 0.5), 0.2, Vec3::new(0.0, 10.0, 0.0))?;
    /// fluid.step(0.01)?;
    /// assert!(fluid.velocity(Vec3::new(0.5, 0.3, 0.5)).y > 0.0);
    /// # Ok::<(), lucerna_fluid::FluidError>(())
    /// ```
    ///
    /// # Errors
    /// A value that is not finite or out of range; nothing has changed then.
    pub fn add_push(&mut self, point: Vec3, reach_m: f32, acceleration_m_s2: Vec3) -> Result<(), FluidError> {
        check_ball(point, reach_m)?;
        let acceleration = check_acceleration(acceleration_m_s2)?;
        let tents = [0, 1, 2].map(|axis| self.tent(axis, point[axis], reach_m));
        let total: f32 = tents.iter().map(|tent| tent.shares[..tent.cells.len()].iter().sum::<f32>()).product();
        if total <= 0.0 {
            return Ok(());
        }
        let volume = self.grid.cell_m.into_iter().product::<f32>();
        // Each face of a cell takes half of its push.
        let cells = (reach_m * reach_m * reach_m / volume / total).min(1.0e20);
        let half = (0.5 * acceleration * cells).to_array();
        let [nx, ny, _] = self.grid.cells;
        let [xs, ys, zs] = &tents;
        for (k, z) in zs.cells.clone().zip(zs.shares) {
            for (j, y) in ys.cells.clone().zip(ys.shares) {
                let row = nx * (j + ny * k);
                for (axis, half) in half.into_iter().enumerate() {
                    // A push too great is cut.
                    let push = (half * (y * z)).clamp(-MAX_ACCELERATION_M_S2, MAX_ACCELERATION_M_S2);
                    if push != 0.0 {
                        self.push_row(axis, row, xs, push);
                    }
                }
            }
        }
        Ok(())
    }

    /// Adds to both faces across `axis` of the cells of a row, which starts at the cell `row`.
    fn push_row(&mut self, axis: usize, row: usize, xs: &Tent, push: f32) {
        let start = row + xs.cells.start;
        if axis == 0 {
            for (cell, share) in (start..).zip(&xs.shares[..xs.cells.len()]) {
                for at in faces(&self.grid, axis, cell) {
                    let values = self.accelerations(axis);
                    values[at] = add_clamped(values[at], push * share, MAX_ACCELERATION_M_S2);
                }
            }
            return;
        }
        for at in faces(&self.grid, axis, start) {
            let values = &mut self.accelerations(axis)[at..][..xs.cells.len()];
            for (value, share) in values.iter_mut().zip(&xs.shares) {
                *value = add_clamped(*value, push * share, MAX_ACCELERATION_M_S2);
            }
        }
    }

    /// What falls linearly from 1 at a place to 0 at `reach_m`, at the centres of cells.
    fn tent(&self, axis: usize, place: f32, reach_m: f32) -> Tent {
        let (origin, cell_m) = (self.grid.origin[axis], self.grid.cell_m[axis]);
        let reach = reach_m.max(cell_m);
        // Numbers beyond any cell become the last one, not-a-numbers the first.
        let cell = |place: f32| ((place - origin) / cell_m).max(0.0) as usize;
        let end = cell(place + reach).saturating_add(1).min(self.grid.cells[axis]);
        let cells = cell(place - reach).min(end)..end;
        let mut shares = [0.0; MAX_AXIS_CELLS];
        for (share, index) in shares.iter_mut().zip(cells.clone()) {
            let centre = origin + cell_m * (index as f32 + 0.5);
            *share = (1.0 - (centre - place).abs() / reach).max(0.0);
        }
        Tent { cells, shares }
    }
}
