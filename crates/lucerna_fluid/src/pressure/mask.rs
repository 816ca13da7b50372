//! Cells that obstacles fill, and what that means to the pressure: which faces it acts on, and
//! which parts of the air are cut off from every open side.

use super::regions::Regions;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::sides::Side;

/// Solid cells of a grid. Obstacles that move change it by [`Mask::update`], which takes no new
/// memory once it has seen as many runs of cells.
#[derive(Clone, Debug)]
pub(crate) struct Mask {
    solid: Vec<bool>,
    weights: [Vec<f32>; 3],
    fluid_cells: usize,
    regions: Regions,
}

impl Mask {
    /// For a solid flag by cell, x fastest; cells beyond the end of `solid` are fluid.
    pub(crate) fn new(grid: &Grid, solid: &[bool]) -> Self {
        let mut mask = Self {
            solid: Vec::new(),
            weights: std::array::from_fn(|axis| vec![0.0; grid.face_counts(axis).iter().product()]),
            fluid_cells: 0,
            regions: Regions::default(),
        };
        mask.update(grid, solid);
        mask
    }

    /// Takes other solid cells, as [`Mask::new`]; the grid must be the same.
    pub(crate) fn update(&mut self, grid: &Grid, solid: &[bool]) {
        let count = grid.count();
        self.solid.clear();
        self.solid.extend_from_slice(&solid[..solid.len().min(count)]);
        self.solid.resize(count, false);
        self.fluid_cells = self.solid.iter().filter(|solid| !**solid).count();
        for (axis, weights) in self.weights.iter_mut().enumerate() {
            weigh(grid, axis, &self.solid, weights);
        }
        self.regions.find(grid, &self.solid);
    }

    /// Solid flags by cell, x fastest.
    pub(crate) fn solid(&self) -> &[bool] {
        &self.solid
    }

    /// Sets the values of solid cells to zero.
    pub(crate) fn clear_solid(&self, grid: &Grid, values: &mut [f32]) {
        let plane = grid.plane();
        for_planes(
            grid.exec,
            values,
            plane,
            #[inline(always)]
            |k, values| {
                for (value, solid) in values.iter_mut().zip(&self.solid[k * plane..(k + 1) * plane]) {
                    *value = if *solid { 0.0 } else { *value };
                }
            },
        );
    }

    /// Number of cells that are not solid.
    pub(crate) fn fluid_cells(&self) -> usize {
        self.fluid_cells
    }

    /// How strongly the pressure acts on each face across `axis`, in units of a difference over
    /// one cell: 1 between two fluid cells, 2 between a fluid cell and an open side (where the
    /// pressure is zero half a cell away), 0 on sides that fix the flow and next to solid cells:
    /// such faces keep the velocity that they have.
    pub(crate) fn weights(&self, axis: usize) -> &[f32] {
        &self.weights[axis]
    }

    /// The parts of the air without a way to an open side.
    pub(crate) fn regions(&self) -> &Regions {
        &self.regions
    }
}

/// Fills the weights of the faces across `axis`; see [`Mask::weights`].
fn weigh(grid: &Grid, axis: usize, solid: &[bool], weights: &mut [f32]) {
    let [nx, ny, _] = grid.cells;
    let counts = grid.face_counts(axis);
    let last = grid.cells[axis];
    let sides = grid.sides[axis];
    let is_periodic = sides[0] == Side::Periodic;
    let open = sides.map(|side| if side == Side::Open { 2.0 } else { 0.0 });
    let between = |a: bool, b: bool| f32::from(u8::from(!(a | b)));
    let beside = |a: bool, weight: f32| if a { 0.0 } else { weight };
    let row_at = |j: usize, k: usize| &solid[nx * (j + ny * k)..][..nx];
    for_planes(
        grid.exec,
        weights,
        counts[0] * counts[1],
        #[inline(always)]
        |k, out| {
            for (j, out) in out.chunks_exact_mut(counts[0]).enumerate() {
                if axis == 0 {
                    let row = row_at(j, k);
                    for (weight, pair) in out[1..nx].iter_mut().zip(row.windows(2)) {
                        *weight = between(pair[0], pair[1]);
                    }
                    if is_periodic {
                        out[0] = between(row[nx - 1], row[0]);
                        out[nx] = out[0];
                    } else {
                        out[0] = beside(row[0], open[0]);
                        out[nx] = beside(row[nx - 1], open[1]);
                    }
                    continue;
                }
                let index = if axis == 1 { j } else { k };
                let row_of = |index: usize| if axis == 1 { row_at(index, k) } else { row_at(j, index) };
                if is_periodic || (index > 0 && index < last) {
                    let (low, high) = (row_of((index + last - 1) % last), row_of(index % last));
                    out.iter_mut().zip(low).zip(high).for_each(|((weight, a), b)| *weight = between(*a, *b));
                } else {
                    let end = usize::from(index == last);
                    let row = row_of(index - end);
                    out.iter_mut().zip(row).for_each(|(weight, a)| *weight = beside(*a, open[end]));
                }
            }
        },
    );
}

