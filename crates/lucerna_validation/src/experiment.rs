//! What an experiment is, and running one.

use std::ops::ControlFlow;
use std::time::Instant;

use lucerna_fluid::{Fluid, FluidError, StepReport};
use serde::{Deserialize, Serialize};

use crate::catalogue::{EXPERIMENTS, names};
use crate::chart::Chart;
use crate::error::ValidationError;
use crate::figure::Figure;

/// How much work to spend.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Effort {
    /// Coarse grids and short times: seconds.
    #[default]
    Short,
    /// What the documentation's figures come from: up to some minutes each.
    Long,
}

/// Where a figure comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// No constant was fitted to the law, or to anything like it.
    Emergent,
    /// A constant was set from measurements of the same kind.
    Calibrated,
}

impl Origin {
    /// The word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Emergent => "emergent",
            Self::Calibrated => "calibrated",
        }
    }
}

/// A law, and how the simulation is held to it.
#[derive(Debug)]
pub struct Experiment {
    /// What to call it by: lower case letters and `_`.
    pub name: &'static str,
    /// What burns.
    pub title: &'static str,
    /// The law as a formula.
    pub law: &'static str,
    /// Who published it.
    pub source: &'static str,
    /// Whether anything was fitted.
    pub origin: Origin,
    /// What is measured here, and how.
    pub measures: &'static str,
    /// Grid and times with [`Effort::Short`]; none where only the long form says anything.
    pub short: Option<&'static str>,
    /// Grid and times with [`Effort::Long`].
    pub long: &'static str,
    /// Burns it.
    pub burn: fn(&mut Run<'_>) -> Result<(), Halt>,
}

impl Experiment {
    /// The experiment of that name.
    ///
    /// # Errors
    /// A name that is not in the catalogue.
    pub fn named(name: &str) -> Result<&'static Self, ValidationError> {
        let known = EXPERIMENTS.iter().find(|experiment| experiment.name == name);
        known.ok_or_else(|| ValidationError::Unknown { name: name.into(), known: names().join(", ") })
    }

    /// Runs it. `progress` is told the share that is done, 0 to 1, now and then, and can stop it.
    ///
    /// # Errors
    /// Being stopped, and values that the air refuses.
    pub fn run(
        &self,
        effort: Effort,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Outcome, ValidationError> {
        let start = Instant::now();
        let mut run = Run { effort, progress, part: [0.0, 1.0], outcome: Outcome::default() };
        let name = self.name;
        (self.burn)(&mut run).map_err(|halt| match halt {
            Halt::Air(error) => ValidationError::Air { name, error },
            Halt::Other(error) => ValidationError::Other { name, error },
            Halt::Stopped => ValidationError::Stopped { name },
        })?;
        let settings = match effort {
            Effort::Short => self.short.unwrap_or(self.long),
            Effort::Long => self.long,
        };
        let seconds = start.elapsed().as_secs_f64();
        Ok(Outcome { effort, settings: settings.into(), seconds, ..run.outcome })
    }
}

/// What was found. Its record, which [`Outcome::record`] writes, is all of it but the plots.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Outcome {
    /// How much work it was.
    pub effort: Effort,
    /// Grid and times.
    pub settings: String,
    /// Figures beside the published ones.
    pub figures: Vec<Figure>,
    /// Plots, side by side.
    #[serde(skip)]
    pub charts: Vec<Chart>,
    /// Cells of the largest box.
    pub cells: usize,
    /// Cells stepped in all: the work, whatever the machine.
    pub cell_steps: u64,
    /// Time that it took here, s.
    pub seconds: f64,
}

impl Outcome {
    /// Whether all figures hold.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.figures.iter().all(Figure::holds)
    }

    /// What was found, as text in RON, so that a page can be written again without burning all of it.
    #[must_use]
    pub fn record(&self) -> String {
        // Numbers and texts can always be written.
        ron::ser::to_string_pretty(self, ron::ser::PrettyConfig::default()).unwrap_or_default()
    }

    /// Reads a record.
    ///
    /// # Errors
    /// Text that is no record.
    pub fn from_record(text: &str) -> Result<Self, ValidationError> {
        Ok(ron::from_str(text)?)
    }
}

/// Why an experiment ended early.
#[derive(Debug)]
pub enum Halt {
    /// The air refused a value.
    Air(FluidError),
    /// Something else that the experiment needs refused.
    Other(Box<dyn std::error::Error + Send + Sync>),
    /// It was told to stop.
    Stopped,
}

impl Halt {
    /// Anything that an experiment needs and that fails.
    #[must_use]
    pub fn other(error: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> Self {
        Self::Other(error.into())
    }
}

impl From<FluidError> for Halt {
    fn from(error: FluidError) -> Self {
        Self::Air(error)
    }
}

/// An experiment while it runs.
pub struct Run<'a> {
    effort: Effort,
    progress: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
    /// Share of the whole where the present part starts, and how much it is.
    part: [f64; 2],
    outcome: Outcome,
}

impl Run<'_> {
    /// One of two settings.
    pub(crate) fn choose<T>(&self, short: T, long: T) -> T {
        match self.effort {
            Effort::Short => short,
            Effort::Long => long,
        }
    }

    /// Says that a share of the present part is done, 0 to 1.
    ///
    /// # Errors
    /// Being told to stop.
    pub fn done(&mut self, share: f64) -> Result<(), Halt> {
        let [start, size] = self.part;
        if (self.progress)(start + size * share).is_break() { Err(Halt::Stopped) } else { Ok(()) }
    }

    /// Counts work: a box of so many cells, and how many were stepped.
    pub fn count(&mut self, cells: usize, cell_steps: u64) {
        self.outcome.cells = self.outcome.cells.max(cells);
        self.outcome.cell_steps += cell_steps;
    }

    /// From now on, part `at` of `count` runs.
    pub(crate) fn part(&mut self, at: usize, count: usize) {
        self.part = [at as f64 / count as f64, 1.0 / count as f64];
    }

    /// Steps the air `count` times, and calls `look` after each with its number.
    pub(crate) fn steps(
        &mut self,
        air: &mut Fluid,
        dt_s: f32,
        count: usize,
        mut look: impl FnMut(usize, &Fluid, &StepReport),
    ) -> Result<(), Halt> {
        let cells = air.cells().into_iter().product::<usize>();
        for step in 0..count {
            if step % 16 == 0 {
                self.done(step as f64 / count as f64)?;
            }
            let report = air.step(dt_s)?;
            self.count(cells, cells as u64 * u64::from(report.substeps.max(1)));
            look(step, air, &report);
        }
        Ok(())
    }

    /// Adds a figure.
    pub fn figure(&mut self, figure: Figure) {
        self.outcome.figures.push(figure);
    }

    /// Adds a plot.
    pub fn chart(&mut self, chart: Chart) {
        self.outcome.charts.push(chart);
    }
}
