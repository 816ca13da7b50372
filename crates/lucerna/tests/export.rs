//! Flames that are exported are read again by other libraries, and are the world's.

use lucerna::World;
use lucerna::export::{ExportError, GlbSequence, LightTable, write_nets, write_obj};
use lucerna::flame::Surfaces;
use lucerna::frame::{FlameDraw, FlameVertex, Frame, unit_luminance_cd_m2};
use lucerna_nurbs::{GridOptions, GridPlan, KnotVector};
use serde_json::Value;

/// A torch in coarse air, of which tips have broken away.
fn world() -> World {
    let mut loaded = lucerna::scene::open("torch").expect("torch");
    loaded.scene.air.cells = [12, 16, 12];
    let mut world = World::new(loaded).expect("a world");
    for _ in 0..120 {
        world.step(1.0 / 60.0).expect("step");
        if world.flames().control_nets().any(|net| net.is_free) {
            break;
        }
    }
    world
}

/// The vertices and indices of one flame.
fn mesh<'a>(frame: &Frame<'a>, draw: &FlameDraw) -> (&'a [FlameVertex], &'a [u32]) {
    (
        &frame.flame_vertices[draw.first_vertex as usize..][..draw.vertex_count as usize],
        &frame.flame_indices[draw.first_index as usize..][..draw.index_count as usize],
    )
}

#[test]
fn an_obj_holds_the_vertices_of_every_flame_in_a_group() {
    let world = world();
    let mut obj = Vec::new();
    write_obj(&world.frame(), &mut obj).expect("an OBJ");
    let options = tobj::LoadOptions { single_index: true, ..Default::default() };
    let none = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut obj.as_slice(), &options, none).expect("tobj reads it");
    let frame = world.frame();
    println!("{} flames in {} bytes", models.len(), obj.len());
    assert_eq!(models.len(), frame.flame_draws.len());
    for (number, (model, draw)) in models.iter().zip(frame.flame_draws).enumerate() {
        assert_eq!(model.name, format!("flame_{number}"));
        let (vertices, indices) = mesh(&frame, draw);
        assert_eq!(model.mesh.indices.len(), indices.len());
        // tobj numbers vertices as faces first name them.
        for (&read, &index) in model.mesh.indices.iter().zip(indices) {
            let (read, vertex) = (read as usize, &vertices[index as usize]);
            assert_eq!(model.mesh.positions[3 * read..][..3], vertex.position);
            assert_eq!(model.mesh.normals[3 * read..][..3], vertex.normal);
            assert_eq!(model.mesh.texcoords[2 * read..][..2], vertex.uv);
        }
    }
}

#[test]
fn a_gltf_shows_every_frame_in_its_turn() {
    let mut world = world();
    let (fps, mut sequence) = (20.0, GlbSequence::new(20.0).expect("a sequence"));
    let mut frames = Vec::new();
    for _ in 0..3 {
        world.step(0.05).expect("step");
        let frame = world.frame();
        sequence.push(&frame).expect("a frame");
        let flames = frame.flame_draws.iter().map(|draw| {
            let (vertices, indices) = mesh(&frame, draw);
            (vertices.to_vec(), indices.to_vec())
        });
        frames.push(flames.collect::<Vec<_>>());
    }
    let mut glb = Vec::new();
    sequence.finish(&mut glb).expect("a glTF");
    // Reading validates it as well.
    let (document, buffers, _) = gltf::import_slice(&glb).expect("gltf reads it");
    println!("{} frames in {} bytes, {} accessors", frames.len(), glb.len(), document.accessors().len());
    assert_eq!(document.default_scene().expect("a scene").nodes().len(), frames.len());
    for (node, flames) in document.nodes().zip(&frames) {
        let mesh = node.mesh().expect("a mesh");
        assert_eq!(mesh.primitives().len(), flames.len());
        for (primitive, (vertices, indices)) in mesh.primitives().zip(flames) {
            let reader = primitive.reader(|buffer| Some(&buffers[buffer.index()]));
            let positions: Vec<_> = reader.read_positions().expect("positions").collect();
            assert!(positions.iter().copied().eq(vertices.iter().map(|v| v.position)));
            assert!(reader.read_normals().expect("normals").eq(vertices.iter().map(|v| v.normal)));
            let uv = reader.read_tex_coords(0).expect("texture coordinates").into_f32();
            assert!(uv.eq(vertices.iter().map(|v| [v.uv[0], 1.0 - v.uv[1]])));
            assert!(reader.read_indices().expect("indices").into_u32().eq(indices.iter().copied()));
            let bounds = primitive.bounding_box();
            for axis in 0..3 {
                let all = positions.iter().map(|p| p[axis]);
                assert_eq!(all.clone().fold(f32::INFINITY, f32::min), bounds.min[axis]);
                assert_eq!(all.fold(f32::NEG_INFINITY, f32::max), bounds.max[axis]);
            }
            let [red, green, blue] = primitive.material().emissive_factor();
            assert!(red == 1.0 && red > green && green > blue, "soot glows orange: {red} {green} {blue}");
        }
    }
    // In the middle of each frame it alone is seen.
    let animation = document.animations().next().expect("an animation");
    for now in 0..frames.len() {
        let time_s = ((now as f64 + 0.5) / fps) as f32;
        let seen: Vec<bool> = animation
            .channels()
            .map(|channel| {
                let reader = channel.reader(|buffer| Some(&buffers[buffer.index()]));
                let times: Vec<f32> = reader.read_inputs().expect("times").collect();
                assert!(times[0] == 0.0 && times.is_sorted_by(|a, b| a < b), "{times:?}");
                let Some(gltf::animation::util::ReadOutputs::Scales(scales)) = reader.read_outputs() else {
                    panic!("a scale is animated");
                };
                let scales: Vec<_> = scales.collect();
                assert_eq!(scales.len(), times.len());
                scales[times.partition_point(|&t| t <= time_s) - 1] == [1.0; 3]
            })
            .collect();
        assert_eq!(seen, (0..frames.len()).map(|frame| frame == now).collect::<Vec<_>>());
    }
}

