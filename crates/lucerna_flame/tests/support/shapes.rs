//! Ten wicks as meshes, and air to burn them in.

use glam::{Quat, Vec3};
use lucerna_flame::{Air, FlameSettings, Skeletons, SurfaceGrid, WickShape};
use std::f32::consts::TAU;

/// Samples around a flame and from root to tip.
pub const AROUND: usize = 12;
pub const UP: usize = 10;

/// A wick and what it should become.
pub struct Shape {
    pub name: &'static str,
    pub vertices: Vec<[f32; 3]>,
    /// Distance of its flame's rim from the wick, m.
    pub width_m: f32,
    /// It carries a candle's flame.
    pub is_point: bool,
    /// Vertices farther apart than this belong to separate wicks.
    pub gap_m: f32,
    /// Linear wicks that it is made of.
    pub wicks: usize,
}

/// A number in -1..1 that depends on `n` alone.
pub fn noise(n: usize) -> f32 {
    let mut x = n as u32 ^ 0x9e37_79b9;
    for _ in 0..3 {
        x = (x ^ (x >> 16)).wrapping_mul(0x45d9_f3b3);
    }
    (x >> 8) as f32 / 8_388_608.0 - 1.0
}

/// Rings of eight vertices around a line, like a wick modelled as a tube.
pub fn tube(line: impl Fn(f32) -> Vec3, rings: usize, radius: f32) -> Vec<[f32; 3]> {
    let mut out = Vec::new();
    for i in 0..rings {
        let s = i as f32 / (rings - 1) as f32;
        let forward = (line((s + 1e-3).min(1.0)) - line((s - 1e-3).max(0.0))).normalize();
        let a = forward.any_orthonormal_vector();
        for k in 0..8 {
            let turn = Quat::from_axis_angle(forward, k as f32 * TAU / 8.0);
            out.push((line(s) + turn * a * radius).to_array());
        }
    }
    out
}

pub fn straight(s: f32) -> Vec3 {
    Vec3::new(0.4 * s - 0.2, 0.1, 0.1 * s)
}
pub fn bent(s: f32) -> Vec3 {
    if s < 0.5 { Vec3::X * (0.5 * s) } else { Vec3::new(0.25, 0.04 * (s - 0.5), 0.5 * (s - 0.5)) }
}
pub fn ring(s: f32) -> Vec3 {
    let (sin, cos) = (s * TAU).sin_cos();
    Vec3::new(0.2 * cos, 0.1, 0.2 * sin)
}

pub fn shapes() -> Vec<Shape> {
    let shape = |name, vertices, width_m| Shape { name, vertices, width_m, is_point: false, gap_m: 0.1, wicks: 1 };
    let point = |shape| Shape { is_point: true, ..shape };
    let ball = |centre: Vec3, size: Vec3, lumps: f32| -> Vec<[f32; 3]> {
        let at = |i: usize| {
            let y = 1.0 - 2.0 * (i as f32 + 0.5) / 300.0;
            let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
            let r = (1.0 - y * y).sqrt();
            centre + Vec3::new(r * cos, y, r * sin) * size * (1.0 + lumps * noise(i))
        };
        (0..300).map(|i| at(i).to_array()).collect()
    };
    let two = [-0.2, 0.2].map(|x| tube(move |s| Vec3::new(x, 0.02, 0.2 * s), 40, 0.01)).concat();
    // Two patches of the tube are missing, and four in ten of all other vertices.
    let holes = tube(straight, 80, 0.015).into_iter().enumerate();
    let holes = holes.filter(|&(i, _)| noise(i) > -0.2 && !(200..240).contains(&i) && !(400..424).contains(&i));
    let noisy = tube(bent, 120, 0.01).into_iter().enumerate().map(|(i, p)| {
        // A scan: jitter as large as the wick's radius, and now and then a stray point in the air around.
        let jitter = Vec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2));
        let stray = if i % 97 == 50 { 0.07 } else { 0.008 };
        (Vec3::from(p) + jitter * stray).to_array()
    });
    vec![
        shape("straight", tube(straight, 60, 0.01), 0.02),
        shape("bent", tube(bent, 60, 0.01), 0.02),
        Shape { wicks: 3, ..shape("ring", tube(ring, 96, 0.01), 0.02) },
        point(shape("vertical", tube(|s| Vec3::new(0.1, 0.03 * s, 0.2), 20, 0.002), 0.004)),
        Shape { gap_m: 1e-3, ..shape("tiny", tube(|s| straight(s) * 0.01, 20, 1e-4), 4e-4) },
        Shape { gap_m: 20.0, ..shape("huge", tube(|s| straight(s) * 100.0, 60, 1.0), 2.0) },
        point(shape("blob", ball(Vec3::new(0.1, 0.05, 0.0), Vec3::splat(0.05), 0.2), 0.04)),
        Shape { wicks: 2, ..shape("two parts", two, 0.02) },
        shape("holes", holes.map(|(_, p)| p).collect(), 0.02),
        shape("noisy", noisy.collect(), 0.02),
    ]
}

impl Shape {
    /// Height to which its flame is carried, m, and the speed of its gas, m/s (of Froude number 1).
    pub fn scales(&self) -> (f32, f32) {
        let height = 10.0 * self.width_m;
        (height, (9.81 * height).sqrt())
    }

    /// A flame on `wick` in proportion to its width, on a coarse grid.
    pub fn settings(&self, wick: WickShape) -> FlameSettings {
        let (height, speed) = self.scales();
        let skeletons = Skeletons {
            lead_life_s: height / speed,
            peripheral_life_s: 0.9 * height / speed,
            width_m: self.width_m,
            expansion_m_s: 0.2 * speed,
            shed_per_s: 2.0,
            free_life_s: height / speed,
            turbulence_m_s: 0.4 * speed,
            turbulence_m: 0.5 * height,
            ..Skeletons::default()
        };
        let surface = SurfaceGrid { around: AROUND as u32, up: UP as u32, ..SurfaceGrid::default() };
        FlameSettings { skeletons, surface, ..FlameSettings::new(wick) }
    }
}

/// Air that rises, dies down and sinks, gusts from all sides, and swirls: the flow of Arnold, Beltrami and Childress,
/// whose streamlines are chaotic.
pub struct Gusts {
    pub time_s: f32,
    /// Speed at which it rises when nothing disturbs it, m/s.
    pub speed_m_s: f32,
    /// Size of its eddies, m.
    pub size_m: f32,
}

impl Air for Gusts {
    fn velocity(&self, point: Vec3) -> Vec3 {
        let t = self.time_s;
        let rise = Vec3::Y * (0.8 + 0.9 * (1.3 * t).sin());
        let strength = (0.9 * t).sin().max(0.0);
        let gust = Vec3::new((0.31 * t).cos(), 0.0, (0.31 * t).sin()) * (3.0 * strength * strength * strength);
        let p = point * (TAU / self.size_m) - (rise + gust) * (self.speed_m_s / self.size_m * t);
        let p = Vec3::new(p.x % TAU, p.y % TAU, p.z % TAU);
        let ((sx, cx), (sy, cy), (sz, cz)) = (p.x.sin_cos(), p.y.sin_cos(), p.z.sin_cos());
        let swirl = Vec3::new(sz + cy, sx + cz, sy + cx) * (0.5 * (1.0 + (0.7 * t).sin()));
        (rise + gust + swirl) * self.speed_m_s
    }
    fn bounds(&self) -> (Vec3, Vec3) {
        (Vec3::splat(-200.0), Vec3::splat(200.0))
    }
}
