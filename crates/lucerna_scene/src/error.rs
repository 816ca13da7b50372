//! Why a scene could not be used.

use std::path::{Path, PathBuf};

/// Why a scene could not be read, was not allowed, or could not be written.
///
/// Every message names the file (where there is one), the field or line, what is there and what is allowed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A file is missing or cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// A scene file is not well-formed, or names a field that does not exist.
    #[error("{}:{line}:{column}: {problem}", path.display())]
    Syntax {
        /// The scene file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong there.
        problem: String,
    },
    /// A value is outside what is allowed.
    #[error("{}{field} is {value}: must be {allowed}", prefix(file.as_deref()))]
    Value {
        /// The scene file, where there is one.
        file: Option<PathBuf>,
        /// The field, with its path from the scene: `air.cells[1]`.
        field: String,
        /// What it is.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// A mesh or wick file cannot be used.
    #[error("{}{}: {problem}", path.display(), line_suffix(*line))]
    Mesh {
        /// The file.
        path: PathBuf,
        /// Line, from 1, where the file has lines.
        line: Option<usize>,
        /// What is wrong with it.
        problem: String,
    },
    /// There is no built-in scene or preset of that name.
    #[error("there is no {kind} named `{name}`: must be {allowed}")]
    Unknown {
        /// `scene` or `preset`.
        kind: &'static str,
        /// The name asked for.
        name: String,
        /// The names there are.
        allowed: String,
    },
    /// A scene cannot be written as text.
    #[error("the scene cannot be written: {0}")]
    Write(String),
}

impl SceneError {
    pub(crate) fn mesh(path: &Path, line: Option<usize>, problem: impl Into<String>) -> Self {
        Self::Mesh { path: path.to_path_buf(), line, problem: problem.into() }
    }
}

fn prefix(file: Option<&Path>) -> String {
    file.map(|file| format!("{}: ", file.display())).unwrap_or_default()
}

fn line_suffix(line: Option<usize>) -> String {
    line.map(|line| format!(":{line}")).unwrap_or_default()
}