#[test]
fn control_nets_make_the_exported_vertices_again() {
    let world = world();
    let mut json = Vec::new();
    write_nets(world.flames(), &mut json).expect("JSON");
    let moment: Value = serde_json::from_slice(&json).expect("serde_json reads it");
    assert_eq!(moment["time_s"], world.time_s());
    let frame = world.frame();
    let nets = moment["nets"].as_array().expect("nets");
    assert_eq!(nets.len(), frame.flame_draws.len());
    let (mut free, mut made) = (0, 0);
    for (number, (net, draw)) in nets.iter().zip(frame.flame_draws).enumerate() {
        let read = |name: &str| net[name].clone();
        let knots_u: KnotVector<f32> = serde_json::from_value(read("knots_u")).expect("knots");
        let knots_v: KnotVector<f32> = serde_json::from_value(read("knots_v")).expect("knots");
        let grid: GridOptions = serde_json::from_value(read("grid")).expect("a grid");
        let points: Vec<[f32; 3]> = serde_json::from_value(read("points")).expect("points");
        let (rows, columns) = (net["rows"].as_u64().expect("rows"), net["columns"].as_u64().expect("columns"));
        assert_eq!((net["flame"].as_u64(), rows * columns), (Some(number as u64), points.len() as u64));
        assert_eq!((knots_u.count() - knots_u.degree(), knots_v.count()), (rows as usize, columns as usize));
        free += usize::from(net["free"].as_bool().expect("free"));

        let plan = GridPlan::new(&knots_u, &knots_v, grid).expect("a plan");
        let (vertices, indices) = mesh(&frame, draw);
        assert_eq!((plan.vertex_count(), plan.indices()), (vertices.len(), indices));
        plan.evaluate(&points, None, &mut plan.scratch(), |i, vertex| {
            assert_eq!((vertex.position, vertex.normal), (vertices[i].position, vertices[i].normal));
            made += 1;
        })
        .expect("vertices");
    }
    println!("{made} vertices of {} flames, {free} of them free, in {} bytes", nets.len(), json.len());
    assert!(free > 0, "no tip has broken away");
}

