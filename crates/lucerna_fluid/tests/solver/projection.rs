//! What the projection leaves, for many sizes and sides.

use lucerna_fluid::{Fluid, PressureSolver, Side, Sides, Vec3};

use crate::support::{Random, divergence, greatest, random_velocity};

const SIZES: [[usize; 3]; 9] = [
    [15, 15, 15],
    [16, 31, 17],
    [2, 2, 2],
    [3, 2, 40],
    [7, 24, 5],
    [24, 24, 24],
    [33, 20, 47],
    [31, 16, 64],
    [64, 48, 64],
];

fn sides() -> Vec<Sides> {
    use Side::{FreeSlip, Inflow, NoSlip, Open};
    vec![
        Sides::CLOSED,
        Sides::OPEN,
        Sides { y: [FreeSlip, Open], ..Sides::OPEN },
        Sides { y: [NoSlip, Open], ..Sides::CLOSED },
        Sides { x: [Inflow, Open], ..Sides::CLOSED },
        Sides { x: [Inflow, Inflow], ..Sides::CLOSED },
        Sides { x: [Open, FreeSlip], y: [Open, NoSlip], z: [FreeSlip, Open] },
    ]
}

/// A box of uneven cells with the given sides and a wild velocity.
fn wild(cells: [usize; 3], sides: Sides, pressure: PressureSolver) -> Fluid {
    let edges = Vec3::new(0.02, 0.03, 0.025);
    let size_m = edges * Vec3::from_array(cells.map(|count| count as f32));
    let wind = Vec3::new(1.5, 0.2, -0.5);
    let builder = Fluid::builder(cells).origin(Vec3::new(-3.0, 1.0, 0.5)).size_m(size_m).sides(sides).wind(wind);
    let mut fluid = builder.pressure(pressure).build().unwrap();
    fluid.fill_velocity(random_velocity(7, 2.0)).unwrap();
    fluid
}

#[test]
fn direct_projection_leaves_no_divergence_at_any_size_and_sides() {
    let mut worst = 0.0_f64;
    for cells in SIZES {
        for sides in sides() {
            let mut fluid = wild(cells, sides, PressureSolver::Direct);
            let mut random = Random(3);
            for _ in 0..3 {
                let middle = fluid.origin() + 0.5 * fluid.size_m();
                fluid.add_acceleration(middle, random.vector(2000.0)).unwrap();
                let report = fluid.step(0.02).unwrap();
                let left = greatest(&divergence(&fluid)) * 0.02 / f64::from(report.max_speed_m_s);
                worst = worst.max(left);
                assert!(left < 1.0e-4, "{cells:?} {sides:?}: {left}");
                assert!(report.divergence_after < 1.0e-4, "{cells:?} {sides:?}: {report:?}");
                assert!(report.divergence_before > 1.0e-3, "nothing to do for {cells:?} {sides:?}: {report:?}");
            }
        }
    }
    println!("greatest relative divergence after a direct projection: {worst:.2e}");
}

#[test]
fn the_reported_divergence_is_that_of_the_field() {
    for pressure in [PressureSolver::Direct, PressureSolver::GaussSeidel { sweeps: 20 }] {
        let mut fluid = wild([15, 14, 13], Sides::CLOSED, pressure);
        let report = fluid.step(0.01).unwrap();
        let found = greatest(&divergence(&fluid));
        let reported = f64::from(report.divergence_after_per_s);
        // Rounding of differences of velocities of some m/s over 2 cm.
        assert!((found - reported).abs() < 1.0e-4 + 1.0e-5 * found, "{pressure:?}: {found} against {reported}");
        let own = fluid.divergence();
        let own: Vec<f64> = own.into_iter().map(f64::from).collect();
        assert!((greatest(&own) - found).abs() < 1.0e-4 + 1.0e-5 * found);
    }
}

