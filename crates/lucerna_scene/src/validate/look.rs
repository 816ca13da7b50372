//! Whether the camera and the look are allowed.

use super::{Check, FAR_M};
use crate::import::MAX_LIGHT;
use crate::{CameraKey, SceneError};
use lucerna_frame::{Blur, Camera, DebugView, GlowLevel, Look, Shading, Transparency};

/// Most glow levels.
const MAX_GLOW: usize = 4;

/// Texels that the faces of all shadow maps may have together along one edge.
const MAX_SHADOW_TEXELS: u32 = 8192;

/// Widest blur in pixels of the blurred image: the kernel reaches three times as far.
const MAX_BLUR_PIXELS: f32 = 21.0;

pub(super) fn camera(check: &Check<'_>, camera: &Camera) -> Result<(), SceneError> {
    check.each("camera.eye", &camera.eye, &(-FAR_M..=FAR_M))?;
    check.each("camera.target", &camera.target, &(-FAR_M..=FAR_M))?;
    if camera.eye == camera.target {
        let [x, y, z] = camera.target;
        return Err(check.fail("camera.target", format!("({x}, {y}, {z})"), "another point than camera.eye"));
    }
    check.within("camera.fov_y_deg", camera.fov_y_deg, 1.0..=170.0)?;
    check.above_zero("camera.near_m", camera.near_m, 1.0e5)?;
    check.above_zero("camera.far_m", camera.far_m, 1.0e6)?;
    if camera.far_m <= camera.near_m {
        return Err(check.fail("camera.far_m", camera.far_m, format!("above camera.near_m, {}", camera.near_m)));
    }
    Ok(())
}

/// Most keys of a camera's path.
const MAX_KEYS: usize = 4096;

/// Where the camera flies.
pub(super) fn camera_path(check: &Check<'_>, keys: &[CameraKey]) -> Result<(), SceneError> {
    if keys.len() > MAX_KEYS {
        return Err(check.fail("the number of camera_path", keys.len(), format!("at most {MAX_KEYS}")));
    }
    for (index, key) in keys.iter().enumerate() {
        let of = |name: &str| format!("camera_path[{index}].{name}");
        check.within(&of("time_s"), key.time_s, 0.0..=1.0e6)?;
        check.each(&of("eye"), &key.eye, &(-FAR_M..=FAR_M))?;
        check.each(&of("target"), &key.target, &(-FAR_M..=FAR_M))?;
        if key.eye == key.target {
            let [x, y, z] = key.target;
            return Err(check.fail(of("target"), format!("({x}, {y}, {z})"), "another point than eye"));
        }
        if index > 0 && key.time_s <= keys[index - 1].time_s {
            let allowed = format!("after that of the key before, {}", keys[index - 1].time_s);
            return Err(check.fail(of("time_s"), key.time_s, allowed));
        }
    }
    Ok(())
}

pub(super) fn look(check: &Check<'_>, look: &Look) -> Result<(), SceneError> {
    if look.transparency == Transparency::Unsorted && look.shading == Shading::Volume {
        return Err(check.fail("look.transparency", "unsorted", "peeled where look.shading is volume"));
    }
    check.within("look.layers", look.layers, 1..=32)?;
    if look.glow.len() > MAX_GLOW {
        return Err(check.fail("the number of look.glow", look.glow.len(), format!("at most {MAX_GLOW}")));
    }
    for (index, level) in look.glow.iter().enumerate() {
        glow(check, &format!("look.glow[{index}]"), level)?;
    }
    check.within("look.exposure_stops", look.exposure_stops, -30.0..=30.0)?;
    check.within("look.white_k", look.white_k, 1000.0..=20_000.0)?;
    check.within("look.light_gain", look.light_gain, 0.0..=MAX_LIGHT)?;
    check.within("look.shadows", look.shadows, 0..=32)?;
    check.within("look.shadow_size", look.shadow_size, 16..=1024)?;
    if look.shadows * look.shadow_size > MAX_SHADOW_TEXELS {
        let allowed = format!("at most {MAX_SHADOW_TEXELS} / look.shadows, {}", MAX_SHADOW_TEXELS / look.shadows);
        return Err(check.fail("look.shadow_size", look.shadow_size, allowed));
    }
    check.within("look.shadow_samples", look.shadow_samples, 1..=64)?;
    check.within("look.light_merging", look.light_merging, 0.0..=1.0)?;
    check.each("look.ambient", &look.ambient, &(0.0..=MAX_LIGHT))?;
    check.each("look.background", &look.background, &(0.0..=MAX_LIGHT))?;
    if ![1, 4].contains(&look.samples) {
        return Err(check.fail("look.samples", look.samples, "1 or 4"));
    }
    check.within("look.volume_steps", look.volume_steps, 2..=32)?;
    check.within("look.shell_softness", look.shell_softness, 0.0..=1.0)?;
    match look.debug {
        DebugView::Layer(layer) if layer >= look.layers => {
            Err(check.fail("look.debug layer", layer, format!("below look.layers, {}", look.layers)))
        }
        DebugView::Glow(level) if level as usize >= look.glow.len() => {
            let allowed = format!("below the number of look.glow, {}", look.glow.len());
            Err(check.fail("look.debug glow", level, allowed))
        }
        _ => Ok(()),
    }
}

fn glow(check: &Check<'_>, field: &str, level: &GlowLevel) -> Result<(), SceneError> {
    if ![1, 4, 16].contains(&level.divisor) {
        return Err(check.fail(format!("{field}.divisor"), level.divisor, "1, 4 or 16"));
    }
    match level.blur {
        Blur::Height(sigma) => check.above_zero(&format!("{field}.blur height"), sigma, 1.0)?,
        Blur::Pixels(sigma) => check.above_zero(&format!("{field}.blur pixels"), sigma, MAX_BLUR_PIXELS)?,
        Blur::Published => {}
    }
    check.within(&format!("{field}.gain"), level.gain, 0.0..=100.0)
}
