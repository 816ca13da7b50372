//! Editing surfaces.

use alloc::{vec, vec::Vec};

use super::{Direction, check_interval, elevate, insertable, remove};
use crate::strip::{Strip, lift, project, transpose};
use crate::{Curve, KnotVector, NurbsError, Real, Surface, check};

impl<T: Real> Surface<T> {
    /// Inserts the knot `t` `times` times in one direction (The NURBS Book, A5.3). The surface
    /// stays where it is.
    ///
    /// ```
    /// use lucerna_nurbs::{Direction, KnotVector, Surface};
    ///
    /// let line = KnotVector::<f64>::clamped_uniform(1, 2)?;
    /// let net = vec![[0., 0., 0.], [0., 4., 0.], [1., 0., 0.], [1., 4., 8.]];
    /// let surface = Surface::new(line.clone(), line, net, None)?;
    /// let refined = surface.insert_knot(Direction::V, 0.25, 1)?;
    /// assert_eq!(refined.points()[3..], [[1., 0., 0.], [1., 1., 2.], [1., 4., 8.]]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain, or would occur more often than the degree.
    pub fn insert_knot(&self, direction: Direction, t: T, times: usize) -> Result<Self, NurbsError> {
        self.knots(direction).check(direction.name(), t)?;
        // One more than may be is enough to be refused.
        self.refine(direction, &vec![t; times.min(self.knots(direction).degree() + 1)])
    }

