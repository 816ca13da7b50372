//! Surfaces and curves of every kind, for tests that hold for all of them.

use lucerna_nurbs::{Curve, KnotVector, Surface};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// Numbers in -1 to 1 that look random.
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub(crate) fn points(&mut self, count: usize) -> Vec<[f64; 3]> {
        (0..count).map(|_| [self.next(), self.next(), self.next()]).collect()
    }

    pub(crate) fn weights(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| 4.0_f64.powf(self.next())).collect()
    }
}

/// The largest coordinate.
pub(crate) fn size(points: &[[f64; 3]]) -> f64 {
    points.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// From one end of the domain to the other: `samples + 1` parameters, and every knot.
pub(crate) fn parameters(knots: &KnotVector<f64>, samples: usize) -> Vec<f64> {
    let (lo, hi) = knots.domain();
    let even = (0..=samples).map(|k| if k == samples { hi } else { lo + (hi - lo) * k as f64 / samples as f64 });
    let mut all: Vec<f64> = even.chain(knots.as_slice().iter().copied().filter(|&t| t >= lo && t <= hi)).collect();
    all.sort_unstable_by(f64::total_cmp);
    all.dedup();
    all
}

/// Knots of a degree: clamped, with double or triple knots, uneven, unclamped, periodic.
pub(crate) fn knots(p: usize) -> Vec<KnotVector<f64>> {
    let mut all = vec![
        KnotVector::clamped_uniform(p, p + 1).unwrap(),
        KnotVector::clamped_uniform(p, p + 6).unwrap(),
        KnotVector::uniform(p, p + 5).unwrap(),
        KnotVector::periodic(p, p + 3).unwrap(),
        KnotVector::new(p, (0..2 * p + 6).map(|k| (k * k) as f64 * 0.1 - 1.0).collect()).unwrap(),
    ];
    let mut inner = vec![0.125];
    inner.extend(vec![0.375; p.min(2)]);
    inner.extend(vec![0.5; p.min(3)]);
    inner.extend([0.625, 0.8125]);
    all.push(KnotVector::clamped(p, &inner).unwrap());
    let full: Vec<f64> = [0.2, 0.7].iter().flat_map(|&t| vec![t; p]).collect();
    all.push(KnotVector::clamped(p, &full).unwrap());
    all
}

/// The circle in nine points, homogeneous: x, y, weight.
pub(crate) fn circle() -> (KnotVector<f64>, [[f64; 3]; 9]) {
    const H: f64 = FRAC_1_SQRT_2;
    let points = [
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
    (KnotVector::clamped(2, &[0.25, 0.25, 0.5, 0.5, 0.75, 0.75]).unwrap(), points)
}

/// A flame's net: closed around `leads` leads (one: a candle), pinched below and above.
pub(crate) fn flame(leads: usize, columns: usize) -> Surface<f64> {
    let lead = |row: usize| match (row, leads) {
        (_, 1) => 0,
        (0, _) => 0,
        (row, n) if row <= n => row - 1,
        (row, n) if row == n + 1 => n - 1,
        (row, n) => 2 * n + 1 - row,
    };
    let rows = 2 * leads + 2;
    let mut points = Vec::new();
    for row in 0..rows {
        let (sin, cos) = (row as f64 / rows as f64 * TAU).sin_cos();
        for k in 0..columns {
            let height = 0.5 * k as f64 / (columns - 1) as f64;
            let inner = k > 0 && k + 1 < columns;
            let width = if inner { 0.08 * (1.0 - 0.6 * height) } else { 0.0 };
            let at = lead(row) as f64 * 0.1;
            points.push([at - width * cos, height, width * sin]);
        }
    }
    Surface::closed_u(3, KnotVector::clamped_uniform(3, columns).unwrap(), points, None).unwrap()
}

/// Every kind of surface with a name.
pub(crate) fn surfaces() -> Vec<(String, Surface<f64>)> {
    let mut noise = Noise(7);
    let mut all = Vec::new();
    let (ring, arc) = circle();
    let lead = |profile: &[[f64; 3]], knots: KnotVector<f64>| {
        let pairs = arc.iter().flat_map(|a| profile.iter().map(move |b| (a, b)));
        let points = pairs.clone().map(|(a, b)| [b[0] * a[0], b[1], -b[0] * a[1]]).collect();
        let weights = pairs.map(|(a, b)| a[2] * b[2]).collect();
        Surface::new(ring.clone(), knots, points, Some(weights)).unwrap()
    };
    const H: f64 = FRAC_1_SQRT_2;
    let half = [[0.0, -1.0, 1.0], [1.0, -1.0, H], [1.0, 0.0, 1.0], [1.0, 1.0, H], [0.0, 1.0, 1.0]];
    all.push(("sphere".into(), lead(&half, KnotVector::clamped(2, &[0.5, 0.5]).unwrap())));
    all.push(("torus".into(), lead(&arc.map(|[x, y, w]| [3.0 + x, y, w]), ring.clone())));
    let line = [[1.0, 0.0, 1.0], [1.0, 2.0, 1.0]];
    all.push(("cylinder".into(), lead(&line, KnotVector::clamped_uniform(1, 2).unwrap())));
    let (u, v) = (KnotVector::clamped_uniform(3, 16).unwrap(), KnotVector::clamped_uniform(3, 11).unwrap());
    let net = Surface::new(u, v, noise.points(176), Some(noise.weights(176))).unwrap();
    all.push(("16 x 11 bicubic".into(), net));
    for p in 1..=7 {
        let q = 8 - p;
        for (i, u) in knots(p).into_iter().enumerate() {
            let v = knots(q).swap_remove((i + p) % 7);
            let n = u.count() * v.count();
            let weights = (i % 3 > 0).then(|| noise.weights(n));
            all.push((format!("degrees {p}, {q}, knots {i}"), Surface::new(u, v, noise.points(n), weights).unwrap()));
        }
    }
    all.push(("flame".into(), flame(4, 8)));
    all.push(("candle".into(), flame(1, 8)));
    all
}

/// Every kind of curve with a name.
pub(crate) fn curves() -> Vec<(String, Curve<f64, 3>)> {
    let mut noise = Noise(3);
    let mut all = Vec::new();
    let (ring, arc) = circle();
    let points = arc.map(|[x, y, _]| [x, y, 0.5]).to_vec();
    all.push(("circle".into(), Curve::new(ring, points, Some(arc.map(|a| a[2]).to_vec())).unwrap()));
    for p in 1..=7 {
        for (i, knots) in knots(p).into_iter().enumerate() {
            let n = knots.count();
            let weights = (i % 2 > 0).then(|| noise.weights(n));
            all.push((format!("degree {p}, knots {i}"), Curve::new(knots, noise.points(n), weights).unwrap()));
        }
    }
    all
}
