//! What the mouse points at: rays from the camera, meshes and the ground that they meet, points on the picture.

use glam::{Vec2, Vec3};
use lucerna::frame::{Camera, OpaqueMesh};

/// Farthest that the ground is met, in units of the camera's distance from its target.
const FARTHEST: f32 = 20.0;

/// A line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ray {
    pub(super) origin: Vec3,
    /// Of unit length.
    pub(super) way: Vec3,
}

/// A camera and the size of its picture, in any unit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<'a> {
    pub(super) camera: &'a Camera,
    pub(super) size: Vec2,
}

impl Sight<'_> {
    /// The line of sight through a place on the picture, from its upper left corner.
    pub(super) fn ray(&self, at: Vec2) -> Ray {
        let tangent = (0.5 * self.camera.fov_y_deg.to_radians()).tan();
        let from_middle = (at - 0.5 * self.size) * (2.0 * tangent / self.size.y.max(1.0));
        let in_view = Vec3::new(from_middle.x, -from_middle.y, -1.0);
        let way = self.camera.view_from_world().transpose().transform_vector3(in_view);
        Ray { origin: self.camera.eye.into(), way: way.normalize_or(Vec3::NEG_Z) }
    }

    /// Where a point is on the picture; nothing behind the camera.
    pub(super) fn place(&self, point: Vec3) -> Option<Vec2> {
        let view = self.camera.view_from_world().transform_point3(point);
        let tangent = (0.5 * self.camera.fov_y_deg.to_radians()).tan();
        let scale = 0.5 * self.size.y / (tangent * -view.z);
        (-view.z > self.camera.near_m).then(|| 0.5 * self.size + Vec2::new(view.x, -view.y) * scale)
    }

    /// The point on the line of sight that is as deep in the picture as `point`.
    pub(super) fn as_deep_as(&self, at: Vec2, point: Vec3) -> Vec3 {
        let ray = self.ray(at);
        let forward = (Vec3::from(self.camera.target) - Vec3::from(self.camera.eye)).normalize_or(Vec3::NEG_Z);
        let depth = (point - ray.origin).dot(forward);
        ray.origin + ray.way * (depth / ray.way.dot(forward).max(1e-6))
    }

    /// The nearest point of the meshes, or else of the ground at the height `ground_m`.
    pub(super) fn surface(&self, at: Vec2, meshes: &[OpaqueMesh], ground_m: f32) -> Option<Vec3> {
        let ray = self.ray(at);
        let ground = (ground_m - ray.origin.y) / ray.way.y;
        let far = FARTHEST * Vec3::from(self.camera.eye).distance(self.camera.target.into());
        let on_ground = (ground.is_finite() && ground > 0.0 && ground < far).then_some(ground);
        nearest(&ray, meshes).or(on_ground).map(|distance| ray.origin + ray.way * distance)
    }
}

/// Distance of the nearest triangle on a ray (Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection,
/// 1997).
pub(super) fn nearest(ray: &Ray, meshes: &[OpaqueMesh]) -> Option<f32> {
    let mut best = f32::INFINITY;
    for mesh in meshes {
        let corner = |i: u32| mesh.vertices.get(i as usize).map(|vertex| Vec3::from(vertex.position));
        for triangle in mesh.indices.as_chunks::<3>().0 {
            let [Some(a), Some(b), Some(c)] = triangle.map(corner) else { continue };
            let (ab, ac) = (b - a, c - a);
            let p = ray.way.cross(ac);
            let determinant = ab.dot(p);
            if determinant.abs() < 1e-14 {
                continue;
            }
            let from_a = ray.origin - a;
            let u = from_a.dot(p) / determinant;
            let q = from_a.cross(ab);
            let v = ray.way.dot(q) / determinant;
            let distance = ac.dot(q) / determinant;
            if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 1e-6 && distance < best {
                best = distance;
            }
        }
    }
    best.is_finite().then_some(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera { eye: [1.0, 2.0, 3.0], target: [0.1, 0.2, -0.3], fov_y_deg: 40.0, ..Camera::default() }
    }

    #[test]
    fn points_are_seen_where_their_ray_goes() {
        let camera = camera();
        let sight = Sight { camera: &camera, size: Vec2::new(640.0, 480.0) };
        for point in [Vec3::ZERO, Vec3::new(0.3, 0.9, -0.2), Vec3::new(-0.4, 0.0, 0.5)] {
            let at = sight.place(point).expect("in sight");
            let ray = sight.ray(at);
            let off = (point - ray.origin).cross(ray.way).length();
            assert!(off < 1e-4, "{point} is {off} m off its ray");
            assert!(sight.as_deep_as(at, point).distance(point) < 1e-3);
        }
        assert_eq!(sight.place(Vec3::new(2.0, 4.0, 6.5)), None, "behind the camera");
        assert!(sight.place(camera.target.into()).unwrap().distance(Vec2::new(320.0, 240.0)) < 1e-2);
    }

    #[test]
    fn the_nearest_surface_is_met_else_the_ground() {
        let world = lucerna::World::new(lucerna::scene::builtin("candle").unwrap()).unwrap();
        let camera = Camera { eye: [0.0, 0.5, 0.01], target: [0.0, 0.0, 0.0], ..Camera::default() };
        let sight = Sight { camera: &camera, size: Vec2::splat(100.0) };
        let top = sight.surface(Vec2::splat(50.0), world.frame().meshes, -5.0).expect("the wax");
        assert!(top.y.abs() < 0.01 && top.with_y(0.0).length() < 0.005, "{top}");
        let level = sight.surface(Vec2::new(50.0, 20.0), &[], -1.0).expect("the ground");
        assert!((level.y + 1.0).abs() < 1e-5 && level.z < -0.2, "{level}");
        let up = Camera { eye: [0.0; 3], target: [0.0, 1.0, 0.5], ..Camera::default() };
        assert_eq!(Sight { camera: &up, ..sight }.surface(Vec2::splat(50.0), &[], -1.0), None, "the sky");
    }
}
