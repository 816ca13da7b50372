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

/// Still air does not notice that a box without walls moves through it.
#[test]
fn still_air_stays_still_in_an_open_box_that_moves() {
    let mut fluid = Fluid::builder([15, 12, 13]).sides(Sides::OPEN).build().unwrap();
    fluid.set_frame_velocity(Vec3::new(3.0, -1.0, 0.5)).unwrap();
    for _ in 0..100 {
        fluid.step(0.02).unwrap();
    }
    assert!(fluid.origin().distance(Vec3::new(6.0, -2.0, 1.0)) < 1.0e-4, "{}", fluid.origin());
    let most = fluid.max_speed_m_s();
    println!("still air in an open box that moves at 3.2 m/s: {most:.1e} m/s after 100 steps");
    assert!(most < 2.0e-6, "{most}");
}

/// The air of a closed box goes with it.
#[test]
fn the_air_of_a_closed_box_moves_with_it() {
    let velocity = Vec3::new(2.0, -0.5, 1.0);
    for (sides, viscosity) in [(Sides::CLOSED, 0.0), (Sides::all(Side::NoSlip), 1.0)] {
        let mut fluid = Fluid::builder([8, 9, 7]).sides(sides).viscosity_m2_s(viscosity).build().unwrap();
        fluid.set_frame_velocity(velocity).unwrap();
        for _ in 0..20 {
            fluid.step(0.02).unwrap();
        }
        for (field, expected) in fluid.face_velocities().into_iter().zip(velocity.to_array()) {
            let off = field.iter().fold(0.0_f32, |most, value| most.max((value - expected).abs()));
            assert!(off < 2.0e-5, "{sides:?}: off by {off}");
        }
    }
}

/// A torch that is carried through still air leans as it does in a wind from the front: both
/// are the same flow, seen from the air and from the torch.
#[test]
fn a_plume_carried_through_still_air_leans_as_in_a_wind() {
    let wind = Vec3::new(-1.2, 0.0, 0.4);
    let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
    let run = |is_carried: bool| {
        let builder = Fluid::builder([24; 3]).sides(sides).wind(if is_carried { Vec3::ZERO } else { wind });
        let mut fluid = builder.build().unwrap();
        if is_carried {
            fluid.set_frame_velocity(-wind).unwrap();
        }
        for _ in 0..80 {
            fluid.add_heat(fluid.origin() + Vec3::new(0.6, 0.12, 0.4), 0.15, 1500.0).unwrap();
            fluid.step(1.0 / 60.0).unwrap();
        }
        fluid
    };
    let (blown, carried) = (run(false), run(true));
    let mut off = 0.0_f32;
    for (axis, (a, b)) in blown.face_velocities().into_iter().zip(carried.face_velocities()).enumerate() {
        let away = a.iter().zip(b).map(|(a, b)| (a - wind[axis] - b).abs());
        off = away.fold(off, f32::max);
    }
    // Where the heat is, from the middle of the box: it leans downwind.
    let lean = |fluid: &Fluid| {
        let (mut sum, mut weight) = (0.0, 0.0);
        for (cell, kelvin) in fluid.temperatures().iter().enumerate() {
            sum += kelvin * ((cell % 24) as f32 + 0.5) / 24.0;
            weight += kelvin;
        }
        sum / weight - 0.6
    };
    println!(
        "plume carried at 1.3 m/s against the same in a wind: off by {off:.1e} of {:.2} m/s; leans by {:.3} and {:.3} m",
        blown.max_speed_m_s(),
        lean(&blown),
        lean(&carried)
    );
    assert!(off < 2.0e-3 * blown.max_speed_m_s(), "{off}");
    assert!(lean(&carried) < -0.05, "{}", lean(&carried));
}

#[test]
fn a_box_that_cannot_move_so_is_left_where_it_is() {
    let mut fluid = Fluid::builder([8, 1, 8]).build().unwrap();
    for bad in [Vec3::new(f32::NAN, 0.0, 0.0), Vec3::new(0.0, 0.1, 0.0), Vec3::new(0.0, 0.0, 101.0)] {
        assert!(matches!(fluid.set_frame_velocity(bad), Err(FluidError::Value { .. })), "{bad}");
        assert!(fluid.move_to(bad * 10.0, 0.1).is_err(), "{bad}");
    }
    assert!(fluid.move_to(Vec3::X, 0.0).is_err());
    fluid.step(0.1).unwrap();
    assert_eq!(fluid.origin(), Vec3::ZERO);
    fluid.move_to(Vec3::new(0.5, 0.0, -0.25), 0.1).unwrap();
    fluid.step(0.1).unwrap();
    assert!(fluid.origin().distance(Vec3::new(0.5, 0.0, -0.25)) < 1.0e-6);
}

/// An eddy that the wind carries out through an open side is gone: what comes back of it is small.
#[test]
fn an_eddy_leaves_through_an_open_side() {
    let n = 64;
    let sides = Sides { x: [Side::Inflow, Side::Open], ..Sides::CLOSED };
    let builder = Fluid::builder([n, n, 1]).size_m(Vec3::new(1.0, 1.0, 1.0 / n as f32)).sides(sides);
    let mut fluid = builder.wind(Vec3::X).build().unwrap();
    let eddy = |point: Vec3| {
        let away = (point - Vec3::new(0.5, 0.5, point.z)) / 0.1;
        Vec3::X + Vec3::Z.cross(away) * 0.8 * (-away.length_squared()).exp()
    };
    fluid.fill_velocity(eddy).unwrap();
    let energy = |fluid: &Fluid| {
        let sums = fluid.face_velocities().into_iter().zip([1.0, 0.0, 0.0]);
        sums.map(|(field, wind)| field.iter().map(|value| f64::from((value - wind).powi(2))).sum::<f64>()).sum::<f64>()
    };
    let before = energy(&fluid);
    for _ in 0..96 {
        fluid.step(1.0 / n as f32).unwrap();
    }
    let left = energy(&fluid) / before;
    println!("an eddy carried out through an open side: {:.2} % of its energy is left", 100.0 * left);
    assert!(left < 0.05, "{left}");
}
