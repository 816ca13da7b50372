//! One box of air.

use glam::Vec3;
use lucerna_fluid::{
    Advection, Combustion, Density, Fluid, FluidBuilder, FluidError, PressureSolver, ScalarAdvection, Side, Sides,
};
use lucerna_scene::{Air, AirAdvection, AirSides, HeatAdvection, Pressure};

/// Most acceleration of a row that the fluid takes, m/s^2.
const MAX_ACCELERATION_M_S2: f32 = 1e6;

/// Deardorff's constant of air that burns: small eddies mix fuel into it.
const DEARDORFF: f32 = 0.1;
/// Viscosity over thermal diffusivity of gas.
const PRANDTL: f32 = 0.7;

/// What makes the air, at rest or moving with the wind. Where fuel burns in it, it is as light as it is hot, and heat and
/// fuel are conserved.
pub(crate) fn builder(air: &Air, burning: Option<Combustion>) -> FluidBuilder {
    let sides = match air.sides {
        AirSides::Floor => Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN },
        AirSides::Open => Sides::OPEN,
        AirSides::Closed => Sides::CLOSED,
    };
    let fluid = Fluid::builder(air.cells.map(|n| n as usize))
        .origin(air.origin_m.into())
        .size_m(air.size_m.into())
        .sides(sides)
        .wind(air.wind_m_s.into())
        .viscosity_m2_s(air.viscosity_m2_s)
        .vorticity_confinement(air.vorticity_confinement)
        .ambient_k(air.ambient_k)
        .cooling_per_s(air.cooling_per_s)
        .advection(match air.advection {
            AirAdvection::SemiLagrangian => Advection::SemiLagrangian,
            AirAdvection::MacCormack => Advection::MacCormack,
            AirAdvection::Reflection => Advection::Reflection,
            AirAdvection::Cubic => Advection::Cubic,
            AirAdvection::Conservative => Advection::Conservative,
        })
        .scalar_advection(match air.heat_advection {
            HeatAdvection::SemiLagrangian => ScalarAdvection::SemiLagrangian,
            HeatAdvection::Flux => ScalarAdvection::Flux,
            HeatAdvection::MacCormack => ScalarAdvection::MacCormack,
            HeatAdvection::Cubic => ScalarAdvection::Cubic,
        })
        .pressure(match air.pressure {
            Pressure::Direct => PressureSolver::Direct,
            Pressure::GaussSeidel(sweeps) => PressureSolver::GaussSeidel { sweeps },
        });
    match burning {
        None => fluid,
        Some(combustion) => fluid
            .density(Density::LowMach)
            .scalar_advection(ScalarAdvection::Flux)
            .thermal_diffusivity_m2_s(air.viscosity_m2_s / PRANDTL)
            .deardorff(DEARDORFF)
            .combustion(combustion),
    }
}

/// Whether the two can be stepped together.
pub(crate) fn same_shape(a: &Air, b: &Air) -> bool {
    let shape = |air: &Air| (air.size_m, air.cells, air.pressure, air.sides);
    shape(a) == shape(b)
}

/// Whether the two need the same grid, so that the air can go on as it is.
pub(crate) fn same_grid(a: &Air, b: &Air) -> bool {
    let built_with =
        |air: &Air| (air.origin_m, air.size_m, air.cells, air.pressure, air.advection, air.heat_advection, air.sides);
    built_with(a) == built_with(b)
}

/// Checks what [`adjust`] takes over, and changes nothing.
pub(crate) fn check(air: &Air) -> Result<(), FluidError> {
    // A fluid of eight cells has the same limits, and costs nothing.
    builder(&Air { origin_m: [0.0; 3], size_m: [1.0; 3], cells: [2; 3], ..air.clone() }, None).build().map(drop)
}

/// Takes over what can change while the air moves.
pub(crate) fn adjust(fluid: &mut Fluid, air: &Air) -> Result<(), FluidError> {
    fluid.set_wind(air.wind_m_s.into())?;
    fluid.set_viscosity_m2_s(air.viscosity_m2_s)?;
    if fluid.scalar_id("fuel").is_some() {
        fluid.set_thermal_diffusivity_m2_s(air.viscosity_m2_s / PRANDTL)?;
    }
    fluid.set_vorticity_confinement(air.vorticity_confinement)?;
    fluid.set_ambient_k(air.ambient_k)?;
    fluid.set_cooling_per_s(air.cooling_per_s)
}

/// The buoyancy of paper 003's authors: every cell of row j is pushed up by `B n_y / j`.
pub(crate) fn add_row_buoyancy(fluid: &mut Fluid, air: &Air) -> Result<(), FluidError> {
    if air.row_buoyancy_m_s2 > 0.0 {
        let rows = fluid.cells()[1];
        for j in 1..rows {
            let acceleration = air.row_buoyancy_m_s2 * rows as f32 / j as f32;
            fluid.add_row_acceleration(j, acceleration.min(MAX_ACCELERATION_M_S2))?;
        }
    }
    Ok(())
}

/// The two ends of each of the twelve edges of the box.
pub(crate) fn edges(fluid: &Fluid) -> impl Iterator<Item = [Vec3; 2]> {
    let (low, size) = (fluid.origin(), fluid.size_m());
    [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate().flat_map(move |(axis, along)| {
        let mut others = [Vec3::X, Vec3::Y, Vec3::Z];
        others[axis] = Vec3::ZERO;
        (0..4_u8).map(move |corner| {
            let mut at = Vec3::ZERO;
            let mut bit = 0;
            for (other, unit) in others.into_iter().enumerate() {
                if other != axis {
                    at += unit * f32::from((corner >> bit) & 1);
                    bit += 1;
                }
            }
            [low + at * size, low + (at + along) * size]
        })
    })
}
