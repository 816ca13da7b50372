//! A hall: a long table, chandeliers and ledges with 200 candles, ten columns with two torches each.

use crate::mesh::{Obj, Sample, angle, polar};
use crate::noise::{fractal, noise, random, step};
use glam::{Quat, Vec3};
use std::f32::consts::FRAC_PI_2;
use std::fmt::Write;

const MATERIALS: &str = "\
# Stone, oak, iron, wax and pitch. Vertex colours multiply Kd and Ke; Tf is the share of light that goes on inside.
newmtl stone
Kd 1 1 1
newmtl wood
Kd 1 1 1
newmtl iron
Kd 1 1 1
newmtl ember
Kd 0.2 0.06 0.03
Ke 0.12 0.016 0.0015
newmtl wax
Kd 1 1 1
Tf 0.7 0.7 0.7
";

/// Half of the hall's width, its height, and where it begins and ends, m.
const HALF: f32 = 4.0;
const HIGH: f32 = 4.6;
const NEAR: f32 = 2.5;
const FAR: f32 = -12.5;
/// Where the columns stand.
const COLUMN_X: f32 = 2.3;
const COLUMN_R: f32 = 0.24;
const TABLE_Y: f32 = 0.76;
const LEDGE_Y: f32 = 1.15;
const RING_Y: f32 = 2.45;
const RING_R: f32 = 0.6;

/// Where something stands, and how far it is turned, degrees.
type Places = Vec<(Vec3, f32)>;

fn column_z(i: usize) -> f32 {
    -0.5 - 2.5 * i as f32
}

fn chandelier(i: usize) -> Vec3 {
    Vec3::new(0.0, RING_Y, -0.8 - 2.4 * i as f32)
}

/// Where the wax of the candles melts.
fn candles() -> Places {
    let mut at = Vec::new();
    for i in 0..60 {
        let (row, along) = (i % 3, i / 3);
        let shift = |purpose| 0.1 * (random(i, purpose) - 0.5);
        let x = [-0.3, 0.0, 0.3][row] + shift(50);
        let z = -1.4 - 0.42 * along as f32 - [0.1, 0.0, 0.2][row] + shift(51);
        at.push(Vec3::new(x, TABLE_Y + 0.06 + 0.14 * random(i, 52), z));
    }
    for i in 0..100 {
        let a = angle(i % 20, 20);
        at.push(chandelier(i / 20) + polar(RING_R, a, 0.10 + 0.05 * random(i, 53)));
    }
    for i in 0..40 {
        let side = if i % 2 == 0 { -1.0 } else { 1.0 };
        let z = -0.6 - 0.56 * (i / 2) as f32 + 0.12 * random(i, 54);
        at.push(Vec3::new(side * (HALF - 0.2), LEDGE_Y + 0.06 + 0.12 * random(i, 55), z));
    }
    at.into_iter().enumerate().map(|(i, at)| (at, (360.0 * random(i, 56)).floor())).collect()
}

/// Where the heads of the torches are: on the inner and the near side of each column.
fn torches() -> Places {
    let mut at = Vec::new();
    for i in 0..5 {
        for side in [-1.0_f32, 1.0] {
            let column = Vec3::new(side * COLUMN_X, 2.0, column_z(i));
            // A torch leans towards +x where it is not turned.
            let inwards = if side < 0.0 { 0.0 } else { 180.0 };
            at.push((column + Vec3::X * (-side * (COLUMN_R + 0.13)), inwards));
            at.push((column + Vec3::Z * (COLUMN_R + 0.13), 270.0));
        }
    }
    at
}

