//! The centreline of a cloud of mesh vertices, straight, bent or closed to a ring.

use super::{Centreline, classify};
use glam::{Mat3, Vec3};

/// Slices in which the centreline is found; the roots are then placed along it.
const BINS: usize = 16;
/// Angles in which a ring is found.
const SECTORS: usize = 24;
/// How far inwards from a ring its hole begins, as a share of its radius.
const HOLE: f32 = 0.6;
/// Points farther from the line than so many times the median are strays.
const STRAY: f32 = 2.5;
/// Most clusters: the distances between all pairs are looked at.
const MAX_CLUSTERS: usize = 3000;

pub(super) fn centreline(vertices: &[Vec3]) -> Centreline {
    let clusters = cluster(vertices);
    let mean = clusters.iter().sum::<Vec3>() / clusters.len() as f32;
    if clusters.len() < 2 {
        return Centreline::Point(mean);
    }
    if let Some(ring) = ring(&clusters, mean) {
        return Centreline::Line(ring);
    }
    let (line, radius) = spine(&clusters);
    match classify(line, radius) {
        Centreline::Point(_) => Centreline::Point(mean),
        line @ Centreline::Line(_) => line,
    }
}

/// The closed line around a ring-shaped cloud, and the mean distance of its vertices from it.
pub(super) fn closed_ring(vertices: &[Vec3]) -> Option<(Vec<Vec3>, f32)> {
    let clusters = cluster(vertices);
    let mean = clusters.iter().sum::<Vec3>() / clusters.len() as f32;
    let mut line = ring(&clusters, mean)?;
    line.push(line[0]);
    let radius = clusters.iter().map(|p| distance_to_line(&line, *p)).sum::<f32>() / clusters.len() as f32;
    Some((line, radius.max(1e-6)))
}

/// One mean point for each occupied cell of a coarse grid: evens out how densely a mesh is tessellated.
fn cluster(vertices: &[Vec3]) -> Vec<Vec3> {
    let (low, high) = vertices.iter().fold((vertices[0], vertices[0]), |(l, h), p| (l.min(*p), h.max(*p)));
    let mut edge = (high - low).length() / 40.0;
    if edge < 1e-9 {
        return vec![low];
    }
    loop {
        let mut keyed: Vec<(u32, u32)> = vertices
            .iter()
            .enumerate()
            .map(|(i, p)| {
                let cell = ((*p - low) / edge).as_uvec3();
                (cell.x | cell.y << 8 | cell.z << 16, i as u32)
            })
            .collect();
        keyed.sort_unstable();
        let means: Vec<Vec3> = keyed
            .chunk_by(|a, b| a.0 == b.0)
            .map(|same| same.iter().map(|&(_, i)| vertices[i as usize]).sum::<Vec3>() / same.len() as f32)
            .collect();
        if means.len() <= MAX_CLUSTERS {
            return means;
        }
        edge *= 1.5;
    }
}

/// The open line around a ring-shaped cloud, if it is one.
fn ring(points: &[Vec3], mean: Vec3) -> Option<Vec<Vec3>> {
    let normal = thinnest_axis(points, mean);
    let a = normal.any_orthonormal_vector();
    let b = normal.cross(a);
    let count = points.len() as f32;
    let radius = points.iter().map(|p| (*p - mean).reject_from_normalized(normal).length()).sum::<f32>() / count;
    let (mut spread, mut inside) = (0.0, 0.0);
    let mut sectors = [(Vec3::ZERO, 0.0_f32); SECTORS];
    for p in points {
        let d = *p - mean;
        let off = d.reject_from_normalized(normal).length() - radius;
        inside += f32::from(u8::from(off < -HOLE * radius));
        spread += off * off + d.dot(normal).powi(2);
        let turn = d.dot(b).atan2(d.dot(a)) / std::f32::consts::TAU + 0.5;
        let sector = &mut sectors[((turn * SECTORS as f32) as usize).min(SECTORS - 1)];
        *sector = (sector.0 + *p, sector.1 + 1.0);
    }
    let thin = (spread / count).sqrt() < 0.5 * radius;
    // A few stray points of a scan do not fill the hole; a disc does.
    if !thin || inside > 0.02 * count || sectors.iter().any(|s| s.1 < 1.0) {
        return None;
    }
    Some(sectors.iter().map(|s| s.0 / s.1).collect())
}

/// The direction in which the cloud extends least, upwards.
fn thinnest_axis(points: &[Vec3], mean: Vec3) -> Vec3 {
    let mut covariance = Mat3::ZERO;
    for p in points {
        let d = *p - mean;
        covariance += Mat3::from_cols(d * d.x, d * d.y, d * d.z);
    }
    // Power iteration on trace - C, whose largest eigenvalue belongs to the smallest of C.
    let trace = covariance.x_axis.x + covariance.y_axis.y + covariance.z_axis.z;
    let complement = Mat3::from_diagonal(Vec3::splat(trace)) - covariance;
    let mut axis = Vec3::new(0.31, 0.9, 0.29);
    for _ in 0..200 {
        axis = (complement * axis).normalize_or(Vec3::Y);
    }
    if axis.y < 0.0 { -axis } else { axis }
}

