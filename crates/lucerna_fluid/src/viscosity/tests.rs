//! The systems against their own equations.

use super::coefficients::diffusion_number;
use super::*;
use crate::sides::{GivenSides, fix_sides};
use glam::Vec3;

/// `(1 - r Dxx)(1 - r Dyy)(1 - r Dzz)` applied in `f64` to a component, with its ends.
fn applied(grid: &Grid, component: usize, values: &[f64], r: [f64; 3], wind: f64) -> Vec<f64> {
    let counts = grid.face_counts(component);
    let strides = [1, counts[0], counts[0] * counts[1]];
    let mut values = values.to_vec();
    // Where values on a side are held the factors do not commute: the last one solved comes first.
    for axis in [1, 0, 2] {
        let before = values.clone();
        for at in 0..values.len() {
            let index = |along: usize| at / strides[along] % counts[along];
            let is_on = |along: usize| along == component && [0, counts[along] - 1].contains(&index(along));
            let side = |along: usize| grid.sides[along][usize::from(index(along) > 0)];
            if (0..3).any(|along| is_on(along) && side(along).fixes_flow()) {
                continue;
            }
            let period = counts[axis] - usize::from(component == axis);
            let neighbour = |is_up: bool| {
                let i = index(axis);
                let inside = if is_up { i + 1 < counts[axis] } else { i > 0 };
                let is_circle = grid.sides[axis][0] == Side::Periodic;
                let to = |j: usize| before[at - i * strides[axis] + j * strides[axis]];
                match grid.sides[axis][usize::from(is_up)] {
                    _ if is_circle => to((i % period + if is_up { 1 } else { period - 1 }) % period),
                    _ if inside => to(if is_up { i + 1 } else { i - 1 }),
                    Side::Open if component == axis => to(if is_up { i - 1 } else { i + 1 }),
                    // On the parabola through the side's value and the last two; with one, on the line.
                    Side::NoSlip | Side::Inflow => {
                        let held = if grid.sides[axis][usize::from(is_up)] == Side::NoSlip { 0.0 } else { wind };
                        match counts[axis] {
                            1 => 2.0 * held - to(i),
                            _ => (8.0 * held - 6.0 * to(i) + to(if is_up { i - 1 } else { i + 1 })) / 3.0,
                        }
                    }
                    _ => to(i),
                }
            };
            values[at] -= r[axis] * (neighbour(true) + neighbour(false) - 2.0 * before[at]);
        }
    }
    values
}

#[test]
fn what_was_solved_gives_back_what_was_there() {
    use Side::{FreeSlip, Inflow, NoSlip, Open, Periodic};
    let cases = [
        ([5, 6, 7], [[FreeSlip; 2], [NoSlip; 2], [Open; 2]]),
        ([19, 4, 3], [[Periodic; 2], [Inflow, Open], [NoSlip, FreeSlip]]),
        ([45, 2, 2], [[Open, NoSlip], [Periodic; 2], [Periodic; 2]]),
        ([3, 40, 4], [[Inflow, Open], [NoSlip, Open], [Periodic; 2]]),
        ([24, 26, 25], [[NoSlip; 2], [Periodic; 2], [Inflow; 2]]),
        ([18, 17, 1], [[Periodic; 2], [NoSlip; 2], [FreeSlip; 2]]),
        ([1, 17, 18], [[FreeSlip; 2], [Open; 2], [Periodic; 2]]),
    ];
    let mut most = 0.0_f64;
    for (cells, sides) in cases {
        let size = Vec3::new(cells[0] as f32, 2.0 * cells[1] as f32, 0.5 * cells[2] as f32);
        let grid = Grid::new(cells, Vec3::ZERO, size, sides);
        let given = GivenSides::default();
        let walls = Walls { wind: [0.3, -0.4, 0.7], frame: [0.0; 3], given: &given, solids: None };
        let mut velocity = [0, 1, 2].map(|axis| Field::on_faces(&grid, axis));
        for (axis, field) in velocity.iter_mut().enumerate() {
            for (at, value) in field.data.iter_mut().enumerate() {
                *value = ((at * (axis + 7)) as f32 * 12.9898).sin();
            }
        }
        fix_sides(&grid, &mut velocity, walls);
        let before = velocity.clone();
        let mut spare = velocity.clone();
        let (held, mut room) = (Held::default(), Coefficients::default());
        let viscosity = Diffusivity { uniform_m2_s: 0.25, eddy_m2_s: None, density: None };
        diffuse_velocity(&grid, &mut velocity, viscosity, 3.0, walls, held, &mut spare, &mut room);
        fix_sides(&grid, &mut velocity, walls);
        // A diffusivity that might vary, but does not, gives the same.
        let (mut varying, eddies) = (before.clone(), vec![0.15; grid.count()]);
        let viscosity = Diffusivity { uniform_m2_s: 0.1, eddy_m2_s: Some(&eddies), density: None };
        diffuse_velocity(&grid, &mut varying, viscosity, 3.0, walls, held, &mut spare, &mut room);
        fix_sides(&grid, &mut varying, walls);
        for (one, other) in velocity.iter().zip(&varying) {
            for (at, (a, b)) in one.data.iter().zip(&other.data).enumerate() {
                assert!((a - b).abs() < 4.0e-6, "{cells:?} {at}: {a} against {b}");
            }
        }
        let r = [0, 1, 2].map(|along| diffusion_number(&grid, along, 0.25, 3.0));
        for (axis, (field, before)) in velocity.iter().zip(&before).enumerate() {
            let solved: Vec<f64> = field.data.iter().map(|value| f64::from(*value)).collect();
            let back = applied(&grid, axis, &solved, r, f64::from(walls.wind[axis]));
            for (at, (back, before)) in back.iter().zip(&before.data).enumerate() {
                let off = (back - f64::from(*before)).abs();
                most = most.max(off);
                assert!(off < 2.0e-5, "{cells:?} {axis} {at}: {back} against {before}");
            }
        }
    }
    println!("what was solved, put back into the equations, is off by {most:.1e} at most");
}

