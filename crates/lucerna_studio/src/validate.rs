//! `lucerna validate`: runs the experiments, tells what they found, and writes it down.

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use lucerna_validation::{EXPERIMENTS, Effort, Entry, Experiment, Outcome, ValidationError, page, plots, table};

use crate::brightness::BRIGHTNESS;
use crate::cli::ValidateArgs;
use crate::progress::Progress;

/// Parts of the progress bar for each experiment.
const PARTS: u64 = 1000;
/// Folder of the plots and of what is kept of each experiment, beside the page.
const KEPT: &str = "validation";

/// Runs what was asked for; `say` gets the lines for standard output. What an experiment found is written as soon as it
/// ends, and the page made of all that is kept.
pub fn run(args: &ValidateArgs, say: impl Fn(&str)) -> Result<()> {
    let effort = if args.long { Effort::Long } else { Effort::Short };
    let chosen = chosen(args, effort)?;
    if let Some(folder) = &args.out {
        fs::create_dir_all(folder.join(KEPT)).with_context(|| format!("cannot make {}", folder.display()))?;
    }
    let mut progress = Progress::new("experiments", PARTS * chosen.len() as u64);
    let mut outcomes: Vec<(&Experiment, Outcome)> = Vec::new();
    for (at, experiment) in chosen.into_iter().enumerate() {
        let outcome = experiment.run(effort, &mut |share| {
            progress.set(PARTS * at as u64 + (PARTS as f64 * share) as u64);
            ControlFlow::Continue(())
        })?;
        if let Some(folder) = &args.out {
            keep(folder, experiment, &outcome)?;
        }
        outcomes.push((experiment, outcome));
    }
    drop(progress);
    for (experiment, outcome) in &outcomes {
        say(table(&Entry { experiment, outcome }).trim_end());
    }
    let figures = || outcomes.iter().flat_map(|(_, outcome)| &outcome.figures);
    let short = figures().filter(|figure| !figure.holds()).count();
    let line = format!("{short} of {} figures fall short", figures().count());
    if args.strict && short > 0 {
        bail!("{line}");
    }
    say(&line);
    Ok(())
}

/// Writes what an experiment found, and the page anew.
fn keep(folder: &Path, experiment: &Experiment, outcome: &Outcome) -> Result<()> {
    let write = |path: PathBuf, text: String| {
        fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))
    };
    if let Some(plots) = plots(outcome) {
        write(folder.join(KEPT).join(format!("{}.svg", experiment.name)), plots)?;
    }
    write(record_of(folder, experiment), outcome.record())?;
    let mut kept = Vec::new();
    for experiment in experiments() {
        let path = record_of(folder, experiment);
        if path.exists() {
            let text = fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
            kept.push((experiment, Outcome::from_record(&text).with_context(|| path.display().to_string())?));
        }
    }
    let entries: Vec<Entry<'_>> = kept.iter().map(|(experiment, outcome)| Entry { experiment, outcome }).collect();
    write(folder.join("validation.md"), page(&entries, KEPT))
}

fn record_of(folder: &Path, experiment: &Experiment) -> PathBuf {
    folder.join(KEPT).join(format!("{}.ron", experiment.name))
}

/// The experiments asked for; without names, all that have the form.
fn chosen(args: &ValidateArgs, effort: Effort) -> Result<Vec<&'static Experiment>> {
    if args.only.is_empty() {
        let has_form = |experiment: &&Experiment| effort == Effort::Long || experiment.short.is_some();
        return Ok(experiments().filter(has_form).collect());
    }
    let named = |name: &String| {
        let known = || experiments().map(|experiment| experiment.name).collect::<Vec<_>>().join(", ");
        let found = experiments().find(|experiment| experiment.name == name);
        Ok(found.ok_or_else(|| ValidationError::Unknown { name: name.clone(), known: known() })?)
    };
    args.only.iter().map(named).collect()
}

/// Those on air alone, and the one on pictures.
fn experiments() -> impl Iterator<Item = &'static Experiment> {
    static OF_PICTURES: [Experiment; 1] = [BRIGHTNESS];
    EXPERIMENTS.iter().chain(&OF_PICTURES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lucerna_validation::{Allowed, Figure};

    #[test]
    fn names_choose_experiments_and_wrong_ones_are_told_apart() {
        let args = |only: &[&str]| ValidateArgs {
            only: only.iter().map(|name| (*name).into()).collect(),
            ..Default::default()
        };
        let short = chosen(&args(&[]), Effort::Short).unwrap().len();
        assert!(short > 0 && short < chosen(&args(&[]), Effort::Long).unwrap().len());
        assert_eq!(chosen(&args(&["wind", "pools"]), Effort::Short).unwrap().len(), 2);
        let error = chosen(&args(&["windy"]), Effort::Long).unwrap_err().to_string();
        assert!(error.contains("`windy`") && error.contains("wind"), "{error}");
    }

    #[test]
    fn one_experiment_is_made_again_and_the_others_are_kept() {
        let folder = std::env::temp_dir().join(format!("lucerna_validate_{}", std::process::id()));
        let kept = Experiment::named("wind").unwrap();
        let figure = Figure::new("tilt", "°", 27.3, f64::NAN, Allowed::Difference(10.0)).noted("it went out");
        let outcome = Outcome { figures: vec![figure], seconds: 12.0, ..Outcome::default() };
        fs::create_dir_all(folder.join(KEPT)).unwrap();
        keep(&folder, kept, &outcome).unwrap();
        let args = ValidateArgs { only: vec!["rising_wave".into()], out: Some(folder.clone()), ..Default::default() };
        run(&args, |_| {}).unwrap();
        let text = fs::read_to_string(folder.join("validation.md")).unwrap();
        assert!(text.contains("| tilt | none (it went out) | 27.3 ° | - | 10.0 | **short** |"), "{text}");
        assert!(text.contains("## rising_wave") && text.contains("](validation/rising_wave.svg)"), "{text}");
        assert!(text.find("## rising_wave") < text.find("## wind"), "{text}");
        assert!(fs::read_to_string(folder.join("validation/rising_wave.svg")).unwrap().starts_with("<svg"));
        // A record that is spoilt is told of, not dropped.
        fs::write(record_of(&folder, kept), "spoilt").unwrap();
        let error = format!("{:#}", keep(&folder, Experiment::named("pools").unwrap(), &outcome).unwrap_err());
        assert!(error.contains("wind.ron"), "{error}");
        fs::remove_dir_all(folder).unwrap();
    }
}
