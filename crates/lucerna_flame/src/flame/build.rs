//! From chains to nets and surfaces.

use super::Flame;
use crate::net::{self, Shaping};
use crate::random::Fnv;
use crate::spine::{self, Limits, Spine};
use crate::surface::{Surface, SurfacePlan, Surfaces};
use glam::Vec3;
use lucerna_frame::FlameShade;
use std::sync::Arc;

/// Radius of the tightest bend of a spine, as a share of the flame's width.
const TIGHTEST: f32 = 0.5;
/// Least length of a spine, as a share of the flame's width.
const SHORTEST: f32 = 1.0;
/// Age of the gas at the tip from which a flame that burns in the air is drawn in full, s.
const SEEN_S: f32 = 0.02;
/// Least distance of neighbouring lead skeletons along the wick, as a share of that of their roots.
const LEAST_GAP: f32 = 0.25;

impl Flame {
    /// Reads the lead chains at their fixed ages.
    pub(super) fn trace_spines(&mut self) {
        let points = self.row.len();
        let s = &self.settings.skeletons;
        let spines = self.spines.chunks_exact_mut(points).zip(self.lengths.chunks_exact_mut(points));
        for (i, ((spine, lengths), tongue)) in spines.zip(&self.tongues).enumerate() {
            let age_s = self.hot.as_ref().map_or(s.lead_life_s * tongue.reach, |hot| hot.tip_s(i));
            self.chains.sample(i, age_s / (points - 1) as f32, spine);
            // The row after a lead's number is beside it.
            let is_line = self.roots.leads.len() > 1;
            let along = if is_line { self.roots.peripherals[i + 1].outward.cross(Vec3::Y) } else { Vec3::ZERO };
            let (least_m, bend_m) = (SHORTEST * s.width_m, TIGHTEST * s.width_m);
            let limits = Limits { stands: Vec3::Y, least_m, bend_m, along };
            spine::straighten(spine, lengths, &mut self.row, limits);
        }
        self.part_spines();
    }

    /// Keeps the lead skeletons in the order of their roots: where two crossed, the surface would turn over.
    fn part_spines(&mut self) {
        let (points, leads) = (self.row.len(), self.roots.leads.len());
        let middle = leads / 2;
        let apart = |spines: &mut [Vec3], lengths: &mut [f32], fixed: usize, moved: usize| {
            let rest = self.roots.leads[moved].position - self.roots.leads[fixed].position;
            let flat = rest.with_y(0.0);
            let (away, least) = (flat.normalize_or_zero(), LEAST_GAP * flat.length());
            for k in 0..points {
                let gap = spines[moved * points + k] - spines[fixed * points + k];
                spines[moved * points + k] += away * (least - gap.dot(away)).max(0.0);
            }
            let range = moved * points..(moved + 1) * points;
            spine::measure(&spines[range.clone()], &mut lengths[range]);
        };
        for moved in middle + 1..leads {
            apart(&mut self.spines, &mut self.lengths, moved - 1, moved);
        }
        for moved in (0..middle).rev() {
            apart(&mut self.spines, &mut self.lengths, moved + 1, moved);
        }
        self.rooms.fill(f32::INFINITY);
        for right in points..leads * points {
            let room = 0.5 * self.spines[right].distance(self.spines[right - points]);
            self.rooms[right] = room;
            self.rooms[right - points] = self.rooms[right - points].min(room);
        }
    }

