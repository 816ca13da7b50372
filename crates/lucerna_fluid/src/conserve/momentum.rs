//! Transport of momentum by the fluxes of mass, and what pushes it meanwhile.

use super::padded::Shape;
use crate::grid::Grid;
use crate::limits::GRAVITY_M_S2;
use crate::parallel::for_planes;

/// A step of Euler's for the velocity. All but `push` is padded.
pub(super) struct Transport<'a> {
    pub(super) grid: &'a Grid,
    pub(super) shape: Shape,
    pub(super) velocity: &'a [Vec<f32>; 3],
    /// Mass fluxes over ambient density.
    pub(super) mass: &'a [Vec<f32>; 3],
    /// `1 - rho / rho_a` at the end.
    pub(super) share: &'a [f32],
    /// Pressure over ambient density, and its weight in the coming solve: the part beyond that
    /// acts here.
    pub(super) pressure: &'a [f32],
    pub(super) weight: f32,
    /// Added to the velocity; not padded.
    pub(super) push: Option<[&'a [f32]; 3]>,
    /// Whether light air is lifted.
    pub(super) lifts: bool,
    pub(super) dt_s: f32,
}

impl Transport<'_> {
    /// Fills `out` with the component across `axis` after the step: `u - dt (div (m u) - u div m) / rho`,
    /// which is `rho u` less what leaves of it wherever mass is conserved.
    pub(super) fn run(&self, axis: usize, out: &mut [f32]) {
        let Self { grid, shape, mass, share, pressure, weight, dt_s, .. } = *self;
        let (values, push) = (self.velocity[axis].as_slice(), self.push.map(|push| push[axis]));
        let [nx, ny, _] = grid.face_counts(axis);
        let own = shape.strides[axis];
        let per_m = grid.cell_m.map(|edge| 0.25 * dt_s / edge);
        let press = dt_s / grid.cell_m[axis];
        let lift = if self.lifts && axis == 1 { dt_s * GRAVITY_M_S2 } else { 0.0 };
        for_planes(
            grid.exec,
            out,
            nx * ny,
            #[inline(always)]
            |k, out| {
                for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                    let at = shape.at([0, j, k]);
                    let here = &values[at..at + nx];
                    out.fill(0.0);
                    for along in 0..3 {
                        let stride = shape.strides[along];
                        let flux = &mass[along];
                        let below = &values[at - stride..at - stride + nx];
                        let above = &values[at + stride..at + stride + nx];
                        // The fluxes at the two ends of a face's volume are means of two.
                        let (a, b, c, d) = if along == axis {
                            (at - own, at, at, at + own)
                        } else {
                            (at - own, at, at + stride - own, at + stride)
                        };
                        let (a, b) = (&flux[a..a + nx], &flux[b..b + nx]);
                        let (c, d) = (&flux[c..c + nx], &flux[d..d + nx]);
                        let by = per_m[along];
                        for i in 0..nx {
                            let (low, high) = (a[i] + b[i], c[i] + d[i]);
                            out[i] += by * (high * (above[i] - here[i]) + low * (here[i] - below[i]));
                        }
                    }
                    let (share_low, share_high) = (&share[at - own..at - own + nx], &share[at..at + nx]);
                    let (low, high) = (&pressure[at - own..at - own + nx], &pressure[at..at + nx]);
                    for i in 0..nx {
                        let light = 1.0 / (1.0 - 0.5 * (share_low[i] + share_high[i]));
                        let pushed = (weight - light) * press * (high[i] - low[i]) + lift * (light - 1.0);
                        out[i] = here[i] + (pushed - out[i] * light);
                    }
                    if let Some(push) = push {
                        for (out, push) in out.iter_mut().zip(&push[nx * (j + ny * k)..]) {
                            *out += push;
                        }
                    }
                }
            },
        );
    }
}
