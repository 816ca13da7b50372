//! Viscosity and conduction against exact answers.

use lucerna_fluid::{Fluid, Side, SideAt, Sides};

/// Between two walls at different temperatures the temperature becomes linear (and the velocity
/// stays zero, because heavy lies below light).
#[test]
fn conduction_between_two_walls_becomes_linear() {
    let n = 16;
    for sides in [Sides::CLOSED, Sides::all(Side::NoSlip)] {
        let mut fluid = Fluid::builder([4, n, 6]).sides(sides).build().unwrap();
        fluid.set_side_temperature(SideAt::Bottom, Some(-40.0)).unwrap();
        fluid.set_side_temperature(SideAt::Top, Some(120.0)).unwrap();
        fluid.set_thermal_diffusivity_m2_s(0.5).unwrap();
        for _ in 0..100 {
            fluid.step(0.5).unwrap();
        }
        let mut off = 0.0_f32;
        for (at, value) in fluid.temperatures().iter().enumerate() {
            let y = ((at / 4 % n) as f32 + 0.5) / n as f32;
            off = off.max((value - (-40.0 + 160.0 * y)).abs());
        }
        println!("conduction between walls of -40 and 120 K: off by {off:.1e} K");
        assert!(off < 1.0e-3, "{sides:?}: {off}");
    }
}

/// Insulated walls keep the heat, whatever the step.
#[test]
fn conduction_keeps_the_heat_in_an_insulated_box() {
    for dt_s in [1.0e-3, 0.1, 10.0] {
        let mut fluid = Fluid::builder([17, 9, 12]).build().unwrap();
        fluid.set_thermal_diffusivity_m2_s(0.01).unwrap();
        fluid.fill_temperature(|point| 300.0 * (point.x * 9.0).sin().powi(2)).unwrap();
        let total = |fluid: &Fluid| fluid.temperatures().iter().map(|value| f64::from(*value)).sum::<f64>();
        let spread = |fluid: &Fluid| {
            let bounds = (f32::MAX, f32::MIN);
            fluid.temperatures().iter().fold(bounds, |(low, high), value| (low.min(*value), high.max(*value)))
        };
        let (before, bounds) = (total(&fluid), spread(&fluid));
        for _ in 0..50 {
            fluid.step(dt_s).unwrap();
        }
        let (change, after) = (total(&fluid) / before - 1.0, spread(&fluid));
        println!("heat in an insulated box, 50 steps of {dt_s} s: changed by {change:.1e}");
        assert!(change.abs() < 1.0e-4, "dt {dt_s}: {change}");
        assert!(after.0 >= bounds.0 - 0.01 && after.1 <= bounds.1 + 0.01 && after.1 < bounds.1, "{after:?}");
    }
}
