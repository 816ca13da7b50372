//! Shapes, by signed distance or by cells.

use std::fmt;
use std::sync::Arc;

use glam::{Quat, Vec3};

use super::{check_length, check_place};
use crate::error::{FluidError, check};
use crate::grid::Grid;

#[derive(Clone)]
pub(crate) enum Shape {
    /// A ball where both ends are the same.
    Capsule {
        from: Vec3,
        to: Vec3,
        radius_m: f32,
    },
    Cylinder {
        from: Vec3,
        to: Vec3,
        radius_m: f32,
    },
    Cuboid {
        centre: Vec3,
        size_m: Vec3,
        rotation: Quat,
    },
    Distance(Arc<dyn Fn(Vec3) -> f32 + Send + Sync>),
    Voxels(Arc<[bool]>),
    /// The cells that have this number: a body that was saved.
    Numbered(Arc<[u16]>, u16),
}

impl fmt::Debug for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Capsule { from, to, radius_m } => write!(f, "capsule {from} {to} {radius_m}"),
            Self::Cylinder { from, to, radius_m } => write!(f, "cylinder {from} {to} {radius_m}"),
            Self::Cuboid { centre, size_m, rotation } => write!(f, "cuboid {centre} {size_m} {rotation}"),
            Self::Distance(_) => f.write_str("distance"),
            Self::Voxels(solid) => write!(f, "voxels of {} cells", solid.len()),
            Self::Numbered(owners, number) => write!(f, "number {number} of {} cells", owners.len()),
        }
    }
}

impl Shape {
    pub(super) fn check(&self) -> Result<(), FluidError> {
        match self {
            Self::Capsule { from, to, radius_m } => {
                check_place(*from)?;
                check_place(*to)?;
                check_length(*radius_m)?;
            }
            Self::Cylinder { from, to, radius_m } => {
                check_place(*from)?;
                check_place(*to)?;
                check_length(*radius_m)?;
                check_length(from.distance(*to))?;
            }
            Self::Cuboid { centre, size_m, rotation } => {
                check_place(*centre)?;
                for edge in size_m.to_array() {
                    check_length(edge)?;
                }
                check("obstacle rotation", rotation.length(), 0.999, 1.001, "a quaternion of length 1")?;
            }
            Self::Distance(_) | Self::Voxels(_) | Self::Numbered(..) => {}
        }
        Ok(())
    }

    /// Corners of a box around it, in metres; none where only asking tells.
    pub(super) fn bounds(&self) -> Option<[Vec3; 2]> {
        match self {
            Self::Capsule { from, to, radius_m } | Self::Cylinder { from, to, radius_m } => {
                Some([from.min(*to) - *radius_m, from.max(*to) + *radius_m])
            }
            Self::Cuboid { centre, size_m, rotation } => {
                let half = 0.5 * *size_m;
                let reach = [Vec3::X, Vec3::Y, Vec3::Z]
                    .into_iter()
                    .map(|axis| (*rotation * (axis * half)).abs())
                    .fold(Vec3::ZERO, |sum, part| sum + part);
                Some([*centre - reach, *centre + reach])
            }
            Self::Distance(_) | Self::Voxels(_) | Self::Numbered(..) => None,
        }
    }

    /// Number of cells of the box that it was made for, if that matters.
    pub(super) fn cell_count(&self) -> Option<usize> {
        match self {
            Self::Voxels(solid) => Some(solid.len()),
            Self::Numbered(owners, _) => Some(owners.len()),
            _ => None,
        }
    }

    /// How far outside a point lies; negative inside. `cell` is the cell whose centre it is.
    pub(super) fn distance(&self, point: Vec3, cell: usize) -> f32 {
        match self {
            Self::Capsule { from, to, radius_m } => {
                let axis = *to - *from;
                let share = (point - *from).dot(axis) / axis.length_squared().max(f32::MIN_POSITIVE);
                point.distance(*from + axis * share.clamp(0.0, 1.0)) - radius_m
            }
            Self::Cylinder { from, to, radius_m } => {
                let length = from.distance(*to);
                let axis = (*to - *from) / length;
                let along = (point - *from).dot(axis);
                let away = (point - *from - axis * along).length() - radius_m;
                away.max(-along).max(along - length)
            }
            Self::Cuboid { centre, size_m, rotation } => {
                let local = rotation.inverse() * (point - *centre);
                (local.abs() - 0.5 * *size_m).max_element()
            }
            Self::Distance(distance) => distance(point),
            Self::Voxels(solid) => {
                if solid[cell] {
                    -1.0
                } else {
                    1.0
                }
            }
            Self::Numbered(owners, number) => {
                if owners[cell] == *number {
                    -1.0
                } else {
                    1.0
                }
            }
        }
    }

    /// The cells, by axis, whose centres may lie inside; all where only asking tells.
    pub(super) fn cells(&self, grid: &Grid) -> [std::ops::Range<usize>; 3] {
        let Some([low, high]) = self.bounds() else { return grid.cells.map(|count| 0..count) };
        let (low, high) = (grid.cells_from_point(low), grid.cells_from_point(high));
        std::array::from_fn(|axis| {
            let count = grid.cells[axis] as f32;
            let first = (low[axis] - 0.5).floor().max(0.0).min(count);
            let end = (high[axis] + 0.5).ceil().max(0.0).min(count);
            first as usize..(end as usize).max(first as usize)
        })
    }
}
