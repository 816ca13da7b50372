//! Saving and loading: the same bits as without, and nothing that is read does harm.

use lucerna_fluid::{
    Advection, Combustion, Couple, Density, Fluid, FluidBuilder, FluidError, Fuel, Obstacle, PressureSolver, Shape,
    Side, SideAt, Sides, Snapshot, SnapshotError, Source, Vec3,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::support::{Random, random_velocity};

fn everything() -> FluidBuilder {
    Fluid::builder([9, 7, 8])
        .size_m(Vec3::new(0.4, 0.3, 0.35))
        .origin(Vec3::new(-3.0, 1.0, 2.0))
        .sides(Sides { x: [Side::Inflow, Side::Open], y: [Side::NoSlip, Side::Open], z: [Side::FreeSlip; 2] })
        .wind(Vec3::new(0.4, 0.1, -0.2))
        .viscosity_m2_s(1.0e-3)
        .vorticity_confinement(2.0)
        .cooling_per_s(0.3)
        .thermal_diffusivity_m2_s(1.0e-4)
        .cfl_limit(Some(0.5))
        .scalar("soot")
        .scalar_with_outside("oxygen", 0.23)
}

/// One step's sources, the same for the same number.
fn add_sources(step: u64, fluid: &mut Fluid) {
    let mut random = Random(step);
    let point = fluid.origin() + fluid.size_m() * Vec3::new(random.next(), 0.2, random.next());
    fluid.add_heat(point, 0.1, 3000.0).unwrap();
    fluid.add_acceleration(point, random.vector(50.0)).unwrap();
    fluid.add_expansion(point, 0.1, 2.0).unwrap();
    if let Some(soot) = fluid.scalar_id("soot") {
        fluid.add_scalar(soot, point, 0.1, 5.0).unwrap();
    }
    if let Some(fuel) = fluid.scalar_id("fuel") {
        fluid.add_scalar(fuel, point, 0.1, 1.0).unwrap();
    }
    let push = Source { force_n: random.vector(0.1), ..Source::new(Shape::Sphere { centre: point, radius_m: 0.05 }) };
    fluid.add_source(&push).unwrap();
}

fn run(fluid: &mut Fluid, steps: std::ops::Range<u64>) -> u64 {
    for step in steps {
        add_sources(step, fluid);
        fluid.step(0.02).unwrap();
    }
    fluid.state_hash()
}

/// A fluid in the middle of things, with sources pending.
fn running(builder: FluidBuilder) -> Fluid {
    let mut fluid = builder.build().unwrap();
    let (low, high) = (fluid.origin() + 0.1 * fluid.size_m(), fluid.origin() + 0.4 * fluid.size_m());
    let shape = Shape::Box { low, high };
    let gone = fluid.attach_source(Source { heat_kw: 9.0, ..Source::new(shape.clone()) }).unwrap();
    let velocity = Some(Couple { value: Vec3::X, per_s: 3.0 });
    fluid.attach_source(Source { heat_kw: 0.4, velocity, ..Source::new(shape) }).unwrap();
    fluid.detach_source(gone).unwrap();
    if fluid.sides().x[0] == Side::Inflow {
        fluid.set_side_velocity(SideAt::Left, |point| Vec3::X * (0.5 + point.y)).unwrap();
        fluid.set_side_velocity(SideAt::Bottom, |_| 0.2 * Vec3::Z).unwrap();
        fluid.set_side_temperature(SideAt::Bottom, Some(80.0)).unwrap();
    }
    if fluid.scalar_id("oxygen").is_some() {
        let (origin, size) = (fluid.origin(), fluid.size_m());
        let ball = Obstacle::sphere(origin + 0.6 * size, 0.06).spinning(Vec3::Y * 5.0, origin).moving(0.1 * Vec3::X);
        let bar = Obstacle::from_distance(move |point| (point.y - origin.y - 0.7 * size.y).abs() - 0.03).slippery();
        fluid.set_obstacles(&[bar, ball]).unwrap();
        fluid.set_frame_velocity(Vec3::new(0.05, 0.0, -0.1)).unwrap();
    }
    run(&mut fluid, 0..4);
    fluid.set_wind(Vec3::new(0.6, 0.0, 0.1)).unwrap();
    fluid.set_ambient_k(310.0).unwrap();
    add_sources(77, &mut fluid);
    fluid
}

fn through_bytes(snapshot: &Snapshot) -> Snapshot {
    Snapshot::from_bytes(&snapshot.to_bytes()).unwrap()
}

fn through_json(snapshot: &Snapshot) -> Snapshot {
    serde_json::from_str(&serde_json::to_string(snapshot).unwrap()).unwrap()
}

#[test]
fn saving_loading_and_going_on_equals_not_having_stopped() {
    for builder in [
        everything(),
        everything().pressure(PressureSolver::GaussSeidel { sweeps: 7 }),
        everything().combustion(Combustion::new(Fuel::PROPANE)).smagorinsky(0.15).hot_gas(true),
        everything().advection(Advection::Reflection).density(Density::LowMach),
        everything().advection(Advection::Conservative).density(Density::LowMach).deardorff(0.1),
        Fluid::builder([5, 12, 6]),
        Fluid::builder([24, 25, 24]).sides(Sides::OPEN),
    ] {
        let mut fluid = running(builder.clone());
        let saved = fluid.save();
        let hash = run(&mut fluid, 4..9);
        for copy in [saved.clone(), through_bytes(&saved), through_json(&saved)] {
            let mut loaded = Fluid::load(&copy).unwrap();
            assert_eq!(loaded.save(), saved);
            assert_eq!(run(&mut loaded, 4..9), hash, "{builder:?}");
            assert_eq!(loaded.max_speed_m_s(), fluid.max_speed_m_s());
            assert_eq!(loaded.potential(), fluid.potential());
        }
        // Back to where it was, in the fluid itself and in a box of a batch.
        fluid.restore(&saved).unwrap();
        assert_eq!(run(&mut fluid, 4..9), hash);
        let mut batch = builder.build_batch(2).unwrap();
        batch[1].restore(&saved).unwrap();
        assert_eq!(run(&mut batch[1], 4..9), hash);
    }
}

#[test]
fn the_bytes_are_compact_and_always_the_same() {
    let fluid = running(everything());
    let bytes = fluid.save().to_bytes();
    let [nx, ny, nz] = fluid.cells();
    let cells = nx * ny * nz;
    let faces = 3 * cells + nx * ny + ny * nz + nz * nx;
    // Velocity and accelerations; temperature, potential, heat, expansion, soot's source, a pack of four.
    let values = 2 * faces + 9 * cells;
    println!("{} bytes for {values} values", bytes.len());
    // The velocities of two sides and what describes fluid and sources besides.
    let sides = 3 * (nx * nz + ny * nz) + 2 * (nx + ny + 2 * nz);
    // One byte a cell for obstacles.
    assert!(bytes.len() < 4 * (values + sides) + cells + 900);
    assert_eq!(bytes, running(everything()).save().to_bytes());
}

#[test]
fn a_snapshot_of_another_shape_is_refused_and_changes_nothing() {
    let saved = running(everything()).save();
    for builder in [
        Fluid::builder([9, 7, 8]),
        everything().size_m(Vec3::new(0.4, 0.3, 0.36)),
        everything().sides(Sides::OPEN),
        everything().pressure(PressureSolver::GaussSeidel { sweeps: 7 }),
        everything().scalar("ash"),
    ] {
        let mut fluid = running(builder);
        let before = fluid.save();
        assert_eq!(fluid.restore(&saved), Err(SnapshotError::Shape));
        assert_eq!(fluid.save(), before);
    }
}

/// Changes one thing in the snapshot's JSON, and says how it is refused.
fn refused(path: &[&str], value: serde_json::Value) -> SnapshotError {
    let mut fluid = running(everything());
    let mut json = serde_json::to_value(fluid.save()).unwrap();
    let mut place = &mut json;
    for key in path {
        place = match key.parse::<usize>() {
            Ok(index) => &mut place[index],
            Err(_) => &mut place[key],
        };
    }
    assert!(!place.is_null(), "{path:?} is not there");
    *place = value;
    let bad: Snapshot = serde_json::from_value(json).unwrap();
    let error = Fluid::load(&bad).err().unwrap_or_else(|| panic!("{path:?} was taken"));
    let before = fluid.save();
    assert!(fluid.restore(&bad).is_err());
    assert_eq!(fluid.save(), before);
    error
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    use serde_json::json;
    assert_eq!(refused(&["version"], json!(99)), SnapshotError::Version { found: 99 });
    let length = |field, found, expected| SnapshotError::Length { field, found, expected };
    assert_eq!(refused(&["state", "velocity", "1"], json!([])), length("velocity", 0, 9 * 8 * 8));
    assert_eq!(refused(&["state", "temperature"], json!([1.0])), length("temperature", 1, 504));
    assert_eq!(refused(&["state", "potential"], json!([1.0])), length("potential", 1, 504));
    assert_eq!(refused(&["state", "packs"], json!([])), length("scalars", 0, 1));
    assert_eq!(refused(&["state", "packs", "0"], json!([])), length("scalars", 0, 504));
    assert_eq!(refused(&["pending", "heat"], json!([1.0])), length("heat", 1, 504));
    assert_eq!(refused(&["pending", "acceleration", "0"], json!([1.0])), length("acceleration", 1, 10 * 7 * 8));
    assert_eq!(refused(&["pending", "scalars"], json!([[]])), length("scalar sources", 1, 2));
    for (path, field) in
        [(["state", "velocity", "2", "5"], "velocity"), (["pending", "acceleration", "2", "5"], "acceleration")]
    {
        let error = refused(&path, json!(1.0e30));
        assert!(matches!(error, SnapshotError::Value { field: named, index: 5, .. } if named == field), "{error}");
    }
    assert!(matches!(refused(&["state", "temperature", "5"], json!(1.0e5)), SnapshotError::Value { index: 5, .. }));
    for path in [["setup", "viscosity_m2_s"], ["setup", "ambient_k"], ["setup", "cooling_per_s"]] {
        assert!(matches!(refused(&path, json!(-1.0)), SnapshotError::Setup(FluidError::Value { .. })));
    }
    let error = refused(&["given", "velocity", "0", "0", "1"], json!([1.0]));
    let expected = FluidError::Length { field: "side velocity", found: 1, expected: 8 * 8 };
    assert_eq!(error, SnapshotError::Setup(expected));
    let error = refused(&["given", "temperature_k", "1", "0"], json!(1.0e9));
    assert!(matches!(error, SnapshotError::Setup(FluidError::Value { field: "side temperature", .. })));
    let error = refused(&["pending", "placed", "kept", "0", "2", "heat_kw"], json!(1.0e9));
    assert!(matches!(error, SnapshotError::Setup(FluidError::Value { field: "heat_kw", .. })));
    for id in [json!(1), json!(u64::MAX)] {
        let error = refused(&["pending", "placed", "next_id"], id);
        assert!(matches!(error, SnapshotError::Setup(FluidError::UnknownSource { .. })));
    }
    let error = refused(&["solids", "owners"], json!([1]));
    let expected = FluidError::Length { field: "obstacle cells", found: 1, expected: 504 };
    assert_eq!(error, SnapshotError::Setup(expected));
    for (path, value, named) in [
        (["solids", "owners", "7"], json!(9), "obstacle of a cell"),
        (
            ["solids", "bodies", "0"],
            json!({"velocity_m_s": [1.0e9, 0.0, 0.0], "spin_rad_s": [0.0, 0.0, 0.0], "about": [0.0, 0.0, 0.0], "is_slippery": true}),
            "obstacle velocity",
        ),
    ] {
        let error = refused(&path, value);
        assert!(matches!(error, SnapshotError::Setup(FluidError::Value { field, .. }) if field == named), "{error}");
    }
    // Cells that nobody could hold in memory are refused before any is taken.
    let error = refused(&["setup", "cells"], json!([512, 512, 512]));
    assert_eq!(error, SnapshotError::Setup(FluidError::TooManyCells { cells: 1 << 27 }));
    let error = refused(&["setup", "cells"], json!([512, 512, 64]));
    assert_eq!(error, length("velocity", 10 * 7 * 8, 513 * 512 * 64));
    assert_eq!(
        Fluid::load(&running(Fluid::builder([2, 3, 4])).save()).err(),
        None,
        "the smallest box that is not flat"
    );
}

/// Puts the right checksum before bytes that were changed, as somebody who means harm would.
fn with_checksum(mut bytes: Vec<u8>) -> Vec<u8> {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for byte in bytes.iter().skip(20) {
        hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    }
    if let Some(place) = bytes.get_mut(12..20) {
        place.copy_from_slice(&hash.to_le_bytes());
    }
    bytes
}

/// Whatever the bytes are: an error, or a fluid that steps and stays finite.
fn is_harmless(bytes: &[u8]) -> Result<(), TestCaseError> {
    let Ok(snapshot) = Snapshot::from_bytes(bytes) else { return Ok(()) };
    let Ok(mut fluid) = Fluid::load(&snapshot) else { return Ok(()) };
    for _ in 0..2 {
        fluid.step(0.05).unwrap();
    }
    let all = fluid.face_velocities().into_iter().chain([fluid.temperatures()]);
    prop_assert!(all.flatten().all(|value| value.is_finite()));
    Ok(())
}

fn small_bytes() -> Vec<u8> {
    let mut fluid = Fluid::builder([3, 4, 3]).sides(Sides::OPEN).scalar("soot").build().unwrap();
    fluid.fill_velocity(random_velocity(3, 2.0)).unwrap();
    add_sources(5, &mut fluid);
    fluid.save().to_bytes()
}

#[test]
fn bytes_cut_anywhere_are_refused() {
    let bytes = small_bytes();
    for length in 0..bytes.len() {
        let error = Snapshot::from_bytes(&bytes[..length]).unwrap_err();
        let expected = if length < 20 { SnapshotError::NotASnapshot } else { SnapshotError::Checksum };
        assert_eq!(error, expected, "{length}");
        let error = Snapshot::from_bytes(&with_checksum(bytes[..length].to_vec())).unwrap_err();
        assert!(matches!(error, SnapshotError::NotASnapshot | SnapshotError::Malformed), "{length}: {error}");
    }
    let longer = [bytes.as_slice(), &[0]].concat();
    assert_eq!(Snapshot::from_bytes(&longer), Err(SnapshotError::Checksum));
    assert_eq!(Snapshot::from_bytes(&with_checksum(longer)), Err(SnapshotError::Malformed));
    let mut other = bytes.clone();
    other[8] = 9;
    assert_eq!(Snapshot::from_bytes(&other), Err(SnapshotError::Version { found: 9 }));
    other[0] = b'l';
    assert_eq!(Snapshot::from_bytes(&other), Err(SnapshotError::NotASnapshot));
}

#[test]
fn every_flipped_bit_is_noticed_and_with_a_forged_checksum_does_no_harm() {
    let bytes = small_bytes();
    let mut taken = 0;
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut flipped = bytes.clone();
            flipped[at] ^= 1 << bit;
            assert!(Snapshot::from_bytes(&flipped).is_err(), "byte {at}, bit {bit}");
            let forged = with_checksum(flipped);
            taken += usize::from(Snapshot::from_bytes(&forged).is_ok());
            is_harmless(&forged).unwrap();
        }
    }
    println!("{taken} of {} flips leave something that can be read", 8 * bytes.len());
    assert!(taken > bytes.len());
}

