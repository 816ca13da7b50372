//! Figures of the flow as a whole.

use std::f32::consts::PI;

use lucerna_fluid::{Fluid, FluidBuilder, FluidError, Shape, Side, Sides, Source, Vec3, air_density_kg_m3};

use crate::support::{divergence, random_velocity};

fn greatest_difference(values: &[Vec3], expected: impl Fn(usize) -> Vec3) -> f32 {
    values.iter().enumerate().fold(0.0, |most, (at, value)| most.max((*value - expected(at)).length()))
}

/// Solid rotation is free of divergence, but not what walls allow: the box is open.
#[test]
fn solid_rotation_has_twice_its_rate_as_vorticity_everywhere() {
    let rate = Vec3::new(0.7, -1.3, 2.1);
    let centre = Vec3::new(0.4, 1.0, 0.3);
    let mut fluid = Fluid::builder([9, 12, 7]).size_m(Vec3::new(0.8, 2.0, 0.6)).sides(Sides::OPEN).build().unwrap();
    fluid.fill_velocity(|point| rate.cross(point - centre)).unwrap();
    // What the projection leaves of it is the same flow to rounding only if it had no divergence.
    let most = greatest_difference(&fluid.vorticity(), |_| 2.0 * rate);
    println!("vorticity of a solid rotation off by {most:.1e} of {:.1}", 2.0 * rate.length());
    assert!(most < 1.0e-4, "{most}");
    for point in [centre, Vec3::ZERO, Vec3::new(0.8, 2.0, 0.6), Vec3::splat(50.0), Vec3::splat(f32::NAN)] {
        assert!((fluid.vorticity_at(point) - 2.0 * rate).length() < 1.0e-4, "{point}");
    }
    let expected = 0.5 * f64::from((2.0 * rate).length_squared());
    assert!((fluid.mean_enstrophy_per_s2() / expected - 1.0).abs() < 1.0e-4);
}

#[test]
fn vorticity_and_enstrophy_of_the_taylor_green_vortex_converge_at_second_order() {
    let flow = |point: Vec3| {
        let (x, y) = (PI * point.x, PI * point.y);
        Vec3::new(x.sin() * y.cos(), -x.cos() * y.sin(), 0.0)
    };
    let exact = |point: Vec3| 2.0 * PI * (PI * point.x).sin() * (PI * point.y).sin();
    let errors = [16, 32].map(|n| {
        let mut fluid = Fluid::builder([n, n, 4]).size_m(Vec3::new(1.0, 1.0, 0.25)).build().unwrap();
        fluid.fill_velocity(flow).unwrap();
        let vorticity = fluid.vorticity();
        let mut most = 0.0_f32;
        for (at, value) in vorticity.iter().enumerate() {
            let [i, j] = [at % n, at / n % n];
            let centre = (Vec3::new(i as f32, j as f32, 0.0) + 0.5) / n as f32;
            assert!(value.x.abs() + value.y.abs() < 1.0e-3);
            let is_inside = [i, j].iter().all(|at| (1..n - 1).contains(at));
            if is_inside {
                most = most.max((value.z - exact(centre)).abs());
            }
            assert!((fluid.vorticity_at(centre * Vec3::new(1.0, 1.0, 0.2)) - *value).length() < 1.0e-3);
        }
        let enstrophy = fluid.mean_enstrophy_per_s2() / (0.5 * f64::from(PI * PI)) - 1.0;
        println!("{n}^2: vorticity off by {most:.4} of {:.2}, enstrophy by {enstrophy:.4}", 2.0 * PI);
        [f64::from(most), enstrophy.abs()]
    });
    for (coarse, fine) in errors[0].into_iter().zip(errors[1]) {
        assert!(fine < 0.03 && coarse / fine > 3.0, "{coarse} {fine}");
    }
}

#[test]
fn vorticity_goes_round_periodic_axes() {
    let wave = |point: Vec3| Vec3::new(0.0, (2.0 * PI * point.x).sin(), 0.0);
    let mut fluid = Fluid::builder([24, 6, 5]).sides(Sides::PERIODIC).build().unwrap();
    fluid.fill_velocity(wave).unwrap();
    // Central differences of a sine are the cosine times sin(a) / a.
    let step = 2.0 * PI / 24.0;
    let exact = |at: usize| 2.0 * PI * (step.sin() / step) * (step * (at as f32 + 0.5)).cos();
    let most = greatest_difference(&fluid.vorticity(), |at| Vec3::new(0.0, 0.0, exact(at % 24)));
    assert!(most < 1.0e-4, "{most}");
    let half = 0.5 * (exact(0) + exact(23));
    for x in [0.0, 1.0, 7.0] {
        assert!((fluid.vorticity_at(Vec3::new(x, 0.3, 0.3)).z - half).abs() < 1.0e-3);
    }
}

