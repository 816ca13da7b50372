//! Fuel: how strongly each lead root drives the air (paper 003, section 4.2, equation 2).

use crate::error::in_range;
use crate::flame::MAX_HEAT_K_S;
use crate::random::{hash, octaves, unit};
use crate::{FlameError, Fuel, FuelDistribution, FuelForm, Swing};
use std::fmt;
use std::sync::Arc;

/// A function of the user's: how much fuel flows at u in -1..1 along the wick at a time in s, as a factor.
///
/// The same arguments must give the same number, or replays differ.
#[derive(Clone)]
pub(crate) struct FuelFunction(pub(crate) Arc<dyn Fn(f32, f64) -> f32 + Send + Sync>);

impl FuelFunction {
    /// The factor, 0 to 1000; what is not a number counts as zero.
    pub(crate) fn value(&self, u: f32, time_s: f64) -> f32 {
        let value = (self.0)(u, time_s);
        if value > 0.0 { value.min(1e3) } else { 0.0 }
    }
}

impl fmt::Debug for FuelFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("FuelFunction")
    }
}

impl FuelDistribution {
    /// F(u) for u in -1..1; `random` in 0..1 is the number drawn for this root.
    ///
    /// `Published` forms reach 2 at u = 1 (linear) or e (exponential): they scale the height too.
    #[must_use]
    pub fn value(&self, u: f32, form: FuelForm, random: f32) -> f32 {
        let u = u.clamp(-1.0, 1.0);
        let published = form == FuelForm::Published;
        match self {
            Self::Uniform => 1.0,
            Self::Linear if published => u + 1.0,
            Self::Linear => 0.5 * (1.0 + u),
            Self::Bilinear if published => u * u,
            Self::Bilinear => u.abs(),
            Self::Exponential if published => u.exp(),
            Self::Exponential => (u - 1.0).exp(),
            Self::Gaussian if published => (-u * u).exp() * (10.0 / 9.0),
            Self::Gaussian => (-u * u).exp(),
            Self::Random => random,
            Self::Table(samples) => table(samples, u),
        }
    }
}

/// Straight lines between samples at equal distances of u.
fn table(samples: &[f32], u: f32) -> f32 {
    let Some(last) = samples.len().checked_sub(1) else { return 0.0 };
    let x = 0.5 * (u + 1.0) * last as f32;
    let i = (x as usize).min(last);
    let (a, b) = (samples[i], samples[(i + 1).min(last)]);
    a + (b - a) * (x - i as f32)
}

impl Swing {
    /// `F_ext` over C of one lead root at a time; `step` counts fixed steps (for [`Swing::Random`]).
    #[must_use]
    pub fn value(&self, time_s: f64, step: u64, seed: u64, lead: u32) -> f32 {
        let seed = hash(seed ^ (u64::from(lead) << 32));
        match *self {
            Self::Still => 0.0,
            Self::Periodic { amplitude, frequency_hz } => {
                // Each root has a phase of its own, or the whole fire would breathe as one.
                let turns = time_s * f64::from(frequency_hz) + f64::from(unit(seed));
                amplitude * ((turns - turns.floor()) as f32 * std::f32::consts::TAU).sin()
            }
            Self::Noise { amplitude, frequency_hz } => amplitude * octaves(seed, time_s * f64::from(frequency_hz)),
            Self::Random { amplitude } => amplitude * (2.0 * unit(hash(seed ^ step)) - 1.0),
        }
    }
}

impl Fuel {
    /// The acceleration of the air at a root, m/s^2 (paper 003, equation 2). It never points down.
    #[must_use]
    pub fn acceleration_m_s2(&self, share: f32, swing: f32) -> f32 {
        (self.strength_m_s2 * (share + swing)).max(0.0)
    }

