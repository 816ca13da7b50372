//! Cavities: driven by a lid, and by heat.

use lucerna_fluid::{Advection, Fluid, GRAVITY_M_S2, Side, SideAt, Sides, Vec3};

#[path = "../../examples/validate/published.rs"]
#[allow(dead_code, reason = "the example plots more")]
mod published;

use published::{BOTELLA_1000_U, BOTELLA_1000_V, DE_VAHL_DAVIS, GHIA_100_U, GHIA_100_V, Profile};

const CELLS: usize = 64;

/// A square metre with walls that hold the air, and a lid of 1 m/s, after `end_s` seconds.
fn driven(reynolds: f32, end_s: f32, advection: Advection) -> Fluid {
    let (no_slip, edge) = ([Side::NoSlip; 2], 1.0 / CELLS as f32);
    let mut fluid = Fluid::builder([CELLS, CELLS, 1])
        .size_m(Vec3::new(1.0, 1.0, edge))
        .sides(Sides { x: no_slip, y: no_slip, ..Sides::CLOSED })
        .viscosity_m2_s(1.0 / reynolds)
        .advection(advection)
        .build()
        .unwrap();
    fluid.set_side_velocity(SideAt::Top, |_| Vec3::X).unwrap();
    for _ in 0..(end_s / edge) as usize {
        fluid.step(edge).unwrap();
    }
    fluid
}

/// Velocity along `axis` on the centreline across it.
fn centreline(fluid: &Fluid, axis: usize, place: f64) -> f64 {
    let mut point = Vec3::new(0.5, 0.5, 0.5 / CELLS as f32);
    point[1 - axis] = place as f32;
    f64::from(fluid.velocity(point)[axis])
}

fn off(fluid: &Fluid, published: [&Profile; 2]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let away = |(place, value): &(f64, f64)| (centreline(fluid, axis, *place) - value).abs();
        published[axis].iter().map(away).fold(0.0, f64::max)
    })
}

/// Least and greatest of what a centreline has in its cells.
fn extremes(fluid: &Fluid, axis: usize) -> [f64; 2] {
    let values = (1..4 * CELLS).map(|at| centreline(fluid, axis, at as f64 / (4 * CELLS) as f64));
    values.fold([f64::MAX, f64::MIN], |[low, high], value| [low.min(value), high.max(value)])
}

#[test]
fn a_lid_driven_cavity_matches_the_spectral_values_at_re_100() {
    let fluid = driven(100.0, 25.0, Advection::default());
    // Botella and Peyret 1998, table 8: extremes on the centrelines.
    let [least_u, _] = extremes(&fluid, 0);
    let [least_v, most_v] = extremes(&fluid, 1);
    let off_extremes = [least_u + 0.214_042_4, least_v + 0.253_803_0, most_v - 0.179_572_8];
    let off = off(&fluid, [GHIA_100_U, GHIA_100_V]);
    println!("cavity Re 100, 64^2: extremes off by {off_extremes:.4?}; off Ghia's table by {off:.4?}");
    assert!(off_extremes.into_iter().all(|off| off.abs() < 0.01), "{off_extremes:?}");
    // The table itself is off by up to 0.009.
    assert!(off.into_iter().all(|off| off < 0.019), "{off:?}");
}

#[test]
fn the_best_scheme_matches_the_spectral_values_at_re_1000() {
    let fluid = driven(1000.0, 50.0, Advection::Reflection);
    // Botella and Peyret 1998: extremes on the centrelines.
    let [least_u, _] = extremes(&fluid, 0);
    let [least_v, most_v] = extremes(&fluid, 1);
    let off_extremes = [least_u + 0.388_569_8, least_v + 0.527_077_1, most_v - 0.376_944_7];
    let off = off(&fluid, [BOTELLA_1000_U, BOTELLA_1000_V]);
    println!("cavity Re 1000, 64^2, reflection: extremes off by {off_extremes:.4?}; off the tables by {off:.4?}");
    assert!(off_extremes.into_iter().chain(off).all(|off| off.abs() < 0.03), "{off_extremes:?} {off:?}");
}

/// Mean Nusselt number of a square hot on the left and cold on the right: heat through the box
/// over what conduction alone would carry.
fn nusselt(rayleigh: f64, cells: usize, end: f64) -> f64 {
    let (no_slip, edge) = ([Side::NoSlip; 2], 1.0 / cells as f32);
    let ambient_k = 300.0_f64;
    // So that buoyancy over the whole difference is 1 m/s².
    let difference_k = ambient_k / f64::from(GRAVITY_M_S2);
    let viscosity = (0.71 / rayleigh).sqrt();
    let conductivity = viscosity / 0.71;
    let mut fluid = Fluid::builder([cells, cells, 1])
        .size_m(Vec3::new(1.0, 1.0, edge))
        .sides(Sides { x: no_slip, y: no_slip, ..Sides::CLOSED })
        .ambient_k(ambient_k as f32)
        .viscosity_m2_s(viscosity as f32)
        .build()
        .unwrap();
    fluid.set_thermal_diffusivity_m2_s(conductivity as f32).unwrap();
    let half_k = 0.5 * difference_k as f32;
    fluid.set_side_temperature(SideAt::Left, Some(half_k)).unwrap();
    fluid.set_side_temperature(SideAt::Right, Some(-half_k)).unwrap();
    fluid.fill_temperature(|point| half_k * (1.0 - 2.0 * point.x)).unwrap();
    let dt_s = edge;
    for _ in 0..(end / f64::from(dt_s)) as usize {
        fluid.step(dt_s).unwrap();
    }
    let [u, _, _] = fluid.face_velocities();
    let carried = fluid.temperatures().iter().enumerate().map(|(cell, value)| {
        let face = cell % cells + (cells + 1) * (cell / cells);
        0.5 * f64::from(u[face] + u[face + 1]) * f64::from(*value)
    });
    1.0 + carried.sum::<f64>() / (cells * cells) as f64 / (conductivity * difference_k)
}

#[test]
fn a_heated_cavity_carries_the_heat_that_de_vahl_davis_found() {
    for ((rayleigh, published), (cells, end)) in DE_VAHL_DAVIS.iter().zip([(32, 30.0), (48, 60.0), (64, 120.0)]) {
        let found = nusselt(*rayleigh, cells, end);
        println!("heated cavity Ra {rayleigh:.0e}, {cells}^2: Nusselt number {found:.3}, published {published}");
        assert!((found / published - 1.0).abs() < 0.02, "Ra {rayleigh}: {found} against {published}");
    }
}
