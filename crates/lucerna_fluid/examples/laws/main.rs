//! Laws of fire against what the solver does: `cargo run --release -p lucerna_fluid --example laws`
//! prints a table in Markdown. Names of cases after `--` run only those. No constant is fitted to
//! any of these laws: all that is found is emergent.

mod disk;
mod mccaffrey;
mod puffing;
mod signal;

use std::error::Error;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// A line of the table.
struct Row {
    law: String,
    published: f64,
    found: f64,
    /// How far off it may be; differences in place of percents for exponents.
    allowed: Off,
    note: String,
}

/// A distance from the published value.
enum Off {
    Percent(f64),
    Difference(f64),
}

type Case = fn(&mut Vec<Row>) -> Outcome<()>;

const CASES: &[(&str, Case)] =
    &[("light_plume", puffing::light_plume), ("burners", puffing::burners), ("mccaffrey", mccaffrey::run)];

fn main() -> Outcome<()> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    println!("| law | published | found | off | allowed | | s |\n|---|---|---|---|---|---|---|");
    for (name, case) in CASES {
        if asked.is_empty() || asked.iter().any(|asked| asked == name) {
            let (start, mut rows) = (Instant::now(), Vec::new());
            case(&mut rows)?;
            let seconds = start.elapsed().as_secs_f64();
            rows.iter().for_each(|row| print(row, seconds));
        }
    }
    Ok(())
}

/// Prints a row; the seconds are those of its whole case.
fn print(row: &Row, seconds: f64) {
    let Row { law, published, found, note, .. } = row;
    let (off, allowed, is_short) = match row.allowed {
        Off::Percent(most) => {
            let off = 100.0 * (found / published - 1.0);
            (format!("{off:+.0} %"), format!("{most:.0} %"), off.abs() > most)
        }
        Off::Difference(most) => {
            let off = found - published;
            (format!("{off:+.2}"), format!("{most:.2}"), off.abs() > most)
        }
    };
    let verdict = if is_short { "**short**" } else { "holds" };
    println!("| {law} | {published:.2} | {found:.2} {note} | {off} | {allowed} | {verdict} | {seconds:.0} |");
}
