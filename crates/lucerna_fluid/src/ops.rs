//! The solver's operators, to be called alone on plain arrays.
//!
//! ```
//! use lucerna_fluid::{Sides, Vec3, ops};
//!
//! # fn main() -> Result<(), lucerna_fluid::FluidError> {
//! // A puff in a wind of one cell a step along x.
//! let shape = ops::Shape::new([8, 4, 4], Vec3::new(8.0, 4.0, 4.0), Sides::PERIODIC)?;
//! let velocity = shape.fill_faces(|_| Vec3::X);
//! let mut puff = shape.fill_cells(|point| if point.x < 1.0 { 5.0 } else { 0.0 });
//! ops::advect_cells(&shape, velocity.each_ref(), 1.0, &mut puff, ops::Carry::default())?;
//! assert_eq!(puff[..4], [0.0, 5.0, 0.0, 0.0]);
//! # Ok(())
//! # }
//! ```

use glam::Vec3;

use crate::advect::{Advection, Carrier, Flow, Job, Kind, Outside, ScalarAdvection, Scheme, Trace, transport};
use crate::error::{FluidError, check};
use crate::field::Field;
use crate::fluid::{Fluid, check_dt};
use crate::grid::Grid;
use crate::parallel::Partial;
use crate::scalars::MAX_SCALAR;
use crate::sides::Sides;

/// The shape of plain arrays: cells, their size, what the sides do.
///
/// Values at the cells' centres: `cells[0] * cells[1] * cells[2]`, x fastest, then y, then z.
/// Velocities across an axis: on the faces, one more along that axis.
#[derive(Clone, Debug)]
pub struct Shape {
    pub(crate) grid: Grid,
}

impl Shape {
    /// The low corner lies at zero. Counts, sizes and sides as for [`Fluid::builder`].
    ///
    /// # Errors
    /// What the builder would refuse.
    pub fn new(cells: [usize; 3], size_m: Vec3, sides: Sides) -> Result<Self, FluidError> {
        let (grid, _) = Fluid::builder(cells).size_m(size_m).sides(sides).checked()?;
        Ok(Self { grid })
    }

    /// Number of cells along x, y and z.
    #[must_use]
    pub fn cells(&self) -> [usize; 3] {
        self.grid.cells
    }

    /// Number of values on the faces across `axis` (0 to 2, others count as 2), along x, y and z.
    #[must_use]
    pub fn face_counts(&self, axis: usize) -> [usize; 3] {
        self.grid.face_counts(axis.min(2))
    }

    /// Values at the centres of the cells, from a function of the point.
    #[must_use]
    pub fn fill_cells(&self, value: impl Fn(Vec3) -> f32) -> Vec<f32> {
        self.fill(&Field::at_centres(&self.grid), value)
    }

    /// Velocities through the faces, from a function of the point: each face takes its component.
    #[must_use]
    pub fn fill_faces(&self, velocity_m_s: impl Fn(Vec3) -> Vec3) -> [Vec<f32>; 3] {
        [0, 1, 2].map(|axis| self.fill(&Field::on_faces(&self.grid, axis), |point| velocity_m_s(point)[axis]))
    }

    fn fill(&self, field: &Field, value: impl Fn(Vec3) -> f32) -> Vec<f32> {
        let [nx, ny, _] = field.counts;
        let offset = Vec3::from_array(field.offset);
        let place = |at: usize| Vec3::new((at % nx) as f32, (at / nx % ny) as f32, (at / (nx * ny)) as f32);
        let point = |at: usize| (place(at) + offset) * Vec3::from_array(self.grid.cell_m);
        (0..field.data.len()).map(|at| value(point(at))).collect()
    }

    /// Checks velocities, and copies them into fields.
    fn fields(&self, velocity: [&Vec<f32>; 3]) -> Result<[Field; 3], FluidError> {
        let mut fields = [0, 1, 2].map(|axis| Field::on_faces(&self.grid, axis));
        for (field, values) in fields.iter_mut().zip(velocity) {
            check_values("velocity", values, field.data.len())?;
            field.data.copy_from_slice(values);
        }
        Ok(fields)
    }
}

