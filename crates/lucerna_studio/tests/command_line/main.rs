//! The program `lucerna` as it is used from a shell: what it writes, what it answers, and how it refuses.
//!
//! A refusal is one line on standard error that says what is wrong, nothing on standard output, and exit code 2.

mod place;
mod refused;
mod wicks;
mod written;
