//! What can be wrong with the control nets of a frame, found before anything is uploaded: the shader trusts them.

use crate::error::RenderError;
use lucerna_frame::{FlameNets, FlameVertex, Frame};

/// Words of a table before its samples, as `lucerna_nurbs::GridPlan::tables_as_bytes` documents them.
const HEADER: u64 = 16;
/// Most cells of a grid in one direction.
const MOST_CELLS: u64 = 8192;
/// Most rows of control points: as `MOST_ROWS` in `evaluate.wgsl`.
const MOST_ROWS: u64 = 256;

/// What the CPU needs to know of a grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct GridShape {
    /// Rows of vertices.
    pub(crate) rings: u32,
    pub(crate) vertices: u32,
    /// Control points.
    pub(crate) points: u32,
    /// Where its words start among those of all grids.
    pub(crate) start: u32,
}

impl GridShape {
    /// Reads the header of a table and checks that all that it refers to is there; otherwise says what is wrong.
    pub(crate) fn read(tables: &[u8]) -> Result<Self, String> {
        let (words, rest) = tables.as_chunks::<4>();
        let count = words.len() as u64;
        if !rest.is_empty() || count < HEADER {
            return Err(format!("has {} bytes: must be whole words of 4, at least {HEADER}", tables.len()));
        }
        let word = |at: u64| u32::from_le_bytes(words[at as usize]);
        let [columns, rows, vertices, flags, n_v, p, q, start_u, start_v, start_middle, points]: [u64; 11] =
            std::array::from_fn(|at| u64::from(word(at as u64)));
        if !(1..=MOST_CELLS).contains(&columns) || !(1..=MOST_CELLS).contains(&rows) {
            return Err(format!("says {columns} x {rows} cells: must be 1 to {MOST_CELLS} each"));
        }
        if flags > 15 || (flags & 6 != 0 && flags & 8 == 0) {
            return Err(format!("says the flags {flags}: must be at most 15, with poles only where v is open"));
        }
        let poles = (flags >> 1 & 1) + (flags >> 2 & 1);
        let expected = (columns + 1) * (rows + 1) - poles;
        if vertices != expected {
            return Err(format!(
                "says {vertices} vertices: {columns} x {rows} cells with {poles} poles have {expected}"
            ));
        }
        if n_v == 0 || points == 0 || !points.is_multiple_of(n_v) {
            return Err(format!("says {points} control points in rows of {n_v}: must be whole rows"));
        }
        if points / n_v > MOST_ROWS {
            return Err(format!("says {} rows of control points: must be at most {MOST_ROWS}", points / n_v));
        }
        let middles = if poles > 0 { columns } else { 0 };
        for (name, start, samples, width, most) in [
            ("u", start_u, columns + 1, p, points / n_v),
            ("v", start_v, rows + 1, q, n_v),
            ("the middles", start_middle, middles, p, points / n_v),
        ] {
            let end = start + samples * (1 + 3 * width);
            if samples == 0 {
                continue;
            }
            if width == 0 || start < HEADER || end > count {
                return Err(format!("has samples of {name} from word {start} to {end}: must be {HEADER} to {count}"));
            }
            for sample in (start..end).step_by(1 + 3 * width as usize) {
                if let Some(index) = (sample + 1..=sample + width).map(word).find(|index| u64::from(*index) >= most) {
                    return Err(format!("has a sample of {name} that reads control point {index} of {most}"));
                }
                let mut numbers = (sample + 1 + width..sample + 1 + 3 * width).chain([sample]);
                if !numbers.all(|at| f32::from_bits(word(at)).is_finite()) {
                    return Err(format!("has a sample of {name} that is not finite"));
                }
            }
        }
        Ok(Self { rings: rows as u32 + 1, vertices: vertices as u32, points: points as u32, start: 0 })
    }
}

fn error<T>(field: &'static str, problem: String) -> Result<T, RenderError> {
    Err(RenderError::Frame { field, problem })
}

/// Reads the tables of new grids.
pub(crate) fn check_grids(nets: &FlameNets<'_>, limits: &wgpu::Limits) -> Result<Vec<GridShape>, RenderError> {
    let bytes: u64 = nets.grids.iter().map(|grid| grid.tables.len() as u64).sum();
    if bytes > limits.max_storage_buffer_binding_size {
        let most = limits.max_storage_buffer_binding_size;
        return error("flame_nets.grids", format!("need {bytes} bytes: the device takes at most {most}"));
    }
    let mut start = 0;
    let read = |(index, grid): (usize, &lucerna_frame::FlameGrid)| {
        let shape = GridShape::read(&grid.tables)
            .or_else(|problem| error("flame_nets.grids", format!("[{index}] {problem}")))?;
        let shape = GridShape { start, ..shape };
        start += (grid.tables.len() / 4) as u32;
        Ok(shape)
    };
    nets.grids.iter().enumerate().map(read).collect()
}

/// Every net has a grid, control points and as many vertices as its draw says.
pub(crate) fn check_nets(
    nets: &FlameNets<'_>,
    shapes: &[GridShape],
    frame: &Frame<'_>,
    limits: &wgpu::Limits,
) -> Result<(), RenderError> {
    if !frame.flame_vertices.is_empty() {
        let problem = format!("has {} entries: must have none beside flame_nets", frame.flame_vertices.len());
        return error("flame_vertices", problem);
    }
    let (count, draws) = (nets.nets.len(), frame.flame_draws.len());
    if count != draws {
        return error("flame_nets.nets", format!("has {count} entries for {draws} draws: must be as many"));
    }
    for (index, (net, draw)) in nets.nets.iter().zip(frame.flame_draws).enumerate() {
        let Some(shape) = shapes.get(net.grid as usize) else {
            return error("flame_nets.nets", format!("[{index}] has the grid {} of {}", net.grid, shapes.len()));
        };
        let end = u64::from(net.first_point) + u64::from(shape.points);
        if end > nets.points.len() as u64 {
            let problem = format!("[{index}] ends at control point {end} of {}", nets.points.len());
            return error("flame_nets.nets", problem);
        }
        if draw.vertex_count != shape.vertices {
            let problem = format!("[{index}] has {} vertices: its grid has {}", draw.vertex_count, shape.vertices);
            return error("flame_draws", problem);
        }
    }
    let most = limits.max_storage_buffer_binding_size;
    for (field, bytes) in [("flame_draws", vertex_bytes(frame)), ("flame_nets.points", size_of_val(nets.points) as u64)]
    {
        if bytes > most {
            return error(field, format!("needs {bytes} bytes: the device takes at most {most}"));
        }
    }
    Ok(())
}

/// Bytes up to the last vertex that is drawn.
pub(crate) fn vertex_bytes(frame: &Frame<'_>) -> u64 {
    let ends = frame.flame_draws.iter().map(|draw| u64::from(draw.first_vertex) + u64::from(draw.vertex_count));
    ends.max().unwrap_or(0) * size_of::<FlameVertex>() as u64
}
