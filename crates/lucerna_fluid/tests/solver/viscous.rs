//! Viscosity and conduction against exact answers.

use std::f32::consts::TAU;

use lucerna_fluid::{Advection, Fluid, Side, SideAt, Sides, Vec3};

/// Between two walls at different temperatures the temperature becomes linear (and the velocity
/// stays zero, because heavy lies below light).
#[test]
fn conduction_between_two_walls_becomes_linear() {
    let n = 16;
    for sides in [Sides::CLOSED, Sides::all(Side::NoSlip)] {
        let mut fluid = Fluid::builder([4, n, 6]).sides(sides).build().unwrap();
        fluid.set_side_temperature(SideAt::Bottom, Some(-40.0)).unwrap();
        fluid.set_side_temperature(SideAt::Top, Some(120.0)).unwrap();
        fluid.set_thermal_diffusivity_m2_s(0.5).unwrap();
        for _ in 0..100 {
            fluid.step(0.5).unwrap();
        }
        let mut off = 0.0_f32;
        for (at, value) in fluid.temperatures().iter().enumerate() {
            let y = ((at / 4 % n) as f32 + 0.5) / n as f32;
            off = off.max((value - (-40.0 + 160.0 * y)).abs());
        }
        println!("conduction between walls of -40 and 120 K: off by {off:.1e} K");
        assert!(off < 1.0e-3, "{sides:?}: {off}");
    }
}

/// Insulated walls keep the heat, whatever the step.
#[test]
fn conduction_keeps_the_heat_in_an_insulated_box() {
    for dt_s in [1.0e-3, 0.1, 10.0] {
        let mut fluid = Fluid::builder([17, 9, 12]).build().unwrap();
        fluid.set_thermal_diffusivity_m2_s(0.01).unwrap();
        fluid.fill_temperature(|point| 300.0 * (point.x * 9.0).sin().powi(2)).unwrap();
        let total = |fluid: &Fluid| fluid.temperatures().iter().map(|value| f64::from(*value)).sum::<f64>();
        let spread = |fluid: &Fluid| {
            let bounds = (f32::MAX, f32::MIN);
            fluid.temperatures().iter().fold(bounds, |(low, high), value| (low.min(*value), high.max(*value)))
        };
        let (before, bounds) = (total(&fluid), spread(&fluid));
        for _ in 0..50 {
            fluid.step(dt_s).unwrap();
        }
        let (change, after) = (total(&fluid) / before - 1.0, spread(&fluid));
        println!("heat in an insulated box, 50 steps of {dt_s} s: changed by {change:.1e}");
        assert!(change.abs() < 1.0e-4, "dt {dt_s}: {change}");
        assert!(after.0 >= bounds.0 - 0.01 && after.1 <= bounds.1 + 0.01 && after.1 < bounds.1, "{after:?}");
    }
}

#[test]
fn plane_poiseuille_flow_is_the_exact_parabola() {
    let (n, viscosity, push) = (16, 0.5, 4.0);
    let sides = Sides { x: [Side::NoSlip; 2], y: [Side::Periodic; 2], ..Sides::CLOSED };
    let mut fluid = Fluid::builder([n, 6, 1]).sides(sides).viscosity_m2_s(viscosity).build().unwrap();
    for _ in 0..60 {
        (0..6).for_each(|row| fluid.add_row_acceleration(row, push).unwrap());
        fluid.step(0.5).unwrap();
    }
    let [_, v, _] = fluid.face_velocities();
    let edge = 1.0 / n as f32;
    let mut off = 0.0_f32;
    for (at, value) in v.iter().enumerate() {
        let x = ((at % n) as f32 + 0.5) * edge;
        off = off.max((value - push / viscosity * 0.5 * x * (1.0 - x)).abs());
    }
    println!("plane Poiseuille flow, 16 cells: off the parabola by {off:.1e} of 1 m/s");
    assert!(off < 3.0e-6, "{off}");
}

#[test]
fn plane_couette_flow_under_a_moving_lid_is_linear() {
    let n = 16;
    let sides = Sides { x: [Side::Periodic; 2], y: [Side::NoSlip; 2], ..Sides::CLOSED };
    let mut fluid = Fluid::builder([6, n, 1]).sides(sides).viscosity_m2_s(0.5).build().unwrap();
    fluid.set_side_velocity(SideAt::Top, |_| Vec3::X).unwrap();
    for _ in 0..60 {
        fluid.step(0.5).unwrap();
    }
    let [u, _, _] = fluid.face_velocities();
    let away = |(at, value): (usize, &f32)| (value - ((at / 7) as f32 + 0.5) / n as f32).abs();
    let off = u.iter().enumerate().map(away).fold(0.0, f32::max);
    println!("plane Couette flow, 16 cells: off the exact line by {off:.1e} of 1 m/s");
    assert!(off < 3.0e-6, "{off}");
}

