//! How fine a grid must be.

use alloc::vec::Vec;

use super::{Closure, GridOptions, GridPlan};
use crate::patch::Patch;
use crate::{KnotVector, NurbsError, Real, Surface};

/// The number of grid cells, around or along a rounded shape of extent `size`, that keeps the
/// distance between mesh and surface near `tolerance`: `3 sqrt(size / tolerance)`, rounded up.
///
/// Both are in the same unit, for instance pixels. The result is 3 to 8192.
///
/// ```
/// assert_eq!(lucerna_nurbs::cells_for_error(100.0, 1.0), Ok(30));
/// ```
///
/// # Errors
/// When `size` or `tolerance` is not positive and finite.
pub fn cells_for_error(size: f64, tolerance: f64) -> Result<usize, NurbsError> {
    for (name, value) in [("size", size), ("tolerance", tolerance)] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(NurbsError::NotPositive { name, value });
        }
    }
    let cells = 3.0 * Real::sqrt(size / tolerance);
    // Rounded up.
    Ok((-Real::floor(-cells)).clamp(3.0, 8192.0) as usize)
}

/// What bounds the distance between a surface and its grids.
struct Bound {
    /// An eighth of the second derivatives over the whole domain as one cell: along u, mixed, along v.
    smooth: [f64; 3],
    creases: [Creases; 2],
}

/// The knots at which the tangents of a direction jump: their places in units of the domain, from
/// the first sample on, rising, and a quarter of the jumps over the whole domain as one cell.
struct Creases(Vec<(f64, f64)>);

impl Creases {
    /// The part of the distance that they cause: none where a line of the grid runs along each.
    fn distance(&self, cells: usize) -> f64 {
        let (mut most, mut cell, mut sum) = (0.0f64, 0, 0.0);
        for (place, jump) in &self.0 {
            let at = place * cells as f64;
            let to_line = at - (at + 0.5) as usize as f64;
            if Real::abs(to_line) < 1e-6 {
                continue;
            }
            if at as usize != cell {
                (cell, sum) = (at as usize, 0.0);
            }
            sum += jump / cells as f64;
            most = most.max(sum);
        }
        most
    }
}

impl Bound {
    fn distance(&self, [columns, rows]: [usize; 2]) -> f64 {
        let ([uu, uv, vv], [c, r]) = (self.smooth, [columns as f64, rows as f64]);
        let creases = self.creases[0].distance(columns) + self.creases[1].distance(rows);
        uu / (c * c) + 2.0 * uv / (c * r) + vv / (r * r) + creases
    }
}

