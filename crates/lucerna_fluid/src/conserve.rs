//! Transport that conserves mass, momentum and, but for the time step, kinetic energy.
//!
//! Mass passes the faces of the cells by limited fluxes; the same fluxes, averaged, carry momentum
//! through the volumes about the faces, which hold the mean density of the two cells beside them:
//! then momentum is conserved where density jumps, and central differences conserve kinetic energy
//! (Y. Morinishi et al., J. Comput. Phys. 143, 1998; F. Ham, Y.-N. Young, CTR Annual Research Briefs
//! 2003). In time it is the method of Heun as two steps of Euler's and the mean of start and end,
//! which keeps what is bounded bounded (C.-W. Shu, S. Osher, J. Comput. Phys. 77, 1988), with a
//! projection after each.
//!
//! Weight and pressure act in each step of Euler's; all else that accelerates, viscosity too, is
//! found once, at the start, and added to both.

mod advance;
mod euler;
mod flux;
mod mean;
mod momentum;
mod padded;

use crate::field::Field;
use crate::grid::Grid;
use crate::scalars::Pack;
use padded::Shape;

/// Courant number, summed over the axes, up to which a step is one part.
pub(crate) const COURANT: f32 = 0.5;

/// Courant number beyond which a part is carried by another scheme, which is stable at any.
const MOST_COURANT: f32 = 1.0;

/// Arrays to work in; empty until first used.
#[derive(Clone, Debug, Default)]
pub(crate) struct Conserver {
    shape: Shape,
    /// Padded, by axis: velocity; the same against the grid; fluxes of mass; of something else.
    velocity: [Vec<f32>; 3],
    flow: [Vec<f32>; 3],
    mass: [Vec<f32>; 3],
    fluxes: [Vec<f32>; 3],
    /// Padded: a scalar; the pressure.
    values: Vec<f32>,
    pressure: Vec<f32>,
    /// Padded: `1 - rho / rho_a` at the start, after one step of Euler's, and after two.
    shares: [Vec<f32>; 3],
    /// The state at the start.
    start: Option<[Field; 3]>,
    start_temperature: Vec<f32>,
    start_packs: Vec<Pack>,
    /// What accelerates besides weight and pressure, m/s in the step.
    push: Option<[Field; 3]>,
    /// By face, 0 in and beside solid cells; empty without any.
    open: [Vec<f32>; 3],
    /// Weight of the pressure in the last step of Euler's: greatest `rho_a / rho`.
    weight: f32,
    /// What part of the step the coming projection makes up for.
    part: f32,
}

impl Conserver {
    /// Takes the memory for a grid.
    fn fit(&mut self, grid: &Grid) {
        let shape = Shape::new(grid);
        if self.shape == shape {
            return;
        }
        self.shape = shape;
        let all = self.velocity.iter_mut().chain(&mut self.flow).chain(&mut self.mass).chain(&mut self.fluxes);
        let all = all.chain([&mut self.values, &mut self.pressure]).chain(&mut self.shares);
        all.for_each(|array| *array = vec![0.0; shape.total]);
    }
}