#[test]
fn eddies_and_solid_cells_spread_a_scalar_as_their_equations_say() {
    use Side::{FreeSlip, Periodic};
    for (cells, sides) in
        [([19, 5, 6], [[FreeSlip; 2]; 3]), ([7, 18, 26], [[Periodic; 2], [FreeSlip; 2], [Periodic; 2]])]
    {
        let grid = Grid::new(cells, Vec3::ZERO, Vec3::from_array(cells.map(|count| count as f32)), sides);
        let noise = |at: usize, scale: f32| (((at * 7) as f32 * scale).sin() * 43_758.547).fract().abs();
        let eddies: Vec<f32> = (0..grid.count()).map(|at| 2.0 * noise(at, 1.3)).collect();
        let solid: Vec<f32> = (0..grid.count()).map(|at| if noise(at, 2.7) < 0.2 { -1.0 } else { 0.0 }).collect();
        let mut field = Field::at_centres(&grid);
        field.data.iter_mut().enumerate().for_each(|(at, value)| *value = 10.0 * noise(at, 0.9));
        let (before, mut spare, mut room) = (field.clone(), field.clone(), Coefficients::default());
        let held = Held { cells: &solid, ..Held::default() };
        let diffusivity = Diffusivity { uniform_m2_s: 0.5, eddy_m2_s: Some(&eddies), density: None };
        diffuse_scalar(&grid, &mut field, diffusivity, 2.0, [[None; 2]; 3], held, &mut spare, &mut room);
        let mut values: Vec<f64> = field.data.iter().map(|value| f64::from(*value)).collect();
        let strides = [1, cells[0], cells[0] * cells[1]];
        for axis in [1, 0, 2] {
            let old = values.clone();
            for at in 0..old.len() {
                let i = at / strides[axis] % cells[axis];
                for (is_end, next) in [(i + 1 == cells[axis], i + 1), (i == 0, i + cells[axis] - 1)] {
                    if is_end && sides[axis][0] != Periodic {
                        continue;
                    }
                    let other = at - i * strides[axis] + next % cells[axis] * strides[axis];
                    if solid[at] == 0.0 && solid[other] == 0.0 {
                        let number = 2.0 * (0.5 + 0.5 * f64::from(eddies[at] + eddies[other]));
                        values[at] += number * (old[at] - old[other]);
                    }
                }
            }
        }
        let total = |field: &Field| {
            let free = field.data.iter().zip(&solid).filter(|(_, solid)| **solid == 0.0);
            free.map(|(value, _)| f64::from(*value)).sum::<f64>()
        };
        assert!((total(&field) / total(&before) - 1.0).abs() < 1.0e-6);
        for (at, (value, before)) in values.iter().zip(&before.data).enumerate() {
            assert!((value - f64::from(*before)).abs() < 1.0e-3, "{cells:?} {at}: {value} against {before}");
        }
    }
}

#[test]
fn viscosity_takes_no_momentum_from_gas_of_any_density() {
    use Side::{FreeSlip, Periodic};
    let cells = [19, 7, 9];
    let grid = Grid::new(cells, Vec3::ZERO, Vec3::ONE, [[Periodic; 2], [FreeSlip; 2], [Periodic; 2]]);
    let noise = |at: usize, scale: f32| (((at * 7) as f32 * scale).sin() * 43_758.547).fract().abs();
    let eddies: Vec<f32> = (0..grid.count()).map(|at| 0.02 * noise(at, 1.3)).collect();
    let density: Vec<f32> = (0..grid.count()).map(|at| 0.15 + 0.85 * noise(at, 2.7)).collect();
    let given = GivenSides::default();
    let walls = Walls { wind: [0.0; 3], frame: [0.0; 3], given: &given, solids: None };
    let mut velocity = [0, 1, 2].map(|axis| Field::on_faces(&grid, axis));
    for field in &mut velocity {
        field.data.iter_mut().enumerate().for_each(|(at, value)| *value = noise(at, 0.9) - 0.2);
    }
    fix_sides(&grid, &mut velocity, walls);
    // Along x, the last face of which is the first; a face holds half of each cell beside it.
    let momentum = |field: &Field| {
        let faces = field.data.iter().enumerate().filter(|(at, _)| at % 20 < 19);
        let sum = faces.map(|(at, speed)| {
            let (i, row) = (at % 20, 19 * (at / 20));
            0.5 * f64::from(density[row + i] + density[row + (i + 18) % 19]) * f64::from(*speed)
        });
        sum.sum::<f64>()
    };
    let energy = |field: &Field| field.data.iter().map(|speed| f64::from(speed * speed)).sum::<f64>();
    let (before, still) = (momentum(&velocity[0]), energy(&velocity[0]));
    let viscosity = Diffusivity { uniform_m2_s: 0.01, eddy_m2_s: Some(&eddies), density: Some(&density) };
    let mut spare = velocity.clone();
    let (held, mut room) = (Held::default(), Coefficients::default());
    diffuse_velocity(&grid, &mut velocity, viscosity, 0.3, walls, held, &mut spare, &mut room);
    let off = momentum(&velocity[0]) / before - 1.0;
    println!("momentum of gas 0.15 to 1 times as dense as air: off by {off:.1e}");
    assert!(off.abs() < 1.0e-6 && energy(&velocity[0]) < 0.8 * still, "{off}");
}
