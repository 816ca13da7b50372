//! Fires that move, and their wicks: along a scene's motion, where the program puts them, and in boxes of air that go along.

use glam::{Quat, Vec3};
use lucerna::World;
use lucerna::flame::Pose;
use lucerna::flame::WickLook;
use lucerna::scene::{LoadedScene, Motion, MotionPath, Scene};

fn scene(name: &str) -> Scene {
    let mut scene = lucerna::scene::open(name).expect(name).scene;
    lucerna::scene::apply_preset(&mut scene, "draft").expect("draft");
    scene
}

fn world(scene: Scene) -> World {
    World::new(LoadedScene::from_scene(scene, "".as_ref()).expect("a scene")).expect("a world")
}

/// Mean of all flame vertices.
fn middle(world: &World) -> Vec3 {
    let vertices = world.frame().flame_vertices;
    vertices.iter().map(|v| Vec3::from(v.position)).sum::<Vec3>() / vertices.len() as f32
}

/// Kinetic energy to the side, in m^2/s^2 a cell.
fn sideways(world: &World) -> f32 {
    let fluid = world.fluid();
    let (low, size) = (fluid.origin(), fluid.size_m());
    let at = |i: usize| Vec3::new((i % 10) as f32, (i / 10 % 10) as f32, (i / 100) as f32) / 10.0 + 0.05;
    (0..1000).map(|i| fluid.velocity(low + at(i) * size).with_y(0.0).length_squared()).sum::<f32>() / 1000.0
}

#[test]
fn a_swung_torch_trails_behind_its_head_and_stirs_the_air() {
    let mut still = scene("torch_swung");
    still.motions[0].path = MotionPath::Still;
    let (mut swung, mut still) = (world(scene("torch_swung")), world(still));
    let (mut with, mut against) = (0.0, 0.0);
    for _ in 0..180 {
        let before = swung.pose(0).expect("a fire").point(Vec3::ZERO);
        swung.step(1.0 / 60.0).expect("a step");
        still.step(1.0 / 60.0).expect("a step");
        let head = swung.pose(0).expect("a fire").point(Vec3::ZERO);
        let speed = (head.x - before.x) * 60.0;
        // At rest the flame's middle is over the head.
        let behind = (head.x - middle(&swung).x) * speed.signum();
        if speed.abs() > 0.8 {
            with += behind;
            against += 1.0;
        }
    }
    let (behind, stirred) = (with / against, sideways(&swung) / sideways(&still));
    println!("{behind:.3} m behind a head that moves faster than 0.8 m/s; {stirred:.1} times the motion to the side");
    assert!(behind > 0.03 && stirred > 2.0, "{behind} {stirred}");
    // The mesh goes along, by its name; the wall does not.
    let (rest, now) = (&swung.scene().meshes, swung.frame().meshes);
    let pose = swung.pose(0).expect("a fire");
    for (rest, now) in rest[0].vertices.iter().zip(&now[0].vertices) {
        assert!(pose.point(rest.position.into()).distance(now.position.into()) < 1e-5);
    }
    assert_eq!(rest[1], now[1]);
}

#[test]
fn moving_fires_burn_to_the_same_bits_however_time_is_cut() {
    let run = |pieces: &[f32]| {
        let mut world = world(scene("torch_swung"));
        for dt in pieces {
            world.step(*dt).expect("a step");
        }
        world.state_hash()
    };
    let one = run(&[1.0 / 60.0; 12]);
    assert_eq!(one, run(&[3.0 / 60.0; 4]));
    let mut again = world(scene("torch_swung"));
    again.step(0.1).expect("a step");
    again.reset();
    for _ in 0..12 {
        again.step(1.0 / 60.0).expect("a step");
    }
    assert_eq!(one, again.state_hash(), "after a reset");
}

