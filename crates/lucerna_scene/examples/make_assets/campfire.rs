//! A campfire: six logs over a bed of coals, a ring of stones, the ground. The ground is near y = 0.

use crate::mesh::{Obj, Sample, angle, polar};
use crate::noise::{fractal, noise, random, step};
use glam::Vec3;

const MATERIALS: &str = "\
# Bark and cut wood, embers, coals, stones, earth. Vertex colours multiply Kd and Ke.
newmtl log
Kd 1 1 1
newmtl ember
Kd 0.25 0.07 0.03
Ke 0.16 0.015 0.001
newmtl stone
Kd 1 1 1
newmtl earth
Kd 1 1 1
";

/// Logs: where they begin and end (angle in degrees about y, distance from the middle, height) and radius, m.
const LOGS: [[[f32; 3]; 2]; 6] = [
    [[20.0, 0.66, 0.075], [20.0, -0.08, 0.115]],
    [[145.0, 0.62, 0.065], [145.0, -0.06, 0.125]],
    [[262.0, 0.64, 0.070], [262.0, -0.02, 0.100]],
    [[80.0, 0.46, 0.060], [92.0, -0.05, 0.47]],
    [[203.0, 0.47, 0.055], [215.0, -0.06, 0.44]],
    [[322.0, 0.44, 0.055], [330.0, -0.07, 0.45]],
];

/// How many coals there are.
const COALS: usize = 54;

const LOG_RADIUS: [f32; 6] = [0.064, 0.056, 0.060, 0.046, 0.043, 0.040];

pub(crate) fn parts() -> Vec<(&'static str, String)> {
    let mut logs = Obj::new("campfire.mtl", 4);
    for index in 0..LOGS.len() {
        log(&mut logs, index);
    }
    let mut stones = Obj::new("campfire.mtl", 4);
    for index in 0..13 {
        stone(&mut stones, index);
    }
    let mut coals = Obj::new("campfire.mtl", 4);
    for index in 0..COALS {
        coal(&mut coals, index);
    }
    let mut ground = Obj::new("campfire.mtl", 4);
    earth(&mut ground);
    vec![
        ("campfire.mtl", MATERIALS.to_owned()),
        ("campfire_logs.obj", logs.finish()),
        ("campfire_stones.obj", stones.finish()),
        ("campfire_coals.obj", coals.finish()),
        ("campfire_ground.obj", ground.finish()),
    ]
}

/// Height of the ground, m.
fn ground(x: f32, z: f32) -> f32 {
    let distance = x.hypot(z);
    let rough = 0.035 * fractal(Vec3::new(x * 1.4, 2.0, z * 1.4)) + 0.010 * noise(Vec3::new(x * 9.0, 5.0, z * 9.0));
    rough * step(0.25, 0.9, distance) - 0.035 * step(0.6, 0.3, distance)
}

fn log(obj: &mut Obj, index: usize) {
    let [from, to] = LOGS[index].map(|[degrees, distance, y]| polar(distance, degrees.to_radians(), y));
    let axis = (to - from).normalize();
    let side = axis.cross(Vec3::Y).normalize();
    let up = side.cross(axis);
    let seed = Vec3::splat(13.7 * index as f32);
    // The first two and last two rows are the cut ends.
    let (rows, columns) = (25, 20);
    obj.surface("log", [rows, columns], true, |row, column| {
        let cut = row < 2 || row > rows - 3;
        let inner = row == 0 || row == rows - 1;
        let t = ((row as f32 - 2.0) / (rows - 5) as f32).clamp(0.0, 1.0);
        // Columns go right where rows go along the axis.
        let a = angle(column, columns);
        let out = side * a.cos() + up * a.sin();
        let bark = fractal(out * 2.6 + axis * (t * 2.2) + seed);
        let ridge = noise(out * 4.5 + axis * (t * 5.0) + seed * 2.0);
        let bend = (up * noise(Vec3::splat(t * 2.0) + seed) + side * noise(Vec3::splat(t * 2.0 + 9.0) + seed)) * 0.012;
        let mut radius = LOG_RADIUS[index] * (1.04 - 0.12 * t) * (1.0 + 0.13 * bark + 0.07 * ridge);
        if cut {
            radius *= if inner { 0.0 } else { 0.93 };
        }
        let position = from.lerp(to, t) + bend + out * radius;
        // Charred towards the fire, which is at the middle.
        let middle = Vec3::new(0.0, 0.10, 0.0);
        let char = step(0.50, 0.26, position.distance(middle) + 0.05 * bark);
        let fresh = if cut { Vec3::new(0.36, 0.23, 0.12) } else { Vec3::new(0.135, 0.088, 0.055) };
        let fresh = fresh * (1.0 + 0.55 * ridge.min(bark));
        let ash = Vec3::splat(0.13) * step(0.35, 0.75, noise(position * 60.0));
        let colour = fresh.lerp(Vec3::new(0.018, 0.016, 0.015) + ash, char);
        // The side that faces the coals glows in places; black surrounds them.
        let near = step(0.34, 0.20, position.distance(Vec3::new(0.0, 0.08, 0.0)));
        let faces_coals = step(-0.2, 0.6, out.dot((middle - position).normalize_or_zero()));
        let hot = near * faces_coals * (0.65 + 0.55 * noise(position * 24.0 + seed));
        let colour = colour * (1.0 - 0.95 * step(0.05, 0.3, hot));
        Sample { glow: step(0.38, 0.95, hot), ..Sample::new(position, colour) }
    });
}

