//! What is read before it is validated.

use alloc::vec::Vec;
use serde::Deserialize;

use crate::{Curve, KnotVector, NurbsError, Real, Surface};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "KnotVector")]
pub(crate) struct RawKnots<T> {
    degree: usize,
    knots: Vec<T>,
}

impl<T: Real> TryFrom<RawKnots<T>> for KnotVector<T> {
    type Error = NurbsError;

    fn try_from(raw: RawKnots<T>) -> Result<Self, NurbsError> {
        Self::new(raw.degree, raw.knots)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "Curve")]
#[serde(bound = "T: Real + Deserialize<'de>, [T; D]: Deserialize<'de>")]
pub(crate) struct RawCurve<T, const D: usize> {
    knots: KnotVector<T>,
    points: Vec<[T; D]>,
    weights: Option<Vec<T>>,
}

impl<T: Real, const D: usize> TryFrom<RawCurve<T, D>> for Curve<T, D> {
    type Error = NurbsError;

    fn try_from(raw: RawCurve<T, D>) -> Result<Self, NurbsError> {
        Self::new(raw.knots, raw.points, raw.weights)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "Surface")]
#[serde(bound = "T: Real + Deserialize<'de>")]
pub(crate) struct RawSurface<T> {
    knots_u: KnotVector<T>,
    knots_v: KnotVector<T>,
    points: Vec<[T; 3]>,
    weights: Option<Vec<T>>,
}

impl<T: Real> TryFrom<RawSurface<T>> for Surface<T> {
    type Error = NurbsError;

    fn try_from(raw: RawSurface<T>) -> Result<Self, NurbsError> {
        Self::new(raw.knots_u, raw.knots_v, raw.points, raw.weights)
    }
}
