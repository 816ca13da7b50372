//! What the program and the examples do with a command line, and how they fail: one line, exit code 2.

use crate::cli::{Command, ExampleArgs, ProgramArgs, RecordArgs, SceneArgs, one_line};
use crate::job::Job;
use crate::progress::say;
use crate::window::{self, Outcome, WindowJob};
use crate::{export, headless, validate};
use crate::{record, scenes};
use anyhow::{Result, bail};
use clap::Parser;
use lucerna::scene::{LoadedScene, Scene};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Runs the program `lucerna` on the command line of this process.
#[must_use]
pub fn run_program() -> ExitCode {
    exit_code(ProgramArgs::try_parse().map_or_else(Err, |args| Ok(program(args))))
}

/// Runs an example: a built-in scene, in a window or, asked for by its command line or for want of a display,
/// without one.
#[must_use]
pub fn run_example(name: &str) -> ExitCode {
    run_example_with(name, |_| {})
}

/// As [`run_example`], with changes to the scene made in code; the command line has the last word.
#[must_use]
pub fn run_example_with(name: &str, adjust: impl FnOnce(&mut Scene)) -> ExitCode {
    exit_code(ExampleArgs::try_parse().map_or_else(Err, |args| Ok(example(name, adjust, &args))))
}

fn program(args: ProgramArgs) -> Result<()> {
    match args.command {
        None => {
            print_overview();
            Ok(())
        }
        Some(Command::View { scene, changes, window, size }) => {
            if let Some(path) = &window.screenshot {
                record::check_file(path)?;
            }
            let loaded = scenes::open(&scene, &changes, |_| {})?;
            match window::run(WindowJob {
                name: scene,
                scene: loaded,
                preset: changes.preset,
                surfaces: changes.surfaces,
                window,
                size,
            })? {
                Outcome::Closed => Ok(()),
                Outcome::NotOpened(error) => bail!("{error}; `lucerna render` draws without a window"),
            }
        }
        Some(Command::Render { scene, changes, record, headless: _ }) => {
            let loaded = scenes::open(&scene, &changes, |_| {})?;
            let name = Path::new(&scene).file_stem().unwrap_or_default().to_owned();
            render(loaded, &changes, &record, Path::new(&name).with_extension("png"))
        }
        Some(Command::Export { scene, export }) => {
            let (preset, seed) = (export.preset.clone(), export.seed);
            let loaded = scenes::open(&scene, &SceneArgs { preset, seed, ..SceneArgs::default() }, |_| {})?;
            export::run(loaded, &export)?.iter().for_each(|line| print_line(line));
            Ok(())
        }
        Some(Command::Validate { validate }) => validate::run(&validate, print_line),
    }
}

fn example(name: &str, adjust: impl FnOnce(&mut Scene), args: &ExampleArgs) -> Result<()> {
    if let Some(path) = &args.window.screenshot {
        record::check_file(path)?;
    }
    let loaded = scenes::open(name, &args.changes, adjust)?;
    if !args.runs_headless() {
        let (preset, surfaces) = (args.changes.preset.clone(), args.changes.surfaces);
        let (window, size) = (args.window.clone(), args.record.size);
        match window::run(WindowJob { name: name.into(), scene: loaded.clone(), preset, surfaces, window, size })? {
            Outcome::Closed => return Ok(()),
            Outcome::NotOpened(error) => say(&format!("{}: drawing without a window", message(&error))),
        }
    }
    let folder = if Path::new("target").is_dir() { Path::new("target") } else { Path::new("") };
    render(loaded, &args.changes, &args.record, folder.join(name).with_extension("png"))
}

fn render(scene: LoadedScene, changes: &SceneArgs, record: &RecordArgs, default_out: PathBuf) -> Result<()> {
    for line in headless::run(&Job::new(scene, changes, record, default_out)?)? {
        print_line(&line);
    }
    Ok(())
}

/// Lists the scenes, the presets and the commands.
fn print_overview() {
    print_line("Lucerna: real-time fire\n\nScenes:");
    for name in lucerna::scene::builtin_names() {
        print_line(&format!("  {name}"));
    }
    print_line("\nPresets:");
    for name in lucerna::scene::presets() {
        print_line(&format!("  {name}"));
    }
    print_line(
        "\nCommands:\n  \
         lucerna view SCENE                    opens a window\n  \
         lucerna render SCENE --out fire.png   draws a picture\n  \
         lucerna render SCENE --out fire.gif   records an animation\n  \
         lucerna export SCENE --out folder     writes the flames for other programs\n  \
         lucerna validate                      holds the fire to the laws of fire\n  \
         lucerna help                          lists every option\n\n\
         SCENE is one of the names above or the path of a scene file.",
    );
}

/// Writes a line to standard output; a closed one is no reason to fail.
fn print_line(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

fn exit_code(result: Result<Result<()>, clap::Error>) -> ExitCode {
    match result {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(error)) => {
            say(&format!("error: {}", message(&error)));
            ExitCode::from(2)
        }
        Err(error) if error.use_stderr() => {
            say(&one_line(&error));
            ExitCode::from(2)
        }
        Err(help) => {
            print_line(help.to_string().trim_end());
            ExitCode::SUCCESS
        }
    }
}

/// An error and its causes as one line; a cause that the line names already is not repeated.
fn message(error: &anyhow::Error) -> String {
    let mut line = String::new();
    for cause in error.chain() {
        let text = cause.to_string().split_whitespace().collect::<Vec<&str>>().join(" ");
        if line.is_empty() {
            line = text;
        } else if !line.contains(&text) {
            line = format!("{line}: {text}");
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_one_line_without_repetition() {
        let error = anyhow::anyhow!("no such\nfile").context("a.ron: no such file").context("cannot open");
        assert_eq!(message(&error), "cannot open: a.ron: no such file");
    }
}