    pub(crate) fn check(&self) -> Result<(), FlameError> {
        in_range("fuel.strength_m_s2", self.strength_m_s2, 0.0, 1e6, "0 to 1e6")?;
        in_range("fuel.heat_k_s", self.heat_k_s, 0.0, MAX_HEAT_K_S, "0 to 1e6")?;
        let (amplitude, frequency) = match self.swing {
            Swing::Still => (0.0, 0.0),
            Swing::Periodic { amplitude, frequency_hz } | Swing::Noise { amplitude, frequency_hz } => {
                (amplitude, frequency_hz)
            }
            Swing::Random { amplitude } => (amplitude, 0.0),
        };
        in_range("fuel.swing.amplitude", amplitude, 0.0, 1e3, "0 to 1000")?;
        in_range("fuel.swing.frequency_hz", frequency, 0.0, 1e4, "0 to 10000")?;
        if let FuelDistribution::Table(samples) = &self.distribution {
            if !(2..=4096).contains(&samples.len()) {
                let count = samples.len();
                return Err(FlameError::Count { field: "fuel.distribution.table", count, allowed: "2 to 4096" });
            }
            for (index, &value) in samples.iter().enumerate() {
                if !(0.0..=1e6).contains(&value) {
                    let field = "fuel.distribution.table";
                    return Err(if value.is_finite() {
                        FlameError::OutOfRange { field, value: f64::from(value), allowed: "0 to 1e6" }
                    } else {
                        FlameError::NotFinite { field, index, value: f64::from(value) }
                    });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f32, b: f32) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }

    #[test]
    fn distributions_have_their_written_values() {
        let e = std::f32::consts::E;
        let (n, p) = (FuelForm::Normalised, FuelForm::Published);
        for (f, form, at) in [
            (FuelDistribution::Linear, n, [0.0, 0.5, 1.0]),
            (FuelDistribution::Bilinear, n, [1.0, 0.0, 1.0]),
            (FuelDistribution::Exponential, n, [1.0 / e / e, 1.0 / e, 1.0]),
            (FuelDistribution::Gaussian, n, [1.0 / e, 1.0, 1.0 / e]),
            (FuelDistribution::Uniform, n, [1.0, 1.0, 1.0]),
            (FuelDistribution::Linear, p, [0.0, 1.0, 2.0]),
            (FuelDistribution::Bilinear, p, [1.0, 0.0, 1.0]),
            (FuelDistribution::Exponential, p, [1.0 / e, 1.0, e]),
            (FuelDistribution::Gaussian, p, [10.0 / 9.0 / e, 10.0 / 9.0, 10.0 / 9.0 / e]),
            (FuelDistribution::Table(vec![0.2, 0.8, 0.4]), n, [0.2, 0.8, 0.4]),
            (FuelDistribution::Random, n, [0.3, 0.3, 0.3]),
        ] {
            for (u, want) in [-1.0, 0.0, 1.0].into_iter().zip(at) {
                close(f.value(u, form, 0.3), want);
            }
        }
        close(FuelDistribution::Table(vec![0.0, 1.0]).value(0.5, n, 0.0), 0.75);
        close(FuelDistribution::Bilinear.value(0.5, p, 0.0), 0.25);
    }

    #[test]
    fn swing_differs_by_lead_and_repeats_by_seed() {
        let swing = Swing::Noise { amplitude: 0.5, frequency_hz: 4.0 };
        let at = |seed, lead| swing.value(1.23, 0, seed, lead);
        assert_eq!(at(1, 0).to_bits(), at(1, 0).to_bits());
        assert_ne!(at(1, 0).to_bits(), at(1, 1).to_bits());
        assert_ne!(at(1, 0).to_bits(), at(2, 0).to_bits());
        let sine = Swing::Periodic { amplitude: 2.0, frequency_hz: 5.0 };
        close(sine.value(0.3, 0, 7, 0), sine.value(0.5, 0, 7, 0));
        close(sine.value(0.3, 0, 7, 0), -sine.value(0.4, 0, 7, 0));
    }

    #[test]
    fn impossible_fuel_is_refused() {
        let bad = Fuel { strength_m_s2: f32::NAN, ..Fuel::default() };
        assert!(matches!(bad.check(), Err(FlameError::OutOfRange { field: "fuel.strength_m_s2", .. })));
        let bad = Fuel { distribution: FuelDistribution::Table(vec![1.0]), ..Fuel::default() };
        assert!(matches!(bad.check(), Err(FlameError::Count { count: 1, .. })));
        let bad = Fuel { distribution: FuelDistribution::Table(vec![1.0, f32::INFINITY]), ..Fuel::default() };
        assert!(matches!(bad.check(), Err(FlameError::NotFinite { index: 1, .. })));
    }
}
