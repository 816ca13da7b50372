//! How often plumes puff: the frequency at which the air over them swings half a diameter up.

use std::f32::consts::FRAC_PI_4;

use lucerna_fluid::{AIR_GAS_CONSTANT_J_KG_K, AIR_HEAT_CAPACITY_J_KG_K, AIR_PRESSURE_PA, Fluid, Source, Vec3};

use crate::air::open_air;
use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::fire::{Burner, METHANE, Plan, disk};
use crate::signal::{Peak, exponent, spectrum, strongest};

pub(crate) const LIGHT_PLUME: Experiment = Experiment {
    name: "light_plume",
    title: "Light gas from a plate of a metre",
    law: "1.37 Hz",
    source: "T. O'Hern et al., Experimental Study of a Turbulent Buoyant Helium Plume, J. Fluid Mech. 544, 2005, table 1: \
             helium at 0.325 m/s, ten repeats from 1.19 to 1.53 Hz",
    origin: Origin::Emergent,
    measures: "Mean upward speed within 0.4 m of the axis, half a metre up; gas 0.185 times as dense as air (heat in place of helium).",
    short: None,
    long: "20 cells across the plate, box of 3 x 3 x 3 m, 4 to 18 s",
    burn: light_plume,
};

pub(crate) const PUFFING: Experiment = Experiment {
    name: "puffing",
    title: "Methane on round burners of four sizes",
    law: "1.5 / sqrt(D) Hz",
    source: "B. Cetegen, T. Ahmed, Experiments on the Periodic Instability of Buoyant Plumes and Pool Fires, Combustion and \
             Flame 93, 1993",
    origin: Origin::Emergent,
    measures: "Mean upward speed within 0.4 D of the axis, half a diameter up; 1110 D^2.5 kW, nothing radiates.",
    short: None,
    long: "12 cells across, box of 3 x 4 x 3 diameters, 6 to 27 puffs",
    burn: burners,
};

/// Step, start and end of what counts, for a burner of a metre; times go as the root of its width.
const STEP_S: f32 = 0.0112;
const TIMES_S: [f32; 2] = [4.0, 18.0];
/// Swings of less than this share of the mean are noise.
pub(crate) const PUFFS: f64 = 0.02;
/// How far from the axis the speed is averaged, in diameters.
const REACH: f32 = 0.4;

/// Where the speed of what rises over a burner is taken: a disk half a diameter up.
pub(crate) struct Probe(Vec<Vec3>);

impl Probe {
    pub(crate) fn new(foot: Vec3, diameter_m: f32, cell_m: f32) -> Self {
        let reach = (REACH * diameter_m / cell_m) as i32;
        let places = (-reach..=reach).flat_map(|k| (-reach..=reach).map(move |i| Vec3::new(i as f32, 0.0, k as f32)));
        let inside = places.map(|place| cell_m * place).filter(|place| place.length() <= REACH * diameter_m);
        Self(inside.map(|place| foot + 0.5 * diameter_m * Vec3::Y + place).collect())
    }

    /// Mean upward speed, m/s.
    pub(crate) fn speed_m_s(&self, air: &Fluid) -> f64 {
        self.0.iter().map(|place| f64::from(air.velocity(*place).y)).sum::<f64>() / self.0.len() as f64
    }
}

/// The speed half a diameter up, every step once the plume has settled.
fn speeds(run: &mut Run<'_>, air: &mut Fluid, foot: Vec3, diameter_m: f32) -> Result<Vec<f64>, Halt> {
    let dt_s = STEP_S * diameter_m.sqrt();
    let [start, end] = TIMES_S.map(|time| (time / STEP_S) as usize);
    let probe = Probe::new(foot, diameter_m, air.cell_size_m().x);
    let mut speeds = Vec::with_capacity(end - start);
    run.steps(air, dt_s, end, |step, air, _| {
        if step >= start {
            speeds.push(probe.speed_m_s(air));
        }
    })?;
    Ok(speeds)
}

fn band_hz(diameter_m: f32) -> [f64; 2] {
    [0.4, 6.0].map(|hz| hz / f64::from(diameter_m).sqrt())
}

/// A figure of a frequency; a swing that is none has no frequency.
pub(crate) fn frequency(what: String, published: f64, peak: &Peak) -> Figure {
    let percent = 100.0 * peak.share();
    if peak.share() < PUFFS {
        let note = format!("steady: swings by {percent:.0} % of the mean");
        return Figure::new(what, "Hz", published, f64::NAN, Allowed::Percent(15.0)).noted(note);
    }
    let note = format!("swings by {percent:.0} % of the mean, peak {:.2} Hz wide", peak.width_hz);
    Figure::new(what, "Hz", published, peak.hz, Allowed::Percent(15.0)).noted(note)
}

