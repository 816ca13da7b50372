//! Flame nets: closed around, pinched to a slit or a point below and above.

use lucerna_nurbs::{Closure, GridOptions, GridPlan, GridVertex, KnotVector};
use std::collections::HashMap;

type Point = [f32; 3];

/// A sequence of numbers in -1 to 1 that look random.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 23) as f32 - 1.0
    }

    fn about(&mut self, [x, y, z]: Point, by: f32) -> Point {
        [x + by * self.next(), y + by * self.next(), z + by * self.next()]
    }
}

/// For each peripheral row, its nearest lead.
fn nearest(leads: usize) -> Vec<usize> {
    if leads == 1 {
        return vec![0; 4];
    }
    let along = 0..leads;
    let mut all = vec![0];
    all.extend(along.clone());
    all.push(leads - 1);
    all.extend(along.rev());
    all
}

/// The net of a wick along x with `leads` leads, or of a candle with one.
fn flame(leads: usize, columns: usize, noise: f32, seed: u64, at: Point) -> Vec<Point> {
    let mut random = Noise(seed);
    let rows = nearest(leads);
    let x = |lead: usize| at[0] + lead as f32 * 0.1;
    let roots: Vec<Point> = (0..leads).map(|k| random.about([x(k), at[1], at[2]], noise * 0.02)).collect();
    let tips: Vec<Point> = (0..leads).map(|k| random.about([x(k), at[1] + 0.5, at[2]], noise * 0.05)).collect();
    let mut net = Vec::new();
    for (row, &lead) in rows.iter().enumerate() {
        // Counter-clockwise from above: the near side (z > 0) from left to right.
        let n = rows.len();
        let side = if row == 0 || row == n / 2 {
            0.0
        } else if row < n / 2 {
            0.08
        } else {
            -0.08
        };
        let end = if row == 0 {
            -0.08
        } else if row == n / 2 {
            0.08
        } else {
            0.0
        };
        net.push(roots[lead]);
        for k in 1..columns - 1 {
            let height = 0.5 * k as f32 / (columns - 1) as f32;
            let width = 1.0 - 0.6 * height;
            let p = [x(lead) + end * width, at[1] + height, at[2] + side * width];
            net.push(random.about(p, noise * 0.02));
        }
        net.push(tips[lead]);
    }
    net
}

struct Mesh {
    vertices: Vec<GridVertex<f32>>,
    indices: Vec<u32>,
}

fn mesh(leads: usize, net: &[Point], options: GridOptions) -> Mesh {
    let around = KnotVector::<f32>::periodic(3, nearest(leads).len()).unwrap();
    let n_v = net.len() / nearest(leads).len();
    let mut inner: Vec<f32> = (1..n_v - 3).map(|k| k as f32 / (n_v - 3) as f32).collect();
    // A flame's first inner knot may be anywhere.
    if let Some(first) = inner.first_mut() {
        *first *= 0.5;
    }
    let along = KnotVector::clamped(3, &inner).unwrap();
    let plan = GridPlan::new(&around, &along, options).unwrap();
    let mut vertices = Vec::new();
    let emit = |_, vertex| vertices.push(vertex);
    plan.evaluate(net, None, &mut plan.scratch(), emit).unwrap();
    Mesh { vertices, indices: plan.indices().to_vec() }
}

fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Every edge between welded vertices belongs to two triangles, once in each direction. Returns the
/// volume inside.
fn check_closed(mesh: &Mesh, what: &str) -> f32 {
    let mut places = HashMap::new();
    let mut weld = |index: u32| {
        // Adding zero makes one zero of two.
        let key = mesh.vertices[index as usize].position.map(|x| (x + 0.0).to_bits());
        let next = places.len();
        *places.entry(key).or_insert(next)
    };
    let mut edges: HashMap<(usize, usize), usize> = HashMap::new();
    let mut volume = 0.0;
    let center = mesh.vertices[mesh.vertices.len() / 2].position;
    for triangle in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| weld(triangle[k]));
        if a == b || b == c || c == a {
            continue;
        }
        for edge in [(a, b), (b, c), (c, a)] {
            *edges.entry(edge).or_default() += 1;
        }
        let [p, q, r] = [0, 1, 2].map(|k| sub(mesh.vertices[triangle[k] as usize].position, center));
        volume += dot(p, cross(q, r));
    }
    for (&(a, b), &count) in &edges {
        let back = edges.get(&(b, a)).copied().unwrap_or(0);
        assert_eq!((count, back), (1, 1), "{what}: edge {a} {b}");
    }
    volume / 6.0
}

fn check_normals(mesh: &Mesh, least: f32, what: &str) {
    // The seam is one place, unlike the two sides of a slit.
    let place = |index: u32| {
        let vertex = &mesh.vertices[index as usize];
        let u = if vertex.u == 1.0 { 0.0 } else { vertex.u };
        (u.to_bits(), vertex.v.to_bits())
    };
    let mut faces: HashMap<_, Point> = HashMap::new();
    for triangle in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.vertices[triangle[k] as usize].position);
        let area = cross(sub(b, a), sub(c, a));
        for &index in triangle {
            for (sum, x) in faces.entry(place(index)).or_default().iter_mut().zip(area) {
                *sum += x;
            }
        }
    }
    for (k, vertex) in mesh.vertices.iter().enumerate() {
        let face = faces[&place(k as u32)];
        let n = vertex.normal;
        assert!((dot(n, n).sqrt() - 1.0).abs() < 1e-4, "{what}: normal {k} is {n:?}");
        let length = dot(face, face).sqrt();
        if length > 1e-7 {
            let cosine = dot(n, face) / length;
            // At the ends of a slit the limit normal turns within one cell.
            let at_edge = vertex.v == 0.0 || vertex.v == 1.0;
            let least = if at_edge { least - 0.8 } else { least };
            assert!(cosine > least, "{what}: normal {k} {n:?} against {face:?}: {cosine}");
        }
    }
}

