//! What a wick is made of: separate parts, and rings cut into open arcs, each of which carries a flame of its own.

use super::{along, checked, mesh};
use crate::error::in_range;
use crate::{FlameError, WickShape};
use glam::Vec3;
use std::collections::BTreeMap;

/// Arcs of a ring: a flame of four lead skeletons follows a third of a circle within a seventh of its radius.
const ARCS: usize = 3;

impl WickShape {
    /// The linear wicks that this shape is made of, each for a flame of its own: separate parts of a mesh, and closed
    /// rings cut into three open arcs that meet at their ends. Most shapes are one linear wick.
    ///
    /// Vertices up to `gap_m` apart belong to the same part; those more than 3.5 times as far from all others do not.
    /// Parts come in the order of their first vertices.
    ///
    /// ```
    /// use lucerna_flame::WickShape;
    ///
    /// let two = WickShape::Vertices(vec![[0.0; 3], [0.1, 0.0, 0.0], [0.9, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    /// assert_eq!(two.linear_wicks(0.2)?.len(), 2);
    /// # Ok::<(), lucerna_flame::FlameError>(())
    /// ```
    ///
    /// # Errors
    /// As [`centreline`](Self::centreline), and when `gap_m` is not 1e-6 to 1e6.
    pub fn linear_wicks(&self, gap_m: f32) -> Result<Vec<Self>, FlameError> {
        in_range("gap_m", gap_m, 1e-6, 1e6, "1e-6 to 1e6")?;
        match self {
            Self::Polyline { points, radius_m } => {
                self.centreline()?;
                let closed = points.len() > 3 && points.first() == points.last();
                let line: Vec<Vec3> = points.iter().copied().map(Vec3::from).collect();
                Ok(if closed { arcs(&line, *radius_m) } else { vec![self.clone()] })
            }
            Self::Vertices(vertices) => {
                let vertices = checked("wick.vertices", vertices)?;
                Ok(parts(&vertices, gap_m).into_iter().flat_map(linear).collect())
            }
        }
    }
}

fn linear(part: Vec<Vec3>) -> Vec<WickShape> {
    match mesh::closed_ring(&part) {
        Some((ring, radius_m)) => arcs(&ring, radius_m),
        None => vec![WickShape::Vertices(part.into_iter().map(|p| p.to_array()).collect())],
    }
}

/// Cuts a line into arcs of equal length.
fn arcs(line: &[Vec3], radius_m: f32) -> Vec<WickShape> {
    let total: f32 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    let cut = |i: usize| along(line, i as f32 / ARCS as f32).0;
    let arc = |i: usize| {
        let (from, to) = (total * i as f32 / ARCS as f32, total * (i + 1) as f32 / ARCS as f32);
        let mut passed = 0.0;
        let mut points = vec![cut(i)];
        for pair in line.windows(2) {
            passed += pair[0].distance(pair[1]);
            if passed > from && passed < to {
                points.push(pair[1]);
            }
        }
        points.push(cut(i + 1));
        WickShape::Polyline { points: points.into_iter().map(|p| p.to_array()).collect(), radius_m }
    };
    (0..ARCS).map(arc).collect()
}

/// Vertices in the same cell of a grid, or in cells that touch, belong together.
fn parts(vertices: &[Vec3], gap_m: f32) -> Vec<Vec<Vec3>> {
    let cell_of = |p: &Vec3| [p.x, p.y, p.z].map(|x| (x / gap_m).floor() as i64);
    let mut part_of: BTreeMap<[i64; 3], Option<usize>> = vertices.iter().map(|p| (cell_of(p), None)).collect();
    let mut count = 0;
    for vertex in vertices {
        let mut open = vec![cell_of(vertex)];
        let mut found = false;
        while let Some([x, y, z]) = open.pop() {
            match part_of.get_mut(&[x, y, z]) {
                Some(part @ None) => *part = Some(count),
                _ => continue,
            }
            found = true;
            for i in 0..27 {
                open.push([x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1]);
            }
        }
        count += usize::from(found);
    }
    let mut parts = vec![Vec::new(); count];
    for vertex in vertices {
        if let Some(part) = part_of.get(&cell_of(vertex)).copied().flatten() {
            parts[part].push(*vertex);
        }
    }
    parts
}
