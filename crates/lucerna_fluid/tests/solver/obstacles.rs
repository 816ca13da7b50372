//! Solid bodies in the air.

use lucerna_fluid::{Fluid, FluidError, Obstacle, Quat, Side, Sides, Vec3};

use crate::support::divergence;

#[test]
fn bad_obstacles_are_refused_and_leave_the_fluid_alone() {
    let middle = Vec3::splat(0.5);
    let build = || {
        let mut fluid = Fluid::builder([12; 3]).sides(Sides::OPEN).wind(Vec3::X).build().unwrap();
        fluid.set_obstacles(&[Obstacle::sphere(middle, 0.2)]).unwrap();
        fluid
    };
    let (mut fluid, mut untouched) = (build(), build());
    let refused = |fluid: &mut Fluid, obstacle: Obstacle| {
        let result = fluid.set_obstacles(&[Obstacle::sphere(middle, 0.1), obstacle]);
        assert!(matches!(result, Err(FluidError::Value { .. })), "{result:?}");
    };
    for bad in [f32::NAN, f32::INFINITY, -1.0e9] {
        let vector = Vec3::new(0.5, bad, 0.5);
        refused(&mut fluid, Obstacle::sphere(vector, 0.1));
        refused(&mut fluid, Obstacle::sphere(middle, bad));
        refused(&mut fluid, Obstacle::capsule(middle, vector, 0.1));
        refused(&mut fluid, Obstacle::cylinder(middle, vector, 0.1));
        refused(&mut fluid, Obstacle::cuboid(middle, vector, Quat::IDENTITY));
        refused(&mut fluid, Obstacle::cuboid(middle, Vec3::ONE, Quat::from_xyzw(0.0, bad, 0.0, 1.0)));
        refused(&mut fluid, Obstacle::sphere(middle, 0.1).moving(vector));
        refused(&mut fluid, Obstacle::sphere(middle, 0.1).spinning(vector, middle));
        refused(&mut fluid, Obstacle::sphere(middle, 0.1).spinning(Vec3::X, vector));
    }
    refused(&mut fluid, Obstacle::cylinder(middle, middle, 0.1));
    refused(&mut fluid, Obstacle::from_distance(|point| if point.x > 0.6 { f32::NAN } else { 1.0 }));
    let outside = [
        Obstacle::sphere(Vec3::splat(1.3), 0.2),
        Obstacle::capsule(Vec3::new(-1.0, 0.5, 0.5), Vec3::new(-0.3, 0.5, 0.5), 0.2),
        Obstacle::cuboid(Vec3::new(0.5, 3.0, 0.5), Vec3::ONE, Quat::from_rotation_x(0.7)),
        Obstacle::from_distance(|point| point.distance(Vec3::splat(2.0)) - 0.3),
        Obstacle::from_voxels(vec![false; 1728]),
    ];
    for obstacle in outside {
        let result = fluid.set_obstacles(&[Obstacle::sphere(middle, 0.1), obstacle]);
        assert_eq!(result, Err(FluidError::ObstacleOutside { index: 1 }));
    }
    let result = fluid.set_obstacles(&[Obstacle::from_voxels(vec![true; 1727])]);
    assert_eq!(result, Err(FluidError::ObstacleVoxels { index: 0, cells: 1727, expected: 1728 }));
    for fluid in [&mut fluid, &mut untouched] {
        fluid.step(0.02).unwrap();
    }
    assert_eq!(fluid.state_hash(), untouched.state_hash());
    assert_eq!(fluid.obstacles().len(), 1);
    fluid.set_obstacles(&[]).unwrap();
    assert!(fluid.solid_cells().is_empty());
    fluid.step(0.02).unwrap();
}

