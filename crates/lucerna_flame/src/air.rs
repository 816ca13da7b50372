//! What a flame needs to know of the air.

use glam::Vec3;
use lucerna_fluid::OXYGEN_IN_AIR;

/// Temperature of air that says nothing of its own, K.
pub const ROOM_K: f32 = 293.15;

/// What is in the air at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gas {
    /// Temperature, K.
    pub temperature_k: f32,
    /// Mass fraction of fuel that has not burnt yet, 0 to 1.
    pub fuel: f32,
    /// Mass fraction of oxygen, 0 to 1.
    pub oxygen: f32,
}

impl Default for Gas {
    /// Air of [`ROOM_K`] without fuel.
    fn default() -> Self {
        Self { temperature_k: ROOM_K, fuel: 0.0, oxygen: OXYGEN_IN_AIR }
    }
}

/// Air that carries flames: a solver's grid, or any field of velocities.
pub trait Air: Sync {
    /// Velocity at a point, m/s.
    fn velocity(&self, point: Vec3) -> Vec3;

    /// Lowest and highest corner of the box of air, m. Particles stay inside.
    fn bounds(&self) -> (Vec3, Vec3);

    /// Distance over which what is in the air changes, m: the shortest edge of a grid's cells; zero where there is no
    /// such distance.
    fn cell_m(&self) -> f32 {
        0.0
    }

    /// What is in the air at points, as many as `out` has room for; by default nothing but air of [`ROOM_K`]. Flames
    /// that burn fuel in the air are drawn where there is more of it than burns, and unlit wicks catch fire where the
    /// air is hot.
    fn gas(&self, _points: &[Vec3], out: &mut [Gas]) {
        out.fill(Gas::default());
    }

    /// Moves points with the air for `dt_s` seconds; by default with the midpoint rule.
    fn carry(&self, points: &mut [Vec3], dt_s: f32) {
        for point in points {
            let middle = *point + self.velocity(*point) * (0.5 * dt_s);
            *point += self.velocity(middle) * dt_s;
        }
    }
}

/// Several airs, such as a box for each fire; any single [`Air`] is one of all numbers.
pub trait Airs: Sync {
    /// What each of them is.
    type Air: Air;

    /// The air of this number, which flames name by [`FlameSettings::air`](crate::FlameSettings::air). One that does
    /// not exist should be any other.
    fn air(&self, number: usize) -> &Self::Air;
}

impl<A: Air> Airs for A {
    type Air = A;

    fn air(&self, _number: usize) -> &A {
        self
    }
}

/// Air that moves with one velocity everywhere: for tests and previews.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformAir {
    /// Velocity, m/s.
    pub velocity_m_s: Vec3,
    /// Lowest corner of the box, m.
    pub low_m: Vec3,
    /// Highest corner of the box, m.
    pub high_m: Vec3,
}

impl Air for UniformAir {
    fn velocity(&self, _point: Vec3) -> Vec3 {
        self.velocity_m_s
    }
    fn bounds(&self) -> (Vec3, Vec3) {
        (self.low_m, self.high_m)
    }
}

/// The point of the box nearest to `point`; a point that is not a number goes to `fallback`.
pub(crate) fn keep_inside(point: Vec3, (low, high): (Vec3, Vec3), fallback: Vec3) -> Vec3 {
    if point.is_finite() { point.clamp(low, high) } else { fallback.clamp(low, high) }
}
