//! Connected regions of fluid cells without an open side, where the pressure is known up to a
//! constant only, and nothing can be taken in or given off.
//!
//! Runs of cells along x are joined by union-find (a flood fill in one pass), across periodic
//! sides too.

use crate::grid::Grid;
use crate::lanes::sum;
use crate::parallel::for_planes;
use crate::sides::Side;

/// Fluid cells side by side along x.
#[derive(Clone, Copy, Debug)]
struct Run {
    /// The first cell and the one after the last, counted within their z-plane.
    first: u32,
    end: u32,
    /// Which run it was joined to; then its region, plus one, or zero if that is not sealed.
    parent: u32,
}

/// A run in a sealed region.
#[derive(Clone, Copy, Debug)]
struct SealedRun {
    first: u32,
    end: u32,
    region: u32,
}

/// Where the sums of runs go, by plane, before they are added in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct RegionSums {
    planes: Vec<Vec<f64>>,
    means: Vec<f64>,
}

/// The sealed regions of a grid with obstacles.
#[derive(Clone, Debug, Default)]
pub(crate) struct Regions {
    /// Number zero stands for all that is outside.
    runs: Vec<Run>,
    /// The first run of each row of cells, and the number of runs.
    rows: Vec<usize>,
    /// By z-plane.
    sealed: Vec<Vec<SealedRun>>,
    cells: Vec<u32>,
}

impl Regions {
    /// Number of cells of each sealed region, in the order of their first cells.
    #[cfg(test)]
    pub(crate) fn cells(&self) -> &[u32] {
        &self.cells
    }

    /// Takes from each sealed region its mean over its cells; `values` holds one value a cell.
    pub(crate) fn remove_means(&self, grid: &Grid, values: &mut [f32], sums: &mut RegionSums) {
        if self.cells.is_empty() {
            return;
        }
        let RegionSums { planes, means } = sums;
        let cells_in_plane = grid.plane();
        planes.resize_with(self.sealed.len(), Vec::new);
        let shared: &[f32] = values;
        for_planes(
            grid.exec,
            planes,
            1,
            #[inline(always)]
            |k, sums| {
                let plane = &shared[k * cells_in_plane..(k + 1) * cells_in_plane];
                let of_run = |run: &SealedRun| sum(&plane[run.first as usize..run.end as usize]);
                for sums in sums {
                    sums.clear();
                    sums.extend(self.sealed[k].iter().map(of_run));
                }
            },
        );
        means.clear();
        means.resize(self.cells.len(), 0.0);
        for (runs, sums) in self.sealed.iter().zip(planes.iter()) {
            runs.iter().zip(sums).for_each(|(run, sum)| means[run.region as usize] += sum);
        }
        means.iter_mut().zip(&self.cells).for_each(|(mean, cells)| *mean /= f64::from(*cells));
        for_planes(
            grid.exec,
            values,
            cells_in_plane,
            #[inline(always)]
            |k, plane| {
                for run in &self.sealed[k] {
                    let mean = means[run.region as usize] as f32;
                    plane[run.first as usize..run.end as usize].iter_mut().for_each(|value| *value -= mean);
                }
            },
        );
    }

    /// For a solid flag by cell.
    pub(crate) fn find(&mut self, grid: &Grid, solid: &[bool]) {
        self.list_runs(grid, solid);
        self.join_runs(grid);
        self.number_regions(grid);
    }

    fn list_runs(&mut self, grid: &Grid, solid: &[bool]) {
        let [nx, ny, _] = grid.cells;
        self.runs.clear();
        self.runs.push(Run { first: 0, end: 0, parent: 0 });
        self.rows.clear();
        for (row, solid) in solid.chunks_exact(nx).enumerate() {
            self.rows.push(self.runs.len());
            let start = row % ny * nx;
            let mut i = 0;
            while let Some(skipped) = solid[i..].iter().position(|solid| !solid) {
                let first = i + skipped;
                i = solid[first..].iter().position(|solid| *solid).map_or(nx, |length| first + length);
                let parent = self.runs.len() as u32;
                self.runs.push(Run { first: (start + first) as u32, end: (start + i) as u32, parent });
            }
        }
        self.rows.push(self.runs.len());
    }

