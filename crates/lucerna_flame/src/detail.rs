//! Level of detail: flames that are small in the picture show what another of their kind does, some time later and
//! turned, and have fewer vertices.
//!
//! The flame that is followed is recorded for two seconds, net by net. From its own nets to those that it follows and
//! back, a flame changes over in a second: it burns on meanwhile, and both nets have the same rows and columns, so that
//! nothing jumps. One that only follows costs no air and no skeletons; when it is to burn for itself again, it goes on
//! from where it stopped.

use crate::flame::Flame;
use crate::surface::{Surface, SurfacePlan, Surfaces};
use crate::{FlameError, Flames};
use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};

/// Nets that are kept of a flame, and the time from one to the next, s: two seconds in all.
const SAMPLES: usize = 120;
const SPACING_S: f32 = 1.0 / 60.0;
/// Time in which a flame changes over, s.
const CHANGE_S: f32 = 1.0;

/// How finely a flame is simulated and drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Detail {
    /// The flame that it follows instead of burning for itself.
    pub follows: Option<Follow>,
    /// Draw it with a quarter of its vertices.
    pub is_coarse: bool,
}

/// Which flame is followed, and how.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Follow {
    /// Its number in the settings; [`Flames::record`] must have been called with it.
    pub flame: usize,
    /// How far behind it, 0 to 1 of what is recorded.
    pub delay: f32,
    /// Quarter turns about y, for flames over a point.
    pub quarter_turns: u8,
}

/// Where a flame is on its way from burning for itself to following.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Follower {
    pub(crate) follow: Option<Follow>,
    /// Whether it is to follow.
    wants: bool,
    /// 0 for its own net, 1 for the other's.
    share: f32,
    pub(crate) is_coarse: bool,
    /// What it shows while it follows at all, and the free flames of the other.
    #[serde(skip)]
    pub(crate) net: Vec<[f32; 3]>,
    #[serde(skip)]
    pub(crate) free: Vec<Ghost>,
}

/// A free flame of the flame that is followed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ghost {
    pub(crate) strength: f32,
    pub(crate) net: Vec<[f32; 3]>,
    pub(crate) surface: Surface,
}

impl Follower {
    /// Whether the flame itself need not burn.
    pub(crate) fn is_asleep(&self) -> bool {
        self.wants && self.share >= 1.0
    }

    /// How far its own net has given way, 0 to 1, smoothly.
    pub(crate) fn blend(&self) -> f32 {
        self.share * self.share * (3.0 - 2.0 * self.share)
    }

    pub(crate) fn step(&mut self, dt_s: f32) {
        let way = if self.wants { dt_s } else { -dt_s };
        self.share = (self.share + way / CHANGE_S).clamp(0.0, 1.0);
        if !self.wants && self.share == 0.0 {
            self.follow = None;
        }
    }

    /// Numbers that the next step depends on; none for a flame that burns for itself.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = u64> {
        let follow = self.follow.map(|follow| {
            [
                follow.flame as u64,
                u64::from(follow.delay.to_bits()),
                u64::from(follow.quarter_turns),
                u64::from(self.wants),
            ]
        });
        follow.into_iter().flatten().chain(follow.map(|_| u64::from(self.share.to_bits())))
    }

    pub(crate) fn is_sound(&self, flames: usize) -> bool {
        let follows = |follow: &Follow| follow.flame < flames && (0.0..=1.0).contains(&follow.delay);
        (0.0..=1.0).contains(&self.share) && self.follow.as_ref().is_none_or(follows)
    }
}

/// One moment of a flame that is recorded.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Sample {
    net: Vec<[f32; 3]>,
    /// Strength and net of every free flame that it can have.
    free: Vec<(f32, Vec<[f32; 3]>)>,
}

/// The last nets of a flame.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Recording {
    flame: usize,
    /// A ring; `next` is written next, and is the oldest once all are there.
    samples: Vec<Sample>,
    next: usize,
    count: usize,
    /// Time since the last one, s.
    since_s: f32,
}

impl Recording {
    fn push(&mut self, flame: &mut Flame, dt_s: f32) {
        self.since_s += dt_s;
        if self.since_s < 0.999 * SPACING_S {
            return;
        }
        self.since_s = 0.0;
        flame.build_nets();
        let sample = &mut self.samples[self.next];
        sample.net.clone_from(&flame.net);
        sample.free.resize_with(flame.free.len(), Default::default);
        for ((strength, net), free) in sample.free.iter_mut().zip(&flame.free) {
            *strength = if free.burning { free.strength() } else { 0.0 };
            net.clone_from(&free.net);
        }
        self.next = (self.next + 1) % self.samples.len();
        self.count = (self.count + 1).min(self.samples.len());
    }

