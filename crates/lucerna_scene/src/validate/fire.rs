//! Whether a fire is allowed: its wicks, fuel, particle chains, surface and shading.

use super::{Check, placed};
use crate::model::Placement;
use crate::{Air, Fire, SceneError, WickSource};
use lucerna_flame::{FlameError, Fuel, FuelDistribution, Skeletons, SurfaceGrid, Swing, WickLook};
use lucerna_frame::FlameShade;

/// Most wicks of one fire.
const MAX_WICKS: usize = 64;

/// Most points of one wick.
const MAX_POINTS: usize = 1024;

/// Most samples of a fuel table.
const MAX_SAMPLES: usize = 4096;

pub(super) fn fire(check: &Check<'_>, air: &Air, field: &str, fire: &Fire) -> Result<(), SceneError> {
    if !(1..=MAX_WICKS).contains(&fire.wicks.len()) {
        let counted = format!("the number of {field}.wicks");
        return Err(check.fail(counted, fire.wicks.len(), format!("1 to {MAX_WICKS}")));
    }
    super::copies(check, field, &fire.at, &fire.turns_deg)?;
    super::air::of_fire(check, field, fire)?;
    for (index, source) in fire.wicks.iter().enumerate() {
        wick(check, air, fire, &format!("{field}.wicks[{index}]"), source)?;
    }
    let life = fire.drive.check().and_then(|()| fire.life.check(&fire.drive));
    life.map_err(|error| refused(check, field, &error))?;
    fuel(check, &format!("{field}.fuel"), &fire.fuel)?;
    skeletons(check, &format!("{field}.skeletons"), &fire.skeletons)?;
    surface(check, &format!("{field}.surface"), &fire.surface)?;
    shade(check, &format!("{field}.shade"), &fire.shade)?;
    wick_look(check, &format!("{field}.wick"), &fire.wick)
}

fn wick_look(check: &Check<'_>, field: &str, look: &WickLook) -> Result<(), SceneError> {
    if let Some(radius_m) = look.radius_m {
        check.within(&format!("{field}.radius_m"), radius_m, 1.0e-6..=10.0)?;
    }
    check.each(&format!("{field}.char_color"), &look.char_color, &(0.0..=1.0))?;
    check.within(&format!("{field}.tip_k"), look.tip_k, 500.0..=3000.0)
}

/// What a flame says of its own settings, as a scene says it.
fn refused(check: &Check<'_>, fire: &str, error: &FlameError) -> SceneError {
    match error {
        FlameError::OutOfRange { field, value, allowed } => check.fail(format!("{fire}.{field}"), value, *allowed),
        FlameError::Supply { unit } => {
            check.fail(format!("{fire}.life.supply"), unit, "seconds, as the drive is root_forces")
        }
        other => check.fail(fire, other, "what flames take"),
    }
}

fn wick(check: &Check<'_>, air: &Air, fire: &Fire, field: &str, wick: &WickSource) -> Result<(), SceneError> {
    let radius = |radius_m: f32| check.within(&format!("{field}.radius_m"), radius_m, 1.0e-6..=10.0);
    match wick {
        WickSource::Polyline { points, radius_m } | WickSource::Curve { points, radius_m, .. } => {
            wick_points(check, air, fire, field, points)?;
            if points.len() > 1 && points.iter().all(|point| *point == points[0]) {
                return Err(check.fail(format!("{field}.points"), "of no length", "one point, or points that differ"));
            }
            radius(*radius_m)
        }
        WickSource::Points { points, radius_m } => {
            wick_points(check, air, fire, field, points)?;
            radius(*radius_m)
        }
        WickSource::Ring { center_m, ring_m, normal, radius_m } => {
            super::wick_inside_air(check, air, fire, &format!("{field}.center_m"), &[*center_m])?;
            check.within(&format!("{field}.ring_m"), *ring_m, 1.0e-5..=100.0)?;
            check.each(&format!("{field}.normal"), normal, &(-1.0e3..=1.0e3))?;
            if normal.iter().all(|x| x.abs() < 1.0e-6) {
                return Err(check.fail(format!("{field}.normal"), "of no length", "a direction"));
            }
            radius(*radius_m)
        }
        WickSource::Mesh { file, position_m, rotation_deg, scale, gap_m, .. } => {
            if let Some(gap_m) = gap_m {
                check.within(&format!("{field}.gap_m"), *gap_m, 1.0e-6..=1.0e3)?;
            }
            let placement = Placement { position_m: *position_m, rotation_deg: *rotation_deg, scale: *scale };
            placed(check, field, file, &placement)
        }
    }
}

fn wick_points(check: &Check<'_>, air: &Air, fire: &Fire, field: &str, points: &[[f32; 3]]) -> Result<(), SceneError> {
    if !(1..=MAX_POINTS).contains(&points.len()) {
        let counted = format!("the number of {field}.points");
        return Err(check.fail(counted, points.len(), format!("1 to {MAX_POINTS}")));
    }
    for (index, point) in points.iter().enumerate() {
        super::wick_inside_air(check, air, fire, &format!("{field}.points[{index}]"), &[*point])?;
    }
    Ok(())
}

