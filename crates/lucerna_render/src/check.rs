//! What can be wrong with a picture's size, its camera, its look and its frame, found before anything is uploaded.

use crate::data::{MAX_GLOW, MAX_LAYERS};
use crate::error::RenderError;
use lucerna_frame::{Camera, Frame, Look};

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

pub(crate) fn check_look(look: &Look) -> Result<(), RenderError> {
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
    Ok(())
}

/// Flames that a layer can name.
const MAX_FLAMES: usize = (1 << 15) - 2;

pub(crate) fn check_frame(frame: &Frame<'_>) -> Result<(), RenderError> {
    let error = |field, problem: String| Err(RenderError::Frame { field, problem });
    let (draws, shades) = (frame.flame_draws.len(), frame.flame_shades.len());
    if draws != shades || shades > MAX_FLAMES {
        return error(
            "flame_shades",
            format!("has {shades} entries for {draws} draws: must be as many, at most {MAX_FLAMES}"),
        );
    }
    let (vertices, indices) = (frame.flame_vertices.len() as u64, frame.flame_indices.len() as u64);
    for (index, draw) in frame.flame_draws.iter().enumerate() {
        let last_vertex = u64::from(draw.first_vertex) + u64::from(draw.vertex_count);
        let last_index = u64::from(draw.first_index) + u64::from(draw.index_count);
        if last_vertex > vertices || last_index > indices {
            let problem =
                format!("[{index}] ends at vertex {last_vertex} of {vertices} and index {last_index} of {indices}");
            return error("flame_draws", problem);
        }
    }
    for (index, mesh) in frame.meshes.iter().enumerate() {
        if let Some(bad) = mesh.indices.iter().find(|&&i| i as usize >= mesh.vertices.len()) {
            return error("meshes", format!("[{index}] has the index {bad} and {} vertices", mesh.vertices.len()));
        }
    }
    Ok(())
}