    /// What it was a share of its length ago.
    fn before(&self, delay: f32) -> &Sample {
        let back = 1 + (delay * (self.count.max(1) - 1) as f32) as usize;
        &self.samples[(self.next + self.samples.len() - back) % self.samples.len()]
    }

    fn fits(&self, flames: &[Flame]) -> bool {
        let Some(flame) = flames.get(self.flame) else { return false };
        let finite = |net: &[[f32; 3]]| net.iter().flatten().all(|x| x.is_finite());
        let whole = |sample: &Sample| {
            sample.net.len() == flame.net.len()
                && finite(&sample.net)
                && sample.free.len() == flame.free.len()
                && sample.free.iter().zip(&flame.free).all(|((strength, net), free)| {
                    (0.0..=1.0).contains(strength) && net.len() == free.net.len() && finite(net)
                })
        };
        let written = |i: usize| self.count == SAMPLES || i < self.count;
        self.samples.len() == SAMPLES
            && self.count <= SAMPLES
            && self.next < SAMPLES
            && (self.count == SAMPLES || self.next == self.count)
            && (0.0..=1.0).contains(&self.since_s)
            && self.samples.iter().enumerate().all(|(i, sample)| !written(i) || whole(sample))
    }
}

/// How a net is moved from one flame to another, and which row becomes which.
struct Turn {
    rotation: Quat,
    from: Vec3,
    to: Vec3,
    rows: usize,
}

impl Turn {
    fn new(from: &Flame, to: &Flame, quarter_turns: u8) -> Self {
        let foot = |flame: &Flame| flame.roots.middle_and_length().0;
        let (rotation, rows) = if to.roots.leads.len() == 1 {
            // The four rows lie along the axes: a quarter turn makes each of them the next.
            let turns = quarter_turns % 4;
            (Quat::from_rotation_y(f32::from(turns) * std::f32::consts::FRAC_PI_2), usize::from(turns))
        } else {
            let (a, b) = (from.roots.peripherals[0].outward, to.roots.peripherals[0].outward);
            (Quat::from_rotation_y((b.x.atan2(b.z)) - a.x.atan2(a.z)), 0)
        };
        Self { rotation, from: foot(from), to: foot(to), rows }
    }

    fn point(&self, point: [f32; 3]) -> Vec3 {
        self.to + self.rotation * (Vec3::from(point) - self.from)
    }
}

impl Flame {
    /// Takes over what the flame that it follows showed. Only nets of the same size can be followed.
    fn show(&mut self, sample: &Sample, turn: &Turn) {
        let blend = self.follower.blend();
        let (rows, columns) = (self.plan.key.rows, self.plan.key.columns);
        self.follower.net.resize(self.net.len(), [0.0; 3]);
        for (r, out) in self.follower.net.chunks_exact_mut(columns).enumerate() {
            let theirs = &sample.net[(r + turn.rows) % rows * columns..][..columns];
            for ((out, own), theirs) in out.iter_mut().zip(&self.net[r * columns..]).zip(theirs) {
                *out = Vec3::from(*own).lerp(turn.point(*theirs), blend).to_array();
            }
        }
        self.follower.free.resize_with(sample.free.len(), Ghost::default);
        for (ghost, (strength, net)) in self.follower.free.iter_mut().zip(&sample.free) {
            ghost.strength = strength * blend;
            if ghost.strength > 0.0 {
                ghost.net.clear();
                ghost.net.extend(net.iter().map(|point| turn.point(*point).to_array()));
            }
        }
    }

    /// Makes the surfaces of what it follows.
    pub(crate) fn build_follower(&mut self, surfaces: Surfaces) {
        let (plan, free_plan) = (self.drawn_plan(false).clone(), self.drawn_plan(true).clone());
        let build = |surface: &mut Surface, plan: &SurfacePlan, net: &[[f32; 3]]| {
            surface.is_right_side_out(plan, net);
            surface.build(plan, net, surfaces);
        };
        if self.fire.burns() {
            build(&mut self.surface, &plan, &self.follower.net);
        }
        for ghost in self.follower.free.iter_mut().filter(|ghost| ghost.strength > 0.0) {
            build(&mut ghost.surface, &free_plan, &ghost.net);
        }
    }
}

