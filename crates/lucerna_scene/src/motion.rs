//! What moves: a swing, a turn, or keyframes that fires and meshes follow together.

use crate::model::turn;
use glam::{Quat, Vec3};
use lucerna_flame::Pose;
use serde::{Deserialize, Serialize};

/// Something that moves; fires, meshes and the air name it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// What fires and meshes call it.
    pub name: String,
    /// How it moves.
    pub path: MotionPath,
}

/// How something moves, in simulated time. Poses are seen from where the scene places things.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MotionPath {
    /// It stays until the program moves it.
    Still,
    /// To and fro about an axis, as a pendulum.
    Swing {
        /// A point on the axis, m.
        pivot_m: [f32; 3],
        /// The axis, of any length above zero.
        axis: [f32; 3],
        /// Farthest from the middle, degrees.
        angle_deg: f32,
        /// Time of one swing to and fro, s.
        period_s: f32,
        /// Where in the swing it begins, 0 to 1 of a period; 0 is the middle.
        #[serde(default)]
        phase: f32,
    },
    /// Round and round about an axis.
    Turn {
        /// A point on the axis, m.
        pivot_m: [f32; 3],
        /// The axis; counter-clockwise seen against it.
        axis: [f32; 3],
        /// Time of one turn, s.
        period_s: f32,
    },
    /// From key to key, smoothly.
    Keys {
        /// When it is where, in the order of time.
        keys: Vec<MotionKey>,
        /// After the last key the first follows at once, again and again.
        #[serde(default)]
        repeats: bool,
    },
}

/// When something is where.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionKey {
    /// Simulated time, s.
    pub time_s: f32,
    /// How far it has moved, m.
    #[serde(default)]
    pub position_m: [f32; 3],
    /// How it is turned about the world's origin before that, degrees: about x, then y, then z.
    #[serde(default)]
    pub rotation_deg: [f32; 3],
}

impl MotionPath {
    /// Where things are at a time, s.
    #[must_use]
    pub fn pose(&self, time_s: f64) -> Pose {
        let about = |pivot: &[f32; 3], axis: &[f32; 3], angle: f64| {
            let axis = Vec3::from(*axis).normalize_or(Vec3::Y);
            Pose::about((*pivot).into(), Quat::from_axis_angle(axis, angle as f32))
        };
        let turns = |period_s: f32| (time_s / f64::from(period_s)).fract();
        match self {
            Self::Still => Pose::REST,
            Self::Swing { pivot_m, axis, angle_deg, period_s, phase } => {
                let way = (std::f64::consts::TAU * (turns(*period_s) + f64::from(*phase))).sin();
                about(pivot_m, axis, f64::from(angle_deg.to_radians()) * way)
            }
            Self::Turn { pivot_m, axis, period_s } => about(pivot_m, axis, std::f64::consts::TAU * turns(*period_s)),
            Self::Keys { keys, repeats } => between(keys, *repeats, time_s),
        }
    }
}

impl MotionPath {
    /// From when to when all poses are taken, s.
    pub(crate) fn times_s(&self) -> (f64, f64) {
        match self {
            Self::Still => (0.0, 0.0),
            Self::Swing { period_s, .. } | Self::Turn { period_s, .. } => (0.0, f64::from(*period_s)),
            Self::Keys { keys, .. } => {
                let time = |key: Option<&MotionKey>| key.map_or(0.0, |key| f64::from(key.time_s));
                (time(keys.first()), time(keys.last()))
            }
        }
    }
}

impl MotionKey {
    fn pose(&self) -> Pose {
        Pose { rotation: turn(self.rotation_deg), translation: self.position_m.into() }
    }
}

