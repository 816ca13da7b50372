//! Uniform grids.

mod every;
mod many;
mod output;
mod points;
mod shapes;
mod tables;
mod tolerance;
