//! What repeats in a signal, and slopes of laws of powers.

use std::f64::consts::PI;

/// The frequency within a band (Hz) at which values, `dt_s` apart, swing most: the highest place of
/// their spectrum under a raised cosine (F. Harris, Proc. IEEE 66, 1978), their line taken out.
pub(crate) fn strongest_hz(values: &[f64], dt_s: f64, band_hz: [f64; 2]) -> f64 {
    let count = values.len() as f64;
    let places: Vec<(f64, f64)> = values.iter().enumerate().map(|(at, value)| (at as f64, *value)).collect();
    let (slope, start) = line(&places);
    let weighted: Vec<f64> =
        places.iter().map(|(at, value)| (value - start - slope * at) * (1.0 - (2.0 * PI * at / count).cos())).collect();
    let power = |hz: f64| {
        // Goertzel's recursion.
        let turn = 2.0 * (2.0 * PI * hz * dt_s).cos();
        let (last, before) = weighted.iter().fold((0.0, 0.0), |(a, b), value| (value + turn * a - b, a));
        last * last + before * before - turn * last * before
    };
    // Ten places across the width of a line.
    let spacing = 0.1 / (count * dt_s);
    let tries = ((band_hz[1] - band_hz[0]) / spacing) as usize;
    let powers = (0..=tries).map(|at| band_hz[0] + spacing * at as f64).map(|hz| (hz, power(hz)));
    powers.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(f64::NAN, |(hz, _)| hz)
}

/// Slope and value at zero of the line through points by least squares.
pub(crate) fn line(points: &[(f64, f64)]) -> (f64, f64) {
    let count = points.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(&|point| point.0), mean(&|point| point.1));
    let slope =
        mean(&|point| (point.0 - x) * (point.1 - y)) / mean(&|point| (point.0 - x).powi(2)).max(f64::MIN_POSITIVE);
    (slope, y - slope * x)
}

/// The power with which `y` goes as `x`.
pub(crate) fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    line(&logs).0
}
