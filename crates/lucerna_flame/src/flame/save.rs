//! What makes a flame go on as it would have.

use super::{Flame, Tongue};
use crate::Pose;
use crate::chains::Chains;
use crate::detail::Follower;
use crate::free::Free;
use crate::life::Fire;
use crate::random::Pcg;
use serde::{Deserialize, Serialize};

/// Greatest age that is read, s: lives are at most 60 s, and steps 10 s.
const OLDEST_S: f32 = 1e3;

/// The state of one flame: all that its settings do not say.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct SavedFlame {
    rng: Pcg,
    tongues: Vec<Tongue>,
    pose: Pose,
    fire: Fire,
    flow: f32,
    /// Tips and radii of what burns in the air; none with root forces.
    hot: Option<[Vec<f32>; 2]>,
    chains: Chains,
    drift_m: f64,
    free: Vec<Free>,
    follower: Follower,
}

impl Flame {
    pub(crate) fn save(&self) -> SavedFlame {
        SavedFlame {
            rng: self.rng.clone(),
            tongues: self.tongues.clone(),
            pose: self.carried.pose,
            fire: self.fire,
            flow: self.flow,
            hot: self.hot.as_ref().map(super::hot::Hot::saved),
            chains: self.chains.clone(),
            drift_m: self.drift_m,
            free: self.free.iter().map(Free::saved).collect(),
            follower: self.follower.clone(),
        }
    }

    /// Goes on from what was saved; says no where it is not of this flame, or holds what cannot be.
    pub(crate) fn restore(&mut self, saved: &SavedFlame, flames: usize) -> bool {
        let share = |x: &f32| (0.0..=1.0).contains(x);
        let tongue =
            |t: &Tongue| share(&t.share) && t.reach > 0.0 && share(&t.reach) && t.cut.as_ref().is_none_or(share);
        let fits = saved.tongues.len() == self.tongues.len()
            && saved.tongues.iter().all(tongue)
            && saved.pose.is_allowed()
            && saved.fire.is_sound()
            && (0.0..=1e6).contains(&saved.flow)
            && saved.drift_m.is_finite()
            && saved.hot.is_some() == self.hot.is_some()
            && saved.chains.fits(&self.chains, OLDEST_S)
            && saved.follower.is_sound(flames)
            && saved.free.len() == self.free.len()
            && saved.free.iter().zip(&self.free).all(|(saved, free)| saved.fits(free));
        if !fits {
            return false;
        }
        if let (Some(hot), Some(saved)) = (&mut self.hot, &saved.hot)
            && !hot.restore(saved)
        {
            return false;
        }
        // In a step long enough that it is no jump: then the chains are overwritten.
        self.place(saved.pose, 1e6);
        self.rng = saved.rng.clone();
        self.tongues.clone_from(&saved.tongues);
        (self.fire, self.flow, self.drift_m) = (saved.fire, saved.flow, saved.drift_m);
        self.chains = saved.chains.clone();
        self.free.iter_mut().zip(&saved.free).for_each(|(free, saved)| free.inherit(saved));
        self.follower = saved.follower.clone();
        // Fires that burn in the air trace them once a step.
        self.trace_spines();
        self.build_nets();
        true
    }
}
