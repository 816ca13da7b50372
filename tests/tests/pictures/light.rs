//! Light on the scene: it falls off with the square of the distance, and shadows lie where geometry says and nowhere else.

use crate::support::{Painter, pixel};
use glam::{Mat3, Vec3};
use lucerna::frame::{Camera, Frame, Light, Look, MeshVertex, OpaqueMesh, ToneMap, adaptation};
use std::sync::atomic::{AtomicU64, Ordering};
use wgpu::TextureFormat::Rgba16Float;

const SIZE: [u32; 2] = [200, 200];

/// A look that shows the lit scene as numbers.
fn plain(shadows: u32) -> Look {
    Look {
        exposure_stops: 0.0,
        tone_map: ToneMap::None,
        glow: Vec::new(),
        samples: 1,
        layers: 1,
        shadows,
        shadow_size: 1024,
        ..Default::default()
    }
}

/// A white square: its middle and half its sides.
fn square(middle: Vec3, u: Vec3, v: Vec3) -> OpaqueMesh {
    let normal = u.cross(v).normalize().to_array();
    let vertex = |[a, b]: [f32; 2]| MeshVertex {
        position: (middle + a * u + b * v).to_array(),
        normal,
        color: [1.0; 3],
        ..Default::default()
    };
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    OpaqueMesh { vertices: corners.map(vertex).to_vec(), indices: vec![0, 1, 2, 0, 2, 3] }
}

/// The green of a picture of meshes in the light of one small source.
fn lit(painter: &mut Painter, meshes: &[OpaqueMesh], light: Light, camera: &Camera, look: &Look) -> Vec<f32> {
    // Meshes are uploaded when this number changes.
    static REVISION: AtomicU64 = AtomicU64::new(0);
    let mesh_revision = REVISION.fetch_add(1, Ordering::Relaxed);
    let frame = Frame { lights: &[light], meshes, mesh_revision, ..Default::default() };
    painter.light(SIZE, &frame, camera, look).iter().map(|texel| texel[1]).collect()
}

