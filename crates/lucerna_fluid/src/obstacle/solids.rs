//! What a step needs to know of the solid bodies: cells, faces, and how they move.

use std::sync::Arc;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::fill::Fill;
use super::shape::Shape;
use super::{MAX_OBSTACLES, Obstacle};
use crate::error::{FluidError, check, check_vec};
use crate::field::Field;
use crate::grid::Grid;
use crate::pressure::Mask;
use crate::scalars::Pack;
use crate::sides::Side;
use crate::viscosity::Held;

/// Solid bodies on a grid.
#[derive(Clone, Debug)]
pub(crate) struct Solids {
    obstacles: Vec<Obstacle>,
    /// Number of the obstacle of each cell, counted from 1; 0 is air.
    owners: Vec<u16>,
    /// The next ones, until all is known to be right.
    next_owners: Vec<u16>,
    flags: Vec<bool>,
    mask: Mask,
    /// Faces in or next to solid cells, by component, and the velocity of the solid there.
    faces: [Vec<(u32, f32)>; 3],
    /// See [`Held`].
    held_faces: [Vec<f32>; 3],
    held_cells: Vec<f32>,
    fill_cells: Fill,
    /// Faces within slippery bodies.
    fill_faces: [Fill; 3],
    has_slippery: bool,
    /// Where the box was when it took these bodies.
    origin: Vec3,
}

/// Solid bodies as cells, with how each moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct SavedSolids {
    origin: Vec3,
    owners: Vec<u16>,
    bodies: Vec<SavedBody>,
}

/// How a body moves, and whether air slides along it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct SavedBody {
    velocity_m_s: Vec3,
    spin_rad_s: Vec3,
    about: Vec3,
    is_slippery: bool,
}

impl SavedSolids {
    /// Refuses what no bodies in this grid are saved as.
    pub(crate) fn check(&self, grid: &Grid) -> Result<(), FluidError> {
        let (found, expected) = (self.owners.len(), grid.count());
        if found != expected {
            return Err(FluidError::Length { field: "obstacle cells", found, expected });
        }
        check("number of obstacles", self.bodies.len() as f32, 1.0, MAX_OBSTACLES as f32, "1 to 65534")?;
        let highest = self.owners.iter().copied().max().unwrap_or(0);
        check("obstacle of a cell", f32::from(highest), 0.0, self.bodies.len() as f32, "one of the obstacles")?;
        check_vec("obstacle origin", self.origin, 1.0e7, "components within ±1e7 m")?;
        self.bodies().iter().try_for_each(Obstacle::check)
    }

    /// The bodies: each is the cells that have its number.
    fn bodies(&self) -> Vec<Obstacle> {
        let owners: Arc<[u16]> = self.owners.as_slice().into();
        let body = |(index, body): (usize, &SavedBody)| Obstacle {
            shape: Shape::Numbered(Arc::clone(&owners), index as u16 + 1),
            velocity_m_s: body.velocity_m_s,
            spin_rad_s: body.spin_rad_s,
            about: body.about,
            is_slippery: body.is_slippery,
        };
        self.bodies.iter().enumerate().map(body).collect()
    }
}

impl Solids {
    pub(crate) fn new(grid: &Grid) -> Self {
        Self {
            obstacles: Vec::new(),
            owners: vec![0; grid.count()],
            next_owners: Vec::new(),
            flags: vec![false; grid.count()],
            mask: Mask::new(grid, &[]),
            faces: Default::default(),
            held_faces: Default::default(),
            held_cells: Vec::new(),
            fill_cells: Fill::default(),
            fill_faces: Default::default(),
            has_slippery: false,
            origin: grid.origin,
        }
    }

    pub(crate) fn is_in_use(&self) -> bool {
        !self.obstacles.is_empty()
    }

    pub(crate) fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    pub(crate) fn mask(&self) -> &Mask {
        &self.mask
    }

