//! Figures of the flow as a whole: energy, vorticity, flow through the sides, length of a step.
//!
//! Sums are taken in `f64`, plane by plane, in a fixed order. What returns a number allocates
//! nothing.

use glam::Vec3;

use crate::advect::side_squares;
use crate::air::AIR_HEAT_CAPACITY_J_KG_K;
use crate::error::{FluidError, check};
use crate::field::Around;
use crate::fluid::Fluid;
use crate::lanes::{scan, sum};
use crate::limits::{BUOYANCY_RATIO, GRAVITY_M_S2, MAX_DT_S};
use crate::pressure::{divergence_plane, slices};
use crate::sides::Side;

impl Fluid {
    /// Mean kinetic energy per mass over the box, m²/s²; faces on its sides count half.
    #[must_use]
    pub fn mean_kinetic_energy_m2_s2(&self) -> f64 {
        let squares = |axis: usize| {
            let field = &self.state.velocity[axis];
            scan(self.grid.exec.simd, &field.data).squares - 0.5 * side_squares(field, axis)
        };
        0.5 * (squares(0) + squares(1) + squares(2)) / self.grid.count() as f64
    }

    /// Divergence of the present velocity by cell, 1/s; x fastest. Allocates.
    #[must_use]
    pub fn divergence(&self) -> Vec<f32> {
        let mut out = vec![0.0; self.grid.count()];
        for (k, plane) in out.chunks_exact_mut(self.grid.plane()).enumerate() {
            divergence_plane(&self.grid, slices(&self.state.velocity), k, plane);
        }
        out
    }

    /// Vorticity, the curl of the velocity, at the centre of each cell, 1/s; x fastest. Slopes
    /// are taken between the centres of the cells on either side, and at the sides of the box
    /// between the last two; periodic axes go round. Allocates.
    #[must_use]
    pub fn vorticity(&self) -> Vec<Vec3> {
        let [nx, ny, nz] = self.grid.cells;
        let mut out = Vec::with_capacity(self.grid.count());
        for k in 0..nz {
            for j in 0..ny {
                out.extend((0..nx).map(|i| self.cell_vorticity([i, j, k])));
            }
        }
        out
    }

    /// Vorticity at a point, 1/s, trilinear between the cells' centres. Outside the box, the
    /// value at the nearest place inside; along a periodic axis the box repeats.
    #[must_use]
    pub fn vorticity_at(&self, point: Vec3) -> Vec3 {
        let at = self.grid.cells_from_point(point);
        let at = at.map(|at| at - 0.5);
        Around::new(at, self.grid.cells, self.grid.periods()).blend(|cell| self.cell_vorticity(cell))
    }

    /// Mean enstrophy over the box, half the squared vorticity, 1/s².
    #[must_use]
    pub fn mean_enstrophy_per_s2(&self) -> f64 {
        let [nx, ny, nz] = self.grid.cells;
        let mut total = 0.0;
        for k in 0..nz {
            let mut plane = 0.0;
            for j in 0..ny {
                for i in 0..nx {
                    plane += f64::from(self.cell_vorticity([i, j, k]).length_squared());
                }
            }
            total += plane;
        }
        0.5 * total / self.grid.count() as f64
    }

    /// Heat that the air holds above ambient, kJ: the sum over the cells of density times heat
    /// capacity ([`crate::AIR_HEAT_CAPACITY_J_KG_K`]) times excess temperature times volume.
    #[must_use]
    pub fn total_heat_kj(&self) -> f64 {
        let air = self.air();
        let planes = self.state.temperature.data.chunks_exact(self.grid.plane());
        let sums = planes.map(|plane| {
            plane.iter().map(|kelvin| f64::from(air.density_kg_m3(*kelvin)) * f64::from(*kelvin)).sum::<f64>()
        });
        1.0e-3 * f64::from(AIR_HEAT_CAPACITY_J_KG_K) * self.grid.cell_volume_m3() * sums.sum::<f64>()
    }

