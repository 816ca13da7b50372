//! What can be wrong with a picture's size, its camera, its look and its frame, found before anything is uploaded.

use crate::data::{FlameData, LightData, MAX_GLOW, MAX_LAYERS};
use crate::error::RenderError;
use crate::shadows::MAX_SHADOWS;
use lucerna_frame::{Blur, Camera, Frame, Look, OpaqueMesh};

/// Just below what half floats hold, as in `common.wgsl`.
const BRIGHTEST: f32 = 6e4;

pub(crate) fn check_size([width, height]: [u32; 2], limit: u32) -> Result<(), RenderError> {
    if width == 0 || height == 0 || width > limit || height > limit {
        return Err(RenderError::Size { width, height, limit });
    }
    Ok(())
}

pub(crate) fn check_camera(camera: &Camera) -> Result<(), RenderError> {
    let error = |field, value, allowed| Err(RenderError::Camera { field, value, allowed });
    if let Some(value) = camera.eye.iter().chain(&camera.target).find(|v| !v.is_finite()) {
        return error("eye or camera.target", *value, "finite");
    }
    if !(1.0..=170.0).contains(&camera.fov_y_deg) {
        return error("fov_y_deg", camera.fov_y_deg, "1 to 170");
    }
    if !(camera.near_m.is_finite() && camera.near_m > 0.0) {
        return error("near_m", camera.near_m, "above 0");
    }
    if !(camera.far_m.is_finite() && camera.far_m > camera.near_m) {
        return error("far_m", camera.far_m, "above near_m");
    }
    Ok(())
}

pub(crate) fn check_look(look: &Look, largest_texture: u32) -> Result<(), RenderError> {
    let error = |field, value: &dyn std::fmt::Display, allowed| {
        Err(RenderError::Look { field, value: value.to_string(), allowed })
    };
    if !(1..=MAX_LAYERS).contains(&look.layers) {
        return error("layers", &look.layers, "1 to 32");
    }
    if look.glow.len() > MAX_GLOW {
        return error("glow", &look.glow.len(), "at most 4 levels");
    }
    if let Some(level) = look.glow.iter().find(|level| ![1, 4, 16].contains(&level.divisor)) {
        return error("glow.divisor", &level.divisor, "1, 4 or 16");
    }
    if ![1, 4].contains(&look.samples) {
        return error("samples", &look.samples, "1 or 4");
    }
    if !(2..=32).contains(&look.volume_steps) {
        return error("volume_steps", &look.volume_steps, "2 to 32");
    }
    if !(-30.0..=30.0).contains(&look.exposure_stops) {
        return error("exposure_stops", &look.exposure_stops, "-30 to 30");
    }
    if !(1000.0..=20_000.0).contains(&look.white_k) {
        return error("white_k", &look.white_k, "1000 to 20000");
    }
    let brightness = |value: f32| (0.0..=BRIGHTEST).contains(&value);
    for level in &look.glow {
        if !brightness(level.gain) {
            return error("glow.gain", &level.gain, "0 to 60000");
        }
        if let Blur::Height(sigma) | Blur::Pixels(sigma) = level.blur
            && !brightness(sigma)
        {
            return error("glow.blur", &sigma, "0 or more");
        }
    }
    if !brightness(look.light_gain) {
        return error("light_gain", &look.light_gain, "0 to 60000");
    }
    if look.shadows > MAX_SHADOWS {
        return error("shadows", &look.shadows, "0 to 32");
    }
    if !(16..=1024).contains(&look.shadow_size) {
        return error("shadow_size", &look.shadow_size, "16 to 1024");
    }
    if look.shadow_size * look.shadows.max(6) > largest_texture {
        let allowed = "so small that shadows x shadow_size and 6 x shadow_size fit into a texture of the device";
        return error("shadow_size", &look.shadow_size, allowed);
    }
    if !(1..=64).contains(&look.shadow_samples) {
        return error("shadow_samples", &look.shadow_samples, "1 to 64");
    }
    if !(0.0..=1.0).contains(&look.light_merging) {
        return error("light_merging", &look.light_merging, "0 to 1");
    }
    if let Some(value) = look.ambient.iter().chain(&look.background).find(|value| !brightness(**value)) {
        return error("ambient or look.background", value, "0 to 60000");
    }
    if !(0.0..=1.0).contains(&look.shell_softness) {
        return error("shell_softness", &look.shell_softness, "0 to 1");
    }
    Ok(())
}

