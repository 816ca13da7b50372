//! Rational B-spline surfaces.

use alloc::{vec, vec::Vec};

use crate::vector::{add_scaled, largest, unit_cross};
use crate::{KnotVector, NurbsError, Real, basis, check};

/// A tensor product surface in space: two knot vectors, a net of control points and, when it is
/// rational, weights.
///
/// The net is stored row by row: the point of row `i` (along u) and column `j` (along v) is at
/// `i * n_v + j`.
///
/// ```
/// use lucerna_nurbs::{KnotVector, Surface};
///
/// let line = KnotVector::<f64>::clamped_uniform(1, 2)?;
/// let net = vec![[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 1.]];
/// let surface = Surface::new(line.clone(), line, net, None)?;
/// assert_eq!(surface.point(0.5, 0.5)?, [0.5, 0.5, 0.25]);
/// # Ok::<(), lucerna_nurbs::NurbsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "crate::serial::RawSurface<T>", bound(deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct Surface<T> {
    knots_u: KnotVector<T>,
    knots_v: KnotVector<T>,
    points: Vec<[T; 3]>,
    weights: Option<Vec<T>>,
    /// The largest coordinate of a control point, by magnitude.
    #[cfg_attr(feature = "serde", serde(skip))]
    extent: T,
}

/// The derivatives of a surface at one parameter pair, from [`Surface::derivatives`].
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceDerivatives<T> {
    order: usize,
    values: Vec<[T; 3]>,
}

impl<T: Real> SurfaceDerivatives<T> {
    /// The derivative `k` times along u and `l` times along v; `None` where `k + l` is above the
    /// order that was asked for.
    pub fn get(&self, k: usize, l: usize) -> Option<[T; 3]> {
        (k <= self.order && l <= self.order - k).then(|| self.at(k, l))
    }

    fn at(&self, k: usize, l: usize) -> [T; 3] {
        self.values[k * (self.order + 1) + l]
    }
}

impl<T: Real> Surface<T> {
    /// Puts a surface together; without weights all of them are 1.
    ///
    /// # Errors
    /// When the counts do not match, a coordinate is not finite or a weight is not positive.
    pub fn new(
        knots_u: KnotVector<T>,
        knots_v: KnotVector<T>,
        points: Vec<[T; 3]>,
        weights: Option<Vec<T>>,
    ) -> Result<Self, NurbsError> {
        check::points(&points, knots_u.count().saturating_mul(knots_v.count()))?;
        if let Some(weights) = &weights {
            check::weights(weights, points.len())?;
        }
        Ok(Self::from_valid(knots_u, knots_v, points, weights))
    }

    /// A surface of parts known to fit.
    pub(crate) fn from_valid(
        knots_u: KnotVector<T>,
        knots_v: KnotVector<T>,
        points: Vec<[T; 3]>,
        weights: Option<Vec<T>>,
    ) -> Self {
        let extent = points.iter().fold(T::ZERO, |extent, &point| extent.max(largest(point)));
        Self { knots_u, knots_v, points, weights, extent }
    }

    /// A surface closed smoothly in u: periodic uniform knots of degree `degree_u`, the first
    /// `degree_u` of the given rows repeated behind the last. The domain in u is 0 to the number
    /// of rows.
    ///
    /// ```
    /// use lucerna_nurbs::{KnotVector, Surface};
    ///
    /// let along = KnotVector::<f64>::clamped_uniform(1, 2)?;
    /// let corners = [[0., 0.], [2., 0.], [2., 2.], [0., 2.]];
    /// let net = corners.iter().flat_map(|&[x, z]| [[x, 0., z], [x, 1., z]]).collect();
    /// let tube = Surface::closed_u(3, along, net, None)?;
    /// assert_eq!(tube.point(0.0, 0.5)?, tube.point(4.0, 0.5)?);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`new`](Self::new); also when there are fewer rows than `degree_u`, or the points do
    /// not fill whole rows.
    pub fn closed_u(
        degree_u: usize,
        knots_v: KnotVector<T>,
        mut points: Vec<[T; 3]>,
        mut weights: Option<Vec<T>>,
    ) -> Result<Self, NurbsError> {
        let rows = points.len() / knots_v.count();
        check::points(&points, rows * knots_v.count())?;
        let knots_u = KnotVector::periodic(degree_u, rows)?;
        let repeated = degree_u * knots_v.count();
        if let Some(weights) = &mut weights {
            check::weights(weights, points.len())?;
            weights.extend_from_within(..repeated);
        }
        points.extend_from_within(..repeated);
        Self::new(knots_u, knots_v, points, weights)
    }

