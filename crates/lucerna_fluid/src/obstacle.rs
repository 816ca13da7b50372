//! Solid bodies in the air: what a caller describes, and what a step makes of it.

mod fill;
mod shape;
mod solids;

use std::sync::Arc;

use glam::{Quat, Vec3};

use crate::error::{FluidError, check, check_vec};
use crate::fluid::Fluid;
use shape::Shape;
pub(crate) use solids::{SavedSolids, Solids};

/// Most obstacles in a box.
pub const MAX_OBSTACLES: usize = 65_534;

/// A solid body: where it is, how its surface moves, and whether it holds the air that touches
/// it. Cells whose centres lie inside it are solid.
///
/// ```
/// use lucerna_fluid::{Fluid, Obstacle, Sides, Vec3};
///
/// # fn main() -> Result<(), lucerna_fluid::FluidError> {
/// let mut fluid = Fluid::builder([16; 3]).sides(Sides::OPEN).build()?;
/// let mut at = Vec3::new(0.3, 0.5, 0.5);
/// let velocity = Vec3::new(0.5, 0.0, 0.0);
/// for _ in 0..20 {
///     fluid.set_obstacles(&[Obstacle::sphere(at, 0.15).moving(velocity)])?;
///     fluid.step(0.02)?;
///     at += velocity * 0.02;
/// }
/// // The air before it is pushed along.
/// assert!(fluid.velocity(at + Vec3::X * 0.2).x > 0.1);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Obstacle {
    shape: Shape,
    velocity_m_s: Vec3,
    spin_rad_s: Vec3,
    about: Vec3,
    is_slippery: bool,
}

impl Obstacle {
    fn new(shape: Shape, about: Vec3) -> Self {
        Self { shape, velocity_m_s: Vec3::ZERO, spin_rad_s: Vec3::ZERO, about, is_slippery: false }
    }

    /// A ball; radius above 0, up to 1e6 m.
    #[must_use]
    pub fn sphere(centre: Vec3, radius_m: f32) -> Self {
        Self::new(Shape::Capsule { from: centre, to: centre, radius_m }, centre)
    }

    /// A box with edges `size_m` (each above 0, up to 1e6 m) about its centre, turned by `rotation`.
    #[must_use]
    pub fn cuboid(centre: Vec3, size_m: Vec3, rotation: Quat) -> Self {
        Self::new(Shape::Cuboid { centre, size_m, rotation }, centre)
    }

    /// All that is nearer than `radius_m` (above 0, up to 1e6) to the line between two points.
    #[must_use]
    pub fn capsule(from: Vec3, to: Vec3, radius_m: f32) -> Self {
        Self::new(Shape::Capsule { from, to, radius_m }, 0.5 * (from + to))
    }

    /// A round bar between two different points, with flat ends; radius above 0, up to 1e6 m.
    #[must_use]
    pub fn cylinder(from: Vec3, to: Vec3, radius_m: f32) -> Self {
        Self::new(Shape::Cylinder { from, to, radius_m }, 0.5 * (from + to))
    }

    /// Any shape, by its signed distance: negative inside. Only the sign counts, and whether the
    /// distance of every cell's centre is so great that the body lies wholly outside the box.
    #[must_use]
    pub fn from_distance(distance_m: impl Fn(Vec3) -> f32 + Send + Sync + 'static) -> Self {
        Self::new(Shape::Distance(Arc::new(distance_m)), Vec3::ZERO)
    }

    /// Solid cells, one flag a cell of the box, x fastest.
    #[must_use]
    pub fn from_voxels(solid: impl Into<Arc<[bool]>>) -> Self {
        Self::new(Shape::Voxels(solid.into()), Vec3::ZERO)
    }

    /// Its surface moves with this velocity, m/s; components within ±100. The fluid does not
    /// move the body: where it is next is said by the next [`Fluid::set_obstacles`].
    #[must_use]
    pub fn moving(self, velocity_m_s: Vec3) -> Self {
        Self { velocity_m_s, ..self }
    }

    /// It turns about a point with this angular velocity, rad/s; components within ±1e4.
    #[must_use]
    pub fn spinning(self, spin_rad_s: Vec3, about: Vec3) -> Self {
        Self { spin_rad_s, about, ..self }
    }

    /// Air slides along it without friction. Otherwise air that touches it moves with it.
    #[must_use]
    pub fn slippery(self) -> Self {
        Self { is_slippery: true, ..self }
    }

    /// Velocity of the body at a point, clamped to ±300 m/s.
    pub(crate) fn velocity(&self, point: Vec3) -> Vec3 {
        let velocity = self.velocity_m_s + self.spin_rad_s.cross(point - self.about);
        velocity.clamp(Vec3::splat(-300.0), Vec3::splat(300.0))
    }

    fn check(&self) -> Result<(), FluidError> {
        check_vec("obstacle velocity", self.velocity_m_s, 100.0, "components within ±100 m/s")?;
        check_vec("obstacle spin", self.spin_rad_s, 1.0e4, "components within ±1e4 rad/s")?;
        check_vec("obstacle centre of rotation", self.about, 1.0e7, "components within ±1e7 m")?;
        self.shape.check()
    }
}

fn check_place(point: Vec3) -> Result<Vec3, FluidError> {
    check_vec("obstacle position", point, 1.0e7, "components within ±1e7 m")
}

fn check_length(value: f32) -> Result<f32, FluidError> {
    check("obstacle size", value, f32::MIN_POSITIVE, 1.0e6, "above 0, up to 1e6 m")
}

impl Fluid {
    /// Puts solid bodies into the box, in place of those that were there; none at all takes them
    /// away. Call it anew before each step for bodies that move: with as many bodies as before
    /// it takes no new memory, and costs about as much as one pass over the cells. Where bodies
    /// overlap, the later one counts.
    ///
    /// The pressure is then found by conjugate gradients. What a moving body displaces has to go
    /// somewhere: in parts of the air without a way to an open side the mean of what does not
    /// balance is left out. [`Fluid::save`] keeps them as the cells
    /// that they cover.
    ///
    /// # Errors
    /// A value that is not finite or out of range, a distance that is not a number, a body that
    /// lies wholly outside the box, or flags for another number of cells; nothing has changed then.
    pub fn set_obstacles(&mut self, obstacles: &[Obstacle]) -> Result<(), FluidError> {
        if obstacles.is_empty() {
            self.solids = None;
            return Ok(());
        }
        check("number of obstacles", obstacles.len() as f32, 0.0, MAX_OBSTACLES as f32, "up to 65534")?;
        for obstacle in obstacles {
            obstacle.check()?;
        }
        let mut solids = self.solids.take().unwrap_or_else(|| Box::new(Solids::new(&self.grid)));
        let result = solids.update(&self.grid, obstacles);
        if result.is_ok() || solids.is_in_use() {
            self.solids = Some(solids);
        }
        result
    }

    /// The bodies in the box.
    #[must_use]
    pub fn obstacles(&self) -> &[Obstacle] {
        self.solids.as_ref().map_or(&[], |solids| solids.obstacles())
    }

    /// Solid flags by cell, x fastest; empty without obstacles.
    #[must_use]
    pub fn solid_cells(&self) -> &[bool] {
        self.solids.as_ref().map_or(&[], |solids| solids.mask().solid())
    }
}
