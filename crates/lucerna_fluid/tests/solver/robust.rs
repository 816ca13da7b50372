//! Any step, any number of threads.

use lucerna_fluid::{Fluid, MAX_SPEED_M_S, PressureSolver, Side, Sides, Vec3};

use crate::support::{Random, random_velocity};

#[test]
fn any_length_of_step_stays_finite_and_makes_no_energy() {
    let open = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
    let solvers = [PressureSolver::Direct, PressureSolver::GaussSeidel { sweeps: 20 }];
    for dt_s in [1.0e-6, 1.0e-3, 1.0 / 60.0, 0.5, 10.0, 1.0e3] {
        for sides in [Sides::CLOSED, open, Sides::all(Side::NoSlip)] {
            for pressure in solvers {
                let mut fluid = Fluid::builder([12, 9, 11]).sides(sides).pressure(pressure).build().unwrap();
                fluid.fill_velocity(random_velocity(11, 5.0)).unwrap();
                let before = fluid.mean_kinetic_energy_m2_s2();
                for step in 0..100 {
                    fluid.step(dt_s).unwrap();
                    let now = fluid.mean_kinetic_energy_m2_s2();
                    assert!(
                        now.is_finite() && now <= 1.25 * before,
                        "{sides:?} {pressure:?} dt {dt_s} step {step}: {now} of {before}"
                    );
                }
            }
        }
    }
}

/// Eddies and jets near a corner, and very long steps: traces from all over the box end in the
/// fast air there, and without the bound on energy these three starts gain four to five times.
#[test]
fn long_steps_make_no_energy_out_of_an_eddy() {
    let starts = [
        (12, 83.0, Vec3::new(0.08, 0.97, 0.155), 0.21, Vec3::new(2.0, 1.6, -0.1), true),
        (8, 55.0, Vec3::new(0.16, 0.616, 0.88), 0.14, Vec3::new(4.5, 0.4, 4.5), true),
        (17, 67.0, Vec3::new(0.45, 0.93, 0.07), 0.075, Vec3::new(-2.4, -4.4, 1.05), false),
    ];
    let mut most = 0.0_f64;
    for (n, dt_s, centre, width, strength, is_eddy) in starts {
        for dt_s in [dt_s, 0.8 * dt_s, 0.5 * dt_s, 0.1] {
            let mut fluid = Fluid::builder([n; 3]).build().unwrap();
            let start = |point: Vec3| {
                let away = (point - centre) / width;
                let flow = if is_eddy { strength.cross(away) } else { strength };
                flow * (-away.length_squared()).exp()
            };
            fluid.fill_velocity(start).unwrap();
            let before = fluid.mean_kinetic_energy_m2_s2();
            for _ in 0..30 {
                fluid.step(dt_s).unwrap();
                most = most.max(fluid.mean_kinetic_energy_m2_s2() / before);
            }
        }
    }
    println!("greatest energy in long steps: {most:.4} of the start");
    assert!(most <= 1.001, "{most}");
}

#[test]
fn any_length_of_step_stays_finite_with_everything_on() {
    for dt_s in [1.0e-6, 1.0 / 60.0, 1.0, 1.0e3] {
        for sides in [Sides::CLOSED, Sides::OPEN, Sides { x: [Side::Inflow, Side::Open], ..Sides::CLOSED }] {
            let mut fluid = Fluid::builder([9, 12, 10])
                .size_m(Vec3::new(0.3, 0.5, 0.2))
                .sides(sides)
                .viscosity_m2_s(0.01)
                .vorticity_confinement(10.0)
                .cooling_per_s(0.5)
                .build()
                .unwrap();
            fluid.set_wind(Vec3::new(40.0, -3.0, 9.0)).unwrap();
            let mut random = Random(5);
            for _ in 0..60 {
                let point = fluid.size_m() * random.next();
                fluid.add_heat(point, 0.1, 1.0e6).unwrap();
                fluid.add_expansion(point, 0.1, 1.0e4).unwrap();
                fluid.add_acceleration(point, random.vector(1.0e6)).unwrap();
                fluid.add_row_acceleration(3, -1.0e6).unwrap();
                let report = fluid.step(dt_s).unwrap();
                assert!(report.max_speed_m_s <= 1.001 * MAX_SPEED_M_S, "{report:?}");
                let all = fluid.face_velocities().into_iter().chain([fluid.temperatures()]);
                assert!(all.flatten().all(|value| value.is_finite()), "{sides:?} dt {dt_s}");
            }
        }
    }
}

#[test]
fn one_thread_and_seven_give_the_same_bits() {
    let hash = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let sides = Sides { x: [Side::Inflow, Side::Open], y: [Side::NoSlip, Side::Open], z: [Side::FreeSlip; 2] };
            let mut fluid = Fluid::builder([26, 24, 25])
                .sides(sides)
                .wind(Vec3::new(0.5, 0.0, 0.0))
                .viscosity_m2_s(1.0e-4)
                .vorticity_confinement(2.0)
                .build()
                .unwrap();
            let mut random = Random(9);
            for _ in 0..20 {
                fluid.add_heat(Vec3::new(0.5, 0.1, 0.4), 0.15, 3000.0).unwrap();
                fluid.add_acceleration(Vec3::splat(0.4), random.vector(100.0)).unwrap();
                fluid.add_expansion(Vec3::new(0.6, 0.2, 0.4), 0.1, 5.0).unwrap();
                fluid.step(1.0 / 60.0).unwrap();
            }
            fluid.state_hash()
        })
    };
    let one = hash(1);
    assert_eq!(one, hash(2));
    assert_eq!(one, hash(7));
}

#[test]
fn reset_goes_back_to_the_start() {
    let mut fluid = Fluid::builder([15; 3]).sides(Sides::OPEN).wind(Vec3::X).build().unwrap();
    let run = |fluid: &mut Fluid| {
        for _ in 0..10 {
            fluid.add_heat(Vec3::splat(0.4), 0.2, 2000.0).unwrap();
            fluid.step(0.02).unwrap();
        }
        fluid.state_hash()
    };
    let start = fluid.state_hash();
    let first = run(&mut fluid);
    assert_ne!(first, start);
    fluid.add_heat(Vec3::splat(0.4), 0.2, 2000.0).unwrap();
    fluid.reset();
    assert_eq!(fluid.state_hash(), start);
    assert_eq!(run(&mut fluid), first);
}
