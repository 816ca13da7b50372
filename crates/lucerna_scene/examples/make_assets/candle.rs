//! A candle on a brass saucer on a table. The melted pool is at y = 0.

use crate::mesh::{Obj, Sample, angle, polar, table};
use crate::noise::{fractal, noise, random, step};
use glam::Vec3;

const MATERIALS: &str = "\
# Warm white wax, a charred wick whose tip glows, brass, oiled wood. Vertex colours multiply Kd and Ke;
# Tf is the share of light that goes on inside.
newmtl wax
Kd 1 1 1
Tf 0.7 0.7 0.7
newmtl wick
Kd 1 1 1
newmtl ember
Kd 0.3 0.1 0.05
Ke 0.05 0.009 0.0012
newmtl brass
Kd 1 1 1
newmtl wood
Kd 1 1 1
";

/// Where the saucer stands, m.
const TABLE_Y: f32 = -0.106;

const AROUND: usize = 56;

/// The profile of the wax from the middle of the pool outwards and down: radius and height, mm.
const WAX_MM: [[f32; 2]; 25] = [
    [0.0, 0.0],
    [1.5, 0.02],
    [3.5, 0.0],
    [5.5, 0.05],
    [7.2, 0.3],
    [8.6, 0.9],
    [9.6, 1.8],
    [10.3, 2.7],
    [10.8, 3.3],
    [11.3, 3.5],
    [11.7, 3.2],
    [12.0, 2.4],
    [12.1, 1.0],
    [12.05, -1.5],
    [12.0, -5.0],
    [12.0, -10.0],
    [12.0, -15.0],
    [12.0, -20.0],
    [12.0, -26.0],
    [12.0, -33.0],
    [12.0, -42.0],
    [12.0, -54.0],
    [12.0, -70.0],
    [12.0, -88.0],
    [12.0, -100.0],
];

/// Drips: angle, how far down they reach (m), width (rad).
const DRIPS: [[f32; 3]; 5] =
    [[0.9, 0.034, 0.17], [2.7, 0.019, 0.13], [3.15, 0.052, 0.19], [4.9, 0.026, 0.15], [5.9, 0.012, 0.12]];

/// The saucer from the middle of its upper side outwards, and back below: radius and height over the table, mm.
const SAUCER_MM: [[f32; 2]; 20] = [
    [0.0, 6.0],
    [12.5, 6.0],
    [12.9, 12.0],
    [13.4, 13.6],
    [14.3, 13.6],
    [14.8, 12.0],
    [15.2, 6.6],
    [17.0, 5.2],
    [24.0, 4.6],
    [34.0, 5.0],
    [41.0, 7.4],
    [45.0, 11.2],
    [46.4, 11.9],
    [47.0, 11.2],
    [43.0, 6.0],
    [36.0, 2.6],
    [28.0, 2.0],
    [27.0, 0.0],
    [25.0, 0.0],
    [24.0, 1.6],
];

pub(crate) fn parts() -> Vec<(&'static str, String)> {
    let mut candle = Obj::new("candle.mtl", 5);
    wax(&mut candle);
    wick(&mut candle);
    let mut saucer = Obj::new("candle.mtl", 5);
    brass(&mut saucer);
    planks(&mut saucer);
    vec![("candle.mtl", MATERIALS.to_owned()), ("candle.obj", candle.finish()), ("candle_table.obj", saucer.finish())]
}

