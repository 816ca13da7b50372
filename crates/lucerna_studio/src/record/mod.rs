//! Where frames go: a PNG, an animated GIF or a folder of numbered PNGs.

pub mod dither;
pub mod gif;
pub mod palette;
pub mod png;

#[cfg(test)]
mod gif_tests;

use anyhow::{Context, Result, bail};
use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};

/// Highest rate of a GIF: viewers slow down what is faster.
pub const GIF_MAX_FPS: f64 = 50.0;

/// What a path asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// The last frame.
    Png(PathBuf),
    /// An animation.
    Gif(PathBuf),
    /// `frame_00000.png` and so on.
    Folder(PathBuf),
}

impl Output {
    /// Reads what a path asks for from how it ends.
    pub fn new(path: &Path) -> Result<Self> {
        let path = path.to_path_buf();
        if path.as_os_str().is_empty() {
            bail!("--out needs a path");
        }
        let named_folder = path.is_dir() || path.to_string_lossy().ends_with(['/', '\\']);
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            _ if named_folder => Ok(Self::Folder(path)),
            None => Ok(Self::Folder(path)),
            Some("png") => Ok(Self::Png(path)),
            Some("gif") => Ok(Self::Gif(path)),
            Some(other) => bail!("{}: .{other} cannot be written: use .png, .gif or a folder", path.display()),
        }
    }

    /// The path.
    #[must_use]
    pub fn path(&self) -> &Path {
        match self {
            Self::Png(path) | Self::Gif(path) | Self::Folder(path) => path,
        }
    }

    /// Fails before any work is done where the path cannot be written; makes the folder of a sequence.
    pub fn prepare(&self) -> Result<()> {
        match self {
            Self::Png(path) | Self::Gif(path) => check_file(path),
            Self::Folder(path) => {
                fs::create_dir_all(path).with_context(|| format!("cannot make the folder {}", path.display()))?;
                check_file(&path.join("frame_00000.png"))
            }
        }
    }
}

/// Fails where a file cannot be written; leaves an existing file as it is and no new one behind.
pub fn check_file(path: &Path) -> Result<()> {
    let existed = path.exists();
    OpenOptions::new()
        .append(true)
        .create(true)
        .open(path)
        .with_context(|| format!("cannot write {}", path.display()))?;
    if !existed {
        fs::remove_file(path).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}

/// Takes frames as they are drawn and writes them.
#[derive(Debug)]
pub struct Recorder {
    output: Output,
    size_px: [u32; 2],
    frames: u32,
    seen: u32,
    gif: Option<gif::GifRecorder>,
}

impl Recorder {
    /// Begins a recording of `frames` frames.
    pub fn new(output: Output, size_px: [u32; 2], frames: u32, fps: f64) -> Result<Self> {
        let gif = match &output {
            Output::Gif(path) => Some(gif::GifRecorder::new(path, size_px, fps)?),
            Output::Png(_) | Output::Folder(_) => None,
        };
        Ok(Self { output, size_px, frames, seen: 0, gif })
    }

    /// Whether the next frame's pixels are needed; where they are not, [`Recorder::skip`] it.
    #[must_use]
    pub fn wants_next(&self) -> bool {
        !matches!(self.output, Output::Png(_)) || self.seen + 1 == self.frames
    }

    /// Passes over a frame.
    pub fn skip(&mut self) {
        self.seen += 1;
    }

    /// Takes a frame: rows of red, green, blue, from the top.
    pub fn push(&mut self, rgb: &[u8]) -> Result<()> {
        match (&self.output, &mut self.gif) {
            (Output::Gif(_), Some(gif)) => gif.push(rgb)?,
            (Output::Gif(_), None) => {}
            (Output::Png(path), _) => png::write(path, self.size_px, rgb)?,
            (Output::Folder(path), _) => {
                png::write(&path.join(format!("frame_{:05}.png", self.seen)), self.size_px, rgb)?;
            }
        }
        self.seen += 1;
        Ok(())
    }

    /// Writes what is still held back, and says in words what was written.
    pub fn finish(self) -> Result<String> {
        if let Some(gif) = self.gif {
            gif.finish()?;
        }
        let [width, height] = self.size_px;
        let path = self.output.path().display();
        Ok(match self.output {
            Output::Png(_) => format!("wrote {path} ({width}x{height})"),
            Output::Gif(_) => format!("wrote {path} ({} frames, {width}x{height})", self.seen),
            Output::Folder(_) => format!("wrote {} pictures to {path} ({width}x{height})", self.seen),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_choose_the_kind() {
        assert_eq!(Output::new(Path::new("a.PNG")).unwrap(), Output::Png("a.PNG".into()));
        assert_eq!(Output::new(Path::new("b/a.gif")).unwrap(), Output::Gif("b/a.gif".into()));
        assert_eq!(Output::new(Path::new("frames")).unwrap(), Output::Folder("frames".into()));
        assert_eq!(Output::new(Path::new("take.2/")).unwrap(), Output::Folder("take.2/".into()));
        assert!(Output::new(Path::new("a.jpg")).is_err());
        assert!(Output::new(Path::new("")).is_err());
    }

    #[test]
    fn unwritable_paths_fail_early_and_leave_nothing() {
        assert!(Output::Png("/no/such/folder/a.png".into()).prepare().is_err());
        assert!(Output::Folder("/dev/null/frames".into()).prepare().is_err());
        let folder = tempdir("prepare");
        let path = folder.join("a.png");
        Output::Png(path.clone()).prepare().unwrap();
        assert!(!path.exists());
        fs::write(&path, b"kept").unwrap();
        Output::Png(path.clone()).prepare().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"kept");
    }

    #[test]
    fn folders_get_numbered_pictures_and_a_png_the_last_frame() {
        let folder = tempdir("sequence");
        for output in [Output::Folder(folder.clone()), Output::Png(folder.join("last.png"))] {
            let mut recorder = Recorder::new(output, [2, 1], 3, 30.0).unwrap();
            for frame in 0..3u8 {
                if recorder.wants_next() {
                    recorder.push(&[frame; 6]).unwrap();
                } else {
                    recorder.skip();
                }
            }
            recorder.finish().unwrap();
        }
        for frame in 0..3u8 {
            let read = png::read(&folder.join(format!("frame_{frame:05}.png"))).unwrap();
            assert_eq!(read, ([2, 1], vec![frame; 6]));
        }
        assert_eq!(png::read(&folder.join("last.png")).unwrap().1, vec![2; 6]);
    }

    /// An empty folder of its own for a test.
    pub(crate) fn tempdir(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lucerna_studio_{name}_{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }
}
