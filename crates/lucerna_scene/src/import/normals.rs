//! Normals for meshes that have none, and the finished mesh.

use super::RawMesh;
use glam::Vec3;
use lucerna_frame::{MeshVertex, OpaqueMesh};
use std::collections::HashMap;

/// Cosine of the angle between two faces above which the edge between them stays sharp: 50 degrees.
const CREASE_COS: f32 = 0.642_787_6;

/// A point with more faces than this is always smooth: looking at all pairs would take too long.
const MAX_FACES: usize = 64;

/// Drops triangles without an area, makes the normals that are missing, and normalises the others.
pub(super) fn complete(mut raw: RawMesh) -> OpaqueMesh {
    raw.triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
    for vertex in &mut raw.vertices {
        vertex.normal = Vec3::from(vertex.normal).normalize_or_zero().into();
    }
    if raw.vertices.iter().all(|vertex| vertex.normal != [0.0; 3]) {
        return OpaqueMesh { indices: raw.triangles.into_flattened(), vertices: raw.vertices };
    }
    let faces: Vec<Face> = raw.triangles.iter().map(|corners| Face::new(&raw.vertices, *corners)).collect();
    let around = Around::new(&raw);
    let mut split: Vec<Vec<u32>> = vec![Vec::new(); raw.vertices.len()];
    let mut vertices: Vec<MeshVertex> = Vec::with_capacity(raw.vertices.len());
    let mut indices = Vec::with_capacity(raw.triangles.len() * 3);
    for (face, corners) in raw.triangles.iter().enumerate() {
        for &corner in corners {
            let corner = corner as usize;
            let mut vertex = raw.vertices[corner];
            if vertex.normal == [0.0; 3] {
                vertex.normal = smooth(&faces, around.corners(corner), faces[face].area_normal).into();
            }
            let same = split[corner].iter().copied().find(|&made| vertices[made as usize] == vertex);
            let made = same.unwrap_or_else(|| {
                let made = vertices.len() as u32;
                vertices.push(vertex);
                split[corner].push(made);
                made
            });
            indices.push(made);
        }
    }
    OpaqueMesh { vertices, indices }
}

/// What a face adds to the normals at its corners.
struct Face {
    /// Its normal times twice its area.
    area_normal: Vec3,
    /// Its angles.
    angles: [f32; 3],
}

impl Face {
    fn new(vertices: &[MeshVertex], corners: [u32; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| Vec3::from(vertices[corner as usize].position));
        let normal = (b - a).cross(c - a);
        let angle = |at: Vec3, left: Vec3, right: Vec3| {
            let cosine = (left - at).normalize_or_zero().dot((right - at).normalize_or_zero());
            cosine.clamp(-1.0, 1.0).acos()
        };
        Self {
            area_normal: if normal.is_finite() { normal } else { Vec3::ZERO },
            angles: [angle(a, b, c), angle(b, c, a), angle(c, a, b)],
        }
    }
}

/// The mean over the faces that meet the given one without a crease, weighted by area and by angle, so that it does
/// not matter along which diagonal a quadrilateral was cut.
fn smooth(faces: &[Face], around: &[u32], face: Vec3) -> Vec3 {
    let own = face.normalize_or_zero();
    let mut sum = Vec3::ZERO;
    for &corner in around {
        let other = &faces[corner as usize / 3];
        let weighted = other.area_normal * other.angles[corner as usize % 3];
        if around.len() > MAX_FACES || own == Vec3::ZERO || weighted.normalize_or_zero().dot(own) >= CREASE_COS {
            sum += weighted;
        }
    }
    let mean = sum.normalize_or_zero();
    if mean != Vec3::ZERO {
        mean
    } else if own != Vec3::ZERO {
        own
    } else {
        Vec3::Y
    }
}

/// The corners of faces at each point, as three times the face plus 0 to 2; vertices at the same place are one point.
struct Around {
    point_of_vertex: Vec<u32>,
    first_of_point: Vec<u32>,
    corners: Vec<u32>,
}

impl Around {
    fn new(raw: &RawMesh) -> Self {
        let mut points: HashMap<[u32; 3], u32> = HashMap::with_capacity(raw.vertices.len());
        let point_of_vertex: Vec<u32> = raw
            .vertices
            .iter()
            .map(|vertex| {
                // Adding zero makes -0 the same as 0.
                let key = vertex.position.map(|x| (x + 0.0).to_bits());
                let next = points.len() as u32;
                *points.entry(key).or_insert(next)
            })
            .collect();
        let mut first_of_point = vec![0_u32; points.len() + 1];
        for corner in raw.triangles.as_flattened() {
            first_of_point[point_of_vertex[*corner as usize] as usize + 1] += 1;
        }
        for point in 1..first_of_point.len() {
            first_of_point[point] += first_of_point[point - 1];
        }
        let mut next = first_of_point.clone();
        let mut around = vec![0; raw.triangles.len() * 3];
        for (index, &corner) in raw.triangles.as_flattened().iter().enumerate() {
            let slot = &mut next[point_of_vertex[corner as usize] as usize];
            around[*slot as usize] = index as u32;
            *slot += 1;
        }
        Self { point_of_vertex, first_of_point, corners: around }
    }

    fn corners(&self, vertex: usize) -> &[u32] {
        let point = self.point_of_vertex[vertex] as usize;
        &self.corners[self.first_of_point[point] as usize..self.first_of_point[point + 1] as usize]
    }
}
