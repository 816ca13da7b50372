//! All experiments.

use crate::experiment::Experiment;
use crate::laws::{candles, heights, line_fire, mccaffrey, merging, puffing, radiation, rising_wave, wind};

/// All experiments, cheap ones first.
pub static EXPERIMENTS: &[Experiment] = &[
    rising_wave::RISING_WAVE,
    puffing::LIGHT_PLUME,
    puffing::PUFFING,
    mccaffrey::MCCAFFREY,
    heights::POOLS,
    heights::HEIGHT_BY_HEAT,
    line_fire::LINE_FIRE,
    wind::WIND,
    merging::MERGING,
    radiation::RADIATION,
    candles::CANDLES,
    candles::CANDLE_PAIRS,
];

/// The names of all experiments.
#[must_use]
pub fn names() -> Vec<&'static str> {
    EXPERIMENTS.iter().map(|experiment| experiment.name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_different_and_found() {
        for experiment in EXPERIMENTS {
            assert!(std::ptr::eq(Experiment::named(experiment.name).unwrap(), experiment), "{}", experiment.name);
        }
        let error = Experiment::named("no_such_law").unwrap_err().to_string();
        assert!(error.contains("no_such_law") && error.contains("mccaffrey"), "{error}");
    }
}
