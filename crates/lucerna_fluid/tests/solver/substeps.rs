//! Steps that divide themselves.

use lucerna_fluid::{Couple, Fluid, FluidError, Shape, Sides, Source, StepReport, Vec3};

fn windy(limit: Option<f32>, most: u32) -> Fluid {
    let builder = Fluid::builder([10; 3]).sides(Sides::OPEN).wind(Vec3::new(2.0, 0.0, 0.0)).cooling_per_s(0.5);
    builder.cfl_limit(limit).max_substeps(most).build().unwrap()
}

fn push(fluid: &mut Fluid) {
    fluid.add_heat(Vec3::splat(0.5), 0.3, 500.0).unwrap();
    fluid.add_acceleration(Vec3::splat(0.3), Vec3::new(0.0, 20.0, 0.0)).unwrap();
    fluid.add_expansion(Vec3::splat(0.5), 0.3, 2.0).unwrap();
    let velocity = Some(Couple { value: Vec3::Y, per_s: 5.0 });
    let shape = Shape::Sphere { centre: Vec3::splat(0.6), radius_m: 0.2 };
    fluid.add_source(&Source { inflow_m3_s: 0.02, heat_kw: 3.0, velocity, ..Source::new(shape) }).unwrap();
}

#[test]
fn a_step_has_as_many_parts_as_the_limit_asks_for() {
    // The wind of 2 m/s crosses 0.1 m in 0.05 s.
    for (limit, most, dt_s, parts) in [
        (None, 32, 1.0, 1),
        (Some(1.0), 32, 0.0499, 1),
        (Some(1.0), 32, 0.0501, 2),
        (Some(1.0), 32, 0.249, 5),
        (Some(0.5), 32, 0.249, 10),
        (Some(2.0), 32, 0.249, 3),
        (Some(1.0), 4, 0.249, 4),
        (Some(0.01), 7, 1.0e3, 7),
        (Some(1.0), 32, 1.0e-30, 1),
    ] {
        let report = windy(limit, most).step(dt_s).unwrap();
        assert_eq!(report.substeps, parts, "{limit:?} {most} {dt_s}");
        assert_eq!(report.dt_s, dt_s);
        let cfl = 2.0 * dt_s / parts as f32 / 0.1;
        assert!((report.cfl / cfl - 1.0).abs() < 1.0e-2, "{} {cfl}", report.cfl);
    }
}

#[test]
fn a_divided_step_is_its_parts_with_the_sources_in_each() {
    let mut whole = windy(Some(1.0), 32);
    let mut parts = windy(None, 32);
    push(&mut whole);
    let report = whole.step(0.18).unwrap();
    assert_eq!(report.substeps, 4);
    let mut all: Vec<StepReport> = Vec::new();
    for _ in 0..4 {
        push(&mut parts);
        all.push(parts.step(0.18 / 4.0).unwrap());
    }
    assert_eq!(whole.state_hash(), parts.state_hash());
    let most = |of: fn(&StepReport) -> f32| all.iter().map(of).fold(0.0, f32::max);
    assert_eq!(report.pressure_residual, most(|part| part.pressure_residual));
    assert_eq!(report.divergence_before, most(|part| part.divergence_before));
    assert_eq!(report.divergence_after, most(|part| part.divergence_after));
    assert_eq!(report.cfl, most(|part| part.cfl));
    assert_eq!(report.max_speed_m_s, all[3].max_speed_m_s);
    assert_eq!(report.max_temperature_k, all[3].max_temperature_k);
    // Used up: the next step has none.
    let hash = |fluid: &mut Fluid| {
        fluid.set_cfl_limit(None).unwrap();
        fluid.step(0.01).unwrap();
        fluid.state_hash()
    };
    assert_eq!(hash(&mut whole), hash(&mut parts));
}

#[test]
fn dividing_a_long_step_keeps_what_it_would_lose() {
    let flow = |point: Vec3| {
        let (x, y) = (std::f32::consts::PI * point.x, std::f32::consts::PI * point.y);
        Vec3::new(x.sin() * y.cos(), -x.cos() * y.sin(), 0.0)
    };
    let error = |limit: Option<f32>| {
        let mut fluid = Fluid::builder([24, 24, 4]).cfl_limit(limit).build().unwrap();
        fluid.fill_velocity(flow).unwrap();
        fluid.step(1.0).unwrap();
        let at = Vec3::new(0.5, 0.2, 0.5);
        (fluid.velocity(at) - flow(at)).length()
    };
    let (long, divided) = (error(None), error(Some(1.0)));
    println!("a steady vortex after 24 cells: off by {long:.3} m/s in one part, {divided:.3} in many");
    assert!(divided < 0.5 * long);
}

#[test]
fn limits_out_of_range_are_refused() {
    let value = |result: Result<(), FluidError>| match result {
        Err(FluidError::Value { field, .. }) => field,
        other => panic!("{other:?}"),
    };
    let mut fluid = windy(None, 32);
    for bad in [f32::NAN, f32::INFINITY, 0.0, -1.0, 1.0e4] {
        assert_eq!(value(fluid.set_cfl_limit(Some(bad))), "cfl_limit");
        assert_eq!(value(Fluid::builder([4; 3]).cfl_limit(Some(bad)).build().map(drop)), "cfl_limit");
    }
    for bad in [0, 1001, u32::MAX] {
        assert_eq!(value(fluid.set_max_substeps(bad)), "max_substeps");
        assert_eq!(value(Fluid::builder([4; 3]).max_substeps(bad).build().map(drop)), "max_substeps");
    }
    assert_eq!(fluid.step(0.2).unwrap().substeps, 1);
}