    /// The knots along u.
    pub fn knots_u(&self) -> &KnotVector<T> {
        &self.knots_u
    }

    /// The knots along v.
    pub fn knots_v(&self) -> &KnotVector<T> {
        &self.knots_v
    }

    /// The net, row by row.
    pub fn points(&self) -> &[[T; 3]] {
        &self.points
    }

    /// The weights in the order of the points, `None` when the surface is not rational.
    pub fn weights(&self) -> Option<&[T]> {
        self.weights.as_deref()
    }

    /// The surface with every control point mapped. An affine map (moving, turning, scaling,
    /// shearing) takes the surface along; other maps bend it in ways of their own.
    ///
    /// ```
    /// use lucerna_nurbs::Surface;
    ///
    /// let sphere = Surface::sphere([0.0; 3], 1.0_f64)?;
    /// let ellipsoid = sphere.map_points(|[x, y, z]| [3.0 * x, y, z])?;
    /// assert_eq!(ellipsoid.point(0.0, 0.5)?, [3.0, 0.0, 0.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a mapped coordinate is not finite.
    pub fn map_points(&self, map: impl FnMut([T; 3]) -> [T; 3]) -> Result<Self, NurbsError> {
        let points = self.points.iter().copied().map(map).collect();
        Self::new(self.knots_u.clone(), self.knots_v.clone(), points, self.weights.clone())
    }

    /// The point at `(u, v)` (The NURBS Book, A3.5 and A4.3).
    ///
    /// ```
    /// use lucerna_nurbs::Surface;
    ///
    /// let torus = Surface::torus([0.0; 3], 3.0, 1.0_f64)?;
    /// assert_eq!(torus.point(0.25, 0.0)?, [0.0, 0.0, -4.0]);
    /// assert!(torus.point(0.25, 1.5).is_err());
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a parameter is NaN or outside the domain.
    pub fn point(&self, u: T, v: T) -> Result<[T; 3], NurbsError> {
        Ok(self.derivatives(u, v, 0)?.at(0, 0))
    }

