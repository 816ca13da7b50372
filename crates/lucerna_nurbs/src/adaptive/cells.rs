//! The domain, halved where the surface bends.

use alloc::vec::Vec;

use crate::flatness::length;
use crate::patch::Patch;
use crate::vector::sub;
use crate::{Direction, NurbsError, Surface};

/// Halvings of a knot span.
const DEPTH: u32 = 20;
/// The most cells.
pub(super) const MAX_CELLS: usize = 1 << 20;
/// The relative distance at which points count as one.
const SAME: f64 = 1e-9;

/// A place in one direction: the knot span times `2^DEPTH`, plus the place within it.
pub(super) type Place = u32;

/// A rectangle of the domain: from and to along u, from and to along v.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) u: [Place; 2],
    pub(super) v: [Place; 2],
}

/// The cells of a surface, and how its edges meet.
pub(super) struct Cells {
    pub(super) leaves: Vec<Cell>,
    /// The distinct knots of the domain, along u and v.
    pub(super) knots: [Vec<f64>; 2],
    /// Whether the edges at the two ends of u, and of v, are the same.
    pub(super) closed: [bool; 2],
    /// For the lower and upper end of u, then of v: the point that the edge is, when it is one.
    pub(super) poles: [[Option<[f64; 3]>; 2]; 2],
}

impl Cells {
    /// Fails when there are more cells than `limit`.
    pub(super) fn new(surface: &Surface<f64>, tolerance: f64, limit: usize) -> Result<Self, NurbsError> {
        let patches = Patch::of_surface(surface)?;
        let columns = patches.iter().take_while(|patch| patch.lo[0] == patches[0].lo[0]).count();
        let rows = patches.len() / columns;
        let mut knots = [
            patches.iter().step_by(columns).map(|patch| patch.lo[0]).collect::<Vec<_>>(),
            patches[..columns].iter().map(|patch| patch.lo[1]).collect(),
        ];
        let most = (Place::MAX >> DEPTH) as usize - 1;
        if rows.max(columns) > most {
            return Err(NurbsError::Cells { name: "knot spans", found: rows.max(columns), min: 1, max: most });
        }
        let (domain_u, domain_v) = (surface.knots_u().domain(), surface.knots_v().domain());
        knots[0].push(domain_u.1);
        knots[1].push(domain_v.1);
        let edges = |direction: usize| {
            let row = |i: usize| patches[i * columns..(i + 1) * columns].iter().collect::<Vec<_>>();
            let column = |j: usize| patches.iter().skip(j).step_by(columns).collect::<Vec<_>>();
            let ends = if direction == 0 { [row(0), row(rows - 1)] } else { [column(0), column(columns - 1)] };
            [edge(&ends[0], direction, false), edge(&ends[1], direction, true)]
        };
        let extent = surface.points().iter().fold(0.0f64, |most, &p| most.max(length(sub(p, surface.points()[0]))));
        let same = |a: [f64; 3], b: [f64; 3]| length(sub(a, b)) <= SAME * extent;
        let (mut closed, mut poles) = ([false; 2], [[None; 2]; 2]);
        for direction in 0..2 {
            let [low, high] = edges(direction);
            for (pole, edge) in poles[direction].iter_mut().zip([&low, &high]) {
                *pole = edge.iter().all(|&point| same(point, edge[0])).then_some(edge[0]);
            }
            closed[direction] =
                poles[direction] == [None; 2] && low.iter().zip(&high).all(|(&low, &high)| same(low, high));
        }
        let mut cells = Self { leaves: Vec::new(), knots, closed, poles };
        for (k, patch) in patches.into_iter().enumerate() {
            let span = |at: usize| [(at as Place) << DEPTH, (at as Place + 1) << DEPTH];
            cells.halve(patch, Cell { u: span(k / columns), v: span(k % columns) }, tolerance, limit)?;
        }
        Ok(cells)
    }

    /// Halves until the patches are flat enough, and there are enough of them to close.
    fn halve(&mut self, patch: Patch<3>, cell: Cell, tolerance: f64, limit: usize) -> Result<(), NurbsError> {
        let least = [0, 1].map(|direction| {
            let poles = self.poles[direction].iter().flatten().count();
            let least = if self.closed[direction] { 3 } else { poles.max(1) };
            // Halvings of each span.
            least.div_ceil(self.knots[direction].len() - 1).next_power_of_two() as Place
        });
        let mut stack = alloc::vec![(patch, cell)];
        while let Some((patch, cell)) = stack.pop() {
            let bend = patch.bend();
            let coarse =
                [cell.u, cell.v].iter().zip(least).position(|(side, least)| (side[1] - side[0]) * least > 1 << DEPTH);
            let direction = match coarse {
                Some(0) => Direction::U,
                Some(_) => Direction::V,
                None if bend.distance() <= tolerance && self.leaves.len() < limit => {
                    self.leaves.push(cell);
                    continue;
                }
                // Where only the twist counts, halve the longer side.
                None if bend.uu == bend.vv && cell.u[1] - cell.u[0] < cell.v[1] - cell.v[0] => Direction::V,
                None if bend.uu >= bend.vv => Direction::U,
                None => Direction::V,
            };
            let side = if direction == Direction::U { cell.u } else { cell.v };
            let halves = if side[1] - side[0] > 1 { patch.halve(direction) } else { None };
            let Some([low, high]) = halves.filter(|_| self.leaves.len() + stack.len() < limit) else {
                return Err(NurbsError::Cells { name: "cells", found: MAX_CELLS + 1, min: 1, max: MAX_CELLS });
            };
            let middle = side[0] + (side[1] - side[0]) / 2;
            let with = |side: [Place; 2]| match direction {
                Direction::U => Cell { u: side, ..cell },
                Direction::V => Cell { v: side, ..cell },
            };
            stack.push((high, with([middle, side[1]])));
            stack.push((low, with([side[0], middle])));
        }
        Ok(())
    }

    /// The parameter at a place.
    pub(super) fn parameter(&self, direction: usize, place: Place) -> f64 {
        let knots = &self.knots[direction];
        let span = (place >> DEPTH) as usize;
        let part = f64::from(place & ((1 << DEPTH) - 1)) / f64::from(1u32 << DEPTH);
        match knots.get(span + 1) {
            Some(next) => knots[span] + (next - knots[span]) * part,
            None => knots[knots.len() - 1],
        }
    }

    /// The last place of a direction.
    pub(super) fn end(&self, direction: usize) -> Place {
        (self.knots[direction].len() as Place - 1) << DEPTH
    }
}

/// The control points of an edge: at an end of `direction`, the upper one or the lower.
fn edge(patches: &[&Patch<3>], direction: usize, upper: bool) -> Vec<[f64; 3]> {
    let mut points = Vec::new();
    for patch in patches {
        let [rows, columns] = patch.counts();
        let hull: Vec<[f64; 3]> = patch.hull().collect();
        if direction == 0 {
            let row = if upper { rows - 1 } else { 0 };
            points.extend_from_slice(&hull[row * columns..(row + 1) * columns]);
        } else {
            let column = if upper { columns - 1 } else { 0 };
            points.extend(hull.iter().skip(column).step_by(columns));
        }
    }
    points
}