    /// Joins what touches: runs in rows side by side, and the outside behind open sides.
    fn join_runs(&mut self, grid: &Grid) {
        let [nx, ny, nz] = grid.cells;
        let is_open = grid.sides.map(|sides| sides.map(|side| side == Side::Open));
        let is_periodic = grid.sides.map(|sides| sides[0] == Side::Periodic);
        for k in 0..nz {
            for j in 0..ny {
                let row = j + ny * k;
                let (first, end) = (self.rows[row], self.rows[row + 1]);
                if first == end {
                    continue;
                }
                let touches_low = self.runs[first].first as usize == j * nx;
                let touches_high = self.runs[end - 1].end as usize == (j + 1) * nx;
                if is_periodic[0] && touches_low && touches_high {
                    self.join(first, end - 1);
                }
                if is_open[0][0] && touches_low {
                    self.join(first, 0);
                }
                if is_open[0][1] && touches_high {
                    self.join(end - 1, 0);
                }
                for (axis, index, count) in [(1, j, ny), (2, k, nz)] {
                    let is_outside = (index == 0 && is_open[axis][0]) || (index + 1 == count && is_open[axis][1]);
                    if is_outside {
                        (first..end).for_each(|run| self.join(run, 0));
                    }
                }
                if j > 0 {
                    self.join_rows(row, row - 1, nx);
                } else if is_periodic[1] {
                    self.join_rows(row, row + ny - 1, nx);
                }
                if k > 0 {
                    self.join_rows(row, row - ny, nx);
                } else if is_periodic[2] {
                    self.join_rows(row, row + ny * (nz - 1), nx);
                }
            }
        }
    }

    /// Joins the runs of two rows that share faces.
    fn join_rows(&mut self, row: usize, other_row: usize, nx: usize) {
        let (mut a, mut b) = (self.rows[row], self.rows[other_row]);
        while a < self.rows[row + 1] && b < self.rows[other_row + 1] {
            let ends = [a, b].map(|run| {
                let start = self.runs[run].first as usize / nx * nx;
                [self.runs[run].first as usize - start, self.runs[run].end as usize - start]
            });
            if ends[0][0] < ends[1][1] && ends[1][0] < ends[0][1] {
                self.join(a, b);
            }
            if ends[0][1] < ends[1][1] { a += 1 } else { b += 1 }
        }
    }

    /// The lower root becomes the root of both, so that parents come before their children.
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.runs[a.max(b)].parent = a.min(b) as u32;
    }

    fn root(&mut self, mut run: usize) -> usize {
        while self.runs[run].parent as usize != run {
            let above = self.runs[run].parent as usize;
            self.runs[run].parent = self.runs[above].parent;
            run = above;
        }
        run
    }

    fn number_regions(&mut self, grid: &Grid) {
        let [_, ny, nz] = grid.cells;
        self.cells.clear();
        self.sealed.resize_with(nz, Vec::new);
        for run in 1..self.runs.len() {
            let parent = self.runs[run].parent as usize;
            // What comes before has its number already.
            self.runs[run].parent = if parent == run {
                self.cells.push(0);
                self.cells.len() as u32
            } else {
                self.runs[parent].parent
            };
        }
        for (k, plane) in self.sealed.iter_mut().enumerate() {
            plane.clear();
            for run in &self.runs[self.rows[k * ny]..self.rows[(k + 1) * ny]] {
                if let Some(region) = run.parent.checked_sub(1) {
                    plane.push(SealedRun { first: run.first, end: run.end, region });
                    self.cells[region as usize] += run.end - run.first;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{RegionSums, Regions};
    use crate::grid::Grid;
    use crate::sides::Sides;
    use glam::Vec3;

    #[test]
    fn each_sealed_region_loses_its_own_mean_and_nothing_else_changes() {
        let grid = Grid::new([6, 5, 4], Vec3::ZERO, Vec3::ONE, Sides::CLOSED.by_axis());
        let solid: Vec<bool> = (0..120).map(|cell| cell % 6 == 3 || (cell / 30 == 2 && cell % 6 > 3)).collect();
        let mut regions = Regions::default();
        regions.find(&grid, &solid);
        assert_eq!(regions.cells(), [60, 20, 10]);
        let start: Vec<f32> = (0..120).map(|cell| (cell * 37 % 41) as f32).collect();
        let mut values = start.clone();
        regions.remove_means(&grid, &mut values, &mut RegionSums::default());
        let parts: [&dyn Fn(usize) -> bool; 4] = [
            &|cell| cell % 6 < 3,
            &|cell| cell % 6 > 3 && cell / 30 < 2,
            &|cell| cell % 6 > 3 && cell / 30 == 3,
            &|cell| solid[cell],
        ];
        for (part, is_in) in parts.into_iter().enumerate() {
            let cells: Vec<usize> = (0..120).filter(|cell| is_in(*cell)).collect();
            let mean =
                if part == 3 { 0.0 } else { cells.iter().map(|cell| start[*cell]).sum::<f32>() / cells.len() as f32 };
            for cell in cells {
                assert!((values[cell] - (start[cell] - mean)).abs() < 1e-5, "part {part}, cell {cell}");
            }
        }
    }
}