/// The line through the barycentres of slices at equal distance along the cloud, and its mean radius.
///
/// Distance is measured through the cloud, from point to near point, so that bends are followed.
fn spine(points: &[Vec3]) -> (Vec<Vec3>, f32) {
    let reach = 1.5 * longest_tree_edge(points);
    let start = farthest(&distances(points, 0, reach));
    let along = distances(points, start, reach);
    let end = along.iter().copied().fold(0.0_f32, f32::max).max(1e-9);
    let mut line = barycentres(points, |i| (along[i] / end * BINS as f32) as usize);
    // Points far from the line, as a scan has, pull it aside: the second line is without them.
    let off: Vec<f32> = points.iter().map(|p| distance_to_line(&line, *p)).collect();
    let mut sorted = off.clone();
    sorted.sort_unstable_by(f32::total_cmp);
    let most = STRAY * sorted[sorted.len() / 2];
    let near: Vec<usize> = (0..points.len()).filter(|&i| off[i] <= most).collect();
    let kept: Vec<Vec3> = near.iter().map(|&i| points[i]).collect();
    if near.len() < points.len() {
        line = barycentres(&kept, |i| (along[near[i]] / end * BINS as f32) as usize);
    }
    extend(&mut line, &kept);
    line.reverse();
    extend(&mut line, &kept);
    line.reverse();
    let radius = kept.iter().map(|p| distance_to_line(&line, *p)).sum::<f32>() / kept.len() as f32;
    (line, radius)
}

/// The barycentre of each slice that has points, smoothed along the line.
fn barycentres(points: &[Vec3], bin_of: impl Fn(usize) -> usize) -> Vec<Vec3> {
    let mut bins = [(Vec3::ZERO, 0.0_f32); BINS];
    for (i, p) in points.iter().enumerate() {
        let bin = &mut bins[bin_of(i).min(BINS - 1)];
        *bin = (bin.0 + *p, bin.1 + 1.0);
    }
    let mut line: Vec<Vec3> = bins.iter().filter(|b| b.1 > 0.0).map(|b| b.0 / b.1).collect();
    let raw = line.clone();
    for (point, w) in line.iter_mut().skip(1).zip(raw.windows(3)) {
        *point = (w[0] + w[1] * 2.0 + w[2]) * 0.25;
    }
    line
}

/// Draws the first point of the line out to where the cloud ends.
fn extend(line: &mut [Vec3], points: &[Vec3]) {
    let [first, second, ..] = *line else { return };
    let outward = (first - second).normalize_or_zero();
    let near = 2.0 * first.distance(second);
    let beyond =
        points.iter().filter(|p| p.distance(first) <= near).map(|p| (*p - first).dot(outward)).fold(0.0_f32, f32::max);
    line[0] = first + outward * beyond;
}

fn distance_to_line(line: &[Vec3], p: Vec3) -> f32 {
    let to = |w: &[Vec3]| {
        let d = w[1] - w[0];
        let t = ((p - w[0]).dot(d) / d.length_squared().max(1e-18)).clamp(0.0, 1.0);
        p.distance(w[0] + d * t)
    };
    line.windows(2).map(to).fold(f32::INFINITY, f32::min)
}

/// The longest edge of the minimal spanning tree (Prim): shorter edges alone do not connect the cloud.
fn longest_tree_edge(points: &[Vec3]) -> f32 {
    let mut gap = vec![f32::INFINITY; points.len()];
    gap[0] = 0.0;
    let mut done = vec![false; points.len()];
    let mut longest = 0.0_f32;
    for _ in 0..points.len() {
        let Some(next) = nearest_open(&gap, &done) else { break };
        done[next] = true;
        longest = longest.max(gap[next]);
        for (i, p) in points.iter().enumerate() {
            if !done[i] {
                gap[i] = gap[i].min(p.distance(points[next]));
            }
        }
    }
    longest
}

/// Shortest ways from `start` over steps no longer than `reach` (Dijkstra).
fn distances(points: &[Vec3], start: usize, reach: f32) -> Vec<f32> {
    let mut far = vec![f32::INFINITY; points.len()];
    far[start] = 0.0;
    let mut done = vec![false; points.len()];
    while let Some(next) = nearest_open(&far, &done) {
        done[next] = true;
        for (i, p) in points.iter().enumerate() {
            let step = p.distance(points[next]);
            if step <= reach {
                far[i] = far[i].min(far[next] + step);
            }
        }
    }
    far
}

fn nearest_open(distance: &[f32], done: &[bool]) -> Option<usize> {
    let open = (0..distance.len()).filter(|&i| !done[i] && distance[i].is_finite());
    open.min_by(|&a, &b| distance[a].total_cmp(&distance[b]))
}

fn farthest(distance: &[f32]) -> usize {
    (0..distance.len()).max_by(|&a, &b| distance[a].total_cmp(&distance[b])).unwrap_or(0)
}
