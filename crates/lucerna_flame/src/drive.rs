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
        if self.acceleration_m_s2 > 0.0 {
            let push = Vec3::Y * self.acceleration_m_s2.min(1e6);
            fluid.add_push(self.position, self.reach_m.min(most_m), push)?;
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
        self.current_sources().iter().try_for_each(|source| source.add_to(fluid))?;
        self.stir(fluid)
    }
}
