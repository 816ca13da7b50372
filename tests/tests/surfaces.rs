//! Flame surfaces made on the GPU from control nets are those that the CPU makes.

use glam::Vec3;
use lucerna::flame::{FlameSettings, Flames, Surfaces, UniformAir, WickShape};
use lucerna::frame::{Camera, FlameDraw, FlameGrid, FlameNet, FlameNets, FlameShade, FlameVertex, Frame, Look};
use lucerna::render::{FireRenderer, RenderError, Stage};
use lucerna::{DebugLines, World};
use lucerna_tests::{burning, device, read, read_buffer, step_once, target};

const SIZE: [u32; 2] = [150, 117];

struct Bench {
    device: wgpu::Device,
    queue: wgpu::Queue,
    renderer: FireRenderer,
}

impl Bench {
    fn new() -> Self {
        let (device, queue) = device();
        let renderer = FireRenderer::new(&device, &queue, wgpu::TextureFormat::Rgba8UnormSrgb);
        Self { device, queue, renderer }
    }

    fn prepare(&mut self, frame: &Frame<'_>, camera: &Camera, look: &Look) -> Result<(), RenderError> {
        self.renderer.prepare(&self.device, &self.queue, SIZE, frame, camera, look)
    }

    /// The bytes of a picture.
    fn picture(&mut self, frame: &Frame<'_>, camera: &Camera, look: &Look) -> Vec<u8> {
        self.prepare(frame, camera, look).expect("a frame that can be drawn");
        let picture = target(&self.device, SIZE, wgpu::TextureFormat::Rgba8UnormSrgb);
        let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.render(&mut encoder, &view);
        self.queue.submit([encoder.finish()]);
        read(&self.device, &self.queue, &picture)
    }

    /// The vertices that the GPU makes of a frame's nets.
    fn vertices(&mut self, frame: &Frame<'_>) -> Vec<FlameVertex> {
        self.prepare(frame, &Camera::default(), &Look::default()).expect("a frame that can be drawn");
        let unused = target(&self.device, SIZE, wgpu::TextureFormat::Rgba8UnormSrgb);
        let view = unused.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.record(Stage::Surfaces, &mut encoder, &view);
        self.queue.submit([encoder.finish()]);
        let count: u32 = frame.flame_draws.iter().map(|draw| draw.vertex_count).sum();
        let bytes = u64::from(count) * size_of::<FlameVertex>() as u64;
        let bytes = read_buffer(&self.device, &self.queue, self.renderer.flame_vertices(), bytes);
        bytes.chunks_exact(size_of::<FlameVertex>()).map(bytemuck::pod_read_unaligned).collect()
    }
}

/// The largest differences found so far.
#[derive(Debug, Default)]
struct Worst {
    /// Positions, heights and half thicknesses, as shares of the flame's size.
    position: f32,
    height: f32,
    radius: f32,
    /// Normals, degrees.
    normal: f32,
    vertices: usize,
    /// Pairs of vertices of a ring that meet: at seams, along slits.
    meetings: usize,
}

