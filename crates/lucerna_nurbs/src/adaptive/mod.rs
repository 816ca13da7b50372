//! Meshes that are fine only where the surface bends.
//!
//! The domain is halved along u or v, starting from the knot spans, until the control points of the
//! Bezier patch of each cell say that two triangles stay within the tolerance. A cell knows its
//! corners by integers, so that the corners of finer neighbours on its edges are found exactly, also
//! across the seam of a closed surface; they become corners of its triangles, which leaves no crack.

mod cells;
mod stitch;

use alloc::vec::Vec;

use crate::{Direction, GridVertex, KnotVector, NurbsError, Real, Surface};
use cells::Cells;

/// How [`Surface::adaptive_mesh`] works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdaptiveOptions<T> {
    /// The greatest distance between the surface and the mesh, in the unit of the control points.
    pub tolerance: T,
    /// Turns triangles and normals over.
    pub flip: bool,
}

/// Triangles with their vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh<T> {
    /// Points with unit normals. `u` and `v` are places in the domain, 0 to 1.
    pub vertices: Vec<GridVertex<T>>,
    /// Three vertex indices for each triangle, counter-clockwise seen from where normals point.
    pub indices: Vec<u32>,
}

impl<T: Real> Surface<T> {
    /// A mesh within `tolerance` of the surface, with large triangles where it is flat.
    ///
    /// The surface is closed along a direction when its two edges there have the same points; an edge
    /// that is a single point becomes a pole. Both are found from the control points, to nine
    /// digits of their extent. Along a seam, and at a pole, places differ between vertices of the
    /// same position; otherwise neighbouring triangles share vertices.
    ///
    /// For an edge that runs forth and back along a slit, use a [`GridPlan`](crate::GridPlan).
    ///
    /// ```
    /// use lucerna_nurbs::{AdaptiveOptions, GridOptions, KnotVector, Surface};
    ///
    /// // Flat but for one corner.
    /// let line = KnotVector::<f64>::clamped_uniform(2, 5)?;
    /// let height = |i: usize, j: usize| if i + j == 8 { 1.0 } else { 0.0 };
    /// let net = (0..25).map(|k| [(k / 5) as f64, (k % 5) as f64, height(k / 5, k % 5)]).collect();
    /// let surface = Surface::new(line.clone(), line, net, None)?;
    /// let mesh = surface.adaptive_mesh(AdaptiveOptions { tolerance: 0.01, flip: false })?;
    /// // A grid that is sure to be as near has more than twice as many triangles.
    /// let grid = surface.grid_for_tolerance(0.01, GridOptions::default())?;
    /// assert!(mesh.indices.len() / 3 < grid.columns * grid.rows);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the tolerance is not positive and finite, or so small that the mesh would have more than
    /// 2^20 cells.
    pub fn adaptive_mesh(&self, options: AdaptiveOptions<T>) -> Result<Mesh<T>, NurbsError> {
        let tolerance = options.tolerance.to_f64();
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(NurbsError::NotPositive { name: "tolerance", value: tolerance });
        }
        let surface = self.map_f64(|point| point)?;
        // Halvings alone go by powers of two, which is up to twice too fine: spans start in three or
        // five parts where that comes out with fewer cells.
        let mut best: Option<Cells> = None;
        for parts_u in PARTS {
            let surface = surface.refine(Direction::U, &inner(surface.knots_u(), parts_u))?;
            for parts_v in PARTS {
                let surface = surface.refine(Direction::V, &inner(surface.knots_v(), parts_v))?;
                let most = best.as_ref().map_or(cells::MAX_CELLS, |best| best.leaves.len() - 1);
                match Cells::new(&surface, tolerance, most) {
                    Ok(cells) => best = Some(cells),
                    Err(error) if best.is_none() => return Err(error),
                    Err(_) => {}
                }
            }
        }
        let Some(cells) = best else { return Ok(Mesh::default()) };
        Ok(stitch::stitch(&surface, &cells, options.flip))
    }
}

/// The parts in which a knot span may start.
const PARTS: [usize; 3] = [1, 3, 5];

/// The knots that part each span in so many.
fn inner(knots: &KnotVector<f64>, parts: usize) -> Vec<f64> {
    let (lo, hi) = knots.domain();
    let spans = knots.as_slice().windows(2).filter(|pair| pair[0] < pair[1] && pair[0] >= lo && pair[1] <= hi);
    let at = |pair: &[f64], k: usize| pair[0] + (pair[1] - pair[0]) * (k as f64 / parts as f64);
    spans.flat_map(|pair| (1..parts).map(move |k| at(pair, k))).collect()
}
