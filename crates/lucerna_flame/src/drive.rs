//! Flames in the air of `lucerna_fluid`: how it carries them, and how their roots drive it.

use crate::air::{Gas, keep_inside};
use crate::flame::{Doings, Feed};
use crate::{Air, Flames, Source};
use glam::Vec3;
use lucerna_fluid::{Fluid, FluidError, OXYGEN_IN_AIR, ScalarId, ScalarSource, Shape};
use std::sync::PoisonError;

/// Names of the scalars that hold fuel and oxygen.
const FUEL: &str = "fuel";
const OXYGEN: &str = "oxygen";

impl Air for Fluid {
    fn velocity(&self, point: Vec3) -> Vec3 {
        Fluid::velocity(self, point)
    }
    fn bounds(&self) -> (Vec3, Vec3) {
        (self.origin(), self.origin() + self.size_m())
    }
    fn carry(&self, points: &mut [Vec3], dt_s: f32) {
        self.advect_points(points, dt_s);
    }
    fn cell_m(&self) -> f32 {
        self.cell_size_m().min_element()
    }
    fn gas(&self, points: &[Vec3], out: &mut [Gas]) {
        let (fuel, oxygen) = (self.scalar_id(FUEL), self.scalar_id(OXYGEN));
        for (out, point) in out.iter_mut().zip(points) {
            let of = |scalar: Option<ScalarId>, or: f32| scalar.map_or(or, |scalar| self.scalar(scalar, *point));
            let temperature_k = self.ambient_k() + self.temperature(*point);
            *out = Gas { temperature_k, fuel: of(fuel, 0.0), oxygen: of(oxygen, OXYGEN_IN_AIR) };
        }
    }
}

/// How far a source reaches at most, as a share of the box's smallest side.
const MAX_REACH: f32 = 0.25;

impl Source {
    /// Adds the source to the coming step of the air.
    ///
    /// The paper pushes the one voxel that holds the root. Here the push fades linearly to zero at
    /// `reach_m` along each axis, so that a flame stays put when its root is not in the middle of
    /// a voxel or sways from one to the next, and finer grids do not weaken it. No source reaches
    /// farther than a quarter of the box's smallest side.
    ///
    /// # Errors
    /// When a number is outside what the air accepts.
    pub fn add_to(&self, fluid: &mut Fluid) -> Result<(), FluidError> {
        // A wide source must not cost a pass over all of a large box.
        let most_m = MAX_REACH * fluid.size_m().min_element();
        if self.heat_k_s > 0.0 {
            fluid.add_heat(self.position, self.radius_m.min(most_m), self.heat_k_s)?;
        }
        if self.acceleration_m_s2 > 0.0 {
            let push = Vec3::Y * self.acceleration_m_s2.min(1e6);
            fluid.add_push(self.position, self.reach_m.min(most_m), push)?;
        }
        Ok(())
    }
}

/// Points into which a patch is divided at most, and how many fall on a cell.
const MAX_POINTS: f32 = 400.0;
const POINTS_A_CELL: f32 = 3.0;

impl Feed {
    /// Lets the fuel in, evenly over the patch: a disc, or a band along a stretch of the wick.
    fn add_to(&self, fluid: &mut Fluid, source: &mut lucerna_fluid::Source) -> Result<(), FluidError> {
        if self.kg_s <= 0.0 {
            return Ok(());
        }
        let bounds = fluid.bounds();
        let length = self.half.length();
        let across = self.half.cross(Vec3::Y).try_normalize().unwrap_or(Vec3::X);
        let band = 4.0 * length * self.radius_m;
        let disc = std::f32::consts::PI * self.radius_m * self.radius_m;
        let area = if length > 0.0 { band } else { disc };
        let cell = fluid.cell_m();
        let points = (POINTS_A_CELL * area / (cell * cell)).max(2.0 * length / cell).ceil().clamp(1.0, MAX_POINTS);
        let kg_s = self.kg_s / points;
        source.inflow_m3_s = kg_s / self.vapour_kg_m3;
        source.scalars[0].kg_s = kg_s;
        for i in 0..points as u32 {
            let x = i as f32 + 0.5;
            let offset = if length > 0.0 {
                // Equal steps along, and a low-discrepancy sequence across.
                let aside = (x * 0.618_034).fract();
                self.half * (2.0 * x / points - 1.0) + across * (self.radius_m * (2.0 * aside - 1.0))
            } else {
                // Vogel's spiral: equal areas, turned by the golden angle.
                let (sin, cos) = (x * 2.399_963).sin_cos();
                Vec3::new(cos, 0.0, sin) * (self.radius_m * (x / points).sqrt())
            };
            source.shape = Shape::Point(keep_inside(self.position + offset, bounds, self.position));
            fluid.add_source(source)?;
        }
        Ok(())
    }
}

impl Flames {
    /// Moves the roots with the only air and adds what they do to its coming step: forces and heat, or fuel.
    ///
    /// # Errors
    /// When a number is outside what the air accepts; when flames let in fuel and the air does not burn any, see
    /// [`combustion`](crate::combustion).
    pub fn drive(&mut self, fluid: &mut Fluid) -> Result<(), FluidError> {
        self.sources(fluid);
        self.drive_air(0, fluid)
    }

    /// Adds what the roots found by [`sources`](Self::sources) do to the coming step of one of several airs. Different
    /// airs can be driven at the same time.
    ///
    /// # Errors
    /// As [`drive`](Self::drive).
    pub fn drive_air(&self, number: usize, fluid: &mut Fluid) -> Result<(), FluidError> {
        self.sources_in(number).try_for_each(|source| source.add_to(fluid))?;
        for Doings { feeds, gas, .. } in self.in_air(number).map(|flame| &flame.doings) {
            if feeds.is_empty() {
                continue;
            }
            let mut gas = gas.lock().unwrap_or_else(PoisonError::into_inner);
            let fuel = fluid.scalar_id(FUEL).ok_or(FluidError::CombustionScalar { name: FUEL })?;
            let gas = gas.get_or_insert_with(|| lucerna_fluid::Source::new(Shape::Point(Vec3::ZERO)));
            gas.scalars.resize(1, ScalarSource::new(fuel));
            gas.scalars[0].scalar = fuel;
            feeds.iter().try_for_each(|feed| feed.add_to(fluid, gas))?;
        }
        self.in_air(number).try_for_each(|flame| flame.stir(fluid))
    }
}