#[test]
fn light_falls_off_with_the_square_of_the_distance() {
    let mut painter = Painter::new(Rgba16Float);
    let light = Light { position: [0.0; 3], radius_m: 0.03, intensity: [2.0; 3] };
    for shadows in [0, 1] {
        let look = plain(shadows);
        let intensity = (adaptation(look.white_k) * Vec3::from(light.intensity)).y;
        // Beyond five heights of a flame as large as this source.
        for distance in [0.3, 0.6, 1.5, 4.0, 10.0] {
            let wall = square(Vec3::NEG_Z * distance, Vec3::X * 3.0 * distance, Vec3::Y * 3.0 * distance);
            let camera = Camera {
                // So far aside that hardly any gloss is seen.
                eye: [0.0, 6.0 * distance, 0.2 * distance],
                target: [0.0, 0.0, -distance],
                fov_y_deg: 1.0,
                near_m: 0.1 * distance,
                far_m: 20.0 * distance,
            };
            let picture = lit(&mut painter, &[wall], light, &camera, &look);
            let middle = picture[(SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize];
            let error = middle * std::f32::consts::PI * distance * distance / intensity - 1.0;
            println!("{distance} m: {:+.2} %", 100.0 * error);
            assert!(error.abs() < 0.02, "{shadows} shadows, {distance} m: {middle}, off by {error}");
        }
    }
}

#[test]
fn the_edge_of_a_shadow_lies_where_geometry_says() {
    let mut painter = Painter::new(Rgba16Float);
    let light = Light { position: [0.9, 2.0, -0.7], radius_m: 1e-3, intensity: [1.0; 3] };
    // A square half-way up throws a shadow twice as large.
    let (half, height) = (0.2, 1.0);
    let meshes =
        [square(Vec3::ZERO, Vec3::Z * 4.0, Vec3::X * 4.0), square(Vec3::Y * height, Vec3::Z * half, Vec3::X * half)];
    let camera = Camera { eye: [0.0, 6.0, 0.0], target: [0.0; 3], fov_y_deg: 38.0, near_m: 0.1, far_m: 20.0 };
    let with = lit(&mut painter, &meshes, light, &camera, &plain(1));
    let without = lit(&mut painter, &meshes, light, &camera, &plain(0));
    let seen: Vec<f32> = with.iter().zip(&without).map(|(a, b)| a / b).collect();
    let from = Vec3::from(light.position);
    let shadow_of = |point: Vec3| from + (point - from) * (from.y / (from.y - point.y));
    let at = |x: i32, y: i32| seen[(y * SIZE[0] as i32 + x) as usize];
    let middle = pixel(&camera, SIZE, shadow_of(Vec3::Y * height));
    assert!(at(middle.x as i32, middle.y as i32) < 0.01, "no shadow in its middle");
    let (mut largest, mut edges) = (0.0f32, 0);
    for (axis, side) in [(Vec3::X, -1.0), (Vec3::X, 1.0), (Vec3::Z, -1.0), (Vec3::Z, 1.0)] {
        for along in [-0.8, -0.4, 0.0, 0.4, 0.8] {
            let edge = Vec3::Y * height + half * (side * axis + along * (Vec3::X + Vec3::Z - axis));
            let expected = pixel(&camera, SIZE, shadow_of(edge));
            // Across the edge in the picture, row by row or column by column.
            let outwards = pixel(&camera, SIZE, shadow_of(edge + side * axis * 0.01)) - expected;
            let across_x = outwards.x.abs() > outwards.y.abs();
            let value = |place: f32| {
                // Between the middles of two pixels.
                let (low, part) = ((place - 0.5).floor(), (place - 0.5).fract());
                let pick =
                    |p: f32| if across_x { at(p as i32, expected.y as i32) } else { at(expected.x as i32, p as i32) };
                pick(low) * (1.0 - part) + pick(low + 1.0) * part
            };
            let (center, sign) =
                if across_x { (expected.x, outwards.x.signum()) } else { (expected.y, outwards.y.signum()) };
            let crossing = (-400..400)
                .map(|step| 0.01 * step as f32)
                .find(|step| value(center + sign * step) >= 0.5)
                .expect("the shadow ends");
            largest = largest.max(crossing.abs());
            edges += usize::from(value(center - 3.0 * sign) < 0.02 && value(center + 3.0 * sign) > 0.98);
        }
    }
    println!("edges lie up to {largest:.2} pixels from where geometry says");
    assert!(largest < 1.0, "{largest} pixels");
    assert_eq!(edges, 20, "a tiny light throws a sharp shadow");
}

#[test]
fn what_nothing_stands_before_is_lit_as_without_shadows() {
    let mut painter = Painter::new(Rgba16Float);
    for (radius_m, height) in [(1e-3, 1.0), (0.05, 1.0), (0.01, 0.1), (0.2, 0.3), (1e-3, 0.03)] {
        for turn in
            [Mat3::IDENTITY, Mat3::from_rotation_z(0.7), Mat3::from_rotation_x(2.0) * Mat3::from_rotation_y(0.4)]
        {
            let floor = square(turn * Vec3::Y * -height, turn * Vec3::Z * 4.0, turn * Vec3::X * 4.0);
            let light = Light { position: [0.0; 3], radius_m, intensity: [1.0; 3] };
            let camera = Camera {
                eye: (turn * Vec3::new(0.5, 3.0, 3.0)).to_array(),
                target: (turn * Vec3::Y * -height).to_array(),
                fov_y_deg: 60.0,
                near_m: 0.1,
                far_m: 20.0,
            };
            let with = lit(&mut painter, std::slice::from_ref(&floor), light, &camera, &plain(1));
            let without = lit(&mut painter, std::slice::from_ref(&floor), light, &camera, &plain(0));
            let worst = with.iter().zip(&without).map(|(a, b)| (a - b).abs() / b.max(1e-6)).fold(0.0, f32::max);
            let covered = without.iter().filter(|value| **value > 0.0).count();
            assert!(covered > 10_000, "{covered} pixels of floor");
            assert!(worst < 0.01, "a light of {radius_m} m, {height} m over the floor: off by {worst}");
        }
    }
}
