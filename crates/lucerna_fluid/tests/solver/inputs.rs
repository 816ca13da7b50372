//! What is refused, and that a refusal changes nothing.

use lucerna_fluid::{
    Fluid, FluidBuilder, FluidError, Obstacle, PressureSolver, Shape, Side, SideAt, Sides, Source, Vec3,
};

const BAD: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

#[test]
fn the_builder_refuses_what_it_cannot_build() {
    let good = || Fluid::builder([8, 8, 8]);
    assert!(good().build().is_ok());
    assert_eq!(Fluid::builder([8, 1, 1]).build().err(), Some(FluidError::AxisCells { axis: "y", cells: 1 }));
    assert_eq!(Fluid::builder([8, 8, 513]).build().err(), Some(FluidError::AxisCells { axis: "z", cells: 513 }));
    assert_eq!(
        Fluid::builder([usize::MAX, 8, 8]).build().err(),
        Some(FluidError::AxisCells { axis: "x", cells: usize::MAX })
    );
    assert_eq!(Fluid::builder([512; 3]).build().err(), Some(FluidError::TooManyCells { cells: 512 * 512 * 512 }));
    let one_way = Sides { x: [Side::Inflow, Side::FreeSlip], ..Sides::CLOSED };
    assert_eq!(good().sides(one_way).build().err(), Some(FluidError::NoOutlet { axis: "x" }));
    let refused = |builder: FluidBuilder, name: &str| match builder.build() {
        Err(FluidError::Value { field, .. }) => assert_eq!(field, name),
        other => panic!("{name}: {:?}", other.err()),
    };
    for bad in BAD.into_iter().chain([-1.0, 1.0e9]) {
        refused(good().viscosity_m2_s(bad), "viscosity_m2_s");
        refused(good().vorticity_confinement(bad), "vorticity_confinement");
        refused(good().ambient_k(bad), "ambient_k");
        refused(good().cooling_per_s(bad), "cooling_per_s");
        refused(good().thermal_diffusivity_m2_s(bad), "thermal_diffusivity_m2_s");
        refused(good().smagorinsky(bad), "smagorinsky");
        refused(good().deardorff(bad), "deardorff");
        refused(good().turbulent_prandtl(bad), "turbulent_prandtl");
        refused(good().scalar_with_outside("soot", bad * 1.0e9), "scalar");
        refused(good().size_m(Vec3::new(1.0, bad, 1.0)), "size_m");
    }
    refused(good().size_m(Vec3::new(1.0, 0.0, 1.0)), "size_m");
    refused(good().origin(Vec3::new(0.0, 0.0, f32::NAN)), "origin");
    refused(good().wind(Vec3::new(0.0, 1000.0, 0.0)), "wind");
    refused(good().pressure(PressureSolver::GaussSeidel { sweeps: 0 }), "pressure sweeps");
    let message = good().viscosity_m2_s(-1.0).build().err().unwrap().to_string();
    assert_eq!(message, "viscosity_m2_s is -1; allowed: 0 to 1e3 m²/s");
}

