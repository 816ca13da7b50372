//! Flames that are carried about: their roots move, the air does not, but for what the wick drags along.

use crate::flame::Flame;
use crate::random::Fnv;
use crate::roots::Roots;
use crate::{Air, Centreline, FlameError, Flames};
use glam::{Quat, Vec3};
use lucerna_fluid::{Fluid, FluidError};
use serde::{Deserialize, Serialize};

/// Roots that move faster have jumped, m/s: their flame goes with them, and the air stays as it was.
const FASTEST_M_S: f32 = 30.0;
/// Time in which a wick takes the air about its roots along, s: a few widths of a wick at the speed of a hand.
const DRAG_S: f32 = 0.05;
/// Most that a wick pushes the air, m/s^2.
const MOST_PUSH_M_S2: f32 = 1e4;

/// Where something that moves is, seen from where it rests: turned about the world's origin, then moved.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// The turn, a unit quaternion.
    pub rotation: Quat,
    /// How far it is moved after that, m.
    pub translation: Vec3,
}

impl Default for Pose {
    fn default() -> Self {
        Self::REST
    }
}

impl Pose {
    /// Where the scene says that it rests.
    pub const REST: Self = Self { rotation: Quat::IDENTITY, translation: Vec3::ZERO };

    /// Turned about a point.
    #[must_use]
    pub fn about(pivot: Vec3, rotation: Quat) -> Self {
        Self { rotation, translation: pivot - rotation * pivot }
    }

    /// Where a point is that rests at `point`.
    #[must_use]
    pub fn point(&self, point: Vec3) -> Vec3 {
        self.rotation * point + self.translation
    }

    /// The pose a share of the way from this one to another, the shorter way round.
    #[must_use]
    pub fn towards(&self, other: &Self, share: f32) -> Self {
        if share >= 1.0 {
            return *other;
        }
        Self {
            rotation: self.rotation.slerp(other.rotation, share).normalize(),
            translation: self.translation.lerp(other.translation, share),
        }
    }

    /// Whether all numbers are finite, positions within 1e6 m, and the turn is one.
    #[must_use]
    pub fn is_allowed(&self) -> bool {
        self.rotation.is_normalized() && self.translation.abs().max_element() <= 1e6
    }

    fn centreline(&self, rest: &Centreline) -> Centreline {
        match rest {
            Centreline::Point(point) => Centreline::Point(self.point(*point)),
            Centreline::Line(line) => Centreline::Line(line.iter().map(|point| self.point(*point)).collect()),
        }
    }

    pub(crate) fn hash(&self, fnv: &mut Fnv) {
        self.rotation.to_array().into_iter().for_each(|x| fnv.float(x));
        fnv.point(self.translation);
    }
}

/// Where a flame is, and how fast its lead roots move.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Carried {
    pub(crate) pose: Pose,
    /// Of each lead root, m/s; none while it stands still.
    speeds: Vec<Vec3>,
}

impl Carried {
    /// How fast a lead root moves, m/s.
    pub(crate) fn speed(&self, lead: usize) -> Vec3 {
        self.speeds.get(lead).copied().unwrap_or(Vec3::ZERO)
    }
}

impl Flame {
    /// Moves the roots to a pose of the wick, on the way there during the coming step of `dt_s` seconds.
    pub(crate) fn place(&mut self, pose: Pose, dt_s: f32) {
        let speeds = &mut self.carried.speeds;
        speeds.clear();
        self.chains.set_ways(std::iter::empty());
        if pose == self.carried.pose {
            return;
        }
        let s = &self.settings.skeletons;
        let roots = Roots::place(&pose.centreline(&self.centreline), s.slices, s.width_m);
        let ways = roots.leads.iter().zip(&self.roots.leads).map(|(new, old)| new.position - old.position);
        speeds.extend(ways.map(|way| way / dt_s.max(1e-6)));
        if speeds.iter().any(|speed| speed.length() > FASTEST_M_S) {
            speeds.clear();
            let way = roots.middle_and_length().0 - self.roots.middle_and_length().0;
            self.chains.carry_along(way);
        } else {
            let places = |roots: &Roots| -> Vec<Vec3> {
                let rim = roots.peripherals.iter().map(|root| root.position);
                roots.leads.iter().map(|root| root.position).chain(rim).collect()
            };
            self.chains.set_ways(places(&roots).into_iter().zip(places(&self.roots)).map(|(new, old)| new - old));
        }
        self.carried.pose = pose;
        self.roots = roots;
    }

    /// Takes the air about moving roots along, within a twentieth of a second.
    pub(crate) fn stir(&self, fluid: &mut Fluid) -> Result<(), FluidError> {
        let reach_m = (2.0 * self.settings.skeletons.width_m).min(0.25 * fluid.size_m().min_element());
        let (low, high) = Air::bounds(fluid);
        for (speed, lead) in self.carried.speeds.iter().zip(&self.roots.leads) {
            let at = lead.position.clamp(low, high);
            let push = (*speed - Fluid::velocity(fluid, at)) / DRAG_S;
            fluid.add_push(at, reach_m, push.clamp_length_max(MOST_PUSH_M_S2))?;
        }
        Ok(())
    }
}

