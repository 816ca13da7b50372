//! Where vertices go.

use crate::{NurbsError, Real};

/// A vertex as a plan hands it out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GridVertex<T> {
    /// The point of the surface, in the unit of the control points.
    pub position: [T; 3],
    /// The unit normal.
    pub normal: [T; 3],
    /// The place along u, 0 to 1 from the first column to the last.
    pub u: T,
    /// The place along v, 0 to 1.
    pub v: T,
}

/// From the plain form, `[x, y, z, u, nx, ny, nz, v]`.
impl<T> From<[T; 8]> for GridVertex<T> {
    #[inline(always)]
    fn from([x, y, z, u, a, b, c, v]: [T; 8]) -> Self {
        Self { position: [x, y, z], normal: [a, b, c], u, v }
    }
}

/// Takes the vertices of a mesh.
///
/// Pass one of these to [`GridPlan::evaluate_into`](crate::GridPlan::evaluate_into), or your own:
///
/// * `[[T; 8]]` takes the plain form `[x, y, z, u, nx, ny, nz, v]`, which is two `vec4` in a
///   shader. It is the fastest: vertices are written where they stay.
/// * `[V]`, a slice of your own vertices, if these implement `From<GridVertex<T>>`.
/// * [`Interleaved`]: numbers at a stride, with attributes where you want them.
///
/// ```
/// use lucerna_nurbs::{GridOptions, GridPlan, GridVertex, KnotVector};
///
/// #[derive(Clone, Default)]
/// struct Vertex {
///     position: [f32; 3],
///     colour: [u8; 4],
/// }
///
/// impl From<GridVertex<f32>> for Vertex {
///     fn from(vertex: GridVertex<f32>) -> Self {
///         Self { position: vertex.position, colour: vertex.normal_colour() }
///     }
/// }
/// # trait Colour { fn normal_colour(&self) -> [u8; 4]; }
/// # impl Colour for GridVertex<f32> {
/// #     fn normal_colour(&self) -> [u8; 4] { [(255.0 * self.normal[2]) as u8, 0, 0, 255] }
/// # }
///
/// let knots = KnotVector::<f32>::clamped_uniform(1, 2)?;
/// let plan = GridPlan::new(&knots, &knots, GridOptions { columns: 1, rows: 1, ..Default::default() })?;
/// let net = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]];
/// let mut vertices = vec![Vertex::default(); plan.vertex_count()];
/// plan.evaluate_into(&net, None, &mut plan.scratch(), &mut vertices[..])?;
/// assert_eq!(vertices[3].position, [1.0, 1.0, 0.0]);
/// assert_eq!(vertices[3].colour, [255, 0, 0, 255]);
/// # Ok::<(), lucerna_nurbs::NurbsError>(())
/// ```
pub trait GridOutput<T: Real> {
    /// The number of vertices that fit in.
    fn room(&self) -> usize {
        usize::MAX
    }

    /// Takes vertex `index`, which is below [`room`](Self::room). Indices rise from 0.
    fn vertex(&mut self, index: usize, vertex: GridVertex<T>);

    /// Memory for vertices in plain form, if there is any, at least [`room`](Self::room) of them;
    /// [`vertex`](Self::vertex) is not called then.
    fn plain(&mut self) -> Option<&mut [[T; 8]]> {
        None
    }
}

impl<T: Real> GridOutput<T> for [[T; 8]] {
    fn room(&self) -> usize {
        self.len()
    }

    fn vertex(&mut self, index: usize, vertex: GridVertex<T>) {
        let ([x, y, z], [a, b, c]) = (vertex.position, vertex.normal);
        self[index] = [x, y, z, vertex.u, a, b, c, vertex.v];
    }

    fn plain(&mut self) -> Option<&mut [[T; 8]]> {
        Some(self)
    }
}

impl<T: Real, V: From<GridVertex<T>>> GridOutput<T> for [V] {
    fn room(&self) -> usize {
        self.len()
    }

    #[inline]
    fn vertex(&mut self, index: usize, vertex: GridVertex<T>) {
        self[index] = vertex.into();
    }
}

/// A closure as output.
pub(super) struct Each<F>(pub(super) F);

impl<T: Real, F: FnMut(usize, GridVertex<T>)> GridOutput<T> for Each<F> {
    #[inline]
    fn vertex(&mut self, index: usize, vertex: GridVertex<T>) {
        (self.0)(index, vertex);
    }
}

/// Where the attributes of a vertex lie, counted in scalars from its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GridLayout {
    /// Scalars from one vertex to the next.
    pub stride: usize,
    /// The position, three scalars.
    pub position: Option<usize>,
    /// The unit normal, three scalars.
    pub normal: Option<usize>,
    /// The places along u and v, two scalars.
    pub uv: Option<usize>,
}

/// Vertices interleaved with whatever else a buffer holds, which stays as it is.
///
/// ```
/// use lucerna_nurbs::{GridLayout, GridOptions, GridPlan, Interleaved, KnotVector};
///
/// let knots = KnotVector::<f32>::clamped_uniform(1, 2)?;
/// let plan = GridPlan::new(&knots, &knots, GridOptions { columns: 1, rows: 1, ..Default::default() })?;
/// let net = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]];
/// let layout = GridLayout { stride: 10, position: Some(0), normal: Some(4), uv: Some(8) };
/// let mut buffer = vec![7.0_f32; 10 * plan.vertex_count()];
/// plan.evaluate_into(&net, None, &mut plan.scratch(), &mut Interleaved::new(&mut buffer, layout)?)?;
/// assert_eq!(buffer[10..20], [1.0, 0.0, 0.0, 7.0, 0.0, 0.0, 1.0, 7.0, 1.0, 0.0]);
/// # Ok::<(), lucerna_nurbs::NurbsError>(())
/// ```
#[derive(Debug)]
pub struct Interleaved<'a, T> {
    buffer: &'a mut [T],
    layout: GridLayout,
}

impl<'a, T: Real> Interleaved<'a, T> {
    /// Vertices from the start of `buffer` on, as many as fit in.
    ///
    /// # Errors
    /// When an attribute reaches beyond the stride.
    pub fn new(buffer: &'a mut [T], layout: GridLayout) -> Result<Self, NurbsError> {
        let stride = layout.stride;
        for (name, offset, len) in
            [("position", layout.position, 3), ("normal", layout.normal, 3), ("uv", layout.uv, 2)]
        {
            if let Some(offset) = offset.filter(|offset| offset.saturating_add(len) > stride) {
                return Err(NurbsError::Layout { name, offset, len, stride });
            }
        }
        if stride == 0 {
            return Err(NurbsError::Layout { name: "vertex", offset: 0, len: 1, stride });
        }
        Ok(Self { buffer, layout })
    }
}

impl<T: Real> GridOutput<T> for Interleaved<'_, T> {
    fn room(&self) -> usize {
        self.buffer.len() / self.layout.stride
    }

    #[inline]
    fn vertex(&mut self, index: usize, vertex: GridVertex<T>) {
        let GridLayout { stride, position, normal, uv } = self.layout;
        let to = &mut self.buffer[index * stride..(index + 1) * stride];
        if let Some(at) = position {
            to[at..at + 3].copy_from_slice(&vertex.position);
        }
        if let Some(at) = normal {
            to[at..at + 3].copy_from_slice(&vertex.normal);
        }
        if let Some(at) = uv {
            to[at..at + 2].copy_from_slice(&[vertex.u, vertex.v]);
        }
    }
}
