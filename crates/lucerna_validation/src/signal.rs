//! What repeats in a signal, and slopes of laws of powers.

use std::f64::consts::PI;

/// The strongest frequency of a signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Where the spectrum is highest, Hz; not a number for a signal without anything in the band.
    pub hz: f64,
    /// Width of the peak at half of its height, Hz.
    pub width_hz: f64,
    /// Mean of the signal.
    pub mean: f64,
    /// Root mean square of the swings about the mean.
    pub rms: f64,
}

impl Peak {
    /// Swings over the mean.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.rms / self.mean.abs()
    }
}

/// The frequency within a band (Hz) at which values, `dt_s` apart, swing most: the highest place of their spectrum under
/// a raised cosine (F. Harris, Proc. IEEE 66, 1978), their line taken out.
#[must_use]
pub fn strongest(values: &[f64], dt_s: f64, band_hz: [f64; 2]) -> Peak {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let rms = (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt();
    let spectrum = spectrum(values, dt_s, band_hz);
    let highest = spectrum.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, power)| *power > 0.0);
    let Some((hz, power)) = highest else { return Peak { hz: f64::NAN, width_hz: f64::NAN, mean, rms } };
    let at = spectrum.iter().position(|(place, _)| *place == hz).unwrap_or(0);
    let is_high = |(_, value): &&(f64, f64)| *value >= 0.5 * power;
    let above = spectrum[at..].iter().take_while(is_high).count();
    let below = spectrum[..=at].iter().rev().take_while(is_high).count();
    let width_hz = (above + below - 1) as f64 * spacing_hz(values.len(), dt_s);
    Peak { hz, width_hz, mean, rms }
}

/// Power at places of a band, Hz, ten across the width of a line.
#[must_use]
pub fn spectrum(values: &[f64], dt_s: f64, band_hz: [f64; 2]) -> Vec<(f64, f64)> {
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
    let spacing = spacing_hz(values.len(), dt_s);
    let tries = ((band_hz[1] - band_hz[0]) / spacing) as usize;
    (0..=tries).map(|at| band_hz[0] + spacing * at as f64).map(|hz| (hz, power(hz))).collect()
}

fn spacing_hz(count: usize, dt_s: f64) -> f64 {
    0.1 / (count as f64 * dt_s)
}

/// How alike two signals of one length swing: 1 in phase, -1 in anti-phase.
pub(crate) fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let sum = |of: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(a, b)| of(a - mean_a, b - mean_b)).sum::<f64>();
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
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

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(hz: f64, phase: f64) -> Vec<f64> {
        (0..1000).map(|at| 3.0 + 0.01 * f64::from(at) + (2.0 * PI * hz * 0.01 * f64::from(at) + phase).sin()).collect()
    }

    #[test]
    fn the_frequency_of_a_wave_on_a_slope_is_found() {
        for hz in [0.9, 2.37, 11.0] {
            let peak = strongest(&wave(hz, 0.3), 0.01, [0.4, 20.0]);
            assert!((peak.hz - hz).abs() < 0.03 && peak.width_hz < 0.3, "{peak:?}");
        }
        assert!(strongest(&[2.0; 100], 0.01, [0.4, 20.0]).hz.is_nan());
    }

    #[test]
    fn waves_in_and_against_phase_are_told_apart() {
        let flat = |values: Vec<f64>| -> Vec<f64> { (0..1000).map(|at| values[at] - 0.01 * at as f64).collect() };
        let (a, b, c) = (flat(wave(3.0, 0.0)), flat(wave(3.0, PI)), flat(wave(3.0, 0.5 * PI)));
        assert!(correlation(&a, &a) > 0.999 && correlation(&a, &b) < -0.999 && correlation(&a, &c).abs() < 0.01);
    }

    #[test]
    fn powers_are_found() {
        let points: Vec<(f64, f64)> = (1..9).map(|x| (f64::from(x), 3.0 * f64::from(x).powf(-0.5))).collect();
        assert!((exponent(&points) + 0.5).abs() < 1.0e-12);
    }
}