impl Flames {
    /// Moves a flame, by its number in the settings, to a pose of its wick: it is on the way there during the coming
    /// step of `dt_s` seconds, which gives its roots their velocity. What has been emitted stays behind with the air,
    /// so that a flame that is carried leans and trails. Roots that would need more than 30 m/s jump, and their flame
    /// with them.
    ///
    /// # Errors
    /// When there is no such flame, or the pose is not allowed ([`Pose::is_allowed`]).
    pub fn place(&mut self, flame: usize, pose: Pose, dt_s: f32) -> Result<(), FlameError> {
        if !pose.is_allowed() {
            return Err(FlameError::NotFinite {
                field: "pose",
                index: flame,
                value: f64::from(pose.rotation.length()),
            });
        }
        let allowed = "the number of a flame";
        let found = self.flames.get_mut(flame).ok_or(FlameError::Count { field: "flame", count: flame, allowed })?;
        found.place(pose, dt_s);
        Ok(())
    }

    /// Where a flame's wick is; its rest where there is no such flame.
    #[must_use]
    pub fn pose(&self, flame: usize) -> Pose {
        self.flames.get(flame).map_or(Pose::REST, |flame| flame.carried.pose)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FlameSettings, UniformAir, WickShape};

    fn still() -> UniformAir {
        UniformAir { velocity_m_s: Vec3::Y, low_m: Vec3::splat(-9.0), high_m: Vec3::splat(9.0) }
    }

    /// A flame that is moved at a speed in air that rises by 1 m/s.
    fn carried(speed: f32, seconds: f32) -> Flames {
        let wick = WickShape::Polyline { points: vec![[-0.05, 0.0, 0.0], [0.05, 0.0, 0.0]], radius_m: 0.005 };
        let mut flames = Flames::new(vec![FlameSettings::new(wick)], 1).expect("a flame");
        let dt = 1.0 / 60.0;
        for step in 1..=(seconds * 60.0) as usize {
            let pose = Pose { translation: Vec3::Z * (speed * step as f32 * dt), ..Pose::REST };
            flames.place(0, pose, dt).expect("placed");
            flames.sources(&still());
            flames.step(&still(), dt);
        }
        flames.build();
        flames
    }

    fn lean_deg(flames: &Flames) -> f32 {
        let flame = &flames.flames[0];
        let n = flame.net.len() / flame.roots.peripherals.len();
        let tip = flame.net.chunks_exact(n).map(|row| Vec3::from(row[0])).sum::<Vec3>();
        let way = tip / flame.roots.peripherals.len() as f32 - flame.roots.middle_and_length().0;
        way.z.atan2(way.y).to_degrees()
    }

    #[test]
    fn a_flame_that_is_carried_trails_by_the_ratio_of_the_speeds() {
        for speed in [0.0, 0.3, 1.0] {
            let flames = carried(speed, 1.0);
            let (lean, expected) = (lean_deg(&flames), -speed.atan().to_degrees());
            println!("at {speed} m/s through air that rises by 1 m/s: {lean:.1} degrees, expected {expected:.1}");
            assert!((lean - expected).abs() < 1.5);
            let middle = flames.flames[0].roots.middle_and_length().0;
            assert!((middle.z - speed).abs() < 1e-3, "{middle}");
        }
    }

    #[test]
    fn a_jump_takes_the_flame_along() {
        let mut flames = carried(0.0, 1.0);
        let before: Vec<Vec3> = flames.flames[0].chains.particles(0).collect();
        flames.place(0, Pose { translation: Vec3::X * 5.0, ..Pose::REST }, 1.0 / 60.0).expect("placed");
        let after: Vec<Vec3> = flames.flames[0].chains.particles(0).collect();
        for (a, b) in before.iter().zip(&after).skip(1) {
            assert!((*b - *a - Vec3::X * 5.0).length() < 1e-5);
        }
    }

    #[test]
    fn however_a_wick_is_turned_its_rim_runs_clockwise_from_above() {
        let mut flames = carried(0.0, 0.1);
        for i in 0..500 {
            let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.1 * i as f32, 0.37 * i as f32, 0.23 * i as f32);
            flames.place(0, Pose::about(Vec3::new(0.0, -0.3, 0.1), turn), 0.01).expect("placed");
            flames.sources(&still());
            flames.step(&still(), 0.01);
            flames.build();
            let rim = &flames.flames[0].roots.peripherals;
            let from = rim[0].position;
            let area: f32 = rim.windows(2).map(|w| (w[0].position - from).cross(w[1].position - from).y).sum();
            assert!(area < 0.0, "turn {i}: {area}");
            assert!(flames.vertices().iter().all(|v| Vec3::from(v.position).is_finite()));
        }
    }

    #[test]
    fn impossible_poses_are_refused() {
        let mut flames = carried(0.0, 0.1);
        let far = Pose { translation: Vec3::X * f32::NAN, ..Pose::REST };
        assert!(flames.place(0, far, 0.1).is_err());
        assert!(flames.place(0, Pose { rotation: Quat::from_xyzw(0.0, 0.0, 0.0, 2.0), ..Pose::REST }, 0.1).is_err());
        assert!(flames.place(7, Pose::REST, 0.1).is_err());
    }
}
