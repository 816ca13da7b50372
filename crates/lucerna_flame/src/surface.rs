//! From a control net to a closed surface: its vertices, or what a renderer needs to make them.

use crate::FlameError;
use crate::section::Section;
use glam::Vec3;
use lucerna_frame::{FlameGrid, FlameVertex};
use lucerna_nurbs::{Closure, GridOptions, GridPlan, KnotVector, Scratch};

/// Where the vertices of flames are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Surfaces {
    /// Here: [`Flames::vertices`](crate::Flames::vertices) has them.
    #[default]
    Vertices,
    /// By the renderer, from the control nets of [`Flames::nets`](crate::Flames::nets).
    Nets,
}

/// The control net of one surface, and what its vertices are made of it with.
///
/// `GridPlan::new(knots_u, knots_v, grid)?.evaluate(points, ..)` of `lucerna_nurbs` makes the vertices of
/// [`Flames::vertices`](crate::Flames::vertices), bit for bit.
#[derive(Clone, Copy, Debug)]
pub struct ControlNet<'a> {
    /// Knots around the flame, periodic: they carry `degree` points more than the net has rows.
    pub knots_u: &'a KnotVector<f32>,
    /// Knots from the tip (0) to the root (1); they carry as many points as the net has columns.
    pub knots_v: &'a KnotVector<f32>,
    /// Cells, closure and poles.
    pub grid: GridOptions,
    /// Control points in metres, row by row; each row runs from tip to root.
    pub points: &'a [[f32; 3]],
    /// The flame has broken away from its wick.
    pub is_free: bool,
}

/// Half thickness of a flame that has none, m.
pub(crate) const THINNEST_M: f32 = 1e-5;

/// Most volume that may be inside out, as a share of what is not.
const MOST_WRONG: f32 = 0.1;
/// Least volume, as a share of what the cuts would enclose if they faced the root.
const LEAST_FACING: f32 = 0.15;

/// Where this much of what cuts would enclose is enclosed, nothing is folded.
const PLAIN: f32 = 0.9;

/// What determines a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlanKey {
    /// Rows of the net, around the flame.
    pub(crate) rows: usize,
    /// Columns of the net, from tip to root.
    pub(crate) columns: usize,
    pub(crate) around: usize,
    pub(crate) up: usize,
    pub(crate) tip_softness: f32,
}

/// Tables and triangles shared by all flames of a size.
#[derive(Debug)]
pub(crate) struct SurfacePlan {
    pub(crate) key: PlanKey,
    /// Around the flame, and from tip to root.
    knots: [KnotVector<f32>; 2],
    grid: GridPlan<f32>,
    /// For each ring of vertices: the first of the net's columns that it depends on, and their weights.
    weights: Vec<(usize, [f32; 4])>,
    /// For each vertex of a ring: the first of the padded ring's points that it depends on, and their weights.
    around: Vec<(usize, [f32; 4])>,
    /// Both ends are points (one lead skeleton), not slits.
    poles: bool,
}

impl SurfacePlan {
    pub(crate) fn new(key: PlanKey) -> Result<Self, FlameError> {
        let around = KnotVector::periodic(3, key.rows)?;
        let spans = key.columns - 3;
        let inner: Vec<f32> = (1..spans)
            .map(|i| (i as f32 + if i == 1 && spans > 2 { key.tip_softness } else { 0.0 }) / spans as f32)
            .collect();
        let along = KnotVector::clamped(3, &inner)?;
        let poles = key.rows == 4;
        let options = GridOptions {
            columns: key.around,
            rows: key.up,
            closure_u: Closure::Periodic { start_row: 0 },
            pole_v_min: poles,
            pole_v_max: poles,
            ..GridOptions::default()
        };
        let grid = GridPlan::new(&around, &along, options)?;
        let mut weights = Vec::with_capacity(key.up + 1);
        for ring in 0..=key.up {
            let basis = along.basis_functions(ring as f32 / key.up as f32)?;
            let mut four = [0.0; 4];
            for (to, from) in four.iter_mut().zip(basis.derivative(0).unwrap_or(&[])) {
                *to = *from;
            }
            weights.push((basis.first(), four));
        }
        let spline = |k: usize| {
            // The uniform cubic spline at its parameter, in rows.
            let (row, t) = (k * key.rows / key.around, (k * key.rows % key.around) as f32 / key.around as f32);
            let u = 1.0 - t;
            let six = [u * u * u, 4.0 - 6.0 * t * t + 3.0 * t * t * t, 4.0 - 6.0 * u * u + 3.0 * u * u * u, t * t * t];
            (row, six.map(|six| six / 6.0))
        };
        let splines = (0..key.around).map(spline).collect();
        Ok(Self { key, knots: [around, along], grid, weights, around: splines, poles })
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.grid.vertex_count()
    }
    pub(crate) fn net<'a>(&'a self, points: &'a [[f32; 3]], is_free: bool) -> ControlNet<'a> {
        let [knots_u, knots_v] = &self.knots;
        ControlNet { knots_u, knots_v, grid: *self.grid.options(), points, is_free }
    }
    /// What a renderer needs to evaluate nets of this size.
    pub(crate) fn tables(&self) -> FlameGrid {
        FlameGrid { tables: self.grid.tables_as_bytes() }
    }
    pub(crate) fn indices(&self) -> &[u32] {
        self.grid.indices()
    }
    /// The vertices of ring 0 (tip) to `up` (root); all but a pole's repeat their first at the end.
    pub(crate) fn ring(&self, ring: usize) -> std::ops::Range<usize> {
        let width = self.key.around + 1;
        if !self.poles {
            return ring * width..(ring + 1) * width;
        }
        let start = (ring * width).saturating_sub(1);
        let pole = ring == 0 || ring == self.key.up;
        start..start + width - usize::from(pole)
    }
}

