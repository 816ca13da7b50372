//! Many boxes together do what each does alone.

use lucerna_fluid::{Fluid, FluidBatch, FluidBuilder, FluidError, PressureSolver, Side, Sides, Vec3};

use crate::support::Random;

/// Boxes that differ in all in which they may.
fn builder(index: usize, cells: [usize; 3]) -> FluidBuilder {
    let share = index as f32 / 16.0;
    Fluid::builder(cells)
        .size_m(Vec3::new(0.3, 0.5, 0.3))
        .sides(Sides { y: [Side::NoSlip, Side::Open], ..Sides::OPEN })
        .origin(Vec3::new(share, 2.0 * share, -share))
        .wind(Vec3::new(share, 0.0, 0.1))
        .vorticity_confinement(if index.is_multiple_of(2) { 3.0 } else { 0.0 })
        .viscosity_m2_s(if index.is_multiple_of(3) { 1.0e-3 } else { 0.0 })
        .cooling_per_s(share)
}

fn add_sources(index: usize, step: u64, fluid: &mut Fluid) {
    let mut random = Random(step * 1000 + index as u64);
    let point = fluid.origin() + fluid.size_m() * Vec3::new(0.5, 0.1, 0.3 + 0.4 * random.next());
    fluid.add_heat(point, 0.08, 4000.0 * random.next()).unwrap();
    if index % 4 == 1 {
        fluid.add_acceleration(point, random.vector(30.0)).unwrap();
        fluid.add_expansion(point, 0.1, 3.0).unwrap();
    }
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

#[test]
fn a_batch_gives_the_bits_of_each_box_alone_on_any_number_of_threads() {
    for (cells, count, steps) in [([7, 9, 6], 37, 6), ([24, 25, 24], 3, 3)] {
        let alone: Vec<_> = (0..count)
            .map(|index| {
                let mut fluid = builder(index, cells).build().unwrap();
                let mut report = None;
                for step in 0..steps {
                    add_sources(index, step, &mut fluid);
                    report = Some(fluid.step(0.02).unwrap());
                }
                (fluid.state_hash(), report.unwrap())
            })
            .collect();
        for threads in [1, 2, 3, 16] {
            on_threads(threads, || {
                let mut batch = FluidBatch::new((0..count).map(|index| builder(index, cells))).unwrap();
                for step in 0..steps {
                    if step % 2 == 0 {
                        batch.for_each(|index, fluid| add_sources(index, step, fluid));
                    } else {
                        batch.iter_mut().enumerate().for_each(|(index, fluid)| add_sources(index, step, fluid));
                    }
                    batch.step(0.02).unwrap();
                }
                for (index, (hash, mut report)) in alone.iter().copied().enumerate() {
                    assert_eq!(batch[index].state_hash(), hash, "{cells:?} box {index}, {threads} threads");
                    report.times = batch.reports()[index].times;
                    assert_eq!(batch.reports()[index], report, "{cells:?} box {index}, {threads} threads");
                }
            });
        }
    }
}

#[test]
fn a_box_of_a_batch_has_the_whole_interface_of_a_fluid() {
    let flow = |point: Vec3| Vec3::new(point.y, 0.5, -point.x);
    let mut batch = builder(4, [8; 3]).build_batch(3).unwrap();
    let mut alone = builder(4, [8; 3]).build().unwrap();
    for fluid in [&mut batch[1], &mut alone] {
        fluid.fill_velocity(flow).unwrap();
        fluid.fill_temperature(|point| 100.0 * point.x.abs()).unwrap();
        fluid.set_wind(Vec3::Z).unwrap();
        fluid.step(0.01).unwrap();
    }
    assert_eq!(batch[1].state_hash(), alone.state_hash());
    batch.step(0.01).unwrap();
    alone.step(0.01).unwrap();
    assert_eq!(batch[1].state_hash(), alone.state_hash());
    assert_ne!(batch[0].state_hash(), alone.state_hash());
    batch[1].reset();
    alone.reset();
    assert_eq!(batch[1].state_hash(), alone.state_hash());
    assert_eq!((batch.len(), batch.iter().count(), batch.is_empty()), (3, 3, false));
    assert!(batch.get(3).is_none() && batch.get_mut(2).is_some());
}

#[test]
fn a_batch_refuses_boxes_of_other_shapes() {
    let good = Fluid::builder([6; 3]);
    let cube = |builder| FluidBatch::new([good.clone(), good.clone().origin(Vec3::ONE), builder]).err();
    assert_eq!(cube(good.clone().wind(Vec3::X).cooling_per_s(1.0)), None);
    let refused = Some(FluidError::BatchShape { index: 2 });
    assert_eq!(cube(Fluid::builder([6, 6, 7])), refused);
    assert_eq!(cube(good.clone().size_m(Vec3::splat(2.0))), refused);
    assert_eq!(cube(good.clone().sides(Sides::OPEN)), refused);
    assert_eq!(cube(good.clone().pressure(PressureSolver::GaussSeidel { sweeps: 9 })), refused);
    assert!(matches!(
        cube(good.clone().cooling_per_s(f32::NAN)),
        Some(FluidError::Value { field: "cooling_per_s", .. })
    ));
    let mut none = FluidBatch::new([]).unwrap();
    assert!(none.is_empty() && none.step(0.1).unwrap().is_empty());
    let mut batch = good.build_batch(2).unwrap();
    let before = batch[0].state_hash();
    assert!(matches!(batch.step(f32::NAN), Err(FluidError::Value { field: "dt_s", .. })));
    assert!(none.step(-1.0).is_err());
    assert_eq!(batch[0].state_hash(), before);
}

/// `batch[i]` can be swapped for any other fluid: that must step too, and harm nobody.
#[test]
fn a_fluid_put_into_a_batch_from_elsewhere_steps_as_it_would_alone() {
    let mut batch = Fluid::builder([6; 3]).sides(Sides::OPEN).build_batch(5).unwrap();
    let start = |cells| {
        let mut fluid = Fluid::builder(cells).build().unwrap();
        fluid.fill_temperature(|point| 300.0 * point.x).unwrap();
        fluid
    };
    for (index, cells) in [(1, [6; 3]), (3, [9, 4, 7])] {
        let (mut alone, mut guest) = (start(cells), start(cells));
        std::mem::swap(&mut batch[index], &mut guest);
        guest.step(0.05).unwrap();
        batch.step(0.05).unwrap();
        alone.step(0.05).unwrap();
        assert_eq!(batch[index].state_hash(), alone.state_hash());
    }
}
