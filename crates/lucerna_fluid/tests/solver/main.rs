//! The solver against what it promises, through its public interface only.

mod advection;
mod allocations;
mod batch;
mod cavity;
mod combustion;
mod conserve;
mod figures;
mod flows;
mod heat;
mod inputs;
mod laws;
mod obstacles;
mod points;
mod poisson;
mod projection;
mod robust;
mod saving;
mod scalars;
mod sides;
mod sources;
mod substeps;
mod support;
mod viscous;
