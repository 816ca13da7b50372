//! Triangle meshes as lists of cells.
//!
//! The inside is found by parity along rays in the x direction, 4 x 4 of them a row of cells,
//! with exact lengths along x. A ray that meets an edge shared by two triangles counts it for
//! exactly one of them, since both decide it by the same arithmetic.

use glam::{DVec3, Vec3};

use crate::error::{FluidError, check_vec};
use crate::grid::Grid;

/// Rays a cell along y and along z.
const RAYS: usize = 4;

/// Refuses a mesh without triangles, with places that are not finite or corners that do not exist.
pub(super) fn check_mesh(positions: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), FluidError> {
    if triangles.is_empty() {
        return Err(FluidError::Mesh { problem: "has no triangles" });
    }
    for position in positions {
        check_vec("mesh position", *position, 1.0e9, "components within ±1e9 m")?;
    }
    if triangles.iter().flatten().any(|corner| *corner as usize >= positions.len()) {
        return Err(FluidError::Mesh { problem: "has a triangle with a corner that does not exist" });
    }
    Ok(())
}

/// Refuses a mesh with an edge that an odd number of triangles have.
pub(super) fn check_closed(positions: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), FluidError> {
    // Adding zero makes one of the two zeros out of both.
    let key = |corner: u32| (positions[corner as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut edges = Vec::with_capacity(3 * triangles.len());
    for [a, b, c] in triangles.iter().map(|corners| corners.map(key)) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if from != to {
                edges.push(if from < to { (from, to) } else { (to, from) });
            }
        }
    }
    edges.sort_unstable();
    if edges.chunk_by(|a, b| a == b).any(|edge| edge.len() % 2 == 1) {
        return Err(FluidError::Mesh { problem: "is not closed" });
    }
    Ok(())
}

/// The corners of a triangle in cells from the low corner of the box.
fn corners(grid: &Grid, positions: &[Vec3], triangle: [u32; 3]) -> [DVec3; 3] {
    let (origin, edge) = (grid.origin.as_dvec3(), Vec3::from_array(grid.cell_m).as_dvec3());
    triangle.map(|corner| (positions[corner as usize].as_dvec3() - origin) / edge)
}

/// Lists the cells inside a closed mesh with the share that is inside.
pub(super) fn place_inside(grid: &Grid, positions: &[Vec3], triangles: &[[u32; 3]], cells: &mut Vec<(u32, f32)>) {
    let [nx, ny, nz] = grid.cells;
    // Where rays cross the mesh: by ray, then x.
    let mut crossings: Vec<(usize, f64)> = Vec::new();
    let place = |ray: usize| (ray as f64 + 0.5) / RAYS as f64;
    let range = |values: [f64; 3], count: usize| {
        let (low, high) = (values.into_iter().fold(f64::MAX, f64::min), values.into_iter().fold(f64::MIN, f64::max));
        let most = (RAYS * count) as f64;
        let first = (low * RAYS as f64 - 0.5).ceil().clamp(0.0, most);
        first as usize..((high * RAYS as f64 - 0.5).floor() + 1.0).clamp(first, most) as usize
    };
    for triangle in triangles {
        let points = corners(grid, positions, *triangle);
        for rz in range(points.map(|point| point.z), nz) {
            for ry in range(points.map(|point| point.y), ny) {
                if let Some(x) = crossing(points, place(ry), place(rz)) {
                    crossings.push((ry + RAYS * ny * rz, x));
                }
            }
        }
    }
    crossings.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut shares = vec![0.0_f64; nx * ny * nz];
    for ray in crossings.chunk_by(|a, b| a.0 == b.0) {
        let (ry, rz) = (ray[0].0 % (RAYS * ny), ray[0].0 / (RAYS * ny));
        let row = &mut shares[nx * (ry / RAYS + ny * (rz / RAYS))..][..nx];
        for pair in ray.as_chunks::<2>().0 {
            let (enter, leave) = (pair[0].1.max(0.0), pair[1].1.min(nx as f64));
            for (i, share) in row.iter_mut().enumerate().skip(enter as usize) {
                let inside = leave.min((i + 1) as f64) - enter.max(i as f64);
                if inside <= 0.0 {
                    break;
                }
                *share += inside / (RAYS * RAYS) as f64;
            }
        }
    }
    list(&shares, cells);
}

