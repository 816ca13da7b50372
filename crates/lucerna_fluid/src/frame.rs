//! A box that moves: the grid goes along with a torch that is swung, the air does not.

use glam::Vec3;

use crate::error::{FluidError, check, check_vec};
use crate::fluid::Fluid;
use crate::limits::MAX_DT_S;

/// Farthest that a box may lie from the world's origin, along each axis, m.
const FARTHEST_M: f32 = 1.0e6;

impl Fluid {
    /// Lets the box move with this velocity during the coming steps, m/s, components within
    /// ±100; zero, the start, along the axis of one cell. [`Fluid::origin`] moves on with each
    /// step, up to 1e6 m from the world's.
    ///
    /// All velocities stay those of the world, so that still air stays still: it enters in front
    /// and leaves behind. Walls go with the box, as does the air of a closed one; `wind`, and what
    /// [`Fluid::set_side_velocity`] gives, are the world's. Bodies have to be put where they are
    /// by [`Fluid::set_obstacles`] before each step, or they go with the box as well.
    ///
    /// # Errors
    /// A value that is not finite or out of range; nothing has changed then.
    pub fn set_frame_velocity(&mut self, velocity_m_s: Vec3) -> Result<(), FluidError> {
        self.settings.frame_m_s = check_frame(velocity_m_s, self.grid.cells)?;
        Ok(())
    }

    /// Lets the box move so that its low corner is at `origin` (components within ±1e6 m) after a
    /// step of `dt_s` seconds (above 0, up to 1e3), and go on with that velocity until told
    /// otherwise.
    ///
    /// # Errors
    /// A value that is not finite or out of range, or a place that only a box faster than
    /// [`Fluid::set_frame_velocity`] allows would reach; nothing has changed then.
    pub fn move_to(&mut self, origin: Vec3, dt_s: f32) -> Result<(), FluidError> {
        check_vec("origin", origin, FARTHEST_M, "components within ±1e6 m")?;
        check("dt_s", dt_s, f32::MIN_POSITIVE, MAX_DT_S, "above 0, up to 1e3 s")?;
        self.set_frame_velocity((origin - self.grid.origin) / dt_s)
    }

    /// Velocity of the box, m/s.
    #[must_use]
    pub fn frame_velocity(&self) -> Vec3 {
        self.settings.frame_m_s
    }

    /// Moves the box on.
    pub(crate) fn move_box(&mut self, dt_s: f32) {
        let way = self.settings.frame_m_s * dt_s;
        if way != Vec3::ZERO {
            self.grid.origin = (self.grid.origin + way).clamp(Vec3::splat(-FARTHEST_M), Vec3::splat(FARTHEST_M));
        }
    }
}

/// Refuses a velocity of the box that is not finite, too great, or along the axis of one cell.
pub(crate) fn check_frame(velocity_m_s: Vec3, cells: [usize; 3]) -> Result<Vec3, FluidError> {
    let field = "frame velocity";
    check_vec(field, velocity_m_s, 100.0, "components within ±100 m/s")?;
    for (component, cells) in velocity_m_s.to_array().into_iter().zip(cells) {
        if cells == 1 {
            check(field, component, 0.0, 0.0, "0 along the axis of one cell")?;
        }
    }
    Ok(velocity_m_s)
}
