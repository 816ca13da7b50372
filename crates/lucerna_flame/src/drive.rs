//! Flames in the air of `lucerna_fluid`: how it carries them, and how their roots drive it.

use crate::{Air, Flames, Source};
use glam::Vec3;
use lucerna_fluid::{Fluid, FluidError};

impl Air for Fluid {
    fn velocity(&self, point: Vec3) -> Vec3 {
        Fluid::velocity(self, point)
    }
    fn bounds(&self) -> (Vec3, Vec3) {
        (self.origin(), self.origin() + self.size_m())
    }
    fn carry(&self, points: &mut [Vec3], dt_s: f32) {
        self.advect_points(points, dt_s);
    }
}

/// How far a source reaches at most, as a share of the box's smallest side.
const MAX_REACH: f32 = 0.25;

impl Source {
    /// Adds the source to the coming step of the air.
    ///
    /// The paper pushes the one voxel that holds the root. Here the push fades linearly to zero at
    /// `reach_m` along each axis, so that a flame stays put when its root is not in the middle of
    /// a voxel or sways from one to the next, and finer grids do not weaken it. No source reaches
    /// farther than a quarter of the box's smallest side.
    ///
    /// # Errors
    /// When a number is outside what the air accepts.
    pub fn add_to(&self, fluid: &mut Fluid) -> Result<(), FluidError> {
        // A wide source must not cost a pass over all of a large box.
        let most_m = MAX_REACH * fluid.size_m().min_element();
        if self.heat_k_s > 0.0 {
            fluid.add_heat(self.position, self.radius_m.min(most_m), self.heat_k_s)?;
        }
        if self.acceleration_m_s2 <= 0.0 {
            return Ok(());
        }
        let cell = fluid.cell_size_m();
        let reach_m = self.reach_m.min(most_m);
        let reach = cell.max(Vec3::splat(reach_m));
        let low = ((self.position - reach - fluid.origin()) / cell).max(Vec3::ZERO);
        let high = (self.position + reach - fluid.origin()) / cell;
        let [nx, ny, nz] = fluid.cells();
        let range = |low: f32, high: f32, n: usize| low as usize..((high + 1.0).max(0.0) as usize).min(n);
        let ranges = [range(low.x, high.x, nx), range(low.y, high.y, ny), range(low.z, high.z, nz)];
        let (origin, cell_m) = (fluid.origin().to_array(), cell.to_array());
        let (position, reach) = (self.position.to_array(), reach.to_array());
        let centre = |axis: usize, index: usize| origin[axis] + cell_m[axis] * (index as f32 + 0.5);
        let tent =
            |axis: usize, index: usize| (1.0 - (centre(axis, index) - position[axis]).abs() / reach[axis]).max(0.0);
        let sum = |axis: usize| ranges[axis].clone().map(|index| tent(axis, index)).sum::<f32>();
        let total = sum(0) * sum(1) * sum(2);
        if total <= 0.0 {
            return Ok(());
        }
        // The same momentum on any grid: that of a cube of air with the edge `reach_m`.
        let each = self.acceleration_m_s2 * reach_m.powi(3) / (cell.x * cell.y * cell.z) / total;
        let [xs, ys, zs] = ranges.clone();
        for k in zs {
            for j in ys.clone() {
                let row = each * tent(1, j) * tent(2, k);
                for i in xs.clone() {
                    let push = row * tent(0, i);
                    if push > 0.0 {
                        let at = Vec3::new(centre(0, i), centre(1, j), centre(2, k));
                        fluid.add_acceleration(at, Vec3::Y * push.min(1e5))?;
                    }
                }
            }
        }
        Ok(())
    }
}

impl Flames {
    /// Moves the roots with the air and adds what they do to its coming step.
    ///
    /// # Errors
    /// When a number is outside what the air accepts.
    pub fn drive(&mut self, fluid: &mut Fluid) -> Result<(), FluidError> {
        self.sources(fluid);
        self.current_sources().iter().try_for_each(|source| source.add_to(fluid))
    }
}
