//! The conservative scheme: what it keeps, and what it keeps within bounds.

use lucerna_fluid::{Advection, Density, Fluid, FluidBuilder, Side, Sides, Vec3};

use crate::support::random_velocity;

/// A flow in the plane of x and z, where nothing has weight: x leaves, z goes round.
fn weightless(cells: usize) -> FluidBuilder {
    Fluid::builder([cells, 1, cells])
        .size_m(Vec3::new(1.0, 1.0 / cells as f32, 1.0))
        .sides(Sides { x: [Side::Open; 2], y: [Side::FreeSlip; 2], z: [Side::Periodic; 2] })
        .density(Density::LowMach)
        .advection(Advection::Conservative)
}

/// Temperature above ambient of a ball of gas of a fifth of the density of air, a cell's slope at
/// its edge.
fn light_ball(point: Vec3) -> f32 {
    let from_centre = Vec3::new(point.x - 0.5, 0.0, point.z - 0.5).length();
    let share = 0.8 * ((0.2 - from_centre) * 32.0 + 0.5).clamp(0.0, 1.0);
    293.15 * share / (1.0 - share)
}

/// Density over that of ambient air, by cell.
fn densities(fluid: &Fluid) -> impl Iterator<Item = f64> {
    fluid.temperatures().iter().map(|kelvin| 1.0 / (1.0 + f64::from(kelvin / fluid.ambient_k())))
}

/// Sum over the faces across z of the mass there times the velocity.
fn momentum(fluid: &Fluid) -> f64 {
    let [nx, _, nz] = fluid.cells();
    let (rho, [_, _, w]): (Vec<f64>, _) = (densities(fluid).collect(), fluid.face_velocities());
    let at =
        |i: usize, k: usize| 0.5 * (rho[i + nx * ((k + nz - 1) % nz)] + rho[i + nx * k]) * f64::from(w[i + nx * k]);
    (0..nz).flat_map(|k| (0..nx).map(move |i| (i, k))).map(|(i, k)| at(i, k)).sum()
}

#[test]
fn a_light_ball_goes_with_the_wind_as_if_it_weighed_as_much_as_air() {
    let mut fluid = weightless(32).wind(Vec3::new(0.5, 0.0, 1.0)).build().unwrap();
    fluid.fill_temperature(light_ball).unwrap();
    let mass: f64 = densities(&fluid).sum();
    let mut off = 0.0_f32;
    for _ in 0..40 {
        fluid.step(0.01).unwrap();
        let [u, _, w] = fluid.face_velocities();
        off = u.iter().map(|u| (u - 0.5).abs()).chain(w.iter().map(|w| (w - 1.0).abs())).fold(off, f32::max);
    }
    let lost = densities(&fluid).sum::<f64>() / mass - 1.0;
    println!("a light ball in a wind of 1.1 m/s: the wind is off by {off:.1e} m/s, the mass by {lost:.1e}");
    assert!(off < 2.0e-5, "{off}");
    assert!(lost.abs() < 1.0e-6, "{lost}");
    let hottest = fluid.temperatures().iter().copied().fold(0.0, f32::max);
    assert!(hottest < 4.0 * 293.15 * 1.0001, "{hottest} K is a new extreme");
}

/// By how much the momentum of a jet through light gas is off after half a second, and the mass.
fn jet(dt_s: f32) -> (f64, f64) {
    let mut fluid = weightless(32).build().unwrap();
    fluid.fill_temperature(light_ball).unwrap();
    fluid
        .fill_velocity(|point| {
            let x = point.x - 0.55;
            Vec3::Z * (-100.0 * x * x).exp() * (1.0 + 0.3 * (std::f32::consts::TAU * point.z).sin())
        })
        .unwrap();
    fluid.step(1.0e-4).unwrap();
    let (before, mass) = (momentum(&fluid), densities(&fluid).sum::<f64>());
    for _ in 0..(0.5 / dt_s) as usize {
        fluid.step(dt_s).unwrap();
    }
    (momentum(&fluid) / before - 1.0, densities(&fluid).sum::<f64>() / mass - 1.0)
}

#[test]
fn a_jet_through_light_gas_keeps_its_momentum_the_better_the_shorter_the_step() {
    let ((long, lost), (short, _)) = (jet(0.005), jet(0.00125));
    println!(
        "a jet through light gas: momentum off by {long:.1e}, with a quarter of the step {short:.1e}; mass {lost:.1e}"
    );
    assert!(long.abs() < 0.01 && short.abs() < 0.5 * long.abs(), "{long} {short}");
    assert!(lost.abs() < 1.0e-6, "{lost}");
}

#[test]
fn eddies_in_a_periodic_box_keep_momentum_and_nearly_all_of_their_energy() {
    let energy = |dt_s: f32, steps: usize| {
        let mut fluid =
            Fluid::builder([16; 3]).sides(Sides::PERIODIC).advection(Advection::Conservative).build().unwrap();
        fluid.fill_velocity(random_velocity(3, 1.0)).unwrap();
        let sums = |fluid: &Fluid| {
            fluid.face_velocities().map(|field| field.iter().map(|value| f64::from(*value)).sum::<f64>())
        };
        let (before, start) = (fluid.mean_kinetic_energy_m2_s2(), sums(&fluid)[1]);
        for _ in 0..steps {
            fluid.step(dt_s).unwrap();
        }
        let drift = (sums(&fluid)[1] - start).abs() / 16.0_f64.powi(3);
        assert!(drift < 1.0e-5, "momentum drifts by {drift} m/s");
        fluid.mean_kinetic_energy_m2_s2() / before - 1.0
    };
    let (long, short) = (energy(0.008, 60), energy(0.004, 120));
    println!("noise in a periodic box, 0.48 s: energy off by {long:+.2e}, half the step {short:+.2e}");
    assert!(long.abs() < 1.0e-3 && short.abs() < long.abs() / 2.0, "{long} {short}");
}

#[test]
fn scalars_keep_their_totals_and_their_bounds() {
    let builder = Fluid::builder([14, 11, 12]).advection(Advection::Conservative).scalar("dye");
    let mut fluid = builder.build().unwrap();
    let dye = fluid.scalar_id("dye").unwrap();
    fluid.fill_scalar(dye, |point| if point.x < 0.5 { 1.0 } else { 0.0 }).unwrap();
    fluid.fill_velocity(random_velocity(8, 3.0)).unwrap();
    let before = fluid.scalar_total(dye);
    let (mut least, mut most) = (0.0_f32, 1.0_f32);
    for step in 0..60 {
        fluid.step([0.02, 0.003, 0.05][step % 3]).unwrap();
        least = fluid.scalar_values(dye).fold(least, f32::min);
        most = fluid.scalar_values(dye).fold(most, f32::max);
    }
    let off = fluid.scalar_total(dye) / before - 1.0;
    println!("dye in eddies: total off by {off:.1e}, between {least:.1e} and 1 + {:.1e}", most - 1.0);
    assert!(off.abs() < 1.0e-5 && least > -1.0e-5 && most < 1.00001);
}
