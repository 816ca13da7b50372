//! Copies: where a fire or a mesh stands, and the air that goes with a fire.

use crate::{Air, AirSides, Fire};
use lucerna_flame::WickShape;
use lucerna_frame::{MeshVertex, OpaqueMesh};
use serde::{Deserialize, Serialize};

impl Fire {
    /// Where the copies of the fire stand.
    pub fn places(&self) -> impl ExactSizeIterator<Item = Place> + '_ {
        places(&self.at, &self.turns_deg)
    }
}

/// A box of air that goes with a fire. What it does not say is as in the air of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FireAir {
    /// Lowest corner of the box from where the fire stands, m. The box does not turn with the fire.
    pub origin_m: [f32; 3],
    /// Size of the box, m.
    pub size_m: [f32; 3],
    /// Cells along x, y and z, 2 to 256 each.
    pub cells: [u32; 3],
    /// Which sides are closed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sides: Option<AirSides>,
    /// Vorticity confinement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vorticity_confinement: Option<f32>,
    /// Rate at which hot air cools, 1/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cooling_per_s: Option<f32>,
}

impl FireAir {
    /// The air of a copy of the fire that stands `at` a place, in a scene with the air `common`.
    #[must_use]
    pub fn air(&self, common: &Air, at: [f32; 3]) -> Air {
        Air {
            origin_m: std::array::from_fn(|axis| at[axis] + self.origin_m[axis]),
            size_m: self.size_m,
            cells: self.cells,
            sides: self.sides.unwrap_or(common.sides),
            vorticity_confinement: self.vorticity_confinement.unwrap_or(common.vorticity_confinement),
            cooling_per_s: self.cooling_per_s.unwrap_or(common.cooling_per_s),
            ..common.clone()
        }
    }
}

/// Where a copy of something stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where its origin goes, m.
    pub at: [f32; 3],
    /// How far it is turned about y, degrees, counter-clockwise seen from above.
    pub turn_deg: f32,
}

impl Place {
    /// A point of the thing, in the world.
    #[must_use]
    pub fn point(&self, point: [f32; 3]) -> [f32; 3] {
        let [x, y, z] = self.vector(point);
        [x + self.at[0], y + self.at[1], z + self.at[2]]
    }

    /// A direction of the thing, in the world.
    #[must_use]
    pub fn vector(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        if self.turn_deg == 0.0 {
            return [x, y, z];
        }
        let (sin, cos) = self.turn_deg.to_radians().sin_cos();
        [cos * x + sin * z, y, cos * z - sin * x]
    }

    /// A wick of the thing, in the world.
    #[must_use]
    pub fn wick(&self, wick: &WickShape) -> WickShape {
        match wick {
            WickShape::Polyline { points, radius_m } => {
                WickShape::Polyline { points: points.iter().map(|p| self.point(*p)).collect(), radius_m: *radius_m }
            }
            WickShape::Vertices(vertices) => WickShape::Vertices(vertices.iter().map(|p| self.point(*p)).collect()),
        }
    }
}

/// Places with their turns; one at the origin where there are none.
pub(crate) fn places<'a>(at: &'a [[f32; 3]], turns_deg: &'a [f32]) -> impl ExactSizeIterator<Item = Place> + 'a {
    (0..at.len().max(1)).map(|i| Place {
        at: at.get(i).copied().unwrap_or_default(),
        turn_deg: turns_deg.get(i).copied().unwrap_or_default(),
    })
}

/// A mesh that shows another at many places.
pub(crate) fn copies(mesh: &OpaqueMesh, at: &[[f32; 3]], turns_deg: &[f32]) -> OpaqueMesh {
    let mut all = OpaqueMesh::default();
    for place in places(at, turns_deg) {
        let first = all.vertices.len() as u32;
        all.vertices.extend(mesh.vertices.iter().map(|vertex| MeshVertex {
            position: place.point(vertex.position),
            normal: place.vector(vertex.normal),
            ..*vertex
        }));
        all.indices.extend(mesh.indices.iter().map(|index| first + index));
    }
    all
}
