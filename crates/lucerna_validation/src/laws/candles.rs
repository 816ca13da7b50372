//! Candles: one burns steadily, three beside each other flicker, and two such groups lock their phases.

use std::f32::consts::TAU;

use lucerna_fluid::{AIR_HEAT_CAPACITY_J_KG_K, Combustion, Fluid, Fuel, ScalarId, ScalarSource, Shape, Source, Vec3};

use crate::air::candle_air;
use crate::chart::{Axis, Chart, Mark, Series};
use crate::experiment::{Experiment, Halt, Origin, Run};
use crate::figure::{Allowed, Figure};
use crate::signal::{Peak, correlation, spectrum, strongest};

pub(crate) const CANDLES: Experiment = Experiment {
    name: "candles",
    title: "One candle, and three beside each other",
    law: "one is steady, 2 to 5 cm high; three flicker at 5 to 15 Hz",
    source: "A. Gergely et al., Flickering Candle Flames and their Collective Behavior, Scientific Reports 10, 2020; H. \
             Kitahata et al., Oscillation and Synchronization in the Combustion of Candles, J. Phys. Chem. A 113, 2009; A. \
             Hamins et al., Characterization of Candle Flames, J. Fire Prot. Eng. 15, 2005: 77 W, 4.2 cm",
    origin: Origin::Emergent,
    measures: "Wicks that give off wax for 40 W each, as thin candles do, 6 mm from the middle of a group; height up to which \
               there is fuel enough to warm the gas by 100 K, speed of the air 5 cm above the floor. Viscosity and conduction \
               are those of hot air, no eddies are modelled. One of 80 W, a thick candle's heat, is told of beside them: here \
               it is past the onset of flicker.",
    short: None,
    long: "cells of 2 mm, box of 4.8 x 14.4 x 4.8 cm, 0.6 to 1.6 s",
    burn: one_and_three,
};

pub(crate) const CANDLE_PAIRS: Experiment = Experiment {
    name: "candle_pairs",
    title: "Two groups of three candles",
    law: "in phase 2 cm apart, in anti-phase farther apart",
    source: "H. Kitahata et al., J. Phys. Chem. A 113, 2009; A. Gergely et al., Scientific Reports 10, 2020",
    origin: Origin::Emergent,
    measures: "Candles as above, the second group lit half a period after the first. Correlation of the speeds 5 cm above \
               the floor in the two flames: 1 in phase, -1 in anti-phase.",
    short: None,
    long: "cells of 2.5 mm, box of 12 x 12 x 5 cm, 0.6 to 2 s each",
    burn: pairs,
};

/// A thin candle's heat, kW: 0.055 g of wax a minute.
const CANDLE_KW: f32 = 0.04;
/// A thick one's.
const THICK_KW: f32 = 0.08;
/// From the middle of a group to each of its wicks, m.
const RING_M: f32 = 0.006;
/// Height of the wicks' feet above the floor, and their thickness and length, m.
const LIFT_M: f32 = 0.01;
const WICK_M: [f32; 2] = [0.004, 0.006];
/// Gas burns that holds fuel enough to warm it by this much more, K.
const BURNING_K: f32 = 100.0;
/// Where the speed is taken, m above the floor.
const PROBE_M: f32 = 0.05;
/// How much later the second group is lit, s.
const LATER_S: f32 = 0.05;
const BAND_HZ: [f64; 2] = [3.0, 30.0];

/// What was seen of a group.
struct Group {
    heights_m: Vec<f64>,
    speeds_m_s: Vec<f64>,
}