#[test]
fn shapes_fill_the_cells_that_they_hold() {
    let mut fluid = Fluid::builder([40; 3]).build().unwrap();
    let middle = Vec3::splat(0.5);
    let mut share = |obstacle: Obstacle| {
        fluid.set_obstacles(&[obstacle]).unwrap();
        fluid.solid_cells().iter().filter(|solid| **solid).count() as f32 / 64_000.0
    };
    let pi = std::f32::consts::PI;
    let turned = Quat::from_rotation_z(0.5);
    let along = Vec3::new(0.1, 0.2, 0.15);
    let cases = [
        (Obstacle::sphere(middle, 0.3), 4.0 / 3.0 * pi * 0.027),
        (Obstacle::cuboid(middle, Vec3::new(0.2, 0.5, 0.6), turned), 0.06),
        (Obstacle::cylinder(middle - along, middle + along, 0.2), pi * 0.04 * 2.0 * along.length()),
        (
            Obstacle::capsule(middle - along, middle + along, 0.2),
            pi * 0.04 * 2.0 * along.length() + 4.0 / 3.0 * pi * 0.008,
        ),
        (Obstacle::from_distance(|point| point.y - 0.25), 0.25),
        (Obstacle::from_voxels((0..64_000).map(|cell| cell % 2 == 0).collect::<Vec<bool>>()), 0.5),
    ];
    for (obstacle, volume) in cases {
        let name = format!("{obstacle:?}");
        let found = share(obstacle);
        assert!((found / volume - 1.0).abs() < 0.02, "{name}: {found} against {volume}");
    }
}

/// Around a body that moves and turns the flow is free of divergence, and on its surface it has
/// the body's velocity.
#[test]
fn air_gives_way_to_a_body_that_moves_and_turns() {
    let (n, centre) = (24, Vec3::new(0.45, 0.5, 0.55));
    let (velocity, spin) = (Vec3::new(0.8, -0.3, 0.2), Vec3::new(0.0, 3.0, -2.0));
    for sides in [Sides::OPEN, Sides::CLOSED, Sides { x: [Side::Periodic; 2], ..Sides::all(Side::NoSlip) }] {
        let mut fluid = Fluid::builder([n; 3]).sides(sides).viscosity_m2_s(1.0e-3).build().unwrap();
        let body = Obstacle::cuboid(centre, Vec3::new(0.4, 0.2, 0.3), Quat::from_rotation_y(0.4));
        fluid.set_obstacles(&[body.moving(velocity).spinning(spin, centre)]).unwrap();
        for _ in 0..5 {
            let report = fluid.step(0.02).unwrap();
            assert!(report.divergence_after < 1.0e-4, "{sides:?}: {report:?}");
        }
        let solid = fluid.solid_cells().to_vec();
        for (rate, _) in divergence(&fluid).iter().zip(&solid).filter(|(_, solid)| !**solid) {
            assert!(rate.abs() < 4.0e-3, "{sides:?}: {rate}");
        }
        let [u, _, _] = fluid.face_velocities();
        for (cell, _) in solid.iter().enumerate().filter(|(_, solid)| **solid) {
            let [i, j, k] = [cell % n, cell / n % n, cell / (n * n)];
            for i in [i, i + 1] {
                let point = Vec3::new(i as f32, j as f32 + 0.5, k as f32 + 0.5) / n as f32;
                let expected = (velocity + spin.cross(point - centre)).x;
                assert!((u[i + (n + 1) * (j + n * k)] - expected).abs() < 1.0e-5);
            }
        }
    }
}

/// A plate that moves along itself over a floor drags the air: Couette's linear profile, also
/// where the floor is an obstacle. A slippery one drags nothing.
#[test]
fn a_moving_plate_drags_the_air_linearly_and_a_slippery_one_not_at_all() {
    let sides = Sides { x: [Side::Periodic; 2], ..Sides::CLOSED };
    let plate = |low: f32, high: f32, velocity: f32| {
        Obstacle::from_distance(move |point| if point.y > low && point.y < high { -1.0 } else { 1.0 })
            .moving(Vec3::X * velocity)
    };
    for slip in [false, true] {
        let mut fluid = Fluid::builder([6, 16, 4]).sides(sides).viscosity_m2_s(0.5).build().unwrap();
        let top = plate(0.75, 1.0, 2.0);
        let top = if slip { top.slippery() } else { top };
        fluid.set_obstacles(&[plate(0.0, 0.25, 0.0), top]).unwrap();
        for _ in 0..200 {
            fluid.step(0.05).unwrap();
        }
        let [u, _, _] = fluid.face_velocities();
        let mut off = 0.0_f32;
        for j in 4..12 {
            let y = (j as f32 + 0.5 - 4.0) / 8.0;
            off = off.max((u[3 + 7 * j] - if slip { 0.0 } else { 2.0 * y }).abs());
        }
        println!("Couette flow between obstacles, slippery plate {slip}: off by {off:.1e} of 2 m/s");
        assert!(off < 1.0e-5, "slip {slip}: {off}");
    }
}

