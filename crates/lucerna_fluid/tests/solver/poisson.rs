//! The pressure solver on plain arrays, and what it leaves in every kind of box.

use std::f64::consts::PI;

use lucerna_fluid::{Fluid, FluidError, PoissonSolver, Side, Sides, Vec3};

use crate::support::{Random, divergence, random_velocity};

const PAIRS: [[Side; 2]; 5] = [
    [Side::FreeSlip, Side::NoSlip],
    [Side::Open, Side::Open],
    [Side::Inflow, Side::Open],
    [Side::Open, Side::FreeSlip],
    [Side::Periodic, Side::Periodic],
];

/// One of the 125 combinations of sides; free to slide along an axis with one cell.
fn combination(number: usize, cells: [usize; 3]) -> Sides {
    let pair = |axis: usize| {
        if cells[axis] == 1 { [Side::FreeSlip; 2] } else { PAIRS[number / [1, 5, 25][axis] % 5] }
    };
    Sides { x: pair(0), y: pair(1), z: pair(2) }
}

fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0_f64);
    for value in values {
        sum += value * value;
        count += 1.0;
    }
    (sum / count.max(1.0)).sqrt()
}

fn rms_speed(velocity: [&[f32]; 3]) -> f64 {
    velocity.into_iter().map(|values| rms(values.iter().map(|value| f64::from(*value))).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn a_projection_leaves_rounding_in_a_box_of_any_size_and_sides() {
    let sizes: [([usize; 3], usize); 13] = [
        ([15, 15, 15], 1),
        ([16, 16, 16], 1),
        ([31, 31, 31], 3),
        ([32, 32, 32], 3),
        ([64, 64, 64], 21),
        ([100, 100, 100], 62),
        ([128, 128, 128], 62),
        ([17, 40, 23], 2),
        ([2, 9, 70], 2),
        ([1, 64, 48], 2),
        ([48, 1, 33], 2),
        ([50, 15, 1], 2),
        ([128, 128, 1], 2),
    ];
    let edges = Vec3::new(0.02, 0.025, 0.02);
    for (cells, spacing) in sizes {
        let mut worst = 0.0_f64;
        for number in (0..125).step_by(spacing) {
            let sides = combination(number, cells);
            let size_m = edges * Vec3::from_array(cells.map(|count| count as f32));
            let mut fluid = Fluid::builder(cells).size_m(size_m).sides(sides).build().unwrap();
            fluid.fill_velocity(random_velocity(5, 2.0)).unwrap();
            let left = 0.02 * rms(divergence(&fluid)) / rms_speed(fluid.face_velocities());
            worst = worst.max(left);
            assert!(left < 2.0e-5, "{cells:?} {sides:?}: {left}");
            assert!(fluid.max_speed_m_s() > 0.1);
        }
        println!("{cells:?}: h rms(div u) / rms(u) at most {worst:.1e}");
    }
}

#[test]
fn the_reported_rms_divergence_is_that_of_the_field() {
    for sides in [Sides::OPEN, Sides::CLOSED, Sides::PERIODIC] {
        let mut fluid = Fluid::builder([15, 14, 13]).sides(sides).build().unwrap();
        let shortest_m = f64::from(fluid.cell_size_m().min_element());
        // Air that is pushed apart: the speeds after are those that the figures refer to.
        fluid.add_expansion(Vec3::splat(0.5), 0.4, 30.0).unwrap();
        let report = fluid.step(0.01).unwrap();
        let found = divergence(&fluid);
        let speed = rms_speed(fluid.face_velocities());
        assert!((f64::from(report.rms_speed_m_s) / speed - 1.0).abs() < 1.0e-5, "{report:?} {speed}");
        // Of the expansion only what the open sides let out is there.
        let mut expected = Vec::new();
        for k in 0..13 {
            for j in 0..14 {
                for i in 0..15 {
                    let index = Vec3::new(i as f32, j as f32, k as f32);
                    let point = (index + 0.5) * fluid.cell_size_m();
                    let distance = point.distance(Vec3::splat(0.5));
                    expected.push(30.0 * f64::from((1.0 - (distance / 0.4).powi(2)).max(0.0).powi(2)));
                }
            }
        }
        let mean = expected.iter().sum::<f64>() / expected.len() as f64;
        let mean = if sides == Sides::OPEN { 0.0 } else { mean };
        let missing = found.iter().zip(&expected).map(|(found, expected)| found - (expected - mean));
        let recomputed = rms(missing);
        let reported = f64::from(report.rms_divergence_after_per_s);
        assert!((recomputed - reported).abs() < 2.0e-5, "{sides:?}: {reported} against {recomputed}");
        let relative = f64::from(report.rms_divergence_after) * speed / shortest_m;
        assert!((relative / reported - 1.0).abs() < 1.0e-4, "{sides:?}: {relative} against {reported}");
        let before = f64::from(report.rms_divergence_before) * speed / shortest_m;
        let all = rms(expected.iter().map(|rate| rate - mean));
        assert!((before / all - 1.0).abs() < 1.0e-4, "{sides:?}: {before} against {all}");
    }
}

/// Solid cells in many shapes, by name.
fn obstacles([nx, ny, nz]: [usize; 3]) -> Vec<(&'static str, Vec<bool>)> {
    let mut random = Random(11);
    let noise: Vec<f32> = (0..nx * ny * nz).map(|_| random.next()).collect();
    let cells = |is_solid: &dyn Fn(usize, usize, usize) -> bool| -> Vec<bool> {
        (0..nx * ny * nz).map(|cell| is_solid(cell % nx, cell / nx % ny, cell / (nx * ny))).collect()
    };
    let from_middle = |i: usize, count: usize| (i as f32 + 0.5) / count as f32 - 0.5;
    let ball = |i: usize, j: usize, k: usize| {
        [from_middle(i, nx), from_middle(j, ny), from_middle(k, nz)].iter().map(|x| x * x).sum::<f32>() < 0.06
    };
    let brick = |i: usize, j: usize, k: usize| {
        [from_middle(i, nx), from_middle(j, ny), from_middle(k, nz)].iter().all(|x| x.abs() < 0.2)
    };
    vec![
        ("ball", cells(&ball)),
        ("brick", cells(&brick)),
        ("two chambers", cells(&|i, _, _| i == nx / 3)),
        ("thin wall with a gap", cells(&|i, j, _| i == nx / 3 && j > ny / 4)),
        ("a tenth of the cells", noise.iter().map(|value| *value < 0.1).collect()),
        ("a third of the cells", noise.iter().map(|value| *value < 0.33).collect()),
        ("all but single cells", cells(&|i, j, k| (i + j + k) % 2 == 0 || i % 2 == 0)),
        ("all", cells(&|_, _, _| true)),
    ]
}

#[test]
fn a_projection_around_obstacles_leaves_little() {
    let sizes = [([15, 15, 15], 4), ([16, 31, 12], 7), ([32, 32, 32], 24), ([64, 64, 64], 124), ([40, 50, 1], 6)];
    let mut most: Vec<(&str, u32, f64)> = Vec::new();
    for (cells, spacing) in sizes {
        let [nx, ny, nz] = cells;
        for number in (0..125).step_by(spacing) {
            let sides = combination(number, cells);
            let size_m = 0.02 * Vec3::from_array(cells.map(|count| count as f32));
            let mut solver = PoissonSolver::new(cells, size_m, sides).unwrap();
            for (name, solid) in obstacles(cells) {
                solver.set_solid(&solid).unwrap();
                let mut random = Random(9);
                let mut velocity = [(nx + 1) * ny * nz, nx * (ny + 1) * nz, nx * ny * (nz + 1)]
                    .map(|count| (0..count).map(|_| 2.0 * random.next() - 1.0).collect::<Vec<f32>>());
                shut(cells, sides, &solid, &mut velocity);
                let [u, v, w] = &mut velocity;
                let mut values = vec![0.0; solid.len()];
                solver.divergence([u, v, w], &mut values).unwrap();
                let iterations = solver.solve(&mut values).unwrap();
                assert!(values.iter().all(|value| value.is_finite()), "{name} {cells:?} {sides:?}");
                solver.subtract_gradient(&values, [u, v, w]).unwrap();
                solver.divergence([u, v, w], &mut values).unwrap();
                let fluid = values.iter().zip(&solid).filter(|(_, solid)| !**solid).map(|(rate, _)| f64::from(*rate));
                let (left, speed) = (0.02 * rms(fluid), rms_speed([u, v, w]));
                // Where all cells are shut in, nothing moves.
                let relative = if speed > 1.0e-4 { left / speed } else { 0.0 };
                assert!(relative < 1.0e-4, "{name} {cells:?} {sides:?}: {relative} after {iterations}");
                match most.iter_mut().find(|found| found.0 == name) {
                    Some(found) => *found = (name, found.1.max(iterations), found.2.max(relative)),
                    None => most.push((name, iterations, relative)),
                }
            }
        }
    }
    for (name, iterations, left) in most {
        println!("{name}: at most {iterations} iterations, h rms(div u) / rms(u) at most {left:.1e}");
    }
}

/// Stops the flow through closed sides and the faces of solid cells; makes periodic faces agree.
fn shut(cells: [usize; 3], sides: Sides, solid: &[bool], velocity: &mut [Vec<f32>; 3]) {
    let [nx, ny, _] = cells;
    let at = |[i, j, k]: [usize; 3]| i + nx * (j + ny * k);
    for (axis, values) in velocity.iter_mut().enumerate() {
        let ends = [sides.x, sides.y, sides.z][axis];
        let mut counts = cells;
        counts[axis] += 1;
        let strides = [1, counts[0], counts[0] * counts[1]];
        for face in 0..values.len() {
            let index = [face % counts[0], face / counts[0] % counts[1], face / (counts[0] * counts[1])];
            let n = cells[axis];
            let end = if index[axis] == 0 { Some(0) } else { (index[axis] == n).then_some(1) };
            let beside = |place: usize| {
                let mut index = index;
                index[axis] = place;
                solid[at(index)]
            };
            values[face] = match end {
                Some(_) if ends[0] == Side::Periodic => {
                    let first = values[face - index[axis] * strides[axis]];
                    if beside(0) || beside(n - 1) { 0.0 } else { first }
                }
                Some(end) if ends[end] != Side::Open || beside(end * (n - 1)) => 0.0,
                Some(_) => values[face],
                None if beside(index[axis]) || beside(index[axis] - 1) => 0.0,
                None => values[face],
            };
        }
    }
}

#[test]
fn a_known_solution_is_met_to_second_order() {
    use Side::{FreeSlip, Inflow, NoSlip, Open, Periodic};
    // By pair of sides: a wave that fits, and its wave number.
    let waves: [([Side; 2], f64, bool); 5] = [
        ([FreeSlip, NoSlip], 2.0 * PI, true),
        ([Open, Open], PI, false),
        ([Inflow, Open], 0.5 * PI, true),
        ([Open, FreeSlip], 0.5 * PI, false),
        ([Periodic, Periodic], 2.0 * PI, false),
    ];
    for first in 0..5 {
        let axes = [waves[first], waves[(first + 1) % 5], waves[(first + 3) % 5]];
        let sides = Sides { x: axes[0].0, y: axes[1].0, z: axes[2].0 };
        let error = |n: usize| {
            let cells = [n, n + n / 4, n - n / 4];
            let mut solver = PoissonSolver::new(cells, Vec3::ONE, sides).unwrap();
            let exact: Vec<f64> = (0..cells.iter().product())
                .map(|cell: usize| {
                    let index = [cell % cells[0], cell / cells[0] % cells[1], cell / (cells[0] * cells[1])];
                    let wave = |axis: usize| {
                        let phase = axes[axis].1 * (index[axis] as f64 + 0.5) / cells[axis] as f64;
                        if axes[axis].2 { phase.cos() } else { phase.sin() }
                    };
                    wave(0) * wave(1) * wave(2)
                })
                .collect();
            let rate = -axes.iter().map(|axis| axis.1 * axis.1).sum::<f64>();
            let mut values: Vec<f32> = exact.iter().map(|value| (rate * value) as f32).collect();
            solver.solve(&mut values).unwrap();
            rms(values.iter().zip(&exact).map(|(found, exact)| f64::from(*found) - exact))
        };
        let (coarse, fine) = (error(16), error(32));
        let order = (coarse / fine).log2();
        println!("{sides:?}: error {coarse:.1e} and {fine:.1e}, order {order:.2}");
        assert!((1.9..2.6).contains(&order), "{sides:?}: order {order}");
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let mut solver = PoissonSolver::new([4, 5, 6], Vec3::ONE, Sides::OPEN).unwrap();
    let expected = FluidError::Length { field: "values", found: 119, expected: 120 };
    assert_eq!(solver.solve(&mut [0.0; 119]), Err(expected));
    assert!(solver.set_solid(&[true; 121]).is_err());
    let mut values = vec![1.0; 120];
    values[7] = f32::NAN;
    assert!(matches!(solver.solve(&mut values), Err(FluidError::Value { field: "values", .. })));
    assert_eq!(values[0], 1.0);
    let (mut u, mut v, mut w) = ([0.0; 150], [0.0; 144], [0.0; 140]);
    assert!(solver.divergence([&u, &v, &w], &mut values).is_ok());
    let error = solver.divergence([&u, &v[1..], &w], &mut values);
    assert_eq!(error, Err(FluidError::Length { field: "velocity across y", found: 143, expected: 144 }));
    values[3] = f32::INFINITY;
    assert!(solver.subtract_gradient(&values, [&mut u, &mut v, &mut w]).is_err());
    assert!(PoissonSolver::new([0, 4, 4], Vec3::ONE, Sides::OPEN).is_err());
    assert!(PoissonSolver::new([4, 4, 4], Vec3::NAN, Sides::OPEN).is_err());
}
