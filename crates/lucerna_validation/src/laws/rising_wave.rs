//! Light gas under air: the instability of Rayleigh and Taylor.

use std::f32::consts::PI;

use lucerna_fluid::{Fluid, GRAVITY_M_S2, Side, Sides, Vec3};

use crate::air::schemes;
use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};

pub(crate) const RISING_WAVE: Experiment = Experiment {
    name: "rising_wave",
    title: "Light gas under air",
    law: "a small wave grows at sqrt(A g k), A the difference of the densities over their sum",
    source: "G. I. Taylor, The Instability of Liquid Surfaces when Accelerated in a Direction Perpendicular to their \
             Planes, Proc. R. Soc. A 201, 1950",
    origin: Origin::Emergent,
    measures: "Height of a wave of 2 m on a layer at rest, until it is four times as high.",
    short: Some("32 cells across half a wave"),
    long: "32 and 64 cells across half a wave",
    burn,
};

/// What light gas lacks of the density of air, and a step that resolves its rise.
const CASES: [(f32, f32); 3] = [(0.1, 0.005), (0.5, 0.005), (0.815, 0.0025)];

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    let grids: &[usize] = run.choose(&[32], &[32, 64]);
    let mut lines = Vec::new();
    for (at, across) in grids.iter().enumerate() {
        let mut points = Vec::new();
        for (case, (share, dt_s)) in CASES.into_iter().enumerate() {
            run.part(at * CASES.len() + case, grids.len() * CASES.len());
            let atwood = f64::from(share / (2.0 - share));
            let law = (atwood * f64::from(GRAVITY_M_S2 * PI)).sqrt();
            let found = growth_per_s(run, *across, share, law, dt_s * 32.0 / *across as f32)?;
            points.push((atwood, found));
            if at + 1 == grids.len() {
                let times = 1.0 / (1.0 - share);
                let what = format!("growth, air {times:.2} times as dense");
                run.figure(Figure::new(what, "1/s", law, found, Allowed::Percent(4.0)));
            }
        }
        lines.push(Series { name: format!("{across} cells"), mark: Mark::Points, points });
    }
    let law = (0..=40).map(|at| 0.02 * f64::from(at)).map(|a| (a, (a * f64::from(GRAVITY_M_S2 * PI)).sqrt())).collect();
    lines.insert(0, Series { name: "Taylor".into(), mark: Mark::Dashes, points: law });
    run.chart(Chart {
        title: "Growth of a wave on light gas".into(),
        x: Axis::linear("A"),
        y: Axis::linear("growth, 1/s"),
        series: lines,
    });
    Ok(())
}

/// It starts at rest, and so goes as the hyperbolic cosine. Two ends a metre away take a part in 500 off.
fn growth_per_s(run: &mut Run<'_>, across: usize, share: f32, law_per_s: f64, dt_s: f32) -> Result<f64, Halt> {
    let cell_m = 1.0 / across as f32;
    let mut air = schemes(Fluid::builder([across, 2 * across, 1]))
        .size_m(Vec3::new(1.0, 2.0, cell_m))
        .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::CLOSED })
        .build()?;
    let ambient_k = air.ambient_k();
    air.fill_temperature(|point| {
        let top_m = 1.0 + 0.01 * (PI * point.x).cos();
        let share = share * ((top_m - point.y) / cell_m + 0.5).clamp(0.0, 1.0);
        ambient_k * share / (1.0 - share)
    })?;
    let start_m = wave_m(&air, f64::from(share));
    let steps = (4.0_f64.acosh() / law_per_s / f64::from(dt_s)).round();
    run.steps(&mut air, dt_s, steps as usize, |_, _, _| {})?;
    Ok((wave_m(&air, f64::from(share)) / start_m).acosh() / (steps * f64::from(dt_s)))
}

/// Height of the wave, m: the part of `dT / T` that goes as a cosine.
fn wave_m(air: &Fluid, share: f64) -> f64 {
    let across = air.cells()[0];
    let part = air.temperatures().iter().enumerate().map(|(cell, kelvin)| {
        let x = ((cell % across) as f64 + 0.5) / across as f64;
        f64::from(kelvin / (air.ambient_k() + kelvin)) * (f64::from(PI) * x).cos()
    });
    2.0 * part.sum::<f64>() / (share * (across * across) as f64)
}
