//! The solver against what it promises, through its public interface only.

mod batch;
mod flows;
mod heat;
mod inputs;
mod projection;
mod robust;
mod saving;
mod scalars;
mod sides;
mod sources;
mod support;
mod viscous;