#[test]
fn the_reported_residual_is_what_is_left_of_what_was_there() {
    let (n, dt_s, push) = (15, 0.01, 200.0);
    let mut fluid = Fluid::builder([n; 3]).pressure(PressureSolver::GaussSeidel { sweeps: 5 }).build().unwrap();
    fluid.add_acceleration(Vec3::splat(0.5), Vec3::new(0.0, push, 0.0)).unwrap();
    let report = fluid.step(dt_s).unwrap();
    // Half the push on either face of one cell: only the cells below and above it diverge.
    let each = f64::from(0.5 * push * dt_s) * n as f64;
    let before = (2.0 * each * each).sqrt();
    let after = divergence(&fluid).iter().map(|rate| rate * rate).sum::<f64>().sqrt();
    let residual = f64::from(report.pressure_residual);
    assert!((residual / (after / before) - 1.0).abs() < 1.0e-4, "{residual} against {}", after / before);
    assert!((f64::from(report.divergence_before) - 1.0).abs() < 1.0e-5, "{report:?}");
}

#[test]
fn gauss_seidel_leaves_what_it_says_and_converges() {
    let residual = |sweeps: u32| {
        let mut fluid = wild(
            [15, 15, 15],
            Sides { y: [Side::FreeSlip, Side::Open], ..Sides::CLOSED },
            PressureSolver::GaussSeidel { sweeps },
        );
        fluid.add_acceleration(fluid.origin() + 0.5 * fluid.size_m(), Vec3::new(0.0, 1.0e5, 0.0)).unwrap();
        fluid.step(0.01).unwrap().pressure_residual
    };
    let (few, many) = (residual(20), residual(2000));
    println!("residual after 20 and 2000 Gauss-Seidel sweeps: {few:.3} and {many:.1e}");
    assert!(few > 1.0e-3, "20 sweeps left only {few}");
    assert!(many < 1.0e-4, "2000 sweeps left {many}");
}

#[test]
fn direct_and_converged_sweeps_find_the_same_flow() {
    for sides in sides() {
        let step = |pressure| {
            let mut fluid = Fluid::builder([9, 8, 7])
                .size_m(Vec3::new(0.9, 0.8, 1.4))
                .sides(sides)
                .pressure(pressure)
                .build()
                .unwrap();
            fluid.add_acceleration(Vec3::new(0.4, 0.4, 0.6), Vec3::new(50.0, 90.0, -20.0)).unwrap();
            fluid.step(0.1).unwrap();
            fluid
        };
        let (direct, sweeps) = (step(PressureSolver::Direct), step(PressureSolver::GaussSeidel { sweeps: 5000 }));
        for (a, b) in direct.face_velocities().into_iter().zip(sweeps.face_velocities()) {
            for (a, b) in a.iter().zip(b) {
                assert!((a - b).abs() < 2.0e-5, "{sides:?}: {a} against {b}");
            }
        }
    }
}

#[test]
fn expansion_becomes_the_divergence() {
    let middle = Vec3::splat(0.5);
    let mut fluid = Fluid::builder([16; 3]).sides(Sides::OPEN).build().unwrap();
    fluid.add_expansion(middle, 0.3, 40.0).unwrap();
    let report = fluid.step(0.01).unwrap();
    assert!(report.divergence_after < 1.0e-5, "{report:?}");
    let found = divergence(&fluid);
    for (at, rate) in found.into_iter().enumerate() {
        let index = Vec3::new((at % 16) as f32, (at / 16 % 16) as f32, (at / 256) as f32);
        let distance = ((index + 0.5) / 16.0).distance(middle);
        let expected = 40.0 * (1.0 - (distance / 0.3).powi(2)).max(0.0).powi(2);
        assert!((rate - f64::from(expected)).abs() < 1.0e-2, "{at}: {rate} against {expected}");
    }
    // Gas flows out on all sides; it is used up, so that the next step has none.
    assert!(fluid.velocity(Vec3::new(0.95, 0.5, 0.5)).x > 0.1);
    fluid.step(0.01).unwrap();
    assert!(greatest(&divergence(&fluid)) < 1.0e-2);
}

#[test]
fn expansion_in_a_sealed_box_acts_by_its_difference_from_the_mean() {
    let mut fluid = Fluid::builder([15; 3]).build().unwrap();
    fluid.add_expansion(Vec3::new(0.3, 0.5, 0.5), 0.2, 10.0).unwrap();
    let report = fluid.step(0.01).unwrap();
    assert!(report.divergence_after < 1.0e-5, "{report:?}");
    let found = divergence(&fluid);
    let mean = found.iter().sum::<f64>() / found.len() as f64;
    assert!(mean.abs() < 1.0e-5 && greatest(&found) > 5.0);
}