    /// The point and all partial derivatives up to the total order `order` (A3.6 and A4.4).
    ///
    /// ```
    /// use lucerna_nurbs::{KnotVector, Surface};
    ///
    /// let line = KnotVector::<f64>::clamped_uniform(1, 2)?;
    /// let net = vec![[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 1.]];
    /// let saddle = Surface::new(line.clone(), line, net, None)?;
    /// let d = saddle.derivatives(0.5, 0.5, 2)?;
    /// assert_eq!(d.get(1, 0), Some([1.0, 0.0, 0.5]));
    /// assert_eq!(d.get(1, 1), Some([0.0, 0.0, 1.0]));
    /// assert_eq!(d.get(2, 1), None);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a parameter is NaN or outside the domain, or `order` is above
    /// [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn derivatives(&self, u: T, v: T, order: usize) -> Result<SurfaceDerivatives<T>, NurbsError> {
        self.knots_u.check("u", u)?;
        self.knots_v.check("v", v)?;
        basis::check_order(order)?;
        let (bu, bv) = (self.knots_u.basis(u, order), self.knots_v.basis(v, order));
        let n_v = self.knots_v.count();
        let side = order + 1;
        let mut a = vec![[T::ZERO; 3]; side * side];
        let mut w = vec![T::ZERO; side * side];
        for k in 0..=order {
            for (&nu, i) in bu.row(k).iter().zip(bu.first()..) {
                for l in 0..=order - k {
                    for (&nv, j) in bv.row(l).iter().zip(bv.first()..) {
                        let index = i * n_v + j;
                        let weight = self.weights.as_ref().map_or(T::ONE, |w| w[index]);
                        add_scaled(&mut a[k * side + l], &self.points[index], nu * nv * weight);
                        w[k * side + l] += nu * nv * weight;
                    }
                }
            }
        }
        if self.weights.is_some() {
            divide(&mut a, &w, order);
        }
        Ok(SurfaceDerivatives { order, values: a })
    }

    /// The unit normal, in the direction of dS/du x dS/dv.
    ///
    /// Where an edge of the surface collapses to a point, or turns round in one, the product
    /// vanishes; there the normal is the exact limit from inside: with dS/du = 0 it is
    /// d2S/du dv x dS/dv at the lower end of v and its opposite at the upper end, likewise
    /// dS/du x d2S/du dv for dS/dv = 0 at the ends of u.
    ///
    /// ```
    /// use lucerna_nurbs::Curve;
    /// use std::f64::consts::TAU;
    ///
    /// // A cone: its tip is a single point, yet it has a normal on every side.
    /// let cone = Curve::line([1.0, 0.0, 0.0], [0.0, 1.0, 0.0])?.revolve([0.0; 3], [0.0, 1.0, 0.0], TAU)?;
    /// let [x, y, z] = cone.normal(0.0, 1.0)?;
    /// assert!((x - 0.5_f64.sqrt()).abs() < 1e-12 && (y - x).abs() < 1e-12 && z.abs() < 1e-12);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a parameter is NaN or outside the domain, or the surface has no tangent plane there.
    pub fn normal(&self, u: T, v: T) -> Result<[T; 3], NurbsError> {
        let d = self.derivatives(u, v, 2)?;
        let (su, sv, suv) = (d.at(1, 0), d.at(0, 1), d.at(1, 1));
        let (rate_u, rate_v) = (rate(&self.knots_u), rate(&self.knots_v));
        let flat_u = self.is_rounding(su, rate_u);
        let flat_v = self.is_rounding(sv, rate_v);
        let twisted = !self.is_rounding(suv, rate_u * rate_v);
        let (u_lo, u_hi) = self.knots_u.domain();
        let (v_lo, v_hi) = self.knots_v.domain();
        let normal = match (flat_u, flat_v) {
            (false, false) => unit_cross(su, sv),
            (true, false) if v == v_lo && twisted => unit_cross(suv, sv),
            (true, false) if v == v_hi && twisted => unit_cross(sv, suv),
            (false, true) if u == u_lo && twisted => unit_cross(su, suv),
            (false, true) if u == u_hi && twisted => unit_cross(suv, su),
            _ => None,
        };
        normal.ok_or(NurbsError::NoNormal { u: u.to_f64(), v: v.to_f64() })
    }

    /// Whether a derivative is nothing but rounding, measured by the extent of the net and the rate
    /// at which basis functions change.
    fn is_rounding(&self, derivative: [T; 3], rate: T) -> bool {
        largest(derivative) <= T::from_f64(16.0) * T::EPSILON * self.extent * rate
    }
}

/// A bound, generous on even knots, of the slopes of basis functions.
fn rate<T: Real>(knots: &KnotVector<T>) -> T {
    let (lo, hi) = knots.domain();
    T::from_usize(knots.degree() * knots.count()) / (hi - lo)
}

/// A4.4: derivatives of the quotient `a / w`, in place.
fn divide<T: Real>(a: &mut [[T; 3]], w: &[T], order: usize) {
    let side = order + 1;
    let mut choose = vec![T::ZERO; side * side];
    for n in 0..side {
        choose[n * side] = T::ONE;
        for k in 1..=n {
            choose[n * side + k] =
                choose[(n - 1) * side + k - 1] + if k < n { choose[(n - 1) * side + k] } else { T::ZERO };
        }
    }
    for k in 0..=order {
        for l in 0..=order - k {
            let mut sum = a[k * side + l];
            for i in 0..=k {
                for j in 0..=l {
                    if i + j > 0 {
                        let factor = choose[k * side + i] * choose[l * side + j] * w[i * side + j];
                        let lower = a[(k - i) * side + l - j];
                        add_scaled(&mut sum, &lower, -factor);
                    }
                }
            }
            a[k * side + l] = sum.map(|x| x / w[0]);
        }
    }
}