    /// Makes the control net.
    pub(super) fn build_net(&mut self) {
        if self.hot.is_none() {
            self.trace_spines();
        }
        let points = self.row.len();
        let s = &self.settings.skeletons;
        let leads = self.roots.leads.len();
        // A closed cubic through four points passes at 2/3 of their distance from the middle.
        let spread = if leads == 1 { 1.5 } else { 1.0 };
        for (r, (out, root)) in self.net.chunks_exact_mut(points + 2).zip(&self.roots.peripherals).enumerate() {
            let range = root.lead * points..(root.lead + 1) * points;
            let spine = Spine { points: &self.spines[range.clone()], lengths: &self.lengths[range.clone()] };
            if let Some(hot) = &self.hot {
                net::around(&spine, &mut self.row, &mut self.heights, root.outward, hot.row(r, points));
                let (least_m, most_m) = (0.1 * s.width_m, 1e3);
                let how = Shaping { outward: root.outward, least_m, most_m, taper: 0.0, spread };
                net::shape(&spine, &mut self.row, &self.heights, &self.rooms[range], how);
                net::write_row(out, &spine, &self.row);
                continue;
            }
            let reach = self.tongues[root.lead].reach;
            self.chains.sample(leads + r, s.peripheral_life_s * reach / (points - 1) as f32, &mut self.row);
            net::unfold(&spine, &mut self.row, &mut self.heights);
            let how = Shaping {
                outward: root.outward,
                least_m: 0.15 * s.width_m,
                // A short flame wider than it is long would be a disc that every breath turns over.
                most_m: (2.0 * (s.width_m + s.expansion_m_s * s.expansion_s())).min(0.5 * spine.total()),
                taper: s.taper,
                spread,
            };
            net::shape(&spine, &mut self.row, &self.heights, &self.rooms[range], how);
            net::write_row(out, &spine, &self.row);
        }
        if leads > 1 {
            let (spines, lengths, rim) = (&self.spines, &self.lengths, &self.roots.peripherals);
            net::relax(&mut self.net, points + 2, |row| {
                let range = rim[row].lead * points..(rim[row].lead + 1) * points;
                (Spine { points: &spines[range.clone()], lengths: &lengths[range] }, rim[row].outward)
            });
        }
        self.calm_net(spread);
    }

    /// Where the air turns parts of the net inside out, draws it over to a plain flame: horizontal cuts one over the
    /// other, in the direction in which the tongues lean on the whole.
    fn calm_net(&mut self, spread: f32) {
        let points = self.row.len();
        let s = &self.settings.skeletons;
        let leads = self.roots.leads.len();
        let reaches = || self.spines.chunks_exact(points).map(|spine| spine[points - 1] - spine[0]);
        let mean = reaches().sum::<Vec3>() / leads as f32;
        let flat = mean.with_y(0.0).clamp_length_max(1.5 * mean.y.max(0.0));
        let length = (reaches().map(Vec3::length).sum::<f32>() / leads as f32).max(SHORTEST * s.width_m);
        let way = flat.with_y(mean.y.max(0.0)).normalize_or(Vec3::Y) * length;
        let plain = |i: usize| {
            let (row, column) = (i / (points + 2), i % (points + 2));
            let root = &self.roots.peripherals[row];
            let foot = self.spines[root.lead * points];
            match column {
                0 => foot + way,
                c if c == points + 1 => foot,
                c => {
                    let x = (points - c) as f32 / (points - 1) as f32;
                    let narrow = 1.0 - s.taper * x * x;
                    foot + way * (net::HIGHEST * x) + root.outward * (s.width_m * narrow * spread)
                }
            }
        };
        let (surface, plan) = (&mut self.surface, &self.plan);
        net::calm(&mut self.net, &mut self.raw_net, plain, |net| surface.is_right_side_out(plan, net));
    }

    /// Makes the nets and surfaces of the flame and of its free flames.
    pub(crate) fn build(&mut self, surfaces: Surfaces) {
        let follower = &self.follower;
        let (is_coarse, follows, is_asleep) = (follower.is_coarse, follower.follow.is_some(), follower.is_asleep());
        if is_asleep {
            return;
        }
        self.build_nets();
        if self.fire.burns() && !follows {
            if is_coarse {
                self.surface.is_right_side_out(&self.coarse_plan, &self.net);
            }
            let plan = if is_coarse { &self.coarse_plan } else { &self.plan };
            self.surface.build(plan, &self.net, surfaces);
        }
        let plan = if is_coarse { &self.coarse_free_plan } else { &self.free_plan };
        for free in self.free.iter_mut().filter(|f| f.burning) {
            if is_coarse {
                free.surface.is_right_side_out(plan, &free.net);
            }
            free.surface.build(plan, &free.net, surfaces);
        }
    }

