//! A camera that is moved around its target with the mouse.

use glam::{Quat, Vec2, Vec3};
use lucerna::frame::Camera;

/// Turn for each point that the mouse is dragged, rad.
const TURN: f32 = 0.006;
/// Share of the distance for each point that the wheel is turned.
const ZOOM: f32 = 0.0015;
/// Largest angle above and below the horizon, rad.
const MOST_PITCH: f32 = 1.53;
/// Nearest and farthest distance from the target, m.
const DISTANCE_M: std::ops::RangeInclusive<f32> = 0.02..=500.0;

/// Turns the camera around its target; `drag` is in points, y down.
pub(super) fn orbit(camera: &mut Camera, drag: Vec2) {
    let (target, offset) = target_and_offset(camera);
    let distance = offset.length();
    let yaw = offset.x.atan2(offset.z) - drag.x * TURN;
    let pitch = ((offset.y / distance).clamp(-1.0, 1.0).asin() + drag.y * TURN).clamp(-MOST_PITCH, MOST_PITCH);
    let direction = Quat::from_rotation_y(yaw) * Quat::from_rotation_x(-pitch) * Vec3::Z;
    camera.eye = (target + distance * direction).into();
}

/// Moves eye and target in the picture's plane so that the target follows the mouse; `drag` is in points, y down.
pub(super) fn pan(camera: &mut Camera, drag: Vec2, height_points: f32) {
    let (target, offset) = target_and_offset(camera);
    let world_from_view = camera.view_from_world().transpose();
    let right = world_from_view.x_axis.truncate();
    let up = world_from_view.y_axis.truncate();
    let per_point = 2.0 * offset.length() * (camera.fov_y_deg.to_radians() / 2.0).tan() / height_points.max(1.0);
    let shift = per_point * (up * drag.y - right * drag.x);
    camera.target = (target + shift).into();
    camera.eye = (target + shift + offset).into();
}

/// Moves the eye towards the target (`scroll` above 0) or away from it.
pub(super) fn zoom(camera: &mut Camera, scroll: f32) {
    let (target, offset) = target_and_offset(camera);
    let distance = offset.length();
    let wanted = (distance * (-scroll * ZOOM).exp()).clamp(*DISTANCE_M.start(), *DISTANCE_M.end());
    camera.eye = (target + offset * (wanted / distance)).into();
}

/// The target and where the eye is from there, never at distance zero.
fn target_and_offset(camera: &Camera) -> (Vec3, Vec3) {
    let target = Vec3::from(camera.target);
    let offset = Vec3::from(camera.eye) - target;
    (target, if offset.length() < *DISTANCE_M.start() { Vec3::Z * *DISTANCE_M.start() } else { offset })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera { eye: [1.0, 2.0, 3.0], target: [0.5, 0.5, 0.0], ..Camera::default() }
    }

    fn distance(camera: &Camera) -> f32 {
        Vec3::from(camera.eye).distance(camera.target.into())
    }

    #[test]
    fn orbiting_keeps_target_and_distance() {
        let mut moved = camera();
        orbit(&mut moved, Vec2::new(120.0, -40.0));
        assert_eq!(moved.target, camera().target);
        assert!((distance(&moved) - distance(&camera())).abs() < 1e-5);
        orbit(&mut moved, Vec2::new(-120.0, 40.0));
        assert!(Vec3::from(moved.eye).distance(camera().eye.into()) < 1e-4);
    }

    #[test]
    fn orbiting_never_passes_the_poles() {
        for drag in [1e5, -1e5] {
            let mut moved = camera();
            orbit(&mut moved, Vec2::new(0.0, drag));
            let direction = (Vec3::from(moved.eye) - Vec3::from(moved.target)).normalize();
            assert!(direction.y.abs() < 0.9999 && direction.is_finite());
            assert_eq!(direction.y > 0.0, drag > 0.0);
        }
    }

    #[test]
    fn panning_moves_the_target_with_the_mouse() {
        let mut moved = camera();
        pan(&mut moved, Vec2::new(30.0, -20.0), 600.0);
        assert!((distance(&moved) - distance(&camera())).abs() < 1e-5);
        // Where the old target is now drawn, in points from the middle of a picture 600 points high.
        let view = moved.view_from_world().transform_point3(camera().target.into());
        let scale = 300.0 / (moved.fov_y_deg.to_radians() / 2.0).tan() / -view.z;
        assert!((view.x * scale - 30.0).abs() < 0.05 && (view.y * scale - 20.0).abs() < 0.05);
    }

    #[test]
    fn zooming_stops_before_the_target_and_far_away() {
        let mut moved = camera();
        zoom(&mut moved, 1e6);
        assert!((distance(&moved) - 0.02).abs() < 1e-5);
        zoom(&mut moved, -1e6);
        assert!((distance(&moved) - 500.0).abs() < 1e-2);
    }

    #[test]
    fn a_camera_inside_its_target_still_moves() {
        let mut moved = Camera { eye: [0.0; 3], target: [0.0; 3], ..Camera::default() };
        orbit(&mut moved, Vec2::new(3.0, 4.0));
        zoom(&mut moved, -10.0);
        assert!(Vec3::from(moved.eye).is_finite() && distance(&moved) > 0.0);
    }
}