impl Worst {
    fn compare(&mut self, made: &[FlameVertex], expected: &[FlameVertex], draws: &[FlameDraw]) {
        assert_eq!(made.len(), expected.len());
        self.vertices += made.len();
        for (index, draw) in draws.iter().enumerate() {
            let range = draw.first_vertex as usize..(draw.first_vertex + draw.vertex_count) as usize;
            let (made, expected) = (&made[range.clone()], &expected[range]);
            let points = expected.iter().map(|v| Vec3::from(v.position));
            let (low, high) = points.fold((Vec3::MAX, Vec3::MIN), |(low, high), p| (low.min(p), high.max(p)));
            let size = (high - low).max_element();
            for (a, b) in made.iter().zip(expected) {
                let numbers = a.position.iter().chain(&a.normal).chain([&a.height, &a.radius_m]).chain(&a.uv);
                assert!(numbers.copied().all(f32::is_finite), "{a:?}");
                assert_eq!((a.uv, a.flame, a.padding), (b.uv, index as u32, 0));
                let apart = |a: [f32; 3], b: [f32; 3]| Vec3::from(a).distance(Vec3::from(b));
                self.position = self.position.max(apart(a.position, b.position) / size);
                self.height = self.height.max((a.height - b.height).abs());
                self.radius = self.radius.max((a.radius_m - b.radius_m).abs() / size);
                let angle = 2.0 * (0.5 * apart(a.normal, b.normal)).asin().to_degrees();
                self.normal = self.normal.max(angle);
            }
            // What closes bit for bit on the CPU does so on the GPU.
            let rings = |vertices: &[FlameVertex]| -> Vec<Vec<FlameVertex>> {
                vertices.chunk_by(|a, b| a.uv[1] == b.uv[1]).map(<[_]>::to_vec).collect()
            };
            for (made, expected) in rings(made).iter().zip(rings(expected)) {
                for (i, j) in (0..made.len() / 2).map(|i| (i, made.len() - 1 - i)) {
                    if expected[i].position == expected[j].position {
                        assert_eq!(made[i].position, made[j].position, "vertices {i} and {j} of a ring of {index}");
                        self.meetings += 1;
                    }
                }
            }
        }
    }

    #[track_caller]
    fn check(&self, name: &str) {
        println!("{name}: {self:?}");
        assert!(self.position < 1e-5 && self.height < 1e-5 && self.radius < 1e-5, "{name}: {self:?}");
        assert!(self.normal < 0.1 && self.meetings > 100, "{name}: {self:?}");
    }
}

/// Both frames of a moment: vertices, then nets.
fn both_ways(world: &mut World, mut see: impl FnMut(&Frame<'_>)) {
    for surfaces in [Surfaces::Vertices, Surfaces::Nets] {
        world.set_surfaces(surfaces);
        see(&world.frame());
    }
}

#[test]
fn the_gpu_makes_the_vertices_that_the_cpu_makes() {
    let mut bench = Bench::new();
    for name in lucerna_tests::small_scenes() {
        let mut worst = Worst::default();
        let mut world = burning(name, 0.6);
        for _ in 0..3 {
            for _ in 0..20 {
                step_once(&mut world);
            }
            let mut expected = Vec::new();
            both_ways(&mut world, |frame| {
                if frame.flame_nets.is_none() {
                    expected = frame.flame_vertices.to_vec();
                } else {
                    assert!(frame.flame_vertices.is_empty());
                    let points = frame.flame_nets.map_or(0, |nets| size_of_val(nets.points));
                    let (flames, vertices) = (frame.flame_draws.len(), size_of_val(&*expected));
                    println!("{name}: {flames} flames, {points} bytes of control points, {vertices} of vertices");
                    worst.compare(&bench.vertices(frame), &expected, frame.flame_draws);
                }
            });
        }
        worst.check(name);
    }
}

#[test]
fn flames_of_every_size_are_made_on_the_gpu() {
    // A point with poles, lines with slits; fewer and more samples than a workgroup has threads.
    let mut bench = Bench::new();
    let wicks = [vec![[0.1, 0.2, 0.3]], vec![[-0.05, 0.0, 0.0], [0.05, 0.01, 0.02]]];
    for (around, up) in [(4, 3), (6, 7), (32, 24), (130, 5), (256, 9)] {
        let mut worst = Worst::default();
        let settings = wicks.clone().map(|points| {
            let mut settings = FlameSettings::new(WickShape::Polyline { points, radius_m: 0.001 });
            (settings.surface.around, settings.surface.up) = (around, up);
            settings.skeletons.shed_per_s = 30.0;
            settings
        });
        let mut flames = Flames::new(settings.to_vec(), 1).expect("flames");
        let low_m = Vec3::NEG_ONE;
        let air = UniformAir { velocity_m_s: Vec3::new(0.1, 0.5, 0.05), low_m, high_m: -low_m };
        for _ in 0..4 {
            (0..5).for_each(|_| flames.step(&air, 1.0 / 60.0));
            flames.set_surfaces(Surfaces::Vertices);
            flames.build();
            let (expected, lights) = (flames.vertices().to_vec(), flames.lights().to_vec());
            flames.set_surfaces(Surfaces::Nets);
            flames.build();
            assert_eq!(flames.lights(), lights, "the light of a flame needs no vertices");
            worst.compare(&bench.vertices(&frame(&flames)), &expected, flames.draws());
        }
        worst.check(&format!("{around} x {up}"));
    }
}

fn frame(flames: &Flames) -> Frame<'_> {
    Frame {
        flame_indices: flames.indices(),
        flame_draws: flames.draws(),
        flame_nets: flames.nets(),
        flame_shades: flames.shades(),
        ..Frame::default()
    }
}

