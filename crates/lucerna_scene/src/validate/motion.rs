//! Whether motions are allowed, and whether those that are named exist.

use super::{Check, FAR_M};
use crate::{MotionPath, Scene, SceneError};

/// Most motions of a scene.
const MAX_MOTIONS: usize = 64;
/// Most keys of a motion.
const MAX_KEYS: usize = 4096;

pub(super) fn motions(check: &Check<'_>, scene: &Scene) -> Result<(), SceneError> {
    let motions = &scene.motions;
    if motions.len() > MAX_MOTIONS {
        return Err(check.fail("the number of motions", motions.len(), format!("at most {MAX_MOTIONS}")));
    }
    for (index, motion) in motions.iter().enumerate() {
        let field = format!("motions[{index}]");
        if motion.name.is_empty() || motions[..index].iter().any(|other| other.name == motion.name) {
            let value = format!("`{}`", motion.name);
            return Err(check.fail(format!("{field}.name"), value, "a name that no other motion has"));
        }
        path(check, &format!("{field}.path"), &motion.path)?;
    }
    let known = |field: String, name: Option<&String>| match name {
        Some(name) if motions.iter().all(|motion| motion.name != *name) => {
            let names = motions.iter().map(|motion| motion.name.as_str()).collect::<Vec<_>>().join(", ");
            let allowed = if names.is_empty() { "left out: there are no motions".into() } else { names };
            Err(check.fail(field, format!("`{name}`"), allowed))
        }
        _ => Ok(()),
    };
    known("air.follows".into(), scene.air.follows.as_ref())?;
    for (index, fire) in scene.fires.iter().enumerate() {
        known(format!("fires[{index}].motion"), fire.motion.as_ref())?;
    }
    for (index, mesh) in scene.meshes.iter().enumerate() {
        known(format!("meshes[{index}].motion"), mesh.motion.as_ref())?;
    }
    Ok(())
}

fn path(check: &Check<'_>, field: &str, path: &MotionPath) -> Result<(), SceneError> {
    let about = |pivot_m: &[f32; 3], axis: &[f32; 3], period_s: f32| {
        check.each(&format!("{field}.pivot_m"), pivot_m, &(-FAR_M..=FAR_M))?;
        check.each(&format!("{field}.axis"), axis, &(-1.0e3..=1.0e3))?;
        if axis.iter().all(|x| x.abs() < 1.0e-6) {
            return Err(check.fail(format!("{field}.axis"), "of no length", "a direction"));
        }
        check.within(&format!("{field}.period_s"), period_s, 0.01..=1.0e6)
    };
    match path {
        MotionPath::Still => Ok(()),
        MotionPath::Swing { pivot_m, axis, angle_deg, period_s, phase } => {
            about(pivot_m, axis, *period_s)?;
            check.within(&format!("{field}.angle_deg"), *angle_deg, -360.0..=360.0)?;
            check.within(&format!("{field}.phase"), *phase, 0.0..=1.0)
        }
        MotionPath::Turn { pivot_m, axis, period_s } => about(pivot_m, axis, *period_s),
        MotionPath::Keys { keys, .. } => {
            if !(1..=MAX_KEYS).contains(&keys.len()) {
                return Err(check.fail(format!("the number of {field}.keys"), keys.len(), format!("1 to {MAX_KEYS}")));
            }
            for (index, key) in keys.iter().enumerate() {
                let of = |name: &str| format!("{field}.keys[{index}].{name}");
                check.within(&of("time_s"), key.time_s, 0.0..=1.0e6)?;
                if index > 0 && key.time_s <= keys[index - 1].time_s {
                    let allowed = format!("after that of the key before, {}", keys[index - 1].time_s);
                    return Err(check.fail(of("time_s"), key.time_s, allowed));
                }
                check.each(&of("position_m"), &key.position_m, &(-FAR_M..=FAR_M))?;
                check.each(&of("rotation_deg"), &key.rotation_deg, &(-360.0..=360.0))?;
            }
            Ok(())
        }
    }
}