fn fuel(check: &Check<'_>, field: &str, fuel: &Fuel) -> Result<(), SceneError> {
    if let FuelDistribution::Table(samples) = &fuel.distribution {
        let table = format!("{field}.distribution table");
        if !(2..=MAX_SAMPLES).contains(&samples.len()) {
            let counted = format!("the number of samples of {table}");
            return Err(check.fail(counted, samples.len(), format!("2 to {MAX_SAMPLES}")));
        }
        check.each(&table, samples, &(0.0..=1000.0))?;
    }
    check.within(&format!("{field}.strength_m_s2"), fuel.strength_m_s2, 0.0..=100_000.0)?;
    check.within(&format!("{field}.heat_k_s"), fuel.heat_k_s, 0.0..=1_000_000.0)?;
    let (amplitude, frequency_hz) = match fuel.swing {
        Swing::Still => return Ok(()),
        Swing::Random { amplitude } => (amplitude, None),
        Swing::Periodic { amplitude, frequency_hz } | Swing::Noise { amplitude, frequency_hz } => {
            (amplitude, Some(frequency_hz))
        }
    };
    check.within(&format!("{field}.swing.amplitude"), amplitude, 0.0..=100.0)?;
    match frequency_hz {
        Some(hertz) => check.above_zero(&format!("{field}.swing.frequency_hz"), hertz, 1000.0),
        None => Ok(()),
    }
}

fn skeletons(check: &Check<'_>, field: &str, skeletons: &Skeletons) -> Result<(), SceneError> {
    let of = |name: &str| format!("{field}.{name}");
    check.within(&of("slices"), skeletons.slices, 1..=64)?;
    check.within(&of("particles"), skeletons.particles, 3..=32)?;
    check.within(&of("peripheral_life_s"), skeletons.peripheral_life_s, 0.001..=60.0)?;
    check.within(&of("lead_life_s"), skeletons.lead_life_s, 0.001..=60.0)?;
    if skeletons.lead_life_s < skeletons.peripheral_life_s {
        let allowed = format!("at least peripheral_life_s, {}", skeletons.peripheral_life_s);
        return Err(check.fail(of("lead_life_s"), skeletons.lead_life_s, allowed));
    }
    check.within(&of("width_m"), skeletons.width_m, 1.0e-5..=10.0)?;
    check.within(&of("expansion_m_s"), skeletons.expansion_m_s, 0.0..=100.0)?;
    check.each(&of("lead_sway_s"), &skeletons.lead_sway_s, &(-10.0..=10.0))?;
    check.each(&of("peripheral_sway_s"), &skeletons.peripheral_sway_s, &(-10.0..=10.0))?;
    check.within(&of("shed_per_s"), skeletons.shed_per_s, 0.0..=100.0)?;
    check.within(&of("free_life_s"), skeletons.free_life_s, 0.001..=60.0)?;
    check.within(&of("taper"), skeletons.taper, 0.0..=1.0)?;
    check.within(&of("turbulence_m_s"), skeletons.turbulence_m_s, 0.0..=100.0)?;
    check.within(&of("turbulence_m"), skeletons.turbulence_m, 0.0001..=100.0)
}

fn surface(check: &Check<'_>, field: &str, surface: &SurfaceGrid) -> Result<(), SceneError> {
    let around = format!("{field}.around");
    if !surface.around.is_multiple_of(2) || !(4..=256).contains(&surface.around) {
        return Err(check.fail(around, surface.around, "an even number, 4 to 256"));
    }
    check.within(&format!("{field}.up"), surface.up, 3..=256)?;
    check.within(&format!("{field}.tip_softness"), surface.tip_softness, 0.0..=1.0)
}

fn shade(check: &Check<'_>, field: &str, shade: &FlameShade) -> Result<(), SceneError> {
    let of = |name: &str| format!("{field}.{name}");
    check.each(&of("tint"), &shade.tint, &(0.0..=1000.0))?;
    check.within(&of("soot_per_m"), shade.soot_per_m, 0.0..=100_000.0)?;
    check.within(&of("temperature_k"), shade.temperature_k, 500.0..=10_000.0)?;
    check.within(&of("soot_begin"), shade.soot_begin, 0.0..=1.0)?;
    check.within(&of("soot_full"), shade.soot_full, 0.0..=1.0)?;
    if shade.soot_full < shade.soot_begin {
        return Err(check.fail(of("soot_full"), shade.soot_full, format!("at least soot_begin, {}", shade.soot_begin)));
    }
    check.within(&of("tip_fade"), shade.tip_fade, 0.0..=1.0)?;
    check.within(&of("blue_per_m"), shade.blue_per_m, 0.0..=100_000.0)?;
    check.within(&of("blue_end"), shade.blue_end, 0.0..=1.0)?;
    check.within(&of("dark_radius"), shade.dark_radius, 0.0..=1.0)?;
    check.within(&of("dark_end"), shade.dark_end, 0.0..=1.0)?;
    check.within(&of("noise_amount"), shade.noise_amount, 0.0..=1.0)?;
    check.within(&of("noise_per_m"), shade.noise_per_m, 0.0..=10_000.0)?;
    check.within(&of("noise_rise_m_s"), shade.noise_rise_m_s, 0.0..=100.0)?;
    check.within(&of("strength"), shade.strength, 0.0..=1.0)
}
