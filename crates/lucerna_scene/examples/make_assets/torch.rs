//! A torch before a stone wall: a stick, a head of pitch-soaked cloth in an iron cage. The flame stands at the
//! top of the head, near y = 0.

use crate::mesh::{Obj, Sample, angle, polar, table};
use crate::noise::{fractal, noise, random, step};
use glam::{Quat, Vec3};

const MATERIALS: &str = "\
# Pitch-soaked cloth that smoulders, wood, iron, stone and mortar. Vertex colours multiply Kd and Ke.
newmtl cloth
Kd 1 1 1
newmtl ember
Kd 0.2 0.06 0.03
Ke 0.12 0.016 0.0015
newmtl wood
Kd 1 1 1
newmtl iron
Kd 1 1 1
newmtl stone
Kd 1 1 1
";

/// Radius of the head over height, m.
const HEAD: [[f32; 2]; 10] = [
    [-0.120, 0.024],
    [-0.112, 0.036],
    [-0.095, 0.047],
    [-0.070, 0.054],
    [-0.040, 0.0565],
    [-0.020, 0.054],
    [-0.004, 0.046],
    [0.008, 0.034],
    [0.016, 0.018],
    [0.020, 0.0],
];

pub(crate) fn parts() -> Vec<(&'static str, String)> {
    let mut torch = Obj::new("torch.mtl", 4);
    head(&mut torch);
    stick(&mut torch);
    cage(&mut torch);
    let mut wall = Obj::new("torch.mtl", 4);
    blocks(&mut wall);
    vec![("torch.mtl", MATERIALS.to_owned()), ("torch.obj", torch.finish()), ("torch_wall.obj", wall.finish())]
}

/// The whole torch leans a little.
fn lean(point: Vec3) -> Vec3 {
    Quat::from_rotation_z(-0.05) * Quat::from_rotation_x(0.04) * point
}

fn head(obj: &mut Obj) {
    let (rows, columns) = (30, 40);
    obj.surface("cloth", [rows, columns], true, |row, column| {
        let t = row as f32 / (rows - 1) as f32;
        let y = -0.120 + 0.140 * (1.0 - (1.0 - t).powf(1.25));
        let a = angle(column, columns);
        let around = polar(1.0, a, y * 30.0);
        // Strips of cloth wind around the head; their edges stand out.
        let strip = (y * 30.0 + a / std::f32::consts::TAU).rem_euclid(1.0);
        let edge = step(0.0, 0.16, strip) * step(1.0, 0.5, strip);
        let mut radius = table(&HEAD, y);
        radius *= 1.0 + 0.05 * (edge - 0.4) + 0.07 * fractal(around * 1.6);
        let burnt = step(-0.09, -0.02, y);
        let cloth = Vec3::new(0.085, 0.060, 0.040).lerp(Vec3::new(0.022, 0.018, 0.016), burnt);
        let colour = cloth * (0.75 + 0.45 * edge) * (1.0 + 0.4 * fractal(around * 3.0));
        // Black surrounds what glows.
        let hot = noise(around * 2.1 + 9.0) - step(0.0, -0.05, y);
        let colour = colour * (1.0 - 0.97 * step(-0.45, 0.05, hot));
        Sample { glow: step(0.12, 0.6, hot), ..Sample::new(lean(polar(radius, a, y)), colour) }
    });
}

fn stick(obj: &mut Obj) {
    let (rows, columns) = (30, 18);
    obj.surface("wood", [rows, columns], true, |row, column| {
        let t = (row as f32 / (rows - 2) as f32).min(1.0);
        let y = -0.80 + 0.70 * t;
        let a = angle(column, columns);
        let around = polar(1.0, a, y * 7.0);
        let bark = fractal(polar(2.2, a, y * 4.0));
        let knot = (-((y + 0.37) / 0.02).powi(2)).exp() * step(0.2, 0.9, (a - 1.3).cos());
        let radius = (0.0135 + 0.004 * t) * (1.0 + 0.08 * bark + 0.25 * knot + 0.03 * noise(around));
        let radius = if row == rows - 1 { 0.0 } else { radius };
        let bend = Vec3::new(0.010 * (y * 6.0).sin(), 0.0, 0.007 * (y * 4.0 + 1.0).cos() - 0.004);
        let colour = Vec3::new(0.20, 0.115, 0.058) * (1.0 + 0.5 * bark) * (1.0 - 0.5 * knot);
        let sooty = 1.0 - 0.75 * step(-0.3, -0.1, y);
        Sample::new(lean(polar(radius, a, y) + bend * step(-0.1, -0.2, y)), colour * sooty)
    });
}