#[test]
fn bad_numbers_are_refused_and_leave_the_fluid_alone() {
    let warm = || {
        let mut fluid = Fluid::builder([9; 3]).sides(Sides::OPEN).scalar("soot").build().unwrap();
        fluid.add_heat(Vec3::splat(0.5), 0.3, 1000.0).unwrap();
        fluid.step(0.02).unwrap();
        fluid
    };
    let (mut fluid, mut untouched) = (warm(), warm());
    let soot = fluid.scalar_id("soot").unwrap();
    let middle = Vec3::splat(0.5);
    for bad in BAD {
        let vector = Vec3::new(0.0, bad, 0.0);
        assert!(fluid.step(bad).is_err());
        assert!(fluid.add_acceleration(vector, Vec3::Y).is_err());
        assert!(fluid.add_acceleration(middle, vector).is_err());
        assert!(fluid.add_push(vector, 0.1, Vec3::Y).is_err());
        assert!(fluid.add_push(middle, bad, Vec3::Y).is_err());
        assert!(fluid.add_push(middle, 0.1, vector).is_err());
        assert!(fluid.add_row_acceleration(2, bad).is_err());
        assert!(fluid.add_heat(vector, 0.1, 1.0).is_err());
        assert!(fluid.add_heat(middle, bad, 1.0).is_err());
        assert!(fluid.add_heat(middle, 0.1, bad).is_err());
        assert!(fluid.add_expansion(vector, 0.1, 1.0).is_err());
        assert!(fluid.add_expansion(middle, bad, 1.0).is_err());
        assert!(fluid.add_expansion(middle, 0.1, bad).is_err());
        assert!(fluid.set_wind(vector).is_err());
        assert!(fluid.set_viscosity_m2_s(bad).is_err());
        assert!(fluid.set_vorticity_confinement(bad).is_err());
        assert!(fluid.set_cooling_per_s(bad).is_err());
        assert!(fluid.set_ambient_k(bad).is_err());
        assert!(fluid.set_thermal_diffusivity_m2_s(bad).is_err());
        assert!(fluid.set_frame_velocity(vector).is_err());
        assert!(fluid.move_to(vector, 0.1).is_err());
        assert!(fluid.move_to(Vec3::ZERO, bad).is_err());
        assert!(fluid.set_side_temperature(SideAt::Left, Some(bad)).is_err());
        assert!(fluid.set_obstacles(&[Obstacle::sphere(vector, 0.2)]).is_err());
        assert!(fluid.set_obstacles(&[Obstacle::sphere(middle, bad)]).is_err());
        assert!(fluid.set_obstacles(&[Obstacle::sphere(middle, 0.2).moving(vector)]).is_err());
        assert!(fluid.set_obstacles(&[Obstacle::sphere(middle, 0.2).spinning(vector, middle)]).is_err());
        assert!(fluid.set_obstacles(&[Obstacle::from_distance(move |_| f32::NAN)]).is_err());
        assert!(fluid.fill_scalar(soot, |point| if point.x > 0.5 { bad } else { 0.1 }).is_err());
        assert!(fluid.add_scalar(soot, vector, 0.1, 1.0).is_err());
        assert!(fluid.add_scalar(soot, middle, 0.1, bad).is_err());
        assert!(fluid.set_scalar_outside(soot, bad).is_err());
        let source = Source::new(Shape::Sphere { centre: middle, radius_m: 0.2 });
        assert!(fluid.add_source(&Source { heat_kw: bad, ..source.clone() }).is_err());
        assert!(fluid.add_source(&Source { force_n: vector, ..source.clone() }).is_err());
        assert!(fluid.attach_source(Source { inflow_m3_s: bad, ..source }).is_err());
        assert!(fluid.dt_for_cfl(bad).is_err());
        assert!(fluid.fill_velocity(|point| if point.x > 0.5 { vector } else { Vec3::X }).is_err());
        assert!(fluid.fill_temperature(|point| if point.x > 0.5 { bad } else { 50.0 }).is_err());
        assert!(fluid.velocity(vector).is_finite());
        assert!(fluid.temperature(vector).is_finite());
    }
    for dt_s in [0.0, -0.1, 1.1e3] {
        assert!(matches!(fluid.step(dt_s), Err(FluidError::Value { field: "dt_s", .. })));
    }
    assert!(fluid.add_heat(middle, 0.0, 1.0).is_err());
    assert_eq!(fluid.add_row_acceleration(9, 1.0), Err(FluidError::Row { row: 9, rows: 9 }));
    // What is far outside is no error, and does nothing.
    fluid.add_acceleration(Vec3::splat(f32::MAX), Vec3::Y).unwrap();
    fluid.add_push(Vec3::splat(f32::MAX), 0.1, Vec3::Y).unwrap();
    fluid.add_heat(Vec3::splat(-1.0e30), 0.1, 1000.0).unwrap();
    assert_eq!(fluid.state_hash(), untouched.state_hash());
    fluid.step(0.02).unwrap();
    untouched.step(0.02).unwrap();
    assert_eq!(fluid.state_hash(), untouched.state_hash());
}

#[test]
fn extreme_points_are_harmless() {
    let mut fluid = Fluid::builder([4, 3, 2]).origin(Vec3::new(-5.0, 2.0, 1.0)).build().unwrap();
    for point in [f32::MAX, -f32::MAX, 0.0, 1.0e30].map(Vec3::splat) {
        fluid.add_heat(point, 1.0e6, 1.0).unwrap();
        fluid.add_expansion(point, 1.0e6, 1.0).unwrap();
        fluid.add_acceleration(point, Vec3::ONE).unwrap();
        fluid.add_push(point, 1.0e6, Vec3::splat(1.0e6)).unwrap();
        assert!(fluid.velocity(point).is_finite());
    }
    fluid.step(0.1).unwrap();
    assert!(fluid.temperatures().iter().all(|value| value.is_finite()));
}
