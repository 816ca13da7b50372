//! An evaluator that knows nothing but the bytes of a plan and a net, as a shader does.

use crate::shapes::shapes;
use lucerna_nurbs::{GridOptions, GridPlan, GridVertex};

type Vec3 = [f32; 3];

struct Tables(Vec<u32>);

/// A point of the surface about an origin, and its derivatives.
struct Jet {
    origin: Vec3,
    size: f32,
    s: Vec3,
    su: Vec3,
    sv: Vec3,
    suv: Vec3,
}

fn add(a: Vec3, b: Vec3, factor: f32) -> Vec3 {
    [a[0] + b[0] * factor, a[1] + b[1] * factor, a[2] + b[2] * factor]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn largest(a: Vec3) -> f32 {
    a.iter().fold(0.0, |most, x| most.max(x.abs()))
}

impl Tables {
    fn new(bytes: &[u8]) -> Self {
        let (words, rest) = bytes.as_chunks::<4>();
        assert!(rest.is_empty());
        Self(words.iter().map(|&word| u32::from_le_bytes(word)).collect())
    }

    fn word(&self, at: usize) -> usize {
        self.0[at] as usize
    }

    fn number(&self, at: usize) -> f32 {
        f32::from_bits(self.0[at])
    }

    /// Sums over the control points of a pair of samples that start at words `u` and `v`.
    fn jet(&self, net: &[Vec3], weights: Option<&[f32]>, u: usize, v: usize) -> Jet {
        let (n_v, p, q) = (self.word(4), self.word(5), self.word(6));
        let origin = net[self.word(u + 1) * n_v + self.word(v + 1)];
        let mut size = 0.0_f32;
        let mut sums = [[0.0; 3]; 4];
        let mut w = [0.0; 4];
        for i in 0..p {
            for j in 0..q {
                let index = self.word(u + 1 + i) * n_v + self.word(v + 1 + j);
                let weight = weights.map_or(1.0, |weights| weights[index]);
                let point = add(net[index], origin, -1.0);
                size = size.max(largest(point));
                let (value_u, slope_u) = (self.number(u + 1 + p + i), self.number(u + 1 + 2 * p + i));
                let (value_v, slope_v) = (self.number(v + 1 + q + j), self.number(v + 1 + 2 * q + j));
                let factors = [value_u * value_v, slope_u * value_v, value_u * slope_v, slope_u * slope_v];
                for k in 0..4 {
                    sums[k] = add(sums[k], point, factors[k] * weight);
                    w[k] += factors[k] * weight;
                }
            }
        }
        let divided = |a: Vec3| a.map(|x| x / w[0]);
        let s = divided(sums[0]);
        let su = divided(add(sums[1], s, -w[1]));
        let sv = divided(add(sums[2], s, -w[2]));
        let suv = divided(add(add(add(sums[3], s, -w[3]), sv, -w[1]), su, -w[2]));
        Jet { origin, size, s, su, sv, suv }
    }

    /// What thread `k` computes.
    fn vertex(&self, net: &[Vec3], weights: Option<&[f32]>, k: usize) -> GridVertex<f32> {
        let (columns, rows, flags) = (self.word(0), self.word(1), self.word(3));
        let first = columns + 1 - (flags >> 1 & 1);
        let (row, column) =
            if k < first { (0, k) } else { (1 + (k - first) / (columns + 1), (k - first) % (columns + 1)) };
        let (lower, upper) = (row == 0, row == rows);
        let pole = lower && flags & 2 != 0 || upper && flags & 4 != 0;
        let (width_u, width_v) = (1 + 3 * self.word(5), 1 + 3 * self.word(6));
        let u = self.word(if pole { 9 } else { 7 }) + column * width_u;
        let v = self.word(8) + row * width_v;
        let jet = self.jet(net, weights, u, v);
        let at = if pole { self.jet(net, weights, self.word(7), v) } else { self.jet(net, weights, u, v) };
        let flat = 64.0 * f32::EPSILON * jet.size;
        let mut su = jet.su;
        if flags & 8 != 0 && (lower || upper) && largest(su) <= flat && largest(jet.suv) > flat {
            su = if lower { jet.suv } else { jet.suv.map(|x| -x) };
        }
        let normal = cross(su, jet.sv);
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        let sign = if flags & 1 != 0 { -1.0 } else { 1.0 };
        GridVertex {
            position: add(at.origin, at.s, 1.0),
            normal: normal.map(|x| sign * x / length),
            u: self.number(u),
            v: self.number(v),
        }
    }
}

#[test]
fn the_bytes_of_a_plan_are_enough_for_its_meshes() {
    for shape in shapes() {
        let mut worst = [0.0_f32; 2];
        for (columns, rows, flip) in [(24, 12, false), (9, 7, true), (64, 48, false)] {
            let options = GridOptions { columns, rows, flip, ..shape.options };
            let plan = GridPlan::new(&shape.knots[0], &shape.knots[1], options).unwrap();
            let tables = Tables::new(&plan.tables_as_bytes());
            assert_eq!(tables.word(2), plan.vertex_count());
            assert_eq!(tables.word(10), plan.point_count());
            let size = shape.points.iter().fold(0.0, |size: f32, &p| size.max(largest(add(p, shape.points[0], -1.0))));
            let weights = shape.weights.as_deref();
            let mut found = Vec::new();
            plan.evaluate(&shape.points, weights, &mut plan.scratch(), |k, wanted| {
                let vertex = tables.vertex(&shape.points, weights, k);
                assert_eq!((vertex.u, vertex.v), (wanted.u, wanted.v));
                worst[0] = worst[0].max(largest(add(vertex.position, wanted.position, -1.0)) / size);
                // On a crease rounding may choose the side.
                if shape.knots.iter().all(|knots| knots.degree() > 1) && !shape.name.starts_with("double") {
                    worst[1] = worst[1].max(largest(add(vertex.normal, wanted.normal, -1.0)));
                }
                found.push(vertex);
            })
            .unwrap();
            if shape.closed {
                for row in found.chunk_by(|a, b| a.v == b.v).filter(|row| row.len() == columns + 1) {
                    assert_eq!(row[0].position, row[columns].position, "{}: the seam closes", shape.name);
                    assert_eq!(row[0].normal, row[columns].normal, "{}: the seam closes", shape.name);
                }
                let poles = found.chunk_by(|a, b| a.v == b.v).filter(|row| row.len() == columns);
                poles.for_each(|row| assert!(row.iter().all(|vertex| vertex.position == row[0].position)));
            }
        }
        println!("{}: positions within {:.1e} of the size, normals within {:.1e}", shape.name, worst[0], worst[1]);
        assert!(worst[0] < 1e-5 && worst[1] < 1e-4, "{}: {worst:?}", shape.name);
    }
}

#[test]
fn the_bytes_are_laid_out_as_documented() {
    let shape = &shapes()[0];
    let options = GridOptions { columns: 5, rows: 4, ..shape.options };
    let plan = GridPlan::new(&shape.knots[0], &shape.knots[1], options).unwrap();
    let bytes = plan.tables_as_bytes();
    let tables = Tables::new(&bytes);
    let header: Vec<usize> = (0..16).map(|at| tables.word(at)).collect();
    let starts = [16, 16 + 6 * 10, 16 + 6 * 10 + 5 * 10];
    assert_eq!(header[..7], [5, 4, 6 * 5 - 2, 2 + 4 + 8, 5, 3, 3]);
    assert_eq!(header[7..], [starts[0], starts[1], starts[2], 45, 0, 0, 0, 0, 0]);
    assert_eq!(bytes.len(), 4 * (starts[2] + 5 * 10));
    // The first sample along v is the first control point.
    let sample: Vec<f32> = (starts[1] + 4..starts[1] + 7).map(|at| tables.number(at)).collect();
    assert_eq!(sample, [1.0, 0.0, 0.0]);
    assert_eq!((tables.number(starts[1]), tables.word(starts[1] + 1)), (0.0, 0));
}
