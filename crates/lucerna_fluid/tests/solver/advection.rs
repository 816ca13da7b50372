//! What carrying keeps: mass, extremes, energy, symmetry, bits.

use std::f32::consts::PI;

use lucerna_fluid::{Advection, Fluid, FluidError, ScalarAdvection, Side, Sides, SimdLevel, Trace, Vec3, ops};

use crate::support::{Random, random_velocity};

const VELOCITY_SCHEMES: [Advection; 5] = [
    Advection::SemiLagrangian,
    Advection::MacCormack,
    Advection::Reflection,
    Advection::Cubic,
    Advection::Conservative,
];
const SCALAR_SCHEMES: [ScalarAdvection; 4] =
    [ScalarAdvection::Flux, ScalarAdvection::SemiLagrangian, ScalarAdvection::MacCormack, ScalarAdvection::Cubic];

fn carry(advection: ScalarAdvection) -> ops::Carry {
    ops::Carry { advection, ..ops::Carry::default() }
}

fn sum(values: &[f32]) -> f64 {
    values.iter().map(|value| f64::from(*value)).sum()
}

fn extremes(values: &[f32]) -> (f32, f32) {
    values.iter().fold((f32::MAX, f32::MIN), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// Turns about the middle of a unit square once a second, in a box that is flat along z.
fn turning(shape: &ops::Shape) -> [Vec<f32>; 3] {
    let omega = 2.0 * PI;
    shape.fill_faces(|point| omega * Vec3::new(0.5 - point.y, point.x - 0.5, 0.0))
}

/// The slotted disk of S. Zalesak (J. Comput. Phys. 31, 1979): radius 0.15 about (0.5, 0.75),
/// slot 0.05 wide and 0.25 deep.
fn slotted_disk(point: Vec3) -> f32 {
    let is_in_disk = (point.x - 0.5).hypot(point.y - 0.75) < 0.15;
    let is_in_slot = (point.x - 0.5).abs() < 0.025 && point.y < 0.85;
    if is_in_disk && !is_in_slot { 1.0 } else { 0.0 }
}

fn gaussian(point: Vec3) -> f32 {
    (-((point.x - 0.5).powi(2) + (point.y - 0.75).powi(2)) / (2.0 * 0.06_f32.powi(2))).exp()
}

#[test]
fn a_turn_keeps_mass_and_makes_no_extremes() {
    let shape = ops::Shape::new([100, 100, 1], Vec3::new(1.0, 1.0, 0.01), Sides::CLOSED).unwrap();
    let velocity = turning(&shape);
    for (name, start) in [("slotted disk", slotted_disk as fn(Vec3) -> f32), ("Gaussian", gaussian)] {
        let start = shape.fill_cells(start);
        for advection in SCALAR_SCHEMES {
            let mut values = start.clone();
            // The disk's edge moves two cells a step.
            for _ in 0..125 {
                ops::advect_cells(&shape, velocity.each_ref(), 1.0 / 125.0, &mut values, carry(advection)).unwrap();
            }
            let mass = sum(&values) / sum(&start) - 1.0;
            let (low, high) = extremes(&values);
            let off: f64 = values.iter().zip(&start).map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / sum(&start);
            println!(
                "{name}, one turn, {advection:?}: mass {:+.2} %, {low:.1e} to {high:.3}, off by {off:.3}",
                100.0 * mass
            );
            let allowed = match advection {
                ScalarAdvection::Flux => 1.0e-3,
                ScalarAdvection::SemiLagrangian => 0.01,
                ScalarAdvection::MacCormack | ScalarAdvection::Cubic => 0.06,
            };
            assert!(mass.abs() < allowed, "{name} {advection:?}: mass {mass}");
            assert!(low >= -1.0e-6 && high <= 1.0 + 1.0e-6, "{name} {advection:?}: {low} to {high}");
        }
    }
}

#[test]
fn straight_traces_lose_mass_in_a_turn() {
    let shape = ops::Shape::new([100, 100, 1], Vec3::new(1.0, 1.0, 0.01), Sides::CLOSED).unwrap();
    let velocity = turning(&shape);
    let start = shape.fill_cells(gaussian);
    let after = |trace| {
        let mut values = start.clone();
        let carry = ops::Carry { advection: ScalarAdvection::SemiLagrangian, trace, ..ops::Carry::default() };
        for _ in 0..125 {
            ops::advect_cells(&shape, velocity.each_ref(), 1.0 / 125.0, &mut values, carry).unwrap();
        }
        sum(&values) / sum(&start) - 1.0
    };
    let (euler, midpoint) = (after(Trace::Euler), after(Trace::Midpoint));
    println!("mass after one turn: {:+.1} % straight, {:+.2} % by the midpoint", 100.0 * euler, 100.0 * midpoint);
    assert!(euler < -0.1 && midpoint.abs() < 0.01);
}

#[test]
fn a_wind_of_whole_cells_moves_values_exactly() {
    let shape = ops::Shape::new([12, 9, 7], Vec3::new(12.0, 9.0, 7.0), Sides::PERIODIC).unwrap();
    let mut random = Random(3);
    let start: Vec<f32> = (0..12 * 9 * 7).map(|_| random.next()).collect();
    for shift in [[1_i32, 0, 0], [0, -1, 0], [0, 0, 1], [3, -2, 4], [-20, 9, 5]] {
        let wind = Vec3::new(shift[0] as f32, shift[1] as f32, shift[2] as f32);
        let velocity = shape.fill_faces(|_| wind);
        for advection in SCALAR_SCHEMES {
            if advection == ScalarAdvection::Flux && wind.abs().element_sum() > 1.0 {
                continue;
            }
            let mut values = start.clone();
            ops::advect_cells(&shape, velocity.each_ref(), 1.0, &mut values, carry(advection)).unwrap();
            for (at, value) in values.iter().enumerate() {
                let from = |index: usize, count: usize, axis: usize| {
                    (index as i32 - shift[axis]).rem_euclid(count as i32) as usize
                };
                let (i, j, k) = (from(at % 12, 12, 0), from(at / 12 % 9, 9, 1), from(at / 108, 7, 2));
                let expected = start[i + 12 * (j + 9 * k)];
                if advection == ScalarAdvection::Flux {
                    assert!((value - expected).abs() < 1.0e-6, "{advection:?} {shift:?} at {at}: {value} {expected}");
                } else {
                    assert_eq!(*value, expected, "{advection:?} {shift:?} at {at}");
                }
            }
        }
        // The grid moving with the wind sees nothing move.
        for advection in SCALAR_SCHEMES {
            let mut values = start.clone();
            let carry = ops::Carry { frame_velocity_m_s: wind, ..carry(advection) };
            ops::advect_cells(&shape, velocity.each_ref(), 1.0, &mut values, carry).unwrap();
            assert_eq!(values, start, "{advection:?}");
        }
    }
}

/// Random flow with divergence, random values, any step: nothing beyond what there was, and what
/// is even stays even.
#[test]
fn no_scheme_makes_new_extremes() {
    let sides = [Sides::CLOSED, Sides::OPEN, Sides::PERIODIC, Sides { x: [Side::Inflow, Side::Open], ..Sides::CLOSED }];
    for (seed, sides) in sides.into_iter().enumerate() {
        let shape = ops::Shape::new([11, 16, 9], Vec3::new(1.1, 1.6, 1.8), sides).unwrap();
        let mut random = Random(seed as u64);
        let mut velocity = shape.fill_faces(|_| Vec3::ZERO);
        velocity.iter_mut().flatten().for_each(|value| *value = 4.0 * random.next() - 2.0);
        let start: Vec<f32> = (0..11 * 16 * 9).map(|_| random.next()).collect();
        for advection in SCALAR_SCHEMES {
            for dt_s in [1.0e-3, 0.05, 0.3, 2.0] {
                let carry = ops::Carry { outside: 0.5, ..carry(advection) };
                let mut values = start.clone();
                ops::advect_cells(&shape, velocity.each_ref(), dt_s, &mut values, carry).unwrap();
                let ((low, high), (least, most)) = (extremes(&values), extremes(&start));
                assert!(
                    low >= least - 1.0e-6 && high <= most + 1.0e-6,
                    "{advection:?} {sides:?} {dt_s}: {low} to {high} from {least} to {most}"
                );
                let mut even = vec![0.5; start.len()];
                ops::advect_cells(&shape, velocity.each_ref(), dt_s, &mut even, carry).unwrap();
                assert!(even.iter().all(|value| *value == 0.5), "{advection:?} {sides:?} {dt_s}");
            }
        }
    }
}

/// Energy of the Taylor-Green vortex in a free-slip box at t = 2, of that at the start.
fn taylor_green(n: usize, advection: Advection, trace: Trace) -> f64 {
    let builder = Fluid::builder([n, n, 1]).size_m(Vec3::new(1.0, 1.0, 1.0 / n as f32)).advection(advection);
    let mut fluid = builder.trace(trace).build().unwrap();
    let vortex = |point: Vec3| {
        let (x, y) = (PI * point.x, PI * point.y);
        Vec3::new(x.sin() * y.cos(), -x.cos() * y.sin(), 0.0)
    };
    fluid.fill_velocity(vortex).unwrap();
    let before = fluid.mean_kinetic_energy_m2_s2();
    for _ in 0..2 * n {
        fluid.step(1.0 / n as f32).unwrap();
    }
    fluid.mean_kinetic_energy_m2_s2() / before
}

#[test]
fn an_inviscid_vortex_keeps_its_energy() {
    for advection in VELOCITY_SCHEMES {
        let kept = [16, 32, 64].map(|n| taylor_green(n, advection, Trace::Midpoint));
        println!("inviscid Taylor-Green vortex, t = 2, CFL 1, 16, 32, 64 cells, {advection:?}: {kept:.4?}");
        let (least, most) = match advection {
            Advection::SemiLagrangian => (0.62, 1.0),
            Advection::MacCormack => (0.75, 1.0),
            Advection::Reflection => (0.98, 1.01),
            Advection::Conservative => (0.999, 1.001),
            Advection::Cubic => (0.75, 1.0),
        };
        assert!(kept[1] >= least && kept[1] <= most, "{advection:?}: {}", kept[1]);
        assert!(kept[0] <= kept[1] + 0.01 && kept[1] <= kept[2] + 0.01, "{advection:?} worsens: {kept:?}");
    }
}

#[test]
fn no_length_of_step_makes_energy_with_any_scheme() {
    let mut most = 0.0_f64;
    for advection in VELOCITY_SCHEMES {
        for sides in [Sides::CLOSED, Sides::PERIODIC, Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN }] {
            for dt_s in [1.0e-6, 1.0e-3, 1.0 / 60.0, 0.5, 10.0, 1.0e3] {
                let mut fluid = Fluid::builder([12, 9, 11]).sides(sides).advection(advection).build().unwrap();
                fluid.fill_velocity(random_velocity(11, 5.0)).unwrap();
                let before = fluid.mean_kinetic_energy_m2_s2();
                for _ in 0..100 {
                    fluid.step(dt_s).unwrap();
                    let now = fluid.mean_kinetic_energy_m2_s2() / before;
                    assert!(now.is_finite() && now <= 1.25, "{advection:?} {sides:?} dt {dt_s}: {now}");
                    most = most.max(now);
                }
            }
        }
    }
    println!("greatest energy of any scheme, steps of 1e-6 to 1e3 s: {most:.5} of the start");
}

#[test]
fn plumes_stay_symmetric_and_heat_is_found_again() {
    let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
    let n = 16;
    for advection in VELOCITY_SCHEMES {
        let mut fluid = Fluid::builder([n; 3]).sides(sides).advection(advection).build().unwrap();
        for _ in 0..100 {
            fluid.add_heat(Vec3::new(0.5, 0.12, 0.5), 0.15, 1500.0).unwrap();
            fluid.step(1.0 / 60.0).unwrap();
        }
        let [_, v, _] = fluid.face_velocities();
        let mut off = 0.0_f32;
        for k in 0..n {
            for j in 0..=n {
                for i in 0..n {
                    let at = |i: usize, k: usize| v[i + n * (j + (n + 1) * k)];
                    off = off.max((at(i, k) - at(n - 1 - i, k)).abs()).max((at(i, k) - at(i, n - 1 - k)).abs());
                }
            }
        }
        let off = off / fluid.max_speed_m_s();
        println!("asymmetry of a plume after 100 steps, {advection:?}: {off:.1e}");
        let allowed = if advection == Advection::SemiLagrangian { 1.0e-5 } else { 1.0e-3 };
        assert!(off < allowed, "{advection:?}: {off}");
    }
    for scalar_advection in SCALAR_SCHEMES {
        let builder = Fluid::builder([n; 3]).scalar_advection(scalar_advection).scalar("smoke");
        let mut fluid = builder.build().unwrap();
        let smoke = fluid.scalar_id("smoke").unwrap();
        let mut put_in = 0.0;
        for _ in 0..60 {
            fluid.add_heat(Vec3::new(0.5, 0.3, 0.5), 0.2, 1000.0).unwrap();
            fluid.add_scalar(smoke, Vec3::new(0.5, 0.3, 0.5), 0.2, 1000.0).unwrap();
            fluid.step(1.0 / 60.0).unwrap();
            if put_in == 0.0 {
                put_in = sum(fluid.temperatures());
            }
        }
        let off = sum(fluid.temperatures()) / (60.0 * put_in) - 1.0;
        println!("heat found of heat put in, closed box, 60 steps, {scalar_advection:?}: off by {:+.3} %", 100.0 * off);
        let allowed = if scalar_advection == ScalarAdvection::Flux { 1.0e-3 } else { 0.3 };
        assert!(off.abs() < allowed, "{scalar_advection:?}: {off}");
        let smoke: Vec<f32> = fluid.scalar_values(smoke).collect();
        assert_eq!(smoke, fluid.temperatures(), "a scalar is carried as the temperature is");
    }
}

#[test]
fn every_number_of_threads_and_every_vector_gives_the_same_bits() {
    let hash = |threads: usize, simd: SimdLevel, advection: Advection, scalars: ScalarAdvection, is_periodic: bool| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let x = if is_periodic { [Side::Periodic; 2] } else { [Side::Inflow, Side::Open] };
            let sides = Sides { x, y: [Side::NoSlip, Side::Open], z: [Side::FreeSlip; 2] };
            let mut fluid = Fluid::builder([26, 24, 25])
                .sides(sides)
                .wind(Vec3::new(0.5, 0.0, 0.0))
                .viscosity_m2_s(1.0e-4)
                .vorticity_confinement(2.0)
                .advection(advection)
                .scalar_advection(scalars)
                .scalar_with_outside("oxygen", 0.23)
                .simd(simd)
                .build()
                .unwrap();
            let mut random = Random(9);
            for _ in 0..if advection == Advection::MacCormack { 100 } else { 8 } {
                fluid.add_heat(Vec3::new(0.5, 0.1, 0.4), 0.15, 3000.0).unwrap();
                fluid.add_acceleration(Vec3::splat(0.4), random.vector(100.0)).unwrap();
                fluid.step(1.0 / 60.0).unwrap();
            }
            fluid.state_hash()
        })
    };
    let scalar_schemes =
        [ScalarAdvection::SemiLagrangian, ScalarAdvection::Flux, ScalarAdvection::MacCormack, ScalarAdvection::Cubic];
    for (advection, scalars) in VELOCITY_SCHEMES.into_iter().zip(scalar_schemes) {
        for is_periodic in [false, true] {
            let one = hash(1, SimdLevel::Best, advection, scalars, is_periodic);
            assert_eq!(one, hash(1, SimdLevel::Baseline, advection, scalars, is_periodic), "{advection:?} baseline");
            for threads in if advection == Advection::MacCormack { &[2, 3, 16][..] } else { &[3] } {
                assert_eq!(
                    one,
                    hash(*threads, SimdLevel::Best, advection, scalars, is_periodic),
                    "{advection:?} {threads}"
                );
            }
        }
    }
}

