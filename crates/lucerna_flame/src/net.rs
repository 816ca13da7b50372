//! Control nets: the points that a flame's surface is drawn through (paper 003, section 4.3, equation 1).
//!
//! A row has M + 3 points, in the order of the authors' program: the top of the nearest lead
//! skeleton, M particles of a peripheral skeleton downwards, its root, the root of the lead skeleton.
//! (The paper prints M + 2: it counts the peripheral root among the M particles.)

use crate::spine::Spine;
use glam::Vec3;

/// How the raw points of a peripheral skeleton become control points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shaping {
    /// Away from the wick, where the spine stands upright.
    pub(crate) outward: Vec3,
    /// Least distance outwards from the spine, m: the surface never turns inside out.
    pub(crate) least_m: f32,
    /// Distances from the spine are bent to stay below this, m.
    pub(crate) most_m: f32,
    /// How far the oldest point is drawn in, 0 to 1.
    pub(crate) taper: f32,
    /// Factor on distances from the spine: a closed cubic through four points passes at 2/3 of their distance.
    pub(crate) spread: f32,
}

/// Highest control point of a peripheral skeleton, as a share of the spine: above it the tip closes.
pub(crate) const HIGHEST: f32 = 0.93;

/// Least distance of neighbouring control points along the spine, as a share of the mean.
const LEAST_STEP: f32 = 0.05;
/// How far control points may lie towards the inside of a bend, as a share of its radius: beyond its middle, rings
/// of the surface would cross.
const BEND: f32 = 0.6;

/// Takes a peripheral chain (root first) apart: `row` becomes offsets from the spine, and `heights` where along it.
pub(crate) fn unfold(spine: &Spine<'_>, row: &mut [Vec3], heights: &mut [f32]) {
    let last = row.len().max(2) - 1;
    let mut segment = 0;
    let tip = spine.points.len() - 1;
    let end = (spine.points[tip] - spine.points[tip - 1]).normalize_or(Vec3::Y);
    for (point, height) in row.iter_mut().zip(heights.iter_mut()) {
        let (length, foot, at) = spine.project(*point, segment);
        segment = at;
        let mut offset = *point - foot;
        *height = length;
        if length >= spine.total() {
            let beyond = offset.dot(end).max(0.0);
            offset -= end * beyond;
            *height += beyond;
        }
        *point = offset;
    }
    // Points that the air has crowded together keep their order.
    let least_step = LEAST_STEP * spine.total() / last as f32;
    for k in 1..heights.len() {
        heights[k] = heights[k].max(heights[k - 1] + least_step);
    }
    // A chain that overtakes its spine is compressed as a whole, so that its order stays.
    let limit = HIGHEST * spine.total();
    if heights[last] > limit {
        let shrink = limit / heights[last].max(1e-12);
        heights.iter_mut().for_each(|h| *h *= shrink);
    }
}

/// A row at known distances outwards from the spine, for [`shape`].
pub(crate) fn around(spine: &Spine<'_>, row: &mut [Vec3], heights: &mut [f32], outward: Vec3, radii: &[f32]) {
    let last = row.len().max(2) - 1;
    for (k, ((point, height), radius)) in row.iter_mut().zip(heights).zip(radii).enumerate() {
        *height = HIGHEST * spine.total() * k as f32 / last as f32;
        *point = spine.lean(*height) * outward * *radius;
    }
}

/// Turns offsets and heights of a chain into control points. `room` is how far each may stray to the side.
pub(crate) fn shape(spine: &Spine<'_>, row: &mut [Vec3], heights: &[f32], room: &[f32], how: Shaping) {
    let last = row.len().max(2) - 1;
    for (k, ((point, height), room)) in row.iter_mut().zip(heights).zip(room).enumerate() {
        let x = k as f32 / last as f32;
        let narrow = 1.0 - how.taper * x * x;
        let lean = spine.lean(*height);
        let (outward, way) = (lean * how.outward, lean * Vec3::Y);
        let side = outward.cross(way);
        // Only what is across the spine, and in the row's own quarter: rows that swap places turn the surface over.
        let out = point.dot(outward).max(how.least_m * narrow);
        let most_aside = out.min(*room);
        let aside = point.dot(side).clamp(-most_aside, most_aside);
        let mut offset = outward * out + side * aside;
        // Eddies that tear a chain far away from its spine would stretch the surface to a sheet.
        let far = (offset.length_squared() / (how.most_m * how.most_m)).min(1e12);
        offset /= (1.0 + far * far).sqrt().sqrt();
        offset *= narrow * how.spread;
        let bend = spine.bend(*height);
        offset -= bend * ((offset.dot(bend) - BEND).max(0.0) / bend.length_squared().max(1e-12));
        *point = spine.at(*height) + offset;
    }
}

/// Writes one row of the net from the shaped chain and its spine.
pub(crate) fn write_row(out: &mut [[f32; 3]], spine: &Spine<'_>, row: &[Vec3]) {
    let (bottom, top) = (spine.points[0], spine.points[spine.points.len() - 1]);
    let points = std::iter::once(top).chain(row.iter().rev().copied()).chain(std::iter::once(bottom));
    for (to, from) in out.iter_mut().zip(points) {
        *to = from.to_array();
    }
}

/// Least cosine between the way down a flame and the area vector of a ring of its net.
const LEAST_FACING: f32 = 0.3;
/// How often rings are looked at, and how far one that does not face the root is drawn to an even one each time.
const ROUNDS: usize = 5;
const EVEN: f32 = 0.5;

