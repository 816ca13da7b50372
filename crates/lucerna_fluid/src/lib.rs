//! Gas in a box: a stable-fluids solver on a staggered grid, in SI units and `f32`.
//!
//! ```
//! use lucerna_fluid::{Fluid, Side, Sides, Vec3};
//!
//! # fn main() -> Result<(), lucerna_fluid::FluidError> {
//! let mut fluid = Fluid::builder([15, 15, 15])
//!     .size_m(Vec3::splat(0.3))
//!     .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
//!     .build()?;
//! for _ in 0..30 {
//!     fluid.add_heat(Vec3::new(0.15, 0.03, 0.15), 0.04, 3000.0)?;
//!     let report = fluid.step(1.0 / 60.0)?;
//!     assert!(report.divergence_after < 1e-3);
//! }
//! assert!(fluid.velocity(Vec3::new(0.15, 0.15, 0.15)).y > 0.1);
//! # Ok(())
//! # }
//! ```
//!
//! One step (J. Stam, *Stable Fluids*, SIGGRAPH 1999, on the grid of Harlow and Welch 1965):
//! advection ([`Advection`], [`ScalarAdvection`]), heat and burning, forces, viscosity, and a
//! projection that leaves the flow free of divergence to rounding. [`ops`] has the operators
//! alone, on plain arrays.
//!
//! Order of cells: x fastest, then y, then z; y is up. The centre of cell (0,0,0) lies at
//! `origin + cell_size / 2`. Velocities sit on the cells' faces: the x component has
//! `nx + 1` values a row, the y component `ny + 1` rows a plane, the z component `nz + 1` planes.
//!
//! Same input, same bits, on any number of threads. No `unsafe`, no fused multiply-add; nothing
//! that a caller passes in makes it panic, and no value that is not a number gets into a field.

mod advect;
mod air;
mod batch;
mod builder;
mod burn;
mod combustion;
mod confinement;
mod conserve;
mod density;
mod error;
mod field;
mod figures;
mod fluid;
mod forces;
mod frame;
mod gas;
mod grid;
mod lanes;
mod limits;
mod obstacle;
pub mod ops;
mod parallel;
mod physics;
mod points;
mod pressure;
mod read;
mod report;
mod save;
mod scalars;
mod scratch;
mod sides;
mod simd;
mod slopes;
mod source;
mod step;
mod substeps;
mod turbulence;
mod viscosity;

pub use advect::{Advection, ScalarAdvection, Trace};
pub use air::{AIR_GAS_CONSTANT_J_KG_K, AIR_HEAT_CAPACITY_J_KG_K, AIR_PRESSURE_PA, air_density_kg_m3};
pub use batch::FluidBatch;
pub use builder::FluidBuilder;
pub use combustion::{Combustion, CombustionReport, Fuel, OXYGEN_IN_AIR, Radiation};
pub use density::Density;
pub use error::FluidError;
pub use fluid::Fluid;
pub use glam::{Quat, Vec3};
pub use limits::{GRAVITY_M_S2, MAX_AXIS_CELLS, MAX_CELLS, MAX_DT_S, MAX_SPEED_M_S, MAX_TEMPERATURE_K, MIN_AXIS_CELLS};
pub use obstacle::{MAX_OBSTACLES, Obstacle};
pub use pressure::{PoissonSolver, PressureSolver};
pub use report::{StageTimes, StepReport};
pub use save::{Snapshot, SnapshotError};
pub use scalars::{MAX_SCALAR, MAX_SCALARS, ScalarId};
pub use sides::{Side, SideAt, Sides};
pub use simd::SimdLevel;
pub use source::{Couple, ScalarSource, Shape, Source, SourceId};
