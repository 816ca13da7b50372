//! Shapes as lists of cells.

use glam::Vec3;

use super::{Shape, mesh};
use crate::error::{FluidError, check, check_vec};
use crate::grid::Grid;

/// Points a cell and axis that decide how much of it a ball covers.
const SAMPLES: usize = 4;

/// The cells that a shape covers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Voxels {
    /// Cell, and the share of it that is covered, above 0, up to 1; cells ascend.
    pub(crate) cells: Vec<(u32, f32)>,
    /// Sum of the shares.
    pub(crate) total: f64,
}

impl Voxels {
    /// Finds the cells of a shape.
    pub(crate) fn place(&mut self, grid: &Grid, shape: &Shape) -> Result<(), FluidError> {
        self.cells.clear();
        match shape {
            Shape::Point(point) => self.place_point(grid, check_point("point", *point)?),
            Shape::Box { low, high } => {
                check_point("low", *low)?;
                check_point("high", *high)?;
                for (low, high) in low.to_array().into_iter().zip(high.to_array()) {
                    check("high", high, low, f32::MAX, "nowhere below low")?;
                }
                self.place_box(grid, *low, *high);
            }
            Shape::Sphere { centre, radius_m } => {
                check_point("centre", *centre)?;
                check("radius_m", *radius_m, f32::MIN_POSITIVE, 1.0e6, "above 0, up to 1e6 m")?;
                self.place_ball(grid, *centre, *radius_m);
                if self.cells.is_empty() {
                    self.place_point(grid, *centre);
                }
            }
            Shape::Mesh { positions, triangles, layer_m } => {
                mesh::check_mesh(positions, triangles)?;
                if let Some(layer_m) = layer_m {
                    check("layer_m", *layer_m, f32::MIN_POSITIVE, 1.0e6, "above 0, up to 1e6 m")?;
                    mesh::place_layer(grid, positions, triangles, *layer_m, &mut self.cells);
                } else {
                    mesh::check_closed(positions, triangles)?;
                    mesh::place_inside(grid, positions, triangles, &mut self.cells);
                }
            }
        }
        self.total = self.cells.iter().map(|(_, share)| f64::from(*share)).sum();
        if self.total > 0.0 { Ok(()) } else { Err(FluidError::SourceOutside) }
    }

    /// Nothing if the point is outside the box.
    fn place_point(&mut self, grid: &Grid, point: Vec3) {
        if grid.cell_of_point(point).is_none() {
            return;
        }
        let at = grid.cells_from_point(point);
        // Two cells an axis; beyond the sides there are none, and the nearest takes it all.
        let shares: [[(usize, f32); 2]; 3] = std::array::from_fn(|axis| {
            let last = (grid.cells[axis] - 1) as f32;
            let from_centre = (at[axis] - 0.5).clamp(0.0, last);
            let low = from_centre.floor();
            let part = from_centre - low;
            [(low as usize, 1.0 - part), ((low as usize + 1).min(grid.cells[axis] - 1), part)]
        });
        for (k, in_z) in shares[2] {
            for (j, in_y) in shares[1] {
                for (i, in_x) in shares[0] {
                    self.push(grid, [i, j, k], in_x * in_y * in_z);
                }
            }
        }
    }

    fn place_box(&mut self, grid: &Grid, low: Vec3, high: Vec3) {
        let (low, high) = (grid.cells_from_point(low), grid.cells_from_point(high));
        let covered = |axis: usize, index: usize| {
            let (low, high, at) = (low[axis], high[axis], index as f32);
            if low == high {
                // The cell that holds it; on the high side of the box, the last.
                let is_in = low >= at && (low < at + 1.0 || (low == at + 1.0 && index + 1 == grid.cells[axis]));
                return if is_in { 1.0 } else { 0.0 };
            }
            (high.min(at + 1.0) - low.max(at)).max(0.0)
        };
        let range = |axis: usize| range(low[axis], high[axis], grid.cells[axis]);
        for k in range(2) {
            for j in range(1) {
                for i in range(0) {
                    self.push(grid, [i, j, k], covered(0, i) * covered(1, j) * covered(2, k));
                }
            }
        }
    }

    fn place_ball(&mut self, grid: &Grid, centre: Vec3, radius_m: f32) {
        let (low, high) = (grid.cells_from_point(centre - radius_m), grid.cells_from_point(centre + radius_m));
        let edge = Vec3::from_array(grid.cell_m);
        let half_diagonal = 0.5 * edge.length();
        let range = |axis: usize| range(low[axis], high[axis], grid.cells[axis]);
        for k in range(2) {
            for j in range(1) {
                for i in range(0) {
                    let corner = grid.origin + Vec3::new(i as f32, j as f32, k as f32) * edge;
                    let distance = (corner + 0.5 * edge).distance(centre);
                    if distance >= radius_m + half_diagonal {
                        continue;
                    }
                    let share = if distance <= radius_m - half_diagonal {
                        1.0
                    } else {
                        covered_by_ball(corner, edge, centre, radius_m)
                    };
                    self.push(grid, [i, j, k], share);
                }
            }
        }
    }

    fn push(&mut self, grid: &Grid, [i, j, k]: [usize; 3], share: f32) {
        if share > 0.0 {
            self.cells.push(((i + grid.cells[0] * (j + grid.cells[1] * k)) as u32, share));
        }
    }
}

/// Cells between two places along an axis, ends included; none where all lies outside.
fn range(low: f32, high: f32, count: usize) -> std::ops::Range<usize> {
    let most = count as f32;
    let last = if low == high && high == most { most } else { (high.floor() + 1.0).clamp(0.0, most) };
    low.floor().clamp(0.0, most - f32::from(u8::from(low == most))) as usize..last as usize
}

fn covered_by_ball(corner: Vec3, edge: Vec3, centre: Vec3, radius_m: f32) -> f32 {
    let place = |index: usize| (index as f32 + 0.5) / SAMPLES as f32;
    let mut inside = 0;
    for k in 0..SAMPLES {
        for j in 0..SAMPLES {
            for i in 0..SAMPLES {
                let point = corner + edge * Vec3::new(place(i), place(j), place(k));
                inside += usize::from(point.distance_squared(centre) <= radius_m * radius_m);
            }
        }
    }
    inside as f32 / (SAMPLES * SAMPLES * SAMPLES) as f32
}

fn check_point(field: &'static str, point: Vec3) -> Result<Vec3, FluidError> {
    check_vec(field, point, f32::MAX, "finite")
}
