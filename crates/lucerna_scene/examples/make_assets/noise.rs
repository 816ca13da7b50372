//! Smooth noise in space, from a hash.

use glam::{IVec3, Vec3};

/// A number in 0..1 from three whole numbers.
pub(crate) fn hash(cell: IVec3) -> f32 {
    let mut h = (cell.x as u32).wrapping_mul(0x9E37_79B1)
        ^ (cell.y as u32).wrapping_mul(0x85EB_CA77)
        ^ (cell.z as u32).wrapping_mul(0xC2B2_AE3D);
    for (shift, factor) in [(16, 0x7FEB_352D), (15, 0x846C_A68B)] {
        h = (h ^ (h >> shift)).wrapping_mul(factor);
    }
    ((h ^ (h >> 16)) >> 8) as f32 / (1 << 24) as f32
}

/// A number in 0..1 from an index and a purpose.
pub(crate) fn random(index: usize, purpose: i32) -> f32 {
    hash(IVec3::new(index as i32, purpose, 7))
}

/// Smooth noise in -1..1 with features of size 1.
pub(crate) fn noise(point: Vec3) -> f32 {
    let cell = point.floor();
    let t = point - cell;
    let t = t * t * (3.0 - 2.0 * t);
    let cell = cell.as_ivec3();
    let mut sum = 0.0;
    for corner in 0..8 {
        let offset = IVec3::new(corner & 1, (corner >> 1) & 1, corner >> 2);
        let weight = (0..3).map(|axis| if offset[axis] == 1 { t[axis] } else { 1.0 - t[axis] }).product::<f32>();
        sum += weight * hash(cell + offset);
    }
    2.0 * sum - 1.0
}

/// Four octaves of [`noise`], about -1..1.
pub(crate) fn fractal(point: Vec3) -> f32 {
    (0..4).map(|octave| 0.5_f32.powi(octave) * noise(point * 2.0_f32.powi(octave) + 17.0 * octave as f32)).sum::<f32>()
        / 1.5
}

/// 0 below `low`, 1 above `high`, smooth between; falls where `low` is above `high`.
pub(crate) fn step(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
