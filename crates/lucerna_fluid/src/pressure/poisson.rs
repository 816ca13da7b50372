//! The Poisson equation on plain arrays.

use glam::Vec3;

use super::conjugate::{self, Problem};
use super::direct::{DirectSolver, mode_space};
use super::lines::Lanes;
use super::mask::Mask;
use super::operators::{divergence_plane, subtract_gradient};
use super::regions::RegionSums;
use crate::error::{FluidError, check};
use crate::fluid::Fluid;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::sides::Sides;

/// Greatest value on a right-hand side, and of a velocity or potential: beyond, squares would
/// not fit an `f32`.
const GREATEST: f32 = 1.0e15;

/// Solves `Laplacian(p) = f` on a grid of cells, on plain arrays: the pressure solver of
/// [`Fluid`], to be used alone. Directly, to rounding, in a box; with
/// [`PoissonSolver::set_solid`] by conjugate gradients that start from that.
///
/// Arrays hold one value a cell, x fastest, then y, then z. Velocities sit on the faces between
/// cells: the x component has `nx + 1` values a row, the y component `ny + 1` rows a plane, the
/// z component `nz + 1` planes. On a periodic axis the last face is the first one again.
///
/// At [`Side::Open`](crate::Side::Open) `p` is zero on the face; `Periodic` goes round; at all
/// other sides the slope of `p` across the face is zero.
///
/// ```
/// use lucerna_fluid::{PoissonSolver, Sides, Vec3};
///
/// # fn main() -> Result<(), lucerna_fluid::FluidError> {
/// // A jet through one face of a box of 20 cm, closed all around.
/// let cells = [20, 16, 12];
/// let mut solver = PoissonSolver::new(cells, Vec3::new(0.2, 0.16, 0.12), Sides::CLOSED)?;
/// let mut velocity = [vec![0.0; 21 * 16 * 12], vec![0.0; 20 * 17 * 12], vec![0.0; 20 * 16 * 13]];
/// velocity[0][7 + 21 * (8 + 16 * 6)] = 1.0;
/// let [u, v, w] = &mut velocity;
/// let mut potential = vec![0.0; 20 * 16 * 12];
/// solver.divergence([u, v, w], &mut potential)?;
/// assert!(potential.iter().any(|rate| *rate > 90.0));
/// solver.solve(&mut potential)?;
/// solver.subtract_gradient(&potential, [u, v, w])?;
/// solver.divergence([u, v, w], &mut potential)?;
/// assert!(potential.iter().all(|rate| rate.abs() < 1e-3));
/// # Ok(())
/// # }
/// ```
pub struct PoissonSolver {
    grid: Grid,
    direct: DirectSolver,
    modes: Vec<Lanes>,
    obstacles: Option<Obstacles>,
}

/// What solving around solid cells takes.
struct Obstacles {
    mask: Mask,
    spare: conjugate::Spare,
    residual: Vec<f32>,
}

impl PoissonSolver {
    /// For `cells` along x, y and z (2 to 512, or exactly 1 along one axis) in a box with edges
    /// of `size_m`, m. Computes the tables: about 4 bytes a cell, and as much to work in.
    ///
    /// # Errors
    /// What [`FluidBuilder::build`](crate::FluidBuilder::build) refuses of cells, size and sides.
    pub fn new(cells: [usize; 3], size_m: Vec3, sides: Sides) -> Result<Self, FluidError> {
        let (grid, _) = Fluid::builder(cells).size_m(size_m).sides(sides).checked()?;
        Ok(Self { direct: DirectSolver::new(&grid), modes: mode_space(&grid), obstacles: None, grid })
    }

    /// Number of cells along x, y and z.
    #[must_use]
    pub fn cells(&self) -> [usize; 3] {
        self.grid.cells
    }