#[test]
fn the_flow_through_the_sides_is_what_expands_inside() {
    let sides = Sides { x: [Side::Inflow, Side::Open], y: [Side::Open; 2], z: [Side::FreeSlip, Side::Open] };
    let mut fluid =
        Fluid::builder([8, 9, 7]).size_m(Vec3::new(0.5, 0.7, 0.6)).sides(sides).wind(2.0 * Vec3::X).build().unwrap();
    for _ in 0..5 {
        fluid.add_expansion(Vec3::new(0.2, 0.3, 0.3), 0.2, 4.0).unwrap();
        fluid.add_heat(Vec3::new(0.2, 0.3, 0.3), 0.2, 2000.0).unwrap();
        fluid.step(0.02).unwrap();
    }
    let flows = fluid.side_flows_m3_s();
    assert!((flows[0][0] + 2.0 * 0.7 * 0.6).abs() < 1.0e-6, "{flows:?}");
    assert_eq!(flows[2][0], 0.0);
    let net: f64 = flows.iter().flatten().sum();
    let volume = f64::from(fluid.cell_size_m().element_product());
    let inside: f64 = divergence(&fluid).iter().sum::<f64>() * volume;
    println!("through the sides {net:.6} m3/s, made inside {inside:.6}");
    assert!(net > 0.01 && (net - inside).abs() < 1.0e-5 * net);
}

#[test]
fn the_heat_put_in_is_the_heat_found() {
    let mut fluid = Fluid::builder([9, 10, 8]).size_m(Vec3::new(0.5, 0.6, 0.4)).build().unwrap();
    let shape = Shape::Sphere { centre: Vec3::new(0.25, 0.2, 0.2), radius_m: 0.12 };
    fluid.attach_source(Source { heat_kw: 0.7, ..Source::new(shape) }).unwrap();
    for _ in 0..40 {
        fluid.step(0.01).unwrap();
    }
    let found = fluid.total_heat_kj();
    println!("0.7 kW for 0.4 s: {found:.5} kJ found");
    assert!((found / 0.28 - 1.0).abs() < 1.0e-3);
    fluid.fill_temperature(|_| 100.0).unwrap();
    let expected = f64::from(air_density_kg_m3(293.15)) * 1005.0 * 100.0 * 0.12e-3;
    assert!((fluid.total_heat_kj() / expected - 1.0).abs() < 1.0e-5);
}

#[test]
fn the_length_of_a_step_follows_speed_and_lift() {
    let still = |builder: FluidBuilder| builder.build().unwrap();
    assert_eq!(still(Fluid::builder([8; 3])).dt_for_cfl(1.0).unwrap(), 1.0e3);
    let windy = still(Fluid::builder([10, 5, 4]).sides(Sides::OPEN).wind(Vec3::new(2.0, 3.0, 0.0)));
    let expected = (0.1_f32 / 2.0).min(0.2 / 3.0) * 1.5;
    assert!((windy.dt_for_cfl(1.5).unwrap() / expected - 1.0).abs() < 1.0e-4);
    let report = still(Fluid::builder([10; 3]).sides(Sides::OPEN).wind(Vec3::X)).step(0.2).unwrap();
    assert!((report.cfl - 2.0).abs() < 1.0e-3);
    // From rest a cell's height is crossed in sqrt(2 h / g) at twice the ambient temperature.
    let mut hot = still(Fluid::builder([10; 3]).ambient_k(300.0));
    hot.fill_temperature(|_| 300.0).unwrap();
    assert!((hot.dt_for_cfl(1.0).unwrap() / (0.2_f32 / 9.81).sqrt() - 1.0).abs() < 1.0e-5);
    for bad in [f32::NAN, 0.0, -1.0, f32::INFINITY] {
        assert!(matches!(hot.dt_for_cfl(bad), Err(FluidError::Value { field: "cfl", .. })));
    }
}

#[test]
fn figures_allocate_nothing() {
    let mut fluid = Fluid::builder([26; 3]).sides(Sides::OPEN).build().unwrap();
    fluid.fill_velocity(random_velocity(4, 1.0)).unwrap();
    let point = Vec3::splat(0.4);
    let mut sink = 0.0;
    let used = allocation_counter::measure(|| {
        sink += fluid.mean_kinetic_energy_m2_s2() + fluid.mean_enstrophy_per_s2() + fluid.total_heat_kj();
        sink += fluid.side_flows_m3_s()[0][1] + f64::from(fluid.dt_for_cfl(1.0).unwrap());
        sink += f64::from(fluid.velocity(point).x + fluid.temperature(point) + fluid.vorticity_at(point).x);
        sink += fluid.state_hash() as f64;
    });
    assert!(sink > 0.0 && used.count_total == 0, "{}", used.count_total);
}
