//! Where the flames are on screen, and whether the eye may be inside one.

use crate::data::clip_from_world;
use glam::Vec3;
use lucerna_frame::Camera;

/// The pixels that flames within the hull of some points may cover; all of them when it reaches behind the eye.
pub(crate) fn bounds(size: [u32; 2], points: impl Iterator<Item = Vec3>, camera: &Camera) -> Option<[u32; 4]> {
    let clip_from_world = clip_from_world(size, camera);
    let (mut low, mut high) = (glam::Vec2::MAX, glam::Vec2::MIN);
    for point in points {
        let clip = clip_from_world * point.extend(1.0);
        if clip.w <= camera.near_m {
            return Some([0, 0, size[0], size[1]]);
        }
        let ndc = clip.truncate().truncate() / clip.w;
        low = low.min(ndc);
        high = high.max(ndc);
    }
    let size = glam::Vec2::new(size[0] as f32, size[1] as f32);
    let pixel = |ndc: glam::Vec2| (ndc * glam::Vec2::new(0.5, -0.5) + 0.5) * size;
    let (from, to) =
        (pixel(glam::Vec2::new(low.x, high.y)).floor() - 1.0, pixel(glam::Vec2::new(high.x, low.y)).ceil() + 1.0);
    let (from, to) = (from.max(glam::Vec2::ZERO), to.min(size));
    (to.x > from.x && to.y > from.y).then(|| [from.x, from.y, to.x - from.x, to.y - from.y].map(|v| v as u32))
}

/// True if the eye, or the near plane around it, lies in the box around a flame's points.
pub(crate) fn encloses(points: impl Iterator<Item = Vec3>, camera: &Camera, size: [u32; 2]) -> bool {
    let eye = Vec3::from(camera.eye);
    let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
    for point in points {
        low = low.min(point);
        high = high.max(point);
    }
    // Corners of the near plane are farther away than its centre.
    let (up, aspect) = ((0.5 * camera.fov_y_deg.to_radians()).tan(), size[0] as f32 / size[1] as f32);
    let margin = Vec3::splat(camera.near_m * (1.0 + up * up * (1.0 + aspect * aspect)).sqrt());
    (low - margin).cmple(eye).all() && eye.cmple(high + margin).all()
}