pub(crate) fn parts() -> Vec<(&'static str, String)> {
    let mut room = Obj::new("hall.mtl", 3);
    shell(&mut room);
    columns(&mut room);
    furniture(&mut room);
    let mut candle = Obj::new("hall.mtl", 4);
    wax(&mut candle);
    let mut torch = Obj::new("hall.mtl", 4);
    stick(&mut torch);
    let mut ring = Obj::new("hall.mtl", 3);
    wheel(&mut ring);
    vec![
        ("hall.mtl", MATERIALS.to_owned()),
        ("hall_room.obj", room.finish()),
        ("hall_candle.obj", candle.finish()),
        ("hall_torch.obj", torch.finish()),
        ("hall_chandelier.obj", ring.finish()),
        ("hall.ron", scene()),
    ]
}

/// The scene file: what stands where is put into what is written by hand.
fn scene() -> String {
    let rings: Places = (0..5).map(|i| (chandelier(i), 0.0)).collect();
    let mut text = include_str!("hall.ron.in").to_owned();
    for (name, places) in [("candles", candles()), ("torches", torches()), ("chandeliers", rings)] {
        let (mut at, mut turns) = (String::new(), String::new());
        for (i, (place, turn)) in places.iter().enumerate() {
            let gap = if i % 5 == 0 { "\n                " } else { " " };
            write!(at, "{gap}({:.3}, {:.3}, {:.3}),", place.x, place.y, place.z).unwrap();
            let gap = if i % 20 == 0 { "\n                " } else { " " };
            write!(turns, "{gap}{turn:.0},").unwrap();
        }
        text = text.replace(&format!("<{name}>"), &format!("[{at}\n            ]"));
        text = text.replace(&format!("<{name} turned>"), &format!("[{turns}\n            ]"));
    }
    text
}

fn blocks(place: Vec3, size: [f32; 2], [u, v]: [f32; 2], tone: Vec3) -> Vec3 {
    // Courses of blocks with mortar between them.
    let course = (v / size[1]).floor();
    let shift = if course.rem_euclid(2.0) < 1.0 { 0.0 } else { 0.5 };
    let block = (u / size[0] + shift).floor();
    let own = 0.8 + 0.4 * random((block + 97.0 * course).abs() as usize, 60);
    tone * own * (1.0 + 0.25 * fractal(place * 2.5))
}

fn shell(obj: &mut Obj) {
    let stone = Vec3::new(0.30, 0.27, 0.235);
    let long = NEAR - FAR;
    // Floor: slabs.
    obj.surface("stone", [46, 25], false, |row, column| {
        let (u, v) = (column as f32 / 24.0, row as f32 / 45.0);
        let place = Vec3::new(HALF * (2.0 * u - 1.0), 0.0, NEAR - long * v);
        let slab = (row / 2 * 31 + column / 2) as f32;
        let tone = Vec3::new(0.20, 0.175, 0.15) * (0.75 + 0.5 * random(slab as usize, 61));
        Sample::new(place, tone * (1.0 + 0.3 * fractal(place * 1.7)))
    });
    // Ceiling: boards.
    obj.surface("wood", [9, 17], false, |row, column| {
        let (u, v) = (column as f32 / 16.0, row as f32 / 8.0);
        let place = Vec3::new(HALF * (1.0 - 2.0 * u), HIGH + 0.5 * (1.0 - (2.0 * u - 1.0).abs()), NEAR - long * v);
        Sample::new(place, Vec3::new(0.12, 0.075, 0.045) * (0.7 + 0.6 * random(column, 62)))
    });
    for side in [-1.0_f32, 1.0] {
        obj.surface("stone", [13, 49], false, |row, column| {
            let (along, up) = (column as f32 / 48.0, row as f32 / 12.0);
            let z = if side < 0.0 { NEAR - long * along } else { FAR + long * along };
            let place = Vec3::new(side * HALF, HIGH * up, z);
            let sooty = 1.0 - 0.35 * step(2.0, HIGH, place.y);
            Sample::new(place, blocks(place, [0.62, 0.38], [z, place.y], stone) * sooty)
        });
    }
    for end in [FAR, NEAR] {
        obj.surface("stone", [13, 25], false, |row, column| {
            let (across, up) = (column as f32 / 24.0, row as f32 / 12.0);
            let way = if end < 0.0 { 1.0 } else { -1.0 };
            let x = way * HALF * (2.0 * across - 1.0);
            let gable = 0.5 * (1.0 - (2.0 * across - 1.0).abs());
            let place = Vec3::new(x, (HIGH + gable) * up, end);
            Sample::new(place, blocks(place, [0.62, 0.38], [x, place.y], stone))
        });
    }
    for i in 0..6 {
        let z = column_z(i) + 1.25;
        block(obj, "wood", Vec3::new(0.0, HIGH - 0.12, z), Vec3::new(HALF, 0.12, 0.10), Vec3::new(0.10, 0.062, 0.038));
    }
}

