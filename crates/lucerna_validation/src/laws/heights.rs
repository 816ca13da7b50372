//! How high pool fires burn, and how that grows with their heat.

use lucerna_fluid::{AIR_GAS_CONSTANT_J_KG_K, AIR_HEAT_CAPACITY_J_KG_K, AIR_PRESSURE_PA, GRAVITY_M_S2};

use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::fire::{Burner, Gas, METHANE, METHANOL, PROPANE, Plan};
use crate::flame_height::{FlameHeight, Heights};
use crate::laws::puffing::{Probe, frequency};
use crate::signal::{Peak, exponent, strongest};

pub(crate) const POOLS: Experiment = Experiment {
    name: "pools",
    title: "Pool fires of NIST: methanol and propane",
    law: "flame heights of 0.41 and 0.75 m, puffing at 2.7 and 2.4 Hz",
    source: "K. Sung, R. Falkenstein-Smith, A. Hamins, The Global and Local Structure of Medium-Scale Pool Fires, NIST \
             Technical Note 2162r1, 2024, table 1.1: heights from video, within 2 % those that flames reach half of the \
             time",
    origin: Origin::Calibrated,
    measures: "Height with burning gas half of the time, which is how flames are measured; beside it the heights below \
               which 95 and 99 % of the heat is released on average, and where the axis is 500 K above ambient. Puffing: mean upward speed within 0.4 D of the axis, \
               half a diameter up. Radiated shares are the measured ones. Small eddies mix at the rate of FDS, which was \
               set to Heskestad's heights there; puffing has no such constant.",
    short: Some("6 cells across, 1.5 to 3 s, the height of methanol only"),
    long: "12 cells across, box of 3 x 5 x 3 diameters, 2 to 8 s",
    burn: pools,
};

pub(crate) const HEIGHT_BY_HEAT: Experiment = Experiment {
    name: "height_by_heat",
    title: "Methane on 0.4 m, 20 to 200 kW",
    law: "L + 1.02 D goes as Q^0.4",
    source: "G. Heskestad, Luminous Heights of Turbulent Diffusion Flames, Fire Safety Journal 5, 1983: \
             L = 0.235 Q^0.4 - 1.02 D",
    origin: Origin::Calibrated,
    measures: "Height with burning gas half of the time, as flames are measured. Small eddies mix at the rate of FDS, which was \
               set to these heights there. Cells are an eighth of the fire's own length (Q / (rho c_p T sqrt(g)))^0.4.",
    short: None,
    long: "cells of 2.5, 4.0 and 6.3 cm, boxes 1 to 1.4 m wide and 1.0 to 3.2 m high, 2 to 8 s each",
    burn: by_heat,
};

/// What a look at a fire gives.
pub(crate) struct Seen {
    pub(crate) heights: Heights,
    pub(crate) peak: Peak,
    pub(crate) watched: FlameHeight,
}

/// Burns a plan between two times, s; looks at the flame every fourth step.
pub(crate) fn watch(run: &mut Run<'_>, plan: &Plan, dt_s: f32, times_s: [f32; 2]) -> Result<Seen, Halt> {
    let mut fire = plan.light()?;
    let (foot, diameter) = (fire.feet[0], plan.burner.diameter_m());
    let mut watched = FlameHeight::new(&fire.air, fire.fuel, fire.kg_s, plan.gas.fuel.heat_kj_kg, foot);
    let [start, end] = times_s.map(|time| (time / dt_s) as usize);
    let probe = Probe::new(foot, diameter, plan.cell_m);
    let mut speeds = Vec::new();
    run.steps(&mut fire.air, dt_s, end, |step, air, _| {
        if step >= start {
            speeds.push(probe.speed_m_s(air));
            if step % 4 == 0 {
                watched.look(air);
            }
        }
    })?;
    let slow = f64::from(diameter).sqrt();
    let peak = strongest(&speeds, f64::from(dt_s), [0.5 / slow, 5.0 / slow]);
    Ok(Seen { heights: watched.heights(), peak, watched })
}

/// A pool fire, and what was published of it.
struct Pool {
    name: &'static str,
    gas: Gas,
    diameter: f32,
    heat_kw: f32,
    height_m: f64,
    hz: f64,
}