/// Draws rings of a net that the air has turned against their neighbours to even ones: as wide on the mean, at one
/// height, across the spines. Other rings stay as they are. `spines` has that of each row, and the row's outward
/// direction where it stands upright.
pub(crate) fn relax<'a>(net: &mut [[f32; 3]], columns: usize, spines: impl Fn(usize) -> (Spine<'a>, Vec3)) {
    let rows = net.len() / columns;
    for _ in 0..ROUNDS {
        let mut even = true;
        for c in 1..columns - 1 {
            let at = |r: usize, c: usize| Vec3::from(net[r % rows * columns + c]);
            let middle = |c: usize| (0..rows).map(|r| at(r, c)).sum::<Vec3>() / rows as f32;
            let (center, down) = (middle(c), middle(c + 1) - middle(c - 1));
            let area = (0..rows).map(|r| (at(r, c) - center).cross(at(r + 1, c) - center)).sum::<Vec3>();
            if area.dot(down) >= LEAST_FACING * area.length() * down.length() {
                continue;
            }
            even = false;
            let (mut share, mut width) = (0.0, 0.0);
            for r in 0..rows {
                let spine = spines(r).0;
                let length = spine.length_at(at(r, c));
                share += length / spine.total().max(1e-12);
                width += spine.at(length).distance(at(r, c));
            }
            let (share, width) = (share / rows as f32, width / rows as f32);
            for r in 0..rows {
                let (spine, outward) = spines(r);
                let height = share * spine.total();
                let target = spine.at(height) + spine.lean(height) * outward * width;
                let point = &mut net[r * columns + c];
                *point = Vec3::from(*point).lerp(target, EVEN).to_array();
            }
        }
        if even {
            break;
        }
    }
}

/// Draws a net over to a calmer one, no farther than it takes for `is_right_side_out`.
///
/// The share is found by halving, so it grows and fades smoothly with what the air does to the flame. What
/// `is_right_side_out` sees last is the net that stays, so that it may keep what it measures.
pub(crate) fn calm(
    net: &mut [[f32; 3]],
    raw: &mut Vec<[f32; 3]>,
    calmer: impl Fn(usize) -> Vec3,
    mut is_right_side_out: impl FnMut(&[[f32; 3]]) -> bool,
) {
    if is_right_side_out(net) {
        return;
    }
    raw.clear();
    raw.extend_from_slice(net);
    let draw = |net: &mut [[f32; 3]], share: f32| {
        for (i, (to, from)) in net.iter_mut().zip(raw.iter()).enumerate() {
            *to = Vec3::from(*from).lerp(calmer(i), share).to_array();
        }
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..6 {
        let middle = 0.5 * (low + high);
        draw(net, middle);
        *(if is_right_side_out(net) { &mut high } else { &mut low }) = middle;
    }
    draw(net, high);
    is_right_side_out(net);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spine::{Limits, straighten};

    const LIMITS: Limits = Limits { stands: Vec3::Y, least_m: 0.1, bend_m: 0.01, along: Vec3::ZERO };

    fn upright() -> (Vec<Vec3>, Vec<f32>) {
        let mut points: Vec<Vec3> = (0..9).map(|k| Vec3::Y * (0.1 * k as f32)).collect();
        let mut lengths = vec![0.0; 9];
        straighten(&mut points, &mut lengths, &mut [Vec3::ZERO; 9], LIMITS);
        (points, lengths)
    }

    #[test]
    fn without_taper_chains_are_taken_as_they_are() {
        let (points, lengths) = upright();
        let spine = Spine { points: &points, lengths: &lengths };
        let raw: Vec<Vec3> = (0..9).map(|k| Vec3::new(0.1, 0.08 * k as f32, 0.0)).collect();
        let mut row = raw.clone();
        let how = Shaping { outward: Vec3::X, least_m: 0.01, most_m: 1e6, taper: 0.0, spread: 1.0 };
        let mut heights = [0.0; 9];
        unfold(&spine, &mut row, &mut heights);
        shape(&spine, &mut row, &heights, &[f32::INFINITY; 9], how);
        assert!(row.iter().zip(&raw).all(|(a, b)| (*a - *b).length() < 1e-6), "{row:?}");
        let mut out = [[0.0; 3]; 11];
        write_row(&mut out, &spine, &row);
        assert!((Vec3::from(out[0]) - Vec3::Y * 0.8).length() < 1e-6 && out[10] == [0.0; 3]);
        assert_eq!((out[1], out[9]), (row[8].to_array(), row[0].to_array()));
    }

    #[test]
    fn chains_never_cross_or_overtake_their_spine() {
        let (points, lengths) = upright();
        let spine = Spine { points: &points, lengths: &lengths };
        let how = Shaping { outward: Vec3::X, least_m: 0.01, most_m: 0.2, taper: 0.5, spread: 1.0 };
        let mut row: Vec<Vec3> = (0..9).map(|k| Vec3::new(0.1 - 0.05 * k as f32, 0.3 * k as f32, 0.0)).collect();
        let mut heights = [0.0; 9];
        unfold(&spine, &mut row, &mut heights);
        shape(&spine, &mut row, &heights, &[f32::INFINITY; 9], how);
        assert!(row.iter().all(|p| p.x > 0.0 && p.y <= 0.8), "{row:?}");
        assert!(row.windows(2).all(|w| w[0].y < w[1].y), "{row:?}");
        let mut flat = [Vec3::ZERO; 9];
        straighten(&mut flat, &mut [0.0; 9], &mut [Vec3::ZERO; 9], LIMITS);
        assert!((flat[8].y - 0.1).abs() < 1e-6, "still air leaves a flame of the least height");
    }
}
