//! Points and derivatives against the recursion in double-double arithmetic.

use crate::{nets, oracle};

fn largest_difference<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

#[test]
fn surfaces_of_every_kind_have_the_points_and_derivatives_of_their_definition() {
    let mut worst = [0.0f64; 3];
    for (name, surface) in nets::surfaces() {
        let size = nets::size(surface.points());
        let (us, vs) = (nets::parameters(surface.knots_u(), 13), nets::parameters(surface.knots_v(), 11));
        for (&u, &v) in us.iter().flat_map(|u| vs.iter().map(move |v| (u, v))) {
            let found = surface.derivatives(u, v, 2).unwrap();
            let wanted = oracle::surface(&surface, u, v);
            for ((k, l), wanted) in oracle::ORDERS.into_iter().zip(wanted) {
                let error = largest_difference(found.get(k, l).unwrap(), wanted) / size;
                let allowed = [1e-12, 1e-12, 1e-10][k + l];
                assert!(error <= allowed, "{name} at {u}, {v}, order {k}, {l}: {error:e}");
                worst[k + l] = worst[k + l].max(error);
            }
            assert_eq!(surface.point(u, v).unwrap(), found.get(0, 0).unwrap(), "{name} at {u}, {v}");
        }
    }
    println!("errors of points, first and second derivatives, by the shapes' size: {worst:?}");
}

#[test]
fn curves_of_every_kind_have_the_points_and_derivatives_of_their_definition() {
    let mut worst = [0.0f64; 3];
    for (name, curve) in nets::curves() {
        let size = nets::size(curve.points());
        for t in nets::parameters(curve.knots(), 97) {
            let found = curve.derivatives(t, 2).unwrap();
            let wanted = oracle::curve(&curve, t);
            for k in 0..3 {
                let error = largest_difference(found[k], wanted[k]) / size;
                assert!(error <= [1e-12, 1e-12, 1e-10][k], "{name} at {t}, order {k}: {error:e}");
                worst[k] = worst[k].max(error);
            }
        }
    }
    println!("errors of points, first and second derivatives, by the shapes' size: {worst:?}");
}
