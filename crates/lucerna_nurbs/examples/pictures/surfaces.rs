//! Surfaces of many kinds, tessellated and shaded by their normals.

use crate::svg::{At, Sheet};
use lucerna_nurbs::{Closure, Curve, GridOptions, GridPlan, KnotVector, NurbsError, Spacing, Surface};
use std::f64::consts::{PI, TAU};

type Point = [f64; 3];

pub(crate) fn draw() -> Result<String, NurbsError> {
    let mut sheet = Sheet::new(3);
    let round = GridOptions { columns: 32, rows: 16, closure_u: Closure::Joined, ..GridOptions::default() };

    sheet.panel("sphere: right normals at the poles");
    let poles = GridOptions { pole_v_min: true, pole_v_max: true, ..round };
    shade(&mut sheet, &Surface::sphere([0.0; 3], 1.0)?, poles, true)?;

    sheet.panel("torus: closed in both directions");
    let both = GridOptions { closure_v: Closure::Joined, ..round };
    shade(&mut sheet, &Surface::torus([0.0; 3], 1.0, 0.45)?, both, true)?;

    sheet.panel("lofted through five circles");
    let sections = [(0.45, 0.0), (0.8, 0.5), (0.35, 1.3), (0.3, 1.6), (0.5, 2.0)]
        .map(|(r, y)| Curve::circle([0.0, y, 0.0], [r, 0.0, 0.0], [0.0, 0.0, -r]))
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    shade(&mut sheet, &Surface::loft(&sections, 3)?.0, GridOptions { rows: 18, ..round }, false)?;

    sheet.panel("a profile, revolved three quarters round");
    let profile = vec![[0.0, 0.0, 0.0], [1.2, 0.1, 0.0], [0.2, 0.7, 0.0], [0.9, 1.3, 0.0], [0.5, 1.8, 0.0]];
    let profile = Curve::new(KnotVector::clamped_uniform(3, 5)?, profile, None)?;
    let turned = profile.revolve([0.0; 3], [0.0, 1.0, 0.0], 1.5 * PI)?;
    shade(&mut sheet, &turned, GridOptions { columns: 24, rows: 24, ..GridOptions::default() }, false)?;

    sheet.panel("through 9 x 9 points");
    let points: Vec<Point> = (0..81)
        .map(|k| [f64::from(k / 9) / 4.0 - 1.0, f64::from(k % 9) / 4.0 - 1.0])
        .map(|[x, z]| [x, 0.35 * (3.0 * x).sin() * (2.5 * z).cos(), -z])
        .collect();
    let (u, v) = Spacing::ChordLength.grid(&points, 9)?;
    let hills = Surface::interpolate(3, 3, &points, &u, &v)?;
    let eye = shade(&mut sheet, &hills, GridOptions { columns: 24, rows: 24, ..GridOptions::default() }, false)?;
    points.iter().for_each(|point| sheet.dot(eye.project(*point), "#20262c", 2.0));

    sheet.panel("a flame over a wick, and its control net");
    let (rows, columns) = (10, 8);
    let net = flame();
    let surface = Surface::closed_u(3, KnotVector::clamped_uniform(3, columns)?, net.clone(), None)?;
    let closed = GridOptions { rows: 28, closure_u: Closure::Periodic { start_row: 0 }, ..round };
    let eye = shade(&mut sheet, &surface, closed, true)?;
    for row in net.chunks(columns) {
        sheet.line(row.iter().map(|point| eye.project(*point)), "#6b7680", 0.8);
    }
    for column in 0..columns {
        let around = (0..=rows).map(|row| eye.project(net[row % rows * columns + column]));
        sheet.line(around, "#6b7680", 0.8);
    }
    Ok(sheet.finish())
}

