//! Basis functions, curves and surfaces against the Cox-de Boor recursion.

use lucerna_nurbs::{Curve, KnotVector, Surface};

/// The recursion as it is defined, one function at a time.
fn cox_de_boor(knots: &[f64], i: usize, p: usize, t: f64, last: bool) -> f64 {
    if p == 0 {
        // The upper end of the domain belongs to the span below it.
        let inside = if last { knots[i] < t && t <= knots[i + 1] } else { knots[i] <= t && t < knots[i + 1] };
        return f64::from(u8::from(inside));
    }
    let part = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a / b };
    part(t - knots[i], knots[i + p] - knots[i]) * cox_de_boor(knots, i, p - 1, t, last)
        + part(knots[i + p + 1] - t, knots[i + p + 1] - knots[i + 1]) * cox_de_boor(knots, i + 1, p - 1, t, last)
}

/// The derivative by the formula for B-splines of one degree less.
fn derivative(knots: &[f64], i: usize, p: usize, t: f64, last: bool, order: usize) -> f64 {
    if order == 0 {
        return cox_de_boor(knots, i, p, t, last);
    }
    if p == 0 {
        return 0.0;
    }
    let part = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a / b };
    let p64 = p as f64;
    part(p64, knots[i + p] - knots[i]) * derivative(knots, i, p - 1, t, last, order - 1)
        - part(p64, knots[i + p + 1] - knots[i + 1]) * derivative(knots, i + 1, p - 1, t, last, order - 1)
}

fn vectors(p: usize) -> Vec<KnotVector<f64>> {
    let mut all = vec![
        KnotVector::clamped_uniform(p, p + 1).unwrap(),
        KnotVector::clamped_uniform(p, p + 6).unwrap(),
        KnotVector::uniform(p, p + 5).unwrap(),
        KnotVector::periodic(p, p + 3).unwrap(),
    ];
    let mut inner = vec![0.125];
    inner.extend(vec![0.5; p]);
    inner.extend([0.625, 0.8125]);
    all.push(KnotVector::clamped(p, &inner).unwrap());
    all
}

#[test]
fn basis_functions_and_derivatives_follow_the_recursion() {
    for p in 1..=7 {
        for knots in vectors(p) {
            let (lo, hi) = knots.domain();
            for k in 0..=48 {
                let t = if k == 48 { hi } else { lo + (hi - lo) * f64::from(k) / 48.0 };
                let basis = knots.basis_derivatives(t, p + 1).unwrap();
                let sum: f64 = basis.derivative(0).unwrap().iter().sum();
                assert!((sum - 1.0).abs() < 1e-14, "partition of unity: {sum}");
                for order in 0..=p + 1 {
                    let row = basis.derivative(order).unwrap();
                    let scale = row.iter().fold(1.0, |a: f64, b| a.max(b.abs()));
                    for i in 0..knots.count() {
                        let inside = (basis.first()..=basis.span()).contains(&i);
                        let found = if inside { row[i - basis.first()] } else { 0.0 };
                        let wanted = derivative(knots.as_slice(), i, p, t, t == hi, order);
                        let error = (found - wanted).abs();
                        assert!(error <= 1e-12 * scale, "{p} {t} {order} {i}: {found} {wanted}");
                    }
                }
                assert_eq!(basis.derivative(p + 2), None);
            }
        }
    }
}

#[test]
fn spans_hold_their_parameters() {
    for p in 1..=5 {
        for knots in vectors(p) {
            let all = knots.as_slice();
            let (lo, hi) = knots.domain();
            for &t in all.iter().filter(|&&t| t >= lo && t <= hi) {
                for t in [t, t + 1e-9] {
                    let Ok(span) = knots.find_span(t) else { continue };
                    assert!(all[span] < all[span + 1]);
                    assert!(all[span] <= t && (t < all[span + 1] || t == hi));
                }
            }
        }
    }
}

#[test]
fn curves_and_surfaces_of_degree_one_to_seven_are_sums_of_basis_functions() {
    for p in 1..=7 {
        let q = 8 - p;
        for (ku, kv) in vectors(p).into_iter().zip(vectors(q)) {
            let (n, m) = (ku.count(), kv.count());
            let net: Vec<[f64; 3]> =
                (0..n * m).map(|k| [k as f64, (k as f64 * 1.7).sin(), (k as f64 * 0.3).cos()]).collect();
            let weights: Vec<f64> = (0..n * m).map(|k| 1.0 + (k % 5) as f64 * 0.3).collect();
            let surface = Surface::new(ku.clone(), kv.clone(), net.clone(), Some(weights.clone())).unwrap();
            let curve = Curve::new(ku.clone(), net[..n].to_vec(), Some(weights[..n].to_vec())).unwrap();
            for k in 0..=12 {
                let at = |(lo, hi): (f64, f64), f: f64| lo + (hi - lo) * f;
                let u = at(ku.domain(), f64::from(k) / 12.0);
                let v = at(kv.domain(), f64::from((5 * k) % 13) / 12.0);
                let bu = |i| cox_de_boor(ku.as_slice(), i, p, u, u == ku.domain().1);
                let bv = |j| cox_de_boor(kv.as_slice(), j, q, v, v == kv.domain().1);
                let mean = |factors: &mut dyn Iterator<Item = (usize, f64)>| {
                    let (mut sum, mut w) = ([0.0; 3], 0.0);
                    for (k, factor) in factors {
                        w += factor * weights[k];
                        for axis in 0..3 {
                            sum[axis] += factor * weights[k] * net[k][axis];
                        }
                    }
                    sum.map(|x| x / w)
                };
                let wanted = mean(&mut (0..n * m).map(|k| (k, bu(k / m) * bv(k % m))));
                let found = surface.point(u, v).unwrap();
                let on_curve = mean(&mut (0..n).map(|i| (i, bu(i))));
                let curve = curve.point(u).unwrap();
                for axis in 0..3 {
                    assert!((found[axis] - wanted[axis]).abs() < 1e-12 * (n * m) as f64);
                    assert!((curve[axis] - on_curve[axis]).abs() < 1e-12 * n as f64);
                }
            }
        }
    }
}

#[test]
fn a_closed_curve_is_smooth_across_its_seam() {
    let points: Vec<[f64; 2]> = (0..7).map(|k| [(f64::from(k)).cos() * 2.0, (f64::from(k) * 0.9).sin()]).collect();
    let curve = Curve::closed(3, points, None).unwrap();
    let (lo, hi) = curve.domain();
    let (a, b) = (curve.derivatives(lo, 2).unwrap(), curve.derivatives(hi, 2).unwrap());
    for k in 0..3 {
        for axis in 0..2 {
            assert!((a[k][axis] - b[k][axis]).abs() < 1e-12);
        }
    }
}