/// Vertices and memory of one surface.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surface {
    /// Empty, or of another moment, where the renderer makes them.
    pub(crate) vertices: Vec<FlameVertex>,
    /// One for each ring of vertices.
    pub(crate) sections: Vec<Section>,
    /// Heights of the net's columns.
    pub(crate) columns: Vec<f32>,
    scratch: Scratch<f32>,
    /// The control points of each ring of vertices, with the last before them and the first two after them.
    rings: Vec<Vec3>,
    /// The corners of each ring, without normals.
    corners: Vec<Vec3>,
}

impl Surface {
    /// With the memory that a surface of this plan needs.
    pub(crate) fn of_size(plan: &SurfacePlan) -> Self {
        let (rings, rows) = (plan.weights.len(), plan.key.rows + 3);
        Self {
            vertices: Vec::with_capacity(plan.vertex_count()),
            sections: Vec::with_capacity(rings),
            columns: Vec::with_capacity(plan.key.columns),
            scratch: plan.grid.scratch(),
            rings: Vec::with_capacity(rings * rows),
            corners: Vec::with_capacity(rings * plan.around.len()),
        }
    }

    /// Measures the net of `rows` x `columns` control points that [`is_right_side_out`](Self::is_right_side_out) has
    /// seen last, and makes the vertices where they are asked for.
    pub(crate) fn build(&mut self, plan: &SurfacePlan, net: &[[f32; 3]], surfaces: Surfaces) {
        self.measure_columns(plan, net);
        for (section, (first, weights)) in self.sections.iter_mut().zip(&plan.weights) {
            let height: f32 = weights.iter().zip(&self.columns[*first..]).map(|(w, h)| w * h).sum();
            section.height = height.clamp(0.0, 1.0);
        }
        if surfaces == Surfaces::Vertices {
            self.evaluate(plan, net);
        }
    }

    /// Cuts the surface of a net, and says whether it is right side out: over a point every cut faces the root, over a
    /// line next to nothing of what the flame encloses is inside out.
    pub(crate) fn is_right_side_out(&mut self, plan: &SurfacePlan, net: &[[f32; 3]]) -> bool {
        self.cut(plan, net);
        let (mut right, mut wrong, mut most) = (0.0, 0.0, 0.0);
        for cuts in self.sections.windows(2) {
            let (area, down) = (cuts[0].area + cuts[1].area, cuts[1].middle - cuts[0].middle);
            let volume = 0.5 * area.dot(down);
            most += 0.5 * area.length() * down.length();
            *(if volume > 0.0 { &mut right } else { &mut wrong }) += volume.abs();
        }
        let faces = |cuts: &[Section]| {
            let (area, next, down) = (cuts[1].area, cuts[2].area, cuts[2].middle - cuts[0].middle);
            area.dot(down) > LEAST_FACING * area.length() * down.length() && area.dot(next) >= 0.0
        };
        let enclosed = right - wrong;
        // Cuts and the net tell of the surface as it is drawn, but where it is folded.
        let rough = volume_of(net, plan.key.columns);
        let is_plain = enclosed >= PLAIN * most && rough >= PLAIN * enclosed;
        wrong <= MOST_WRONG * right
            && enclosed >= LEAST_FACING * most
            && rough >= LEAST_FACING * enclosed
            && (is_plain || self.drawn_volume(plan) >= LEAST_FACING * enclosed)
            && (!plan.poles || self.sections.windows(3).all(faces))
    }

