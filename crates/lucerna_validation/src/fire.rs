//! Gas burners on the floor.

use std::f32::consts::{FRAC_PI_4, TAU};

use lucerna_fluid::{Combustion, Fluid, Fuel, ScalarId, ScalarSource, Shape, Side, Sides, Source, Vec3};

use crate::air::open_air;
use crate::experiment::Halt;

/// Corners of a round burner.
const CORNERS: u32 = 96;

/// Gas at ambient temperature and pressure that burns.
#[derive(Clone, Copy)]
pub(crate) struct Gas {
    pub(crate) fuel: Fuel,
    pub(crate) density_kg_m3: f32,
}

/// CH4.
pub(crate) const METHANE: Gas = Gas { fuel: Fuel::METHANE, density_kg_m3: 0.667 };
/// C3H8.
pub(crate) const PROPANE: Gas = Gas { fuel: Fuel::PROPANE, density_kg_m3: 1.84 };
/// CH3OH, as vapour at its boiling point (338 K); heat of combustion of the liquid, and the radiated share of the 0.3 m
/// pool (K. Sung, R. Falkenstein-Smith, A. Hamins, NIST Technical Note 2162r1, 2024, table 1.1: 0.24 ± 0.01).
pub(crate) const METHANOL: Gas = Gas {
    fuel: Fuel { heat_kj_kg: 19_940.0, oxygen_kg_kg: 1.5, soot_kg_kg: 0.0, radiated: 0.24 },
    density_kg_m3: 1.155,
};

impl Gas {
    pub(crate) const fn radiating(self, share: f32) -> Self {
        Self { fuel: Fuel { radiated: share, ..self.fuel }, ..self }
    }
}

/// What gas comes out of, m.
#[derive(Clone, Copy)]
pub(crate) enum Burner {
    Round {
        diameter: f32,
    },
    Square {
        edge: f32,
    },
    /// As wide as this along x, through all of the box along z.
    Line {
        width: f32,
    },
}

/// A burner in a box of air.
pub(crate) struct Plan {
    pub(crate) gas: Gas,
    /// In all, kW.
    pub(crate) heat_kw: f32,
    pub(crate) burner: Burner,
    pub(crate) cell_m: f32,
    pub(crate) cells: [usize; 3],
    /// Along x, m/s.
    pub(crate) wind_m_s: f32,
    /// Where along x, m from the middle of the box.
    pub(crate) at_m: Vec<f32>,
}

/// A fire that burns.
pub(crate) struct Fire {
    pub(crate) air: Fluid,
    pub(crate) fuel: ScalarId,
    pub(crate) kg_s: f32,
    /// The middle of each burner on the floor.
    pub(crate) feet: Vec<Vec3>,
}

impl Plan {
    /// A burner in the middle of a box, in still air.
    pub(crate) fn new(gas: Gas, heat_kw: f32, burner: Burner, cell_m: f32, cells: [usize; 3]) -> Self {
        Self { gas, heat_kw, burner, cell_m, cells, wind_m_s: 0.0, at_m: vec![0.0] }
    }

    /// Lights it. Several burners share the heat.
    pub(crate) fn light(&self) -> Result<Fire, Halt> {
        let mut builder = open_air(self.cells, self.cell_m).combustion(Combustion::new(self.gas.fuel));
        if matches!(self.burner, Burner::Line { .. }) {
            let sides = Sides { y: [Side::FreeSlip, Side::Open], z: [Side::Periodic; 2], ..Sides::OPEN };
            builder = builder.sides(sides);
        }
        let mut air = builder.wind(self.wind_m_s * Vec3::X).build()?;
        // Combustion adds it.
        let Some(fuel) = air.scalar_id("fuel") else { return Err(Halt::Stopped) };
        let kg_s = self.heat_kw / self.gas.fuel.heat_kj_kg;
        let share = kg_s / self.at_m.len() as f32;
        // A little off the middle: the flow would stay mirror-symmetric otherwise.
        let off = self.cell_m * Vec3::new(0.23, 0.0, -0.17);
        let feet: Vec<Vec3> = self.at_m.iter().map(|at| *at * Vec3::X + off).collect();
        for foot in &feet {
            air.attach_source(Source {
                inflow_m3_s: share / self.gas.density_kg_m3,
                scalars: vec![ScalarSource { kg_s: share, ..ScalarSource::new(fuel) }],
                ..Source::new(self.shape(*foot))
            })?;
        }
        Ok(Fire { air, fuel, kg_s, feet })
    }

    fn shape(&self, foot: Vec3) -> Shape {
        let around = |x: f32, z: f32| {
            let reach = 0.5 * Vec3::new(x, 0.0, z);
            Shape::Box { low: foot - reach, high: foot + reach + self.cell_m * Vec3::Y }
        };
        match self.burner {
            Burner::Round { diameter } => disk(foot, diameter, self.cell_m),
            Burner::Square { edge } => around(edge, edge),
            Burner::Line { width } => around(width, 10.0 * self.cell_m * self.cells[2] as f32),
        }
    }
}

impl Burner {
    /// Diameter of a round burner of the same area, m.
    pub(crate) fn diameter_m(self) -> f32 {
        match self {
            Self::Round { diameter } => diameter,
            Self::Square { edge } => edge / FRAC_PI_4.sqrt(),
            Self::Line { width } => width,
        }
    }
}

/// An upright cylinder: the middle of its foot, diameter and height, m.
pub(crate) fn disk(foot: Vec3, diameter_m: f32, height_m: f32) -> Shape {
    let mut positions = vec![foot, foot + height_m * Vec3::Y];
    let mut triangles = Vec::new();
    for corner in 0..CORNERS {
        let (sin, cos) = (TAU * corner as f32 / CORNERS as f32).sin_cos();
        let low = foot + 0.5 * diameter_m * Vec3::new(cos, 0.0, sin);
        positions.extend([low, low + height_m * Vec3::Y]);
        let (a, b) = (2 + 2 * corner, 2 + 2 * ((corner + 1) % CORNERS));
        triangles.extend([[0, a, b], [1, a + 1, b + 1], [a, b, b + 1], [a, b + 1, a + 1]]);
    }
    Shape::Mesh { positions: positions.into(), triangles: triangles.into(), layer_m: None }
}
