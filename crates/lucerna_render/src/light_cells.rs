//! Which lights, merged or not, light which part of the scene: a grid of cells fixed in the world.

use crate::light_tree::LightTree;
use glam::{Mat4, UVec3, Vec3, Vec4};
use lucerna_frame::OpaqueMesh;

/// Most cells.
const MAX_CELLS: u32 = 4096;
/// So few lights are added up one by one everywhere.
pub(crate) const FEW_LIGHTS: usize = 16;
/// Most entries of all lists: cells beyond it are lit by all lights one by one.
const MAX_ENTRIES: usize = 1 << 21;
/// Where the grid's origin lies in a cell: floors and walls stand at round numbers, and not between two cells.
const OFFSET: f32 = 0.37;

/// The cells, and what lights each.
#[derive(Debug, Default)]
pub(crate) struct LightCells {
    /// Corner of the grid, m.
    pub(crate) origin: Vec3,
    /// Edge of a cell, m: a power of two, so that cells stay where they are when the scene's bounds move.
    pub(crate) edge_m: f32,
    /// Cells along each axis.
    counts: UVec3,
    /// Cells that have lists of their own: all, or a single one where nothing merges.
    pub(crate) used: UVec3,
    /// The cells with a surface in them.
    occupied: Vec<bool>,
    /// For each cell where its list begins and ends; then the lists.
    data: Vec<u32>,
}

impl LightCells {
    /// Lays the grid around meshes.
    pub(crate) fn lay(&mut self, meshes: &[OpaqueMesh]) {
        let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
        for vertex in meshes.iter().flat_map(|mesh| &mesh.vertices) {
            low = low.min(vertex.position.into());
            high = high.max(vertex.position.into());
        }
        let longest = (high - low).max_element();
        if !(longest > 1e-6 && longest < 1e30) {
            (self.origin, self.edge_m, self.counts) = (Vec3::ZERO, 1.0, UVec3::ONE);
            self.occupied.clear();
            self.occupied.push(true);
            return;
        }
        let mut edge = (longest / MAX_CELLS as f32).log2().ceil().exp2();
        let (origin, counts) = loop {
            let corner = ((low / edge - OFFSET).floor() + OFFSET) * edge;
            let counts = ((high - corner) / edge).floor() + 1.0;
            if counts.element_product() <= MAX_CELLS as f32 {
                break (corner, counts.as_uvec3());
            }
            edge *= 2.0;
        };
        (self.origin, self.edge_m, self.counts) = (origin, edge, counts);
        self.occupied.clear();
        self.occupied.resize(counts.element_product() as usize, false);
        for mesh in meshes {
            for corners in mesh.indices.chunks_exact(3) {
                let corners = [0, 1, 2].map(|i: usize| Vec3::from(mesh.vertices[corners[i] as usize].position));
                self.occupy(corners);
            }
        }
    }

    fn occupy(&mut self, corners: [Vec3; 3]) {
        // A little more: a pixel's place is rounded.
        let slack = 1e-3 * self.edge_m;
        let low = corners.into_iter().fold(Vec3::MAX, Vec3::min) - slack;
        let high = corners.into_iter().fold(Vec3::MIN, Vec3::max) + slack;
        let cell = |point: Vec3| ((point - self.origin) / self.edge_m).max(Vec3::ZERO).as_uvec3().min(self.counts - 1);
        let (first, last) = (cell(low), cell(high));
        for z in first.z..=last.z {
            for y in first.y..=last.y {
                let row = (z * self.counts.y + y) * self.counts.x;
                self.occupied[(row + first.x) as usize..=(row + last.x) as usize].fill(true);
            }
        }
    }

    /// Makes the lists of the cells that the camera sees; surfaces anywhere else are lit by all lights one by one.
    pub(crate) fn fill(&mut self, tree: &LightTree, angle: f32, clip_from_world: Mat4) -> &[u32] {
        let merges = angle > 0.0 && tree.light_count() > FEW_LIGHTS;
        let counts = if merges { self.counts } else { UVec3::ONE };
        self.used = counts;
        let cells = counts.element_product() as usize;
        let Self { data, .. } = self;
        data.clear();
        data.resize(2 * cells, 0);
        tree.cut(Vec3::ZERO, Vec3::ZERO, 0.0, |index| data.push(index));
        let all = [2 * cells as u32, data.len() as u32];
        for cell in 0..cells {
            let mut list = all;
            if merges && self.occupied[cell] && data.len() < MAX_ENTRIES {
                let at = cell as u32;
                let at = UVec3::new(at % counts.x, at / counts.x % counts.y, at / (counts.x * counts.y));
                let low = self.origin + at.as_vec3() * self.edge_m;
                if is_seen(low, self.edge_m, clip_from_world) {
                    let begin = data.len() as u32;
                    tree.cut(low, low + self.edge_m, angle, |index| data.push(index));
                    list = [begin, data.len() as u32];
                }
            }
            data[2 * cell..][..2].copy_from_slice(&list);
        }
        data
    }
}

