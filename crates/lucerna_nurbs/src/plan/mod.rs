//! Uniform grids: tables and topology made once, evaluated for any number of nets.

mod axis;
mod blocks;
mod evaluate;
mod kernels;
mod limit;
mod many;
mod net;
mod options;
mod output;
mod tables;
mod tolerance;
mod topology;

pub use evaluate::Scratch;
pub use options::{Closure, GridOptions};
pub use output::{GridLayout, GridOutput, GridVertex, Interleaved};
pub use tolerance::cells_for_error;

use alloc::vec::Vec;

use crate::{KnotVector, NurbsError, Real, SimdLevel};
use axis::Axis;
use blocks::Blocks;
use fearless_simd::{Simd, SimdBase, dispatch};

/// Spans, basis values, derivatives and triangles of a uniform grid.
///
/// A plan knows knots and grid, but no control points: one plan serves all nets of a size, from any
/// number of threads, each with its own [`Scratch`].
///
/// Vertices are numbered row by row, v rising, u rising within a row; a row has `columns + 1`
/// vertices (a closed direction repeats its first, so that texture coordinates run from 0 to 1),
/// a pole has `columns`.
///
/// Orientation: normals point along dS/du x dS/dv, and triangles run counter-clockwise seen from
/// where normals point. They point outwards when the rows of the net run counter-clockwise around
/// it for an eye that looks from the upper end of v towards the lower; otherwise set
/// [`GridOptions::flip`].
///
/// ```
/// use lucerna_nurbs::{GridOptions, GridPlan, KnotVector};
///
/// let knots = KnotVector::<f64>::clamped_uniform(1, 2)?;
/// let plan = GridPlan::new(&knots, &knots, GridOptions { columns: 1, rows: 1, ..Default::default() })?;
/// let net = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]];
/// let mut corners = Vec::new();
/// plan.evaluate(&net, None, &mut plan.scratch(), |_, vertex| corners.push(vertex.position))?;
/// assert_eq!(corners[1], [1.0, 0.0, 0.0]);
/// assert_eq!(plan.indices(), [0, 1, 3, 0, 3, 2]);
/// # Ok::<(), lucerna_nurbs::NurbsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct GridPlan<T> {
    options: GridOptions,
    level: SimdLevel,
    u: Axis<T>,
    blocks: Blocks<T>,
    v: Axis<T>,
    /// The middles of the columns, when there is a pole.
    middle: Option<Middle<T>>,
    indices: Vec<u32>,
}

/// Samples at the middles of the columns.
#[derive(Clone, Debug)]
struct Middle<T> {
    axis: Axis<T>,
    blocks: Blocks<T>,
}

impl<T: Real> GridPlan<T> {
    /// The most cells in one direction.
    pub const MAX_CELLS: usize = 8192;
    /// The most vertices.
    pub const MAX_VERTICES: usize = 1 << 24;

    /// Makes tables and triangles for surfaces with these knots.
    ///
    /// # Errors
    /// When the grid is too small or too large, a periodic closure is asked for on knots that do
    /// not repeat, its start row does not exist, poles are declared where v is closed, or slits where
    /// u is not, v is, or there is a pole.
    pub fn new(knots_u: &KnotVector<T>, knots_v: &KnotVector<T>, options: GridOptions) -> Result<Self, NurbsError> {
        let pole = options.pole_v_min || options.pole_v_max;
        if pole && options.closure_v != Closure::Open {
            return Err(NurbsError::PoleOnClosed);
        }
        let slit = options.slit_v_min || options.slit_v_max;
        let both = options.slit_v_min && options.pole_v_min || options.slit_v_max && options.pole_v_max;
        if both || slit && (options.closure_u == Closure::Open || options.closure_v != Closure::Open) {
            return Err(NurbsError::Slit);
        }
        let max = Self::MAX_CELLS;
        let cells = |name, found, min| {
            if (min..=max).contains(&found) {
                return Ok(());
            }
            Err(NurbsError::Cells { name, found, min, max })
        };
        let [columns, rows] = options.least_cells();
        cells("columns", options.columns, columns)?;
        cells("rows", options.rows, rows)?;
        let at_most = |name, found, max| {
            if found <= max {
                return Ok(());
            }
            Err(NurbsError::Cells { name, found, min: 1, max })
        };
        let side = options.columns + 1;
        at_most("vertices", side * (options.rows + 1), Self::MAX_VERTICES)?;
        at_most("control points along v times columns", side * knots_v.count(), Self::MAX_VERTICES)?;

        let level = SimdLevel::Best;
        let lanes = lanes::<T>(level);
        let middle = if pole { Some(Axis::middles(knots_u, options.columns, options.closure_u)?) } else { None };
        let u = Axis::corners(knots_u, options.columns, options.closure_u)?;
        Ok(Self {
            level,
            blocks: Blocks::new(&u, lanes),
            u,
            v: Axis::corners(knots_v, options.rows, options.closure_v)?,
            middle: middle.map(|axis| Middle { blocks: Blocks::new(&axis, lanes), axis }),
            indices: topology::triangles(&options),
            options,
        })
    }

    /// The same plan with other vector instructions than the best that the machine has, for
    /// comparison. The meshes are the same, bit for bit.
    #[must_use]
    pub fn with_simd(mut self, level: SimdLevel) -> Self {
        let lanes = lanes::<T>(level);
        self.level = level;
        self.blocks = Blocks::new(&self.u, lanes);
        if let Some(middle) = &mut self.middle {
            middle.blocks = Blocks::new(&middle.axis, lanes);
        }
        self
    }

    /// What the plan was made from.
    pub fn options(&self) -> &GridOptions {
        &self.options
    }

    /// The number of vertices a mesh has.
    pub fn vertex_count(&self) -> usize {
        topology::vertex_count(&self.options)
    }

    /// Three vertex indices for each triangle.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// The same indices in half the memory.
    ///
    /// # Errors
    /// When there are more than 65,536 vertices.
    pub fn indices_u16(&self) -> Result<Vec<u16>, NurbsError> {
        let (found, max) = (self.vertex_count(), usize::from(u16::MAX) + 1);
        if found > max {
            return Err(NurbsError::Cells { name: "vertices", found, min: 1, max });
        }
        Ok(self.indices.iter().map(|&index| index as u16).collect())
    }

    /// The number of control points [`evaluate`](Self::evaluate) reads. Points repeated to close a
    /// periodic direction are not counted.
    pub fn point_count(&self) -> usize {
        self.u.points * self.v.points
    }
}

/// Scalars in the widest vector of a level.
fn lanes<T: Real>(level: SimdLevel) -> usize {
    fn lanes<T: Real, S: Simd>(_: S) -> usize {
        T::Native::<S>::LEN
    }
    dispatch!(level.level(), simd => lanes::<T, _>(simd))
}
