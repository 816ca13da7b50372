//! Points that the air carries, and the velocity at many points at once.

use glam::Vec3;
use rayon::prelude::*;

use crate::error::FluidError;
use crate::fluid::Fluid;
use crate::limits::MAX_DT_S;

/// Points handled together.
const LANES: usize = 8;
type Lanes = [[f32; LANES]; 3];

/// Points that a thread takes at a time, and from how many on they are shared.
const CHUNK: usize = 512;
const PARALLEL_POINTS: usize = 4 * CHUNK;

impl Fluid {
    /// Moves points with the air for `dt_s` seconds by the midpoint rule in the present field;
    /// back in time if negative. Times are clamped to ±1e3 s; one that is not a number moves
    /// nothing. Points may leave the box; they are then carried by the nearest air inside, or
    /// along periodic axes by that of the box repeated. One that is not a number stays so. Many points are shared among threads.
    pub fn advect_points(&self, points: &mut [Vec3], dt_s: f32) {
        let Some(dt_s) = within(dt_s) else { return };
        self.for_lanes(
            points,
            #[inline(always)]
            |at| {
                let middle = moved(at, self.velocities_at(at), 0.5 * dt_s);
                moved(at, self.velocities_at(middle), dt_s)
            },
        );
    }

    /// As [`Fluid::advect_points`] by the classic fourth-order rule (W. Kutta, 1901): twice the
    /// work, for points that stay on their path over many steps.
    pub fn advect_points_rk4(&self, points: &mut [Vec3], dt_s: f32) {
        let Some(dt_s) = within(dt_s) else { return };
        self.for_lanes(
            points,
            #[inline(always)]
            |at| {
                let first = self.velocities_at(at);
                let second = self.velocities_at(moved(at, first, 0.5 * dt_s));
                let third = self.velocities_at(moved(at, second, 0.5 * dt_s));
                let fourth = self.velocities_at(moved(at, third, dt_s));
                let mut sum = [[0.0; LANES]; 3];
                for axis in 0..3 {
                    for lane in 0..LANES {
                        let middle = second[axis][lane] + third[axis][lane];
                        sum[axis][lane] = (first[axis][lane] + fourth[axis][lane]) + 2.0 * middle;
                    }
                }
                moved(at, sum, dt_s / 6.0)
            },
        );
    }

    /// Velocities at points, m/s: the same as [`Fluid::velocity`] at each, but faster. Many
    /// points are shared among threads.
    ///
    /// # Errors
    /// Two slices of different lengths; nothing is written then.
    pub fn sample_velocities(&self, points: &[Vec3], velocities_m_s: &mut [Vec3]) -> Result<(), FluidError> {
        if points.len() != velocities_m_s.len() {
            let (found, expected) = (velocities_m_s.len(), points.len());
            return Err(FluidError::Length { field: "velocities_m_s", found, expected });
        }
        velocities_m_s.copy_from_slice(points);
        self.for_lanes(
            velocities_m_s,
            #[inline(always)]
            |at| self.velocities_at(at),
        );
        Ok(())
    }

    /// Replaces points by what `work` makes of them, eight at a time.
    fn for_lanes(&self, points: &mut [Vec3], work: impl Fn(Lanes) -> Lanes + Sync) {
        let chunk = |points: &mut [Vec3]| {
            self.grid.exec.simd.run(
                #[inline(always)]
                || {
                    for points in points.chunks_mut(LANES) {
                        let mut at = [[0.0; LANES]; 3];
                        for (lane, point) in points.iter().enumerate() {
                            (at[0][lane], at[1][lane], at[2][lane]) = (point.x, point.y, point.z);
                        }
                        let [x, y, z] = work(at);
                        for (lane, point) in points.iter_mut().enumerate() {
                            *point = Vec3::new(x[lane], y[lane], z[lane]);
                        }
                    }
                },
            );
        };
        if points.len() >= PARALLEL_POINTS {
            points.par_chunks_mut(CHUNK).for_each(chunk);
        } else {
            chunk(points);
        }
    }

    /// The present velocity at points in m.
    #[inline(always)]
    fn velocities_at(&self, at: Lanes) -> Lanes {
        let origin = self.grid.origin.to_array();
        let mut cells = [[0.0; LANES]; 3];
        for axis in 0..3 {
            for lane in 0..LANES {
                cells[axis][lane] = (at[axis][lane] - origin[axis]) / self.grid.cell_m[axis];
            }
        }
        let [u, v, w] = &self.state.velocity;
        let is_periodic = self.grid.periods() != [0; 3];
        [u, v, w].map(
            #[inline(always)]
            |field| {
                if is_periodic {
                    return std::array::from_fn(|lane| {
                        field.sample_in(&self.grid, [cells[0][lane], cells[1][lane], cells[2][lane]])
                    });
                }
                let mut place = cells;
                for (place, offset) in place.iter_mut().zip(field.offset) {
                    place.iter_mut().for_each(|place| *place -= offset);
                }
                field.sample_lanes(place)
            },
        )
    }
}

/// Points after moving for `dt_s`.
#[inline(always)]
fn moved(at: Lanes, velocity: Lanes, dt_s: f32) -> Lanes {
    let mut out = at;
    for axis in 0..3 {
        for lane in 0..LANES {
            out[axis][lane] += velocity[axis][lane] * dt_s;
        }
    }
    out
}

fn within(dt_s: f32) -> Option<f32> {
    (!dt_s.is_nan()).then(|| dt_s.clamp(-MAX_DT_S, MAX_DT_S))
}
