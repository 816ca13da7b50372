//! One flame: its roots, chains, net, surface and the tips that broke away from it.

mod build;
mod hot;
mod roots;
mod save;
mod shed;

use crate::air::Air;
use crate::chains::Chains;
use crate::detail::Follower;
use crate::free::{self, Free};
use crate::fuel::FuelFunction;
use crate::life::Fire;
use crate::place::Carried;
use crate::random::{PERIOD, Pcg, hash, noise_3d};
use crate::roots::Roots;
use crate::surface::{PlanKey, Surface, SurfacePlan};
use crate::{Centreline, Drive, FlameError, FlameSettings};
use glam::Vec3;
use hot::Hot;
use lucerna_frame::blackbody_rgb;
pub(crate) use roots::{Doings, Feed};
pub(crate) use save::SavedFlame;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How much of its life a flame spans when it is lit; it grows from there.
const KINDLING: f32 = 0.05;
/// Most heating of a root that the air takes, K/s.
pub(crate) const MAX_HEAT_K_S: f32 = 1e6;
/// Most free flames of one flame.
pub(crate) const MAX_FREE: usize = 12;

/// What a root does to the air during one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Source {
    /// Where, m.
    pub position: Vec3,
    /// Upward acceleration of a cube of air with the edge `reach_m`, m/s^2.
    pub acceleration_m_s2: f32,
    /// How far the push reaches, m.
    pub reach_m: f32,
    /// Radius of the heated ball, m.
    pub radius_m: f32,
    /// Heating, K/s.
    pub heat_k_s: f32,
}

/// The tongue over one lead root.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Tongue {
    /// The random number of `FuelDistribution::Random`.
    share: f32,
    /// How much of the chains' life it spans, up to 1; less after its tip broke away.
    reach: f32,
    /// Where `reach` draws back to, while it does.
    cut: Option<f32>,
}

/// One flame.
#[derive(Debug)]
pub(crate) struct Flame {
    pub(crate) settings: FlameSettings,
    /// Where the wick of `settings` runs.
    pub(crate) centreline: Arc<Centreline>,
    pub(crate) roots: Roots,
    seed: u64,
    rng: Pcg,
    tongues: Vec<Tongue>,
    /// Where its wick is now; `roots` are there.
    pub(crate) carried: Carried,
    pub(crate) fire: Fire,
    pub(crate) function: Option<FuelFunction>,
    /// Share of the full rate at which fuel flows in this step.
    flow: f32,
    /// The shape of what burns in the air; none with root forces.
    hot: Option<Hot>,
    pub(crate) chains: Chains,
    /// How far the eddies have risen, m.
    drift_m: f64,
    /// Spines of all tongues, M + 1 points each, and their lengths.
    spines: Vec<Vec3>,
    lengths: Vec<f32>,
    row: Vec<Vec3>,
    /// How far rows may stray along the wick from each point of their spine, m.
    rooms: Vec<f32>,
    heights: Vec<f32>,
    pub(crate) net: Vec<[f32; 3]>,
    raw_net: Vec<[f32; 3]>,
    pub(crate) plan: Arc<SurfacePlan>,
    pub(crate) free_plan: Arc<SurfacePlan>,
    pub(crate) surface: Surface,
    pub(crate) free: Vec<Free>,
    pub(crate) body: Vec3,
    /// What the roots do to the air in the coming step.
    pub(crate) doings: Doings,
    /// The plans of the surfaces where they are coarse.
    pub(crate) coarse_plan: Arc<SurfacePlan>,
    coarse_free_plan: Arc<SurfacePlan>,
    pub(crate) follower: Follower,
}

impl Flame {
    /// `centreline` is that of the wick, where it is known.
    pub(crate) fn new(
        settings: FlameSettings,
        seed: u64,
        centreline: Option<Arc<Centreline>>,
        mut plan: impl FnMut(PlanKey) -> Result<Arc<SurfacePlan>, FlameError>,
    ) -> Result<Self, FlameError> {
        settings.check()?;
        let s = &settings.skeletons;
        let centreline = match centreline {
            Some(known) => known,
            None => Arc::new(settings.wick.centreline()?),
        };
        let roots = Roots::place(&centreline, s.slices, s.width_m);
        let (leads, rows) = (roots.leads.len(), roots.peripherals.len());
        let points = s.particles as usize + 1;
        let grid = settings.surface;
        let key = PlanKey {
            rows,
            columns: points + 2,
            around: grid.around as usize,
            up: grid.up as usize,
            tip_softness: grid.tip_softness,
        };
        // Free flames are small: half the samples do.
        let free_key =
            PlanKey { rows: free::ROWS, around: (key.around / 4 * 2).max(8), up: (key.up / 2).max(6), ..key };
        let coarse = |key: PlanKey| PlanKey {
            around: (key.around / 4 * 2).clamp(key.around.min(8), key.around),
            up: (key.up / 2).clamp(key.up.min(6), key.up),
            ..key
        };
        let mut rng = Pcg::new(seed);
        let tongues = (0..leads).map(|_| Tongue { share: rng.next_unit(), reach: KINDLING, cut: None }).collect();
        let rest = roots.leads.iter().map(|l| l.position).chain(roots.peripherals.iter().map(|p| p.position));
        let fire = Fire::new(&settings.life, &settings.drive);
        let hot = (settings.drive != Drive::RootForces).then(|| Hot::new(leads, rows, points));
        // The sides of gas that burns are looked for in the air: only its spines are chains.
        let skeletons = if hot.is_some() { leads } else { leads + rows };
        let chains = Chains::new(rest.take(skeletons).collect(), s.lead_life_s, s.width_m);
        let pool = if hot.is_some() {
            hot::FREE
        } else if s.shed_per_s > 0.0 {
            (2.0 * s.shed_per_s * s.free_life_s).ceil() as usize + 1
        } else {
            0
        };
        let (own_plan, free_plan) = (plan(key)?, plan(free_key)?);
        Ok(Self {
            seed,
            rng,
            tongues,
            carried: Carried::default(),
            fire,
            function: None,
            flow: fire.power,
            hot,
            chains,
            drift_m: 0.0,
            spines: vec![Vec3::ZERO; leads * points],
            lengths: vec![0.0; leads * points],
            row: vec![Vec3::ZERO; points],
            rooms: vec![0.0; leads * points],
            heights: vec![0.0; points],
            net: vec![[0.0; 3]; rows * (points + 2)],
            raw_net: Vec::with_capacity(rows * (points + 2)),
            surface: Surface::of_size(&own_plan),
            free: (0..pool.min(MAX_FREE)).map(|_| Free::new(points, &free_plan)).collect(),
            plan: own_plan,
            free_plan,
            body: blackbody_rgb(settings.shade.temperature_k),
            doings: Doings::default(),
            coarse_plan: plan(coarse(key))?,
            coarse_free_plan: plan(coarse(free_key))?,
            follower: Follower::default(),
            settings,
            centreline,
            roots,
        })
    }