/// Lengths that claim more than there is: an error at once, and no memory to speak of.
#[test]
fn hostile_lengths_take_no_memory() {
    let bytes = small_bytes();
    for at in 20..bytes.len() {
        let mut hostile = bytes[..at].to_vec();
        hostile.extend([0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]);
        hostile.extend(&bytes[at..]);
        let hostile = with_checksum(hostile);
        let used = allocation_counter::measure(|| drop(Snapshot::from_bytes(&hostile)));
        assert!(used.bytes_max < 8 << 20, "{at}: {} bytes", used.bytes_max);
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn mutated_bytes_do_no_harm(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0_u8..4), 1..12),
        is_forged in any::<bool>(),
    ) {
        let mut bytes = small_bytes();
        for (place, byte, kind) in changes {
            let at = place.index(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                2 => drop(bytes.remove(at)),
                _ => bytes.truncate(bytes.len() - at.min(8)),
            }
            prop_assume!(!bytes.is_empty());
        }
        is_harmless(&if is_forged { with_checksum(bytes) } else { bytes })?;
    }

    #[test]
    fn any_bytes_do_no_harm(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        is_harmless(&bytes)?;
        let mut headed = b"LUCFLUID\x01\0\0\0".to_vec();
        headed.extend([0; 8]);
        headed.extend(&bytes);
        is_harmless(&with_checksum(headed))?;
    }
}
