//! Published values: examples of The NURBS Book, and values of geomdl 5.4.0 (a Python package).

use lucerna_nurbs::{Curve, KnotVector, Spacing, Surface};

fn close<const D: usize>(found: [f64; D], wanted: [f64; D]) {
    let size = wanted.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    let near = found.iter().zip(wanted).all(|(a, b)| (a - b).abs() <= 1e-12 * size);
    assert!(near, "{found:?} against {wanted:?}");
}

/// U = {0, 0, 0, 1, 2, 3, 4, 4, 5, 5, 5}, degree 2: section 2.2 onwards.
fn knots_of_chapter_2() -> KnotVector<f64> {
    KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 5.0, 5.0]).unwrap()
}

#[test]
fn examples_2_3_and_2_4_basis_functions_and_derivatives() {
    let knots = knots_of_chapter_2();
    assert_eq!(knots.find_span(2.5), Ok(4));
    let basis = knots.basis_derivatives(2.5, 2).unwrap();
    assert_eq!(basis.derivative(0), Some(&[0.125, 0.75, 0.125][..]));
    assert_eq!(basis.derivative(1), Some(&[-0.5, 0.0, 0.5][..]));
    assert_eq!(basis.derivative(2), Some(&[1.0, -2.0, 1.0][..]));
}

#[test]
fn a_point_and_a_derivative_of_a_curve_on_the_knots_of_chapter_2() {
    let points = vec![[0.0, 0.0], [1.0, 1.0], [2.0, -1.0], [3.0, 2.0], [5.0, 2.0], [6.0, 0.0], [7.0, 1.0], [8.0, 1.0]];
    let curve = Curve::new(knots_of_chapter_2(), points.clone(), None).unwrap();
    let d = curve.derivatives(2.5, 1).unwrap();
    // C(5/2) = P2/8 + 6 P3/8 + P4/8, C'(5/2) = (P4 - P2)/2.
    let [a, b, c] = [points[2], points[3], points[4]];
    close(d[0], [0, 1].map(|k| a[k] / 8.0 + 6.0 * b[k] / 8.0 + c[k] / 8.0));
    close(d[1], [0, 1].map(|k| (c[k] - a[k]) / 2.0));
}

#[test]
fn example_4_1_a_point_of_a_rational_curve() {
    let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0]).unwrap();
    let points = vec![[0.0, 0.0], [1.0, 1.0], [3.0, 2.0], [4.0, 1.0], [5.0, -1.0]];
    let curve = Curve::new(knots, points, Some(vec![1.0, 4.0, 1.0, 1.0, 1.0])).unwrap();
    close(curve.point(1.0).unwrap(), [7.0 / 5.0, 6.0 / 5.0]);
}

#[test]
fn examples_5_1_and_5_2_a_knot_inserted() {
    let knots = KnotVector::new(3, vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.0, 5.0, 5.0]).unwrap();
    let p: Vec<[f64; 2]> = (0..8).map(|k| [f64::from(k), f64::from(k * k % 5)]).collect();
    let curve = Curve::new(knots, p.clone(), None).unwrap();
    let mix = |a: usize, b: usize, part: f64| [0, 1].map(|k| part * p[a][k] + (1.0 - part) * p[b][k]);
    let found = curve.insert_knot(2.5, 1).unwrap();
    let wanted = [p[0], p[1], p[2], mix(3, 2, 5.0 / 6.0), mix(4, 3, 0.5), mix(5, 4, 1.0 / 6.0), p[5], p[6], p[7]];
    found.points().iter().zip(wanted).for_each(|(&a, b)| close(a, b));
    let found = curve.insert_knot(2.0, 1).unwrap();
    let wanted = [p[0], p[1], p[2], mix(3, 2, 2.0 / 3.0), mix(4, 3, 1.0 / 3.0), p[4], p[5], p[6], p[7]];
    found.points().iter().zip(wanted).for_each(|(&a, b)| close(a, b));
}

