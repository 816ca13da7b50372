//! What a grid is made from.

/// How a direction of the grid ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Closure {
    /// From one end of the domain to the other.
    #[default]
    Open,
    /// The two ends of the domain are the same points of the surface, as with a circle of rational
    /// arcs: the last sample is a copy of the first.
    Joined,
    /// The knots are periodic and the first `degree` control points repeat behind the last, as
    /// [`KnotVector::periodic`](crate::KnotVector::periodic) and [`Surface::closed_u`](crate::Surface::closed_u) have it.
    ///
    /// The samples start, and end, at the Greville abscissa of control row `start_row`, one period
    /// apart. On evenly spaced knots, samples at equal distances before and behind that row are
    /// exact mirror images: where the control points mirror each other bit for bit, so do the
    /// samples, and an edge that runs forth and back along a slit closes without a crack.
    Periodic {
        /// The control row at which the samples start, below the number of distinct rows.
        start_row: usize,
    },
}

/// The size and shape of a grid.
///
/// The default is 48 x 48 cells, open in both directions, without poles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
pub struct GridOptions {
    /// Cells along u, at least 1, or 3 when u is closed; at most 8192.
    pub columns: usize,
    /// Cells along v, at least 1, 2 with poles or slits at both ends, 3 when v is closed; at most
    /// 8192.
    pub rows: usize,
    /// How u ends.
    pub closure_u: Closure,
    /// How v ends.
    pub closure_v: Closure,
    /// The edge at the lower end of v is a single point: it gets one vertex per column, in the
    /// middle of the column, all at the same place, and one triangle per column.
    pub pole_v_min: bool,
    /// The same for the upper end of v.
    pub pole_v_max: bool,
    /// The edge at the lower end of v runs forth and back through the same points, mirrored about
    /// the first column: u is closed, but v is pinched to a slit. With an odd number of columns the
    /// two in the middle meet there; no triangle is put between them.
    pub slit_v_min: bool,
    /// The same for the upper end of v.
    pub slit_v_max: bool,
    /// Turns triangles and normals over, for nets that run the other way round; see
    /// [`GridPlan`](crate::GridPlan) for the rule.
    pub flip: bool,
}

impl Default for GridOptions {
    fn default() -> Self {
        Self {
            columns: 48,
            rows: 48,
            closure_u: Closure::Open,
            closure_v: Closure::Open,
            pole_v_min: false,
            pole_v_max: false,
            slit_v_min: false,
            slit_v_max: false,
            flip: false,
        }
    }
}

impl GridOptions {
    /// The least columns and rows of cells with which a mesh of this kind closes.
    pub fn least_cells(&self) -> [usize; 2] {
        let least = |closure| if closure == Closure::Open { 1 } else { 3 };
        let ends = [self.pole_v_min || self.slit_v_min, self.pole_v_max || self.slit_v_max];
        let ends = ends.into_iter().filter(|&end| end).count();
        [least(self.closure_u), least(self.closure_v).max(ends)]
    }
}
