//! Fires among other things: an eye inside of a flame, a wick in its middle, a picture that it is drawn over.

use crate::support::{Painter, SHADINGS, SIZE, extent, flames_alone, from_afar, largest_rgb_difference, measuring};
use glam::{Vec2, Vec3};
use lucerna::frame::{Camera, DebugView, Frame, Look, MeshVertex, OpaqueMesh};
use lucerna_tests::{burning, luminance};
use wgpu::TextureFormat::{Depth32Float, Rgba8UnormSrgb, Rgba16Float};

#[test]
fn an_eye_inside_a_flame_sees_fire() {
    let (world, mut painter) = (burning("torch", 2.0), Painter::new(Rgba16Float));
    let frame = world.frame();
    let eye = a_point_inside(&frame);
    for shading in SHADINGS {
        let look = Look { shading, ..world.scene().scene.look.clone() };
        for (target, near_m) in [(Vec3::NEG_Z, 0.001), (Vec3::Y, 0.001), (Vec3::X, 0.01)] {
            let target = (eye + target).to_array();
            let camera = Camera { eye: eye.to_array(), target, fov_y_deg: 60.0, near_m, far_m: 20.0 };
            let picture = painter.light(SIZE, &frame, &camera, &look);
            assert!(picture.iter().flatten().all(|x| x.is_finite()), "{shading:?} towards {target:?}");
            let lit = painter.flames().iter().filter(|texel| texel[0] > 0.0).count();
            let mean = picture.iter().map(|[r, g, b, _]| luminance([*r, *g, *b])).sum::<f32>() / picture.len() as f32;
            assert!(lit > picture.len() * 3 / 4, "{shading:?} towards {target:?}: {lit} pixels of flame");
            assert!(mean > 0.2, "{shading:?} towards {target:?}: mean luminance {mean}");
        }
    }
}

/// A point within the first flame, from its lower half: lines in any direction leave it once more than they enter.
fn a_point_inside(frame: &Frame<'_>) -> Vec3 {
    let draw = frame.flame_draws[0];
    let vertices = &frame.flame_vertices[draw.first_vertex as usize..][..draw.vertex_count as usize];
    let triangles = frame.flame_indices[draw.first_index as usize..][..draw.index_count as usize].chunks_exact(3);
    let triangles: Vec<[Vec3; 3]> =
        triangles.map(|t| [0, 1, 2].map(|i: usize| Vec3::from(vertices[t[i] as usize].position))).collect();
    let crossings = |from: Vec3, direction: Vec3| {
        let (u, v) = direction.any_orthonormal_pair();
        let flat = |p: Vec3| Vec2::new((p - from).dot(u), (p - from).dot(v));
        let crossed = |t: &&[Vec3; 3]| {
            let [a, b, c] = t.map(flat);
            let sides = [a.perp_dot(b), b.perp_dot(c), c.perp_dot(a)];
            let normal = (t[1] - t[0]).cross(t[2] - t[0]);
            let ahead = (t[0] - from).dot(normal) * direction.dot(normal) > 0.0;
            ahead && (sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0))
        };
        triangles.iter().filter(crossed).count()
    };
    let directions = [Vec3::new(0.9, 0.1, 0.4), Vec3::new(-0.3, 0.2, -0.9), Vec3::new(0.2, -0.1, 0.9)];
    let mut middles = vertices
        .chunk_by(|a, b| a.height.to_bits() == b.height.to_bits())
        .map(|ring| (ring[0].height, ring.iter().map(|v| Vec3::from(v.position)).sum::<Vec3>() / ring.len() as f32));
    let inside = |p: Vec3| directions.iter().all(|d| crossings(p, d.normalize()) % 2 == 1);
    middles.find(|(height, p)| (0.2..0.5).contains(height) && inside(*p)).expect("a ring around the flame").1
}

#[test]
fn a_wick_inside_a_flame_hides_what_is_behind_it_and_nothing_beside_it() {
    let (world, mut painter) = (burning("candle", 1.0), Painter::new(Rgba8UnormSrgb));
    let (low, high) = extent(&world);
    let (height, middle) = (high.y - low.y, (low + high) / 2.0);
    let half = 0.03 * height;
    let wick = [post(
        Vec3::new(middle.x - half, low.y, middle.z - half),
        Vec3::new(middle.x + half, middle.y, middle.z + half),
    )];
    let camera = Camera {
        eye: (middle + Vec3::Z * 4.0 * height).to_array(),
        target: middle.to_array(),
        fov_y_deg: 16.0,
        near_m: 0.1 * height,
        far_m: 100.0 * height,
    };
    let bare = flames_alone(&world);
    let with_wick = Frame { meshes: &wick, mesh_revision: 0, ..bare };
    for shading in SHADINGS {
        let look = measuring(&world, shading);
        painter.paint(SIZE, &bare, &camera, &look);
        let whole = painter.flames();
        painter.paint(SIZE, &with_wick, &camera, &look);
        let cut = painter.flames();
        let opaque = painter.bytes(SIZE, &with_wick, &camera, &Look { debug: DebugView::Opaque, ..look });
        let covered: Vec<bool> = opaque.chunks_exact(4).map(|texel| texel[1] > 128).collect();
        assert!(covered.iter().filter(|c| **c).count() > 50, "the wick is not in the picture");

        let light = |texel: [f32; 4]| luminance([texel[0], texel[1], texel[2]]);
        let most = whole.iter().copied().map(light).fold(0.0, f32::max);
        let (mut beside, mut before, mut behind) = (0, 0.0, 0.0);
        for i in 0..whole.len() {
            if !covered[i] {
                assert_eq!(
                    cut[i].map(f32::to_bits),
                    whole[i].map(f32::to_bits),
                    "{shading:?}: pixel {i} beside the wick"
                );
                let near = |by: usize| covered[i - by] || covered[i + by];
                beside += usize::from(
                    (1..=4).any(|by| i >= by && i + by < covered.len() && near(by)) && light(whole[i]) > 0.2 * most,
                );
            } else {
                // Where soot begins within the interval, its opacity may round to the next half float.
                let quantum = (-24.0_f32).exp2();
                assert!(
                    light(cut[i]) <= light(whole[i]) && cut[i][3] <= whole[i][3] + quantum,
                    "{shading:?}: pixel {i} of the wick"
                );
                before += light(cut[i]);
                behind += light(whole[i]) - light(cut[i]);
            }
        }
        assert!(beside > 20, "{shading:?}: no flame beside the wick");
        // It stands in the middle of the flame: about half of the light comes from before it.
        assert!((0.3..0.7).contains(&(before / (before + behind))), "{shading:?}: {before} of {}", before + behind);
    }
}

