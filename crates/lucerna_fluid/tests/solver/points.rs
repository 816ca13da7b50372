//! Points that the air carries.

use lucerna_fluid::{Fluid, FluidError, Side, Sides, Vec3};

use crate::support::{Random, random_velocity};

/// Solid rotation about the middle of a unit box, which trilinear sampling gives exactly.
fn rotation() -> Fluid {
    let mut fluid = Fluid::builder([16, 16, 4]).sides(Sides::OPEN).build().unwrap();
    fluid.fill_velocity(|point| Vec3::new(0.5 - point.y, point.x - 0.5, 0.0)).unwrap();
    fluid
}

#[test]
fn paths_close_at_second_and_fourth_order() {
    let fluid = rotation();
    let start = Vec3::new(0.75, 0.5, 0.5);
    let miss = |steps: u32, is_fourth: bool| {
        let mut points = [start];
        let dt_s = std::f32::consts::TAU / steps as f32;
        for _ in 0..steps {
            if is_fourth { fluid.advect_points_rk4(&mut points, dt_s) } else { fluid.advect_points(&mut points, dt_s) }
        }
        (points[0] - start).length()
    };
    let second = [miss(25, false), miss(50, false)];
    let fourth = [miss(8, true), miss(16, true)];
    println!("after a turn, midpoint rule {second:.6?}, fourth order {fourth:.6?}");
    assert!((3.5..4.7).contains(&(second[0] / second[1])));
    assert!((12.0..22.0).contains(&(fourth[0] / fourth[1])));
    // And back again.
    let mut points = [start];
    fluid.advect_points_rk4(&mut points, 0.3);
    fluid.advect_points_rk4(&mut points, -0.3);
    assert!((points[0] - start).length() < 1.0e-5);
}

#[test]
fn many_points_move_as_each_does_alone_on_any_number_of_threads() {
    let sides = Sides { x: [Side::Open; 2], ..Sides::CLOSED };
    let mut fluid = Fluid::builder([11, 7, 9]).origin(Vec3::new(-4.0, 0.5, 7.0)).sides(sides).build().unwrap();
    fluid.fill_velocity(random_velocity(8, 3.0)).unwrap();
    let mut random = Random(2);
    let starts: Vec<Vec3> = (0..5003).map(|_| fluid.origin() + Vec3::splat(0.5) + random.vector(0.8)).collect();
    let alone: Vec<[Vec3; 3]> = starts
        .iter()
        .map(|start| {
            let (mut second, mut fourth) = ([*start], [*start]);
            fluid.advect_points(&mut second, 0.1);
            fluid.advect_points_rk4(&mut fourth, 0.1);
            [second[0], fourth[0], fluid.velocity(*start)]
        })
        .collect();
    for threads in [1, 2, 3, 16] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (mut second, mut fourth, mut sampled) = (starts.clone(), starts.clone(), starts.clone());
            fluid.advect_points(&mut second, 0.1);
            fluid.advect_points_rk4(&mut fourth, 0.1);
            fluid.sample_velocities(&starts, &mut sampled).unwrap();
            for (at, expected) in alone.iter().enumerate() {
                assert_eq!([second[at], fourth[at], sampled[at]], *expected, "{at}");
            }
        });
    }
}

#[test]
fn a_periodic_box_repeats_for_points_and_samples() {
    let sides = Sides { x: [Side::Periodic; 2], z: [Side::Periodic; 2], ..Sides::CLOSED };
    let mut fluid =
        Fluid::builder([8, 6, 5]).size_m(Vec3::new(2.0, 1.0, 1.25)).sides(sides).scalar("dye").build().unwrap();
    let dye = fluid.scalar_id("dye").unwrap();
    fluid.fill_velocity(random_velocity(3, 1.0)).unwrap();
    fluid.fill_temperature(|point| 10.0 * (point.x - 1.0)).unwrap();
    fluid.fill_scalar(dye, |point| point.z).unwrap();
    let period = Vec3::new(2.0, 0.0, -1.25);
    let mut random = Random(5);
    for _ in 0..50 {
        let point = Vec3::new(1.0, 0.5, 0.6) + random.vector(0.9);
        let away = point + 3.0 * period;
        assert!((fluid.velocity(point) - fluid.velocity(away)).length() < 1.0e-4);
        assert!((fluid.temperature(point) - fluid.temperature(away)).abs() < 1.0e-3);
        assert!((fluid.scalar(dye, point) - fluid.scalar(dye, away)).abs() < 1.0e-4);
        let (mut here, mut there) = ([point], [away]);
        fluid.advect_points(&mut here, 0.3);
        fluid.advect_points(&mut there, 0.3);
        assert!((here[0] + 3.0 * period - there[0]).length() < 1.0e-4);
    }
    // Halfway between the last centre and the first it is their mean.
    assert!(fluid.temperature(Vec3::new(0.0, 0.5, 0.6)).abs() < 1.0e-4);
    assert!((fluid.temperature(Vec3::new(1.9375, 0.5, 0.6)) - 0.5 * 8.75).abs() < 1.0e-4);
    assert!(fluid.velocity(Vec3::splat(f32::INFINITY)).is_finite() && fluid.velocity(Vec3::NAN).is_finite());
    assert!(fluid.scalar(dye, Vec3::NAN).is_finite() && fluid.vorticity_at(Vec3::splat(-f32::MAX)).is_finite());
}

#[test]
fn points_that_are_no_numbers_or_far_away_do_no_harm() {
    let fluid = rotation();
    let far = [f32::MAX, -f32::MAX, 1.0e30, -1.0e6].map(Vec3::splat);
    let none = [Vec3::NAN, Vec3::splat(f32::INFINITY), Vec3::new(0.5, f32::NEG_INFINITY, f32::NAN)];
    let neighbour = Vec3::new(0.3, 0.4, 0.5);
    for dt_s in [0.1, 1.0e3, f32::INFINITY, f32::NAN, -5.0] {
        let mut points = [far.as_slice(), &[neighbour], &none].concat();
        let mut expected = [neighbour];
        fluid.advect_points(&mut points, dt_s);
        fluid.advect_points_rk4(&mut points, dt_s);
        fluid.advect_points(&mut expected, dt_s);
        fluid.advect_points_rk4(&mut expected, dt_s);
        assert_eq!(points[4], expected[0]);
        assert!(points[..5].iter().all(|point| point.is_finite()), "{points:?}");
        assert!(points[5..].iter().all(|point| !point.is_finite()));
        let mut velocities = vec![Vec3::ZERO; points.len()];
        fluid.sample_velocities(&points, &mut velocities).unwrap();
        assert!(velocities.iter().all(|velocity| velocity.is_finite()));
    }
    let mut short = [Vec3::ONE; 2];
    let error = FluidError::Length { field: "velocities_m_s", found: 2, expected: 4 };
    assert_eq!(fluid.sample_velocities(&far, &mut short), Err(error));
    assert_eq!(short, [Vec3::ONE; 2]);
}