#[test]
fn both_ways_show_the_same_picture() {
    let mut bench = Bench::new();
    for name in lucerna_tests::small_scenes() {
        let mut world = burning(name, 1.0);
        let (camera, look) = (world.scene().scene.camera, world.scene().scene.look.clone());
        let mut pictures = Vec::new();
        both_ways(&mut world, |frame| pictures.push(bench.picture(frame, &camera, &look)));
        let differences = || pictures[0].iter().zip(&pictures[1]).map(|(a, b)| a.abs_diff(*b));
        let count = pictures[0].len() as f64;
        let mean = differences().map(f64::from).sum::<f64>() / count;
        let worst = differences().max().unwrap_or_default();
        // An edge that passes a pixel's centre within rounding may fall on either side of it.
        let off = differences().filter(|difference| *difference > 4).count() as f64 / count;
        println!("{name}: {mean:.4} of 255 on average, {worst} at most, {off:.1e} off by more than 4");
        assert!(pictures[0].iter().any(|byte| *byte > 128), "{name} is dark");
        assert!(mean < 0.02 && off < 1e-3, "{name}: {mean} on average, {off} of all off by more than 4");
    }
}

#[test]
fn a_world_keeps_its_choice_and_burns_the_same() {
    let (mut here, mut there) = (burning("torch", 0.3), burning("torch", 0.3));
    there.set_surfaces(Surfaces::Nets);
    for step in 0..5 {
        assert!(there.frame().flame_nets.is_some() && there.frame().flame_vertices.is_empty(), "step {step}");
        assert!(here.frame().flame_nets.is_none() && !here.frame().flame_vertices.is_empty(), "step {step}");
        assert_eq!((here.state_hash(), here.frame().lights), (there.state_hash(), there.frame().lights), "step {step}");
        assert_eq!(here.frame().flame_draws, there.frame().flame_draws, "step {step}");
        step_once(&mut here);
        step_once(&mut there);
    }
    // The wireframe is drawn from vertices.
    let wireframe = DebugLines { wireframe: true, ..DebugLines::default() };
    here.set_debug_lines(wireframe);
    there.set_debug_lines(wireframe);
    assert!(!here.frame().lines.is_empty() && here.frame().lines == there.frame().lines);
    assert!(here.frame().flame_vertices == there.frame().flame_vertices && there.frame().flame_nets.is_none());
    there.set_debug_lines(DebugLines::default());
    assert!(there.frame().flame_nets.is_some() && there.frame().lines.is_empty());

    let revision = |world: &World| world.frame().flame_nets.expect("nets").grid_revision;
    let before = revision(&there);
    there.reset();
    there.set_scene(lucerna::scene::builtin("candle").expect("candle")).expect("another scene");
    assert_ne!(revision(&there), before, "the grids of another scene would not be uploaded");
}

#[test]
fn the_same_buffer_serves_all_frames() {
    let mut bench = Bench::new();
    let mut world = burning("torch", 0.5);
    world.set_surfaces(Surfaces::Nets);
    bench.vertices(&world.frame());
    let first = bench.renderer.flame_vertices().clone();
    for _ in 0..10 {
        step_once(&mut world);
        bench.vertices(&world.frame());
        assert_eq!(bench.renderer.flame_vertices(), &first, "a buffer was made anew");
    }
}

/// What a frame with nets is made of.
#[derive(Clone)]
struct Parts {
    grids: Vec<FlameGrid>,
    points: Vec<[f32; 4]>,
    nets: Vec<FlameNet>,
    draws: Vec<FlameDraw>,
}

