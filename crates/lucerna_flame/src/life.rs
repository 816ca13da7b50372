//! The life of a fire: lit or not, how much fuel it has, how it catches fire and how it goes out.

use crate::error::in_range;
use crate::random::Fnv;
use crate::{Drive, FlameError, FuelKind};
use serde::{Deserialize, Serialize};

/// Greatest rate of strain that a flame of gas against air bears, 1/s: a round number near that at which a methane flame
/// before a porous cylinder goes out, twice the speed of the air over the cylinder's radius (H. Tsuji, *Counterflow
/// Diffusion Flames*, Prog. Energy Combust. Sci. 8, 1982). Opposed jets computed with GRI-Mech 3.0 go out at 300 to 500
/// 1/s, by where the strain is taken. Fires of one fuel go out at speeds in proportion to their size (D. B. Spalding,
/// *Experiments on the Burning and Extinction of Liquid Fuel Spheres*, Fuel 32, 1953).
const MOST_STRAIN_PER_S: f32 = 350.0;
/// How long a flame stands a gust of twice the speed that it bears, s.
const GUST_S: f32 = 0.1;

/// How much fuel there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Supply {
    /// It never ends.
    #[default]
    Endless,
    /// For so many seconds at the full rate, up to 1e9.
    Seconds(f32),
    /// So many grams for each flame, up to 1e9; only with `combustion`.
    Grams(f32),
    /// As much as releases so many kilojoules for each flame, up to 1e9; only with `combustion`.
    Kilojoules(f32),
}

/// Which gusts blow a flame out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BlowOut {
    /// With `combustion`, those whose speed over a quarter of the fire's width is above 350 1/s: 1 m/s for a flame of
    /// 11 mm. With root forces, none.
    #[default]
    Natural,
    /// None.
    Never,
    /// Those that pass the wick faster than this, m/s, 0.01 to 1000.
    Above(f32),
}

/// How a fire begins and ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Life {
    /// Whether it burns from the start.
    pub lit: bool,
    /// How much fuel it has.
    pub supply: Supply,
    /// Whether hot air sets it on fire.
    pub catches_fire: bool,
    /// Temperature of the air at the wick at which it catches fire, K, 300 to 3000. None: the fuel's, see
    /// [`FuelKind::ignition_k`]; with root forces that of wax.
    pub ignition_k: Option<f32>,
    /// How long the air must be so hot, s, 0 to 1000. While it is cooler the count runs back.
    pub ignition_s: f32,
    /// Which gusts blow it out.
    pub blow_out: BlowOut,
    /// Time in which it comes to full strength, s, 0.01 to 1000.
    pub kindle_s: f32,
    /// Time in which it dies down, s, 0.01 to 1000.
    pub fade_s: f32,
}

impl Default for Life {
    fn default() -> Self {
        Self {
            lit: true,
            supply: Supply::Endless,
            catches_fire: true,
            ignition_k: None,
            ignition_s: 0.5,
            blow_out: BlowOut::Natural,
            kindle_s: 0.4,
            fade_s: 0.25,
        }
    }
}

impl Life {
    /// Checks every number, and that the drive has what the supply is measured in.
    ///
    /// # Errors
    /// At the first that is out of its range; the error names it.
    pub fn check(&self, drive: &Drive) -> Result<(), FlameError> {
        let (field, amount) = match self.supply {
            Supply::Endless => ("", 0.0),
            Supply::Seconds(seconds) => ("life.supply.seconds", seconds),
            Supply::Grams(grams) => ("life.supply.grams", grams),
            Supply::Kilojoules(kilojoules) => ("life.supply.kilojoules", kilojoules),
        };
        in_range(field, amount, 0.0, 1e9, "0 to 1e9")?;
        if *drive == Drive::RootForces {
            match self.supply {
                Supply::Grams(_) => return Err(FlameError::Supply { unit: "grams" }),
                Supply::Kilojoules(_) => return Err(FlameError::Supply { unit: "kilojoules" }),
                Supply::Endless | Supply::Seconds(_) => {}
            }
        }
        in_range("life.ignition_k", self.ignition_k.unwrap_or(600.0), 300.0, 3000.0, "300 to 3000")?;
        in_range("life.ignition_s", self.ignition_s, 0.0, 1000.0, "0 to 1000")?;
        if let BlowOut::Above(speed) = self.blow_out {
            in_range("life.blow_out.above", speed, 0.01, 1000.0, "0.01 to 1000")?;
        }
        in_range("life.kindle_s", self.kindle_s, 0.01, 1000.0, "0.01 to 1000")?;
        in_range("life.fade_s", self.fade_s, 0.01, 1000.0, "0.01 to 1000")
    }

