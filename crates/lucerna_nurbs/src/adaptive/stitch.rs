//! Triangles in cells whose neighbours may be finer.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use super::Mesh;
use super::cells::{Cell, Cells, Place};
use crate::vector::{add_scaled, cross, scale, sub, unit};
use crate::{GridVertex, NurbsError, Real, Surface};

/// A point of the domain.
type Corner = (Place, Place);

pub(super) fn stitch<T: Real>(surface: &Surface<f64>, cells: &Cells, flip: bool) -> Mesh<T> {
    let mut known = BTreeSet::new();
    for cell in &cells.leaves {
        for u in cell.u {
            known.extend(cell.v.map(|v| joined(cells, (u, v))));
        }
    }
    let mut mesh =
        Builder { surface, cells, known, corners: BTreeMap::new(), vertices: Vec::new(), indices: Vec::new() };
    cells.leaves.iter().for_each(|cell| mesh.fill(cell));
    mesh.finish(flip)
}

/// The same corner on the lower side of a seam.
fn joined(cells: &Cells, (u, v): Corner) -> Corner {
    let wrap = |direction: usize, place: Place| {
        if cells.closed[direction] && place == cells.end(direction) { 0 } else { place }
    };
    (wrap(0, u), wrap(1, v))
}

/// A vertex in the making.
struct Vertex {
    position: [f64; 3],
    /// `None` where the surface has no tangent plane.
    normal: Option<[f64; 3]>,
    place: [f64; 2],
}

struct Builder<'a> {
    surface: &'a Surface<f64>,
    cells: &'a Cells,
    /// The corners of all cells, on the lower side of seams.
    known: BTreeSet<Corner>,
    corners: BTreeMap<Corner, u32>,
    vertices: Vec<Vertex>,
    indices: Vec<[u32; 3]>,
}

impl Builder<'_> {
    /// The triangles of a cell.
    fn fill(&mut self, cell: &Cell) {
        let ([u0, u1], [v0, v1]) = (cell.u, cell.v);
        // Counter-clockwise, the four edges with all corners on them but their last.
        let corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)];
        let mut sides: [Vec<Corner>; 4] = Default::default();
        for (k, side) in sides.iter_mut().enumerate() {
            self.split(corners[k], corners[(k + 1) % 4], side);
        }
        // Corners of finer neighbours, if any, on two sides at most that do not meet in this corner:
        // a fan from there has no triangle along a straight line.
        let plain = |k: usize| sides[k % 4].len() == 1;
        let fan = (0..4).filter(|&k| plain(k) && plain(k + 3));
        let ring: Vec<u32> = sides.iter().flatten().map(|&corner| self.vertex(corner)).collect();
        let start = |k: usize| sides[..k].iter().map(Vec::len).sum::<usize>();
        let best = fan.min_by(|&a, &b| {
            let diagonal = |k: usize| self.distance(ring[start(k)], ring[start((k + 2) % 4)]);
            diagonal(a).total_cmp(&diagonal(b))
        });
        if let Some(k) = best {
            let at = |i: usize| ring[(start(k) + i) % ring.len()];
            (1..ring.len() - 1).for_each(|i| self.push([at(0), at(i), at(i + 1)]));
            return;
        }
        let middle = |a: Place, b: Place| a + (b - a) / 2;
        let center = self.add((middle(u0, u1), middle(v0, v1)));
        for (i, &a) in ring.iter().enumerate() {
            self.push([center, a, ring[(i + 1) % ring.len()]]);
        }
    }

    /// The corners from `a` up to but not including `b`: those of neighbours come from halving.
    fn split(&self, a: Corner, b: Corner, side: &mut Vec<Corner>) {
        let between = |a: Place, b: Place| a.min(b) + a.abs_diff(b) / 2;
        let middle = (between(a.0, b.0), between(a.1, b.1));
        if middle != a && middle != b && self.known.contains(&joined(self.cells, middle)) {
            self.split(a, middle, side);
            self.split(middle, b, side);
        } else {
            side.push(a);
        }
    }

    fn vertex(&mut self, corner: Corner) -> u32 {
        if let Some(&index) = self.corners.get(&corner) {
            return index;
        }
        let index = self.add(corner);
        self.corners.insert(corner, index);
        index
    }

    /// A new vertex. On a seam it lies where it does on the lower side; at a pole, at the pole.
    fn add(&mut self, (u, v): Corner) -> u32 {
        let lower = joined(self.cells, (u, v));
        let at = [self.cells.parameter(0, lower.0), self.cells.parameter(1, lower.1)];
        let pole = |direction: usize, place: Place| {
            let [low, high] = self.cells.poles[direction];
            if place == 0 { low } else { high.filter(|_| place == self.cells.end(direction)) }
        };
        // Parameters come from knots of the domain: they lie in it.
        let point = pole(0, lower.0).or_else(|| pole(1, lower.1));
        let point = point.map_or_else(|| self.surface.point(at[0], at[1]), Ok::<_, NurbsError>);
        let place = |direction: usize, place: Place| {
            let (first, last) =
                (self.cells.knots[direction][0], self.cells.parameter(direction, self.cells.end(direction)));
            (self.cells.parameter(direction, place) - first) / (last - first)
        };
        let vertex = Vertex {
            position: point.unwrap_or_default(),
            normal: self.surface.normal(at[0], at[1]).ok(),
            place: [place(0, u), place(1, v)],
        };
        self.vertices.push(vertex);
        self.vertices.len() as u32 - 1
    }

    fn distance(&self, a: u32, b: u32) -> f64 {
        let d = sub(self.vertices[a as usize].position, self.vertices[b as usize].position);
        d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
    }

    /// Adds a triangle, unless two of its corners are at the same pole.
    fn push(&mut self, triangle: [u32; 3]) {
        let [a, b, c] = triangle.map(|index| self.vertices[index as usize].position);
        if a != b && b != c && c != a {
            self.indices.push(triangle);
        }
    }

    fn finish<T: Real>(self, flip: bool) -> Mesh<T> {
        let mut faces = alloc::vec![[0.0; 3]; self.vertices.len()];
        for triangle in &self.indices {
            let [a, b, c] = triangle.map(|index| self.vertices[index as usize].position);
            let area = cross(sub(b, a), sub(c, a));
            triangle.iter().for_each(|&index| add_scaled(&mut faces[index as usize], &area, 1.0));
        }
        let vertices = self.vertices.iter().zip(faces).map(|(vertex, face)| {
            let normal = vertex.normal.or_else(|| unit(face)).unwrap_or([0.0, 1.0, 0.0]);
            let normal = if flip { scale(normal, -1.0) } else { normal };
            let [u, v] = vertex.place.map(T::from_f64);
            GridVertex { position: vertex.position.map(T::from_f64), normal: normal.map(T::from_f64), u, v }
        });
        let turn = |&[a, b, c]: &[u32; 3]| if flip { [a, c, b] } else { [a, b, c] };
        Mesh { vertices: vertices.collect(), indices: self.indices.iter().flat_map(turn).collect() }
    }
}
