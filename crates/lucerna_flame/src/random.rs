//! Seeded randomness: a hash, a small generator and smooth noise. The same bits on every machine.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Scrambles 64 bits (the finaliser of splitmix64).
pub(crate) fn hash(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A number in 0..1 from the upper 24 bits.
pub(crate) fn unit(bits: u64) -> f32 {
    (bits >> 40) as f32 / 16_777_216.0
}

/// A PCG-XSH-RR generator with 64 bits of state.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Pcg {
    state: u64,
}

impl Pcg {
    pub(crate) fn new(seed: u64) -> Self {
        Self { state: hash(seed) }
    }
    /// The next number in 0..1.
    pub(crate) fn next_unit(&mut self) -> f32 {
        let old = self.state;
        self.state = old.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let word = ((((old >> 18) ^ old) >> 27) as u32).rotate_right((old >> 59) as u32);
        (word >> 8) as f32 / 16_777_216.0
    }
    pub(crate) fn state(&self) -> u64 {
        self.state
    }
}

fn smooth(t: f32) -> f32 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Value noise over a line, -1 to 1, twice differentiable.
pub(crate) fn noise_1d(seed: u64, t: f64) -> f32 {
    let cell = t.floor();
    let at = |i: i64| unit(hash(seed ^ (i as u64).wrapping_mul(0xd6e8_feb8_6659_fd93))) * 2.0 - 1.0;
    let (a, b) = (at(cell as i64), at((cell as i64).wrapping_add(1)));
    a + (b - a) * smooth((t - cell) as f32)
}

/// Eight octaves of [`noise_1d`], each twice as fast and half as strong as the one before; -1 to 1.
pub(crate) fn octaves(seed: u64, t: f64) -> f32 {
    let (mut sum, mut weight, mut scale) = (0.0, 0.5, 1.0);
    for octave in 0..8 {
        sum += weight * noise_1d(hash(seed ^ octave), t * scale);
        weight *= 0.5;
        scale *= 2.0;
    }
    sum
}

/// Cells after which [`noise_3d`] repeats along each axis; a power of two.
pub(crate) const PERIOD: i64 = 1024;

/// A smooth random vector field, each component -1 to 1.
pub(crate) fn noise_3d(seed: u32, p: Vec3) -> Vec3 {
    let cell = p.floor();
    let f = p - cell;
    let weight = Vec3::new(smooth(f.x), smooth(f.y), smooth(f.z));
    let [x, y, z] = [cell.x, cell.y, cell.z].map(|c| (c as i64 & (PERIOD - 1)) as u64);
    let corner = |dx: u64, dy: u64, dz: u64| {
        // The upper corners of the last cell are the lower ones of the first.
        let [x, y, z] = [x + dx, y + dy, z + dz].map(|c| c & (PERIOD as u64 - 1));
        let bits = hash(u64::from(seed) << 32 ^ x ^ (y << 21) ^ (z << 42));
        let part = |shift: u32| ((bits >> shift) & 0x1f_ffff) as f32 / 1_048_576.0 - 1.0;
        Vec3::new(part(0), part(21), part(42))
    };
    let edge = |dy, dz| corner(0, dy, dz).lerp(corner(1, dy, dz), weight.x);
    let face = |dz| edge(0, dz).lerp(edge(1, dz), weight.y);
    face(0).lerp(face(1), weight.z)
}

/// FNV-1a over words: the state hashes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fnv(pub(crate) u64);

impl Fnv {
    pub(crate) fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
    pub(crate) fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
    }
    pub(crate) fn float(&mut self, value: f32) {
        self.word(u64::from(value.to_bits()));
    }
    pub(crate) fn point(&mut self, p: Vec3) {
        self.float(p.x);
        self.float(p.y);
        self.float(p.z);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_bounded_smooth_and_seeded() {
        let mut last = octaves(3, 0.0);
        let mut spread = 0.0_f32;
        for i in 1..4000 {
            let t = f64::from(i) * 1e-3;
            let now = octaves(3, t);
            assert!(now.abs() <= 1.0 && (now - last).abs() < 0.05, "{t}: {last} {now}");
            spread = spread.max(now.abs());
            last = now;
        }
        assert!(spread > 0.3, "it moves: {spread}");
        assert_ne!(octaves(3, 1.7).to_bits(), octaves(4, 1.7).to_bits());
        let p = Vec3::new(-7.3, 2.1, 900.4);
        assert!(noise_3d(1, p).abs().max_element() <= 1.0);
        assert!((noise_3d(1, p) - noise_3d(1, p + Vec3::splat(1e-3))).length() < 0.02);
    }

    #[test]
    fn the_field_has_no_seams_and_repeats() {
        let period = PERIOD as f32;
        for axis in 0..3 {
            for plane in [0.0, -3.0, period - 1.0, period, 2.0 * period, -period] {
                let at = |x: f32| {
                    let mut p = Vec3::new(5.3, -7.6, 2.45);
                    p[axis] = x;
                    p
                };
                let (below, above) = (noise_3d(1, at(plane - 1e-3)), noise_3d(1, at(plane + 1e-3)));
                assert!(below.distance(above) < 1e-3, "axis {axis} at {plane}: {below} {above}");
                let (here, there) = (noise_3d(1, at(plane + 0.25)), noise_3d(1, at(plane + 0.25 + period)));
                assert_eq!(here, there, "axis {axis} at {plane}");
            }
        }
    }

    #[test]
    fn the_generator_is_uniform() {
        let mut pcg = Pcg::new(9);
        let mean = (0..10_000).map(|_| f64::from(pcg.next_unit())).sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 0.01, "{mean}");
    }
}