/// Two iron bands around the head and four straps over its sides.
fn cage(obj: &mut Obj) {
    for (band, y) in [-0.098_f32, -0.052].into_iter().enumerate() {
        let columns = 36;
        obj.surface("iron", [5, columns], true, |row, column| {
            let a = angle(column, columns);
            let [out, up] = [[0.0, -0.006], [0.0035, -0.006], [0.0042, 0.0], [0.0035, 0.006], [0.0, 0.006]][row];
            let radius = table(&HEAD, y) * 1.035 + 0.002 + out;
            iron(lean(polar(radius, a, y + up)), band)
        });
    }
    for strap in 0..4 {
        let middle = 0.5 + angle(strap, 4);
        obj.surface("iron", [18, 4], false, |row, column| {
            let y = -0.118 + 0.105 * row as f32 / 17.0;
            let [side, out] = [[-0.0055, -0.002], [-0.0045, 0.0035], [0.0045, 0.0035], [0.0055, -0.002]][column];
            let radius = table(&HEAD, y) * 1.035 + 0.0035 + out + 0.0015 * step(-0.02, -0.013, y);
            iron(lean(polar(radius, middle + side / radius, y)), 2 + strap)
        });
    }
}

fn iron(position: Vec3, part: usize) -> Sample {
    let rust = step(-0.3, 0.6, fractal(position * 60.0 + part as f32 * 3.0));
    Sample::new(position, Vec3::new(0.055, 0.052, 0.050).lerp(Vec3::new(0.10, 0.045, 0.022), rust))
}

/// A wall of rough blocks, 2.4 m wide, and the mortar behind them.
fn blocks(obj: &mut Obj) {
    const Z: f32 = -0.5;
    const HEIGHT: f32 = 0.215;
    let across = [0.0, 0.05, 0.16, 0.5, 0.84, 0.95, 1.0];
    let up = [0.0, 0.09, 0.26, 0.74, 0.91, 1.0];
    for course in 0..11_usize {
        let mut left = -1.25 - 0.2 * random(course, 10);
        for block in 0..8_usize {
            let index = course * 8 + block;
            let width = 0.25 + 0.28 * random(index, 11);
            let (from, to) = (left + 0.008, left + width - 0.008);
            left += width;
            if to < -1.2 || from > 1.2 {
                continue;
            }
            let tone = 0.75 + 0.5 * random(index, 12);
            let warm = Vec3::new(0.26, 0.235, 0.205).lerp(Vec3::new(0.20, 0.205, 0.215), random(index, 13));
            let out = 0.018 * random(index, 14);
            let y0 = -0.95 + HEIGHT * course as f32;
            obj.surface("stone", [up.len(), across.len()], false, |row, column| {
                let (u, v) = (across[column], up[row]);
                let x = from + (to - from) * u;
                let y = y0 + 0.007 + (HEIGHT - 0.014) * v;
                let [du, dv] = [u.min(1.0 - u) * (to - from), v.min(1.0 - v) * HEIGHT];
                let round = step(0.0, 0.022, du) * step(0.0, 0.022, dv);
                let place = Vec3::new(x, y, index as f32);
                let wobble = 0.006 * (1.0 - round);
                let z = Z - 0.03 + round * (0.035 + out + 0.014 * fractal(place * 7.0));
                let stain = 1.0 + 0.3 * fractal(place * 11.0);
                let shift = Vec3::new(noise(place * 9.0), noise(place * 9.0 + 40.0), 0.0) * wobble;
                Sample::new(Vec3::new(x, y, z) + shift, warm * tone * stain * (0.55 + 0.45 * round))
            });
        }
    }
    let corner = |x: f32, y: f32| Sample::new(Vec3::new(x, y, Z - 0.025), Vec3::new(0.085, 0.078, 0.07));
    obj.face("stone", &[corner(-1.7, -0.95), corner(1.7, -0.95), corner(1.7, 1.42), corner(-1.7, 1.42)]);
}