/// Burns groups of candles, at places along x; each is seen every step from the start of what counts.
fn burn(
    run: &mut Run<'_>,
    (cells, cell_m): ([usize; 3], f32),
    (candles, candle_kw): (u32, f32),
    places_m: &[f32],
    (dt_s, times_s): (f32, [f32; 2]),
) -> Result<Vec<Group>, Halt> {
    let mut air = candle_air(cells, cell_m).combustion(Combustion::new(Fuel::WAX)).build()?;
    let Some(fuel) = air.scalar_id("fuel") else { return Err(Halt::Stopped) };
    let off = cell_m * Vec3::new(0.23, 0.0, -0.17);
    let feet: Vec<Vec3> = places_m.iter().map(|place| *place * Vec3::X + off).collect();
    let light = |air: &mut Fluid, foot: Vec3| -> Result<(), Halt> {
        for candle in 0..candles {
            let (sin, cos) = (TAU * candle as f32 / candles as f32 + 0.3).sin_cos();
            let ring = if candles > 1 { RING_M * Vec3::new(cos, 0.0, sin) } else { Vec3::ZERO };
            let low = foot + ring + LIFT_M * Vec3::Y;
            let half = 0.5 * WICK_M[0] * Vec3::new(1.0, 0.0, 1.0);
            let kg_s = candle_kw / Fuel::WAX.heat_kj_kg;
            air.attach_source(Source {
                // Vapour of 352 g/mol at 700 K.
                inflow_m3_s: kg_s / 6.1,
                scalars: vec![ScalarSource { kg_s, ..ScalarSource::new(fuel) }],
                ..Source::new(Shape::Box { low: low - half, high: low + half + WICK_M[1] * Vec3::Y })
            })?;
        }
        Ok(())
    };
    light(&mut air, feet[0])?;
    // A breath, so that nothing stays symmetric by itself.
    let breath = Shape::Sphere { centre: feet[0] + 0.02 * Vec3::Y, radius_m: 0.01 };
    air.add_source(&Source { acceleration_m_s2: Vec3::new(1.0, 0.0, 0.7), ..Source::new(breath) })?;
    let mut groups: Vec<Group> = feet.iter().map(|_| Group { heights_m: Vec::new(), speeds_m_s: Vec::new() }).collect();
    let [start, end] = times_s.map(|time| (time / dt_s) as usize);
    // Half a period apart, so that being lit together is not what keeps them together.
    for foot in &feet[1..] {
        run.steps(&mut air, dt_s, (LATER_S / dt_s) as usize, |_, _, _| {})?;
        light(&mut air, *foot)?;
    }
    run.steps(&mut air, dt_s, end, |step, air, _| {
        if step >= start {
            for (at, (group, foot)) in groups.iter_mut().zip(&feet).enumerate() {
                group.heights_m.push(height_m(air, fuel, at, feet.len()));
                group.speeds_m_s.push(f64::from(air.velocity(*foot + PROBE_M * Vec3::Y).y));
            }
        }
    })?;
    Ok(groups)
}

/// Height of the flame in one of `count` equal parts of the box along x, above the wicks' feet, m: where the richest gas
/// of a height ceases to burn, straight between the cells.
fn height_m(air: &Fluid, fuel: ScalarId, part: usize, count: usize) -> f64 {
    let least = BURNING_K * 1.0e-3 * AIR_HEAT_CAPACITY_J_KG_K / Fuel::WAX.heat_kj_kg;
    let [nx, ny, _] = air.cells();
    let from = part * nx / count..(part + 1) * nx / count;
    let mut richest = vec![0.0_f32; ny];
    for (cell, share) in air.scalar_values(fuel).enumerate() {
        if from.contains(&(cell % nx)) {
            let most = &mut richest[cell / nx % ny];
            *most = most.max(share);
        }
    }
    let Some(last) = richest.iter().rposition(|share| *share >= least) else { return 0.0 };
    let next = richest.get(last + 1).copied().unwrap_or(0.0);
    let part = f64::from((richest[last] - least) / (richest[last] - next));
    (last as f64 + 0.5 + part) * f64::from(air.cell_size_m().y) - f64::from(LIFT_M)
}

fn peak(values: &[f64], dt_s: f32) -> Peak {
    strongest(values, f64::from(dt_s), BAND_HZ)
}

