//! Whether every value of a scene is allowed.

mod air;
mod check;
mod fire;
mod look;
mod motion;

pub(crate) use air::{inside as inside_air, wick_inside as wick_inside_air};
pub(crate) use check::Check;

use crate::model::Placement;
use crate::{Scene, SceneError};
use std::path::Path;

/// Positions lie within this distance of the origin along each axis, m.
const FAR_M: f32 = 1.0e5;

/// Most opaque meshes of a scene.
const MAX_MESHES: usize = 256;

/// Most copies of a fire or a mesh.
const MAX_COPIES: usize = 4096;

/// Most fires of a scene.
const MAX_FIRES: usize = 64;

/// Whether every value of the scene is allowed; files that it names are not read.
///
/// # Errors
///
/// [`SceneError::Value`] for the first value that is not.
pub fn validate(scene: &Scene) -> Result<(), SceneError> {
    self::scene(&Check::new(None), scene)
}

pub(crate) fn scene(check: &Check<'_>, scene: &Scene) -> Result<(), SceneError> {
    look::camera(check, &scene.camera)?;
    look::camera_path(check, &scene.camera_path)?;
    look::look(check, &scene.look)?;
    air::air(check, &scene.air)?;
    if !(1..=MAX_FIRES).contains(&scene.fires.len()) {
        return Err(check.fail("the number of fires", scene.fires.len(), format!("1 to {MAX_FIRES}")));
    }
    for (index, one) in scene.fires.iter().enumerate() {
        fire::fire(check, &scene.air, &format!("fires[{index}]"), one)?;
    }
    let flames = scene.fires.iter().map(|fire| fire.wicks.len() * fire.places().len()).sum::<usize>();
    if flames > crate::load::MAX_FLAMES {
        let allowed = format!("at most {}", crate::load::MAX_FLAMES);
        return Err(check.fail("the number of wicks of all copies of all fires", flames, allowed));
    }
    motion::motions(check, scene)?;
    if scene.meshes.len() > MAX_MESHES {
        return Err(check.fail("the number of meshes", scene.meshes.len(), format!("at most {MAX_MESHES}")));
    }
    for (index, mesh) in scene.meshes.iter().enumerate() {
        let field = format!("meshes[{index}]");
        placed(check, &field, &mesh.file, &mesh.placement())?;
        copies(check, &field, &mesh.at, &mesh.turns_deg)?;
    }
    Ok(())
}

/// Where copies stand.
fn copies(check: &Check<'_>, field: &str, at: &[[f32; 3]], turns_deg: &[f32]) -> Result<(), SceneError> {
    if at.len() > MAX_COPIES {
        let counted = format!("the number of {field}.at");
        return Err(check.fail(counted, at.len(), format!("at most {MAX_COPIES}")));
    }
    for (index, position) in at.iter().enumerate() {
        check.each(&format!("{field}.at[{index}]"), position, &(-FAR_M..=FAR_M))?;
    }
    if !turns_deg.is_empty() && turns_deg.len() != at.len().max(1) {
        let counted = format!("the number of {field}.turns_deg");
        return Err(check.fail(counted, turns_deg.len(), format!("none, or {}: one for each place", at.len().max(1))));
    }
    check.each(&format!("{field}.turns_deg"), turns_deg, &(-360.0..=360.0))
}

/// A file and where it stands.
fn placed(check: &Check<'_>, field: &str, file: &Path, placement: &Placement) -> Result<(), SceneError> {
    if file.as_os_str().is_empty() {
        return Err(check.fail(format!("{field}.file"), "empty", "the path of an OBJ, glTF or GLB file"));
    }
    check.each(&format!("{field}.position_m"), &placement.position_m, &(-FAR_M..=FAR_M))?;
    check.each(&format!("{field}.rotation_deg"), &placement.rotation_deg, &(-360.0..=360.0))?;
    check.within(&format!("{field}.scale"), placement.scale, 1.0e-6..=1.0e6)
}
