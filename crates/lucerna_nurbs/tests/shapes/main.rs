//! Curves and surfaces, in one program, which links faster than a dozen.

mod basis;
mod book;
mod closed_forms;
mod closest;
mod editing;
mod errors;
mod fit;
mod nets;
mod oracle;
mod properties;
mod serde;
mod sweeps;
mod values;