    /// Makes the nets of the flame and of its free flames.
    pub(crate) fn build_nets(&mut self) {
        if self.fire.burns() {
            self.build_net();
        }
        for free in self.free.iter_mut().filter(|f| f.burning) {
            free.build_net(&self.free_plan);
        }
    }

    /// The plan that its surface, or those of its free flames, are drawn with.
    pub(crate) fn drawn_plan(&self, is_free: bool) -> &Arc<SurfacePlan> {
        match (is_free, self.follower.is_coarse) {
            (false, false) => &self.plan,
            (false, true) => &self.coarse_plan,
            (true, false) => &self.free_plan,
            (true, true) => &self.coarse_free_plan,
        }
    }

    /// Most surfaces that it can have at once, with their vertices and control points.
    pub(crate) fn most(&self) -> [usize; 3] {
        let free = self.free.len();
        let points = self.net.len() + self.free.iter().map(|free| free.net.len()).sum::<usize>();
        [1 + free, self.plan.vertex_count() + free * self.free_plan.vertex_count(), points]
    }

    /// The surfaces that burn now with their nets, the attached one first, how they are shaded, and whether they are
    /// free.
    pub(crate) fn surfaces(&self) -> impl Iterator<Item = (&Surface, &[[f32; 3]], FlameShade, bool)> {
        let shade = self.settings.shade;
        let attached = FlameShade { strength: shade.strength * self.presence(), ..shade };
        let loose = move |strength: f32| {
            // A free flame has left the wick: it is soot from end to end, without a blue zone.
            let strength = shade.strength * strength;
            FlameShade { soot_begin: 0.0, soot_full: 0.2, blue_per_m: 0.0, dark_radius: 0.0, strength, ..shade }
        };
        let follows = self.follower.follow.is_some();
        let left = if follows { 1.0 - self.follower.blend() } else { 1.0 };
        let own = self.free.iter().filter(move |f| f.burning && left > 0.0);
        let own = own.map(move |f| (&f.surface, &*f.net, loose(left * f.strength()), true));
        let ghosts = self.follower.free.iter().filter(move |ghost| follows && ghost.strength > 0.0);
        let ghosts = ghosts.map(move |ghost| (&ghost.surface, &*ghost.net, loose(ghost.strength), true));
        // Together they are no more than it can have.
        let free = own.chain(ghosts).take(self.free.len());
        let net = if follows { &*self.follower.net } else { &*self.net };
        self.fire.burns().then_some((&self.surface, net, attached, false)).into_iter().chain(free)
    }

    /// How much of its full strength the attached flame is drawn with: it comes and goes smoothly.
    fn presence(&self) -> f32 {
        let rise = |x: f32| {
            let x = x.min(1.0);
            x * x * (3.0 - 2.0 * x)
        };
        // Gas that has hardly caught fire yet has no shape of its own.
        rise(3.0 * self.fire.power) * self.hot.as_ref().map_or(1.0, |hot| rise(hot.tallest_s() / SEEN_S))
    }

    pub(crate) fn hash(&self, fnv: &mut Fnv) {
        fnv.word(self.rng.state());
        self.fire.hash(fnv);
        fnv.float(self.flow);
        if let Some(hot) = &self.hot {
            hot.hash(fnv);
        }
        fnv.word(self.drift_m.to_bits());
        for tongue in &self.tongues {
            fnv.float(tongue.reach);
            fnv.float(tongue.share);
            fnv.float(tongue.cut.unwrap_or(-1.0));
        }
        self.carried.pose.hash(fnv);
        self.chains.hash(fnv);
        self.free.iter().for_each(|f| f.hash(fnv));
        self.follower.numbers().for_each(|number| fnv.word(number));
    }
}
