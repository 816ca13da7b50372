//! Arrays that a step works in and nobody reads between steps.

use crate::advect::Carrier;
use crate::combustion::Reactor;
use crate::confinement::Confinement;
use crate::conserve::Conserver;
use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::Partial;
use crate::pressure;
use crate::turbulence::Strain;
use crate::viscosity::Coefficients;

/// Taken once; a step allocates nothing.
pub(crate) struct Scratch {
    pub(crate) next_velocity: [Field; 3],
    pub(crate) next_temperature: Field,
    /// One of the packed scalars.
    pub(crate) scalar: Field,
    pub(crate) carrier: Carrier,
    pub(crate) conserver: Conserver,
    pub(crate) confinement: Confinement,
    /// Of viscosity and conduction that vary.
    pub(crate) coefficients: Coefficients,
    pub(crate) pressure: pressure::Spare,
    /// What the flow is to expand by, 1/s by cell; empty until anything does.
    pub(crate) expansion: Vec<f32>,
    pub(crate) strain: Strain,
    pub(crate) reactor: Reactor,
    /// One a plane of faces.
    pub(crate) partials: Vec<Partial>,
}

impl Scratch {
    pub(crate) fn new(grid: &Grid) -> Self {
        Self {
            next_velocity: std::array::from_fn(|axis| Field::on_faces(grid, axis)),
            next_temperature: Field::at_centres(grid),
            scalar: Field::at_centres(grid),
            carrier: Carrier::default(),
            conserver: Conserver::default(),
            confinement: Confinement::default(),
            coefficients: Coefficients::default(),
            pressure: pressure::Spare::new(grid),
            expansion: Vec::new(),
            strain: Strain::default(),
            reactor: Reactor::default(),
            partials: vec![Partial::default(); grid.cells[2] + 1],
        }
    }
}