const GRIDS: [(usize, usize); 12] =
    [(3, 2), (4, 2), (3, 3), (5, 4), (8, 6), (10, 10), (13, 9), (16, 16), (24, 7), (33, 32), (48, 48), (64, 64)];

fn options(columns: usize, rows: usize, poles: bool) -> GridOptions {
    GridOptions {
        columns,
        rows,
        closure_u: Closure::Periodic { start_row: 0 },
        pole_v_min: poles,
        pole_v_max: poles,
        ..GridOptions::default()
    }
}

#[test]
fn flames_are_closed_and_face_outwards() {
    for at in [[0.0; 3], [0.3, 1.0, -0.7], [100.0, 20.0, -50.0]] {
        for (leads, poles) in [(4, false), (2, false), (7, false), (1, true), (1, false)] {
            for (columns, rows) in GRIDS {
                for (noise, seed) in [(0.0, 1), (0.5, 2), (0.5, 3), (1.0, 4)] {
                    let net = flame(leads, 8, noise, seed, at);
                    let mesh = mesh(leads, &net, options(columns, rows, poles));
                    let what = format!("{leads} leads, {columns} x {rows}, noise {noise} at {at:?}");
                    let volume = check_closed(&mesh, &what);
                    assert!(volume > 0.0, "{what}: volume {volume}");
                    let fine = columns >= 16 && rows >= 16 && noise < 1.0 && at[0] < 1.0;
                    check_normals(&mesh, if fine { 0.3 } else { -1.1 }, &what);
                }
            }
        }
    }
}

#[test]
fn a_still_candle_has_the_normals_of_a_cone_at_its_poles() {
    let net = flame(1, 8, 0.0, 1, [0.0; 3]);
    let mesh = mesh(1, &net, options(32, 24, true));
    assert_eq!(mesh.indices.len(), 3 * 32 * (2 * 24 - 2));
    assert_eq!(mesh.vertices.len(), 33 * 25 - 2);
    for k in 0..32 {
        let bottom = mesh.vertices[k];
        assert_eq!(bottom.position, [0.0, 0.0, 0.0]);
        assert!(bottom.normal[1] < -0.3 && bottom.normal[1] > -0.9, "{bottom:?}");
        let top = mesh.vertices[mesh.vertices.len() - 32 + k];
        assert_eq!(top.position, [0.0, 0.5, 0.0]);
        assert!(top.normal[1] > 0.3 && top.normal[1] < 0.9, "{top:?}");
    }
    check_normals(&mesh, 0.9, "a still candle");
}

#[test]
fn mirrored_columns_of_a_slit_are_the_same_bits() {
    for columns in [3, 12, 31, 32] {
        let net = flame(4, 9, 1.0, 9, [3.0, 2.0, 1.0]);
        let mesh = mesh(4, &net, options(columns, 10, false));
        for row in [0, 10] {
            let vertex = |i: usize| mesh.vertices[row * (columns + 1) + i];
            for i in 0..=columns {
                assert_eq!(vertex(i).position, vertex(columns - i).position);
            }
            assert_eq!(vertex(0).normal, vertex(columns).normal);
        }
    }
}

#[test]
fn collapsed_nets_have_unit_normals() {
    let point = vec![[3.0f32, -2.0, 7.0]; 40];
    for poles in [false, true] {
        let dot_mesh = mesh(4, &point, options(12, 6, poles));
        for vertex in &dot_mesh.vertices {
            assert_eq!(vertex.position, [3.0, -2.0, 7.0]);
            assert_eq!(vertex.normal, [0.0, 1.0, 0.0]);
        }
    }
    // A net that is a line, one that is a sheet, one that is tiny and one that is huge.
    let line: Vec<Point> = (0..80).map(|k| [0.0, (k % 8) as f32, 0.0]).collect();
    let sheet: Vec<Point> = (0..80).map(|k| [(k / 8) as f32, (k % 8) as f32, 0.0]).collect();
    for vertex in mesh(4, &line, options(12, 6, false)).vertices {
        let down = if vertex.v == 0.0 { -1.0 } else { 1.0 };
        assert_eq!(vertex.normal, [0.0, down, 0.0]);
    }
    check_normals(&mesh(4, &sheet, options(12, 6, false)), -1.1, "sheet");
    let candle = flame(1, 8, 0.3, 5, [0.0; 3]);
    for scale in [1e-37f32, 1e-20, 1e20, 1e36] {
        let net: Vec<Point> = candle.iter().map(|p| p.map(|x| x * scale)).collect();
        let mesh = mesh(1, &net, options(16, 16, true));
        for vertex in &mesh.vertices {
            let n = vertex.normal;
            assert!((dot(n, n) - 1.0).abs() < 1e-4, "{scale}: {n:?}");
        }
    }
}
