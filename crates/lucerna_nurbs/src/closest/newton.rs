//! Newton's method for the closest point (The NURBS Book, section 6.1), kept from going astray.

use super::length;
use crate::NurbsError;

/// Point and derivatives along u, v, uu, uv, vv.
pub(super) type Jet<const D: usize> = [[f64; D]; 6];

/// Walks from parameters with their distance from the origin to a local minimum nearby.
///
/// A step is Newton's where the second derivatives make it go down, otherwise that of Gauss and
/// Newton, which always does; it ends at the borders of the domain, and is halved until the
/// distance does not grow.
pub(super) fn polish<const D: usize>(
    start: ([f64; 2], f64),
    domain: [[f64; 2]; 2],
    jet: impl Fn([f64; 2]) -> Result<Jet<D>, NurbsError>,
) -> Result<([f64; 2], f64), NurbsError> {
    let (mut at, mut distance) = start;
    for _ in 0..64 {
        let step = step(&jet(at)?, at, domain);
        let mut part = 1.0;
        let moved = loop {
            let next = [0, 1].map(|k| (at[k] + part * step[k]).clamp(domain[k][0], domain[k][1]));
            if next == at || part < 1e-9 {
                break None;
            }
            let reached = length(jet(next)?[0]);
            // Near the minimum distances differ by rounding only, parameters still by more.
            if reached <= distance * (1.0 + 2.0 * f64::EPSILON) {
                break Some((next, reached));
            }
            part *= 0.5;
        };
        let Some((next, reached)) = moved else { break };
        let still = |k: usize| (next[k] - at[k]).abs() <= 4.0 * f64::EPSILON * (domain[k][1] - domain[k][0]);
        let done = still(0) && still(1);
        (at, distance) = (next, reached);
        if done {
            break;
        }
    }
    Ok((at, distance))
}

fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn step<const D: usize>(&[s, su, sv, suu, suv, svv]: &Jet<D>, at: [f64; 2], domain: [[f64; 2]; 2]) -> [f64; 2] {
    let slope = [dot(su, s), dot(sv, s)];
    // A direction is out of play where it leads out of the domain.
    let free = |k: usize| {
        let [lo, hi] = domain[k];
        lo < hi && !(at[k] <= lo && slope[k] >= 0.0) && !(at[k] >= hi && slope[k] <= 0.0)
    };
    let squares = [dot(su, su), dot(sv, sv)];
    let alone = |k: usize, curvature: f64| {
        let bend = squares[k] + curvature;
        let divisor = if bend > 1e-3 * squares[k] { bend } else { squares[k] };
        if divisor > 0.0 { -slope[k] / divisor } else { 0.0 }
    };
    match (free(0), free(1)) {
        (false, false) => [0.0; 2],
        (true, false) => [alone(0, dot(s, suu)), 0.0],
        (false, true) => [0.0, alone(1, dot(s, svv))],
        (true, true) => {
            let mixed = dot(su, sv);
            let newton = [squares[0] + dot(s, suu), mixed + dot(s, suv), squares[1] + dot(s, svv)];
            let solve = |[a, b, c]: [f64; 3]| {
                let determinant = a * c - b * b;
                (a > 0.0 && c > 0.0 && determinant > 1e-12 * a * c)
                    .then(|| [(b * slope[1] - c * slope[0]) / determinant, (b * slope[0] - a * slope[1]) / determinant])
            };
            solve(newton)
                .or_else(|| solve([squares[0], mixed, squares[1]]))
                .unwrap_or_else(|| [alone(0, 0.0), alone(1, 0.0)])
        }
    }
}