    /// Cuts the surface at every ring of vertices.
    fn cut(&mut self, plan: &SurfacePlan, net: &[[f32; 3]]) {
        self.sections.clear();
        self.rings.clear();
        for (first, weights) in &plan.weights {
            let start = self.rings.len();
            self.rings.push(Vec3::ZERO);
            self.rings.extend(net.chunks_exact(plan.key.columns).map(|row| {
                let mut point = Vec3::ZERO;
                for (column, weight) in row[*first..].iter().zip(weights) {
                    point += Vec3::from(*column) * *weight;
                }
                point
            }));
            let (first, last) = (start + 1, self.rings.len() - 1);
            self.sections.push(Section::of(&self.rings[first..]));
            self.rings[start] = self.rings[last];
            self.rings.extend_from_within(first..first + 2);
        }
    }

    /// What the surface that was cut encloses as it is drawn, with its samples around, m^3.
    fn drawn_volume(&mut self, plan: &SurfacePlan) -> f32 {
        let origin = self.rings.first().copied().unwrap_or_default();
        self.corners.clear();
        for ring in self.rings.chunks_exact(plan.key.rows + 3) {
            self.corners.extend(plan.around.iter().map(|(first, weights)| {
                let mut corner = -origin;
                for (point, weight) in ring[*first..].iter().zip(weights) {
                    corner += *point * *weight;
                }
                corner
            }));
        }
        let around = plan.around.len();
        let mut six = 0.0;
        for (upper, lower) in self.corners.chunks_exact(around).zip(self.corners[around..].chunks_exact(around)) {
            let mut before = around - 1;
            for k in 0..around {
                six += cell(upper[before], upper[k], lower[before], lower[k]);
                before = k;
            }
        }
        six / 6.0
    }

    fn evaluate(&mut self, plan: &SurfacePlan, net: &[[f32; 3]]) {
        self.vertices.resize(plan.vertex_count(), FlameVertex::default());
        let vertices = &mut self.vertices;
        // Nets are finite and of the plan's size, so this does not fail; if it did, the last surface would stay.
        let _ = plan.grid.evaluate(net, None, &mut self.scratch, |i, v| {
            vertices[i].position = v.position;
            vertices[i].normal = v.normal;
            vertices[i].uv = [v.u, 1.0 - v.v];
        });
        for (ring, section) in self.sections.iter().enumerate() {
            let range = plan.ring(ring);
            let radius = half_thickness(&self.vertices[range.clone()]);
            for vertex in &mut self.vertices[range] {
                vertex.height = section.height;
                vertex.radius_m = radius;
            }
        }
    }

    /// The mean length from the root up to each column of the net, as a fraction of the whole.
    fn measure_columns(&mut self, plan: &SurfacePlan, net: &[[f32; 3]]) {
        let n = plan.key.columns;
        self.columns.resize(n, 0.0);
        self.columns.fill(0.0);
        // From the peripheral root (column n - 2) up to the tip (column 0).
        for row in net.chunks_exact(n) {
            for c in 0..n - 2 {
                self.columns[c] += Vec3::from(row[c]).distance(Vec3::from(row[c + 1]));
            }
        }
        for c in (0..n - 2).rev() {
            self.columns[c] += self.columns[c + 1];
        }
        let total = self.columns[0].max(1e-12);
        self.columns.iter_mut().for_each(|h| *h /= total);
    }
}

/// What a net encloses, m^3: its rows run clockwise seen from the tip, its columns from tip to root.
fn volume_of(net: &[[f32; 3]], columns: usize) -> f32 {
    let origin = Vec3::from(net[0]);
    let at = |point: [f32; 3]| Vec3::from(point) - origin;
    let mut six = 0.0;
    let mut before = &net[net.len() - columns..];
    for row in net.chunks_exact(columns) {
        for (a, b) in before.windows(2).zip(row.windows(2)) {
            six += cell(at(a[0]), at(b[0]), at(a[1]), at(b[1]));
        }
        before = row;
    }
    six / 6.0
}

/// Six times the volume between a cell and the origin: two corners, and the next towards the root below each. Twisted
/// cells enclose more or less by the diagonal along which they are cut: the one that is drawn.
fn cell(a: Vec3, b: Vec3, below_a: Vec3, below_b: Vec3) -> f32 {
    a.dot(below_b.cross(below_a - b))
}

/// Half the distance between the two sides of a ring: vertex i mirrors vertex n - i about the wick.
fn half_thickness(ring: &[FlameVertex]) -> f32 {
    let last = ring.len() - 1;
    let mut widest = 0.0_f32;
    for i in 1..=last / 2 {
        let (a, b) = (Vec3::from(ring[i].position), Vec3::from(ring[last - i].position));
        widest = widest.max(a.distance_squared(b));
    }
    (0.5 * widest.sqrt()).max(THINNEST_M)
}