/// Nothing gets through a shell: heat and scalars inside it stay there, and no solid cell lends
/// what it holds.
#[test]
fn heat_does_not_leak_through_a_shell() {
    let middle = Vec3::splat(0.5);
    let shell = Obstacle::from_distance(move |point| (point.distance(middle) - 0.35).abs() - 0.08);
    let mut fluid = Fluid::builder([24; 3]).sides(Sides::OPEN).wind(Vec3::new(1.0, 0.3, 0.0)).build().unwrap();
    fluid.set_thermal_diffusivity_m2_s(1.0e-3).unwrap();
    fluid.set_obstacles(&[shell]).unwrap();
    fluid.fill_temperature(|point| if point.distance(middle) < 0.3 { 200.0 + 300.0 * point.x } else { 0.0 }).unwrap();
    let solid = fluid.solid_cells().to_vec();
    let sums = |fluid: &Fluid| {
        let mut sums = [0.0_f64; 2];
        for (cell, value) in fluid.temperatures().iter().enumerate().filter(|(cell, _)| !solid[*cell]) {
            let point = (Vec3::new((cell % 24) as f32, (cell / 24 % 24) as f32, (cell / 576) as f32) + 0.5) / 24.0;
            sums[usize::from(point.distance(middle) > 0.35)] += f64::from(*value);
        }
        sums
    };
    let before = sums(&fluid);
    for _ in 0..60 {
        fluid.step(0.02).unwrap();
    }
    let after = sums(&fluid);
    println!(
        "heat inside a shell: changed by {:.1e}; outside: {:.1e} of it",
        after[0] / before[0] - 1.0,
        after[1] / before[0]
    );
    assert!(fluid.max_speed_m_s() > 0.5);
    assert!((after[0] / before[0] - 1.0).abs() < 0.02 && after[1].abs() < 1.0e-3 * before[0], "{before:?} {after:?}");
}

/// A ball carried through still air, in a box that goes with it, and the same ball in a wind are
/// one flow. In a box that stands still it is nearly the same: the ball's cells change.
#[test]
fn a_ball_that_moves_through_still_air_is_a_ball_in_a_wind() {
    let (velocity, dt_s, cells) = (Vec3::new(-1.0, 0.0, 0.0), 0.02, [32, 20, 20]);
    let size = Vec3::new(1.6, 1.0, 1.0);
    let at = Vec3::new(1.1, 0.5, 0.5);
    let run = |frame: Vec3, ball: Vec3, wind: Vec3| {
        let builder = Fluid::builder(cells).size_m(size).sides(Sides::OPEN).viscosity_m2_s(2.0e-3).wind(wind);
        let mut fluid = builder.frame_velocity(frame).build().unwrap();
        let mut centre = at - if frame == ball { Vec3::ZERO } else { ball * 20.0 * dt_s };
        for _ in 0..20 {
            fluid.set_obstacles(&[Obstacle::sphere(centre, 0.15).moving(ball)]).unwrap();
            fluid.step(dt_s).unwrap();
            centre += ball * dt_s;
        }
        fluid
    };
    let blown = run(Vec3::ZERO, Vec3::ZERO, -velocity);
    let carried = run(velocity, velocity, Vec3::ZERO);
    let mut off = 0.0_f32;
    for (axis, (a, b)) in blown.face_velocities().into_iter().zip(carried.face_velocities()).enumerate() {
        off = a.iter().zip(b).map(|(a, b)| (a + velocity[axis] - b).abs()).fold(off, f32::max);
    }
    println!("a ball carried at 1 m/s with its box, and in a wind: off by {off:.1e} m/s");
    assert!(off < 1.0e-3, "{off}");
}
