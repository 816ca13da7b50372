//! Flame surfaces of one frame as Wavefront OBJ.

use super::{ExportError, checked};
use lucerna_frame::Frame;
use std::io::Write;

/// Writes the flame surfaces: a group `flame_0`, `flame_1`, ... for each flame, in the order of the frame, every vertex
/// with its position (m), normal and texture coordinates (u around the flame, v from root to tip). Numbers are written
/// so that they are read as the same `f32`.
///
/// # Errors
/// When the frame has control nets instead of vertices, its slices do not fit together, a number is not finite, or
/// `out` fails. What is wrong with the frame is found before anything is written.
pub fn write_obj(frame: &Frame<'_>, mut out: impl Write) -> Result<(), ExportError> {
    let flames = checked::flames(frame)?;
    writeln!(out, "# Flames of Lucerna at {} s, in metres, y up", frame.time_s)?;
    let mut first = 1;
    for flame in flames {
        writeln!(out, "g flame_{}", flame.number)?;
        for v in flame.vertices {
            let ([x, y, z], [nx, ny, nz], [s, t]) = (v.position, v.normal, v.uv);
            writeln!(out, "v {x} {y} {z}\nvt {s} {t}\nvn {nx} {ny} {nz}")?;
        }
        for triangle in flame.indices.as_chunks::<3>().0 {
            let [a, b, c] = triangle.map(|index| first + index as usize);
            writeln!(out, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}")?;
        }
        first += flame.vertices.len();
    }
    Ok(())
}
