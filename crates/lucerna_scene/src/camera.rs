//! Where the camera flies.

use crate::Scene;
use glam::Vec3;
use lucerna_frame::Camera;
use serde::{Deserialize, Serialize};

/// When the camera is where, and what it looks at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraKey {
    /// Simulated time, s.
    pub time_s: f32,
    /// Where the camera is, m.
    pub eye: [f32; 3],
    /// The point in the middle of the picture, m.
    pub target: [f32; 3],
}

impl Scene {
    /// The camera at a simulated time, s: on the Catmull-Rom spline through the keys of its path (Catmull and Rom 1974),
    /// before the first and after the last key at rest there; without a path always the same.
    #[must_use]
    pub fn camera_at(&self, time_s: f64) -> Camera {
        let keys = &self.camera_path;
        let [first, .., last] = keys.as_slice() else {
            let key = keys.first();
            return key.map_or(self.camera, |key| Camera { eye: key.eye, target: key.target, ..self.camera });
        };
        let time_s = (time_s as f32).clamp(first.time_s, last.time_s);
        let next = keys.partition_point(|key| key.time_s <= time_s).clamp(1, keys.len() - 1);
        let (from, to) = (keys[next - 1].time_s, keys[next].time_s);
        let t = (time_s - from) / (to - from).max(1e-6);
        let along = |of: fn(&CameraKey) -> [f32; 3]| {
            let at = |i: usize| Vec3::from(of(&keys[i]));
            // The speed at a key is that from the one before to the one after; at the ends it is zero.
            let speed = |i: usize| match (i.checked_sub(1), keys.get(i + 1)) {
                (Some(before), Some(after)) => {
                    let seconds = (after.time_s - keys[before].time_s).max(1e-6);
                    (Vec3::from(of(after)) - at(before)) * ((to - from) / seconds)
                }
                _ => Vec3::ZERO,
            };
            at(next - 1).hermite(speed(next - 1), at(next), speed(next), t).to_array()
        };
        Camera { eye: along(|key| key.eye), target: along(|key| key.target), ..self.camera }
    }
}

trait Hermite {
    fn hermite(self, speed: Self, to: Self, speed_there: Self, t: f32) -> Self;
}

impl Hermite for Vec3 {
    fn hermite(self, u: Vec3, q: Vec3, v: Vec3, t: f32) -> Vec3 {
        self + t * (u + t * (3.0 * (q - self) - 2.0 * u - v + t * (2.0 * (self - q) + u + v)))
    }
}
