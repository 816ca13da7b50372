//! The flames of a frame, of which anybody may have filled the slices.

use super::ExportError;
use lucerna_frame::{FlameShade, FlameVertex, Frame};

/// The mesh of one flame; it has at least one triangle, and its indices and numbers are valid.
pub(super) struct FlameMesh<'a> {
    /// Its place in [`Frame::flame_draws`].
    pub(super) number: usize,
    pub(super) vertices: &'a [FlameVertex],
    pub(super) indices: &'a [u32],
    pub(super) shade: FlameShade,
}

/// The flames that have a surface.
pub(super) fn flames<'a>(frame: &Frame<'a>) -> Result<Vec<FlameMesh<'a>>, ExportError> {
    if frame.flame_nets.is_some() {
        let allowed = "none: let the world make the vertices, with Surfaces::Vertices";
        return Err(ExportError::value("flame_nets", &"given", allowed));
    }
    let mut flames = Vec::new();
    for (number, draw) in frame.flame_draws.iter().enumerate() {
        let vertices = part(frame.flame_vertices, draw.first_vertex, draw.vertex_count).ok_or_else(|| {
            ExportError::value(format!("flame_draws[{number}]"), &format!("{draw:?}"), "inside flame_vertices")
        })?;
        let indices = part(frame.flame_indices, draw.first_index, draw.index_count).ok_or_else(|| {
            ExportError::value(format!("flame_draws[{number}]"), &format!("{draw:?}"), "inside flame_indices")
        })?;
        if !draw.index_count.is_multiple_of(3) {
            let field = format!("flame_draws[{number}].index_count");
            return Err(ExportError::value(field, &draw.index_count, "a multiple of 3"));
        }
        if let Some(index) = indices.iter().find(|&&index| index >= draw.vertex_count) {
            let field = format!("an index of flame_draws[{number}]");
            return Err(ExportError::value(field, index, "below its vertex_count"));
        }
        for (i, v) in vertices.iter().enumerate() {
            let fields = [("position", &v.position[..]), ("normal", &v.normal), ("uv", &v.uv)];
            if let Some((name, value)) = fields.iter().find(|(_, value)| value.iter().any(|x| !x.is_finite())) {
                let field = format!("flame_vertices[{}].{name}", draw.first_vertex as usize + i);
                return Err(ExportError::value(field, &format!("{value:?}"), "finite"));
            }
        }
        if !indices.is_empty() {
            let shade = frame.flame_shades.get(number).copied().unwrap_or_default();
            flames.push(FlameMesh { number, vertices, indices, shade });
        }
    }
    Ok(flames)
}

fn part<T>(all: &[T], first: u32, count: u32) -> Option<&[T]> {
    all.get(first as usize..)?.get(..count as usize)
}