/// The caller's depth must be of the picture's size.
pub(crate) fn check_depth(depth: Option<&wgpu::TextureView>, [width, height]: [u32; 2]) -> Result<(), RenderError> {
    let Some(texture) = depth.map(wgpu::TextureView::texture) else { return Ok(()) };
    if [texture.width(), texture.height()] != [width, height] || texture.sample_count() != 1 {
        let problem = format!(
            "is {} x {} with {} samples: must be {width} x {height} with one",
            texture.width(),
            texture.height(),
            texture.sample_count()
        );
        return Err(RenderError::Frame { field: "scene_depth", problem });
    }
    Ok(())
}

/// Flames that a layer can name.
const MAX_FLAMES: usize = (1 << 15) - 2;

/// Meshes are looked at only when they are new: there may be millions of indices.
pub(crate) fn check_frame(frame: &Frame<'_>, meshes_are_new: bool, limits: &wgpu::Limits) -> Result<(), RenderError> {
    let error = |field, problem: String| Err(RenderError::Frame { field, problem });
    let (draws, shades) = (frame.flame_draws.len(), frame.flame_shades.len());
    if draws != shades || shades > MAX_FLAMES {
        return error(
            "flame_shades",
            format!("has {shades} entries for {draws} draws: must be as many, at most {MAX_FLAMES}"),
        );
    }
    // Vertices that the GPU makes are as many as are drawn.
    let vertices = if frame.flame_nets.is_some() { u64::MAX } else { frame.flame_vertices.len() as u64 };
    let indices = frame.flame_indices.len() as u64;
    for (index, draw) in frame.flame_draws.iter().enumerate() {
        let last_vertex = u64::from(draw.first_vertex) + u64::from(draw.vertex_count);
        let last_index = u64::from(draw.first_index) + u64::from(draw.index_count);
        if last_vertex > vertices || last_index > indices {
            let problem =
                format!("[{index}] ends at vertex {last_vertex} of {vertices} and index {last_index} of {indices}");
            return error("flame_draws", problem);
        }
    }
    let fits = |field, bytes: usize, limit: u64| {
        if bytes as u64 > limit {
            return error(field, format!("needs {bytes} bytes: the device takes at most {limit}"));
        }
        Ok(())
    };
    let (buffer, storage) = (limits.max_buffer_size, limits.max_storage_buffer_binding_size);
    fits("flame_vertices", size_of_val(frame.flame_vertices), buffer)?;
    fits("flame_indices", size_of_val(frame.flame_indices), buffer)?;
    fits("lines", size_of_val(frame.lines), buffer)?;
    // With the tree over them.
    fits("lights", 2 * frame.lights.len() * size_of::<LightData>(), storage)?;
    fits("flame_shades", shades * size_of::<FlameData>(), storage)?;
    if !meshes_are_new {
        return Ok(());
    }
    let bytes = |of: fn(&OpaqueMesh) -> usize| frame.meshes.iter().map(of).sum();
    fits("meshes", bytes(|mesh| size_of_val(&*mesh.vertices)), buffer)?;
    fits("meshes", bytes(|mesh| size_of_val(&*mesh.indices)), buffer)?;
    for (index, mesh) in frame.meshes.iter().enumerate() {
        if let Some(bad) = mesh.indices.iter().find(|&&i| i as usize >= mesh.vertices.len()) {
            return error("meshes", format!("[{index}] has the index {bad} and {} vertices", mesh.vertices.len()));
        }
    }
    Ok(())
}