fn stone(obj: &mut Obj, index: usize) {
    let a = angle(index, 13) + 0.14 * (random(index, 21) - 0.5);
    let distance = 0.78 + 0.05 * (random(index, 22) - 0.5);
    let size = 0.115 + 0.05 * random(index, 23);
    let flat = 0.62 + 0.25 * random(index, 24);
    let long = 1.0 + 0.25 * random(index, 25);
    let at = polar(distance, a, 0.0);
    let centre = at + Vec3::Y * (ground(at.x, at.z) + 0.45 * size * flat);
    let tangent = polar(1.0, a + std::f32::consts::FRAC_PI_2, 0.0);
    let seed = Vec3::splat(5.3 * index as f32);
    let tone = 0.7 + 0.6 * random(index, 26);
    let tint = Vec3::new(0.21, 0.20, 0.19).lerp(Vec3::new(0.23, 0.185, 0.15), random(index, 27));
    obj.lump("stone", 2, |direction| {
        let bump = 1.0 + 0.24 * fractal(direction * 1.3 + seed);
        // Flat facets: pull the surface in where it reaches beyond a few planes.
        let cut = (0..5).fold(f32::MAX, |least, plane| {
            let normal = Vec3::new(random(plane, 31) - 0.5, random(plane, 32) - 0.5, random(index + plane, 33) - 0.5);
            let along = normal.normalize_or(Vec3::Y).dot(direction);
            if along > 0.1 { least.min(0.86 / along) } else { least }
        });
        let mut offset = direction * size * bump.min(cut);
        offset.y *= flat;
        offset += tangent * (long - 1.0) * tangent.dot(offset);
        let position = centre + offset;
        let soot = step(0.2, 0.9, -direction.dot(polar(1.0, a, 0.0))) * 0.8;
        let lichen = 1.0 + 0.35 * fractal(position * 14.0);
        Sample::new(position, tint * tone * lichen * (1.0 - soot))
    });
}

fn coal(obj: &mut Obj, index: usize) {
    let distance = 0.31 * ((index as f32 + 0.5) / COALS as f32).sqrt();
    let a = 2.399_963 * index as f32 + 0.5 * random(index, 42);
    let size = 0.024 + 0.024 * random(index, 43);
    let heap = 0.05 * step(0.33, 0.0, distance);
    let at = polar(distance, a, 0.0);
    let centre = at + Vec3::Y * (ground(at.x, at.z) + 0.5 * size + heap);
    let seed = Vec3::splat(3.1 * index as f32);
    let heat = (0.3 + 0.7 * random(index, 44)) * step(0.40, 0.10, distance);
    // Some are covered in ash and do not glow.
    let ashen = random(index, 45) > 0.78;
    obj.lump("stone", 1, |direction| {
        let bump = 1.0 + 0.3 * noise(direction * 1.7 + seed);
        let squash = Vec3::new(1.15, 0.75, 0.95);
        let position = centre + direction * squash * size * bump;
        let grey = Vec3::splat(0.07 + 0.09 * (0.5 + 0.5 * noise(position * 70.0)));
        // The sides glow more than the top.
        let bare = 0.25 + 0.75 * step(0.9, 0.0, direction.y + 0.5 * noise(direction * 2.0 + seed * 2.0));
        let glow = heat * bare * step(-0.7, 0.6, noise(position * 45.0));
        Sample { glow: if ashen { 0.0 } else { glow.max(0.04) }, ..Sample::new(position, grey) }
    });
}

fn earth(obj: &mut Obj) {
    let (rows, columns) = (30, 56);
    obj.surface("earth", [rows, columns], true, |row, column| {
        // Rows go from the rim to the middle, closer and closer.
        let t = 1.0 - row as f32 / (rows - 1) as f32;
        let distance = 3.0 * t * (0.35 + 0.65 * t);
        let at = polar(distance, angle(column, columns), 0.0);
        let grain = fractal(at * 5.0 + 3.0) + 0.6 * noise(at * 17.0);
        let soil = Vec3::new(0.095, 0.066, 0.042) * (1.0 + 0.45 * grain);
        let ash = Vec3::new(0.10, 0.096, 0.092) * (1.0 + 0.5 * grain);
        let burnt = Vec3::new(0.022, 0.018, 0.015);
        let scorched = soil.lerp(burnt, step(1.05, 0.6, distance + 0.12 * grain));
        let colour = scorched.lerp(ash, step(0.48, 0.28, distance + 0.10 * grain));
        Sample::new(Vec3::new(at.x, ground(at.x, at.z), at.z), colour)
    });
}