    /// Volume that leaves through each side of the box, by axis and end, m³/s; negative where
    /// more comes in. Their sum is the expansion inside.
    #[must_use]
    pub fn side_flows_m3_s(&self) -> [[f64; 2]; 3] {
        let edges = self.grid.cell_m.map(f64::from);
        std::array::from_fn(|axis| {
            let field = &self.state.velocity[axis];
            let area = edges[(axis + 1) % 3] * edges[(axis + 2) % 3];
            let [nx, ny, nz] = field.counts;
            std::array::from_fn(|end| {
                let last = if end == 0 { 0 } else { field.counts[axis] - 1 };
                let rows = |first: usize, count: usize| sum(&field.data[first..first + count]);
                let speeds: f64 = match axis {
                    0 => field.data.chunks_exact(nx).map(|row| f64::from(row[last])).sum(),
                    1 => (0..nz).map(|k| rows(nx * (last + ny * k), nx)).sum(),
                    _ => rows(nx * ny * last, nx * ny),
                };
                if end == 0 { -area * speeds } else { area * speeds }
            })
        })
    }

    /// The longest step, s, in which the air crosses no more than `cfl` cells (0.001 to 1000)
    /// along any axis, at its present speed and speeding up as the present temperatures make it.
    /// Up to 1e3 s. No step is too long for a [`Fluid::step`] to be stable: advection traces
    /// back or divides itself, and viscosity, conduction and cooling are implicit or exact. Long
    /// ones lose accuracy.
    ///
    /// # Errors
    /// A value that is not finite or out of range.
    pub fn dt_for_cfl(&self, cfl: f32) -> Result<f32, FluidError> {
        check("cfl", cfl, 1.0e-3, 1.0e3, "0.001 to 1000")?;
        let hottest = scan(self.grid.exec.simd, &self.state.temperature.data).greatest() / self.settings.ambient_k;
        let lift = [0.0, GRAVITY_M_S2 * hottest.min(BUOYANCY_RATIO.1), 0.0];
        let mut dt_s = MAX_DT_S;
        for (axis, lift) in lift.into_iter().enumerate() {
            let speed = scan(self.grid.exec.simd, &self.state.velocity[axis].data).greatest();
            let way = cfl * self.grid.cell_m[axis];
            // Positive root of `speed dt + lift dt² / 2 = way`, in the form that loses no digits.
            let root = (speed * speed + 2.0 * lift * way).sqrt();
            dt_s = dt_s.min(2.0 * way / (speed + root).max(1.0e-30));
        }
        Ok(dt_s)
    }

    /// Velocity component `axis` at the centre of a cell.
    #[inline(always)]
    fn centre(&self, axis: usize, [i, j, k]: [usize; 3]) -> f32 {
        let field = &self.state.velocity[axis];
        let [nx, ny, _] = field.counts;
        let low = i + nx * (j + ny * k);
        0.5 * (field.data[low] + field.data[low + [1, nx, nx * ny][axis]])
    }

    #[inline(always)]
    fn cell_vorticity(&self, cell: [usize; 3]) -> Vec3 {
        curl(|of, along| {
            let (mut low, mut high) = (cell, cell);
            let (count, index) = (self.grid.cells[along], cell[along]);
            let mut cells = 2;
            if self.grid.sides[along][0] == Side::Periodic {
                (low[along], high[along]) = ((index + count - 1) % count, (index + 1) % count);
            } else {
                (low[along], high[along]) = (index.saturating_sub(1), (index + 1).min(count - 1));
                cells = (high[along] - low[along]).max(1);
            }
            (self.centre(of, high) - self.centre(of, low)) / (cells as f32 * self.grid.cell_m[along])
        })
    }
}

/// The curl from the slopes of component `of` along an axis.
#[inline(always)]
fn curl(slope: impl Fn(usize, usize) -> f32) -> Vec3 {
    Vec3::new(slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1))
}
