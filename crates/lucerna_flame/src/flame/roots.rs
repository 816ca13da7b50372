//! What a flame's roots do to the air, and what they feel of it.

use super::{Flame, MAX_HEAT_K_S, Source};
use crate::air::{Air, Gas, keep_inside};
use crate::life::Felt;
use crate::{Drive, WickShape};
use glam::Vec3;
use std::sync::Mutex;

/// Fuel that a stretch of the wick lets into the air during one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Feed {
    /// Middle of the stretch, m.
    pub(crate) position: Vec3,
    /// From its middle to its end, m; zero for a round patch.
    pub(crate) half: Vec3,
    /// Half of its width, m.
    pub(crate) radius_m: f32,
    /// Fuel, kg/s.
    pub(crate) kg_s: f32,
    /// Density of its vapour, kg/m^3.
    pub(crate) vapour_kg_m3: f32,
}

/// What the roots of a flame do to the air in the coming step.
#[derive(Debug, Default)]
pub(crate) struct Doings {
    pub(crate) sources: Vec<Source>,
    pub(crate) feeds: Vec<Feed>,
    /// What lets fuel into the air; its memory is used again. Only one thread at a time asks for it.
    pub(crate) gas: Mutex<Option<lucerna_fluid::Source>>,
}

impl Flame {
    /// Moves the roots with the air and finds what they do to it in the coming step.
    pub(crate) fn find_sources(&mut self, air: &impl Air, time_s: f64, step: u64) {
        self.doings.sources.clear();
        self.doings.feeds.clear();
        if self.follower.is_asleep() {
            return;
        }
        self.sway(air);
        if !self.fire.burns() {
            self.flow = 0.0;
            return;
        }
        match self.settings.drive {
            Drive::RootForces => self.push(time_s, step),
            Drive::Combustion { .. } => self.feed(time_s, step),
        }
    }

    fn sway(&mut self, air: &impl Air) {
        let s = &self.settings.skeletons;
        let rest = self.roots.leads.iter().map(|l| (l.position, s.lead_sway_s));
        let rest = rest.chain(self.roots.peripherals.iter().map(|p| (p.position, s.peripheral_sway_s)));
        let bounds = air.bounds();
        for (root, (position, sway)) in self.chains.roots_mut().iter_mut().zip(rest) {
            let moved = position + air.velocity(position) * Vec3::from(sway);
            *root = keep_inside(moved, bounds, position);
        }
    }

    /// F(u) of a lead root, and `F_ext`.
    fn share_and_swing(&self, lead: usize, time_s: f64, step: u64) -> (f32, f32) {
        let (fuel, u) = (&self.settings.fuel, self.roots.leads[lead].u);
        let share = match &self.function {
            Some(function) => function.value(u, time_s),
            // A point has no left and right: all of its fuel burns there.
            None if self.roots.leads.len() == 1 => 1.0,
            None => fuel.distribution.value(u, fuel.form, self.tongues[lead].share),
        };
        (share, fuel.swing.value(time_s, step, self.seed, lead as u32))
    }

    /// Paper 003: a push at every root.
    fn push(&mut self, time_s: f64, step: u64) {
        let power = self.fire.flow(1.0);
        self.flow = power;
        let s = &self.settings.skeletons;
        let rows = &self.roots.peripherals;
        let (fuel, leads) = (&self.settings.fuel, self.roots.leads.len());
        for i in 0..leads {
            let (share, swing) = self.share_and_swing(i, time_s, step);
            let acceleration = power * fuel.acceleration_m_s2(share, swing);
            let beside = rows.iter().filter(|r| r.lead == i).count() as f32;
            // Half of the drive acts at the lead root, half is shared out around it.
            self.doings.sources.push(Source {
                position: self.chains.root(i),
                acceleration_m_s2: 0.5 * acceleration,
                reach_m: 2.0 * s.width_m,
                radius_m: 2.0 * s.width_m,
                heat_k_s: power * (fuel.heat_k_s * (share + swing).max(0.0)).min(MAX_HEAT_K_S),
            });
            for (r, _) in rows.iter().enumerate().filter(|(_, row)| row.lead == i) {
                self.doings.sources.push(Source {
                    position: self.chains.root(leads + r),
                    acceleration_m_s2: 0.5 * acceleration / beside,
                    reach_m: 2.0 * s.width_m,
                    radius_m: 2.0 * s.width_m,
                    heat_k_s: 0.0,
                });
            }
        }
    }

    /// Half of the width over which the wick lets fuel in, m.
    pub(super) fn wick_radius_m(&self) -> f32 {
        match self.settings.wick {
            WickShape::Polyline { radius_m, .. } => radius_m,
            WickShape::Vertices(_) => 0.5 * self.settings.skeletons.width_m,
        }
    }

    /// Fuel from each stretch of the wick. Distributions spread the whole rate over the wick; a function of the
    /// user's is a factor on an even spread.
    fn feed(&mut self, time_s: f64, step: u64) {
        let Drive::Combustion { fuel, .. } = self.settings.drive else { return };
        let kilowatts = self.settings.drive.power_kw().unwrap_or(0.0);
        let leads = self.roots.leads.len();
        let radius_m = self.wick_radius_m();
        let (mut whole, mut flow) = (0.0, 0.0);
        for i in 0..leads {
            // The stretch from halfway to the root before to halfway to the next.
            let at = |k: usize| self.chains.root(k);
            let low = at(i).midpoint(at(i.saturating_sub(1)));
            let high = at(i).midpoint(at((i + 1).min(leads - 1)));
            let half = 0.5 * (high - low);
            let length = if leads == 1 { 1.0 } else { half.length() };
            let (share, swing) = self.share_and_swing(i, time_s, step);
            whole += if self.function.is_some() { length } else { length * share };
            let wanted = length * share * (1.0 + swing).max(0.0);
            flow += wanted;
            let position = low.midpoint(high);
            self.doings.feeds.push(Feed { position, half, radius_m, kg_s: wanted, vapour_kg_m3: fuel.vapour_kg_m3() });
        }
        // Swing and the function change the flow; that of the supply's last step is what is left.
        let wanted = if whole > 0.0 { flow / whole } else { 0.0 };
        self.flow = self.fire.flow(wanted);
        let kg_s = self.flow * kilowatts / fuel.gas().heat_kj_kg;
        for feed in &mut self.doings.feeds {
            feed.kg_s *= if flow > 0.0 { kg_s / flow } else { 0.0 };
        }
    }

    /// Heat that it radiates now, W; none with root forces.
    pub(crate) fn radiated_w(&self) -> Option<f32> {
        let radiated = self.settings.drive.fuel()?.gas().radiated;
        Some(1e3 * radiated * self.flow * self.settings.drive.power_kw()?)
    }

    /// What the wick feels of the air.
    pub(crate) fn feel(&self, air: &impl Air) -> Felt {
        let leads = &self.roots.leads;
        let (mut hottest, mut velocity) = (0.0_f32, Vec3::ZERO);
        for (i, lead) in leads.iter().enumerate() {
            let mut gas = [Gas::default()];
            air.gas(&[lead.position], &mut gas);
            hottest = hottest.max(gas[0].temperature_k);
            velocity += air.velocity(lead.position) - self.carried.speed(i);
        }
        // What a fire draws in from both sides cancels; what it lifts is not wind.
        let wind = velocity.with_y(0.0) / leads.len() as f32;
        let width = 2.0 * self.settings.skeletons.width_m;
        let bears_m_s = self.settings.life.blow_out_m_s(&self.settings.drive, width);
        Felt { temperature_k: hottest, speed_m_s: wind.length(), bears_m_s }
    }
}