#[test]
fn the_table_of_lights_holds_those_of_the_renderer_in_candela() {
    let mut world = world();
    let mut csv = Vec::new();
    let mut table = LightTable::new(&mut csv).expect("a table");
    let mut lights = Vec::new();
    for _ in 0..2 {
        world.step(0.05).expect("step");
        table.push(world.flames()).expect("lights");
        lights.extend(world.frame().lights.iter().map(|light| (world.time_s(), *light)));
    }
    table.finish().expect("the end");
    let text = String::from_utf8(csv).expect("text");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time_s,group,part,x_m,y_m,z_m,radius_m,intensity_cd,red,green,blue"));
    let rows: Vec<Vec<f32>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), lights.len());
    for (row, (time_s, light)) in rows.iter().zip(&lights) {
        let &[time, _, part, x, y, z, radius, candela, red, green, blue] = row.as_slice() else {
            panic!("eleven columns: {row:?}");
        };
        assert!((f64::from(time) - time_s).abs() < 1e-5 && part < 3.0);
        assert_eq!(([x, y, z], radius), (light.position, light.radius_m));
        for (channel, sent) in [red, green, blue].into_iter().zip(light.intensity) {
            let again = channel * candela / unit_luminance_cd_m2();
            assert!((again - sent).abs() <= 1e-5 * light.intensity[0], "{again} {sent}");
        }
        assert!((0.2126 * red + 0.7152 * green + 0.0722 * blue - 1.0).abs() < 1e-3);
    }
    // A group's parts follow from root to tip.
    assert!(rows.windows(2).all(|w| w[0][..2] != w[1][..2] || w[0][2] < w[1][2]));
}

#[test]
fn a_candle_is_about_as_bright_as_a_candle() {
    let mut world = World::new(lucerna::scene::open("candle").expect("candle")).expect("a world");
    for _ in 0..60 {
        world.step(1.0 / 60.0).expect("step");
    }
    let mut csv = Vec::new();
    LightTable::new(&mut csv).expect("a table").push(world.flames()).expect("lights");
    let text = String::from_utf8(csv).expect("text");
    let candela: f32 =
        text.lines().skip(1).map(|line| line.split(',').nth(7).expect("a cell").parse::<f32>().expect("candela")).sum();
    println!("{candela} cd");
    assert!((0.2..5.0).contains(&candela), "{candela}");
}

#[test]
fn frames_that_no_file_can_hold_are_refused_by_name() {
    let world = world();
    let good = world.frame();
    let mut vertices = good.flame_vertices.to_vec();
    vertices[7].normal[1] = f32::NAN;
    let mut indices = good.flame_indices.to_vec();
    indices[4] = 1_000_000;
    let draw = good.flame_draws[0];
    let beyond = [FlameDraw { vertex_count: u32::MAX, ..draw }];
    let no_triangles = [FlameDraw { first_index: u32::MAX, ..draw }];
    let cut = [FlameDraw { index_count: draw.index_count - 1, ..draw }];
    for (frame, part) in [
        (Frame { flame_vertices: &vertices, ..good }, "flame_vertices[7].normal"),
        (Frame { flame_indices: &indices, ..good }, "flame_draws[0] is 1000000: must be below its vertex_count"),
        (Frame { flame_draws: &beyond, ..good }, "inside flame_vertices"),
        (Frame { flame_draws: &no_triangles, ..good }, "inside flame_indices"),
        (Frame { flame_draws: &cut, ..good }, "flame_draws[0].index_count"),
    ] {
        let mut written = Vec::new();
        let error = write_obj(&frame, &mut written).expect_err(part).to_string();
        assert!(error.contains(part) && written.is_empty(), "{error}");
        let mut sequence = GlbSequence::new(30.0).expect("a sequence");
        assert_eq!(sequence.push(&frame).expect_err(part).to_string(), error);
        assert!(sequence.finish(Vec::new()).expect_err("no frames").to_string().contains("number of frames is 0"));
    }
    for fps in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(GlbSequence::new(fps).expect_err("no rate").to_string().starts_with("fps is "));
    }
    let mut world = world;
    world.set_surfaces(Surfaces::Nets);
    let error = write_obj(&world.frame(), Vec::new()).expect_err("nets").to_string();
    assert!(error.contains("flame_nets") && error.contains("Surfaces::Vertices"), "{error}");
    assert!(matches!(write_nets(world.flames(), &mut [0; 9][..]), Err(ExportError::Write(_))));
}

#[test]
fn a_frame_without_flames_is_a_frame() {
    let mut sequence = GlbSequence::new(30.0).expect("a sequence");
    sequence.push(&Frame::default()).expect("nothing");
    sequence.push(&world().frame()).expect("a fire");
    let mut glb = Vec::new();
    sequence.finish(&mut glb).expect("a glTF");
    let (document, ..) = gltf::import_slice(&glb).expect("gltf reads it");
    assert_eq!((document.nodes().len(), document.meshes().len()), (2, 1));
}
