//! How the air of all experiments is computed: one place for the choice of schemes.

use lucerna_fluid::{Advection, Density, Fluid, FluidBuilder, Side, Sides, Vec3};

/// The choice, for readers of the page.
pub(crate) const ABOUT: &str = "All fires on burners are computed alike: low Mach number, conservative transport, \
    Deardorff's eddies with 0.1 and a turbulent Prandtl number of 0.5, one step of reaction as fast as fuel mixes. These \
    are the constants of the FDS Technical Reference Guide; none was changed to meet a law. The only difference is in the \
    size of the cells, which each experiment tells; figures still depend on it.";

/// Deardorff's constant and the turbulent Prandtl number (FDS Technical Reference Guide).
const EDDIES: f32 = 0.1;
const PRANDTL: f32 = 0.5;

/// Air over a floor, open all around and above: the middle of the floor at x = z = 0.
pub(crate) fn open_air(cells: [usize; 3], cell_m: f32) -> FluidBuilder {
    let size = cell_m * Vec3::from_array(cells.map(|cells| cells as f32));
    schemes(Fluid::builder(cells))
        .size_m(size)
        .origin(-0.5 * Vec3::new(size.x, 0.0, size.z))
        .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
        .deardorff(EDDIES)
        .turbulent_prandtl(PRANDTL)
}

/// Air for flames so small that viscosity, not eddies, decides what they do.
pub(crate) fn candle_air(cells: [usize; 3], cell_m: f32) -> FluidBuilder {
    // Of air at 293 K; Prandtl number 0.71.
    open_air(cells, cell_m).deardorff(0.0).viscosity_m2_s(1.5e-5).thermal_diffusivity_m2_s(2.1e-5).hot_gas(true)
}

/// Gas that expands when heated, and the transport that suits it.
pub(crate) fn schemes(builder: FluidBuilder) -> FluidBuilder {
    builder.density(Density::LowMach).advection(Advection::Conservative)
}