    /// How long the supply lasts at the full rate, s.
    fn supply_s(&self, drive: &Drive) -> f64 {
        let kilowatts = f64::from(drive.power_kw().unwrap_or(1.0));
        match self.supply {
            Supply::Endless => f64::INFINITY,
            Supply::Seconds(seconds) => f64::from(seconds),
            Supply::Grams(grams) => {
                let heat_kj_g = drive.fuel().map_or(1.0, |fuel| 1e-3 * f64::from(fuel.gas().heat_kj_kg));
                f64::from(grams) * heat_kj_g / kilowatts
            }
            Supply::Kilojoules(kilojoules) => f64::from(kilojoules) / kilowatts,
        }
    }

    /// The speed of the air past the wick that a flame of a width bears, m/s; infinite where it bears any.
    #[must_use]
    pub fn blow_out_m_s(&self, drive: &Drive, width_m: f32) -> f32 {
        match self.blow_out {
            BlowOut::Above(speed) => speed,
            BlowOut::Natural if *drive != Drive::RootForces => 0.25 * MOST_STRAIN_PER_S * width_m,
            BlowOut::Natural | BlowOut::Never => f32::INFINITY,
        }
    }
}

/// What a flame's wick feels during a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Felt {
    /// Hottest air at the wick, K.
    pub(crate) temperature_k: f32,
    /// Speed of the air past it, m/s.
    pub(crate) speed_m_s: f32,
    /// The speed that the flame bears, m/s.
    pub(crate) bears_m_s: f32,
}

/// Where a flame is in its life.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Fire {
    pub(crate) lit: bool,
    /// Share of its full strength, 0 to 1.
    pub(crate) power: f32,
    /// How long the fuel lasts at the full rate, s.
    pub(crate) left_s: f64,
    /// How long it was hot enough to catch fire, s.
    warm_s: f32,
    /// How far gusts have carried it towards going out, 0 to 1.
    blown: f32,
    /// It has cooled since it was last put out: what is left of its own heat does not count as another's.
    cooled: bool,
    /// Length of the last step, s.
    step_s: f32,
}

impl Fire {
    /// Whether all of it can be, where it was read from outside.
    pub(crate) fn is_sound(&self) -> bool {
        let shares = [self.power, self.blown].iter().all(|share| (0.0..=1.0).contains(share));
        shares && self.left_s >= 0.0 && self.warm_s >= 0.0 && (0.0..=1e3).contains(&self.step_s)
    }

    pub(crate) fn new(life: &Life, drive: &Drive) -> Self {
        let left_s = life.supply_s(drive);
        let lit = life.lit && left_s > 0.0;
        let power = if lit { 1.0 } else { 0.0 };
        Self { lit, power, left_s, warm_s: 0.0, blown: 0.0, cooled: true, step_s: 0.0 }
    }

    /// Sets it on fire, where it has fuel.
    pub(crate) fn ignite(&mut self) {
        if self.left_s > 0.0 {
            (self.lit, self.blown, self.warm_s) = (true, 0.0, 0.0);
        }
    }

    pub(crate) fn extinguish(&mut self) {
        (self.lit, self.cooled, self.warm_s, self.blown) = (false, false, 0.0, 0.0);
    }

    /// The share of the full rate at which fuel flows in the coming step; `wanted` is what the roots ask for. What is
    /// left at the end is spread over a step as long as the last one.
    pub(crate) fn flow(&self, wanted: f32) -> f32 {
        let wanted = wanted * self.power;
        let most = if self.step_s > 0.0 { self.left_s / f64::from(self.step_s) } else { f64::INFINITY };
        if f64::from(wanted) > most { most.max(0.0) as f32 } else { wanted }
    }

    /// Uses fuel, catches fire, is blown out. `flow` is what [`Fire::flow`] said of this step.
    pub(crate) fn step(&mut self, life: &Life, drive: &Drive, felt: Felt, flow: f32, dt_s: f32) {
        self.step_s = dt_s;
        self.left_s = (self.left_s - f64::from(flow) * f64::from(dt_s)).max(0.0);
        if self.lit {
            // A millionth of a second's fuel is what rounding leaves.
            if self.left_s <= 1e-6 {
                self.left_s = 0.0;
                self.extinguish();
            }
            let over = (felt.speed_m_s / felt.bears_m_s - 1.0).clamp(-1.0, 10.0);
            self.blown = (self.blown + over * dt_s / GUST_S).max(0.0);
            if self.blown >= 1.0 {
                self.extinguish();
            }
        } else {
            let fuel = drive.fuel().unwrap_or(FuelKind::Wax);
            let is_hot = felt.temperature_k >= life.ignition_k.unwrap_or(fuel.ignition_k());
            self.cooled |= !is_hot;
            let way = if is_hot && self.cooled { dt_s } else { -dt_s };
            self.warm_s = (self.warm_s + way).max(0.0);
            if life.catches_fire && is_hot && self.cooled && self.warm_s >= life.ignition_s {
                self.ignite();
            }
        }
        let change = if self.lit { dt_s / life.kindle_s } else { -dt_s / life.fade_s };
        self.power = (self.power + change).clamp(0.0, 1.0);
    }

