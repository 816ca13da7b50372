//! Small pictures as PNG.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use crate::Outcome;

/// RGB pixels, the first row at the top.
pub(crate) struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// Asks for the colour at each column and row.
    pub(crate) fn new(width: usize, height: usize, colour: impl Fn(usize, usize) -> [u8; 3]) -> Self {
        let pixels = (0..width * height).map(|at| colour(at % width, at / width)).collect();
        Self { width, height, pixels }
    }

    /// Pictures of one height side by side, with white between.
    pub(crate) fn beside(pictures: &[Self], gap: usize) -> Self {
        let height = pictures.iter().map(|picture| picture.height).max().unwrap_or(0);
        let width = pictures.iter().map(|picture| picture.width + gap).sum::<usize>().saturating_sub(gap);
        let mut all = Self::new(width, height, |_, _| [255; 3]);
        let mut left = 0;
        for picture in pictures {
            for (row, from) in picture.pixels.chunks_exact(picture.width).enumerate() {
                all.pixels[row * width + left..][..picture.width].copy_from_slice(from);
            }
            left += picture.width + gap;
        }
        all
    }

    pub(crate) fn write(&self, path: &Path) -> Outcome<()> {
        let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(self.pixels.as_flattened())?;
        Ok(())
    }
}

/// Blue, white, red over 0 to 1, in steps so that the file stays small.
pub(crate) fn two_colours(share: f64) -> [u8; 3] {
    let share = ((share * 40.0).round() / 40.0).clamp(0.0, 1.0);
    let (cold, hot) = ([49.0, 98.0, 176.0], [190.0, 50.0, 42.0]);
    let (end, way) = if share < 0.5 { (cold, 1.0 - 2.0 * share) } else { (hot, 2.0 * share - 1.0) };
    end.map(|value| (255.0 + way * (value - 255.0)) as u8)
}
