//! Arrays that a step works in and nobody reads between steps.

use crate::confinement::Confinement;
use crate::field::Field;
use crate::grid::Grid;
use crate::parallel::Partial;
use crate::pressure;
use crate::scalars::Pack;

/// Taken once; a step allocates nothing.
pub(crate) struct Scratch {
    pub(crate) next_velocity: [Field; 3],
    pub(crate) next_temperature: Field,
    /// Empty until scalars are first carried.
    pub(crate) next_pack: Pack,
    /// The way that the air of each cell went; see `advect::semi_lagrangian`.
    pub(crate) trace: Vec<f32>,
    pub(crate) confinement: Confinement,
    pub(crate) pressure: pressure::Spare,
    /// One a plane of faces.
    pub(crate) partials: Vec<Partial>,
}

impl Scratch {
    pub(crate) fn new(grid: &Grid) -> Self {
        let count = grid.count();
        Self {
            next_velocity: std::array::from_fn(|axis| Field::on_faces(grid, axis)),
            next_temperature: Field::at_centres(grid),
            next_pack: Vec::new(),
            trace: vec![0.0; 3 * count],
            confinement: Confinement::default(),
            pressure: pressure::Spare::new(grid),
            partials: vec![Partial::default(); grid.cells[2] + 1],
        }
    }
}
