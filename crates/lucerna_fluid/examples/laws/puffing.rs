//! How often a plume puffs: the frequency at which the air on the axis swings half a diameter up.

use std::f32::consts::FRAC_PI_4;

use lucerna_fluid::{
    AIR_GAS_CONSTANT_J_KG_K, AIR_HEAT_CAPACITY_J_KG_K, AIR_PRESSURE_PA, Combustion, Density, Fluid, FluidBuilder, Fuel,
    ScalarSource, Side, Sides, Source, Vec3,
};

use crate::disk::disk;
use crate::signal::strongest_hz;
use crate::{Off, Outcome, Row};

/// Cells across a burner, and of the box.
const ACROSS: f32 = 10.0;
const CELLS: [usize; 3] = [30, 40, 30];
/// Step, start and end of what counts, for a burner of a metre; times go as the root of its width.
const STEP_S: f32 = 0.01;
const TIMES_S: [f32; 2] = [4.0, 16.0];
/// Swings of less than this share of the mean are noise.
const PUFFS: f64 = 0.1;

/// Air over a round burner on the floor, open all around and above.
struct Burner {
    builder: FluidBuilder,
    foot: Vec3,
    diameter_m: f32,
    cell_m: f32,
}

/// What was found: the frequency, and the root mean square of the swings over the mean.
struct Swings {
    hz: f64,
    share: f64,
}

impl Burner {
    fn new(diameter_m: f32) -> Self {
        let cell_m = diameter_m / ACROSS;
        let size = cell_m * Vec3::from_array(CELLS.map(|cells| cells as f32));
        // A little off the middle: the flow would stay mirror-symmetric otherwise.
        let foot = 0.5 * Vec3::new(size.x, 0.0, size.z) + cell_m * Vec3::new(0.5, 0.0, -0.27);
        let builder = Fluid::builder(CELLS)
            .size_m(size)
            .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
            .density(Density::LowMach)
            .smagorinsky(0.1);
        Self { builder, foot, diameter_m, cell_m }
    }

    fn run(self, source: impl FnOnce(&Fluid) -> Outcome<Source>) -> Outcome<Swings> {
        let Self { builder, foot, diameter_m, .. } = self;
        let mut air = builder.build()?;
        let source = source(&air)?;
        air.attach_source(source)?;
        let slow = diameter_m.sqrt();
        let dt_s = STEP_S * slow;
        let [start, end] = TIMES_S.map(|time| (time / STEP_S) as usize);
        let probe = foot + 0.5 * diameter_m * Vec3::Y;
        let mut speeds = Vec::with_capacity(end - start);
        for step in 0..end {
            air.step(dt_s)?;
            if step >= start {
                speeds.push(f64::from(air.velocity(probe).y));
            }
        }
        let count = speeds.len() as f64;
        let mean = speeds.iter().sum::<f64>() / count;
        let rms = (speeds.iter().map(|speed| (speed - mean).powi(2)).sum::<f64>() / count).sqrt();
        let band_hz = [0.4, 6.0].map(|hz| hz / f64::from(slow));
        Ok(Swings { hz: strongest_hz(&speeds, f64::from(dt_s), band_hz), share: rms / mean })
    }

    fn shape(&self) -> lucerna_fluid::Shape {
        disk(self.foot, self.diameter_m, self.cell_m)
    }
}

fn row(law: String, published: f64, Swings { hz, share }: Swings) -> Row {
    let word = if share < PUFFS { ", does not puff" } else { "" };
    let note = format!("(swings by {:.0} % of the mean{word})", 100.0 * share);
    // A swing that is none has no frequency.
    Row { law, published, found: if share < PUFFS { 0.0 } else { hz }, allowed: Off::Percent(15.0), note }
}

/// The helium plume of a metre of T. O'Hern et al., J. Fluid Mech. 544 (2005): gas 0.185 times as
/// dense as air, let in at 0.325 m/s, puffs at 1.37 Hz.
pub(crate) fn light_plume(rows: &mut Vec<Row>) -> Outcome<()> {
    const LIGHTER: f32 = 0.815;
    const SPEED_M_S: f32 = 0.325;
    let burner = Burner::new(1.0);
    let shape = burner.shape();
    let gas_m3_s = SPEED_M_S * FRAC_PI_4;
    // Cold air of the share that has weight, and heat that expands it to all of the volume.
    let kilowatts_m3_s = 1.0e-3 * AIR_PRESSURE_PA * AIR_HEAT_CAPACITY_J_KG_K / AIR_GAS_CONSTANT_J_KG_K;
    let found = burner.run(|_| {
        Ok(Source {
            heat_kw: LIGHTER * gas_m3_s * kilowatts_m3_s,
            inflow_m3_s: (1.0 - LIGHTER) * gas_m3_s,
            ..Source::new(shape)
        })
    })?;
    rows.push(row("puffing of a light plume of 1 m, Hz".into(), 1.37, found));
    Ok(())
}

/// Methane on burners of four sizes, 1110 D^2.5 kW, against 1.5 / sqrt(D) (B. Cetegen, T. Ahmed,
/// Combustion and Flame 93, 1993). The grid grows with the burner.
pub(crate) fn burners(rows: &mut Vec<Row>) -> Outcome<()> {
    const METHANE_KG_M3: f32 = 0.667;
    let fuel = Fuel { radiated: 0.0, ..Fuel::METHANE };
    for diameter_m in [0.1_f32, 0.2, 0.4, 0.8] {
        let kilowatts = 1110.0 * diameter_m.powf(2.5);
        let mut burner = Burner::new(diameter_m);
        burner.builder = burner.builder.combustion(Combustion::new(fuel));
        let shape = burner.shape();
        let found = burner.run(|air| {
            let kg_s = kilowatts / fuel.heat_kj_kg;
            let scalar = air.scalar_id("fuel").ok_or("no fuel")?;
            Ok(Source {
                inflow_m3_s: kg_s / METHANE_KG_M3,
                scalars: vec![ScalarSource { kg_s, ..ScalarSource::new(scalar) }],
                ..Source::new(shape)
            })
        })?;
        let law = format!("puffing of {kilowatts:.0} kW on {diameter_m} m, Hz");
        rows.push(row(law, 1.5 / f64::from(diameter_m).sqrt(), found));
    }
    Ok(())
}
