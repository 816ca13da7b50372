//! The messages of values that are not allowed.

use crate::SceneError;
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::Path;

/// Makes errors that name the scene file, where there is one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Check<'a> {
    file: Option<&'a Path>,
}

impl<'a> Check<'a> {
    pub(crate) fn new(file: Option<&'a Path>) -> Self {
        Self { file }
    }

    pub(crate) fn fail(&self, field: impl Into<String>, value: impl Display, allowed: impl Into<String>) -> SceneError {
        SceneError::Value {
            file: self.file.map(Path::to_path_buf),
            field: field.into(),
            value: value.to_string(),
            allowed: allowed.into(),
        }
    }

    /// A number in a closed range; NaN is in none.
    pub(super) fn within<T>(&self, field: &str, value: T, range: RangeInclusive<T>) -> Result<(), SceneError>
    where
        T: PartialOrd + Display,
    {
        if range.contains(&value) {
            return Ok(());
        }
        Err(self.fail(field, value, format!("{} to {}", range.start(), range.end())))
    }

    /// Every number of a vector in a closed range.
    pub(super) fn each<T: PartialOrd + Display + Copy>(
        &self,
        field: &str,
        values: &[T],
        range: &RangeInclusive<T>,
    ) -> Result<(), SceneError> {
        for (index, value) in values.iter().enumerate() {
            if !range.contains(value) {
                self.within(&format!("{field}[{index}]"), *value, range.clone())?;
            }
        }
        Ok(())
    }

    /// A number above zero with an upper limit.
    pub(super) fn above_zero(&self, field: &str, value: f32, most: f32) -> Result<(), SceneError> {
        if value > 0.0 && value <= most {
            return Ok(());
        }
        Err(self.fail(field, value, format!("above 0 and at most {most}")))
    }
}
