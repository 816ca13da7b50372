//! Animated GIFs of fire that stay small.
//!
//! One palette serves all frames. Each frame stores the rectangle that changed; inside it, pixels whose colour moved
//! by no more than a tolerance since they were last written stay as they are. The tolerance is the smallest that keeps
//! the file below a size for its length.

use super::{GIF_MAX_FPS, dither::Dither, palette::Histogram};
use anyhow::{Context, Result, bail};
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Frames held back to choose palette and tolerance from, in bytes.
const HELD_BYTES: usize = 256 << 20;
/// Bytes a frame of 640x480 may have on average; larger pictures in proportion.
const GOAL_BYTES: f64 = 13_500.0;
/// Tolerances that are tried, in 1/255.
const TOLERANCES: [u8; 8] = [0, 2, 3, 4, 6, 8, 11, 15];
/// Colours of the palette; one index is left for "unchanged".
const COLORS: usize = 255;

/// Collects frames, then writes them.
#[derive(Debug)]
pub struct GifRecorder {
    path: PathBuf,
    size_px: [u16; 2],
    fps: f64,
    held: Vec<Vec<u8>>,
    stream: Option<Stream<BufWriter<File>>>,
}

impl GifRecorder {
    /// Begins a recording.
    pub fn new(path: &Path, size_px: [u32; 2], fps: f64) -> Result<Self> {
        if fps > GIF_MAX_FPS {
            bail!("a GIF has at most {GIF_MAX_FPS} frames per second, not {fps}");
        }
        let [width, height] = size_px.map(u16::try_from);
        let size_px = [width.context("a GIF is at most 65535 pixels wide")?, height.context("a GIF is too high")?];
        Ok(Self { path: path.into(), size_px, fps, held: Vec::new(), stream: None })
    }

    /// Takes a frame: rows of red, green, blue, from the top.
    pub fn push(&mut self, rgb: &[u8]) -> Result<()> {
        if let Some(stream) = &mut self.stream {
            return stream.write(rgb).with_context(|| format!("cannot write {}", self.path.display()));
        }
        self.held.push(rgb.to_vec());
        if self.held.iter().map(Vec::len).sum::<usize>() > HELD_BYTES { self.start() } else { Ok(()) }
    }

    /// Writes what is held back and ends the file.
    pub fn finish(mut self) -> Result<()> {
        if self.stream.is_none() {
            self.start()?;
        }
        if let Some(stream) = self.stream {
            stream.finish().with_context(|| format!("cannot write {}", self.path.display()))?;
        }
        Ok(())
    }

    /// Chooses palette and tolerance and writes the frames held so far.
    fn start(&mut self) -> Result<()> {
        let mut histogram = Histogram::new();
        let stride = (self.held.len() / 16).clamp(1, 31) | 1;
        for frame in &self.held {
            histogram.add(frame, stride);
        }
        let palette = histogram.palette(COLORS);
        let area = f64::from(self.size_px[0]) * f64::from(self.size_px[1]) / (640.0 * 480.0);
        let goal = GOAL_BYTES * area.max(1.0) * self.held.len() as f64;
        let mut tolerance = TOLERANCES[0];
        for candidate in TOLERANCES {
            tolerance = candidate;
            let mut stream = Stream::new(Counter(0), self.size_px, self.fps, &palette, tolerance)?;
            if self.held.iter().try_for_each(|frame| stream.write(frame)).is_ok() && stream.finish()?.0 as f64 <= goal {
                break;
            }
        }
        let what = || format!("cannot write {}", self.path.display());
        let file = BufWriter::new(File::create(&self.path).with_context(what)?);
        let mut stream = Stream::new(file, self.size_px, self.fps, &palette, tolerance).with_context(what)?;
        for frame in std::mem::take(&mut self.held) {
            stream.write(&frame).with_context(what)?;
        }
        self.stream = Some(stream);
        Ok(())
    }
}

/// Counts bytes instead of keeping them.
#[derive(Debug)]
struct Counter(u64);

