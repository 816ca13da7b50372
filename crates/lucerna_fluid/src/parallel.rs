//! Work over fixed z-planes, on one thread or many, with the same bits.

use rayon::prelude::*;

use crate::lanes::scan;
use crate::simd::{Kernel, Simd};

/// How passes over the grid are run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Execution {
    /// Whether planes are shared among threads.
    pub(crate) is_parallel: bool,
    pub(crate) simd: Simd,
}

/// What a plane contributes to the figures of a step. Planes are combined in order.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Partial {
    pub(crate) sum: f64,
    pub(crate) squares: f64,
    /// Least value, or zero.
    pub(crate) low: f32,
    /// Greatest value, or zero.
    pub(crate) high: f32,
}

impl Partial {
    /// All planes, in order.
    pub(crate) fn combine(partials: &[Self]) -> Self {
        partials.iter().fold(Self::default(), |all, one| Self {
            sum: all.sum + one.sum,
            squares: all.squares + one.squares,
            low: all.low.min(one.low),
            high: all.high.max(one.high),
        })
    }

    /// Greatest magnitude.
    pub(crate) fn greatest(&self) -> f32 {
        self.high.max(-self.low)
    }
}

/// Planes whose figures are taken together, so that small ones do not each take a call.
pub(crate) fn planes_together(plane: usize) -> usize {
    4096_usize.div_ceil(plane)
}

/// Sums and extremes of a field whose planes have `plane` values.
pub(crate) fn scan_planes(exec: Execution, values: &[f32], plane: usize, partials: &mut [Partial]) -> Partial {
    let together = plane * planes_together(plane);
    reduce(exec, &mut partials[..values.len().div_ceil(together)], |group| {
        let first = group * together;
        scan(exec.simd, &values[first..values.len().min(first + together)])
    })
}

/// Calls `work(k, plane)` for each run of `plane` values.
pub(crate) fn for_planes<T: Send>(
    exec: Execution,
    data: &mut [T],
    plane: usize,
    work: impl Fn(usize, &mut [T]) + Sync + Send,
) {
    // One closure for both, so that it is compiled once.
    let one = |(k, values): (usize, &mut [T])| {
        exec.simd.run(
            #[inline(always)]
            || work(k, values),
        );
    };
    if exec.is_parallel {
        data.par_chunks_mut(plane).enumerate().for_each(one);
    } else {
        data.chunks_mut(plane).enumerate().for_each(one);
    }
}

/// Calls `work` with each value and that of `from` in the same place, planes of `plane` values at a time.
pub(crate) fn for_pairs<T: Send, U: Sync>(
    exec: Execution,
    data: &mut [T],
    from: &[U],
    plane: usize,
    work: impl Fn(&mut T, &U) + Sync + Send,
) {
    for_planes(
        exec,
        data,
        plane,
        #[inline(always)]
        |k, out| {
            for (out, from) in out.iter_mut().zip(&from[k * plane..]) {
                work(out, from);
            }
        },
    );
}

/// As [`for_planes`]; each plane also fills its partial result. Returns their combination.
pub(crate) fn reduce_planes<T: Send>(
    exec: Execution,
    data: &mut [T],
    plane: usize,
    partials: &mut [Partial],
    work: impl Fn(usize, &mut [T]) -> Partial + Sync + Send,
) -> Partial {
    let planes = data.len() / plane;
    let one = |(k, (values, partial)): (usize, (&mut [T], &mut Partial))| {
        *partial = exec.simd.run(
            #[inline(always)]
            || work(k, values),
        );
    };
    if exec.is_parallel {
        data.par_chunks_mut(plane).zip(partials.par_iter_mut()).enumerate().for_each(one);
    } else {
        data.chunks_mut(plane).zip(partials.iter_mut()).enumerate().for_each(one);
    }
    Partial::combine(&partials[..planes])
}

/// Fills the partial result of each plane without writing to a field. Returns their
/// combination.
pub(crate) fn reduce(
    exec: Execution,
    partials: &mut [Partial],
    work: impl Fn(usize) -> Partial + Sync + Send,
) -> Partial {
    if exec.is_parallel {
        partials.par_iter_mut().enumerate().for_each(|(k, partial)| *partial = work(k));
    } else {
        partials.iter_mut().enumerate().for_each(|(k, partial)| *partial = work(k));
    }
    Partial::combine(partials)
}

/// What [`run_planes`] calls for each run of values.
pub(crate) trait PlaneKernel<T>: Sync {
    /// Mark it `#[inline(always)]`, as all that it calls.
    fn plane<S: fearless_simd::Simd>(&self, simd: S, k: usize, out: &mut [T]) -> Partial;
}

/// One plane of a kernel.
struct OnePlane<'a, T, K> {
    kernel: &'a K,
    k: usize,
    out: &'a mut [T],
}

impl<T, K: PlaneKernel<T>> Kernel for OnePlane<'_, T, K> {
    type Output = Partial;

    #[inline(always)]
    fn run<S: fearless_simd::Simd>(self, simd: S) -> Partial {
        self.kernel.plane(simd, self.k, self.out)
    }
}

/// Calls a kernel that names its vectors for each run of `plane` values; each fills its partial
/// result, too. Returns their combination.
pub(crate) fn run_planes<T: Send, K: PlaneKernel<T>>(
    exec: Execution,
    data: &mut [T],
    plane: usize,
    partials: &mut [Partial],
    kernel: &K,
) -> Partial {
    let planes = data.len() / plane;
    let one = |(k, (out, partial)): (usize, (&mut [T], &mut Partial))| {
        *partial = exec.simd.run_kernel(OnePlane { kernel, k, out });
    };
    if exec.is_parallel {
        data.par_chunks_mut(plane).zip(partials.par_iter_mut()).enumerate().for_each(one);
    } else {
        data.chunks_mut(plane).zip(partials.iter_mut()).enumerate().for_each(one);
    }
    Partial::combine(&partials[..planes])
}