    /// Fills cells with something solid: a flag for each. The slope of `p` across the faces of
    /// solid cells is zero. No flag set: a plain box again.
    ///
    /// # Errors
    /// Another number of flags than cells.
    pub fn set_solid(&mut self, solid: &[bool]) -> Result<(), FluidError> {
        check_length("solid", solid.len(), self.grid.count())?;
        if !solid.contains(&true) {
            self.obstacles = None;
        } else if let Some(obstacles) = &mut self.obstacles {
            obstacles.mask.update(&self.grid, solid);
        } else {
            let mask = Mask::new(&self.grid, solid);
            self.obstacles = Some(Obstacles { mask, spare: conjugate::Spare::default(), residual: Vec::new() });
        }
        Ok(())
    }

    /// Replaces the right-hand side by the solution. In a part of the box without an open side
    /// the mean of the right-hand side over that part is left out (there is no answer to it), and
    /// the mean of the solution is zero. In solid cells the solution is zero.
    ///
    /// Returns the number of iterations: 0 in a box; with solid cells as many as leave a
    /// millionth of the right-hand side, some 5 to 20, more in a maze, 200 at most.
    ///
    /// # Errors
    /// Another number of values than cells; values that are not finite or beyond ±1e15.
    pub fn solve(&mut self, values: &mut [f32]) -> Result<u32, FluidError> {
        self.check_cells("values", values)?;
        let Self { grid, direct, modes, obstacles } = self;
        let Some(Obstacles { mask, spare, residual }) = obstacles else {
            direct.analyze(grid, values, modes);
            direct.synthesize(grid, modes, values);
            return Ok(0);
        };
        mask.clear_solid(grid, values);
        mask.regions().remove_means(grid, values, &mut RegionSums::default());
        residual.clear();
        residual.extend_from_slice(values);
        let problem = Problem { grid, mask, direct, tolerance: 0.0 };
        Ok(conjugate::solve(&problem, residual, values, modes, spare))
    }

    /// Fills `out` with the divergence of a velocity, 1/s, in solid cells too.
    ///
    /// # Errors
    /// Arrays of other lengths than the grid has faces and cells.
    pub fn divergence(&self, velocity: [&[f32]; 3], out: &mut [f32]) -> Result<(), FluidError> {
        check_length("out", out.len(), self.grid.count())?;
        for (axis, values) in velocity.into_iter().enumerate() {
            self.check_faces(axis, values.len())?;
        }
        let grid = &self.grid;
        for_planes(
            grid.exec,
            out,
            grid.plane(),
            #[inline(always)]
            |k, out| divergence_plane(grid, velocity, k, out),
        );
        Ok(())
    }

    /// Subtracts the gradient of a potential on all faces where `p` may have a slope.
    ///
    /// # Errors
    /// Arrays of other lengths than the grid has faces and cells, and values of the potential
    /// that are not finite or beyond ±1e15; nothing has changed then.
    pub fn subtract_gradient(&self, potential: &[f32], velocity: [&mut [f32]; 3]) -> Result<(), FluidError> {
        self.check_cells("potential", potential)?;
        for (axis, values) in velocity.iter().enumerate() {
            self.check_faces(axis, values.len())?;
        }
        let mask = self.obstacles.as_ref().map(|obstacles| &obstacles.mask);
        subtract_gradient(&self.grid, potential, mask, velocity);
        Ok(())
    }

    fn check_faces(&self, axis: usize, found: usize) -> Result<(), FluidError> {
        let field = ["velocity across x", "velocity across y", "velocity across z"][axis];
        check_length(field, found, self.grid.face_counts(axis).iter().product())
    }

    fn check_cells(&self, field: &'static str, values: &[f32]) -> Result<(), FluidError> {
        check_length(field, values.len(), self.grid.count())?;
        for value in values {
            check(field, *value, -GREATEST, GREATEST, "finite, within ±1e15")?;
        }
        Ok(())
    }
}

fn check_length(field: &'static str, found: usize, expected: usize) -> Result<(), FluidError> {
    if found == expected { Ok(()) } else { Err(FluidError::Length { field, found, expected }) }
}
