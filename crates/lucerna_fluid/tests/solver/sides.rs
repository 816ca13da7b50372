//! What the sides do to the flow.

use lucerna_fluid::{Fluid, FluidError, Side, SideAt, Sides, Vec3};

#[test]
fn a_velocity_is_refused_where_a_side_has_none() {
    let sides = Sides { x: [Side::Inflow, Side::Open], y: [Side::NoSlip, Side::FreeSlip], ..Sides::PERIODIC };
    let mut fluid = Fluid::builder([8; 3]).sides(sides).build().unwrap();
    for (side, name) in [(SideAt::Right, "right"), (SideAt::Top, "top"), (SideAt::Back, "back")] {
        let refused = fluid.set_side_velocity(side, |_| Vec3::X);
        assert_eq!(refused, Err(FluidError::SideVelocity { side: name }));
    }
    for bad in [f32::NAN, f32::INFINITY, 101.0] {
        let refused =
            fluid.set_side_velocity(SideAt::Left, |point| if point.z > 0.5 { Vec3::Y * bad } else { Vec3::X });
        assert!(matches!(refused, Err(FluidError::Value { field: "side velocity", .. })));
        assert!(fluid.set_side_temperature(SideAt::Left, Some(bad * 1.0e4)).is_err());
        assert!(fluid.set_thermal_diffusivity_m2_s(bad * 10.0).is_err());
    }
    let refused = fluid.set_side_temperature(SideAt::Front, Some(10.0));
    assert_eq!(refused, Err(FluidError::SideTemperature { side: "front" }));
    // Nothing of all that has changed anything.
    let mut untouched = Fluid::builder([8; 3]).sides(sides).build().unwrap();
    fluid.step(0.1).unwrap();
    untouched.step(0.1).unwrap();
    assert_eq!(fluid.state_hash(), untouched.state_hash());
    fluid.set_side_velocity(SideAt::Left, |_| Vec3::X).unwrap();
    fluid.set_side_velocity(SideAt::Bottom, |_| Vec3::X).unwrap();
}

/// A jet enters a box by a part of one side; what enters leaves by the open one.
#[test]
fn an_inflow_profile_is_what_enters() {
    let (n, sides) = (16, Sides { x: [Side::Inflow, Side::Open], ..Sides::CLOSED });
    let mut fluid = Fluid::builder([n; 3]).sides(sides).build().unwrap();
    let profile = |point: Vec3| if point.y < 0.5 { Vec3::new(4.0 * point.z, 0.0, 0.0) } else { Vec3::ZERO };
    fluid.set_side_velocity(SideAt::Left, profile).unwrap();
    for _ in 0..20 {
        fluid.step(0.02).unwrap();
    }
    let [u, _, _] = fluid.face_velocities();
    let (mut enters, mut leaves) = (0.0_f64, 0.0_f64);
    for (at, row) in u.chunks_exact(n + 1).enumerate() {
        let point = Vec3::new(0.0, (at % n) as f32 + 0.5, (at / n) as f32 + 0.5) / n as f32;
        assert_eq!(row[0], profile(point).x);
        enters += f64::from(row[0]);
        leaves += f64::from(row[n]);
    }
    assert!((leaves / enters - 1.0).abs() < 1.0e-5, "{enters} enters, {leaves} leaves");
}

/// Where no side is open, what does not balance is taken off evenly.
#[test]
fn inflow_sides_of_a_sealed_box_are_balanced() {
    let sides = Sides { x: [Side::Inflow; 2], ..Sides::CLOSED };
    let mut fluid = Fluid::builder([12, 10, 2]).sides(sides).wind(Vec3::X).build().unwrap();
    fluid.set_side_velocity(SideAt::Left, |_| Vec3::X * 3.0).unwrap();
    let report = fluid.step(0.01).unwrap();
    let [u, _, _] = fluid.face_velocities();
    for row in u.chunks_exact(13) {
        assert!((row[0] - 2.0).abs() < 1.0e-5 && (row[12] - 2.0).abs() < 1.0e-5, "{row:?}");
    }
    assert!(report.divergence_after < 1.0e-5, "{report:?}");
}
