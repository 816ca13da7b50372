//! Worlds that are saved and go on elsewhere.

use lucerna::flame::Pose;
use lucerna::scene::LoadedScene;
use lucerna::{SaveError, World};

const STEP_S: f32 = 1.0 / 60.0;

fn scene(name: &str) -> LoadedScene {
    let mut loaded = lucerna::scene::open(name).expect(name);
    loaded.scene.air.cells = loaded.scene.air.cells.map(|n| n.min(16));
    for fire in &mut loaded.scene.fires {
        // A few of each: enough for several boxes in a batch.
        fire.at.truncate(5);
        fire.turns_deg.truncate(5);
    }
    loaded
}

fn world(name: &str) -> World {
    World::new(scene(name)).expect(name)
}

fn step(world: &mut World, steps: usize) {
    (0..steps).for_each(|_| assert!(world.step(STEP_S).is_ok()));
}

#[test]
fn a_world_that_was_saved_goes_on_as_if_it_had_never_been_stopped() {
    for name in lucerna::scene::builtin_names() {
        let mut world = world(name);
        step(&mut world, 40);
        // Half a step is owed.
        world.step(0.5 * STEP_S).expect(name);
        let bytes = world.save();
        let mut again = World::new(scene(name)).expect(name);
        step(&mut again, 7);
        again.restore(&bytes).expect(name);
        println!("{name}: {} kB", bytes.len() / 1000);
        assert_eq!(again.save(), bytes, "{name}");
        for _ in 0..30 {
            assert_eq!(again.state_hash(), world.state_hash(), "{name} at {} s", world.time_s());
            assert!(again.frame().flame_vertices == world.frame().flame_vertices, "{name} at {} s", world.time_s());
            assert!(again.frame().lights == world.frame().lights, "{name} at {} s", world.time_s());
            step(&mut world, 1);
            step(&mut again, 1);
        }
    }
}

#[test]
fn what_is_carried_and_what_is_out_stays_so() {
    let mut world = world("torch");
    world.place(0, Pose { translation: [0.05, 0.0, 0.02].into(), ..Pose::REST }).expect("placed");
    step(&mut world, 3);
    world.extinguish(1).expect("extinguished");
    step(&mut world, 20);
    let mut again = self::world("torch");
    again.restore(&world.save()).expect("restored");
    assert!(!again.flames().is_lit(1) && again.flames().is_lit(0));
    step(&mut world, 20);
    step(&mut again, 20);
    assert_eq!((again.state_hash(), again.pose(0)), (world.state_hash(), world.pose(0)));
}

#[test]
fn what_is_not_a_saved_world_of_this_scene_is_refused_and_changes_nothing() {
    let mut world = world("candle");
    step(&mut world, 20);
    let (bytes, before) = (world.save(), world.state_hash());
    let mut refused = |bytes: &[u8]| {
        let error = world.restore(bytes).expect_err("it is damaged");
        assert_eq!(world.state_hash(), before, "{error}");
        error
    };
    assert!(matches!(refused(b""), SaveError::NotASave));
    assert!(matches!(refused(b"LUCWORLD and then"), SaveError::NotASave));
    assert!(matches!(refused(&bytes[1..]), SaveError::NotASave));
    let mut other = bytes.clone();
    other[8] = 9;
    assert!(matches!(refused(&other), SaveError::Version { found: 9 }));
    for at in (20..bytes.len()).step_by(bytes.len() / 97) {
        let mut other = bytes.clone();
        other[at] ^= 0x10;
        assert!(matches!(refused(&other), SaveError::Checksum), "byte {at}");
        assert!(matches!(refused(&bytes[..at]), SaveError::Checksum), "cut at {at}");
    }
    assert!(matches!(refused(&self::world("torch").save()), SaveError::Scene));
}

/// The checksum does not keep out what was made to pass it.
#[test]
fn bytes_that_pass_the_checksum_never_make_it_panic() {
    let mut world = world("torch");
    step(&mut world, 20);
    let bytes = world.save();
    let fnv = |bytes: &[u8]| {
        bytes.iter().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3))
    };
    let (mut taken, mut refused, mut random) = (0, 0, 1_u64);
    for _ in 0..300 {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mut other = bytes.clone();
        // Flames come last, and are the smaller part.
        let at = if random & 1 == 0 { 28 } else { bytes.len() * 9 / 10 };
        let at = at + (random >> 33) as usize % (bytes.len() - at);
        other[at] = (random >> 20) as u8;
        let hash = fnv(&other[20..]);
        other[12..20].copy_from_slice(&hash.to_le_bytes());
        match world.restore(&other) {
            Ok(()) => {
                taken += 1;
                step(&mut world, 1);
                assert!(world.frame().flame_vertices.iter().all(|v| v.position.iter().all(|x| x.is_finite())));
            }
            Err(_) => refused += 1,
        }
    }
    println!("{taken} taken, {refused} refused");
    assert!(taken > 0 && refused > 0);
}