/// False if a cube lies outside one of the view's planes.
fn is_seen(low: Vec3, edge: f32, clip_from_world: Mat4) -> bool {
    let rows = clip_from_world.transpose();
    let (half, center) = (0.5 * edge, low + 0.5 * edge);
    let reaches = |plane: Vec4| {
        let normal = plane.truncate();
        normal.dot(center) + plane.w + normal.abs().element_sum() * half >= 0.0
    };
    let [x, y, z, w] = [rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis];
    [w + x, w - x, w + y, w - y, z, w - z].into_iter().all(reaches)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light_tree::Node;
    use lucerna_frame::MeshVertex;

    fn triangle(corners: [[f32; 3]; 3]) -> OpaqueMesh {
        let vertices = corners.map(|position| MeshVertex { position, ..Default::default() }).to_vec();
        OpaqueMesh { vertices, indices: vec![0, 1, 2] }
    }

    fn tree(count: usize) -> LightTree {
        let mut tree = LightTree::default();
        let place = |i: usize| Vec3::new(i as f32 % 7.0, (i / 7) as f32 % 5.0, (i / 35) as f32);
        tree.build((0..count).map(|i| Node::light(place(i), 0.01, Vec3::splat(1.0 + i as f32))));
        tree
    }

    #[test]
    fn every_cell_is_lit_by_all_the_light() {
        let floor = triangle([[-1.0, 0.0, -1.0], [9.0, 0.0, 4.0], [2.0, 0.0, 8.0]]);
        let meshes = [floor, triangle([[4.0, 5.0, 1.0], [4.0, 6.0, 1.0], [5.0, 6.0, 1.0]])];
        let (mut cells, tree) = (LightCells::default(), tree(100));
        cells.lay(&meshes);
        assert!((256..=MAX_CELLS).contains(&cells.counts.element_product()), "{:?}", cells.counts);
        let camera = lucerna_frame::Camera { eye: [4.0, 2.0, 30.0], target: [4.0, 2.0, 0.0], ..Default::default() };
        let clip_from_world = camera.clip_from_view(1.0) * camera.view_from_world();
        let data = cells.fill(&tree, 0.2, clip_from_world).to_vec();
        let count = cells.used.element_product() as usize;
        let mut merged = 0;
        for cell in data[..2 * count].chunks_exact(2) {
            let list = &data[cell[0] as usize..cell[1] as usize];
            let sum: f32 = list.iter().map(|node| tree.nodes()[*node as usize].intensity.x).sum();
            assert!((sum - 5050.0).abs() < 0.1, "{sum}");
            merged += usize::from(list.len() < 100);
        }
        assert!(merged > 50 && merged < count, "{merged} of {count} cells");
        // Behind the camera's back nothing is merged, and nothing where lights are few.
        let away = lucerna_frame::Camera { target: [4.0, 2.0, 60.0], ..camera };
        let data = cells.fill(&tree, 0.2, away.clip_from_view(1.0) * away.view_from_world());
        assert_eq!(data.len(), 2 * count + 100);
        assert_eq!(cells.fill(&self::tree(FEW_LIGHTS), 0.2, clip_from_world).len(), 2 + FEW_LIGHTS);
        assert_eq!(cells.used, UVec3::ONE);
    }

    #[test]
    fn cells_stay_where_they_are_when_the_bounds_move_a_little() {
        let (mut cells, mut moved) = (LightCells::default(), LightCells::default());
        cells.lay(&[triangle([[0.0, 0.0, 0.0], [8.0, 0.0, 8.0], [4.0, 3.0, 4.0]])]);
        moved.lay(&[triangle([[-0.1, 0.0, 0.0], [7.7, 0.0, 8.0], [4.0, 3.3, 4.0]])]);
        assert_eq!(cells.edge_m, moved.edge_m);
        let steps = (cells.origin - moved.origin) / cells.edge_m;
        assert!((steps - steps.round()).abs().max_element() < 1e-5, "{steps}");
        // Without a mesh, or with one in a single place, there is one cell.
        for meshes in [&[][..], &[triangle([[1.0; 3]; 3])]] {
            cells.lay(meshes);
            assert_eq!(cells.counts, UVec3::ONE);
        }
    }
}