fn one_and_three(run: &mut Run<'_>) -> Result<(), Halt> {
    let (grid, dt_s, times_s) = (([24, 72, 24], 0.002), 0.0016_f32, [0.6, 1.6]);
    let mut signals = Vec::new();
    let mut spectra = Vec::new();
    let cases = [("one", 1, CANDLE_KW), ("three", 3, CANDLE_KW), ("one of 80 W", 1, THICK_KW)];
    for (at, (name, candles, candle_kw)) in cases.into_iter().enumerate() {
        run.part(at, cases.len());
        let groups = burn(run, grid, (candles, candle_kw), &[0.0], (dt_s, times_s))?;
        let Group { heights_m, speeds_m_s } = &groups[0];
        let (height, speed) = (peak(heights_m, dt_s), peak(speeds_m_s, dt_s));
        let centimetres = 100.0 * height.mean;
        if at == 2 {
            let note = format!("height {centimetres:.1} cm, strongest at {:.1} Hz", height.hz);
            let figure =
                Figure::new("one of 80 W: swings of its height", "%", f64::NAN, 100.0 * height.share(), Allowed::Any);
            run.figure(figure.noted(note));
        } else if candles == 1 {
            run.figure(Figure::new("one: height above the wick's foot", "cm", 2.0, centimetres, Allowed::UpTo(5.0)));
            let note = format!("strongest at {:.1} Hz", height.hz);
            let figure = Figure::new("one: swings of its height", "%", 3.0, 100.0 * height.share(), Allowed::Below);
            run.figure(figure.noted(note));
        } else {
            run.figure(Figure::new("three: mean height", "cm", f64::NAN, centimetres, Allowed::Any));
            let found = if height.share() > 0.03 { speed.hz } else { f64::NAN };
            let note = format!("height swings by {:.0} %, peak {:.1} Hz wide", 100.0 * height.share(), speed.width_hz);
            run.figure(Figure::new("three: flicker", "Hz", 5.0, found, Allowed::UpTo(15.0)).noted(note));
            run.figure(Figure::new("three: measured flicker of a triplet", "Hz", 9.9, found, Allowed::Any));
        }
        let points = heights_m.iter().enumerate().map(|(at, height)| (f64::from(dt_s) * at as f64, 100.0 * height));
        signals.push(Series { name: name.into(), mark: Mark::Line, points: points.collect() });
        let points = spectrum(speeds_m_s, f64::from(dt_s), BAND_HZ);
        let most = points.iter().map(|point| point.1).fold(f64::MIN_POSITIVE, f64::max);
        let points = points.into_iter().map(|(hz, power)| (hz, power / most)).collect();
        spectra.push(Series { name: name.into(), mark: Mark::Line, points });
    }
    run.chart(Chart {
        title: "Heights of candle flames".into(),
        x: Axis::linear("time, s"),
        y: Axis::linear("cm"),
        series: signals,
    });
    run.chart(Chart {
        title: "Spectra of the speed in them".into(),
        x: Axis::linear("Hz"),
        y: Axis::linear("power, over its highest"),
        series: spectra,
    });
    Ok(())
}

fn pairs(run: &mut Run<'_>) -> Result<(), Halt> {
    let (grid, dt_s, times_s) = (([48, 48, 20], 0.0025), 0.002_f32, [0.6, 2.0]);
    let gaps = [0.02_f32, 0.03, 0.045, 0.06];
    let (mut alike, mut rates) = (Vec::new(), Vec::new());
    for (at, gap) in gaps.into_iter().enumerate() {
        run.part(at, gaps.len());
        let groups = burn(run, grid, (3, CANDLE_KW), &[-0.5 * gap, 0.5 * gap], (dt_s, times_s))?;
        let found = correlation(&groups[0].speeds_m_s, &groups[1].speeds_m_s);
        let peaks = [0, 1].map(|group| peak(&groups[group].speeds_m_s, dt_s));
        let what = format!("{:.1} cm apart: correlation", 100.0 * gap);
        let note = format!(
            "{:.1} and {:.1} Hz, swings of {:.0} and {:.0} %",
            peaks[0].hz,
            peaks[1].hz,
            100.0 * peaks[0].share(),
            100.0 * peaks[1].share()
        );
        let figure = match at {
            0 => Figure::new(what, "", 0.5, found, Allowed::UpTo(1.0)),
            3 => Figure::new(what, "", -1.0, found, Allowed::UpTo(-0.5)),
            _ => Figure::new(what, "", f64::NAN, found, Allowed::Any),
        };
        run.figure(figure.noted(note));
        alike.push((f64::from(100.0 * gap), found));
        rates.push((f64::from(100.0 * gap), peaks[0].hz));
    }
    run.chart(Chart {
        title: "Two groups of three candles".into(),
        x: Axis::linear("apart, cm"),
        y: Axis::linear("correlation"),
        series: vec![Series { name: "found".into(), mark: Mark::Points, points: alike }],
    });
    run.chart(Chart {
        title: "Their flicker".into(),
        x: Axis::linear("apart, cm"),
        y: Axis::linear("Hz"),
        series: vec![Series { name: "found".into(), mark: Mark::Points, points: rates }],
    });
    Ok(())
}