#[test]
fn a_fire_that_is_placed_is_there_after_the_next_step_with_its_meshes() {
    let mut scene = scene("torch");
    scene.motions.push(Motion { name: "hand".into(), path: MotionPath::Still });
    scene.fires[0].motion = Some("hand".into());
    scene.meshes[0].motion = Some("hand".into());
    let mut world = world(scene);
    let revision = world.frame().mesh_revision;
    let pose = Pose { rotation: Quat::from_rotation_y(0.5), translation: Vec3::new(0.05, 0.1, 0.02) };
    world.place(0, pose).expect("placed");
    let waiting = world.state_hash();
    world.step(3.0 / 60.0).expect("a step");
    assert_eq!((world.pose(0), world.flames().pose(4)), (Some(pose), pose));
    assert_ne!(world.frame().mesh_revision, revision);
    let (rest, now) = (world.scene().meshes[0].vertices[7], world.frame().meshes[0].vertices[7]);
    assert!(pose.point(rest.position.into()).distance(now.position.into()) < 1e-6);
    world.place(0, Pose::REST).expect("placed");
    assert_ne!(world.state_hash(), waiting);
    for bad in
        [Pose { translation: Vec3::NAN, ..Pose::REST }, Pose { rotation: Quat::from_xyzw(9.0, 0.0, 0.0, 0.0), ..pose }]
    {
        assert!(world.place(0, bad).is_err());
    }
    let error = world.place(3, pose).expect_err("no such fire").to_string();
    assert!(error.contains("no fire 3"), "{error}");
}

#[test]
fn a_box_of_air_goes_along_with_a_fire_that_is_carried_far() {
    let mut scene = scene("torch");
    scene.motions.push(Motion { name: "walk".into(), path: MotionPath::Still });
    scene.fires[0].motion = Some("walk".into());
    scene.air.follows = Some("walk".into());
    let mut world = world(scene);
    let rest = world.fluid().origin();
    for frame in 0..=120 {
        let translation = Vec3::new(0.5 * frame as f32 / 60.0, 0.0, 0.0);
        world.place(0, Pose { translation, ..Pose::REST }).expect("placed");
        world.step(1.0 / 60.0).expect("a step");
    }
    let (moved, flame) = (world.fluid().origin() - rest, middle(&world));
    println!("the box moved by {moved}, the flame is at {flame}");
    assert!((moved - Vec3::X).length() < 0.02);
    assert!(flame.x > 0.75 && flame.x < 1.0 && flame.y > 0.03, "it burns on, a little behind: {flame}");
    world.reset();
    assert_eq!(world.fluid().origin(), rest);
}

#[test]
fn wicks_are_drawn_where_they_are_shown_and_move_with_their_fire() {
    let mut scene = scene("candle");
    let meshes = scene.meshes.len();
    scene.fires[0].wick = WickLook::default();
    let hidden = world(scene.clone());
    assert_eq!(hidden.frame().meshes.len(), meshes);
    scene.fires[0].wick.shown = true;
    let shown = LoadedScene::from_scene(scene.clone(), "".as_ref()).expect("a scene");
    let mut world = World::new(shown.clone()).expect("a world");
    let tube = world.frame().meshes[meshes].clone();
    let top = tube.vertices.iter().max_by(|a, b| a.position[1].total_cmp(&b.position[1])).expect("vertices");
    println!("the wick's tip is at {} m and emits {:?}", top.position[1], top.emission);
    assert!(tube.vertices.iter().any(|v| v.emission[0] > 0.004) && (0.007..0.0095).contains(&top.position[1]));
    let way = Vec3::new(0.01, 0.0, 0.0);
    world.place(0, Pose { translation: way, ..Pose::REST }).expect("placed");
    world.step(1.0 / 60.0).expect("a step");
    let moved = world.frame().meshes[meshes].vertices[40].position;
    assert!((Vec3::from(moved) - Vec3::from(tube.vertices[40].position) - way).length() < 1e-6);
    // The glow goes out with the flame, and comes back with it.
    let glow = |world: &World| world.frame().meshes[meshes].vertices.iter().map(|v| v.emission[0]).fold(0.0, f32::max);
    world.extinguish(0).expect("a flame");
    world.step(1.0 / 60.0).expect("a step");
    assert_eq!(glow(&world), 0.0);
    world.ignite(0).expect("a flame");
    world.step(1.0 / 60.0).expect("a step");
    assert!(glow(&world) > 0.004);
    let revision = world.frame().mesh_revision;
    scene.fires[0].wick.shown = false;
    world.set_scene(LoadedScene::from_scene(scene, "".as_ref()).expect("a scene")).expect("taken over");
    assert_eq!(world.frame().meshes.len(), meshes);
    assert_ne!(world.frame().mesh_revision, revision);
    world.set_scene(shown).expect("taken over");
    assert_eq!(world.frame().meshes.len(), meshes + 1);
}