/// Positions on the Catmull-Rom spline through the keys, turns the shortest way from key to key.
fn between(keys: &[MotionKey], repeats: bool, time_s: f64) -> Pose {
    let [first, .., last] = keys else { return keys.first().map_or(Pose::REST, MotionKey::pose) };
    let (start, end) = (f64::from(first.time_s), f64::from(last.time_s));
    let time_s = match repeats {
        true => (start + (time_s - start).rem_euclid((end - start).max(1e-6))) as f32,
        false => time_s.clamp(start, end) as f32,
    };
    let next = keys.partition_point(|key| key.time_s <= time_s).clamp(1, keys.len() - 1);
    let (a, b) = (&keys[next - 1], &keys[next]);
    let span = (b.time_s - a.time_s).max(1e-6);
    let t = ((time_s - a.time_s) / span).clamp(0.0, 1.0);
    // The speed at a key is that from the one before to the one after; at the ends it is zero.
    let speed = |i: usize| match i.checked_sub(1).and_then(|before| Some((keys.get(before)?, keys.get(i + 1)?))) {
        Some((before, after)) => {
            (Vec3::from(after.position_m) - Vec3::from(before.position_m)) / (after.time_s - before.time_s).max(1e-6)
        }
        None => Vec3::ZERO,
    };
    let (p, q) = (Vec3::from(a.position_m), Vec3::from(b.position_m));
    let (u, v) = (speed(next - 1) * span, speed(next) * span);
    let translation = p + t * (u + t * (3.0 * (q - p) - 2.0 * u - v + t * (2.0 * (p - q) + u + v)));
    Pose { rotation: a.pose().rotation.slerp(b.pose().rotation, t).normalize(), translation }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(time_s: f32, x: f32, y_deg: f32) -> MotionKey {
        MotionKey { time_s, position_m: [x, 0.0, 0.0], rotation_deg: [0.0, y_deg, 0.0] }
    }

    #[test]
    fn a_swing_is_a_sine_about_its_pivot() {
        let path = MotionPath::Swing {
            pivot_m: [0.0, -0.5, 0.0],
            axis: [0.0, 0.0, 1.0],
            angle_deg: 30.0,
            period_s: 2.0,
            phase: 0.0,
        };
        let at = |time_s: f64| path.pose(time_s).point(Vec3::ZERO);
        assert_eq!(at(0.0), Vec3::ZERO);
        let farthest = Vec3::new(-0.25, 0.5 * 30.0_f32.to_radians().cos() - 0.5, 0.0);
        assert!(at(0.5).distance(farthest) < 1e-6 && at(1e6 + 0.5).distance(farthest) < 1e-6);
        assert!(at(1.5).distance(farthest * Vec3::new(-1.0, 1.0, 1.0)) < 1e-6);
        assert!(at(0.3).distance(Vec3::new(0.0, -0.5, 0.0)) - 0.5 < 1e-6);
    }

    #[test]
    fn keys_are_met_and_joined_smoothly() {
        let keys = vec![key(1.0, 0.0, 0.0), key(2.0, 1.0, 90.0), key(4.0, 1.5, 90.0), key(5.0, 0.0, 0.0)];
        for repeats in [false, true] {
            let path = MotionPath::Keys { keys: keys.clone(), repeats };
            for key in &keys[..3] {
                let pose = path.pose(f64::from(key.time_s));
                assert!((pose.translation.x - key.position_m[0]).abs() < 1e-5, "{pose:?}");
                assert!(pose.rotation.angle_between(key.pose().rotation) < 1e-3);
            }
            let x = |time_s: f64| path.pose(time_s).translation.x;
            let sharpest = (1001..4999)
                .map(|i| f64::from(i) * 1e-3)
                .map(|t| (x(t + 1e-3) - 2.0 * x(t) + x(t - 1e-3)).abs())
                .fold(0.0, f32::max);
            assert!(sharpest < 2e-5, "no kinks: {sharpest}");
        }
        let once = MotionPath::Keys { keys: keys.clone(), repeats: false };
        assert!(once.pose(99.0).translation.length() < 1e-6);
        let again = MotionPath::Keys { keys, repeats: true };
        assert!(again.pose(4.0 * 250.0 + 2.0).translation.distance(Vec3::X) < 1e-4);
    }
}