impl Write for Counter {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0 += bytes.len() as u64;
        Ok(bytes.len())
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Encodes frames one after the other.
struct Stream<W: Write> {
    encoder: Encoder<W>,
    dither: Dither,
    size_px: [u16; 2],
    fps: f64,
    tolerance: u8,
    unchanged: u8,
    written: u32,
    /// The colour that each pixel had when it was last written.
    shown: Vec<u8>,
    indices: Vec<u8>,
}

impl<W: Write> std::fmt::Debug for Stream<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stream").field("size_px", &self.size_px).field("tolerance", &self.tolerance).finish()
    }
}

impl<W: Write> Stream<W> {
    fn new(to: W, size_px: [u16; 2], fps: f64, palette: &[[u8; 3]], tolerance: u8) -> Result<Self> {
        let mut table: Vec<u8> = palette.iter().flatten().copied().collect();
        table.extend([0; 3]);
        let mut encoder = Encoder::new(to, size_px[0], size_px[1], &table)?;
        encoder.set_repeat(Repeat::Infinite)?;
        Ok(Self {
            encoder,
            dither: Dither::new(palette),
            size_px,
            fps,
            tolerance,
            unchanged: palette.len() as u8,
            written: 0,
            shown: Vec::new(),
            indices: Vec::new(),
        })
    }

    /// Time of a frame's beginning in hundredths of a second.
    fn time(&self, frame: u32) -> u64 {
        (100.0 * f64::from(frame) / self.fps).round() as u64
    }

    fn write(&mut self, rgb: &[u8]) -> Result<()> {
        let width = usize::from(self.size_px[0]);
        let first = self.shown.is_empty();
        if first {
            self.shown = rgb.to_vec();
        }
        self.indices.clear();
        self.indices.resize(rgb.len() / 3, self.unchanged);
        let mut bounds = Bounds::default();
        let (shown, _) = self.shown.as_chunks_mut::<3>();
        for (at, (pixel, shown)) in rgb.as_chunks::<3>().0.iter().zip(shown).enumerate() {
            let moved = pixel.iter().zip(shown.iter()).any(|(a, b)| a.abs_diff(*b) > self.tolerance);
            if first || moved {
                let (x, y) = (at % width, at / width);
                self.indices[at] = self.dither.index(*pixel, x, y);
                *shown = *pixel;
                bounds.add(x, y);
            }
        }
        self.write_rectangle(&bounds.or_one_pixel())?;
        self.written += 1;
        Ok(())
    }

    fn write_rectangle(&mut self, bounds: &Bounds) -> Result<()> {
        let width = usize::from(self.size_px[0]);
        let rows = self.indices.chunks_exact(width).skip(bounds.y0).take(bounds.y1 - bounds.y0 + 1);
        let buffer: Vec<u8> = rows.flat_map(|row| &row[bounds.x0..=bounds.x1]).copied().collect();
        let delay = self.time(self.written + 1) - self.time(self.written);
        self.encoder.write_frame(&Frame {
            delay: u16::try_from(delay).unwrap_or(u16::MAX),
            dispose: DisposalMethod::Keep,
            transparent: Some(self.unchanged),
            left: bounds.x0 as u16,
            top: bounds.y0 as u16,
            width: (bounds.x1 - bounds.x0 + 1) as u16,
            height: (bounds.y1 - bounds.y0 + 1) as u16,
            buffer: buffer.into(),
            ..Frame::default()
        })?;
        Ok(())
    }

    fn finish(self) -> Result<W> {
        let mut to = self.encoder.into_inner()?;
        to.flush()?;
        Ok(to)
    }
}

/// The rectangle of the pixels that changed.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    x0: usize,
    y0: usize,
    x1: usize,
    y1: usize,
}

impl Default for Bounds {
    fn default() -> Self {
        Self { x0: usize::MAX, y0: usize::MAX, x1: 0, y1: 0 }
    }
}

impl Bounds {
    fn add(&mut self, x: usize, y: usize) {
        self.x0 = self.x0.min(x);
        self.x1 = self.x1.max(x);
        self.y0 = self.y0.min(y);
        self.y1 = self.y1.max(y);
    }

    /// A frame has at least one pixel, if an unchanged one.
    fn or_one_pixel(self) -> Self {
        if self.x0 > self.x1 { Self { x0: 0, y0: 0, x1: 0, y1: 0 } } else { self }
    }
}
