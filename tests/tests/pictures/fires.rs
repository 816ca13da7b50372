//! Fires as they look: where they are, what is theirs in a picture, and what glow does with their light.

use crate::support::{
    Painter, SHADINGS, SIZE, extent, flames_alone, from_afar, largest_difference, linear, measuring, pixel,
};
use glam::{Vec2, Vec3};
use lucerna::World;
use lucerna::flame::WickShape;
use lucerna::frame::{DebugView, Frame, Look};
use lucerna::render::FireRenderer;
use lucerna_tests::{burning, luminance};
use wgpu::TextureFormat::{Rgba8Unorm, Rgba8UnormSrgb, Rgba16Float};

#[test]
fn flames_stand_over_their_wicks_in_their_own_colours() {
    let mut painter = Painter::new(Rgba8UnormSrgb);
    for name in lucerna_tests::small_scenes() {
        let world = burning(name, 2.0);
        let scene = &world.scene().scene;
        let wick = middle_of_wicks(&world);
        let root = pixel(&scene.camera, SIZE, wick);
        let tip = pixel(&scene.camera, SIZE, wick.with_y(extent(&world).1.y));
        for shading in SHADINGS {
            let look = Look { shading, ..scene.look.clone() };
            let opaque = Look { debug: DebugView::Opaque, ..look.clone() };
            let scene_alone = linear(&painter.bytes(SIZE, &world.frame(), &scene.camera, &opaque));
            let bytes = painter.bytes(SIZE, &world.frame(), &scene.camera, &look);
            let (picture, flames) = (linear(&bytes), painter.flames());
            let in_range = |[r, g, b, a]: [f32; 4]| [r, g, b].iter().all(|x| x.is_finite()) && (0.0..=1.0).contains(&a);
            assert!(flames.iter().copied().all(in_range), "{name} {shading:?}: radiance or cover");

            // What flames add to the scene: bright wax is no flame.
            let added: Vec<f32> =
                picture.iter().zip(&scene_alone).map(|(p, s)| luminance(*p) - luminance(*s)).collect();
            let most = added.iter().copied().fold(0.0, f32::max);
            assert!(most > 0.1, "{name} {shading:?}: flames add at most the luminance {most}");
            let bright: Vec<Vec2> = (0..added.len()).filter(|&i| added[i] > 0.5 * most).map(center_of).collect();
            assert!(bright.len() > 30, "{name} {shading:?}: a flame of {} pixels", bright.len());

            // Over the wick, below the tip of the highest flame, give or take a part of its height.
            let height = root.y - tip.y;
            let middle = bright.iter().sum::<Vec2>() / bright.len() as f32;
            let lowest = bright.iter().map(|at| at.y).fold(f32::MIN, f32::max);
            // Those that are swung, blown aside, or spread over many wicks stand elsewhere.
            if ["candle", "torch", "campfire"].contains(name) {
                assert!((middle.x - root.x).abs() < 0.2 * height, "{name} {shading:?}: {middle} over {root}");
                assert!(tip.y < middle.y && middle.y < root.y, "{name} {shading:?}: {middle} between {tip} and {root}");
                assert!((lowest - root.y).abs() < 0.3 * height, "{name} {shading:?}: starts at {lowest}, not {root}");
            }

            // Burnt out to white is a lamp, not a flame.
            let burns = |i: &usize| flames[*i][0] > 0.0 && luminance(picture[*i]) > 0.35;
            let flame: Vec<usize> = (0..picture.len()).filter(burns).collect();
            let white = flame.iter().filter(|&&i| bytes[4 * i..][..3].iter().all(|&channel| channel >= 247)).count();
            assert!(5 * white <= flame.len(), "{name} {shading:?}: {white} of {} pixels are white", flame.len());
        }
    }
}

fn middle_of_wicks(world: &World) -> Vec3 {
    let points = |shape: &WickShape| match shape {
        WickShape::Polyline { points, .. } | WickShape::Vertices(points) => points.clone(),
    };
    let points: Vec<Vec3> = world.scene().wicks.iter().flatten().flat_map(points).map(Vec3::from).collect();
    points.iter().sum::<Vec3>() / points.len() as f32
}

/// The middle of a pixel of a picture of [`SIZE`].
fn center_of(index: usize) -> Vec2 {
    let width = SIZE[0] as usize;
    Vec2::new((index % width) as f32 + 0.5, (index / width) as f32 + 0.5)
}