    /// As viscosity and conduction want it.
    pub(crate) fn held(&self) -> Held<'_> {
        Held { faces: self.held_faces.each_ref().map(Vec::as_slice), cells: &self.held_cells }
    }

    /// Takes other bodies, checked but for what only the grid tells.
    pub(crate) fn update(&mut self, grid: &Grid, obstacles: &[Obstacle]) -> Result<(), FluidError> {
        self.find_cells(grid, obstacles)?;
        self.take(grid, obstacles);
        Ok(())
    }

    /// What is saved of the bodies.
    pub(crate) fn saved(&self) -> SavedSolids {
        let bodies = self.obstacles.iter().map(|body| SavedBody {
            velocity_m_s: body.velocity_m_s,
            spin_rad_s: body.spin_rad_s,
            about: body.about,
            is_slippery: body.is_slippery,
        });
        SavedSolids { origin: self.origin, owners: self.owners.clone(), bodies: bodies.collect() }
    }

    /// The bodies that were saved, checked.
    pub(crate) fn from_saved(saved: &SavedSolids, grid: &Grid) -> Self {
        let grid = Grid { origin: saved.origin, ..grid.clone() };
        let mut solids = Self::new(&grid);
        solids.next_owners.clone_from(&saved.owners);
        solids.take(&grid, &saved.bodies());
        solids
    }

    /// Takes the bodies of the cells in `next_owners`.
    fn take(&mut self, grid: &Grid, obstacles: &[Obstacle]) {
        self.origin = grid.origin;
        self.obstacles.clear();
        self.obstacles.extend_from_slice(obstacles);
        let has_moved = self.owners != self.next_owners;
        std::mem::swap(&mut self.owners, &mut self.next_owners);
        let has_slippery = obstacles.iter().any(|obstacle| obstacle.is_slippery);
        if has_moved || self.held_cells.is_empty() || self.has_slippery || has_slippery {
            self.has_slippery = has_slippery;
            self.flags.clear();
            self.flags.extend(self.owners.iter().map(|owner| *owner != 0));
            self.mask.update(grid, &self.flags);
            self.held_cells.clear();
            self.held_cells.extend(self.flags.iter().map(|solid| if *solid { -1.0 } else { 0.0 }));
            self.fill_cells.find(grid, grid.cells, self.flags.iter().copied());
        }
        for axis in 0..3 {
            self.find_faces(grid, axis);
        }
    }

    /// Fills `next_owners`.
    fn find_cells(&mut self, grid: &Grid, obstacles: &[Obstacle]) -> Result<(), FluidError> {
        let [nx, ny, _] = grid.cells;
        let cell = Vec3::from_array(grid.cell_m);
        let half_diagonal = 0.5 * cell.length();
        self.next_owners.clear();
        self.next_owners.resize(grid.count(), 0);
        for (index, obstacle) in obstacles.iter().enumerate() {
            if let Some(cells) = obstacle.shape.cell_count()
                && cells != grid.count()
            {
                return Err(FluidError::ObstacleVoxels { index, cells, expected: grid.count() });
            }
            let [range_x, range_y, range_z] = obstacle.shape.cells(grid);
            let mut nearest = f32::MAX;
            for k in range_z {
                for j in range_y.clone() {
                    for i in range_x.clone() {
                        let at = i + nx * (j + ny * k);
                        let point = grid.origin + (Vec3::new(i as f32, j as f32, k as f32) + 0.5) * cell;
                        let distance = obstacle.shape.distance(point, at);
                        if distance.is_nan() {
                            let (field, allowed) = ("obstacle distance", "a number");
                            return Err(FluidError::Value { field, value: distance, allowed });
                        }
                        nearest = nearest.min(distance);
                        if distance < 0.0 {
                            self.next_owners[at] = index as u16 + 1;
                        }
                    }
                }
            }
            let is_outside = match obstacle.shape.bounds() {
                Some([low, high]) => (high.cmplt(grid.origin) | low.cmpgt(grid.origin + grid.size_m)).any(),
                // Of voxels none may be set; a closure may lie between the cells' centres.
                None => nearest > half_diagonal.min(0.999),
            };
            if is_outside {
                return Err(FluidError::ObstacleOutside { index });
            }
        }
        Ok(())
    }

    /// Finds the faces across `axis` that solids fix, and their velocities.
    fn find_faces(&mut self, grid: &Grid, axis: usize) {
        let cells = grid.cells;
        let counts = grid.face_counts(axis);
        let stride = [1, cells[0], cells[0] * cells[1]][axis];
        let is_periodic = grid.sides[axis][0] == Side::Periodic;
        let mut offset = Vec3::splat(0.5);
        offset[axis] = 0.0;
        let cell = Vec3::from_array(grid.cell_m);
        let (faces, held) = (&mut self.faces[axis], &mut self.held_faces[axis]);
        faces.clear();
        held.clear();
        for k in 0..counts[2] {
            for j in 0..counts[1] {
                for i in 0..counts[0] {
                    let index = [i, j, k];
                    let last = cells[axis];
                    // The cell above the face, and whether there is one on either side.
                    let above = i + cells[0] * (j + cells[1] * k);
                    let wraps = is_periodic && (index[axis] == 0 || index[axis] == last);
                    let row = above - index[axis] * stride;
                    let (low, high) = match index[axis] {
                        _ if wraps => (Some(row + (last - 1) * stride), Some(row)),
                        0 => (None, Some(above)),
                        at if at == last => (Some(above - stride), None),
                        _ => (Some(above - stride), Some(above)),
                    };
                    let owner = |cell: Option<usize>| cell.map_or(0, |cell| self.owners[cell]);
                    let (low_owner, high_owner) = (owner(low), owner(high));
                    if low_owner == 0 && high_owner == 0 {
                        held.push(0.0);
                        continue;
                    }
                    let at = grid.origin + (Vec3::new(i as f32, j as f32, k as f32) + offset) * cell;
                    let body = |owner: u16| &self.obstacles[usize::from(owner) - 1];
                    let (velocity, is_slippery) = match (low_owner, high_owner) {
                        (0, one) | (one, 0) => (body(one).velocity(at), body(one).is_slippery),
                        (one, other) => (
                            0.5 * (body(one).velocity(at) + body(other).velocity(at)),
                            body(one).is_slippery || body(other).is_slippery,
                        ),
                    };
                    let both = (low_owner != 0 || low.is_none()) && (high_owner != 0 || high.is_none());
                    // A side of the box fixes its own faces; with one cell nothing moves.
                    let sides = grid.sides[axis];
                    let is_fixed = match (low, high) {
                        (None, _) => sides[0].fixes_flow(),
                        (_, None) => sides[1].fixes_flow(),
                        _ => false,
                    };
                    if !is_fixed {
                        faces.push(((i + counts[0] * (j + counts[1] * k)) as u32, velocity[axis]));
                    }
                    held.push(match (is_slippery, both) {
                        (true, true) => -2.0,
                        (true, false) => -1.0,
                        (false, true) => 2.0,
                        (false, false) => 1.5,
                    });
                }
            }
        }
        let hidden = held.iter().map(|held| *held == -2.0);
        if self.has_slippery {
            self.fill_faces[axis].find(grid, counts, hidden);
        }
    }

    /// Gives the air on and in solids their velocity.
    pub(crate) fn fix(&self, velocity: &mut [Field; 3]) {
        for (field, faces) in velocity.iter_mut().zip(&self.faces) {
            for (face, value) in faces {
                field.data[*face as usize] = *value;
            }
        }
    }

    /// Fills `open` with 1 for each face, and 0 for those in or next to solid cells.
    pub(crate) fn close(&self, grid: &Grid, open: &mut [Vec<f32>; 3]) {
        for (axis, (open, faces)) in open.iter_mut().zip(&self.faces).enumerate() {
            open.resize(grid.face_counts(axis).iter().product(), 1.0);
            open.fill(1.0);
            for (face, _) in faces {
                open[*face as usize] = 0.0;
            }
        }
    }

    /// Continues what the air does into solids, so that samples near them see nothing of what
    /// is inside: scalars always, the velocity where they are slippery.
    pub(crate) fn fill(&self, velocity: &mut [Field; 3], temperature: &mut Field, packs: &mut [Pack]) {
        if self.has_slippery {
            for (field, fill) in velocity.iter_mut().zip(&self.fill_faces) {
                fill.apply(&mut field.data);
            }
        }
        self.fill_cells.apply(&mut temperature.data);
        packs.iter_mut().for_each(|pack| self.fill_cells.apply_packs(pack));
    }
}