/// A post that glows green, so that a picture shows where it is.
fn post(low: Vec3, high: Vec3) -> OpaqueMesh {
    let corner = |i: usize| Vec3::from([0, 1, 2].map(|axis| if i >> axis & 1 == 1 { high[axis] } else { low[axis] }));
    let vertex = |i: usize, normal: Vec3| MeshVertex {
        position: corner(i).to_array(),
        normal: normal.to_array(),
        emission: [0.0, 1.0, 0.0],
        ..Default::default()
    };
    let mut mesh = OpaqueMesh::default();
    for (normal, corners) in [
        (Vec3::NEG_X, [0, 4, 6, 2]),
        (Vec3::X, [1, 3, 7, 5]),
        (Vec3::NEG_Y, [0, 1, 5, 4]),
        (Vec3::Y, [2, 6, 7, 3]),
        (Vec3::NEG_Z, [0, 2, 3, 1]),
        (Vec3::Z, [4, 5, 7, 6]),
    ] {
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend(corners.map(|i| vertex(i, normal)));
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
    }
    mesh
}

#[test]
fn over_a_picture_that_is_there_only_the_flames_are_added() {
    let (world, mut painter) = (burning("torch", 1.0), Painter::new(Rgba8UnormSrgb));
    let camera = world.scene().scene.camera;
    for shading in SHADINGS {
        let look = Look { background: [0.0; 3], shading, ..world.scene().scene.look.clone() };
        painter.renderer.set_scene_depth(None);
        let expected = painter.bytes(SIZE, &flames_alone(&world), &camera, &look);

        let far = depth(&painter, SIZE, 1.0);
        painter.renderer.set_scene_depth(Some(&far));
        let over = painter.bytes(SIZE, &world.frame(), &camera, &look);
        let difference = largest_rgb_difference(&over, &expected);
        assert!(difference <= 2, "{shading:?}: {difference}");

        // A wall right before the eye.
        let near = depth(&painter, SIZE, 0.0);
        painter.renderer.set_scene_depth(Some(&near));
        let hidden = painter.bytes(SIZE, &world.frame(), &camera, &look);
        assert!(hidden.chunks_exact(4).all(|texel| texel[..3] == [0; 3]), "{shading:?}: a flame shines through a wall");
    }
}

#[test]
fn a_depth_that_is_there_cuts_flames_as_a_mesh_does() {
    let (world, mut painter) = (burning("torch", 1.0), Painter::new(Rgba8UnormSrgb));
    let camera = from_afar(&world);
    // A wall across the middle of the fire.
    let frame = world.frame();
    let z = frame.flame_vertices.iter().map(|v| v.position[2]).sum::<f32>() / frame.flame_vertices.len() as f32;
    let corners = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]];
    let corner = |[x, y]: [f32; 2]| MeshVertex { position: [x, y, z], normal: [0.0, 0.0, 1.0], ..Default::default() };
    let wall = [OpaqueMesh { vertices: corners.map(corner).to_vec(), indices: vec![0, 1, 2, 0, 2, 3] }];
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    let at = camera.clip_from_view(aspect).project_point3(Vec3::new(0.0, 0.0, z - camera.eye[2])).z;
    for shading in SHADINGS {
        let look = measuring(&world, shading);
        painter.renderer.set_scene_depth(None);
        let light = |flames: &[[f32; 4]]| flames.iter().map(|[r, g, b, _]| luminance([*r, *g, *b])).sum::<f32>();
        painter.paint(SIZE, &flames_alone(&world), &camera, &look);
        let whole = light(&painter.flames());
        painter.paint(SIZE, &Frame { meshes: &wall, mesh_revision: 0, ..world.frame() }, &camera, &look);
        let by_mesh = light(&painter.flames());
        let depth = depth(&painter, SIZE, at);
        painter.renderer.set_scene_depth(Some(&depth));
        painter.paint(SIZE, &flames_alone(&world), &camera, &look);
        let by_depth = light(&painter.flames());
        assert!((0.2..0.8).contains(&(by_mesh / whole)), "{shading:?}: {by_mesh} of {whole} is before the wall");
        assert!((by_depth / by_mesh - 1.0).abs() < 0.01, "{shading:?}: {by_depth}, not {by_mesh}");
    }
}

/// A depth buffer that has the same value everywhere.
fn depth(painter: &Painter, [width, height]: [u32; 2], value: f32) -> wgpu::TextureView {
    let texture = painter.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("the caller's depth"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: Depth32Float,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = painter.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(value), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    painter.queue.submit([encoder.finish()]);
    view
}
