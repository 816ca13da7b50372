//! PNG pictures of eight bits a channel, marked as sRGB.

use anyhow::{Context, Result};
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Writes rows of red, green, blue, from the top.
pub fn write(path: &Path, size_px: [u32; 2], rgb: &[u8]) -> Result<()> {
    let what = || format!("cannot write {}", path.display());
    let file = File::create(path).with_context(what)?;
    let mut encoder = png::Encoder::new(BufWriter::new(file), size_px[0], size_px[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().with_context(what)?;
    writer.write_image_data(rgb).with_context(what)?;
    writer.finish().with_context(what)
}

/// Reads what [`write`] wrote.
#[cfg(test)]
pub(crate) fn read(path: &Path) -> Result<([u32; 2], Vec<u8>)> {
    let mut reader = png::Decoder::new(std::io::BufReader::new(File::open(path)?)).read_info()?;
    let mut rgb = vec![0; reader.output_buffer_size().context("too large")?];
    let info = reader.next_frame(&mut rgb)?;
    anyhow::ensure!(info.color_type == png::ColorType::Rgb && reader.info().srgb.is_some());
    Ok(([info.width, info.height], rgb))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_come_back_bit_for_bit() {
        let path = crate::record::tests::tempdir("png").join("a.png");
        let rgb: Vec<u8> = (0..17 * 5 * 3).map(|i| (i * 37 % 256) as u8).collect();
        write(&path, [17, 5], &rgb).unwrap();
        assert_eq!(read(&path).unwrap(), ([17, 5], rgb));
    }
}
