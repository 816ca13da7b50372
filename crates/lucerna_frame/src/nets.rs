//! Flame surfaces as control nets, for a renderer that makes the vertices itself.

/// The control nets of all flames of a frame.
#[derive(Clone, Copy, Debug)]
pub struct FlameNets<'a> {
    /// The sizes of surfaces that occur; nets refer to them by index.
    pub grids: &'a [FlameGrid],
    /// Changes whenever `grids` do, so that they are uploaded only then.
    pub grid_revision: u64,
    /// The control points of all nets: x, y and z in metres, and the height within the flame, 0 at the root and 1 at
    /// the tip, which is the same for all points of a column.
    pub points: &'a [[f32; 4]],
    /// One net for each entry of [`Frame::flame_draws`](crate::Frame::flame_draws).
    pub nets: &'a [FlameNet],
}

/// How surfaces of one size are evaluated.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FlameGrid {
    /// Samples and basis functions, laid out as `lucerna_nurbs::GridPlan::tables_as_bytes` documents. u runs around
    /// the flame, v from its tip (0) to its root (1); a net has at most 256 rows of control points around the flame.
    pub tables: Vec<u8>,
}

/// The control net of one flame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FlameNet {
    /// Index of its grid, which says how many control points it has.
    pub grid: u32,
    /// Its first control point; the others follow, row by row.
    pub first_point: u32,
}
