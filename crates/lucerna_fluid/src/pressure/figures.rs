//! What a projection measures before and after: divergence and speeds, in one pass.

use fearless_simd::Simd;
use rayon::prelude::*;

use super::operators::divergence_plane;
use crate::grid::Grid;
use crate::lanes::scan_with;
use crate::parallel::{Partial, planes_together};
use crate::simd::Kernel;

/// Figures of some z-planes, or of the whole grid.
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
    /// All groups of planes, in order.
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
    measure_with(&Pass { grid, velocity: Some(velocity), expansion, mean }, divergence, figures)
}

/// Measures a divergence that is already there. The speeds are left at zero.
pub(crate) fn measure_divergence(grid: &Grid, divergence: &mut [f32], figures: &mut [Figures]) -> Figures {
    measure_with(&Pass { grid, velocity: None, expansion: None, mean: 0.0 }, divergence, figures)
}

fn measure_with(pass: &Pass<'_>, divergence: &mut [f32], figures: &mut [Figures]) -> Figures {
    let Grid { exec, cells, .. } = *pass.grid;
    let plane = pass.grid.plane();
    let together = planes_together(plane);
    let figures = &mut figures[..cells[2].div_ceil(together)];
    each_run(exec.is_parallel, divergence, together * plane, figures, |group, out, figures| {
        *figures = exec.simd.run_kernel(Planes { pass, first: group * together, out });
    });
    Figures::combine(figures)
}

/// What is measured.
struct Pass<'a> {
    grid: &'a Grid,
    /// None if the divergence is there.
    velocity: Option<[&'a [f32]; 3]>,
    expansion: Option<&'a [f32]>,
    mean: f64,
}

/// Some z-planes of cells, and the faces of all axes that have their numbers; with the last one
/// those behind it, too.
struct Planes<'a> {
    pass: &'a Pass<'a>,
    first: usize,
    out: &'a mut [f32],
}

impl Kernel for Planes<'_> {
    type Output = Figures;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Figures {
        let Self { pass: Pass { grid, velocity, expansion, mean }, first, out } = self;
        let [nx, ny, nz] = grid.cells;
        let plane = grid.plane();
        let mut slices: [&[f32]; 4] = [&[]; 4];
        if let Some(velocity) = velocity {
            for (k, out) in out.chunks_exact_mut(plane).enumerate() {
                divergence_plane(grid, *velocity, first + k, out);
            }
            // In two parts, and first of all to what expands: the rest of great values that nearly cancel is exact.
            let high = *mean as f32;
            let low = (mean - f64::from(high)) as f32;
            if let Some(expansion) = expansion {
                let rates = &expansion[first * plane..];
                out.iter_mut().zip(rates).for_each(|(value, rate)| *value -= (rate + high) + low);
            } else if *mean != 0.0 {
                out.iter_mut().for_each(|value| *value = (*value - high) - low);
            }
            let last = first + out.len() / plane;
            let w_last = if last == nz { last + 1 } else { last };
            let [u, v, w] = velocity;
            slices[1] = &u[first * (nx + 1) * ny..last * (nx + 1) * ny];
            slices[2] = &v[first * nx * (ny + 1)..last * nx * (ny + 1)];
            slices[3] = &w[first * plane..w_last * plane];
        }
        slices[0] = out;
        // A loop, so that the code is there once.
        let mut scans = [Partial::default(); 4];
        for (scan, slice) in scans.iter_mut().zip(slices) {
            *scan = scan_with(simd, slice);
        }
        let [divergence, u, v, w] = scans;
        Figures {
            sum: divergence.sum,
            squares: divergence.squares,
            low: divergence.low,
            high: divergence.high,
            speed_squares: [u.squares, v.squares, w.squares],
            speeds: [u.greatest(), v.greatest(), w.greatest()],
        }
    }
}

/// Calls `work(index, run, result)` for each run of `count` values.
fn each_run<T: Send>(
    is_parallel: bool,
    values: &mut [f32],
    count: usize,
    results: &mut [T],
    work: impl Fn(usize, &mut [f32], &mut T) + Sync + Send,
) {
    // One closure for both, so that it is compiled once.
    let one = |(index, (values, result)): (usize, (&mut [f32], &mut T))| work(index, values, result);
    if is_parallel {
        values.par_chunks_mut(count).zip(results.par_iter_mut()).enumerate().for_each(one);
    } else {
        values.chunks_mut(count).zip(results).enumerate().for_each(one);
    }
}

/// Calls `work(k, plane, result)` for each z-plane of cells.
pub(crate) fn for_planes_and_figures<T: Send>(
    grid: &Grid,
    values: &mut [f32],
    results: &mut [T],
    work: impl Fn(usize, &mut [f32], &mut T) + Sync + Send,
) {
    each_run(grid.exec.is_parallel, values, grid.plane(), results, |k, values, result| {
        grid.exec.simd.run(
            #[inline(always)]
            || work(k, values, result),
        );
    });
}
