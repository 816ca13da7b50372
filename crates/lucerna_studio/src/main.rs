//! The program `lucerna`: looks at fires and records them.

use std::process::ExitCode;

fn main() -> ExitCode {
    lucerna_studio::run_program()
}