#[cfg(test)]
mod tests {
    use super::Mask;
    use crate::grid::Grid;
    use crate::sides::{Side, Sides};
    use glam::Vec3;

    fn grid(cells: [usize; 3], sides: Sides) -> Grid {
        Grid::new(cells, Vec3::ZERO, Vec3::ONE, sides.by_axis())
    }

    #[test]
    fn faces_next_to_solid_cells_have_no_weight() {
        let sides = Sides { x: [Side::Open, Side::FreeSlip], y: [Side::Periodic; 2], z: [Side::NoSlip, Side::Open] };
        let grid = grid([4, 3, 5], sides);
        let at = |i: usize, j: usize, k: usize| i + 4 * (j + 3 * k);
        let mut solid = vec![false; 60];
        for cell in [at(1, 0, 2), at(0, 2, 4), at(3, 1, 0)] {
            solid[cell] = true;
        }
        let mask = Mask::new(&grid, &solid);
        assert_eq!(mask.fluid_cells(), 57);
        let is_solid = |i: usize, j: usize, k: usize| solid[at(i, j, k)];
        for k in 0..5 {
            for j in 0..3 {
                for i in 0..=4 {
                    let expected = match i {
                        0 if is_solid(0, j, k) => 0.0,
                        0 => 2.0,
                        4 => 0.0,
                        _ if is_solid(i, j, k) || is_solid(i - 1, j, k) => 0.0,
                        _ => 1.0,
                    };
                    assert_eq!(mask.weights(0)[i + 5 * (j + 3 * k)], expected, "x {i} {j} {k}");
                }
            }
            for j in 0..=3 {
                for i in 0..4 {
                    let is_shut = is_solid(i, j % 3, k) || is_solid(i, (j + 2) % 3, k);
                    let expected = if is_shut { 0.0 } else { 1.0 };
                    assert_eq!(mask.weights(1)[i + 4 * (j + 4 * k)], expected, "y {i} {j} {k}");
                }
            }
        }
        for k in 0..=5 {
            for j in 0..3 {
                for i in 0..4 {
                    let expected = match k {
                        0 => 0.0,
                        5 if is_solid(i, j, 4) => 0.0,
                        5 => 2.0,
                        _ if is_solid(i, j, k) || is_solid(i, j, k - 1) => 0.0,
                        _ => 1.0,
                    };
                    assert_eq!(mask.weights(2)[i + 4 * (j + 3 * k)], expected, "z {i} {j} {k}");
                }
            }
        }
    }

    /// Two chambers with a wall between, one of them open; periodic wrap joins what it should.
    #[test]
    fn regions_without_an_open_side_are_found() {
        let wall = |_: usize, j: usize, _: usize| j == 2;
        let solid = |wall: &dyn Fn(usize, usize, usize) -> bool| -> Vec<bool> {
            (0..5 * 6 * 4).map(|cell| wall(cell % 5, cell / 5 % 6, cell / 30)).collect()
        };
        let sealed = |sides: Sides, wall: &dyn Fn(usize, usize, usize) -> bool| -> Vec<u32> {
            let mask = Mask::new(&grid([5, 6, 4], sides), &solid(wall));
            mask.regions().cells().to_vec()
        };
        assert_eq!(sealed(Sides::CLOSED, &wall), [40, 60]);
        assert_eq!(sealed(Sides::OPEN, &wall), [0; 0]);
        let lid = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::CLOSED };
        assert_eq!(sealed(lid, &wall), [40]);
        assert_eq!(sealed(Sides { y: [Side::Periodic; 2], ..Sides::CLOSED }, &wall), [100]);
        let bars = |i: usize, _: usize, k: usize| i == 2 || k == 1;
        assert_eq!(sealed(Sides::CLOSED, &bars), [12, 12, 24, 24]);
        assert_eq!(sealed(Sides { x: [Side::Periodic; 2], ..Sides::CLOSED }, &bars), [24, 48]);
        assert_eq!(sealed(Sides { z: [Side::Periodic; 2], ..Sides::CLOSED }, &bars), [36, 36]);
        assert_eq!(sealed(Sides::PERIODIC, &bars), [72]);
        assert_eq!(sealed(Sides { z: [Side::Open, Side::NoSlip], ..Sides::CLOSED }, &bars), [24, 24]);
        assert_eq!(sealed(Sides::CLOSED, &|_, _, _| true), [0; 0]);
        assert_eq!(sealed(Sides::CLOSED, &|i, j, k| (i + j + k) % 2 == 1), [1; 60]);
    }
}
