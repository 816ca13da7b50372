//! Flows with known answers.

use std::f32::consts::PI;

use lucerna_fluid::{Fluid, Side, Sides, Vec3};

#[test]
fn a_uniform_wind_through_an_open_box_stays_uniform() {
    let wind = Vec3::new(3.0, -0.5, 1.25);
    let tunnel = Sides { x: [Side::Inflow, Side::Open], ..Sides::OPEN };
    for (cells, sides) in [([15, 15, 15], Sides::OPEN), ([16, 31, 17], Sides::OPEN), ([20, 12, 15], tunnel)] {
        let mut fluid = Fluid::builder(cells).sides(sides).wind(wind).build().unwrap();
        for _ in 0..100 {
            fluid.step(0.02).unwrap();
        }
        for (field, expected) in fluid.face_velocities().into_iter().zip(wind.to_array()) {
            let off = field.iter().fold(0.0_f32, |most, value| most.max((value - expected).abs()));
            assert!(off < 2.0e-5, "{cells:?} {sides:?}: off by {off}");
        }
    }
}

#[test]
fn an_open_box_takes_on_a_new_wind_whatever_the_step() {
    let mean_after = |dt_s: f32| {
        let mut fluid = Fluid::builder([15; 3]).sides(Sides::OPEN).build().unwrap();
        fluid.set_wind(Vec3::new(2.0, 0.0, 0.0)).unwrap();
        for _ in 0..(0.5 / dt_s).round() as usize {
            fluid.step(dt_s).unwrap();
        }
        let half = fluid.velocity(Vec3::splat(0.5)).x;
        for _ in 0..(4.0 / dt_s).round() as usize {
            fluid.step(dt_s).unwrap();
        }
        (half, fluid.velocity(Vec3::splat(0.5)).x)
    };
    let (coarse, fine) = (mean_after(1.0 / 50.0), mean_after(1.0 / 200.0));
    assert!((coarse.0 - fine.0).abs() < 0.2, "depends on the step: {coarse:?} against {fine:?}");
    assert!(coarse.1 > 1.8 && coarse.1 < 2.05, "{coarse:?}");
}

/// The Taylor-Green vortex of one half wave in a free-slip unit box.
fn taylor_green(point: Vec3) -> Vec3 {
    let (x, y) = (PI * point.x, PI * point.y);
    Vec3::new(x.sin() * y.cos(), -x.cos() * y.sin(), 0.0)
}

#[test]
fn taylor_green_keeps_its_energy() {
    for (n, least) in [(16, 0.44), (32, 0.62), (64, 0.77)] {
        let mut fluid = Fluid::builder([n, n, 4]).size_m(Vec3::new(1.0, 1.0, 0.25)).build().unwrap();
        fluid.fill_velocity(taylor_green).unwrap();
        let before = fluid.mean_kinetic_energy_m2_s2();
        for _ in 0..2 * n {
            let report = fluid.step(1.0 / n as f32).unwrap();
            assert!(report.cfl < 1.01);
        }
        let kept = fluid.mean_kinetic_energy_m2_s2() / before;
        println!("Taylor-Green at {n}^2, t = 2, CFL 1: {kept:.3} of the energy kept");
        assert!(kept > least && kept <= 1.0, "{n}: {kept}");
    }
}

/// A Taylor-Green vortex so slow that only viscosity acts decays as `exp(-2 nu pi² t)`.
#[test]
fn viscosity_damps_as_it_should() {
    let viscosity = 0.02_f32;
    let builder = Fluid::builder([32, 32, 4]).size_m(Vec3::new(1.0, 1.0, 0.25)).viscosity_m2_s(viscosity);
    let mut fluid = builder.build().unwrap();
    fluid.fill_velocity(|point| 1.0e-4 * taylor_green(point)).unwrap();
    let before = fluid.mean_kinetic_energy_m2_s2();
    for _ in 0..100 {
        fluid.step(0.02).unwrap();
    }
    let kept = (fluid.mean_kinetic_energy_m2_s2() / before).sqrt();
    let expected = f64::from(-2.0 * viscosity * PI * PI * 2.0).exp();
    println!("slow Taylor-Green vortex after 2 s: {kept:.4} of the speed, by theory {expected:.4}");
    assert!((kept / expected - 1.0).abs() < 0.02, "{kept} against {expected}");
}

/// Even flow into a channel whose walls hold the air becomes a parabola, half as fast again in
/// the middle (plane Poiseuille).
#[test]
fn friction_at_the_walls_makes_a_parabola() {
    let (nx, ny) = (16, 32);
    let no_slip = [Side::NoSlip; 2];
    let sides = Sides { x: no_slip, y: [Side::Inflow, Side::Open], z: [Side::FreeSlip; 2] };
    let builder = Fluid::builder([nx, ny, 2]).size_m(Vec3::new(1.0, 2.0, 0.125)).sides(sides);
    let mut fluid = builder.viscosity_m2_s(0.5).wind(Vec3::Y).build().unwrap();
    for _ in 0..400 {
        fluid.step(0.005).unwrap();
    }
    let [_, v, _] = fluid.face_velocities();
    let mut off = 0.0_f32;
    for i in 0..nx {
        let x = (i as f32 + 0.5) / nx as f32;
        off = off.max((v[i + nx * (ny * 3 / 4)] - 6.0 * x * (1.0 - x)).abs());
    }
    println!("plane Poiseuille: off by {off:.4} of the mean speed at most");
    assert!(off < 0.04, "{off}");
}

#[test]
fn points_follow_the_midpoint_rule() {
    let mut fluid = Fluid::builder([32, 32, 4]).size_m(Vec3::new(1.0, 1.0, 0.125)).build().unwrap();
    fluid.fill_velocity(taylor_green).unwrap();
    let start = Vec3::new(0.3, 0.4, 0.06);
    let mut points = [start, Vec3::splat(f32::NAN)];
    fluid.advect_points(&mut points, 0.1);
    let middle = start + 0.05 * fluid.velocity(start);
    assert_eq!(points[0], start + fluid.velocity(middle) * 0.1);
    // The vortex turns: points stay on lines of sin(pi x) sin(pi y) = constant.
    let stream = |point: Vec3| (PI * point.x).sin() * (PI * point.y).sin();
    let mut points = [start];
    for _ in 0..200 {
        fluid.advect_points(&mut points, 0.02);
    }
    assert!((stream(points[0]) - stream(start)).abs() < 2.0e-3, "{}", stream(points[0]) - stream(start));
    assert!((points[0] - start).length() > 0.05);
    let before = points;
    fluid.advect_points(&mut points, f32::NAN);
    assert_eq!(points, before);
}

#[test]
fn acceleration_gives_one_cell_of_momentum() {
    let mut fluid = Fluid::builder([5; 3]).sides(Sides::OPEN).build().unwrap();
    fluid.add_acceleration(Vec3::splat(0.5), Vec3::new(0.0, 10.0, 0.0)).unwrap();
    fluid.add_acceleration(Vec3::splat(2.0), Vec3::new(0.0, 1.0e5, 0.0)).unwrap();
    fluid.step(0.1).unwrap();
    let up = fluid.velocity(Vec3::splat(0.5)).y;
    // 0.5 m/s before the projection, which turns part of it into a ring of return flow.
    assert!(up > 0.2 && up < 0.5, "{up}");
    assert!(fluid.velocity(Vec3::new(0.1, 0.5, 0.5)).y < 0.0);
}