/// F. White, *Viscous Fluid Flow*, section 3-3: 2.096 in a square duct.
#[test]
fn a_square_duct_has_the_profile_of_the_series() {
    let n = 32;
    let sides = Sides { y: [Side::Periodic; 2], ..Sides::all(Side::NoSlip) };
    let builder = Fluid::builder([n, 2, n]).size_m(Vec3::new(1.0, 2.0 / n as f32, 1.0)).sides(sides);
    let mut fluid = builder.viscosity_m2_s(0.1).build().unwrap();
    for _ in 0..400 {
        (0..2).for_each(|row| fluid.add_row_acceleration(row, 1.0).unwrap());
        fluid.step(0.01).unwrap();
    }
    let [_, v, _] = fluid.face_velocities();
    let planes = || v.chunks_exact(3 * n).map(|plane| &plane[..n]);
    let mean = planes().flatten().sum::<f32>() / (n * n) as f32;
    // The middle lies between four values; a parabola through them and the next adds a little.
    let middle = |i: usize, k: usize| v[i + 3 * n * k];
    let (near, far) = (middle(n / 2, n / 2), middle(n / 2 + 1, n / 2));
    let most = near + 0.25 * (near - far);
    let ratio = most / mean;
    println!("square duct, 32^2: greatest over mean velocity {ratio:.4}, exact 2.096");
    assert!((ratio / 2.096 - 1.0).abs() < 0.01, "{ratio}");
}

/// Share of its energy that a periodic flow keeps, against what it should.
fn decay(cells: [usize; 3], viscosity: f32, end_s: f32, cfl_speed: f32, start: impl Fn(Vec3) -> Vec3) -> f64 {
    let n = cells[0] as f32;
    let builder = Fluid::builder(cells).size_m(Vec3::from_array(cells.map(|count| count as f32 / n)));
    let flat = if cells[2] == 1 { [Side::FreeSlip; 2] } else { [Side::Periodic; 2] };
    let builder = builder.sides(Sides { z: flat, ..Sides::PERIODIC }).viscosity_m2_s(viscosity);
    let mut fluid = builder.advection(Advection::Reflection).build().unwrap();
    fluid.fill_velocity(start).unwrap();
    let before = fluid.mean_kinetic_energy_m2_s2();
    let steps = (end_s * cfl_speed * n).ceil();
    for _ in 0..steps as usize {
        fluid.step(end_s / steps).unwrap();
    }
    fluid.mean_kinetic_energy_m2_s2() / before
}

#[test]
fn a_viscous_taylor_green_vortex_decays_as_it_should() {
    let (viscosity, end_s) = (0.01_f32, 1.0_f32);
    let exact = f64::from(-4.0 * viscosity * TAU * TAU * end_s).exp();
    let start = |point: Vec3| {
        let (x, y) = (TAU * point.x, TAU * point.y);
        Vec3::new(x.sin() * y.cos(), -x.cos() * y.sin(), 0.0)
    };
    let off = [32, 64].map(|n| decay([n, n, 1], viscosity, end_s, 1.0, start) / exact - 1.0);
    println!("viscous Taylor-Green vortex, t = 1, CFL 1: energy off by {off:.4?} at 32^2, 64^2");
    assert!(off[1].abs() < 0.01 && off[1].abs() < off[0].abs(), "{off:?}");
}

/// V. Arnold, E. Beltrami, S. Childress: a flow along its own vorticity, so that only viscosity acts.
#[test]
fn an_abc_flow_decays_as_it_should() {
    let (viscosity, end_s) = (0.02_f32, 0.25_f32);
    let exact = f64::from(-2.0 * viscosity * TAU * TAU * end_s).exp();
    let start = |point: Vec3| {
        let [x, y, z] = (TAU * point).to_array();
        Vec3::new(z.sin() + y.cos(), x.sin() + z.cos(), y.sin() + x.cos())
    };
    let off = [32, 64].map(|n| decay([n, n, n], viscosity, end_s, 2.0, start) / exact - 1.0);
    println!("ABC flow, t = 0.25, CFL 1: energy off by {off:.4?} at 32^3, 64^3");
    assert!(off[1].abs() < 0.01 && off[1].abs() < off[0].abs(), "{off:?}");
}

/// A parabola that is given where the air enters is what flows all along the channel.
#[test]
fn a_parabola_that_enters_a_channel_stays_one() {
    let (nx, ny) = (48, 16);
    let sides = Sides { x: [Side::Inflow, Side::Open], y: [Side::NoSlip; 2], ..Sides::CLOSED };
    let builder = Fluid::builder([nx, ny, 1]).size_m(Vec3::new(3.0, 1.0, 1.0 / 16.0)).sides(sides);
    let mut fluid = builder.viscosity_m2_s(0.02).build().unwrap();
    let parabola = |point: Vec3| Vec3::X * 4.0 * point.y * (1.0 - point.y);
    fluid.set_side_velocity(SideAt::Left, parabola).unwrap();
    fluid.fill_velocity(parabola).unwrap();
    for _ in 0..200 {
        fluid.step(0.1).unwrap();
    }
    let [u, _, _] = fluid.face_velocities();
    let mut off = 0.0_f32;
    for (at, value) in u.iter().enumerate() {
        let y = ((at / (nx + 1)) as f32 + 0.5) / ny as f32;
        off = off.max((value - 4.0 * y * (1.0 - y)).abs());
    }
    println!("parabola through a channel of 3 heights, CFL 1.6: off by {off:.4} of its peak");
    assert!(off < 0.02, "{off}");
}
