//! Laws of buoyant motion, from the motion alone.

use std::f64::consts::PI;

use lucerna_fluid::{Advection, Density, Fluid, GRAVITY_M_S2, Side, Sides, Vec3};

/// Cells across the box, which is half a wave wide, a metre, and a wave high.
const CELLS: usize = 32;

/// Height of the wave on the layer of light gas, m: the part of `dT / T` that goes as a cosine.
fn wave_m(air: &Fluid, share: f64) -> f64 {
    let across = CELLS as f64;
    let part = air.temperatures().iter().enumerate().map(|(cell, kelvin)| {
        let x = ((cell % CELLS) as f64 + 0.5) / across;
        f64::from(kelvin / (air.ambient_k() + kelvin)) * (PI * x).cos()
    });
    2.0 * part.sum::<f64>() / (share * across * across)
}

/// Growth of a wave on light gas under ambient air, 1/s; `share` is what its density lacks of that
/// of air. It starts at rest, and so goes as the hyperbolic cosine.
fn growth_per_s(advection: Advection, share: f32, law_per_s: f64, dt_s: f32) -> f64 {
    let cell_m = 1.0 / CELLS as f32;
    let mut air = Fluid::builder([CELLS, 2 * CELLS, 1])
        .size_m(Vec3::new(1.0, 2.0, cell_m))
        .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::CLOSED })
        .density(Density::LowMach)
        .advection(advection)
        .build()
        .unwrap();
    let ambient_k = air.ambient_k();
    air.fill_temperature(|point| {
        let top_m = 1.0 + 0.01 * (std::f32::consts::PI * point.x).cos();
        let share = share * ((top_m - point.y) / cell_m + 0.5).clamp(0.0, 1.0);
        ambient_k * share / (1.0 - share)
    })
    .unwrap();
    let start_m = wave_m(&air, f64::from(share));
    // Until the wave is four times as high.
    let steps = (4.0_f64.acosh() / law_per_s / f64::from(dt_s)).round();
    for _ in 0..steps as usize {
        air.step(dt_s).unwrap();
    }
    (wave_m(&air, f64::from(share)) / start_m).acosh() / (steps * f64::from(dt_s))
}

/// G. I. Taylor, Proc. R. Soc. A 201 (1950): `sqrt(A g k)`, A the difference of the densities over
/// their sum. Two ends a metre away take a part in 500 off. Nothing is fitted.
#[test]
fn light_gas_under_air_rises_as_fast_as_taylor_says() {
    for advection in [Advection::MacCormack, Advection::Conservative] {
        for (share, dt_s) in [(0.1_f32, 0.005), (0.5, 0.005), (0.815, 0.0025)] {
            let atwood = f64::from(share / (2.0 - share));
            let law = (atwood * f64::from(GRAVITY_M_S2) * PI).sqrt();
            let found = growth_per_s(advection, share, law, dt_s);
            let off = 100.0 * (found / law - 1.0);
            println!(
                "air {:.2} times as dense over light gas, {advection:?}: a wave grows at {found:.3} 1/s, by Taylor \
                 {law:.3} ({off:+.1} %)",
                1.0 / (1.0 - share)
            );
            assert!(off.abs() < 4.0, "{found} against {law}");
        }
    }
}
