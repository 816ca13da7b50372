//! Outcomes as Markdown, with their plots.

use std::fmt::Write;

use crate::air::ABOUT;
use crate::chart::row;
use crate::experiment::{Effort, Experiment, Outcome};
use crate::figure::{Allowed, Figure};

/// An experiment and what it found.
pub struct Entry<'a> {
    /// Which one.
    pub experiment: &'a Experiment,
    /// What it found.
    pub outcome: &'a Outcome,
}

/// Figures as lines of a table for a terminal.
#[must_use]
pub fn table(entry: &Entry<'_>) -> String {
    let Entry { experiment, outcome } = entry;
    let mut out = format!(
        "{}: {} ({}, {:.0} million cell-steps, {:.0} s)\n",
        experiment.name,
        experiment.title,
        experiment.origin.word(),
        1.0e-6 * outcome.cell_steps as f64,
        outcome.seconds
    );
    let width = outcome.figures.iter().map(|figure| figure.what.chars().count()).max().unwrap_or(0);
    for figure in &outcome.figures {
        let verdict = format!("{:5}", figure.verdict());
        let (found, published) = (figure.found(), figure.published());
        let _ = writeln!(out, "  {verdict}  {:width$}  {found}; published {published} {}", figure.what, figure.off());
    }
    out
}

/// The page of what was found, whose plots lie in `folder` beside it: those of an experiment are in `NAME.svg`.
#[must_use]
pub fn page(entries: &[Entry<'_>], folder: &str) -> String {
    let mut out = String::new();
    let steps: f64 = entries.iter().map(|entry| 1.0e-6 * entry.outcome.cell_steps as f64).sum();
    let _ = write!(
        out,
        "# Validation\n\nFire against measured fire. `lucerna validate --long --out docs` makes this page: {steps:.0} million \
         cell-steps. Times are those of the machine that made it, busy or not. With `--only NAME` it runs that experiment again and \
         keeps what is told of the others. *Emergent*: no constant was fitted to the law or to anything like it. \
         *Calibrated*: one was. Where a figure is farther off than allowed, it is **short**.\n\n\
         {ABOUT}\n\n\
         | experiment | law | figures that hold | |\n|---|---|---|---|\n"
    );
    for Entry { experiment, outcome } in entries {
        let judged = outcome.figures.iter().filter(|figure| figure.allowed != Allowed::Any);
        let (count, held) = judged.fold((0, 0), |(count, held), figure| (count + 1, held + u32::from(figure.holds())));
        let short = if held < count { "**short**" } else { "" };
        let (name, law) = (experiment.name, experiment.law);
        let _ = writeln!(out, "| [{}](#{name}) | {law} | {held} of {count} | {short} |", experiment.title);
    }
    entries.iter().for_each(|entry| section(&mut out, entry, folder));
    out
}

/// The plots of an experiment as SVG; none for a record.
#[must_use]
pub fn plots(outcome: &Outcome) -> Option<String> {
    (!outcome.charts.is_empty()).then(|| row(&outcome.charts))
}

fn section(out: &mut String, entry: &Entry<'_>, folder: &str) {
    let Entry { experiment, outcome } = entry;
    let Experiment { name, title, law, source, measures, .. } = experiment;
    let form = if outcome.effort == Effort::Short { "Short form: " } else { "" };
    let _ = write!(
        out,
        "\n## {name}\n{title}: {law} ({source}). {measures} {form}{}: up to {:.0} thousand cells, {:.0} million \
         cell-steps, {:.0} s. **{}**.\n\n| | found | published | off | allowed | |\n|---|---|---|---|---|---|\n",
        outcome.settings,
        1.0e-3 * outcome.cells as f64,
        1.0e-6 * outcome.cell_steps as f64,
        outcome.seconds,
        experiment.origin.word()
    );
    for figure in &outcome.figures {
        out.push_str(&line(figure));
    }
    let _ = write!(out, "\n![{title}]({folder}/{name}.svg)\n");
}

fn line(figure: &Figure) -> String {
    let verdict = match figure.verdict() {
        "short" => "**short**",
        verdict => verdict,
    };
    let (found, published, off, allowed) = (figure.found(), figure.published(), figure.off(), figure.allowed());
    format!("| {} | {found} | {published} | {off} | {allowed} | {verdict} |\n", figure.what)
}
