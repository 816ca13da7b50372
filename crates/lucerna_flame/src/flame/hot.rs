//! The shape of gas that burns in the air: how far each spine reaches, and how wide it is.
//!
//! What is drawn is gas whose fuel has not burnt up: soot forms and glows in it, and burns away with the last of the
//! fuel. Above and beside it there is only hot, clear gas. A spine is the line of particles that left its root, as far
//! up as they are in such gas; around it the edge is looked for in the air.

use super::Flame;
use crate::air::{Air, Gas};
use crate::net::HIGHEST;
use crate::random::Fnv;
use crate::spine::Spine;
use glam::Vec3;
use lucerna_fluid::OXYGEN_IN_AIR;

/// Unburnt fuel at the edge of the flame, over what air burns to the last. Calibrated: candles of 80 W are as high as
/// measured.
const BURNT_OUT: f32 = 0.2;
/// Thickness of a flame's sheet, m. A cell wider than this that a sheet crosses holds less fuel on average, by the share
/// of the cell that it fills. Calibrated with the pan fires.
const SHEET_M: f32 = 0.003;
/// Most tips of one flame that have parted from it and still burn.
pub(super) const FREE: usize = 6;
/// Time in which a parted tip dies down once its fuel has burnt up, s.
const DIES_S: f32 = 0.25;
/// Points on a chain at which the gas is looked at.
const PROBES: usize = 32;
/// Most steps outwards from a spine.
const OUTWARDS: usize = 40;
/// Time in which the drawn edge follows that of the gas, s.
const FOLLOWS_S: f32 = 0.02;
/// Least and greatest time over which particles are kept, s.
const KEPT_S: [f32; 2] = [0.04, 6.0];

/// The shape of one flame's burning gas.
#[derive(Debug)]
pub(crate) struct Hot {
    /// Age of the gas at each tip, s, by lead.
    tips_s: Vec<f32>,
    /// Distance of the edge from the spine, m, by row and point of the spine, from the root.
    radii: Vec<f32>,
    next: Vec<f32>,
    /// One ray outwards for each of them: where it begins, its direction, the last two samples.
    rays: Vec<Ray>,
    points: Vec<Vec3>,
    gas: Vec<Gas>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Ray {
    from: Vec3,
    way: Vec3,
    /// [`Sheet::inside`] a step before.
    before: f32,
    radius_m: f32,
    ended: bool,
}

impl Hot {
    /// What has to be saved of it.
    pub(super) fn saved(&self) -> [Vec<f32>; 2] {
        [self.tips_s.clone(), self.radii.clone()]
    }

    /// Goes on from what was saved, if it fits.
    pub(super) fn restore(&mut self, [tips_s, radii]: &[Vec<f32>; 2]) -> bool {
        let fits = tips_s.len() == self.tips_s.len()
            && radii.len() == self.radii.len()
            && tips_s.iter().chain(radii).all(|value| (0.0..=1e6).contains(value));
        if fits {
            self.tips_s.copy_from_slice(tips_s);
            self.radii.copy_from_slice(radii);
        }
        fits
    }

    pub(super) fn new(leads: usize, rows: usize, points: usize) -> Self {
        let rays = rows * points;
        Self {
            tips_s: vec![0.0; leads],
            radii: vec![0.0; rays],
            next: vec![0.0; rays],
            rays: vec![Ray::default(); rays],
            points: vec![Vec3::ZERO; rays.max(PROBES)],
            gas: vec![Gas::default(); rays.max(PROBES)],
        }
    }

    /// Age of the gas at the highest tip, s.
    pub(super) fn tallest_s(&self) -> f32 {
        self.tips_s.iter().copied().fold(0.0, f32::max)
    }

    /// Age of the gas at the tip of a lead's spine, s.
    pub(super) fn tip_s(&self, lead: usize) -> f32 {
        self.tips_s[lead]
    }

    /// The edge of a row, from the root.
    pub(super) fn row(&self, row: usize, points: usize) -> &[f32] {
        &self.radii[row * points..(row + 1) * points]
    }

    pub(super) fn inherit(&mut self, old: &Self) {
        if self.radii.len() == old.radii.len() && self.tips_s.len() == old.tips_s.len() {
            self.tips_s.clone_from(&old.tips_s);
            self.radii.clone_from(&old.radii);
        }
    }