    /// Whether there is anything to be seen or driven.
    pub(crate) fn burns(&self) -> bool {
        self.lit || self.power > 0.0
    }

    pub(crate) fn hash(&self, fnv: &mut Fnv) {
        fnv.word(u64::from(self.lit) | u64::from(self.cooled) << 1);
        fnv.word(self.left_s.to_bits());
        for value in [self.power, self.warm_s, self.blown, self.step_s] {
            fnv.float(value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rate;

    const CALM: Felt = Felt { temperature_k: 293.0, speed_m_s: 0.0, bears_m_s: 1.0 };
    const WAX: Drive = Drive::Combustion { fuel: FuelKind::Wax, rate: Rate::Kw(0.08) };

    /// Steps of `dt_s` until it goes out, at most 1e4; the fuel used, in seconds of the full rate.
    fn burn(fire: &mut Fire, life: &Life, felt: Felt, dt_s: f32) -> (usize, f64) {
        let mut used = 0.0;
        for step in 0..10_000 {
            let flow = fire.flow(1.0);
            used += f64::from(flow) * f64::from(dt_s);
            fire.step(life, &WAX, felt, flow, dt_s);
            if !fire.burns() {
                return (step + 1, used);
            }
        }
        (10_000, used)
    }

    #[test]
    fn what_is_used_is_what_there_was() {
        for (supply, seconds) in
            [(Supply::Seconds(2.0), 2.0), (Supply::Kilojoules(0.16), 2.0), (Supply::Grams(0.16 / 43.4), 2.0)]
        {
            for dt_s in [1e-3, 1.0 / 60.0, 0.3] {
                let life = Life { supply, ..Life::default() };
                let mut fire = Fire::new(&life, &WAX);
                let (steps, used) = burn(&mut fire, &life, CALM, dt_s);
                println!("{supply:?} in steps of {dt_s} s: {used:.6} s in {steps} steps");
                assert!((used / seconds - 1.0).abs() < 1e-4, "{supply:?} at {dt_s}: {used}");
                fire.ignite();
                assert!(!fire.lit, "nothing is left to burn");
            }
        }
    }

    #[test]
    fn gusts_above_what_it_bears_blow_it_out_and_others_do_not() {
        let life = Life::default();
        let bears_m_s = life.blow_out_m_s(&WAX, 0.008);
        println!("a flame 8 mm wide bears {bears_m_s} m/s");
        for (share, goes_out) in [(0.95, false), (1.2, true), (2.0, true)] {
            let felt = Felt { speed_m_s: share * bears_m_s, bears_m_s, ..CALM };
            let mut fire = Fire::new(&life, &WAX);
            let (steps, _) = burn(&mut fire, &life, felt, 0.01);
            assert_eq!(steps < 10_000, goes_out, "{share}: {steps}");
        }
        assert_eq!(life.blow_out_m_s(&Drive::RootForces, 0.008), f32::INFINITY);
    }

    #[test]
    fn it_catches_fire_after_its_time_in_heat_and_not_from_its_own_embers() {
        let life = Life { lit: false, ..Life::default() };
        let hot = Felt { temperature_k: 600.0, ..CALM };
        let mut fire = Fire::new(&life, &WAX);
        for step in 1..60 {
            fire.step(&life, &WAX, hot, 0.0, 1.0 / 64.0);
            assert_eq!(fire.lit, step >= 32, "at step {step}");
        }
        fire.extinguish();
        (0..100).for_each(|_| fire.step(&life, &WAX, hot, 0.0, 0.01));
        assert!(!fire.lit, "the heat was its own");
        fire.step(&life, &WAX, CALM, 0.0, 0.01);
        (0..60).for_each(|_| fire.step(&life, &WAX, hot, 0.0, 0.01));
        assert!(fire.lit, "this heat is another's");
        let warm = Felt { temperature_k: 500.0, ..CALM };
        let mut cool = Fire::new(&life, &WAX);
        (0..1000).for_each(|_| cool.step(&life, &WAX, warm, 0.0, 0.01));
        assert!(!cool.lit);
    }
}
