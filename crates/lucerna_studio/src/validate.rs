//! `lucerna validate`: runs the experiments, tells what they found, and writes it down.

use std::fs;
use std::ops::ControlFlow;

use anyhow::{Context, Result, bail};
use lucerna_validation::{EXPERIMENTS, Effort, Entry, Experiment, Outcome, page, table};

use crate::cli::ValidateArgs;
use crate::progress::Progress;

/// Parts of the progress bar for each experiment.
const PARTS: u64 = 1000;
/// Folder of the plots, beside the page.
const PLOTS: &str = "validation";

/// Runs what was asked for; `say` gets the lines for standard output.
pub fn run(args: &ValidateArgs, say: impl Fn(&str)) -> Result<()> {
    let effort = if args.long { Effort::Long } else { Effort::Short };
    let chosen = chosen(args, effort)?;
    if let Some(folder) = &args.out {
        fs::create_dir_all(folder.join(PLOTS)).with_context(|| format!("cannot make {}", folder.display()))?;
    }
    let mut progress = Progress::new("experiments", PARTS * chosen.len() as u64);
    let mut outcomes: Vec<(&Experiment, Outcome)> = Vec::new();
    for (at, experiment) in chosen.into_iter().enumerate() {
        let outcome = experiment.run(effort, &mut |share| {
            progress.set(PARTS * at as u64 + (PARTS as f64 * share) as u64);
            ControlFlow::Continue(())
        })?;
        outcomes.push((experiment, outcome));
    }
    drop(progress);
    let entries: Vec<Entry<'_>> = outcomes.iter().map(|(experiment, outcome)| Entry { experiment, outcome }).collect();
    entries.iter().for_each(|entry| say(table(entry).trim_end()));
    if let Some(folder) = &args.out {
        let (text, plots) = page(&entries, &command(args), effort, PLOTS);
        let files = plots.into_iter().map(|(name, text)| (folder.join(PLOTS).join(name), text));
        for (path, text) in files.chain([(folder.join("validation.md"), text)]) {
            fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))?;
        }
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

/// The experiments asked for; without names, all that have the form.
fn chosen(args: &ValidateArgs, effort: Effort) -> Result<Vec<&'static Experiment>> {
    if args.only.is_empty() {
        let has_form = |experiment: &&Experiment| effort == Effort::Long || experiment.short.is_some();
        return Ok(EXPERIMENTS.iter().filter(has_form).collect());
    }
    args.only.iter().map(|name| Ok(Experiment::named(name)?)).collect()
}

/// What makes the same page again.
fn command(args: &ValidateArgs) -> String {
    let mut line = String::from("lucerna validate");
    if args.long {
        line.push_str(" --long");
    }
    if !args.only.is_empty() {
        line.push_str(&format!(" --only {}", args.only.join(",")));
    }
    line.push_str(" --out docs");
    line
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn the_page_and_its_plots_are_written() {
        let folder = std::env::temp_dir().join(format!("lucerna_validate_{}", std::process::id()));
        let args = ValidateArgs { only: vec!["rising_wave".into()], out: Some(folder.clone()), ..Default::default() };
        run(&args, |_| {}).unwrap();
        let text = fs::read_to_string(folder.join("validation.md")).unwrap();
        assert!(
            text.contains("--only rising_wave") && text.contains("![Light gas under air](validation/rising_wave.svg)")
        );
        assert!(fs::read_to_string(folder.join("validation/rising_wave.svg")).unwrap().starts_with("<svg"));
        fs::remove_dir_all(folder).unwrap();
    }
}
