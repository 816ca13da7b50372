//! What a caller changes: settings, and what is added to the air.
//!
//! A [`Source`] is a shape and what it adds. It is turned into a list of cells, each with the
//! share of it that the shape covers, once; applying it goes through that list.

mod add;
mod apply;
mod mesh;
mod place;
mod push;
mod settings;
mod voxels;

use std::sync::Arc;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use crate::error::{FluidError, check, check_vec};
use crate::limits::{MAX_ACCELERATION_M_S2, MAX_SPEED_M_S, MAX_TEMPERATURE_K};
use crate::scalars::{MAX_SCALAR, ScalarId};
pub(crate) use add::{add_ball, check_ball};
pub(crate) use apply::{Air, kelvin_from_share, share_from_kelvin};
pub use place::SourceId;
pub(crate) use place::{Placed, SavedSources};
pub(crate) use settings::fill;

/// Where a source acts. What of it lies outside the box counts for nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Shape {
    /// One point. Its eight nearest cells share one cell's worth, so that moving it is smooth.
    Point(Vec3),
    /// A box along the axes; cells that it covers in part count by the part. Where `low` equals
    /// `high` along an axis it is one cell thick there.
    Box {
        /// Low corner, m.
        low: Vec3,
        /// High corner, m, nowhere below `low`.
        high: Vec3,
    },
    /// A ball; cells that it covers in part count by the part. One too small to cover anything
    /// acts as a point.
    Sphere {
        /// Its centre, m.
        centre: Vec3,
        /// Its radius, m, above 0, up to 1e6.
        radius_m: f32,
    },
    /// What triangles enclose, or a layer about them.
    Mesh {
        /// Corners, m.
        positions: Arc<[Vec3]>,
        /// Three corners each, any way round.
        triangles: Arc<[[u32; 3]]>,
        /// None: the inside of the mesh, which must be closed (each edge shared by two triangles;
        /// corners at the same place count as one). Otherwise all within half of this, m, above
        /// 0, of a triangle, softened over a cell.
        layer_m: Option<f32>,
    },
}

/// A value that the air is drawn towards: per time step of length dt, what is missing falls to
/// `exp(-per_s * share * dt)` of itself, `share` the part of the cell that the shape covers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Couple<T> {
    /// Where to.
    pub value: T,
    /// How fast, 1/s, 0 to 1e6. At 1e6 the value is held.
    pub per_s: f32,
}

/// What a source does to one scalar.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScalarSource {
    /// Which one.
    pub scalar: ScalarId,
    /// Mass added in all, kg/s, within ±1e6, for a scalar that is a mass fraction.
    pub kg_s: f32,
    /// Growth of the value, 1/s, within ±1e6.
    pub per_s: f32,
    /// A value to be drawn towards, within ±1e6.
    pub couple: Option<Couple<f32>>,
}

impl ScalarSource {
    /// Nothing yet.
    #[must_use]
    pub fn new(scalar: ScalarId) -> Self {
        Self { scalar, kg_s: 0.0, per_s: 0.0, couple: None }
    }
}

/// Something that acts on the air: `Source { heat_kw: 20.0, ..Source::new(shape) }`. Give it to
/// [`crate::Fluid::add_source`] for one step or to [`crate::Fluid::attach_source`] for all.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Where.
    pub shape: Shape,
    /// Force per mass, N/kg = m/s², components within ±1e6.
    pub acceleration_m_s2: Vec3,
    /// Force in all, N, components within ±1e9; shared among the cells by what is covered.
    pub force_n: Vec3,
    /// Heat in all, kW, within ±1e6; shared among the cells by what is covered, so that all of
    /// it gets into the air: a cell of volume V and share q of it warms by `q / (rho c_p V)`.
    pub heat_kw: f32,
    /// Warming, K/s, within ±1e6.
    pub kelvin_per_s: f32,
    /// Divergence of the flow, 1/s, within ±1e4.
    pub expansion_per_s: f32,
    /// Gas let in, m³/s, within ±1e6; shared among the cells by what is covered.
    pub inflow_m3_s: f32,
    /// A velocity to be drawn towards, m/s, components within ±300.
    pub velocity: Option<Couple<Vec3>>,
    /// A temperature above ambient to be drawn towards, K, -1e4 to 1e4.
    pub temperature: Option<Couple<f32>>,
    /// What it does to scalars.
    pub scalars: Vec<ScalarSource>,
}

impl Source {
    /// A source that adds nothing yet.
    #[must_use]
    pub fn new(shape: Shape) -> Self {
        Self {
            shape,
            acceleration_m_s2: Vec3::ZERO,
            force_n: Vec3::ZERO,
            heat_kw: 0.0,
            kelvin_per_s: 0.0,
            expansion_per_s: 0.0,
            inflow_m3_s: 0.0,
            velocity: None,
            temperature: None,
            scalars: Vec::new(),
        }
    }

    /// Refuses numbers out of range. The shape is checked when it is placed.
    fn check_amounts(&self) -> Result<(), FluidError> {
        const RATE: &str = "0 to 1e6 1/s";
        check_vec("acceleration_m_s2", self.acceleration_m_s2, MAX_ACCELERATION_M_S2, "components within ±1e6 m/s²")?;
        check_vec("force_n", self.force_n, 1.0e9, "components within ±1e9 N")?;
        check("heat_kw", self.heat_kw, -1.0e6, 1.0e6, "within ±1e6 kW")?;
        check("kelvin_per_s", self.kelvin_per_s, -1.0e6, 1.0e6, "within ±1e6 K/s")?;
        check("expansion_per_s", self.expansion_per_s, -1.0e4, 1.0e4, "within ±1e4 1/s")?;
        check("inflow_m3_s", self.inflow_m3_s, -1.0e6, 1.0e6, "within ±1e6 m³/s")?;
        if let Some(couple) = self.velocity {
            check_vec("velocity", couple.value, MAX_SPEED_M_S, "components within ±300 m/s")?;
            check("velocity per_s", couple.per_s, 0.0, 1.0e6, RATE)?;
        }
        if let Some(couple) = self.temperature {
            check("temperature", couple.value, -MAX_TEMPERATURE_K, MAX_TEMPERATURE_K, "within ±1e4 K")?;
            check("temperature per_s", couple.per_s, 0.0, 1.0e6, RATE)?;
        }
        for source in &self.scalars {
            check("kg_s", source.kg_s, -1.0e6, 1.0e6, "within ±1e6 kg/s")?;
            check("per_s", source.per_s, -1.0e6, 1.0e6, "within ±1e6 per s")?;
            if let Some(couple) = source.couple {
                check("scalar", couple.value, -MAX_SCALAR, MAX_SCALAR, "within ±1e6")?;
                check("scalar per_s", couple.per_s, 0.0, 1.0e6, RATE)?;
            }
        }
        Ok(())
    }
}