/// How [`advect_cells`] carries.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Carry {
    /// The scheme.
    pub advection: ScalarAdvection,
    /// How ways are traced; of no account for [`ScalarAdvection::Flux`].
    pub trace: Trace,
    /// What comes in through open and inflow sides, within ±1e6.
    pub outside: f32,
    /// Velocity of the grid itself, m/s, components within ±1e6.
    pub frame_velocity_m_s: Vec3,
}

/// Carries values at the centres of cells for `dt_s` seconds (above 0, up to 1e3) with a given
/// flow: velocities on the faces across x, y and z, m/s. Allocates what it works in.
///
/// # Errors
/// Arrays that do not fit the shape, and numbers that are not finite or beyond ±1e6; nothing has
/// changed then.
pub fn advect_cells(
    shape: &Shape,
    velocity: [&Vec<f32>; 3],
    dt_s: f32,
    values: &mut Vec<f32>,
    carry: Carry,
) -> Result<(), FluidError> {
    let grid = &shape.grid;
    check_dt(dt_s)?;
    let velocity = shape.fields(velocity)?;
    check_values("values", values, grid.count())?;
    let outside = Outside { value: check_value("outside", carry.outside)?, profile: None };
    let frame = carry.frame_velocity_m_s.to_array();
    for speed in frame {
        check_value("frame_velocity_m_s", speed)?;
    }
    let mut partials = vec![Partial::default(); grid.cells[2] + 1];
    let flow = Flow { velocity: &velocity, frame, open: None, thins: false };
    let mut spare = vec![0.0; values.len()];
    if let Some(scheme) = Scheme::of_scalars(carry.advection) {
        let mut carrier = Carrier::default();
        carrier.trace(grid, flow, dt_s, carry.trace, scheme == Scheme::MacCormack, &mut partials);
        carrier.carry(grid, values, Job { kind: Kind::CENTRES, scheme, outside }, &mut spare, &mut partials);
        std::mem::swap(values, &mut spare);
    } else {
        transport(grid, flow, dt_s, outside, [values, &mut spare], &mut partials);
    }
    Ok(())
}

/// Carries a velocity by itself for `dt_s` seconds (above 0, up to 1e3), without a projection:
/// [`Advection::Reflection`] does here what [`Advection::MacCormack`] does. The sides' own
/// velocities are not set again. Allocates what it works in.
///
/// # Errors
/// As [`advect_cells`].
pub fn advect_velocity(
    shape: &Shape,
    velocity: &mut [Vec<f32>; 3],
    dt_s: f32,
    advection: Advection,
    trace: Trace,
    wind_m_s: Vec3,
) -> Result<(), FluidError> {
    let grid = &shape.grid;
    check_dt(dt_s)?;
    let fields = shape.fields(velocity.each_ref())?;
    for speed in wind_m_s.to_array() {
        check_value("wind_m_s", speed)?;
    }
    let mut partials = vec![Partial::default(); grid.cells[2] + 1];
    let flow = Flow { velocity: &fields, frame: [0.0; 3], open: None, thins: false };
    let scheme = Scheme::from(advection);
    let mut carrier = Carrier::default();
    carrier.trace(grid, flow, dt_s, trace, scheme == Scheme::MacCormack, &mut partials);
    for (axis, out) in velocity.iter_mut().enumerate() {
        let job = Job { kind: Kind::faces(axis), scheme, outside: Outside { value: wind_m_s[axis], profile: None } };
        carrier.carry(grid, &fields[axis].data, job, out, &mut partials);
    }
    Ok(())
}

fn check_value(field: &'static str, value: f32) -> Result<f32, FluidError> {
    check(field, value, -MAX_SCALAR, MAX_SCALAR, "within ±1e6")
}

/// Checks the length of an array and all that is in it.
fn check_values(field: &'static str, values: &[f32], expected: usize) -> Result<(), FluidError> {
    if values.len() != expected {
        return Err(FluidError::Length { field, found: values.len(), expected });
    }
    values.iter().try_for_each(|value| check_value(field, *value).map(|_| ()))
}
