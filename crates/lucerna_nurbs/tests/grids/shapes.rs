//! Shapes of every kind, and a few operations on points.

use lucerna_nurbs::{Closure, GridOptions, KnotVector, Surface};
use std::f64::consts::{FRAC_1_SQRT_2 as H, TAU};

pub(crate) type Point = [f64; 3];

/// A shape, and how its grids close.
pub(crate) struct Shape {
    pub(crate) name: &'static str,
    pub(crate) knots: [KnotVector<f32>; 2],
    pub(crate) points: Vec<[f32; 3]>,
    pub(crate) weights: Option<Vec<f32>>,
    pub(crate) options: GridOptions,
    /// All triangles together have no boundary.
    pub(crate) closed: bool,
    /// The surface in double precision, with the points that close it, for the normals at poles.
    pub(crate) exact: Surface<f64>,
}

const RING: [[f64; 3]; 9] = [
    [1.0, 0.0, 1.0],
    [1.0, 1.0, H],
    [0.0, 1.0, 1.0],
    [-1.0, 1.0, H],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, H],
    [0.0, -1.0, 1.0],
    [1.0, -1.0, H],
    [1.0, 0.0, 1.0],
];
pub(crate) const QUARTERS: [f64; 6] = [0.25, 0.25, 0.5, 0.5, 0.75, 0.75];

fn shape(
    name: &'static str,
    knots: [&KnotVector<f64>; 2],
    net: &[Point],
    weights: Option<&[f64]>,
    options: GridOptions,
    closed: bool,
) -> Shape {
    // What is tested is the surface of the rounded numbers.
    let points: Vec<[f32; 3]> = net.iter().map(|p| p.map(|x| x as f32)).collect();
    let weights: Option<Vec<f32>> = weights.map(|w| w.iter().map(|&w| w as f32).collect());
    let [u, v] = knots.map(|knots| {
        let knots32 = knots.as_slice().iter().map(|&knot| knot as f32).collect();
        KnotVector::new(knots.degree(), knots32).unwrap()
    });
    let exact_knots = |knots: &KnotVector<f32>| {
        KnotVector::new(knots.degree(), knots.as_slice().iter().map(|&knot| f64::from(knot)).collect()).unwrap()
    };
    let rows = |closure, count: usize, degree: usize| match closure {
        Closure::Periodic { .. } => (0..count).map(|i| i % (count - degree)).collect::<Vec<_>>(),
        _ => (0..count).collect(),
    };
    let (rows_u, rows_v) =
        (rows(options.closure_u, u.count(), u.degree()), rows(options.closure_v, v.count(), v.degree()));
    let n_v = rows_v.iter().max().unwrap() + 1;
    let order = || rows_u.iter().flat_map(|i| rows_v.iter().map(move |j| i * n_v + j));
    let exact = Surface::new(
        exact_knots(&u),
        exact_knots(&v),
        order().map(|k| points[k].map(f64::from)).collect(),
        weights.as_ref().map(|w| order().map(|k| f64::from(w[k])).collect()),
    );
    Shape { name, knots: [u, v], points, weights, options, closed, exact: exact.unwrap() }
}

/// Leads a profile of radius, height and weight around the y axis.
fn revolved(profile: &[Point]) -> (Vec<Point>, Vec<f64>) {
    let pairs = || RING.iter().flat_map(|ring| profile.iter().map(move |point| (ring, point)));
    let points = pairs().map(|([x, z, _], [radius, y, _])| [radius * x, *y, -radius * z]).collect();
    (points, pairs().map(|(ring, point)| ring[2] * point[2]).collect())
}

/// A bent sheet of uneven points.
fn sheet(n_u: usize, n_v: usize) -> (Vec<Point>, Vec<f64>) {
    let points = (0..n_u * n_v).map(|k| {
        let (i, j) = ((k / n_v) as f64, (k % n_v) as f64);
        [i + 0.3 * (j * 1.3).sin(), (i * 0.9).sin() + (j * 0.7).cos(), j + 0.3 * (i * 1.1).cos()]
    });
    (points.collect(), (0..n_u * n_v).map(|k| 1.0 + 0.5 * (k as f64 * 0.77).sin()).collect())
}

/// A tube of uneven points around the y axis.
fn tube(n_u: usize, n_v: usize) -> (Vec<Point>, Vec<f64>) {
    let points = (0..n_u * n_v).map(|k| {
        let (angle, j) = ((k / n_v) as f64 / n_u as f64 * TAU, (k % n_v) as f64);
        let radius = 1.0 + 0.2 * (k as f64 * 1.7).sin();
        [radius * angle.cos(), 0.4 * j, -radius * angle.sin()]
    });
    (points.collect(), (0..n_u * n_v).map(|k| 1.0 + 0.5 * (k as f64 * 0.77).sin()).collect())
}

