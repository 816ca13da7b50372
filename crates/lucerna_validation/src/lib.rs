//! Lucerna's fire held to the measured laws of fire.
//!
//! An [`Experiment`] is a value: which law, who measured it, what is measured here and how, and whether any constant was
//! fitted to it. [`Experiment::run`] burns it and gives an [`Outcome`]: figures beside the published ones, charts, and
//! how much work it was. [`page`] writes all of it as Markdown.
//!
//! ```
//! use lucerna_validation::{Effort, Experiment};
//! use std::ops::ControlFlow;
//!
//! let experiment = Experiment::named("rising_wave").expect("it is in the catalogue");
//! let outcome = experiment.run(Effort::Short, &mut |_| ControlFlow::Continue(()))?;
//! assert!(outcome.holds());
//! # Ok::<(), lucerna_validation::ValidationError>(())
//! ```

mod air;
mod catalogue;
mod chart;
mod error;
mod experiment;
mod figure;
mod fire;
mod flame_height;
mod laws;
mod page;
mod signal;

pub use catalogue::{EXPERIMENTS, names};
pub use chart::{Axis, Chart, Mark, Series};
pub use error::ValidationError;
pub use experiment::{Effort, Experiment, Halt, Origin, Outcome, Run};
pub use figure::{Allowed, Figure};
pub use page::{Entry, page, plots, table};
pub use signal::{Peak, spectrum, strongest};
