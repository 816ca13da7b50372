//! Pictures of the fire and of the whole window.

use crate::record::png;
use anyhow::{Result, bail};
use egui::{ColorImage, Context, ScreenshotCallback, ViewportCommand};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The first `lucerna-NNN.png` of a folder that is not taken yet.
pub(super) fn free_name(folder: &Path) -> Result<PathBuf> {
    for number in 1..1000 {
        let path = folder.join(format!("lucerna-{number:03}.png"));
        if !path.exists() {
            return Ok(path);
        }
    }
    bail!("lucerna-001.png to lucerna-999.png are all taken")
}

/// A picture of the whole window that was asked for and arrives a frame later.
#[derive(Debug, Default)]
pub(super) struct WindowCapture {
    asked: bool,
    arrived: Arc<Mutex<Option<Arc<ColorImage>>>>,
}

impl WindowCapture {
    /// Asks for the picture, once.
    pub(super) fn ask(&mut self, context: &Context) {
        if std::mem::replace(&mut self.asked, true) {
            return;
        }
        let (arrived, repaint) = (Arc::clone(&self.arrived), context.clone());
        context.send_viewport_cmd(ViewportCommand::Screenshot(ScreenshotCallback::new(move |image| {
            *arrived.lock().unwrap_or_else(PoisonError::into_inner) = Some(image);
            repaint.request_repaint();
        })));
    }

    /// Writes the picture where it has arrived, and says whether it has.
    pub(super) fn write(&self, path: &Path) -> Result<bool> {
        let Some(image) = self.arrived.lock().unwrap_or_else(PoisonError::into_inner).take() else {
            return Ok(false);
        };
        let rgb: Vec<u8> = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
        png::write(path, image.size.map(|side| side as u32), &rgb)?;
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_never_overwrite_one_another() {
        let folder = std::env::temp_dir().join(format!("lucerna_studio_capture_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let first = free_name(&folder).unwrap();
        std::fs::write(&first, b"").unwrap();
        assert_ne!(free_name(&folder).unwrap(), first);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
