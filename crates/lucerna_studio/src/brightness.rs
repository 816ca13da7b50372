//! An experiment on the picture: its brightness pulses as the air puffs.

use std::path::Path;

use glam::Vec3;
use lucerna::World;
use lucerna::scene::{LoadedScene, parse};
use lucerna_validation::{
    Allowed, Axis, Chart, Experiment, Figure, Halt, Mark, Origin, Run, Series, spectrum, strongest,
};

use crate::gpu::Gpu;
use crate::light_meter::LightMeter;

/// The rendered brightness of a pan fire against the motion of its air.
pub const BRIGHTNESS: Experiment = Experiment {
    name: "brightness",
    title: "The picture of 55 kW of methane on 0.3 m",
    law: "its brightness pulses as often as the air puffs",
    source: "a flame's light is that of its gas",
    origin: Origin::Emergent,
    measures: "Mean luminance of the rendered picture, the speed of the air on the axis half a diameter up, and the volume \
               of the drawn flame, every step; a world as scenes have it, fuel at an even rate. 1.5 / sqrt(D) is of B. \
               Cetegen, T. Ahmed, Combustion and Flame 93, 1993.",
    short: None,
    long: "12 cells across, box of 3 x 4 x 3 diameters, 2.2 to 12.2 s, pictures of 96 x 96",
    burn,
};

const SCENE: &str = include_str!("brightness.ron");
/// Of the pan in the scene.
const DIAMETER_M: f32 = 0.3;
/// The middle of the pan, as the scene has it.
const FOOT: Vec3 = Vec3::new(0.00575, 0.0, -0.00425);
const SIZE_PX: [u32; 2] = [96; 2];
/// When the fire has settled, and the end.
const TIMES_S: [f64; 2] = [2.2, 12.2];

/// What is looked at.
#[derive(Default)]
struct Signals {
    luminance: Vec<f64>,
    speed_m_s: Vec<f64>,
    volume_m3: Vec<f64>,
}

fn burn(run: &mut Run<'_>) -> Result<(), Halt> {
    let (signals, dt_s) = watch(run)?;
    let root = f64::from(DIAMETER_M).sqrt();
    let band_hz = [0.4, 6.0].map(|hz| hz / root);
    let peak = |values: &[f64]| strongest(values, dt_s, band_hz);
    let [air, light, volume] = [&signals.speed_m_s, &signals.luminance, &signals.volume_m3].map(|signal| peak(signal));
    for (what, published, found, allowed) in [
        ("brightness, against the air", air.hz, light, 10.0),
        ("volume of the drawn flame, against the air", air.hz, volume, 10.0),
        ("the air, against 1.5 / sqrt(D)", 1.5 / root, air, 15.0),
    ] {
        let note = format!("swings by {:.0} % of the mean, peak {:.2} Hz wide", 100.0 * found.share(), found.width_hz);
        run.figure(Figure::new(what, "Hz", published, found.hz, Allowed::Percent(allowed)).noted(note));
    }
    let lines = [("air", signals.speed_m_s), ("brightness", signals.luminance)];
    let shown = (12.0 * root / 1.5 / dt_s) as usize;
    chart(run, "Speed on the axis, and brightness", ["time, s", "over the mean"], &lines, |signal| {
        let mean = signal.iter().sum::<f64>() / signal.len() as f64;
        let last = signal.iter().skip(signal.len().saturating_sub(shown)).enumerate();
        last.map(|(at, value)| (dt_s * at as f64, value / mean)).collect()
    });
    chart(run, "Their spectra", ["Hz", "power"], &lines, |signal| {
        let mut powers = spectrum(signal, dt_s, band_hz);
        let most = powers.iter().map(|point| point.1).fold(f64::MIN_POSITIVE, f64::max);
        powers.iter_mut().for_each(|point| point.1 /= most);
        powers
    });
    Ok(())
}

fn chart(
    run: &mut Run<'_>,
    title: &str,
    [x, y]: [&str; 2],
    lines: &[(&str, Vec<f64>)],
    points: impl Fn(&[f64]) -> Vec<(f64, f64)>,
) {
    let line =
        |(name, signal): &(&str, Vec<f64>)| Series { name: (*name).into(), mark: Mark::Line, points: points(signal) };
    let series = lines.iter().map(line).collect();
    run.chart(Chart { title: title.into(), x: Axis::linear(x), y: Axis::linear(y), series });
}

/// Burns the pan, and looks at it after every step; the step's length, s.
fn watch(run: &mut Run<'_>) -> Result<(Signals, f64), Halt> {
    let gpu = Gpu::open().map_err(Halt::other)?;
    let mut meter = LightMeter::new(&gpu, SIZE_PX).map_err(Halt::other)?;
    let scene = parse(SCENE, Path::new("brightness.ron")).map_err(Halt::other)?;
    let step_s = scene.air.time_step_s;
    let cells = scene.air.cells.iter().map(|n| *n as usize).product();
    let loaded = LoadedScene::from_scene(scene, Path::new("")).map_err(Halt::other)?;
    let mut world = World::new(loaded).map_err(Halt::other)?;
    let mut signals = Signals::default();
    let probe = FOOT + 0.5 * DIAMETER_M * Vec3::Y;
    while world.time_s() < TIMES_S[1] {
        run.done(world.time_s() / TIMES_S[1])?;
        let step = world.step(step_s).map_err(Halt::other)?;
        run.count(cells, step.cell_steps);
        if world.time_s() >= TIMES_S[0] {
            signals.luminance.push(meter.read(&gpu, &world).map_err(Halt::other)?);
            signals.speed_m_s.push(f64::from(world.fluid().velocity(probe).y));
            signals.volume_m3.push(world.flames().flame_lights().iter().map(|flame| f64::from(flame.volume_m3)).sum());
        }
    }
    Ok((signals, f64::from(step_s)))
}
