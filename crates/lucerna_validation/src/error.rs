//! What can go wrong with an experiment.

use lucerna_fluid::FluidError;
use thiserror::Error;

/// Why an experiment gave no outcome. One that misses its law is no error: see [`crate::Outcome::holds`].
#[derive(Debug, Error)]
pub enum ValidationError {
    /// The air refused a value.
    #[error("experiment {name}: {error}")]
    Air {
        /// The experiment.
        name: &'static str,
        /// What it refused.
        #[source]
        error: FluidError,
    },
    /// Something else that it needs refused.
    #[error("experiment {name}: {error}")]
    Other {
        /// The experiment.
        name: &'static str,
        /// What went wrong.
        #[source]
        error: Box<dyn std::error::Error + Send + Sync>,
    },
    /// It was told to stop.
    #[error("experiment {name}: stopped")]
    Stopped {
        /// The experiment.
        name: &'static str,
    },
    /// A kept outcome cannot be read.
    #[error("no record of an experiment: {0}")]
    Record(#[from] ron::error::SpannedError),
    /// Nothing is called that.
    #[error("no experiment is named `{name}`; there are: {known}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// All names.
        known: String,
    },
}