    /// Inserts many knots at once in one direction, in any order, repeated or not (A5.5).
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, Direction};
    ///
    /// let wall = Curve::line([0.0; 3], [4.0, 0.0, 0.0])?.extrude([0.0, 2.0, 0.0])?;
    /// let refined = wall.refine(Direction::U, &[0.5, 0.25])?;
    /// assert_eq!(refined.points()[2], [1.0, 0.0, 0.0]);
    /// assert_eq!(refined.points().len(), 8);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`insert_knot`](Self::insert_knot).
    pub fn refine(&self, direction: Direction, knots: &[T]) -> Result<Self, NurbsError> {
        let new = insertable(self.knots(direction), direction.name(), knots)?;
        let mut strip = self.strip(direction);
        strip.refine(&new);
        self.rebuild(direction, strip)
    }

    /// Removes the inner knot `t` of one direction up to `times` times, as long as the surface moves
    /// by no more than `tolerance` in all; returns the result and how often the knot was removed
    /// (A5.8 for all rows or columns at once). A knot that does not occur, and one at an end, is not
    /// removed.
    ///
    /// ```
    /// use lucerna_nurbs::{Direction, KnotVector, Surface};
    ///
    /// let line = KnotVector::<f64>::clamped_uniform(1, 2)?;
    /// let net = vec![[0., 0., 0.], [0., 4., 0.], [1., 0., 0.], [1., 4., 8.]];
    /// let surface = Surface::new(line.clone(), line, net, None)?;
    /// let refined = surface.insert_knot(Direction::U, 0.5, 1)?;
    /// assert_eq!(refined.remove_knot(Direction::U, 0.5, 1, 1e-12)?, (surface, 1));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN or outside the domain, or the tolerance is not positive and finite.
    pub fn remove_knot(
        &self,
        direction: Direction,
        t: T,
        times: usize,
        tolerance: T,
    ) -> Result<(Self, usize), NurbsError> {
        self.knots(direction).check(direction.name(), t)?;
        check::positive("tolerance", tolerance)?;
        let (lo, hi) = self.knots(direction).domain();
        if t == lo || t == hi {
            return Ok((self.clone(), 0));
        }
        let mut strip = self.strip(direction);
        let removed = remove(&mut strip, t, times, tolerance, self.parts(), self.weights().is_some());
        Ok(if removed == 0 { (self.clone(), 0) } else { (self.rebuild(direction, strip)?, removed) })
    }

    /// The same surface on knots that are clamped in both directions. Knots before and behind the
    /// domain are dropped.
    ///
    /// ```
    /// use lucerna_nurbs::{KnotVector, Surface};
    ///
    /// let along = KnotVector::<f64>::clamped_uniform(1, 2)?;
    /// let corners = [[0., 0.], [2., 0.], [2., 2.], [0., 2.]];
    /// let net = corners.iter().flat_map(|&[x, z]| [[x, 0., z], [x, 1., z]]).collect();
    /// let tube = Surface::closed_u(2, along, net, None)?.clamp()?;
    /// assert!(tube.knots_u().is_clamped());
    /// assert_eq!(tube.points()[0], [1., 0., 0.]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the coordinates are so large that sums overflow.
    pub fn clamp(&self) -> Result<Self, NurbsError> {
        let (u_lo, u_hi) = self.knots_u().domain();
        let (v_lo, v_hi) = self.knots_v().domain();
        self.trim(Direction::U, u_lo, u_hi)?.trim(Direction::V, v_lo, v_hi)
    }

    /// The part between two parameters of one direction, with the parameters it had, clamped in that
    /// direction.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, Direction};
    ///
    /// let wall = Curve::line([0.0; 3], [4.0, 0.0, 0.0])?.extrude([0.0, 2.0, 0.0])?;
    /// let part = wall.trim(Direction::U, 0.25, 0.5)?;
    /// assert_eq!(part.knots_u().domain(), (0.25, 0.5));
    /// assert_eq!(part.points()[2], [2.0, 0.0, 0.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When a parameter is NaN or outside the domain, or `a` is not below `b`.
    pub fn trim(&self, direction: Direction, a: T, b: T) -> Result<Self, NurbsError> {
        check_interval(self.knots(direction), direction.name(), a, b)?;
        let mut strip = self.strip(direction);
        strip.cut(a, b);
        self.rebuild(direction, strip)
    }

    /// The parts below and above the parameter `t` of one direction, clamped in that direction, with
    /// the parameters they had.
    ///
    /// ```
    /// use lucerna_nurbs::{Direction, KnotVector, Surface};
    ///
    /// let line = KnotVector::<f64>::clamped_uniform(1, 2)?;
    /// let net = vec![[0., 0., 0.], [0., 4., 0.], [1., 0., 0.], [1., 4., 8.]];
    /// let surface = Surface::new(line.clone(), line, net, None)?;
    /// let (low, high) = surface.split(Direction::U, 0.5)?;
    /// assert_eq!(low.point(0.5, 1.0)?, high.point(0.5, 1.0)?);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `t` is NaN, outside the domain or at one of its ends.
    pub fn split(&self, direction: Direction, t: T) -> Result<(Self, Self), NurbsError> {
        let (lo, hi) = self.knots(direction).domain();
        check_interval(self.knots(direction), direction.name(), lo, t)?;
        check_interval(self.knots(direction), direction.name(), t, hi)?;
        let (below, above) = self.strip(direction).split(t);
        Ok((self.rebuild(direction, below)?, self.rebuild(direction, above)?))
    }

    /// The surface as Bezier patches, one for each pair of spans, v faster than u, with the
    /// parameters they had (A5.7).
    ///
    /// ```
    /// use lucerna_nurbs::{KnotVector, Surface};
    ///
    /// let (u, v) = (KnotVector::<f64>::clamped_uniform(1, 2)?, KnotVector::clamped_uniform(2, 4)?);
    /// let net = (0..8).map(|k| [(k / 4) as f64, (k % 4) as f64, 0.0]).collect();
    /// let patches = Surface::new(u, v, net, None)?.bezier_patches()?;
    /// assert_eq!(patches.len(), 2);
    /// assert_eq!(patches[1].knots_v().domain(), (0.5, 1.0));
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the coordinates are so large that sums overflow.
    pub fn bezier_patches(&self) -> Result<Vec<Self>, NurbsError> {
        let mut patches = Vec::new();
        for row in self.strip(Direction::U).bezier_pieces() {
            let row = self.rebuild(Direction::U, row)?;
            for patch in row.strip(Direction::V).bezier_pieces() {
                patches.push(row.rebuild(Direction::V, patch)?);
            }
        }
        Ok(patches)
    }

    /// The same surface with a degree higher by `by` in one direction, clamped in that direction
    /// (as A5.10).
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, Direction};
    ///
    /// let wall = Curve::line([0.0; 3], [4.0, 0.0, 0.0])?.extrude([0.0, 2.0, 0.0])?;
    /// assert_eq!(wall.elevate(Direction::V, 1)?.points()[1], [0.0, 1.0, 0.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When the degree would exceed [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn elevate(&self, direction: Direction, by: usize) -> Result<Self, NurbsError> {
        let mut strip = self.strip(direction);
        elevate(&mut strip, by)?;
        self.rebuild(direction, strip)
    }

    /// The surface run through the other way in one direction, on the same domain. Its normals
    /// turn over.
    ///
    /// ```
    /// use lucerna_nurbs::{Curve, Direction};
    ///
    /// let wall = Curve::line([0.0; 3], [4.0, 0.0, 0.0])?.extrude([0.0, 2.0, 0.0])?;
    /// assert_eq!(wall.reverse(Direction::U)?.point(0.25, 0.0)?, [3.0, 0.0, 0.0]);
    /// assert_eq!(wall.reverse(Direction::U)?.normal(0.5, 0.5)?, [0.0, 0.0, -1.0]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When knots that differ by rounding alone fall together and are too many.
    pub fn reverse(&self, direction: Direction) -> Result<Self, NurbsError> {
        let turned = match direction {
            Direction::U => self.clone(),
            Direction::V => self.transpose(),
        };
        let columns = turned.knots_v().count();
        let knots = turned.knots_u().reverse()?;
        let points = turned.points().chunks(columns).rev().flatten().copied().collect();
        let weights = turned.weights().map(|weights| weights.chunks(columns).rev().flatten().copied().collect());
        let turned = Self::new(knots, turned.knots_v().clone(), points, weights)?;
        Ok(match direction {
            Direction::U => turned,
            Direction::V => turned.transpose(),
        })
    }

    /// The surface with u and v exchanged. Its normals turn over.
    ///
    /// ```
    /// use lucerna_nurbs::{KnotVector, Surface};
    ///
    /// let (u, v) = (KnotVector::<f64>::clamped_uniform(1, 2)?, KnotVector::clamped_uniform(2, 4)?);
    /// let net = (0..8).map(|k| [(k / 4) as f64, (k % 4) as f64, 0.0]).collect();
    /// let surface = Surface::new(u, v, net, None)?;
    /// assert_eq!(surface.transpose().point(0.3, 0.8)?, surface.point(0.8, 0.3)?);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    #[must_use]
    pub fn transpose(&self) -> Self {
        let columns = self.knots_v().count();
        let flat = transpose(self.points().as_flattened(), columns, 3);
        let (points, _) = project(&flat, false);
        let weights = self.weights().map(|weights| transpose(weights, columns, 1));
        Self::from_valid(self.knots_v().clone(), self.knots_u().clone(), points, weights)
    }

    /// The curve on which one parameter is fixed: along v where `fixed` is [`Direction::U`].
    ///
    /// ```
    /// use lucerna_nurbs::{Direction, KnotVector, Surface};
    ///
    /// let line = KnotVector::<f64>::clamped_uniform(1, 2)?;
    /// let net = vec![[0., 0., 0.], [0., 4., 0.], [1., 0., 0.], [1., 4., 8.]];
    /// let surface = Surface::new(line.clone(), line, net, None)?;
    /// let curve = surface.iso_curve(Direction::U, 0.5)?;
    /// assert_eq!(curve.points(), [[0.5, 0., 0.], [0.5, 4., 4.]]);
    /// # Ok::<(), lucerna_nurbs::NurbsError>(())
    /// ```
    ///
    /// # Errors
    /// When `at` is NaN or outside the domain.
    pub fn iso_curve(&self, fixed: Direction, at: T) -> Result<Curve<T, 3>, NurbsError> {
        let knots = self.knots(fixed);
        knots.check(fixed.name(), at)?;
        let strip = self.strip(fixed);
        let basis = knots.basis(at, 0);
        let mut data = vec![T::ZERO; strip.width];
        for (&n, point) in basis.row(0).iter().zip(strip.data.chunks(strip.width).skip(basis.first())) {
            for (sum, &x) in data.iter_mut().zip(point) {
                *sum += x * n;
            }
        }
        let along = match fixed {
            Direction::U => self.knots_v(),
            Direction::V => self.knots_u(),
        };
        Curve::from_strip(Strip::new(along, data), self.weights().is_some())
    }

    /// The knots of one direction.
    pub fn knots(&self, direction: Direction) -> &KnotVector<T> {
        match direction {
            Direction::U => self.knots_u(),
            Direction::V => self.knots_v(),
        }
    }

    /// Scalars of a homogeneous point.
    fn parts(&self) -> usize {
        3 + usize::from(self.weights().is_some())
    }

    pub(crate) fn strip(&self, direction: Direction) -> Strip<T> {
        let data = lift(self.points(), self.weights());
        match direction {
            Direction::U => Strip::new(self.knots_u(), data),
            Direction::V => Strip::new(self.knots_v(), transpose(&data, self.knots_v().count(), self.parts())),
        }
    }

    /// A surface whose homogeneous form along `direction` is given, the rest as here.
    fn rebuild(&self, direction: Direction, strip: Strip<T>) -> Result<Self, NurbsError> {
        let knots = KnotVector::new(strip.degree, strip.knots)?;
        let rational = self.weights().is_some();
        let (knots_u, knots_v, data) = match direction {
            Direction::U => (knots, self.knots_v().clone(), strip.data),
            Direction::V => {
                let columns = strip.width / self.parts();
                (self.knots_u().clone(), knots, transpose(&strip.data, columns, self.parts()))
            }
        };
        let (points, weights) = project(&data, rational);
        Self::new(knots_u, knots_v, points, weights)
    }
}
