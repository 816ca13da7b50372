//! A round burner flush with the floor.

use std::f32::consts::TAU;

use lucerna_fluid::{Shape, Vec3};

/// Corners of the circle.
const CORNERS: u32 = 96;

/// An upright cylinder: the middle of its foot, diameter and height, m.
pub(crate) fn disk(foot: Vec3, diameter_m: f32, height_m: f32) -> Shape {
    let mut positions = vec![foot, foot + height_m * Vec3::Y];
    let mut triangles = Vec::new();
    for corner in 0..CORNERS {
        let (sin, cos) = (TAU * corner as f32 / CORNERS as f32).sin_cos();
        let low = foot + 0.5 * diameter_m * Vec3::new(cos, 0.0, sin);
        positions.extend([low, low + height_m * Vec3::Y]);
        let (a, b) = (2 + 2 * corner, 2 + 2 * ((corner + 1) % CORNERS));
        triangles.extend([[0, a, b], [1, a + 1, b + 1], [a, b, b + 1], [a, b + 1, a + 1]]);
    }
    Shape::Mesh { positions: positions.into(), triangles: triangles.into(), layer_m: None }
}
