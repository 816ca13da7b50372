//! A palette for many frames: variance-based splitting, then k-means.

/// A colour as display-referred numbers, 0 to 255.
pub type Rgb = [f32; 3];

/// How much the eye minds an error in red, green and blue.
const CHANNEL_WEIGHTS: Rgb = [2.0, 4.0, 1.5];
/// Rounds of k-means.
const ROUNDS: usize = 6;
/// How strongly common colours win: 1 by area, 0 each colour once.
const AREA_EXPONENT: f32 = 0.6;

/// Squared distance as the eye minds it.
#[must_use]
pub fn distance(a: Rgb, b: Rgb) -> f32 {
    (0..3).map(|c| CHANNEL_WEIGHTS[c] * (a[c] - b[c]) * (a[c] - b[c])).sum()
}

/// Counts colours, seven bits a channel and the exact mean inside each cell.
#[derive(Debug)]
pub struct Histogram {
    cells: std::collections::BTreeMap<u32, ([u64; 3], u64)>,
}

impl Default for Histogram {
    fn default() -> Self {
        Self::new()
    }
}

impl Histogram {
    /// An empty one.
    #[must_use]
    pub fn new() -> Self {
        Self { cells: std::collections::BTreeMap::new() }
    }

    /// Counts pixels in rows of red, green, blue; every `stride`-th is enough.
    pub fn add(&mut self, rgb: &[u8], stride: usize) {
        let (pixels, _) = rgb.as_chunks::<3>();
        for pixel in pixels.iter().step_by(stride.max(1)) {
            let key = pixel.iter().fold(0, |key, &value| key << 7 | u32::from(value >> 1));
            let (sum, count) = self.cells.entry(key).or_default();
            for (sum, &value) in sum.iter_mut().zip(pixel) {
                *sum += u64::from(value);
            }
            *count += 1;
        }
    }

    /// At most `colors` colours that stand for what was counted, darkest first; at least one.
    #[must_use]
    pub fn palette(&self, colors: usize) -> Vec<[u8; 3]> {
        let mut points: Vec<Point> = self
            .cells
            .values()
            .map(|(sum, count)| Point {
                color: sum.map(|sum| sum as f32 / *count as f32),
                weight: (*count as f32).powf(AREA_EXPONENT),
            })
            .collect();
        if points.is_empty() {
            return vec![[0; 3]];
        }
        let mut centers = split(&mut points, colors.max(1));
        refine(&points, &mut centers);
        let mut palette: Vec<[u8; 3]> = centers.iter().map(|center| center.map(|value| value.round() as u8)).collect();
        palette.sort_by_key(|color| color.iter().map(|&value| u32::from(value)).sum::<u32>());
        palette.dedup();
        palette
    }
}

#[derive(Clone, Copy, Debug)]
struct Point {
    color: Rgb,
    weight: f32,
}

/// A range of points and how far they lie from their mean.
struct Group {
    range: std::ops::Range<usize>,
    mean: Rgb,
    axis: usize,
    error: f32,
}

impl Group {
    fn new(points: &[Point], range: std::ops::Range<usize>) -> Self {
        let inside = &points[range.clone()];
        let weight: f32 = inside.iter().map(|point| point.weight).sum();
        let mean = [0, 1, 2].map(|c| inside.iter().map(|p| p.weight * p.color[c]).sum::<f32>() / weight);
        let spread = [0, 1, 2].map(|c| {
            CHANNEL_WEIGHTS[c] * inside.iter().map(|p| p.weight * (p.color[c] - mean[c]).powi(2)).sum::<f32>()
        });
        let axis = (0..3).max_by(|&a, &b| spread[a].total_cmp(&spread[b])).unwrap_or_default();
        let error = if inside.len() > 1 { spread.iter().sum() } else { 0.0 };
        Self { range, mean, axis, error }
    }
}

/// Splits the group of the largest error at its mean until there are enough.
fn split(points: &mut [Point], colors: usize) -> Vec<Rgb> {
    let mut groups = vec![Group::new(points, 0..points.len())];
    while groups.len() < colors {
        let worst = (0..groups.len()).max_by(|&a, &b| groups[a].error.total_cmp(&groups[b].error)).unwrap_or_default();
        if groups[worst].error <= 0.0 {
            break;
        }
        let Group { range, mean, axis, .. } = groups.swap_remove(worst);
        let inside = &mut points[range.clone()];
        inside.sort_by(|a, b| a.color[axis].total_cmp(&b.color[axis]));
        let below = inside.partition_point(|point| point.color[axis] < mean[axis]).clamp(1, inside.len() - 1);
        let middle = range.start + below;
        groups.push(Group::new(points, range.start..middle));
        groups.push(Group::new(points, middle..range.end));
    }
    groups.iter().map(|group| group.mean).collect()
}

/// Moves every centre to the mean of the points nearest to it, a few times.
fn refine(points: &[Point], centers: &mut [Rgb]) {
    for _ in 0..ROUNDS {
        let mut sums = vec![([0.0f32; 3], 0.0f32); centers.len()];
        for point in points {
            let (sum, weight) = &mut sums[nearest(centers, point.color)];
            for (sum, value) in sum.iter_mut().zip(point.color) {
                *sum += point.weight * value;
            }
            *weight += point.weight;
        }
        for (center, (sum, weight)) in centers.iter_mut().zip(sums) {
            if weight > 0.0 {
                *center = sum.map(|sum| sum / weight);
            }
        }
    }
}

/// Index of the nearest colour.
#[must_use]
pub fn nearest(colors: &[Rgb], color: Rgb) -> usize {
    let mut best = (f32::INFINITY, 0);
    for (index, candidate) in colors.iter().enumerate() {
        let d = distance(*candidate, color);
        if d < best.0 {
            best = (d, index);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colors_are_kept_exactly() {
        let mut histogram = Histogram::new();
        histogram.add(&[0, 0, 0, 255, 128, 0, 255, 128, 0, 9, 9, 10], 1);
        assert_eq!(histogram.palette(255), vec![[0, 0, 0], [9, 9, 10], [255, 128, 0]]);
    }

    #[test]
    fn many_colors_are_covered_evenly() {
        let mut histogram = Histogram::new();
        let ramp: Vec<u8> = (0..=255u8).flat_map(|v| [v, v / 2, v / 8]).collect();
        histogram.add(&ramp, 1);
        let palette = histogram.palette(32);
        assert!(palette.len() <= 32);
        let centers: Vec<Rgb> = palette.iter().map(|color| color.map(f32::from)).collect();
        for pixel in ramp.as_chunks::<3>().0 {
            let color = pixel.map(f32::from);
            assert!(distance(centers[nearest(&centers, color)], color).sqrt() < 15.0);
        }
    }

    #[test]
    fn nothing_counted_is_black() {
        assert_eq!(Histogram::new().palette(16), vec![[0; 3]]);
    }
}
