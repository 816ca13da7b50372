//! What is written is read again; what is wrong is refused.

use crate::nets;
use lucerna_nurbs::{Closure, Curve, GridOptions, KnotVector, Spacing, Surface};

#[test]
fn curves_and_surfaces_are_read_as_they_were_written() {
    for (name, curve) in nets::curves() {
        let bytes = postcard::to_allocvec(&curve).unwrap();
        assert_eq!(postcard::from_bytes::<Curve<f64, 3>>(&bytes).unwrap(), curve, "{name}");
    }
    for (name, surface) in nets::surfaces() {
        let bytes = postcard::to_allocvec(&surface).unwrap();
        assert_eq!(postcard::from_bytes::<Surface<f64>>(&bytes).unwrap(), surface, "{name}");
    }
    let options = GridOptions { closure_u: Closure::Periodic { start_row: 2 }, ..GridOptions::default() };
    let text = serde_json::to_string(&options).unwrap();
    assert_eq!(serde_json::from_str::<GridOptions>(&text).unwrap(), options);
    assert_eq!(serde_json::from_str::<GridOptions>("{}").unwrap(), GridOptions::default());
    assert_eq!(serde_json::from_str::<Spacing>("\"Centripetal\"").unwrap(), Spacing::Centripetal);
}

#[test]
fn what_is_read_is_validated() {
    let refused = |text: &str, why: &str| {
        let error = serde_json::from_str::<Curve<f64, 2>>(text).unwrap_err().to_string();
        assert!(error.contains(why), "{text}: {error}");
    };
    let knots = r#""knots": {"degree": 1, "knots": [0, 0, 1, 1]}"#;
    let points = r#""points": [[0, 0], [1, 1]]"#;
    let good = format!("{{{knots}, {points}, \"weights\": null}}");
    assert_eq!(serde_json::from_str::<Curve<f64, 2>>(&good).unwrap(), Curve::line([0.0; 2], [1.0; 2]).unwrap());
    refused(&format!("{{{knots}, \"points\": [[0, 0]], \"weights\": null}}"), "1 control points: the knots need 2");
    refused(&format!("{{{knots}, {points}, \"weights\": [1, 0]}}"), "weight 1 is 0");
    refused(&format!("{{{knots}, {points}, \"weights\": null, \"colour\": 1}}"), "unknown field `colour`");
    refused(r#"{"knots": {"degree": 1, "knots": [0, 1, 0, 1]}, "points": [], "weights": null}"#, "knot 2 is 0");
    let error = serde_json::from_str::<KnotVector<f32>>(r#"{"degree": 1, "knots": [0, 0, 1, 1e300]}"#).unwrap_err();
    assert!(error.to_string().contains("knot 3"), "{error}");
}