impl<T: Real> Surface<T> {
    /// The coarsest uniform grid of the kind of `options` that is sure to stay within `tolerance` of
    /// this surface, as points in space; the least product of columns and rows.
    ///
    /// From bounds of the second derivatives of the Bezier patches (Filip, Magedson and Markot, 1986)
    /// and of the jumps of tangents at creases.
    ///
    /// ```
    /// use lucerna_nurbs::{GridOptions, KnotVector, Surface};
    ///
    /// let (u, v) = (KnotVector::<f64>::clamped_uniform(2, 3)?, KnotVector::clamped_uniform(1, 2)?);
    /// let arch = vec![[0., 0., 0.], [0., 1., 0.], [1., 0., 2.], [1., 1., 2.], [2., 0., 0.], [2., 1., 0.]];
    /// let options = Surface::new(u, v, arch, None)?.grid_for_tolerance(0.011, GridOptions::default())?;
    /// assert_eq!((options.columns, options.rows), (10, 1));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `tolerance` is not positive and finite, or needs more cells or vertices than a
    /// [`GridPlan`] may have.
    pub fn grid_for_tolerance(&self, tolerance: T, options: GridOptions) -> Result<GridOptions, NurbsError> {
        let tolerance = tolerance.to_f64();
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(NurbsError::NotPositive { name: "tolerance", value: tolerance });
        }
        let bound = self.bound(&options)?;
        let (max, least) = (GridPlan::<T>::MAX_CELLS, options.least_cells());
        let mut best: Option<[usize; 2]> = None;
        for columns in least[0]..=max {
            // No more rows than make a better product.
            let most = best.map_or(max, |[c, r]| (c * r - 1) / columns).min(max);
            if most < least[1] {
                break;
            }
            let enough = |rows: &usize| bound.distance([columns, *rows]) <= tolerance;
            let first = self.first_rows(&bound, columns, tolerance).max(least[1]);
            if let Some(rows) = (first..=most).find(enough) {
                best = Some([columns, rows]);
            }
        }
        let refuse = |name, found, max| NurbsError::Cells { name, found, min: 1, max };
        let [columns, rows] = best.ok_or_else(|| refuse("cells along a direction", max + 1, max))?;
        let vertices = (columns + 1) * (rows + 1);
        if vertices > GridPlan::<T>::MAX_VERTICES {
            return Err(refuse("vertices", vertices, GridPlan::<T>::MAX_VERTICES));
        }
        Ok(GridOptions { columns, rows, ..options })
    }

    /// A number of rows below which no grid of so many columns is fine enough.
    fn first_rows(&self, bound: &Bound, columns: usize, tolerance: f64) -> usize {
        let ([uu, uv, vv], c) = (bound.smooth, columns as f64);
        let rest = tolerance - uu / (c * c);
        if rest <= 0.0 {
            return usize::MAX;
        }
        // vv / r^2 + 2 uv / (c r) <= rest, solved for r.
        let half = uv / c;
        let rows = (half + Real::sqrt(half * half + rest * vv)) / rest;
        (rows * (1.0 - 1e-9)) as usize
    }

    fn bound(&self, options: &GridOptions) -> Result<Bound, NurbsError> {
        let surface = self.map_f64(|point| point)?;
        let patches = Patch::of_surface(&surface)?;
        let (knots_u, knots_v) = (surface.knots_u(), surface.knots_v());
        let side = |knots: &KnotVector<f64>| knots.domain().1 - knots.domain().0;
        let mut smooth = [0.0f64; 3];
        for patch in &patches {
            let bend = patch.bend();
            let u = side(knots_u) / (patch.hi[0] - patch.lo[0]);
            let v = side(knots_v) / (patch.hi[1] - patch.lo[1]);
            for (most, found) in smooth.iter_mut().zip([bend.uu * u * u, bend.uv * u * v, bend.vv * v * v]) {
                *most = most.max(0.125 * found);
            }
        }
        let columns = patches.iter().take_while(|patch| patch.lo[0] == patches[0].lo[0]).count();
        let creases = [
            creases(knots_u, options.closure_u, &patches, 0, columns),
            creases(knots_v, options.closure_v, &patches, 1, 1),
        ];
        Ok(Bound { smooth, creases })
    }
}

/// The creases of a direction, in which neighbouring patches are `step` apart.
fn creases(knots: &KnotVector<f64>, closure: Closure, patches: &[Patch<3>], direction: usize, step: usize) -> Creases {
    let (lo, hi) = knots.domain();
    let periodic = matches!(closure, Closure::Periodic { .. });
    let start = match closure {
        Closure::Periodic { start_row } => knots.greville(start_row).unwrap_or(lo),
        Closure::Open | Closure::Joined => lo,
    };
    let mut found: Vec<(f64, f64)> = Vec::new();
    for (k, low) in patches.iter().enumerate() {
        // The patch behind this one, around the seam of a period.
        let across = |other: &&Patch<3>| other.lo[1 - direction] == low.lo[1 - direction];
        let high = if low.hi[direction] < hi {
            patches.get(k + step)
        } else {
            patches.iter().filter(across).find(|other| periodic && other.lo[direction] == lo)
        };
        let Some(high) = high.filter(|high| knots.multiplicity(high.lo[direction]) >= knots.degree()) else {
            continue;
        };
        let place = (high.lo[direction] - start) / (hi - lo);
        let place = if place < 0.0 { place + 1.0 } else { place };
        let jump = 0.25 * (hi - lo) * low.jump(high, direction);
        match found.iter_mut().find(|crease| crease.0 == place) {
            Some(crease) => crease.1 = crease.1.max(jump),
            None => found.push((place, jump)),
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    Creases(found)
}