#[test]
fn a_rational_curve_has_the_derivatives_that_geomdl_computes() {
    let knots = KnotVector::clamped(3, &[0.25, 0.5, 0.5]).unwrap();
    let points = vec![
        [0.0, 0.0, 0.0],
        [1.0, 2.0, -1.0],
        [3.0, 3.0, 1.0],
        [4.0, 0.0, 2.0],
        [5.0, -2.0, 0.0],
        [7.0, 1.0, 1.0],
        [8.0, 0.0, 3.0],
    ];
    let weights = vec![1.0, 2.0, 0.5, 1.0, 3.0, 1.0, 0.75];
    let curve = Curve::new(knots, points, Some(weights)).unwrap();
    // NURBS.Curve.derivatives(t, 2)
    let wanted = [
        (0.1, [1.0053191489361701, 1.75, -0.7074468085106382]),
        (0.1, [5.746378451788139, 5.984042553191489, 0.09336803983703075]),
        (0.1, [-8.809464184236623, -95.9144409234948, 79.7619506275103]),
        (0.25, [2.25, 1.75, 0.25]),
        (0.25, [12.75, -6.75, 12.75]),
        (0.25, [40.5, -100.5, 40.5]),
        (0.5, [4.6, -1.2000000000000002, 0.8]),
        (0.5, [4.320000000000002, -8.64, -8.64]),
        (0.5, [-41.47200000000001, 183.74400000000003, 154.94400000000002]),
        (0.8, [5.835534725181083, -0.9100979974435448, 0.6412441414571796]),
        (0.8, [7.1161382533504725, 6.129936974542015, 4.805525515625294]),
        (0.8, [41.36834098521735, 29.243225932116967, 50.23941393616538]),
    ];
    for (k, (t, wanted)) in wanted.into_iter().enumerate() {
        close(curve.derivatives(t, 2).unwrap()[k % 3], wanted);
    }
}

#[test]
fn a_rational_surface_has_the_points_and_tangents_that_geomdl_computes() {
    let (u, v) = (KnotVector::clamped(2, &[0.4]).unwrap(), KnotVector::clamped(3, &[0.3]).unwrap());
    let at = |k: usize| (k / 5, k % 5);
    let height = |(i, j): (usize, usize)| ((i * 7 + j * 3) % 5) as f64 * 0.5;
    let points = (0..20).map(at).map(|(i, j)| [i as f64, j as f64, height((i, j))]).collect();
    let weights = (0..20).map(at).map(|(i, j)| 1.0 + ((i * 3 + j * 5) % 4) as f64 * 0.25).collect();
    let surface = Surface::new(u, v, points, Some(weights)).unwrap();
    // NURBS.Surface.derivatives(u, v, 2), orders (0, 0), (0, 1), (1, 0)
    let wanted = [
        (0.2, 0.6, [0.8111942778865537, 2.5978047146553576, 1.0628030528154466]),
        (0.2, 0.6, [0.07778754968117617, 3.108451106829011, 0.7280794757303564]),
        (0.2, 0.6, [3.5457969249000305, 0.13834618640379007, -1.1731967350801442]),
        (0.7, 0.1, [2.115173585228453, 0.7834614397614654, 1.2097564552197766]),
        (0.7, 0.1, [0.5321340267756489, 5.65829455937167, -2.2287557132967994]),
        (0.7, 0.1, [2.403465638506975, 0.19431917422808473, 1.0155523746823754]),
        (0.4, 0.3, [1.4462279293739966, 1.589887640449438, 0.7411717495987158]),
        (0.4, 0.3, [-0.401155286000273, 3.1726243078976313, 0.8240011697141927]),
        (0.4, 0.3, [2.0592380368382677, -0.4680145003336519, -0.010644012686503708]),
    ];
    for (k, (u, v, wanted)) in wanted.into_iter().enumerate() {
        let order = [(0, 0), (0, 1), (1, 0)][k % 3];
        close(surface.derivatives(u, v, 2).unwrap().get(order.0, order.1).unwrap(), wanted);
    }
}

#[test]
fn centripetal_interpolation_finds_the_control_points_that_geomdl_does() {
    let points = [[0.0, 0.0], [1.0, 3.0], [2.0, 2.0], [4.0, 5.0], [6.0, 4.0], [7.0, 7.0], [9.0, 6.0], [10.0, 9.0]];
    let parameters = Spacing::Centripetal.parameters(&points).unwrap();
    let curve = Curve::interpolate(3, &points, &parameters).unwrap();
    // fitting.interpolate_curve(points, 3, centripetal=True)
    let knots = [0.2807208098591468, 0.41457855064753135, 0.5656401461633342, 0.7049181052938536];
    curve.knots().as_slice()[4..8].iter().zip(knots).for_each(|(&a, b)| close([a], [b]));
    let wanted = [
        [0.0, 0.0],
        [0.32753343879386926, 6.616604178937499],
        [1.6889338690313518, -1.5213031077630723],
        [3.6689558950654213, 6.809850797086616],
        [6.557632980825292, 2.16400701083238],
        [6.407689494671041, 10.68873116125749],
        [10.869881534960145, 2.4367192622290075],
        [10.0, 9.0],
    ];
    curve.points().iter().zip(wanted).for_each(|(&a, b)| close(a, b));
}
