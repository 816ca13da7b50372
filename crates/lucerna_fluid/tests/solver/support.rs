//! What the tests share.

use lucerna_fluid::{Fluid, Vec3};

/// Numbers in 0..1 from a 64-bit linear congruential generator (Knuth's MMIX constants).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1 << 24) as f32
    }

    pub(crate) fn vector(&mut self, size: f32) -> Vec3 {
        let mut component = || size * (2.0 * self.next() - 1.0);
        Vec3::new(component(), component(), component())
    }
}

/// A velocity for a point: random, but the same for the same point and seed.
pub(crate) fn random_velocity(seed: u64, size: f32) -> impl Fn(Vec3) -> Vec3 {
    move |point| {
        let [x, y, z] = point.to_array().map(|value| u64::from(value.to_bits()));
        let mut random = Random(seed ^ x.wrapping_mul(0x9e37_79b9) ^ y.rotate_left(21) ^ z.rotate_left(42));
        random.next();
        random.vector(size)
    }
}

/// Divergence by cell, computed here from the public arrays in `f64`, 1/s.
pub(crate) fn divergence(fluid: &Fluid) -> Vec<f64> {
    let [nx, ny, nz] = fluid.cells();
    let [u, v, w] = fluid.face_velocities();
    let edge = fluid.cell_size_m().as_dvec3();
    let mut out = Vec::new();
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                let x = u[i + 1 + (nx + 1) * (j + ny * k)] - u[i + (nx + 1) * (j + ny * k)];
                let y = v[i + nx * (j + 1 + (ny + 1) * k)] - v[i + nx * (j + (ny + 1) * k)];
                let z = w[i + nx * (j + ny * (k + 1))] - w[i + nx * (j + ny * k)];
                out.push(f64::from(x) / edge.x + f64::from(y) / edge.y + f64::from(z) / edge.z);
            }
        }
    }
    out
}

/// Greatest magnitude.
pub(crate) fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}
