//! Named scalars.

use lucerna_fluid::{Fluid, FluidBuilder, FluidError, Sides, Vec3};

#[test]
fn names_must_differ_and_not_be_empty() {
    let error = |names: &[&str]| {
        let builder = names.iter().fold(Fluid::builder([4; 3]), |builder, name| builder.scalar(*name));
        builder.build().err()
    };
    assert_eq!(error(&["soot", "fuel"]), None);
    assert!(matches!(error(&["soot", ""]), Some(FluidError::ScalarName { index: 1, .. })));
    assert!(matches!(error(&["soot", "fuel", "soot"]), Some(FluidError::ScalarName { index: 2, .. })));
    let many: Vec<String> = (0..65).map(|index| index.to_string()).collect();
    let builder = many.iter().fold(Fluid::builder([4; 3]), FluidBuilder::scalar);
    assert_eq!(builder.build().err(), Some(FluidError::TooManyScalars { count: 65 }));
    let builder = Fluid::builder([4; 3]).scalar_with_outside("oxygen", f32::NAN);
    assert!(matches!(builder.build().err(), Some(FluidError::Value { field: "scalar", .. })));
}

#[test]
fn each_scalar_keeps_its_own_values() {
    let names = ["a", "b", "c", "d", "e", "f"];
    let builder = names.iter().fold(Fluid::builder([5, 6, 7]), |builder, name| builder.scalar(*name));
    let mut fluid = builder.build().unwrap();
    assert!(fluid.scalar_names().eq(names));
    assert_eq!(fluid.scalar_id("g"), None);
    for (index, name) in names.into_iter().enumerate() {
        let id = fluid.scalar_id(name).unwrap();
        fluid.fill_scalar(id, |point| index as f32 + point.x).unwrap();
    }
    fluid.step(0.1).unwrap();
    for (index, name) in names.into_iter().enumerate() {
        let id = fluid.scalar_id(name).unwrap();
        let expected = index as f32 + 0.4;
        assert!((fluid.scalar(id, Vec3::new(0.4, 0.2, 0.8)) - expected).abs() < 1.0e-5, "{name}");
        assert_eq!(fluid.scalar_values(id).count(), 5 * 6 * 7);
        assert!((fluid.scalar_total(id) - index as f64 - 0.5).abs() < 1.0e-6);
    }
}

#[test]
fn a_source_adds_its_rate_and_is_used_up() {
    let mut fluid = Fluid::builder([9; 3]).scalar("fuel").scalar("soot").build().unwrap();
    let soot = fluid.scalar_id("soot").unwrap();
    let untouched = fluid.state_hash();
    assert!(fluid.add_scalar(soot, Vec3::splat(0.5), 0.2, f32::NAN).is_err());
    assert!(fluid.add_scalar(soot, Vec3::splat(f32::INFINITY), 0.2, 1.0).is_err());
    assert!(fluid.fill_scalar(soot, |point| if point.x > 0.5 { f32::NAN } else { 1.0 }).is_err());
    assert!(fluid.set_scalar_outside(soot, 1.0e7).is_err());
    assert_eq!(fluid.state_hash(), untouched);
    fluid.add_scalar(soot, Vec3::splat(0.5), 0.2, 8.0).unwrap();
    fluid.step(0.25).unwrap();
    fluid.step(0.25).unwrap();
    assert!((fluid.scalar(soot, Vec3::splat(0.5)) - 2.0).abs() < 1.0e-6);
    assert_eq!(fluid.scalar(fluid.scalar_id("fuel").unwrap(), Vec3::splat(0.5)), 0.0);
    assert_ne!(fluid.state_hash(), untouched);
    fluid.reset();
    assert_eq!(fluid.state_hash(), untouched);
}

#[test]
fn an_id_of_another_fluid_is_refused() {
    let other = Fluid::builder([4; 3]).scalar("a").scalar("b").build().unwrap();
    let id = other.scalar_id("b").unwrap();
    let mut fluid = Fluid::builder([4; 3]).scalar("a").build().unwrap();
    let refused = Err(FluidError::UnknownScalar { index: 1, count: 1 });
    assert_eq!(fluid.add_scalar(id, Vec3::ZERO, 1.0, 1.0), refused);
    assert_eq!(fluid.fill_scalar(id, |_| 1.0), refused);
    assert_eq!(fluid.set_scalar_outside(id, 1.0), refused);
    assert_eq!(fluid.scalar(id, Vec3::ZERO), 0.0);
    let mut none = Fluid::builder([4; 3]).build().unwrap();
    assert_eq!(none.scalar(id, Vec3::ZERO), 0.0);
    assert_eq!(none.scalar_values(id).count(), 0);
    assert!(none.fill_scalar(id, |_| 1.0).is_err());
}

#[test]
fn wind_brings_in_what_is_outside() {
    let builder = Fluid::builder([8; 3]).sides(Sides::OPEN).wind(Vec3::X).scalar_with_outside("oxygen", 0.23);
    let mut fluid = builder.scalar("soot").build().unwrap();
    let (oxygen, soot) = (fluid.scalar_id("oxygen").unwrap(), fluid.scalar_id("soot").unwrap());
    assert_eq!(fluid.scalar(oxygen, Vec3::splat(0.5)), 0.23);
    fluid.fill_scalar(oxygen, |_| 0.0).unwrap();
    fluid.fill_scalar(soot, |_| 1.0).unwrap();
    for _ in 0..100 {
        fluid.step(0.1).unwrap();
    }
    assert!(fluid.scalar_values(oxygen).all(|value| (value - 0.23).abs() < 1.0e-6));
    assert!(fluid.scalar_values(soot).all(|value| value.abs() < 1.0e-6));
}
