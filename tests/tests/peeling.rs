//! Exact depth peeling: with enough layers, peeled and added surfaces equal one unsorted additive pass bit for bit,
//! and an opaque plane hides exactly what lies behind it.

use lucerna::frame::{
    Camera, FlameDraw, FlameShade, FlameVertex, Frame, Look, MeshVertex, OpaqueMesh, Shading, Transparency,
};
use lucerna::render::{FireRenderer, Stage};
use lucerna_tests::{device, read, target};
use rand_core::{RngCore, SeedableRng};
use rand_pcg::Pcg32;

const SIZE: [u32; 2] = [160, 120];
const TRIANGLES: usize = 240;
const LAYERS: u32 = 32;

/// Random triangles between z = -1 and 1, each a flame of its own with colours that are multiples of 1/64. Each keeps
/// to its own slab of depths, so that no two fragments of a pixel are tied, and slabs come in random order.
struct Scene {
    vertices: Vec<FlameVertex>,
    indices: Vec<u32>,
    draws: Vec<FlameDraw>,
    shades: Vec<FlameShade>,
    meshes: Vec<OpaqueMesh>,
    revision: u64,
}

impl Scene {
    fn random(seed: u64) -> Self {
        let mut rng = Pcg32::seed_from_u64(seed);
        let mut unit = move || rng.next_u32() as f32 / u32::MAX as f32;
        let slab = 2.0 / TRIANGLES as f32;
        let mut order: Vec<usize> = (0..TRIANGLES).collect();
        order.sort_by_cached_key(|_| (unit() * 1e6) as u32);
        let mut vertices = Vec::new();
        let mut shades = Vec::new();
        for flame in 0..TRIANGLES as u32 {
            let center = [unit() * 2.0 - 1.0, unit() * 1.6 - 0.8];
            let near = order[flame as usize] as f32 * slab - 1.0;
            for _ in 0..3 {
                let z = near + 0.9 * slab * unit();
                let position = [center[0] + 0.6 * (unit() - 0.5), center[1] + 0.6 * (unit() - 0.5), z];
                vertices.push(FlameVertex { position, normal: [0.0, 0.0, 1.0], flame, ..Default::default() });
            }
            let tint = [0; 3].map(|_: i32| (unit() * 8.0).floor() / 64.0);
            shades.push(FlameShade { tint, ..Default::default() });
        }
        let draws = (0..TRIANGLES as u32)
            .map(|i| FlameDraw { first_vertex: 3 * i, vertex_count: 3, first_index: 0, index_count: 3 })
            .collect();
        Self { vertices, indices: vec![0, 1, 2], draws, shades, meshes: Vec::new(), revision: seed }
    }

    fn frame(&self) -> Frame<'_> {
        Frame {
            flame_vertices: &self.vertices,
            flame_indices: &self.indices,
            flame_draws: &self.draws,
            flame_shades: &self.shades,
            meshes: &self.meshes,
            mesh_revision: self.revision,
            ..Default::default()
        }
    }
}

struct Bench {
    device: wgpu::Device,
    queue: wgpu::Queue,
    renderer: FireRenderer,
}

impl Bench {
    fn new() -> Self {
        let (device, queue) = device();
        let mut renderer = FireRenderer::new(&device, &queue, wgpu::TextureFormat::Rgba8UnormSrgb);
        renderer.set_flame_texture(&device, &queue, [2, 2], &[255; 16]).expect("a white texture");
        renderer.set_statistics(true);
        Self { device, queue, renderer }
    }

    /// The bits of the flames before any blur, and the layers that the picture needs.
    fn flames(&mut self, frame: &Frame<'_>, transparency: Transparency, layers: u32) -> (Vec<u8>, u32) {
        let camera = Camera { eye: [0.0, 0.0, 4.0], target: [0.0; 3], fov_y_deg: 35.0, near_m: 0.1, far_m: 20.0 };
        let look = Look {
            shading: Shading::Shell,
            transparency,
            layers,
            shell_softness: 0.0,
            samples: 1,
            ..Default::default()
        };
        let Self { device, queue, renderer } = self;
        renderer.prepare(device, queue, SIZE, frame, &camera, &look).expect("a drawable frame");
        let unused = target(device, SIZE, wgpu::TextureFormat::Rgba8UnormSrgb);
        let view = unused.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for stage in Stage::ALL {
            renderer.record(stage, &mut encoder, &view);
        }
        queue.submit([encoder.finish()]);
        let counted = renderer.read_statistics(device, queue).expect("statistics").layers;
        (read(device, queue, renderer.flame_texture().expect("drawn")), counted)
    }
}

#[test]
fn peeled_layers_equal_one_unsorted_pass_bit_for_bit() {
    let mut bench = Bench::new();
    for seed in 0..6 {
        let scene = Scene::random(seed);
        let (unsorted, counted) = bench.flames(&scene.frame(), Transparency::Unsorted, 1);
        assert!((4..=LAYERS).contains(&counted), "seed {seed} overlaps {counted} times: no test of peeling");
        let (peeled, _) = bench.flames(&scene.frame(), Transparency::Peeled, LAYERS);
        assert!(unsorted.iter().any(|byte| *byte != 0));
        assert!(peeled == unsorted, "seed {seed}: {} bytes differ", differing(&peeled, &unsorted));
        // One layer short of what is needed must show.
        let (short, _) = bench.flames(&scene.frame(), Transparency::Peeled, counted - 1);
        assert!(short != unsorted, "seed {seed}: a missing layer went unnoticed");
    }
}

#[test]
fn an_opaque_plane_hides_exactly_what_lies_behind_it() {
    let mut bench = Bench::new();
    for seed in 10..14 {
        let mut scene = Scene::random(seed);
        // The plane z = 0 lies between two slabs: hiding can be done by hand.
        let mut before = Scene::random(seed);
        for triangle in before.vertices.chunks_exact_mut(3).filter(|t| t[0].position[2] < 0.0) {
            for vertex in triangle {
                vertex.position = [9.0; 3];
            }
        }
        let corner =
            |x: f32, y: f32| MeshVertex { position: [x, y, 0.0], normal: [0.0, 0.0, 1.0], ..Default::default() };
        let vertices = vec![corner(-9.0, -9.0), corner(9.0, -9.0), corner(9.0, 9.0), corner(-9.0, 9.0)];
        scene.meshes = vec![OpaqueMesh { vertices, indices: vec![0, 1, 2, 0, 2, 3] }];
        scene.revision += 1000;
        for (transparency, layers) in [(Transparency::Peeled, LAYERS), (Transparency::Unsorted, 1)] {
            let (expected, counted) = bench.flames(&before.frame(), transparency, layers);
            let (hidden, also_counted) = bench.flames(&scene.frame(), transparency, layers);
            assert_eq!(counted, also_counted);
            assert!(expected.iter().any(|byte| *byte != 0));
            assert!(hidden == expected, "seed {seed}: {} bytes differ", differing(&hidden, &expected));
        }
    }
}

fn differing(a: &[u8], b: &[u8]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}