fn wax(obj: &mut Obj) {
    // Rows go up on the outside: from the foot to the pool.
    let rows = WAX_MM.len();
    obj.surface("wax", [rows, AROUND], true, |row, column| {
        let [mut radius, mut y] = WAX_MM[rows - 1 - row].map(|mm| mm * 0.001);
        let a = angle(column, AROUND);
        let around = Vec3::new(a.cos(), 0.0, a.sin());
        let rim = step(0.008, 0.0105, radius);
        y += rim * step(-0.01, 0.002, y) * 0.0011 * noise(around * 1.7 + 3.0);
        radius *= 1.0 + rim * 0.012 * noise(around * 1.3 + Vec3::Y * y * 60.0);
        if radius > 0.0112 {
            radius += drips(a, y);
        }
        let melted = step(0.009, 0.004, radius);
        let colour = Vec3::new(0.80, 0.75, 0.65).lerp(Vec3::new(0.74, 0.64, 0.48), 0.6 * melted);
        Sample::new(polar(radius, a, y), colour * (1.0 + 0.03 * fractal(around * 2.0 + Vec3::Y * y * 90.0)))
    });
}

/// How far drips stand out, m.
fn drips(a: f32, y: f32) -> f32 {
    let mut out = 0.0_f32;
    for [at, reach, width] in DRIPS {
        let off = (a - at + 9.424_78).rem_euclid(std::f32::consts::TAU) - std::f32::consts::PI;
        let across = (-(off / width).powi(2)).exp();
        let along = step(-reach - 0.003, -reach + 0.001, y) * step(0.004, -0.002, y);
        let bead = (-((y + reach - 0.002) / 0.0035).powi(2)).exp();
        out = out.max(across * (0.0011 * along + 0.0009 * bead));
    }
    out
}

fn wick(obj: &mut Obj) {
    let (rows, columns) = (14, 10);
    obj.surface("wick", [rows, columns], true, |row, column| {
        let t = (row as f32 / (rows - 2) as f32).min(1.0);
        let a = angle(column, columns);
        // It stands straight, then bends over.
        let centre = Vec3::new(0.0016 * t * t * t, -0.001 + 0.010 * t - 0.0004 * t * t * t, 0.0004 * t * t);
        let twist = 1.0 + 0.12 * (2.0 * a + 14.0 * t).sin();
        let radius = 0.0006 * twist * table(&[[0.0, 1.0], [0.85, 0.95], [1.0, 0.6]], t);
        let radius = if row == rows - 1 { 0.0 } else { radius };
        let colour = Vec3::new(0.5, 0.42, 0.32).lerp(Vec3::splat(0.02), step(0.08, 0.3, t));
        Sample { glow: step(0.8, 1.0, t), ..Sample::new(centre + polar(radius, a, 0.0), colour) }
    });
}

fn brass(obj: &mut Obj) {
    let rows = SAUCER_MM.len();
    obj.surface("brass", [rows, AROUND], true, |row, column| {
        let [radius, y] = SAUCER_MM[rows - 1 - row].map(|mm| mm * 0.001);
        let a = angle(column, AROUND);
        let position = polar(radius, a, TABLE_Y + y);
        let worn = 0.5 + 0.5 * fractal(position * 90.0);
        Sample::new(position, Vec3::new(0.55, 0.38, 0.14).lerp(Vec3::new(0.36, 0.22, 0.08), worn))
    });
}

/// Seven planks, 0.6 m long, with grooves between them.
fn planks(obj: &mut Obj) {
    const ACROSS: [f32; 9] = [0.0, 0.012, 0.05, 0.2, 0.38, 0.6, 0.8, 0.988, 1.0];
    let width = 0.6 / 7.0;
    for plank in 0..7 {
        let tone = 0.8 + 0.4 * random(plank, 1);
        obj.surface("wood", [ACROSS.len(), 17], false, |row, column| {
            let across = ACROSS[row];
            let x = -0.3 + 0.6 * column as f32 / 16.0;
            let z = 0.3 - width * (plank as f32 + across);
            let groove = 0.003 * step(0.03, 0.0, across.min(1.0 - across));
            let grain = fractal(Vec3::new(x * 6.0, plank as f32 * 5.0, z * 130.0));
            let colour = Vec3::new(0.19, 0.095, 0.042) * tone * (1.0 + 0.35 * grain);
            let dark = if groove > 0.0015 { 0.25 } else { 1.0 };
            Sample::new(Vec3::new(x, TABLE_Y - groove, z), colour * dark)
        });
    }
}