    pub(super) fn hash(&self, fnv: &mut Fnv) {
        self.tips_s.iter().chain(&self.radii).for_each(|value| fnv.float(*value));
    }
}

/// How gas is judged.
#[derive(Clone, Copy)]
struct Sheet {
    /// Mass fraction of fuel at its edge.
    fuel: f32,
}

impl Sheet {
    /// Fuel beyond that at the edge, kg a kg: above 0 inside the flame.
    fn inside(self, gas: Gas) -> f32 {
        gas.fuel - self.fuel
    }
}

impl Flame {
    /// Carries the particles and finds the shape anew.
    pub(super) fn step_hot(&mut self, air: &impl Air, dt_s: f32) {
        let oxygen = self.settings.drive.fuel().map_or(1.0, |fuel| fuel.gas().oxygen_kg_kg);
        let filled = (SHEET_M / air.cell_m().max(1e-6)).min(1.0);
        let sheet = Sheet { fuel: BURNT_OUT * filled * OXYGEN_IN_AIR / (oxygen + OXYGEN_IN_AIR) };
        let Some(hot) = &mut self.hot else { return };
        let tallest = hot.tallest_s();
        self.chains.set_life((1.5 * tallest + 4.0 * dt_s).clamp(KEPT_S[0], KEPT_S[1]));
        self.chains.step(air, dt_s, |_, _, _| Vec3::ZERO);
        for free in self.free.iter_mut().filter(|free| free.burning) {
            let gas = &mut hot.gas[..free.spine().len()];
            air.gas(free.spine(), gas);
            let lasts = gas.iter().any(|gas| sheet.inside(*gas) > 0.0);
            free.step(air, dt_s, lasts);
        }
        let width = self.settings.skeletons.width_m;
        let mut parted = None;
        for lead in 0..hot.tips_s.len() {
            let oldest = self.chains.oldest_s();
            let spacing = oldest / (PROBES - 1) as f32;
            let (points, gas) = (&mut hot.points[..PROBES], &mut hot.gas[..PROBES]);
            self.chains.sample(lead, spacing, points);
            air.gas(points, gas);
            let (tip, beyond) = reach(points, gas, sheet, width);
            let tip = spacing * tip;
            let now = &mut hot.tips_s[lead];
            // What was part of the flame a moment ago has parted from it.
            if let Some([low, high]) = beyond.map(|ends| ends.map(|k| spacing * k as f32))
                && tip > 0.0
                && *now >= 0.5 * (low + high)
                && self.fire.lit
            {
                parted = parted.or(Some((lead, (low / *now).min(0.9), *now)));
            }
            // Gas rises no faster than it ages, however much of it there is.
            *now += (tip - *now).min(dt_s).max(-*now * (1.0 - (-dt_s / FOLLOWS_S).exp()));
        }
        if let Some((lead, cut, tip_s)) = parted
            && self.free.iter().any(|free| !free.burning)
        {
            self.build_net();
            self.cut_off(lead, cut, DIES_S);
            if let Some(hot) = &mut self.hot {
                hot.tips_s[lead] = cut * tip_s;
            }
        }
        self.trace_spines();
        self.measure(air, sheet, dt_s);
    }

    /// Looks for the edge outwards from all points of the spines, all rays a step at a time.
    fn measure(&mut self, air: &impl Air, sheet: Sheet, dt_s: f32) {
        // A flame sits on the rim of its wick; a coarse grid would spread its foot.
        let rim_m = self.wick_radius_m() + 0.5 * SHEET_M;
        let Some(hot) = &mut self.hot else { return };
        let n = self.row.len();
        let width = self.settings.skeletons.width_m;
        let step = if air.cell_m() > 0.0 { 0.5 * air.cell_m() } else { 0.1 * width };
        for (r, root) in self.roots.peripherals.iter().enumerate() {
            let range = root.lead * n..(root.lead + 1) * n;
            let spine = Spine { points: &self.spines[range.clone()], lengths: &self.lengths[range] };
            for k in 0..n {
                let length = spine.total() * HIGHEST * k as f32 / (n - 1) as f32;
                let way = spine.lean(length) * root.outward;
                hot.rays[r * n + k] = Ray { from: spine.at(length), way, ..Ray::default() };
            }
        }
        for i in 0..OUTWARDS {
            let distance = step * i as f32;
            for (point, ray) in hot.points.iter_mut().zip(&hot.rays) {
                *point = ray.from + ray.way * distance;
            }
            air.gas(&hot.points[..hot.rays.len()], &mut hot.gas[..hot.rays.len()]);
            let mut all_ended = true;
            for (ray, gas) in hot.rays.iter_mut().zip(&hot.gas).filter(|(ray, _)| !ray.ended) {
                let here = sheet.inside(*gas);
                if here < 0.0 {
                    ray.ended = true;
                    let share = ray.before / (ray.before - here).max(1e-6);
                    ray.radius_m = (distance - step + step * share.clamp(0.0, 1.0)).max(0.0);
                } else {
                    (ray.before, ray.radius_m, all_ended) = (here, distance, false);
                }
            }
            if all_ended {
                break;
            }
        }
        hot.rays.iter_mut().step_by(n).for_each(|root| root.radius_m = root.radius_m.min(rim_m));
        // What was drawn rises with the gas, and follows the edge that was found.
        let follow = 1.0 - (-dt_s / FOLLOWS_S).exp();
        for (r, root) in self.roots.peripherals.iter().enumerate() {
            let rise = dt_s * (n - 1) as f32 / hot.tips_s[root.lead].max(dt_s);
            let old = &hot.radii[r * n..(r + 1) * n];
            for k in 0..n {
                let x = (k as f32 - rise).max(0.0);
                let (i, part) = (x as usize, x.fract());
                let risen = old[i] + (old[(i + 1).min(n - 1)] - old[i]) * part;
                hot.next[r * n + k] = risen + follow * (hot.rays[r * n + k].radius_m - risen);
            }
        }
        std::mem::swap(&mut hot.radii, &mut hot.next);
    }
}

/// How far up a chain the flame reaches, in points (it may begin a little above the root), and the first and last point
/// of the next stretch that burns, where it is longer than the wick is wide.
fn reach(points: &[Vec3], gas: &[Gas], sheet: Sheet, width_m: f32) -> (f32, Option<[usize; 2]>) {
    let near = |k: &usize| points[*k].distance(points[0]) <= 2.0 * width_m;
    let (last, inside) = (points.len() - 1, |k: usize| sheet.inside(gas[k]));
    let Some(first) = (0..=last).take_while(near).find(|k| inside(*k) >= 0.0) else { return (0.0, None) };
    let Some(end) = (first..=last).find(|k| inside(*k) < 0.0) else { return (last as f32, None) };
    let tip = (end - 1) as f32 + inside(end - 1) / (inside(end - 1) - inside(end)).max(1e-9);
    let beyond = (end..=last).find(|k| inside(*k) >= 0.0).map(|low| {
        let high = (low..=last).find(|k| inside(*k) < 0.0).unwrap_or(last);
        [low, high]
    });
    (tip, beyond.filter(|[low, high]| points[*low].distance(points[*high]) > width_m))
}