    /// Takes over what burned in `old`, where it has the same skeletons.
    pub(crate) fn inherit(&mut self, old: &Self) {
        if self.settings.wick == old.settings.wick {
            self.function.clone_from(&old.function);
            let (new, before) = (&self.settings, &old.settings);
            if new.life.lit == before.life.lit {
                let same_supply = new.life.supply == before.life.supply && new.drive == before.drive;
                let left_s = if same_supply { old.fire.left_s } else { self.fire.left_s };
                self.fire = old.fire;
                self.fire.left_s = left_s;
            }
        }
        let same_roots = self.roots.leads.len() == old.roots.leads.len();
        if self.settings.wick == old.settings.wick && same_roots && self.chains.skeletons() == old.chains.skeletons() {
            self.chains = old.chains.clone();
            self.chains.set_life(self.settings.skeletons.lead_life_s);
            if let (Some(hot), Some(old)) = (&mut self.hot, &old.hot) {
                hot.inherit(old);
            }
            self.rng = old.rng.clone();
            self.drift_m = old.drift_m;
            self.place(old.carried.pose, 1.0);
            self.tongues.clone_from(&old.tongues);
            if self.row.len() == old.row.len() {
                self.free.iter_mut().zip(&old.free).for_each(|(free, old)| free.inherit(old));
            }
            self.trace_spines();
        }
    }

    /// Emits, carries and retires particles; breaks and regrows tips.
    pub(crate) fn step(&mut self, air: &impl Air, dt_s: f32) {
        let is_asleep = self.follower.is_asleep();
        self.follower.step(dt_s);
        if is_asleep {
            return;
        }
        let felt = self.feel(air);
        self.fire.step(&self.settings.life, &self.settings.drive, felt, self.flow, dt_s);
        if self.hot.is_some() {
            self.step_hot(air, dt_s);
            return;
        }
        let s = &self.settings.skeletons;
        let leads = self.roots.leads.len();
        // The gas expands while it is young: outward speed v e^(-age / t), integrated exactly.
        let t = s.expansion_s();
        let (life, size, drift) = (s.lead_life_s, s.turbulence_m, self.drift_m as f32);
        let (rows, eddies) = (&self.roots.peripherals, hash(self.seed) as u32);
        self.chains.step(air, dt_s, |k, age, point| {
            let mut push = Vec3::ZERO;
            if k >= leads && s.expansion_m_s > 0.0 {
                let way = s.expansion_m_s * t * ((-age / t).exp() - (-(age + dt_s) / t).exp());
                push += rows[k - leads].outward * way;
            }
            if s.turbulence_m_s > 0.0 {
                // Anchored at the root, in full by half of the life. The eddies rise with the gas.
                let ramp = (2.0 * age / life).min(1.0);
                let at = (point - Vec3::Y * drift) / size;
                let noise = noise_3d(eddies, at) + 0.35 * noise_3d(eddies ^ 1, at * 2.0);
                push += noise * (s.turbulence_m_s * ramp * dt_s);
            }
            push
        });
        for free in &mut self.free {
            free.step(air, dt_s, false);
        }
        self.trace_spines();
        let points = self.row.len();
        let lengths: f32 = (0..leads).map(|i| self.lengths[(i + 1) * points - 1] / self.tongues[i].reach).sum();
        let rise = f64::from(lengths / leads as f32 / life);
        // Both octaves of the eddies repeat after so far.
        let repeat = PERIOD as f64 * f64::from(size);
        self.drift_m = (self.drift_m + 0.7 * rise * f64::from(dt_s)) % repeat;
        self.regrow(dt_s);
        self.shed(dt_s);
    }
}
