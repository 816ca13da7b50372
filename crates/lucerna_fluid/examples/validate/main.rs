//! Runs the solver on flows with known answers: `cargo run --release -p lucerna_fluid --example
//! validate` writes plots to `docs/plots/` and prints a table in Markdown. Names of cases after
//! `--` run only those.

mod cavity;
mod chart;
mod contour;
mod decay;
mod disk;
mod heated;
mod picture;
mod plume;
mod published;
mod schemes;
mod street;
mod taylor_green;

use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// A line of the table.
struct Row {
    what: String,
    measured: String,
    /// The exact or published value, with its source.
    reference: String,
}

type Case = fn(&Path, &mut Vec<Row>) -> Outcome<()>;

const CASES: &[(&str, Case)] = &[
    ("taylor_green", taylor_green::run),
    ("decay", decay::run),
    ("disk", disk::run),
    ("cavity", cavity::run),
    ("heated_cavity", heated::run),
    ("street", street::run),
    ("plume", plume::run),
];

fn main() -> Outcome<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/plots");
    fs::create_dir_all(&folder)?;
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let mut rows = Vec::new();
    for (name, case) in CASES {
        if asked.is_empty() || asked.iter().any(|asked| asked == name) {
            let start = Instant::now();
            case(&folder, &mut rows)?;
            eprintln!("{name}: {:.1} s", start.elapsed().as_secs_f64());
        }
    }
    println!("| what | measured | exact or published |\n|---|---|---|");
    for row in &rows {
        println!("| {} | {} | {} |", row.what, row.measured, row.reference);
    }
    Ok(())
}
