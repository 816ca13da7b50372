//! Where the bytes of scene, mesh and material files come from: a folder, or the crate itself.

use crate::SceneError;
use std::borrow::Cow;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// What a path starts with when the file is one of those embedded in the crate.
pub(crate) const BUILTIN_PREFIX: &str = "builtin:";

/// Largest scene or material file, bytes.
pub(crate) const MAX_TEXT_BYTES: u64 = 16 << 20;

/// Largest mesh file, bytes.
pub(crate) const MAX_MESH_BYTES: u64 = 512 << 20;

/// The folder that relative paths start from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Assets<'a> {
    base_dir: &'a Path,
}

impl<'a> Assets<'a> {
    pub(crate) fn new(base_dir: &'a Path) -> Self {
        Self { base_dir }
    }

    /// The file that a scene or another file names.
    pub(crate) fn resolve(&self, file: &Path) -> PathBuf {
        if builtin_name(file).is_some() { file.to_path_buf() } else { self.base_dir.join(file) }
    }
}

/// The path of a file that stands beside another one; `name` may use either slash.
pub(crate) fn beside(file: &Path, name: &str) -> PathBuf {
    let name = name.replace('\\', "/");
    match builtin_name(file) {
        Some(_) => PathBuf::from(format!("{BUILTIN_PREFIX}{name}")),
        None => file.parent().unwrap_or(Path::new("")).join(name),
    }
}

/// Reads a resolved file of at most `limit` bytes; anything but a regular file is refused.
pub(crate) fn read(path: &Path, limit: u64) -> Result<Cow<'static, [u8]>, SceneError> {
    if let Some(name) = builtin_name(path) {
        return match crate::builtin::file(name) {
            Some(bytes) => Ok(Cow::Borrowed(bytes)),
            None => Err(SceneError::Read { path: path.to_path_buf(), source: std::io::ErrorKind::NotFound.into() }),
        };
    }
    let failed = |source| SceneError::Read { path: path.to_path_buf(), source };
    // Before opening it: opening a named pipe would wait for a writer.
    let metadata = std::fs::metadata(path).map_err(failed)?;
    if !metadata.is_file() {
        return Err(SceneError::mesh(path, None, "is not a regular file"));
    }
    let too_large = |bytes: u64| {
        SceneError::mesh(path, None, format!("is {bytes} bytes long: must be at most {} MiB", limit >> 20))
    };
    if metadata.len() > limit {
        return Err(too_large(metadata.len()));
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes)).map_err(failed)?;
    // Some files (in /proc, say) do not know their size.
    if bytes.len() as u64 > limit {
        return Err(too_large(bytes.len() as u64));
    }
    Ok(Cow::Owned(bytes))
}

fn builtin_name(path: &Path) -> Option<&str> {
    path.to_str()?.strip_prefix(BUILTIN_PREFIX)
}