#[test]
fn the_opaque_view_is_the_scene_lit_by_its_flames_but_without_them() {
    let mut painter = Painter::new(Rgba8UnormSrgb);
    for name in lucerna_tests::small_scenes() {
        let world = burning(name, 1.0);
        let scene = &world.scene().scene;
        let without =
            Frame { flame_vertices: &[], flame_indices: &[], flame_draws: &[], flame_shades: &[], ..world.frame() };
        let expected = painter.bytes(SIZE, &without, &scene.camera, &scene.look);
        assert!(linear(&expected).into_iter().map(luminance).any(|y| y > 0.02), "{name}: no light falls on the scene");
        let look = Look { debug: DebugView::Opaque, ..scene.look.clone() };
        let opaque = painter.bytes(SIZE, &world.frame(), &scene.camera, &look);
        assert!(largest_difference(&opaque, &expected) <= 1, "{name}");
        let burns = painter.bytes(SIZE, &world.frame(), &scene.camera, &scene.look);
        assert!(largest_difference(&burns, &expected) > 50, "{name}: no flame was left out");
    }
}

#[test]
fn the_same_frame_is_the_same_picture() {
    let (world, mut painter) = (burning("torch", 1.0), Painter::new(Rgba8UnormSrgb));
    let scene = &world.scene().scene;
    for shading in SHADINGS {
        let look = Look { shading, ..scene.look.clone() };
        let first = painter.bytes(SIZE, &world.frame(), &scene.camera, &look);
        assert!(painter.bytes(SIZE, &world.frame(), &scene.camera, &look) == first, "{shading:?}: drawn again");
        // Sizes that the reduced copies of the flames do not divide, one of a single pixel, and other looks.
        let sizes = [[161, 47], [160, 90], [1, 1], [250, 128]].map(|size| (size, look.clone()));
        let fewer_layers = Look { layers: 2, ..look.clone() };
        let hard_edges = Look { samples: 1, ..look.clone() };
        let sharp = Look { glow: Vec::new(), ..look.clone() };
        for (size, other) in sizes.into_iter().chain([fewer_layers, hard_edges, sharp].map(|look| (SIZE, look))) {
            let between = painter.bytes(size, &world.frame(), &scene.camera, &other);
            painter.renderer = FireRenderer::new(&painter.device, &painter.queue, painter.format);
            let by_a_new_one = painter.bytes(size, &world.frame(), &scene.camera, &other);
            assert!(between == by_a_new_one, "{shading:?}: {size:?} and {other:?} after another picture");
            assert!(painter.bytes(SIZE, &world.frame(), &scene.camera, &look) == first, "{shading:?}: after {size:?}");
        }
        let mut another = Painter::new(Rgba8UnormSrgb);
        assert!(another.bytes(SIZE, &world.frame(), &scene.camera, &look) == first, "{shading:?}: on another device");
    }
}

#[test]
fn one_renderer_draws_several_worlds() {
    let mut painter = Painter::new(Rgba8UnormSrgb);
    let worlds = ["candle", "torch", "candle"].map(|name| burning(name, 0.2));
    for world in &worlds {
        let scene = &world.scene().scene;
        let next = painter.bytes(SIZE, &world.frame(), &scene.camera, &scene.look);
        painter.renderer = FireRenderer::new(&painter.device, &painter.queue, painter.format);
        let first = painter.bytes(SIZE, &world.frame(), &scene.camera, &scene.look);
        assert!(next == first, "the {} is drawn with what belongs to another world", scene.name);
    }
}

#[test]
fn targets_that_encode_and_targets_that_do_not_show_the_same_colours() {
    let world = burning("candle", 1.0);
    let scene = &world.scene().scene;
    let [encoding, plain] = [Rgba8UnormSrgb, Rgba8Unorm]
        .map(|format| Painter::new(format).bytes(SIZE, &world.frame(), &scene.camera, &scene.look));
    assert!(largest_difference(&encoding, &plain) <= 2, "{}", largest_difference(&encoding, &plain));
}

#[test]
fn glow_spreads_light_and_keeps_its_sum() {
    let mut painter = Painter::new(Rgba16Float);
    for name in ["candle", "torch"] {
        let world = burning(name, 1.0);
        let camera = from_afar(&world);
        for shading in SHADINGS {
            let look = measuring(&world, shading);
            let mut sum = |debug: DebugView| {
                let picture = painter.light(SIZE, &flames_alone(&world), &camera, &Look { debug, ..look.clone() });
                [0, 1, 2].map(|channel| picture.iter().map(|texel| f64::from(texel[channel])).sum::<f64>())
            };
            let sharp = sum(DebugView::Flames);
            // The levels' gains add to one, so the finished picture keeps the sum, too.
            assert!((look.glow.iter().map(|level| level.gain).sum::<f32>() - 1.0).abs() < 1e-3);
            let levels = (0..look.glow.len() as u32).map(DebugView::Glow).chain([DebugView::Final]);
            for view in levels {
                let blurred = sum(view);
                for channel in 0..3 {
                    let kept = blurred[channel] / sharp[channel];
                    assert!((kept - 1.0).abs() < 0.01, "{name} {shading:?} {view:?}: channel {channel} has {kept}");
                }
            }
        }
    }
}