/// The last seconds of a signal, and its spectrum.
fn charts(run: &mut Run<'_>, what: &str, speeds: &[f64], dt_s: f64, band_hz: [f64; 2]) {
    let shown = speeds.len().min((12.0 / band_hz[0] / dt_s) as usize);
    let first = speeds.len() - shown;
    let signal = (first..speeds.len()).map(|at| (dt_s * (at - first) as f64, speeds[at])).collect();
    let line = |points| vec![Series { name: String::new(), mark: Mark::Line, points }];
    run.chart(Chart {
        title: format!("{what}: speed half a diameter up"),
        x: Axis::linear("time, s"),
        y: Axis::linear("m/s"),
        series: line(signal),
    });
    let mut power = spectrum(speeds, dt_s, band_hz);
    let most = power.iter().map(|point| point.1).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    power.iter_mut().for_each(|point| point.1 /= most);
    run.chart(Chart {
        title: format!("{what}: its spectrum"),
        x: Axis::linear("Hz"),
        y: Axis::linear("power"),
        series: line(power),
    });
}

fn light_plume(run: &mut Run<'_>) -> Result<(), Halt> {
    const LIGHTER: f32 = 0.815;
    const SPEED_M_S: f32 = 0.325;
    const ACROSS: usize = 20;
    let cell_m = 1.0 / ACROSS as f32;
    let mut air = open_air([3 * ACROSS; 3], cell_m).build()?;
    let foot = cell_m * Vec3::new(0.5, 0.0, -0.27);
    let gas_m3_s = SPEED_M_S * FRAC_PI_4;
    // Cold air of the share that has weight, and heat that expands it to all of the volume.
    let kilowatts_m3_s = 1.0e-3 * AIR_PRESSURE_PA * AIR_HEAT_CAPACITY_J_KG_K / AIR_GAS_CONSTANT_J_KG_K;
    air.attach_source(Source {
        heat_kw: LIGHTER * gas_m3_s * kilowatts_m3_s,
        inflow_m3_s: (1.0 - LIGHTER) * gas_m3_s,
        ..Source::new(disk(foot, 1.0, cell_m))
    })?;
    let speeds = speeds(run, &mut air, foot, 1.0)?;
    let dt_s = f64::from(STEP_S);
    let peak = strongest(&speeds, dt_s, band_hz(1.0));
    run.figure(frequency("puffing of light gas".into(), 1.37, &peak));
    charts(run, "Light gas", &speeds, dt_s, band_hz(1.0));
    Ok(())
}

fn burners(run: &mut Run<'_>) -> Result<(), Halt> {
    const ACROSS: usize = 12;
    let sizes = [0.1_f32, 0.2, 0.4, 0.8];
    let mut found = Vec::new();
    for (at, diameter) in sizes.into_iter().enumerate() {
        run.part(at, sizes.len());
        let kilowatts = 1110.0 * diameter.powf(2.5);
        let gas = METHANE.radiating(0.0);
        let cells = [3 * ACROSS, 4 * ACROSS, 3 * ACROSS];
        let plan = Plan::new(gas, kilowatts, Burner::Round { diameter }, diameter / ACROSS as f32, cells);
        let mut fire = plan.light()?;
        let speeds = speeds(run, &mut fire.air, fire.feet[0], diameter)?;
        let dt_s = f64::from(STEP_S * diameter.sqrt());
        let peak = strongest(&speeds, dt_s, band_hz(diameter));
        let law = 1.5 / f64::from(diameter).sqrt();
        run.figure(frequency(format!("puffing of {kilowatts:.0} kW on {diameter} m"), law, &peak));
        if peak.share() >= PUFFS {
            found.push((f64::from(diameter), peak.hz));
        }
        if diameter == 0.4 {
            charts(run, "112 kW on 0.4 m", &speeds, dt_s, band_hz(diameter));
        }
    }
    let slope = if found.len() == sizes.len() { exponent(&found) } else { f64::NAN };
    run.figure(Figure::new("exponent of the frequency by diameter", "", -0.5, slope, Allowed::Difference(0.05)));
    let law = [0.08, 1.0].map(|d: f64| (d, 1.5 / d.sqrt())).to_vec();
    run.chart(Chart::of_law("Puffing", ["diameter, m", "Hz"], ("1.5 / sqrt(D)", law), found));
    Ok(())
}
