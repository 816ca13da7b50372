//! Documented limits: what is accepted, and where fields are clamped.

/// Fewest cells along an axis.
pub const MIN_AXIS_CELLS: usize = 2;

/// Most cells along an axis.
pub const MAX_AXIS_CELLS: usize = 512;

/// Most cells in all: about 1.6 GiB of arrays, 100 bytes a cell.
pub const MAX_CELLS: usize = 1 << 24;

/// Longest step, s.
pub const MAX_DT_S: f32 = 1.0e3;

/// Greatest speed through a face, m/s. Forces are clamped to it; it lies below the speed of
/// sound, above which air is not incompressible in any case.
pub const MAX_SPEED_M_S: f32 = 300.0;

/// Greatest temperature above ambient, K.
pub const MAX_TEMPERATURE_K: f32 = 1.0e4;

/// Acceleration of free fall, m/s² (standard gravity, rounded).
pub const GRAVITY_M_S2: f32 = 9.81;

/// Least and greatest excess temperature over ambient temperature that buoyancy feels: at most
/// one g down and ten g up.
pub(crate) const BUOYANCY_RATIO: (f32, f32) = (-1.0, 10.0);

/// Greatest acceleration that a caller may add, m/s².
pub(crate) const MAX_ACCELERATION_M_S2: f32 = 1.0e6;

/// Greatest rate at which a cell is heated, K/s.
pub(crate) const MAX_HEATING_K_S: f32 = 1.0e7;

/// Greatest divergence that a caller may ask for, 1/s.
pub(crate) const MAX_EXPANSION_PER_S: f32 = 1.0e4;

/// Greatest diffusion number (viscosity * dt / cell²) solved for; air is mixed over a hundred
/// cells in a step there, and `f32` would not carry more.
pub(crate) const MAX_DIFFUSION_NUMBER: f64 = 1.0e4;

/// Cells from which on planes are shared among threads: below, starting them costs more.
pub(crate) const PARALLEL_CELLS: usize = 24 * 24 * 24;

/// Most parts into which the transport of heat divides a step.
pub(crate) const MAX_HEAT_STEPS: f32 = 32.0;