fn columns(obj: &mut Obj) {
    let profile = [
        [0.36, 0.0],
        [0.36, 0.18],
        [0.28, 0.26],
        [COLUMN_R, 0.34],
        [COLUMN_R, 1.2],
        [COLUMN_R, 2.2],
        [COLUMN_R, 3.2],
        [COLUMN_R, HIGH - 0.6],
        [0.30, HIGH - 0.46],
        [0.36, HIGH - 0.34],
        [0.36, HIGH - 0.2],
    ];
    for i in 0..10 {
        let foot = Vec3::new(if i < 5 { -COLUMN_X } else { COLUMN_X }, 0.0, column_z(i % 5));
        obj.surface("stone", [profile.len(), 16], true, |row, column| {
            let [radius, y] = profile[row];
            let place = foot + polar(radius, angle(column, 16), y);
            Sample::new(place, Vec3::new(0.33, 0.30, 0.26) * (1.0 + 0.3 * fractal(place * 3.0)))
        });
    }
}

fn furniture(obj: &mut Obj) {
    let oak = Vec3::new(0.17, 0.095, 0.05);
    let (middle, long) = (-5.55, 4.65);
    for board in 0..5 {
        let x = 0.19 * (board as f32 - 2.0);
        let tone = oak * (0.8 + 0.4 * random(board, 63));
        block(obj, "wood", Vec3::new(x, TABLE_Y - 0.03, middle), Vec3::new(0.093, 0.03, long), tone);
    }
    for leg in 0..10 {
        let x = if leg % 2 == 0 { -0.36 } else { 0.36 };
        let z = middle - long + 0.3 + 2.17 * (leg / 2) as f32;
        block(obj, "wood", Vec3::new(x, 0.35, z), Vec3::new(0.05, 0.35, 0.05), oak * 0.8);
    }
    for side in [-1.0, 1.0] {
        block(obj, "wood", Vec3::new(side * 0.95, 0.44, middle), Vec3::new(0.15, 0.02, long - 0.2), oak);
        for leg in 0..5 {
            let z = middle - long + 0.5 + 2.07 * leg as f32;
            block(obj, "wood", Vec3::new(side * 0.95, 0.21, z), Vec3::new(0.12, 0.21, 0.03), oak * 0.8);
        }
        let ledge = Vec3::new(side * (HALF - 0.17), LEDGE_Y - 0.06, -6.0);
        block(obj, "stone", ledge, Vec3::new(0.17, 0.06, 6.1), Vec3::new(0.34, 0.31, 0.27));
    }
}

/// A box about a middle, half of whose edges are given.
fn block(obj: &mut Obj, material: &str, middle: Vec3, half: Vec3, colour: Vec3) {
    for axis in 0..3 {
        let mut out = Vec3::ZERO;
        out[axis] = 1.0;
        let (right, up) = (Vec3::from([out.y, out.z, out.x]), Vec3::from([out.z, out.x, out.y]));
        for side in [1.0, -1.0] {
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(r, u)| {
                let place = middle + half * (out * side + right * (r * side) + up * u);
                Sample::new(place, colour * (1.0 + 0.2 * noise(place * 3.0)))
            });
            obj.face(material, &corners);
        }
    }
}