impl Flames {
    /// Begins to record a flame, so that others can follow it.
    ///
    /// # Errors
    /// When there is no such flame.
    pub fn record(&mut self, flame: usize) -> Result<(), FlameError> {
        let count = self.flames.len();
        if flame >= count {
            return Err(FlameError::NoFlame { flame, count });
        }
        if self.recordings.iter().all(|recording| recording.flame != flame) {
            let samples = vec![Sample::default(); SAMPLES];
            self.recordings.push(Recording { flame, samples, next: 0, count: 0, since_s: 0.0 });
        }
        Ok(())
    }

    /// Whether a flame has been recorded for long enough to be followed.
    #[must_use]
    pub fn is_recorded(&self, flame: usize) -> bool {
        self.recordings.iter().any(|recording| recording.flame == flame && recording.count == SAMPLES)
    }

    /// Says how finely a flame, by its number in the settings, is to be simulated and drawn from now on. It changes
    /// over within a second; a flame that is on its way to or from another keeps to that one until it is back.
    ///
    /// # Errors
    /// When there is no such flame, or it is to follow one that is not recorded, is itself, or has other skeletons.
    pub fn set_detail(&mut self, flame: usize, detail: Detail) -> Result<(), FlameError> {
        let count = self.flames.len();
        if flame >= count {
            return Err(FlameError::NoFlame { flame, count });
        }
        if let Some(follow) = detail.follows {
            let alike = self.flames.get(follow.flame).is_some_and(|other| {
                let own = &self.flames[flame];
                (own.plan.key, own.free_plan.key, own.free.len())
                    == (other.plan.key, other.free_plan.key, other.free.len())
            });
            if !alike
                || follow.flame == flame
                || !self.is_recorded(follow.flame)
                || !(0.0..=1.0).contains(&follow.delay)
            {
                return Err(FlameError::Follow { flame, followed: follow.flame });
            }
        }
        let follower = &mut self.flames[flame].follower;
        follower.is_coarse = detail.is_coarse;
        follower.wants = detail.follows.is_some();
        if follower.follow.is_none() {
            follower.follow = detail.follows;
        }
        Ok(())
    }

    /// Whether a flame burns at its full strength where the scene places it, with fuel that does not run out: only such
    /// flames look alike.
    #[must_use]
    pub fn is_steady(&self, flame: usize) -> bool {
        self.flames.get(flame).is_some_and(|flame| {
            flame.fire.lit
                && flame.fire.power >= 1.0
                && flame.function.is_none()
                && flame.settings.life.supply == crate::Supply::Endless
                && flame.carried.pose == crate::Pose::REST
        })
    }

    /// Whether a flame only follows another, so that its air need not be stepped.
    #[must_use]
    pub fn is_asleep(&self, flame: usize) -> bool {
        self.flames.get(flame).is_some_and(|flame| flame.follower.is_asleep())
    }

    /// How many vertices the attached flame has: in full, and where it is coarse.
    #[must_use]
    pub fn vertex_counts(&self, flame: usize) -> [usize; 2] {
        let plans = self.flames.get(flame).map(|flame| [&flame.plan, &flame.coarse_plan]);
        plans.map_or([0; 2], |plans| plans.map(|plan| plan.vertex_count()))
    }

    /// Records the flames that others may follow.
    pub(crate) fn record_nets(&mut self, dt_s: f32) {
        for recording in &mut self.recordings {
            recording.push(&mut self.flames[recording.flame], dt_s);
        }
    }

    /// Puts the nets that followers show in place.
    pub(crate) fn show_followed(&mut self) {
        for number in 0..self.flames.len() {
            let Some(follow) = self.flames[number].follower.follow else { continue };
            let Some(recording) = self.recordings.iter().find(|recording| recording.flame == follow.flame) else {
                continue;
            };
            let turn = Turn::new(&self.flames[follow.flame], &self.flames[number], follow.quarter_turns);
            self.flames[number].show(recording.before(follow.delay), &turn);
        }
    }

    /// Whether recordings and followers that were read fit these flames.
    pub(crate) fn takes(&self, recordings: &[Recording]) -> bool {
        let recorded = |flame: usize| recordings.iter().any(|known| known.flame == flame && known.count == SAMPLES);
        let alike = |flame: &Flame| {
            flame.follower.follow.is_none_or(|follow| {
                let other = &self.flames[follow.flame];
                recorded(follow.flame) && (other.plan.key, other.free.len()) == (flame.plan.key, flame.free.len())
            })
        };
        recordings.iter().all(|recording| recording.fits(&self.flames)) && self.flames.iter().all(alike)
    }
}
