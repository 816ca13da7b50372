//! NURBS curves and surfaces with exact normals and fast grid tessellation.
//!
//! Everything is generic over `f32` and `f64`, never panics on values a user can supply, and has
//! no GPU types: coordinates are arrays, and a mesh goes to the caller's own buffer of the caller's
//! own vertices. Algorithm numbers are those of Piegl and Tiller, *The NURBS Book*, second edition.
//!
//! * [`KnotVector`]: knots, validated once; basis functions (A2.1 to A2.3).
//! * [`Curve`], [`Surface`]: rational, of any degree up to [`MAX_DEGREE`]; points and derivatives
//!   (A3.1, A3.2, A3.5, A3.6, A4.1 to A4.4); normals that are also right where an edge collapses.
//! * Editing that leaves the shape where it is: knots inserted and removed, degrees raised, parts cut
//!   out, Bezier pieces (A5.1 to A5.9), directions reversed and exchanged, curves on surfaces.
//! * Shapes: arcs (A7.1), surfaces of revolution (A8.1), extruded, ruled and lofted ones; spheres,
//!   tori, cylinders.
//! * Curves and surfaces through points and near them (A9.1 to A9.7), with parameters by [`Spacing`].
//! * The closest point, the global one; bounding boxes.
//! * [`GridPlan`]: everything about a uniform grid that does not depend on the control points,
//!   computed once and shared by all surfaces of that size.
//!
//! # Example
//!
//! A closed surface, drawn with 32 columns around it and 24 rows along it:
//!
//! ```
//! use lucerna_nurbs::{Closure, GridOptions, GridPlan, KnotVector};
//!
//! // Eight control rows around an axis, five points along it.
//! let around = KnotVector::<f32>::periodic(3, 8)?;
//! let along = KnotVector::clamped_uniform(3, 5)?;
//! let mut net = Vec::new();
//! for i in 0..8 {
//!     let (sin, cos) = (i as f32 / 8.0 * std::f32::consts::TAU).sin_cos();
//!     for radius_and_height in [[0.5, 0.0], [0.8, 0.5], [0.4, 1.0], [0.3, 1.5], [0.5, 2.0]] {
//!         let [radius, y] = radius_and_height;
//!         net.push([radius * cos, y, -radius * sin]);
//!     }
//! }
//!
//! let plan = GridPlan::new(
//!     &around,
//!     &along,
//!     GridOptions {
//!         columns: 32,
//!         rows: 24,
//!         closure_u: Closure::Periodic { start_row: 0 },
//!         ..GridOptions::default()
//!     },
//! )?;
//! let mut scratch = plan.scratch();
//! let mut vertices = vec![([0.0; 3], [0.0; 3]); plan.vertex_count()];
//! plan.evaluate(&net, None, &mut scratch, |index, vertex| {
//!     vertices[index] = (vertex.position, vertex.normal);
//! })?;
//! assert_eq!(plan.indices().len(), 32 * 24 * 2 * 3);
//! assert_eq!(vertices[0], vertices[32], "the seam closes bit for bit");
//! # Ok::<(), lucerna_nurbs::NurbsError>(())
//! ```
//!
//! # Features
//!
//! * `std` (on by default): square roots by the processor, and the best vector instructions that it
//!   has. Without it the crate needs an allocator and nothing else of the platform.
//! * `rayon`: [`GridPlan::evaluate_many`] on all processors.
//! * `serde`: knots, curves, surfaces and options can be written and read; what is read is validated.
//!
//! The least Rust version is 1.95.

#![no_std]

extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

mod adaptive;
mod basis;
mod bernstein;
mod bounds;
mod check;
mod closest;
mod curve;
mod edit;
mod error;
mod fit;
mod flatness;
mod knots;
mod patch;
mod plan;
mod real;
#[cfg(feature = "serde")]
mod serial;
mod shapes;
mod simd;
mod strip;
mod surface;
mod vector;

pub use adaptive::{AdaptiveOptions, Mesh};
pub use basis::Basis;
pub use bounds::Bounds;
pub use closest::{CurvePoint, SurfacePoint};
pub use curve::Curve;
pub use edit::Direction;
pub use error::NurbsError;
pub use fit::{FitSample, Spacing};
pub use knots::KnotVector;
pub use plan::{
    Closure, GridLayout, GridOptions, GridOutput, GridPlan, GridVertex, Interleaved, Scratch, cells_for_error,
};
pub use real::Real;
pub use simd::SimdLevel;
pub use surface::{Surface, SurfaceDerivatives};

/// The highest degree, and the highest order of derivatives, that is accepted.
pub const MAX_DEGREE: usize = 32;
/// The most control points in one direction.
pub const MAX_POINTS: usize = 1 << 20;
/// The smallest weight that is accepted.
pub const MIN_WEIGHT: f64 = 1e-9;
/// The largest weight that is accepted.
pub const MAX_WEIGHT: f64 = 1e9;
