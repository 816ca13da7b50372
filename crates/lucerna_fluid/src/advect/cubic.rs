//! Cubic samples, which never pass the eight values around a place: third order where the field
//! is smooth (R. Bermejo and A. Staniforth, *The Conversion of Semi-Lagrangian Advection Schemes
//! to Quasi-Monotone Schemes*, Mon. Weather Rev. 120, 1992).
//!
//! To the trilinear sample is added, along each axis, what the cubic through the two values on
//! either side has more than a line: the second differences at both, weighted (Lagrange). This
//! is a product of three cubics to fourth order. The differences are taken beforehand, and then
//! sampled at the same places.

use fearless_simd::Simd;

use super::corners::corners;
use super::sample::{Lattice, Places, V, blend, bounds, least, mix, most};
use crate::parallel::{Execution, for_planes};

/// Second differences of a lattice along each axis; empty along an axis with fewer than three
/// values, on which there is only a line.
pub(super) type Bends = [Vec<f32>; 3];

/// Takes the second differences of `lattice`. At the ends of an axis the one inside stands for
/// the one that is not there, which makes the cubic there a parabola.
pub(super) fn take_bends(exec: Execution, lattice: &Lattice, bends: &mut Bends) {
    let [nx, ny, nz] = lattice.counts;
    let plane = nx * ny;
    for (axis, bends) in bends.iter_mut().enumerate() {
        let (count, step) = (lattice.counts[axis], lattice.steps[axis]);
        if count < 3 {
            bends.clear();
            continue;
        }
        bends.resize(plane * nz, 0.0);
        // Around which value, and the steps to the ones below and above. A lattice that repeats
        // itself has its first value again behind its last.
        let stencil = |at: usize| match at {
            0 if lattice.is_periodic(axis) => (0, count - 2, 1),
            last if last + 1 == count && lattice.is_periodic(axis) => (0, count - 2, 1),
            at => {
                let middle = at.clamp(1, count - 2);
                (middle, middle - 1, middle + 1)
            }
        };
        for_planes(
            exec,
            bends,
            plane,
            #[inline(always)]
            |k, out| {
                for (j, row) in out.chunks_exact_mut(nx).enumerate() {
                    let first = nx * (j + ny * k);
                    if axis == 0 {
                        let values = &lattice.data[first..first + nx];
                        for (i, three) in values.windows(3).enumerate() {
                            row[i + 1] = (three[2] - three[1]) - (three[1] - three[0]);
                        }
                        for i in [0, nx - 1] {
                            let (middle, below, above) = stencil(i);
                            row[i] = (values[above] - values[middle]) - (values[middle] - values[below]);
                        }
                    } else {
                        let at = [0, j, k][axis];
                        let (middle, below, above) = stencil(at);
                        let line = |at_axis: usize| &lattice.data[first - at * step + at_axis * step..][..nx];
                        let values = line(below).iter().zip(line(middle)).zip(line(above));
                        for (out, ((below, middle), above)) in row.iter_mut().zip(values) {
                            *out = (above - middle) - (middle - below);
                        }
                    }
                }
            },
        );
    }
}

/// Samples at sixteen places of `lattice`, whose second differences are `bends`.
#[inline(always)]
pub(super) fn sample<S: Simd>(
    simd: S,
    lattice: &Lattice,
    bends: &[Lattice; 3],
    places: &Places<S>,
    active: u64,
) -> V<S> {
    let values = corners(simd, lattice, places, active);
    let mut value = blend(values, places);
    for axis in 0..3 {
        if !bends[axis].data.is_empty() {
            let [first, second] = [[1, 2], [0, 2], [0, 1]][axis];
            let bends = corners(simd, &bends[axis], places, active);
            let share = places.shares[axis];
            let mut ends = [share; 2];
            for (end, bend) in ends.iter_mut().enumerate() {
                // The four at this end of the cell along the axis.
                let at = |a: usize, b: usize| bends[end << axis | a << first | b << second];
                let near = mix(at(0, 0), at(1, 0), places.shares[first]);
                let far = mix(at(0, 1), at(1, 1), places.shares[first]);
                *bend = mix(near, far, places.shares[second]);
            }
            let [low, high] = ends;
            value += (low * (2.0 - share) + high * (share + 1.0)) * (share * (share - 1.0)) * (1.0 / 6.0);
        }
    }
    let (lowest, highest) = bounds(&values);
    most(least(value, highest), lowest)
}