/// A candle whose wax melts at y = 0, and its wick.
fn wax(obj: &mut Obj) {
    let profile =
        [[0.0119, -0.22], [0.0119, -0.03], [0.012, -0.003], [0.0113, 0.0028], [0.0095, 0.0015], [0.0, -0.001]];
    obj.surface("wax", [profile.len(), 10], true, |row, column| {
        let [radius, y] = profile[row];
        let a = angle(column, 10);
        let drip = 1.0 + 0.12 * noise(polar(1.7, a, 3.0)) * step(-0.2, -0.02, y);
        Sample::new(polar(radius * drip, a, y), Vec3::new(0.80, 0.74, 0.62))
    });
    obj.surface("iron", [3, 5], true, |row, column| {
        let [radius, y] = [[0.0008, -0.002], [0.0007, 0.006], [0.0, 0.0075]][row];
        Sample::new(polar(radius, angle(column, 5), y), Vec3::splat(0.02))
    });
}

/// A torch that leans towards +x, its head at the origin, and the iron that holds it to the column.
fn stick(obj: &mut Obj) {
    let lean = |point: Vec3| Quat::from_rotation_z(-0.30) * point;
    let profile = [
        [0.010, -0.62, 0.0],
        [0.016, -0.12, 0.0],
        [0.036, -0.11, 0.0],
        [0.052, -0.07, 0.0],
        [0.056, -0.04, 0.2],
        [0.048, -0.008, 0.8],
        [0.022, 0.012, 1.0],
        [0.0, 0.018, 1.0],
    ];
    obj.surface("wood", [profile.len(), 12], true, |row, column| {
        let [radius, y, hot] = profile[row];
        let a = angle(column, 12);
        let place = lean(polar(radius, a, y));
        let glow = hot * step(0.0, 0.6, noise(polar(2.0, a, 40.0 * y)));
        let colour = if y < -0.115 { Vec3::new(0.15, 0.085, 0.045) } else { Vec3::new(0.035, 0.026, 0.02) };
        Sample { glow, ..Sample::new(place, colour) }
    });
    let arm = lean(Vec3::Y * -0.3);
    block(obj, "iron", arm - Vec3::X * 0.06, Vec3::new(0.09, 0.012, 0.012), Vec3::splat(0.05));
}

/// A wheel of iron with its middle at the origin, on four chains.
fn wheel(obj: &mut Obj) {
    let iron = |place: Vec3| Sample::new(place, Vec3::new(0.07, 0.06, 0.055) * (1.0 + 0.3 * noise(place * 20.0)));
    obj.surface("iron", [5, 40], true, |row, column| {
        let [out, y] = [[0.018, -0.03], [0.018, 0.03], [-0.018, 0.03], [-0.018, -0.03], [0.018, -0.03]][row];
        iron(polar(RING_R + out, angle(column, 40), y))
    });
    for arm in 0..4 {
        let a = angle(arm, 4);
        let turn = Quat::from_rotation_y(a);
        // A spoke, and a chain as a thin bar up to the ceiling.
        for (from, to, half) in [
            (Vec3::ZERO, Vec3::X * RING_R, 0.012),
            (Vec3::X * RING_R, Vec3::new(0.05, HIGH + 0.4 - RING_Y, 0.0), 0.006),
        ] {
            let way = (to - from).normalize();
            let side = Vec3::Z * half;
            let up = way.cross(Vec3::Z) * half;
            obj.surface("iron", [2, 4], true, |row, column| {
                let (sin, cos) = (FRAC_PI_2 * column as f32).sin_cos();
                iron(turn * ([from, to][row] + side * cos - up * sin))
            });
        }
    }
    // Each candle stands in a dish.
    for i in 0..20 {
        let middle = polar(RING_R, angle(i, 20), 0.035);
        obj.surface("iron", [3, 8], true, |row, column| {
            let [radius, y] = [[0.012, 0.0], [0.034, 0.008], [0.0, 0.004]][row];
            iron(middle + polar(radius, angle(column, 8), y))
        });
    }
}
