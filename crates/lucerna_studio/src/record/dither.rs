//! Ordered dithering between the two palette colours that mix best.
//!
//! The pattern is fixed to the pixels, so that what does not change stays the same from frame to frame.

use super::palette::{Rgb, distance, nearest};

/// Thresholds of an 8x8 Bayer matrix, 0 to 63.
const BAYER: [[u8; 8]; 8] = [
    [0, 32, 8, 40, 2, 34, 10, 42],
    [48, 16, 56, 24, 50, 18, 58, 26],
    [12, 44, 4, 36, 14, 46, 6, 38],
    [60, 28, 52, 20, 62, 30, 54, 22],
    [3, 35, 11, 43, 1, 33, 9, 41],
    [51, 19, 59, 27, 49, 17, 57, 25],
    [15, 47, 7, 39, 13, 45, 5, 37],
    [63, 31, 55, 23, 61, 29, 53, 21],
];

/// Turns colours into palette indices.
#[derive(Debug)]
pub struct Dither {
    palette: Vec<Rgb>,
    /// For every 24-bit colour: 0 not yet known, else 1 << 24 | share << 16 | second << 8 | first.
    known: Vec<u32>,
}

impl Dither {
    /// For a palette of 1 to 256 colours.
    #[must_use]
    pub fn new(palette: &[[u8; 3]]) -> Self {
        Self { palette: palette.iter().map(|color| color.map(f32::from)).collect(), known: vec![0; 1 << 24] }
    }

    /// The palette index of a colour at a pixel.
    pub fn index(&mut self, color: [u8; 3], x: usize, y: usize) -> u8 {
        let key = color.iter().fold(0, |key, &value| key << 8 | usize::from(value));
        if self.known[key] == 0 {
            self.known[key] = self.mix(color.map(f32::from));
        }
        let [first, second, share, _] = self.known[key].to_le_bytes();
        if BAYER[y % 8][x % 8] < share { second } else { first }
    }

    /// The nearest colour, the one that best makes up for its error, and the share of the latter in 1/64.
    fn mix(&self, color: Rgb) -> u32 {
        let first = nearest(&self.palette, color);
        let near = self.palette[first];
        let (mut best, mut second, mut share) = (distance(near, color), first, 0.0f32);
        for (index, &other) in self.palette.iter().enumerate() {
            let along: f32 = distance(near, other);
            // Far apart, two colours make a coarse pattern.
            if along <= 0.0 || along > MOST_CONTRAST {
                continue;
            }
            let t = ((distance(near, color) + along - distance(other, color)) / (2.0 * along)).clamp(0.0, 0.5);
            let mixed = [0, 1, 2].map(|c| near[c] + t * (other[c] - near[c]));
            let error = distance(mixed, color) + PATTERN_COST * t * (1.0 - t) * along;
            if error < best {
                (best, second, share) = (error, index, t);
            }
        }
        let share = (share * 64.0).round() as u8;
        u32::from_le_bytes([first as u8, second as u8, share, 1])
    }
}

/// Largest squared distance of two colours that are mixed.
const MOST_CONTRAST: f32 = 40.0 * 40.0;
/// How much a visible pattern is minded compared with a wrong colour.
const PATTERN_COST: f32 = 0.1;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bayer_has_every_threshold_once() {
        let mut all: Vec<u8> = BAYER.iter().flatten().copied().collect();
        all.sort_unstable();
        assert_eq!(all, (0..64).collect::<Vec<u8>>());
    }

    #[test]
    fn palette_colors_are_exact_and_mixtures_right_on_average() {
        let palette = [[0, 0, 0], [8, 4, 0], [16, 8, 0]];
        let mut dither = Dither::new(&palette);
        for (index, color) in palette.iter().enumerate() {
            assert!((0..64).all(|i| usize::from(dither.index(*color, i % 8, i / 8)) == index));
        }
        let mean: f32 =
            (0..64).map(|i| f32::from(palette[usize::from(dither.index([2, 1, 0], i % 8, i / 8))][0])).sum();
        assert!((mean / 64.0 - 2.0).abs() < 0.2);
    }

    #[test]
    fn one_color_takes_everything() {
        assert_eq!(Dither::new(&[[7, 7, 7]]).index([255, 0, 0], 3, 5), 0);
    }
}