fn pools(run: &mut Run<'_>) -> Result<(), Halt> {
    let pools = [
        Pool { name: "methanol", gas: METHANOL, diameter: 0.301, heat_kw: 19.2, height_m: 0.41, hz: 2.7 },
        Pool { name: "propane", gas: PROPANE.radiating(0.28), diameter: 0.37, heat_kw: 34.4, height_m: 0.75, hz: 2.4 },
    ];
    let (across, times_s) = run.choose((6, [1.5, 3.0]), (12, [2.0, 8.0]));
    let count = run.choose(1, pools.len());
    let mut lines = Vec::new();
    for (at, pool) in pools.iter().take(count).enumerate() {
        run.part(at, count);
        let Pool { name, gas, diameter, heat_kw, height_m, hz } = *pool;
        let cells = [3 * across, 5 * across, 3 * across];
        let cell_m = diameter / across as f32;
        let plan = Plan::new(gas, heat_kw, Burner::Round { diameter }, cell_m, cells);
        let Seen { heights, peak, watched } = watch(run, &plan, 0.2 * cell_m, times_s)?;
        figures(run, &format!("{name}, {heat_kw} kW on {diameter} m"), &heights, height_m);
        if count > 1 {
            run.figure(frequency(format!("{name}: puffing"), hz, &peak));
        }
        lines.push(Series { name: name.into(), mark: Mark::Line, points: watched.axis_kelvin() });
    }
    run.chart(Chart {
        title: "Mean temperature on the axis".into(),
        x: Axis::linear("height, m"),
        y: Axis::linear("above ambient, K"),
        series: lines,
    });
    Ok(())
}

fn figures(run: &mut Run<'_>, what: &str, heights: &Heights, published_m: f64) {
    run.figure(Figure::new(
        format!("{what}: height"),
        "m",
        published_m,
        heights.half_of_time_m,
        Allowed::Percent(25.0),
    ));
    for (measure, found) in [
        ("95 % of the heat", heights.released_95_m),
        ("99 % of the heat", heights.released_99_m),
        ("500 K on the axis", heights.kelvin_500_m),
    ] {
        run.figure(Figure::new(format!("the same, {measure}"), "m", published_m, found, Allowed::Any));
    }
}

/// A fire's own length `(Q / (rho c_p T sqrt(g)))^0.4`, m.
fn own_length_m(heat_kw: f32) -> f32 {
    let air = AIR_PRESSURE_PA / AIR_GAS_CONSTANT_J_KG_K * AIR_HEAT_CAPACITY_J_KG_K * GRAVITY_M_S2.sqrt();
    (1.0e3 * heat_kw / air).powf(0.4)
}

fn by_heat(run: &mut Run<'_>) -> Result<(), Halt> {
    const DIAMETER: f32 = 0.4;
    /// Cells across the fire's own length: 6 are said to be coarse, 12 fair (FDS Validation Guide).
    const ACROSS: f32 = 8.0;
    let mut found = Vec::new();
    let heats = [20.0_f32, 63.0, 200.0];
    for (at, heat_kw) in heats.into_iter().enumerate() {
        run.part(at, heats.len());
        let law = 0.235 * f64::from(heat_kw).powf(0.4) - 1.02 * f64::from(DIAMETER);
        let own_m = own_length_m(heat_kw);
        let cell_m = own_m / ACROSS;
        let box_m = [0.8 + 1.2 * own_m, 0.4 + 1.8 * law as f32, 0.8 + 1.2 * own_m];
        let burner = Burner::Round { diameter: DIAMETER };
        let plan = Plan::new(METHANE, heat_kw, burner, cell_m, box_m.map(|edge| (edge / cell_m) as usize));
        let heights = watch(run, &plan, 0.15 * cell_m, [2.0, 8.0])?.heights;
        let figure =
            Figure::new(format!("height of {heat_kw} kW"), "m", law, heights.half_of_time_m, Allowed::Percent(25.0));
        let note = format!("99 % of the heat {:.2} m, 500 K {:.2} m", heights.released_99_m, heights.kelvin_500_m);
        run.figure(figure.noted(note));
        found.push((f64::from(heat_kw), heights.half_of_time_m + 1.02 * f64::from(DIAMETER)));
    }
    run.figure(Figure::new("exponent of L + 1.02 D by heat", "", 0.4, exponent(&found), Allowed::Difference(0.05)));
    let law = [15.0, 250.0].map(|q: f64| (q, 0.235 * q.powf(0.4))).to_vec();
    run.chart(Chart::of_law("Height of methane on 0.4 m", ["kW", "L + 1.02 D, m"], ("Heskestad", law), found));
    Ok(())
}