/// Where the line at (y, z) meets the triangle; seen along x, a point is inside if the edges
/// cross the line from it towards greater z an odd number of times.
fn crossing(points: [DVec3; 3], y: f64, z: f64) -> Option<f64> {
    let mut is_inside = false;
    for at in 0..3 {
        let (mut a, mut b) = (points[at], points[(at + 1) % 3]);
        // The same order from both sides, so that both triangles of an edge agree.
        if (a.y, a.z, a.x) > (b.y, b.z, b.x) {
            (a, b) = (b, a);
        }
        if (a.y > y) != (b.y > y) && z < a.z + (b.z - a.z) * ((y - a.y) / (b.y - a.y)) {
            is_inside = !is_inside;
        }
    }
    if !is_inside {
        return None;
    }
    let [a, b, c] = points;
    let normal = (b - a).cross(c - a);
    if normal.x == 0.0 {
        return Some(a.x);
    }
    let x = a.x - (normal.y * (y - a.y) + normal.z * (z - a.z)) / normal.x;
    let (low, high) = (a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
    Some(x.clamp(low, high))
}

/// Lists the cells near the triangles: fully within the layer, falling to nothing over a cell.
pub(super) fn place_layer(
    grid: &Grid,
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    layer_m: f32,
    cells: &mut Vec<(u32, f32)>,
) {
    let [nx, ny, _] = grid.cells;
    let edge = Vec3::from_array(grid.cell_m).as_dvec3();
    let soft = edge.max_element();
    let reach = 0.5 * (f64::from(layer_m) + soft);
    let mut shares = vec![0.0_f64; grid.count()];
    for triangle in triangles {
        let points = corners(grid, positions, *triangle);
        let [low, high] = [points[0].min(points[1]).min(points[2]), points[0].max(points[1]).max(points[2])];
        let (low, high) = ((low - reach / edge - 0.5).to_array(), (high + reach / edge - 0.5).to_array());
        let range = |axis: usize| {
            let most = grid.cells[axis] as f64;
            let first = low[axis].ceil().clamp(0.0, most);
            first as usize..(high[axis].floor() + 1.0).clamp(first, most) as usize
        };
        let points = points.map(|point| point * edge);
        for k in range(2) {
            for j in range(1) {
                for i in range(0) {
                    let centre = (DVec3::new(i as f64, j as f64, k as f64) + 0.5) * edge;
                    let away = nearest(points, centre).distance(centre);
                    let share = &mut shares[i + nx * (j + ny * k)];
                    *share = share.max(((reach - away) / soft).clamp(0.0, 1.0));
                }
            }
        }
    }
    list(&shares, cells);
}

fn list(shares: &[f64], cells: &mut Vec<(u32, f32)>) {
    for (cell, share) in shares.iter().enumerate() {
        let share = (*share as f32).min(1.0);
        if share > 0.0 {
            cells.push((cell as u32, share));
        }
    }
}

/// The point of a triangle nearest to another: the foot of the perpendicular if it is inside,
/// otherwise the nearest place on the three edges.
fn nearest([a, b, c]: [DVec3; 3], point: DVec3) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let size = normal.length_squared();
    if size > 0.0 {
        let foot = point - normal * ((point - a).dot(normal) / size);
        let is_left = |from: DVec3, to: DVec3| (to - from).cross(foot - from).dot(normal) >= 0.0;
        if is_left(a, b) && is_left(b, c) && is_left(c, a) {
            return foot;
        }
    }
    let on_edge = |from: DVec3, to: DVec3| {
        let along = to - from;
        let share = (point - from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        from + along * share.clamp(0.0, 1.0)
    };
    let mut best = on_edge(a, b);
    for other in [on_edge(b, c), on_edge(c, a)] {
        if other.distance_squared(point) < best.distance_squared(point) {
            best = other;
        }
    }
    best
}