/// Ten rows around a wick of four leads, pinched to the wick's line at both ends.
fn flame() -> Vec<Point> {
    let leads = [0., 0., 1., 2., 3., 3., 3., 2., 1., 0.];
    let sides = [0., 1., 1., 1., 1., 0., -1., -1., -1., -1.];
    let ends = [-1., 0., 0., 0., 0., 1., 0., 0., 0., 0.];
    let widths = [0., 0.8, 1., 0.9, 0.7, 0.5, 0.3, 0.];
    (0..80)
        .map(|k| (k / 8, k % 8))
        .map(|(i, j)| {
            let sway = 0.3 * (j as f64 * 0.9 + 0.4 * leads[i]).sin();
            let along = (leads[i] - 1.5) * (1.0 - 0.12 * j as f64);
            [along + widths[j] * ends[i] + sway, j as f64 * 0.8, widths[j] * sides[i]]
        })
        .collect()
}

/// How space is seen: turned, tilted, and fitted into a panel.
struct Eye {
    right: Point,
    up: Point,
    back: Point,
    middle: Point,
    scale: f64,
}

impl Eye {
    fn new(points: &[Point]) -> Self {
        let ((sin, cos), (rise, flat)) = ((TAU * 0.09).sin_cos(), (TAU * 0.07).sin_cos());
        let right = [cos, 0.0, -sin];
        let up = [-rise * sin, flat, -rise * cos];
        let back = [flat * sin, rise, flat * cos];
        let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
        for point in points {
            for (axis, along) in [right, up, back].into_iter().enumerate() {
                low[axis] = low[axis].min(dot(along, *point));
                high[axis] = high[axis].max(dot(along, *point));
            }
        }
        let middle = [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]));
        let scale = 1.0 / (high[0] - low[0]).max(high[1] - low[1]);
        Self { right, up, back, middle, scale }
    }

    fn project(&self, point: Point) -> At {
        let place = |along, middle| (0.5 + (dot(along, point) - middle) * self.scale) as f32;
        [place(self.right, self.middle[0]), place(self.up, self.middle[1])]
    }
}

/// Tessellates a surface and draws its cells from back to front; of a solid only those that face the eye.
fn shade(sheet: &mut Sheet, surface: &Surface<f64>, options: GridOptions, is_solid: bool) -> Result<Eye, NurbsError> {
    let plan = GridPlan::new(surface.knots_u(), surface.knots_v(), options)?;
    let mut vertices = vec![([0.0; 3], [0.0; 3]); plan.vertex_count()];
    // A plan counts the rows that close a surface once.
    let distinct = plan.point_count();
    let weights = surface.weights().map(|weights| &weights[..distinct]);
    plan.evaluate(&surface.points()[..distinct], weights, &mut plan.scratch(), |index, vertex| {
        vertices[index] = (vertex.position, vertex.normal);
    })?;
    let points: Vec<Point> = vertices.iter().map(|(position, _)| *position).collect();
    let eye = Eye::new(&points);
    // Two triangles that follow each other make a cell; at a pole one does.
    let mut cells: Vec<Vec<usize>> = Vec::new();
    for corners in plan.indices().chunks(3).map(|corners| [0, 1, 2].map(|k| corners[k] as usize)) {
        match cells.last_mut() {
            Some(last) if last.len() == 3 && last[0] == corners[0] && last[2] == corners[1] => last.push(corners[2]),
            _ => cells.push(corners.to_vec()),
        }
    }
    let mean = |cell: &[usize], of: &dyn Fn(usize) -> f64| cell.iter().map(|&k| of(k)).sum::<f64>() / cell.len() as f64;
    let depth = |cell: &[usize]| mean(cell, &|k| dot(eye.back, points[k]));
    cells.retain(|cell| !is_solid || mean(cell, &|k| dot(eye.back, vertices[k].1)) > -0.3);
    cells.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    for cell in cells {
        let normal = [0, 1, 2].map(|axis| mean(&cell, &|k| vertices[k].1[axis]));
        // The far sides of open surfaces are seen from behind.
        let sign = if dot(normal, eye.back) < 0.0 { -1.0 } else { 1.0 };
        let sun: Point = [-0.45, 0.75, 0.48];
        let light = 0.25 + 0.75 * (sign * dot(normal, sun)).max(0.0);
        let tint = if sign > 0.0 { [236.0, 120.0, 48.0] } else { [96.0, 130.0, 160.0] };
        sheet.polygon(cell.iter().map(|&k| eye.project(points[k])), tint.map(|channel| (channel * light) as u8));
    }
    Ok(eye)
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