#[test]
fn arrays_that_do_not_fit_are_refused() {
    assert!(ops::Shape::new([0, 4, 4], Vec3::ONE, Sides::CLOSED).is_err());
    let shape = ops::Shape::new([4, 5, 6], Vec3::ONE, Sides::CLOSED).unwrap();
    assert_eq!(shape.face_counts(1), [4, 6, 6]);
    let velocity = shape.fill_faces(|_| Vec3::ZERO);
    let start = shape.fill_cells(|point| point.x);
    let carry = ops::Carry::default();
    let mut short = vec![0.0; 7];
    let refused = ops::advect_cells(&shape, velocity.each_ref(), 0.1, &mut short, carry);
    assert!(matches!(refused, Err(FluidError::Length { field: "values", found: 7, .. })), "{refused:?}");
    let mut values = start.clone();
    assert!(ops::advect_cells(&shape, velocity.each_ref(), f32::NAN, &mut values, carry).is_err());
    let bad = ops::Carry { outside: f32::NAN, ..carry };
    assert!(ops::advect_cells(&shape, velocity.each_ref(), 0.1, &mut values, bad).is_err());
    let mut broken = velocity.clone();
    broken[2][9] = f32::INFINITY;
    assert!(ops::advect_cells(&shape, broken.each_ref(), 0.1, &mut values, carry).is_err());
    assert!(ops::advect_velocity(&shape, &mut broken, 0.1, Advection::Cubic, Trace::Euler, Vec3::ZERO).is_err());
    assert_eq!(values, start);
    let mut uniform = shape.fill_faces(|_| Vec3::ONE);
    ops::advect_velocity(&shape, &mut uniform, 0.1, Advection::MacCormack, Trace::Midpoint, Vec3::ONE).unwrap();
    assert!(uniform.iter().flatten().all(|value| *value == 1.0));
}
