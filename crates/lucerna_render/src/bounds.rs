//! Where the flames are on screen, and whether the eye may be inside one.

use crate::data::clip_from_world;
use lucerna_frame::{Camera, Frame};

/// The pixels that the flames may cover; all of them when a flame reaches behind the eye.
pub(crate) fn bounds(size: [u32; 2], frame: &Frame<'_>, camera: &Camera) -> Option<[u32; 4]> {
    let clip_from_world = clip_from_world(size, camera);
    let (mut low, mut high) = (glam::Vec2::MAX, glam::Vec2::MIN);
    for vertex in frame.flame_vertices {
        let clip = clip_from_world * glam::Vec3::from(vertex.position).extend(1.0);
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

/// True if the eye, or the near plane around it, lies in the box around a flame.
pub(crate) fn encloses(vertices: &[lucerna_frame::FlameVertex], camera: &Camera, size: [u32; 2]) -> bool {
    let eye = glam::Vec3::from(camera.eye);
    let (mut low, mut high) = (glam::Vec3::MAX, glam::Vec3::MIN);
    for vertex in vertices {
        let position = glam::Vec3::from(vertex.position);
        low = low.min(position);
        high = high.max(position);
    }
    // Corners of the near plane are farther away than its centre.
    let (up, aspect) = ((0.5 * camera.fov_y_deg.to_radians()).tan(), size[0] as f32 / size[1] as f32);
    let margin = glam::Vec3::splat(camera.near_m * (1.0 + up * up * (1.0 + aspect * aspect)).sqrt());
    (low - margin).cmple(eye).all() && eye.cmple(high + margin).all()
}
