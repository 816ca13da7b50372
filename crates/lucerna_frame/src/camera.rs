//! The camera, as plain numbers.

use serde::{Deserialize, Serialize};

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// Where the camera is, in metres.
    pub eye: [f32; 3],
    /// The point it looks at, in metres.
    pub target: [f32; 3],
    /// Vertical angle of view in degrees, 1 to 170.
    pub fov_y_deg: f32,
    /// Distance of the near plane in metres, above 0.
    pub near_m: f32,
    /// Distance of the far plane in metres, above `near_m`.
    pub far_m: f32,
}

impl Default for Camera {
    fn default() -> Self {
        Self { eye: [0.0, 1.0, 3.0], target: [0.0; 3], fov_y_deg: 35.0, near_m: 0.01, far_m: 100.0 }
    }
}

impl Camera {
    /// The matrix that takes world points to view space (x right, y up, looking along -z).
    #[must_use]
    pub fn view_from_world(&self) -> glam::Mat4 {
        let eye = glam::Vec3::from(self.eye);
        let forward = (glam::Vec3::from(self.target) - eye).normalize_or(glam::Vec3::NEG_Z);
        // Looking straight up or down leaves no horizontal direction: choose one.
        let up = if forward.y.abs() > 0.9999 { glam::Vec3::NEG_Z } else { glam::Vec3::Y };
        glam::camera::rh::view::look_to_mat4(eye, forward, up)
    }

    /// The matrix that takes view space to clip space with depth from 0 (near) to 1 (far).
    #[must_use]
    pub fn clip_from_view(&self, aspect: f32) -> glam::Mat4 {
        glam::camera::rh::proj::directx::perspective(self.fov_y_deg.to_radians(), aspect, self.near_m, self.far_m)
    }
}