impl Parts {
    fn word(&self, at: usize) -> u32 {
        u32::from_le_bytes(std::array::from_fn(|i| self.grids[0].tables[4 * at + i]))
    }

    fn set(&mut self, at: usize, value: u32) {
        self.grids[0].tables[4 * at..4 * at + 4].copy_from_slice(&value.to_le_bytes());
    }
}

#[test]
fn nets_that_do_not_fit_are_refused() {
    let mut flames = Flames::new(vec![FlameSettings::new(WickShape::Vertices(vec![[0.0; 3]]))], 1).expect("a flame");
    flames.set_surfaces(Surfaces::Nets);
    flames.build();
    let good = flames.nets().expect("nets");
    let good = Parts {
        grids: good.grids.to_vec(),
        points: good.points.to_vec(),
        nets: good.nets.to_vec(),
        draws: flames.draws().to_vec(),
    };
    let mut bench = Bench::new();
    let mut grid_revision = u64::MAX;
    let mut prepare = |change: &dyn Fn(&mut Parts)| {
        let mut parts = good.clone();
        change(&mut parts);
        let Parts { grids, points, nets, draws } = &parts;
        grid_revision -= 1;
        let shades = vec![FlameShade::default(); draws.len()];
        let frame = Frame {
            flame_nets: Some(FlameNets { grids, grid_revision, points, nets }),
            flame_draws: draws,
            flame_shades: &shades,
            ..frame(&flames)
        };
        bench.prepare(&frame, &Camera::default(), &Look::default())
    };
    prepare(&|_| {}).expect("a good frame");
    let mut refused = |what: &str, change: &dyn Fn(&mut Parts)| {
        let error = prepare(change).expect_err(what);
        println!("{what}: {error}");
        assert!(matches!(error, RenderError::Frame { .. }), "{what}: {error}");
    };
    refused("a net less", &|parts| parts.nets.clear());
    refused("a draw less", &|parts| parts.draws.clear());
    refused("a grid that is not there", &|parts| parts.nets[0].grid = parts.grids.len() as u32);
    refused("no grid", &|parts| parts.grids.clear());
    refused("no points", &|parts| parts.points.clear());
    refused("a point less", &|parts| parts.points.truncate(good.points.len() - 1));
    refused("points beyond the last", &|parts| parts.nets[0].first_point = u32::MAX);
    refused("other vertices than the grid's", &|parts| parts.draws[0].vertex_count += 1);
    refused("vertices beyond what a device holds", &|parts| parts.draws[0].first_vertex = u32::MAX);
    refused("no table", &|parts| parts.grids[0].tables.clear());
    for bytes in [1, 3, 4, 63, 64, 400, good.grids[0].tables.len() - 1] {
        refused(&format!("a table cut to {bytes} bytes"), &|parts| parts.grids[0].tables.truncate(bytes));
    }
    // Every number of the header but the flags, as small and as large as can be, a little more and a little less.
    for word in (0..11).filter(|word| *word != 3) {
        let old = good.word(word);
        for value in [0, u32::MAX, u32::MAX - 1, 1 << 31, old + 1, old - 1] {
            refused(&format!("{value} for {old} in word {word}"), &|parts| parts.set(word, value));
        }
    }
    refused("more rows than a workgroup holds", &|parts| {
        parts.set(4, 1);
        parts.set(10, 257);
    });
    for flags in [0, 6, 8, 16, u32::MAX] {
        refused(&format!("the flags {flags}"), &|parts| parts.set(3, flags));
    }
    for word in [16, good.word(7), good.word(8), good.word(9)].map(|word| word as usize) {
        refused("a control point that is not there", &|parts| parts.set(word + 1, 1000));
        refused("a number that is none", &|parts| parts.set(word, f32::NAN.to_bits()));
    }
    let vertices = [FlameVertex::default()];
    let twice = Frame { flame_vertices: &vertices, ..frame(&flames) };
    assert!(bench.prepare(&twice, &Camera::default(), &Look::default()).is_err(), "vertices beside nets");
}
