//! What can be wrong with a curve, a surface or a grid.

use thiserror::Error;

/// Why knots, points, weights, a parameter or a grid were refused.
///
/// Every variant names the entry, the value found and what is allowed. Values are given as `f64`
/// whatever the scalar type.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum NurbsError {
    /// The degree does not fit the number of control points.
    #[error(
        "degree {degree} with {count} control points: the degree must be 1 to {max} and below the number of points",
        max = crate::MAX_DEGREE
    )]
    Degree {
        /// The degree asked for.
        degree: usize,
        /// The number of control points.
        count: usize,
    },
    /// More control points in one direction than the crate accepts.
    #[error(
        "{count} control points in one direction: at most {max} are allowed",
        max = crate::MAX_POINTS
    )]
    TooManyPoints {
        /// The number of control points.
        count: usize,
    },
    /// The knot vector is too short for its degree.
    #[error("{found} knots: degree {degree} needs at least {needed}")]
    KnotCount {
        /// The number of knots given.
        found: usize,
        /// The degree.
        degree: usize,
        /// The least number of knots, `2 (degree + 1)`.
        needed: usize,
    },
    /// A knot is NaN, infinite or so large that differences overflow.
    #[error("knot {index} is {value}: knots must be finite, of magnitude at most {limit:e}")]
    KnotValue {
        /// The index in the knot vector.
        index: usize,
        /// The knot.
        value: f64,
        /// The largest magnitude allowed.
        limit: f64,
    },
    /// A knot lies below the one before it.
    #[error("knot {index} is {value}, below knot {index} - 1, {previous}: knots must not decrease")]
    KnotDecreasing {
        /// The index in the knot vector.
        index: usize,
        /// The knot.
        value: f64,
        /// The knot before it.
        previous: f64,
    },
    /// A knot is repeated more often than its place allows.
    #[error(
        "knot {index}, {value}, occurs {times} times: at most {allowed} are allowed (degree + 1 at the ends, degree inside)"
    )]
    KnotRepeated {
        /// The index of its first occurrence.
        index: usize,
        /// The knot.
        value: f64,
        /// How often it occurs.
        times: usize,
        /// How often it may occur.
        allowed: usize,
    },
    /// A domain, from knot `degree` to knot `count`, or a part to be cut out, has no length.
    #[error("the domain from {lo} to {hi} is empty: the first must be below the second")]
    EmptyDomain {
        /// The lower end.
        lo: f64,
        /// The upper end.
        hi: f64,
    },
    /// The knots do not repeat, so that the direction cannot be closed.
    #[error("knot spacing {index} is {value}, its repetition one period on is {repeated}: periodic knots must repeat")]
    NotPeriodic {
        /// The index of the knot where the spacing starts.
        index: usize,
        /// The spacing.
        value: f64,
        /// The spacing one period later.
        repeated: f64,
    },
    /// The number of control points does not match the knots.
    #[error("{found} control points: the knots need {expected}")]
    PointCount {
        /// The number of points given.
        found: usize,
        /// The number that fits.
        expected: usize,
    },
    /// A coordinate is NaN, infinite or so large that sums overflow.
    #[error(
        "control point {index}, coordinate {axis}, is {value}: coordinates must be finite, of magnitude at most {limit:e}"
    )]
    PointValue {
        /// The index of the control point.
        index: usize,
        /// The coordinate, 0 for x.
        axis: usize,
        /// The value.
        value: f64,
        /// The largest magnitude allowed.
        limit: f64,
    },
    /// The number of weights is not the number of control points.
    #[error("{found} weights: {expected} are needed, one for each control point")]
    WeightCount {
        /// The number of weights given.
        found: usize,
        /// The number of control points.
        expected: usize,
    },
    /// A weight is NaN, zero, negative or extreme.
    #[error(
        "weight {index} is {value}: weights must be {lo:e} to {hi:e}",
        lo = crate::MIN_WEIGHT,
        hi = crate::MAX_WEIGHT
    )]
    Weight {
        /// The index of the weight.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// A parameter is NaN or outside the domain.
    #[error("parameter {name} is {value}: it must be {lo} to {hi}")]
    Parameter {
        /// `"u"`, `"v"` or `"t"`.
        name: &'static str,
        /// The parameter.
        value: f64,
        /// The lower end of the domain.
        lo: f64,
        /// The upper end of the domain.
        hi: f64,
    },
    /// More derivatives were asked for than the crate evaluates at once.
    #[error("derivatives up to order {order}: at most {max} are allowed", max = crate::MAX_DEGREE)]
    Order {
        /// The order asked for.
        order: usize,
    },
    /// A number, such as that of the cells of a grid, is out of range.
    #[error("{found} {name}: {min} to {max} are allowed")]
    Cells {
        /// What is counted, such as `"columns"`, `"rows"` or `"vertices"`.
        name: &'static str,
        /// The number asked for.
        found: usize,
        /// The least.
        min: usize,
        /// The most.
        max: usize,
    },
    /// An output is too short for the mesh.
    #[error("room for {found} vertices: {needed} are needed")]
    Room {
        /// The number of vertices that fit in.
        found: usize,
        /// The number of vertices of the mesh.
        needed: usize,
    },
    /// An attribute of a vertex reaches into the next one.
    #[error("{name} takes {len} scalars from {offset} on: it must end within the stride of {stride}")]
    Layout {
        /// `"position"`, `"normal"`, `"uv"` or `"vertex"`.
        name: &'static str,
        /// Where it starts.
        offset: usize,
        /// Its length.
        len: usize,
        /// Scalars from one vertex to the next.
        stride: usize,
    },
    /// The control row at which a closed grid shall start does not exist.
    #[error("start row {row}: it must be below {count}, the number of distinct control rows")]
    StartRow {
        /// The row asked for.
        row: usize,
        /// The number of distinct rows.
        count: usize,
    },
    /// Poles were declared in a direction that is closed.
    #[error("a pole was declared at an end of v, but v is closed: poles need `Closure::Open`")]
    PoleOnClosed,
    /// A slit was declared where there can be none.
    #[error("a slit was declared at an end of v: slits need a closed u, an open v and no pole at the same end")]
    Slit,
    /// A tolerance or a size is not a positive number.
    #[error("{name} is {value}: it must be positive and finite")]
    NotPositive {
        /// What was given.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The number of parameters is not the number of points along their direction.
    #[error("{found} parameters {name}: {expected} are needed")]
    ParameterCount {
        /// `"u"`, `"v"` or `"t"`.
        name: &'static str,
        /// The number of parameters given.
        found: usize,
        /// The number that fits.
        expected: usize,
    },
    /// The parameters of points do not rise.
    #[error("parameter {name} number {index} is {value}, the one before it {previous}: parameters of points must rise")]
    ParameterOrder {
        /// `"u"`, `"v"` or `"t"`.
        name: &'static str,
        /// The index of the parameter.
        index: usize,
        /// The parameter.
        value: f64,
        /// The parameter before it.
        previous: f64,
    },
    /// All points are the same, so that distances do not tell them apart.
    #[error("all points coincide: parameters by distance need points that differ")]
    Coincident,
    /// More control points were asked for than there are points to fit.
    #[error("{found} control points for {max} points to fit: there can be at most as many")]
    FitCount {
        /// The number of control points asked for.
        found: usize,
        /// The number of points given.
        max: usize,
    },
    /// The points to fit leave a control point undetermined.
    #[error("control point {index} is not determined: too few of the parameters lie near it")]
    Undetermined {
        /// The index of the control point in its direction.
        index: usize,
    },
    /// What shall be met exactly cannot be, or is asked for twice.
    #[error("the exact samples contradict or repeat each other")]
    Contradiction,
    /// An angle is out of range.
    #[error("the angle {name} is {value}: it must be above 0 and at most 2 pi")]
    Angle {
        /// Which angle.
        name: &'static str,
        /// The angle in radians.
        value: f64,
    },
    /// A vector that must have a direction has none.
    #[error("the vector {name} has no direction: it must be finite and not zero")]
    NoDirection {
        /// Which vector.
        name: &'static str,
    },
    /// Too few curves to lay a surface through.
    #[error("{found} sections: degree {degree} across them needs at least {needed}")]
    Sections {
        /// The number of curves given.
        found: usize,
        /// The degree across them.
        degree: usize,
        /// The least number.
        needed: usize,
    },
    /// The surface has no tangent plane at a parameter.
    #[error("no normal at u = {u}, v = {v}: the surface is degenerate there")]
    NoNormal {
        /// The first parameter.
        u: f64,
        /// The second parameter.
        v: f64,
    },
}