/// A flame over a wick, pinched to a slit below and above; over a point with one lead.
fn flame(leads: usize, columns: usize) -> Vec<Point> {
    let rows = if leads == 1 { 4 } else { 2 * leads + 2 };
    let mut net = Vec::new();
    for row in 0..rows {
        let half = rows / 2;
        let (side, end) = match row {
            0 => (0.0, -0.08),
            row if row == half => (0.0, 0.08),
            row if row < half => (0.08, 0.0),
            _ => (-0.08, 0.0),
        };
        let lead = if leads == 1 {
            0
        } else if row <= half {
            row.saturating_sub(1).min(leads - 1)
        } else {
            rows - 1 - row
        };
        let x = 0.1 * lead as f64;
        for k in 0..columns {
            let height = k as f64 / (columns - 1) as f64;
            let width = if k == 0 || k == columns - 1 { 0.0 } else { 1.0 - 0.6 * height };
            net.push([x + end * width, 0.5 * height, side * width]);
        }
    }
    net
}

pub(crate) fn shapes() -> Vec<Shape> {
    let base = GridOptions::default();
    let clamped = |degree, inner: &[f64]| KnotVector::clamped(degree, inner).unwrap();
    let ring = clamped(2, &QUARTERS);
    let joined = GridOptions { closure_u: Closure::Joined, ..base };
    let around = GridOptions { closure_u: Closure::Periodic { start_row: 0 }, ..base };
    let mut all = Vec::new();

    let half = [[0.0, -1.0, 1.0], [1.0, -1.0, H], [1.0, 0.0, 1.0], [1.0, 1.0, H], [0.0, 1.0, 1.0]];
    let (points, weights) = revolved(&half);
    let poles = GridOptions { pole_v_min: true, pole_v_max: true, ..joined };
    all.push(shape("sphere", [&ring, &clamped(2, &[0.5, 0.5])], &points, Some(&weights), poles, true));
    let (points, weights) = revolved(&RING.map(|[x, y, w]| [3.0 + x, y, w]));
    let both = GridOptions { closure_v: Closure::Joined, ..joined };
    all.push(shape("torus", [&ring, &ring], &points, Some(&weights), both, true));
    let arc: Vec<Point> = RING[..3].iter().flat_map(|p| [[p[0], 2.0, p[1]], [p[0], 0.0, p[1]]]).collect();
    let quarter = [&clamped(2, &[]), &clamped(1, &[])];
    all.push(shape("quarter cylinder", quarter, &arc, Some(&[1.0, 1.0, H, H, 1.0, 1.0]), base, false));

    let (points, weights) = tube(16, 11);
    let periodic = KnotVector::periodic(3, 16).unwrap();
    let along = KnotVector::clamped_uniform(3, 11).unwrap();
    all.push(shape("bicubic tube", [&periodic, &along], &points, Some(&weights), around, false));
    let both = GridOptions { closure_v: Closure::Periodic { start_row: 2 }, ..around };
    let (points, weights) = tube(16, 8);
    let ringed: Vec<Point> = points
        .iter()
        .enumerate()
        .map(|(k, [x, _, z])| {
            let angle = (k % 8) as f64 / 8.0 * TAU;
            [x * (3.0 + angle.cos()), angle.sin(), z * (3.0 + angle.cos())]
        })
        .collect();
    let small = KnotVector::periodic(2, 8).unwrap();
    all.push(shape("periodic both ways", [&periodic, &small], &ringed, Some(&weights), both, true));

    let doubled = clamped(3, &[0.2, 0.2, 0.5, 0.5, 0.5, 0.7]);
    let (points, weights) = sheet(doubled.count(), 7);
    let uneven = KnotVector::new(3, vec![-1.0, 0.0, 0.5, 2.0, 3.0, 3.5, 5.0, 6.0, 6.1, 7.0, 9.0]).unwrap();
    all.push(shape("double and triple knots, unclamped", [&doubled, &uneven], &points, Some(&weights), base, false));
    for (p, q, name) in [
        (1, 7, "degrees 1 and 7"),
        (2, 6, "degrees 2 and 6"),
        (5, 3, "degrees 5 and 3"),
        (4, 1, "degrees 4 and 1"),
        (7, 2, "degrees 7 and 2"),
    ] {
        let (u, v) = (KnotVector::clamped_uniform(p, p + 4).unwrap(), KnotVector::uniform(q, q + 3).unwrap());
        let (points, weights) = sheet(p + 4, q + 3);
        let weights = (p > 2).then_some(&weights[..]);
        all.push(shape(name, [&u, &v], &points, weights, base, false));
    }

    let up = clamped(3, &[0.1, 0.4, 0.6, 0.8]);
    let slits = GridOptions { slit_v_min: true, slit_v_max: true, ..around };
    all.push(shape("flame", [&KnotVector::periodic(3, 10).unwrap(), &up], &flame(4, 8), None, slits, true));
    let poles = GridOptions { pole_v_min: true, pole_v_max: true, ..around };
    all.push(shape("candle", [&KnotVector::periodic(3, 4).unwrap(), &up], &flame(1, 8), None, poles, true));
    all
}

pub(crate) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn degrees(a: Point, b: Point) -> f64 {
    dot(cross(a, b), cross(a, b)).sqrt().atan2(dot(a, b)).to_degrees()
}
