//! Nothing is allocated by a step that has happened before.

use allocation_counter::measure;
use lucerna_fluid::{
    Advection, Combustion, Couple, Density, Fluid, FluidBuilder, Fuel, Obstacle, PressureSolver, Shape, Side, Sides,
    Source, Vec3,
};

fn plume() -> FluidBuilder {
    Fluid::builder([15; 3]).size_m(Vec3::splat(0.3)).sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
}

/// All kinds of sources for the coming step.
fn add_sources(fluid: &mut Fluid) {
    let point = Vec3::new(0.15, 0.05, 0.15);
    fluid.add_heat(point, 0.05, 2000.0).unwrap();
    fluid.add_acceleration(point, Vec3::Y).unwrap();
    fluid.add_row_acceleration(2, 1.0).unwrap();
    fluid.add_expansion(point, 0.05, 1.0).unwrap();
    if let Some(soot) = fluid.scalar_id("soot") {
        fluid.add_scalar(soot, point, 0.05, 1.0).unwrap();
    }
    let velocity = Some(Couple { value: Vec3::Y, per_s: 2.0 });
    let shape = Shape::Sphere { centre: point, radius_m: 0.04 };
    fluid.add_source(&Source { heat_kw: 0.5, velocity, ..Source::new(shape) }).unwrap();
}

/// Allocations of 10 steps that follow 5.
fn in_steady_state(mut step: impl FnMut()) -> u64 {
    (0..5).for_each(|_| step());
    measure(|| (0..10).for_each(|_| step())).count_total
}

fn on_one_thread(work: impl FnOnce() + Send) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work);
}

#[test]
fn a_step_in_steady_state_allocates_nothing() {
    let configurations = [
        ("plume", plume()),
        ("closed", Fluid::builder([12, 9, 10]).sides(Sides::all(Side::NoSlip)).viscosity_m2_s(1.0e-3)),
        ("periodic", Fluid::builder([12, 9, 10]).sides(Sides::PERIODIC).viscosity_m2_s(1.0e-3)),
        ("plane", Fluid::builder([24, 30, 1]).vorticity_confinement(2.0)),
        ("sweeps", plume().pressure(PressureSolver::GaussSeidel { sweeps: 5 })),
        ("everything", plume().wind(Vec3::X).vorticity_confinement(2.0).cooling_per_s(0.2).cfl_limit(Some(0.2))),
        ("everything that diffuses", plume().viscosity_m2_s(1.0e-4).thermal_diffusivity_m2_s(1.0e-4)),
        ("scalars", (0..9).fold(plume().scalar("soot"), |builder, at| builder.scalar(format!("{at}")))),
        ("fire", plume().combustion(Combustion::new(Fuel::WOOD)).smagorinsky(0.15).hot_gas(true)),
        ("reflection", plume().advection(Advection::Reflection)),
        ("conservative", plume().advection(Advection::Conservative).scalar("soot").viscosity_m2_s(1.0e-4)),
        (
            "light gas",
            plume()
                .advection(Advection::Conservative)
                .density(Density::LowMach)
                .combustion(Combustion::new(Fuel::WOOD))
                .deardorff(0.1),
        ),
        ("obstacles", plume().viscosity_m2_s(1.0e-4)),
        ("large", Fluid::builder([26; 3]).sides(Sides::OPEN).viscosity_m2_s(1.0e-4).vorticity_confinement(2.0)),
    ];
    on_one_thread(move || {
        for (name, builder) in configurations {
            let mut fluid = builder.build().unwrap();
            let mut place = Vec3::new(0.1, 0.2, 0.15);
            let allocated = in_steady_state(|| {
                add_sources(&mut fluid);
                if name == "obstacles" {
                    place.x += 0.002;
                    fluid.set_obstacles(&[Obstacle::sphere(place, 0.05)]).unwrap();
                }
                fluid.step(0.02).unwrap();
            });
            println!("{name}: {allocated} allocations in 10 steps");
            assert_eq!(allocated, 0, "{name}");
        }
    });
}

#[test]
fn a_batch_in_steady_state_allocates_nothing() {
    on_one_thread(|| {
        let mut batch = plume().scalar("soot").vorticity_confinement(2.0).build_batch(20).unwrap();
        let allocated = in_steady_state(|| {
            batch.iter_mut().for_each(add_sources);
            let reports = batch.step(0.02).unwrap();
            assert_eq!(reports.len(), 20);
        });
        assert_eq!(allocated, 0);
    });
}

#[test]
fn a_box_of_a_batch_takes_little_memory() {
    let memory = |count: usize| {
        let mut batch = None;
        measure(|| batch = Some(plume().build_batch(count).unwrap())).bytes_current
    };
    let each = (memory(120) - memory(20)) / 100;
    println!("{each} bytes a box of 15^3, {:.1} a cell", each as f64 / 3375.0);
    assert!(each < 85_000, "{each}");
}
