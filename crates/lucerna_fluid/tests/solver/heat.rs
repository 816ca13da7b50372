//! Hot air: rest, plumes, the balance of heat.

use lucerna_fluid::{Advection, Fluid, Side, SideAt, Sides, Vec3};

#[test]
fn a_uniformly_hot_closed_box_stays_at_rest() {
    let mut fluid = Fluid::builder([15; 3]).build().unwrap();
    fluid.fill_temperature(|_| 800.0).unwrap();
    for _ in 0..100 {
        fluid.step(0.02).unwrap();
    }
    // It would fall upwards at 27 m/s² were it not held.
    assert!(fluid.max_speed_m_s() < 1.0e-5, "moves at {}", fluid.max_speed_m_s());
    assert!(fluid.temperatures().iter().all(|value| (value - 800.0).abs() < 0.01));
}

#[test]
fn a_centred_plume_stays_mirror_symmetric() {
    let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
    for n in [15, 16, 30] {
        let mut fluid = Fluid::builder([n; 3])
            .sides(sides)
            .advection(Advection::SemiLagrangian)
            .vorticity_confinement(1.0)
            .build()
            .unwrap();
        for _ in 0..100 {
            fluid.add_heat(Vec3::new(0.5, 0.12, 0.5), 0.15, 1500.0).unwrap();
            fluid.step(1.0 / 60.0).unwrap();
        }
        let scale = fluid.max_speed_m_s();
        assert!(scale > 1.0, "no plume at {n}");
        let [_, v, _] = fluid.face_velocities();
        let mut off = 0.0_f32;
        for k in 0..n {
            for j in 0..=n {
                for i in 0..n {
                    let at = |i: usize, k: usize| v[i + n * (j + (n + 1) * k)];
                    let here = at(i, k);
                    let mirrored = [at(n - 1 - i, k), at(i, n - 1 - k), at(k, i)];
                    off = mirrored.into_iter().fold(off, |most, other| most.max((here - other).abs()));
                }
            }
        }
        println!("asymmetry of a plume at {n}^3 after 100 steps: {:.1e}", off / scale);
        assert!(off < 1.0e-4 * scale, "{n}: off by {off} of {scale}");
    }
}

#[test]
fn a_plume_does_not_care_whether_the_number_of_cells_is_odd() {
    let top_speed = |n: usize| {
        let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
        let mut fluid = Fluid::builder([n; 3]).sides(sides).build().unwrap();
        for _ in 0..200 {
            fluid.add_heat(Vec3::new(0.5, 0.15, 0.5), 0.2, 1000.0).unwrap();
            fluid.step(1.0 / 60.0).unwrap();
        }
        (fluid.max_speed_m_s(), fluid.temperatures().iter().fold(0.0_f32, |most, value| most.max(*value)))
    };
    let ((speed, kelvin), (other_speed, other_kelvin)) = (top_speed(15), top_speed(16));
    println!("plume at 15^3: {speed} m/s, {kelvin} K; at 16^3: {other_speed} m/s, {other_kelvin} K");
    assert!((speed / other_speed - 1.0).abs() < 0.3 && (kelvin / other_kelvin - 1.0).abs() < 0.4);
}

#[test]
fn heat_is_neither_lost_nor_made_in_a_closed_box() {
    let mut fluid = Fluid::builder([15, 20, 16]).build().unwrap();
    fluid.fill_temperature(|point| if point.distance(Vec3::new(0.5, 0.3, 0.5)) < 0.2 { 500.0 } else { 0.0 }).unwrap();
    let total = |fluid: &Fluid| fluid.temperatures().iter().map(|value| f64::from(*value)).sum::<f64>();
    let before = total(&fluid);
    for _ in 0..200 {
        fluid.step(1.0 / 60.0).unwrap();
    }
    assert!(fluid.max_speed_m_s() > 0.1);
    let change = total(&fluid) / before - 1.0;
    println!("change of the total heat in 200 steps: {change:.1e}");
    assert!(change.abs() < 1.0e-4, "{change}");
}

#[test]
fn cooling_is_exponential_whatever_the_step() {
    for dt_s in [0.5, 0.01] {
        let mut fluid = Fluid::builder([4; 3]).cooling_per_s(2.0).build().unwrap();
        fluid.fill_temperature(|_| 100.0).unwrap();
        for _ in 0..(1.0 / f64::from(dt_s)).round() as usize {
            fluid.step(dt_s).unwrap();
        }
        let expected = 100.0 * (-2.0_f32).exp();
        assert!((fluid.temperature(Vec3::splat(0.5)) / expected - 1.0).abs() < 1.0e-3);
    }
}

/// `a dT/dy` is the same everywhere with `a` as T^1.7: T^2.7 is a straight line.
#[test]
fn hot_gas_conducts_as_the_power_law_says() {
    let mut fluid = Fluid::builder([4, 32, 4])
        .size_m(Vec3::new(0.0125, 0.1, 0.0125))
        .thermal_diffusivity_m2_s(1.0e-4)
        .hot_gas(true)
        .build()
        .unwrap();
    // Hot above, so that it stays at rest.
    fluid.set_side_temperature(SideAt::Bottom, Some(0.0)).unwrap();
    fluid.set_side_temperature(SideAt::Top, Some(1200.0)).unwrap();
    // Short against the swings of layered air.
    for _ in 0..5000 {
        fluid.step(0.02).unwrap();
    }
    // From cell to cell; the law of the wall is another matter.
    let ambient = f64::from(fluid.ambient_k());
    let kelvins: Vec<f64> = fluid.temperatures().chunks_exact(4).take(32).map(|row| f64::from(row[0])).collect();
    let power = |j: usize| (1.0 + kelvins[j] / ambient).powf(2.7);
    let (low, high) = (power(3), power(28));
    let mut worst = 0.0_f64;
    for (j, kelvin) in kelvins.iter().enumerate().take(29).skip(3) {
        let exact = ambient * ((low + (high - low) * (j as f64 - 3.0) / 25.0).powf(1.0 / 2.7) - 1.0);
        worst = worst.max((kelvin - exact).abs());
    }
    assert!(kelvins[28] > kelvins[3] + 500.0, "{kelvins:?}");
    println!("hot gas between a cold and a hot wall: {worst:.1} K off, of 1200 K");
    assert!(worst < 6.0, "{worst}");
}
