//! One rational surface in the forms of three libraries, and meshes of it.

use curvo::prelude::NurbsSurface3D;
use lucerna_nurbs::{GridOptions, GridPlan, KnotVector, NurbsError, Scratch, SimdLevel};
use nalgebra::Point4;
use truck_geometry::prelude::{BSplineSurface, KnotVec, NurbsSurface, ParametricSurface3D, Vector4};

/// Control points around and along.
pub const NET: [usize; 2] = [16, 11];
/// Samples around and along.
pub const SAMPLES: usize = 48;

/// A tube that narrows upwards, its weights and its clamped cubic knots.
pub struct Shape {
    points: Vec<[f64; 3]>,
    weights: Vec<f64>,
    knots: [KnotVector<f64>; 2],
}

impl Shape {
    /// The shape all libraries mesh; `seed` makes others of the same size.
    pub fn new(seed: usize) -> Result<Self, NurbsError> {
        let [n_u, n_v] = NET;
        let points = (0..n_u * n_v).map(|k| {
            let (sin, cos) = ((k / n_v) as f64 / n_u as f64 * 6.0).sin_cos();
            let y = (k % n_v) as f64 * 0.1;
            let radius = 1.2 - y + 0.1 * ((k + 7 * seed) as f64).sin();
            [radius * cos, y * 3.0, -radius * sin]
        });
        Ok(Self {
            points: points.collect(),
            weights: (0..n_u * n_v).map(|k| 1.0 + 0.1 * (k % 3) as f64).collect(),
            knots: [KnotVector::clamped_uniform(3, n_u)?, KnotVector::clamped_uniform(3, n_v)?],
        })
    }

    fn homogeneous(&self) -> Vec<Vec<[f64; 4]>> {
        let all = self.points.iter().zip(&self.weights).map(|([x, y, z], w)| [x * w, y * w, z * w, *w]);
        all.collect::<Vec<_>>().chunks(NET[1]).map(<[_]>::to_vec).collect()
    }

    /// The same for curvo.
    pub fn curvo(&self) -> NurbsSurface3D<f64> {
        let rows = self.homogeneous().into_iter().map(|row| row.into_iter().map(Point4::from).collect()).collect();
        let [u, v] = &self.knots;
        NurbsSurface3D::new(3, 3, u.as_slice().to_vec(), v.as_slice().to_vec(), rows)
    }

    /// The same for truck.
    pub fn truck(&self) -> NurbsSurface<Vector4> {
        let rows = self.homogeneous().into_iter().map(|row| row.into_iter().map(Vector4::from).collect()).collect();
        let [u, v] = &self.knots;
        let knots = (KnotVec::from(u.as_slice().to_vec()), KnotVec::from(v.as_slice().to_vec()));
        NurbsSurface::new(BSplineSurface::new(knots, rows))
    }

    /// The same for Lucerna in double precision, with its own weights.
    pub fn lucerna_f64(&self, level: SimdLevel) -> Result<Grid<f64>, NurbsError> {
        let [u, v] = &self.knots;
        let plan = GridPlan::new(u, v, grid())?.with_simd(level);
        Ok(Grid {
            scratch: plan.scratch(),
            mesh: vec![[0.0; 8]; plan.vertex_count()],
            plan,
            points: self.points.clone(),
            weights: self.weights.clone(),
        })
    }

    /// The same in single precision.
    pub fn lucerna(&self, level: SimdLevel) -> Result<Grid<f32>, NurbsError> {
        let knots = |count| KnotVector::clamped_uniform(3, count);
        let plan = GridPlan::new(&knots(NET[0])?, &knots(NET[1])?, grid())?.with_simd(level);
        Ok(Grid {
            scratch: plan.scratch(),
            mesh: vec![[0.0; 8]; plan.vertex_count()],
            plan,
            points: self.points.iter().map(|p| p.map(|x| x as f32)).collect(),
            weights: self.weights.iter().map(|&w| w as f32).collect(),
        })
    }
}

fn grid() -> GridOptions {
    GridOptions { columns: SAMPLES - 1, rows: SAMPLES - 1, ..GridOptions::default() }
}

/// A plan with a net and memory for its mesh.
pub struct Grid<T> {
    /// Tables and triangles.
    pub plan: GridPlan<T>,
    /// The net.
    pub points: Vec<[T; 3]>,
    /// Its weights.
    pub weights: Vec<T>,
    scratch: Scratch<T>,
    /// The mesh in plain form.
    pub mesh: Vec<[T; 8]>,
}

impl<T: lucerna_nurbs::Real> Grid<T> {
    /// Computes the mesh.
    pub fn run(&mut self) -> Result<(), NurbsError> {
        self.plan.evaluate_into(&self.points, Some(&self.weights), &mut self.scratch, &mut self.mesh[..])
    }
}

/// Positions and normals by curvo; its normals do not have length one.
pub fn run_curvo(surface: &NurbsSurface3D<f64>) -> impl Sized {
    surface.regular_tessellate(SAMPLES - 1, SAMPLES - 1)
}

/// Positions and normals by truck, which has no grids.
pub fn run_truck(surface: &NurbsSurface<Vector4>) -> Vec<[f64; 6]> {
    let place = |k: usize| k as f64 / (SAMPLES - 1) as f64;
    let samples = (0..SAMPLES * SAMPLES).map(|k| {
        let (u, v) = (place(k % SAMPLES), place(k / SAMPLES));
        let (point, normal) = (surface.subs(u, v), surface.normal(u, v));
        [point.x, point.y, point.z, normal.x, normal.y, normal.z]
    });
    samples.collect()
}
