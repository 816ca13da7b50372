//! What a projection measures before and after: divergence and speeds, in one pass.

use rayon::prelude::*;

use super::operators::divergence_plane;
use crate::grid::Grid;
use crate::simd::Simd;

/// Sums kept in `f32` before they go into an `f64`.
const SUMMED: usize = 512;
const LANES: usize = 8;

/// Figures of a z-plane, or of the whole grid.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Figures {
    /// Of the divergence: sum, sum of squares, least and greatest value (or zero).
    pub(crate) sum: f64,
    pub(crate) squares: f64,
    pub(crate) low: f32,
    pub(crate) high: f32,
    /// Of the velocity through the faces across each axis: sum of squares, and greatest size.
    pub(crate) speed_squares: [f64; 3],
    pub(crate) speeds: [f32; 3],
}

impl Figures {
    /// All planes, in order.
    fn combine(planes: &[Self]) -> Self {
        planes.iter().fold(Self::default(), |all, one| Self {
            sum: all.sum + one.sum,
            squares: all.squares + one.squares,
            low: all.low.min(one.low),
            high: all.high.max(one.high),
            speed_squares: [0, 1, 2].map(|axis| all.speed_squares[axis] + one.speed_squares[axis]),
            speeds: [0, 1, 2].map(|axis| all.speeds[axis].max(one.speeds[axis])),
        })
    }

    /// Greatest size of the divergence.
    pub(crate) fn greatest(&self) -> f32 {
        self.high.max(-self.low)
    }

    /// Root of the sum over the axes of the mean square velocity through their faces.
    pub(crate) fn rms_speed(&self, grid: &Grid) -> f64 {
        let mean = |axis: usize| self.speed_squares[axis] / grid.face_counts(axis).iter().product::<usize>() as f64;
        (mean(0) + mean(1) + mean(2)).sqrt()
    }
}

/// Fills `divergence` with `div velocity - expansion - mean`, and measures it and the velocity.
pub(crate) fn measure(
    grid: &Grid,
    velocity: [&[f32]; 3],
    expansion: Option<&[f32]>,
    mean: f64,
    divergence: &mut [f32],
    figures: &mut [Figures],
) -> Figures {
    let [nx, ny, nz] = grid.cells;
    let plane = grid.plane();
    let [u, v, w] = velocity;
    // In two parts, and first of all to what expands: the rest of great values that nearly cancel is exact.
    let high = mean as f32;
    let low = (mean - f64::from(high)) as f32;
    for_planes_and_figures(
        grid,
        divergence,
        figures,
        #[inline(always)]
        |k, out, figures| {
            divergence_plane(grid, velocity, k, out);
            if let Some(expansion) = expansion {
                let rates = &expansion[k * plane..(k + 1) * plane];
                out.iter_mut().zip(rates).for_each(|(value, rate)| *value -= (rate + high) + low);
            } else if mean != 0.0 {
                out.iter_mut().for_each(|value| *value = (*value - high) - low);
            }
            let of_divergence = scan(out);
            let w_end = if k + 1 == nz { k + 2 } else { k + 1 };
            let of_velocity = [
                scan(&u[k * (nx + 1) * ny..(k + 1) * (nx + 1) * ny]),
                scan(&v[k * nx * (ny + 1)..(k + 1) * nx * (ny + 1)]),
                scan(&w[k * plane..w_end * plane]),
            ];
            *figures = Figures {
                speed_squares: of_velocity.map(|scan| scan.squares),
                speeds: of_velocity.map(|scan| scan.high.max(-scan.low)),
                ..of_divergence
            };
        },
    );
    Figures::combine(&figures[..nz])
}

/// Measures a divergence that is already there. The speeds are left at zero.
pub(crate) fn measure_divergence(grid: &Grid, divergence: &mut [f32], figures: &mut [Figures]) -> Figures {
    for_planes_and_figures(
        grid,
        divergence,
        figures,
        #[inline(always)]
        |_, values, figures| *figures = scan(values),
    );
    Figures::combine(&figures[..grid.cells[2]])
}

/// Calls `work(k, plane, result)` for each z-plane of cells.
pub(crate) fn for_planes_and_figures<T: Send>(
    grid: &Grid,
    values: &mut [f32],
    results: &mut [T],
    work: impl Fn(usize, &mut [f32], &mut T) + Sync + Send,
) {
    let plane = grid.plane();
    let simd: Simd = grid.exec.simd;
    if grid.exec.is_parallel {
        let planes = values.par_chunks_mut(plane).zip(results.par_iter_mut()).enumerate();
        planes.for_each(|(k, (values, result))| {
            simd.run(
                #[inline(always)]
                || work(k, values, result),
            );
        });
    } else {
        for (k, (values, result)) in values.chunks_mut(plane).zip(results).enumerate() {
            simd.run(
                #[inline(always)]
                || work(k, values, result),
            );
        }
    }
}

/// Sum, sum of squares and extremes.
#[inline(always)]
fn scan(values: &[f32]) -> Figures {
    let mut all = Figures::default();
    for values in values.chunks(SUMMED) {
        let (mut sums, mut squares) = ([0.0_f32; LANES], [0.0_f32; LANES]);
        let (mut low, mut high) = ([0.0_f32; LANES], [0.0_f32; LANES]);
        let (chunks, rest) = values.as_chunks::<LANES>();
        for chunk in chunks {
            for lane in 0..LANES {
                sums[lane] += chunk[lane];
            }
            for lane in 0..LANES {
                squares[lane] += chunk[lane] * chunk[lane];
            }
            for lane in 0..LANES {
                low[lane] = if chunk[lane] < low[lane] { chunk[lane] } else { low[lane] };
            }
            for lane in 0..LANES {
                high[lane] = if chunk[lane] > high[lane] { chunk[lane] } else { high[lane] };
            }
        }
        for (lane, value) in rest.iter().enumerate() {
            sums[lane] += value;
            squares[lane] += value * value;
            low[lane] = low[lane].min(*value);
            high[lane] = high[lane].max(*value);
        }
        for lane in 0..LANES {
            all.sum += f64::from(sums[lane]);
            all.squares += f64::from(squares[lane]);
            all.low = all.low.min(low[lane]);
            all.high = all.high.max(high[lane]);
        }
    }
    all
}
