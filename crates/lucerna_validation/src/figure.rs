//! A measured number beside the published one.

use std::borrow::Cow;
use std::fmt::Write;

use serde::{Deserialize, Serialize};

/// How far a figure may be off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Allowed {
    /// Percent of the published value, either way.
    Percent(f64),
    /// As much either way.
    Difference(f64),
    /// Published as a range: from the published value up to this.
    UpTo(f64),
    /// Anything below the published value.
    Below,
    /// Anything; the figure is told for comparison.
    Any,
}

/// A measured number beside the published one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// What was measured.
    pub what: String,
    /// Unit of both values; empty for a plain number.
    pub unit: Cow<'static, str>,
    /// Published value.
    pub published: f64,
    /// Measured value; not a number where there was nothing to measure.
    pub found: f64,
    /// How far off it may be.
    pub allowed: Allowed,
    /// What else to know, or nothing.
    pub note: String,
}

impl Figure {
    /// A figure without a note.
    #[must_use]
    pub fn new(what: impl Into<String>, unit: &'static str, published: f64, found: f64, allowed: Allowed) -> Self {
        Self { what: what.into(), unit: unit.into(), published, found, allowed, note: String::new() }
    }

    /// The same with a note.
    #[must_use]
    pub fn noted(self, note: impl Into<String>) -> Self {
        Self { note: note.into(), ..self }
    }

    /// Whether it is as close as it has to be.
    #[must_use]
    pub fn holds(&self) -> bool {
        let (published, found) = (self.published, self.found);
        match self.allowed {
            Allowed::Percent(most) => (100.0 * (found / published - 1.0)).abs() <= most,
            Allowed::Difference(most) => (found - published).abs() <= most,
            Allowed::UpTo(high) => (published..=high).contains(&found),
            Allowed::Below => found < published,
            Allowed::Any => true,
        }
    }

    /// `holds`, `short`, or nothing where anything is allowed.
    #[must_use]
    pub fn verdict(&self) -> &'static str {
        match (self.allowed, self.holds()) {
            (Allowed::Any, _) => "",
            (_, true) => "holds",
            (_, false) => "short",
        }
    }

    /// How far off it is.
    #[must_use]
    pub fn off(&self) -> String {
        let (published, found) = (self.published, self.found);
        match self.allowed {
            _ if !found.is_finite() => "-".into(),
            Allowed::Percent(_) => format!("{:+.0} %", 100.0 * (found / published - 1.0)),
            Allowed::Difference(_) => with_digits(found - published, true),
            Allowed::UpTo(_) | Allowed::Below | Allowed::Any => String::new(),
        }
    }

    /// What is allowed, in words.
    #[must_use]
    pub fn allowed(&self) -> String {
        match self.allowed {
            Allowed::Percent(most) => format!("{most:.0} %"),
            Allowed::Difference(most) => with_digits(most, false),
            Allowed::UpTo(_) => "in the range".into(),
            Allowed::Below => "below".into(),
            Allowed::Any => String::new(),
        }
    }

    /// The published value with its unit.
    #[must_use]
    pub fn published(&self) -> String {
        match self.allowed {
            _ if !self.published.is_finite() => "-".into(),
            Allowed::UpTo(high) => {
                self.with_unit(format!("{} to {}", with_digits(self.published, false), with_digits(high, false)))
            }
            _ => self.with_unit(with_digits(self.published, false)),
        }
    }

    /// The measured value with its unit and note.
    #[must_use]
    pub fn found(&self) -> String {
        let mut text =
            if self.found.is_finite() { self.with_unit(with_digits(self.found, false)) } else { "none".into() };
        if !self.note.is_empty() {
            let _ = write!(text, " ({})", self.note);
        }
        text
    }

    fn with_unit(&self, value: String) -> String {
        if self.unit.is_empty() { value } else { format!("{value} {}", self.unit) }
    }
}

/// Three digits that count, or two decimal places.
fn with_digits(value: f64, is_signed: bool) -> String {
    let digits = match value.abs() {
        100.0.. => 0,
        10.0.. => 1,
        1.0.. | 0.0 => 2,
        _ => 3,
    };
    let value = if value == 0.0 { 0.0 } else { value };
    if is_signed { format!("{value:+.digits$}") } else { format!("{value:.digits$}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_hold_within_what_is_allowed_and_no_further() {
        let figure = |found, allowed| Figure::new("x", "m", 2.0, found, allowed);
        for (found, allowed, holds) in [
            (2.29, Allowed::Percent(15.0), true),
            (2.31, Allowed::Percent(15.0), false),
            (f64::NAN, Allowed::Percent(15.0), false),
            (1.91, Allowed::Difference(0.1), true),
            (1.89, Allowed::Difference(0.1), false),
            (2.9, Allowed::UpTo(3.0), true),
            (1.9, Allowed::UpTo(3.0), false),
            (1.9, Allowed::Below, true),
            (2.0, Allowed::Below, false),
            (f64::NAN, Allowed::Any, true),
        ] {
            assert_eq!(figure(found, allowed).holds(), holds, "{found} {allowed:?}");
        }
    }

    #[test]
    fn values_are_written_with_their_units() {
        let figure = Figure::new("x", "Hz", 1.37, 0.0, Allowed::UpTo(15.0)).noted("steady");
        assert_eq!((figure.published(), figure.found()), ("1.37 to 15.0 Hz".into(), "0.00 Hz (steady)".into()));
        assert_eq!(Figure::new("x", "", -0.5, -0.45, Allowed::Difference(0.1)).off(), "+0.050");
        assert_eq!(Figure::new("x", "m", 0.41, f64::NAN, Allowed::Percent(25.0)).found(), "none");
    }
}
