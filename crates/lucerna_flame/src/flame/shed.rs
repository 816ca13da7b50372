//! Tips that break away: a tongue is cut at half of its height or above, its upper part becomes a
//! free flame at the same place, and what is left regrows more slowly than the gas rises.

use super::{Flame, KINDLING};
use crate::free::{BREAK_S, ROWS, frames};
use crate::spine::Spine;
use glam::Vec3;

/// How fast a broken tip regrows, as a share of the speed at which the gas itself rises.
const REGROWTH: f32 = 0.6;

impl Flame {
    /// Draws cut tongues back, then lets them grow.
    pub(super) fn regrow(&mut self, dt_s: f32) {
        let rate = REGROWTH / self.settings.skeletons.lead_life_s;
        let most = if self.fire.power < 1.0 { KINDLING.max(self.fire.power) } else { 1.0 };
        for tongue in &mut self.tongues {
            match tongue.cut {
                Some(cut) => {
                    tongue.reach -= (1.0 - cut) * dt_s / BREAK_S;
                    if tongue.reach <= cut {
                        (tongue.reach, tongue.cut) = (cut, None);
                    }
                }
                None => tongue.reach = (tongue.reach + rate * dt_s).min(most),
            }
        }
    }

    /// Breaks a tip away, now and then: a Poisson process, so that its rate does not depend on the step.
    pub(super) fn shed(&mut self, dt_s: f32) {
        let s = &self.settings.skeletons;
        if s.shed_per_s <= 0.0 {
            return;
        }
        let (chance, pick, height) = (self.rng.next_unit(), self.rng.next_unit(), self.rng.next_unit());
        if chance >= -(-s.shed_per_s * dt_s).exp_m1() {
            return;
        }
        let lead = ((pick * self.tongues.len() as f32) as usize).min(self.tongues.len() - 1);
        let points = self.row.len();
        let tall = self.lengths[(lead + 1) * points - 1] > 4.0 * s.width_m;
        let whole = self.tongues[lead].reach > 0.95 && self.tongues[lead].cut.is_none();
        if tall && whole && self.free.iter().any(|f| !f.burning) {
            self.build_net();
            let cut = 0.5 + 0.4 * height;
            self.tongues[lead].cut = Some(cut);
            self.cut_off(lead, cut, self.settings.skeletons.free_life_s);
        }
    }

    /// Makes a free flame of what lies above the share `cut` of a tongue.
    pub(super) fn cut_off(&mut self, lead: usize, cut: f32, life_s: f32) {
        let n = self.row.len();
        let Some(free) = self.free.iter_mut().find(|f| !f.burning) else { return };
        let range = lead * n..(lead + 1) * n;
        let spine = Spine { points: &self.spines[range.clone()], lengths: &self.lengths[range] };
        // Rows of the net hold their chain from the top downwards, between the two lead points.
        let net = &self.net;
        let chain = |row: usize, x: f32| {
            let x = x.clamp(0.0, 1.0) * (n - 1) as f32;
            let i = (x as usize).min(n - 2);
            let at = |i: usize| Vec3::from(net[row * (n + 2) + n - i]);
            at(i).lerp(at(i + 1), x - i as f32)
        };
        let leads = self.roots.leads.len();
        let sides = if leads == 1 { [1, 3] } else { [lead + 1, 2 * leads + 1 - lead] };
        let bottom = spine.length_at(0.5 * (chain(sides[0], cut) + chain(sides[1], cut)));
        let width = self.settings.skeletons.width_m;
        let side = self.roots.peripherals[sides[0]].outward;
        let (middle, rows) = free.light(life_s, side, self.hot.is_some()).split_at_mut(n);
        for (k, point) in middle.iter_mut().enumerate() {
            *point = spine.at(bottom + (spine.total() - bottom) * k as f32 / (n - 1) as f32);
        }
        for (k, (centre, axes)) in middle.iter().zip(frames(middle, side)).enumerate() {
            let x = cut + (1.0 - cut) * k as f32 / (n - 1) as f32;
            let local = axes.transpose();
            // Only what is across the spine: the rows keep to its points.
            let from_spine = |row: usize| (local * (chain(row, x) - *centre)).with_z(0.0);
            let around: [Vec3; ROWS] = if leads == 1 {
                [0, 1, 2, 3].map(from_spine)
            } else {
                // The two sides of the tongue, and as far along the wick; four points need the factor 1.5.
                let (a, b) = (from_spine(sides[0]), from_spine(sides[1]));
                let (across, off) = (0.75 * (a - b), 0.5 * (a + b));
                let along = across.cross(Vec3::Z);
                [off - along, off + across, off + along, off - across]
            };
            // A tip that eddies have torn wide would become a mushroom.
            let share = k as f32 / (n - 1) as f32;
            let tip = 1.0 - 0.7 * share * share * share;
            for (r, point) in around.into_iter().enumerate() {
                rows[r * n + k] = point.clamp_length_max(2.0 * width) * tip;
            }
        }
    }
}
