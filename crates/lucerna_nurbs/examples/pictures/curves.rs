//! What can be done to curves, with their control points before and after.

use crate::svg::{At, Sheet};
use lucerna_nurbs::{Curve, KnotVector, NurbsError, Spacing};

const CURVE: &str = "#c8401a";
const NET: &str = "#9aa3ad";
const POINT: &str = "#20262c";

pub(crate) fn draw() -> Result<String, NurbsError> {
    let mut sheet = Sheet::new(3);
    let points = vec![[0.02, 0.1], [0.1, 0.9], [0.45, 0.95], [0.5, 0.2], [0.85, 0.05], [0.98, 0.7]];
    let wave = Curve::new(KnotVector::clamped_uniform(3, points.len())?, points, None)?;

    sheet.panel("a cubic and its control points");
    with_net(&mut sheet, &wave)?;

    sheet.panel("knots inserted: the same curve");
    with_net(&mut sheet, &wave.refine(&[0.2, 0.5, 0.8])?)?;

    sheet.panel("in Bézier pieces");
    for (index, piece) in wave.bezier_pieces()?.iter().enumerate() {
        line(&mut sheet, piece, ["#c8401a", "#2a6f97"][index % 2])?;
        net(&mut sheet, piece);
    }

    sheet.panel("weights 0.2, 1, 5 on one point");
    for (weight, color) in [(0.2, "#e9a13b"), (1.0, CURVE), (5.0, "#7a1d1d")] {
        let mut weights = vec![1.0; 6];
        weights[2] = weight;
        let curve = Curve::new(wave.knots().clone(), wave.points().to_vec(), Some(weights))?;
        line(&mut sheet, &curve, color)?;
    }
    net(&mut sheet, &wave);

    sheet.panel("through points, and near points");
    let given: Vec<At> = (0..9).map(|k| spiral(f64::from(k) / 8.0)).collect();
    let through = Curve::interpolate(3, &widen(&given), &Spacing::Centripetal.parameters(&widen(&given))?)?;
    line(&mut sheet, &through, CURVE)?;
    given.iter().for_each(|at| sheet.dot(*at, POINT, 3.0));
    let noisy: Vec<[f64; 2]> = (0..60)
        .map(|k| {
            let x = f64::from(k) / 59.0;
            [x, 0.14 + 0.1 * (7.0 * x).sin() + 0.03 * (f64::from(k) * 12.9898).sin()]
        })
        .collect();
    let near = Curve::approximate(3, 8, &noisy, &Spacing::Even.parameters(&noisy)?)?;
    noisy.iter().for_each(|at| sheet.dot(narrow(*at), NET, 1.8));
    line(&mut sheet, &near, "#2a6f97")?;

    sheet.panel("closed; the closest points to others");
    let corners = vec![[0.1, 0.2], [0.5, 0.02], [0.95, 0.3], [0.6, 0.55], [0.8, 0.98], [0.2, 0.85]];
    let closed = Curve::closed(3, corners, None)?;
    line(&mut sheet, &closed, CURVE)?;
    for from in [[0.02, 0.5], [0.45, 0.5], [0.9, 0.62], [0.35, 0.05], [0.98, 0.95], [0.3, 0.35]] {
        let found = closed.closest_point(from)?;
        sheet.line([from, found.point].map(narrow), NET, 1.0);
        sheet.dot(narrow(from), POINT, 3.0);
        sheet.dot(narrow(found.point), CURVE, 3.0);
    }
    Ok(sheet.finish())
}

fn with_net(sheet: &mut Sheet, curve: &Curve<f64, 2>) -> Result<(), NurbsError> {
    net(sheet, curve);
    line(sheet, curve, CURVE)
}

fn net(sheet: &mut Sheet, curve: &Curve<f64, 2>) {
    sheet.line(curve.points().iter().map(|at| narrow(*at)), NET, 1.0);
    curve.points().iter().for_each(|at| sheet.dot(narrow(*at), POINT, 3.0));
}

fn line(sheet: &mut Sheet, curve: &Curve<f64, 2>, color: &str) -> Result<(), NurbsError> {
    let (lo, hi) = curve.domain();
    let at = |k: u32| curve.point(lo + (hi - lo) * f64::from(k) / 100.0).map(narrow);
    let path = (0..=100).map(at).collect::<Result<Vec<_>, _>>()?;
    sheet.line(path, color, 2.0);
    Ok(())
}

fn spiral(t: f64) -> At {
    let (sin, cos) = (9.0 * t).sin_cos();
    let radius = 0.03 + 0.3 * t;
    [(0.5 + radius * cos) as f32, (0.62 + radius * sin) as f32]
}

fn narrow(at: [f64; 2]) -> At {
    at.map(|x| x as f32)
}

fn widen(points: &[At]) -> Vec<[f64; 2]> {
    points.iter().map(|at| at.map(f64::from)).collect()
}
