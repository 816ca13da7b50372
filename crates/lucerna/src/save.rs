//! A world as bytes, and what can be wrong with them.
//!
//! | bytes | what |
//! |---|---|
//! | 0 to 8 | `LUCWORLD` |
//! | 8 to 12 | version, little endian |
//! | 12 to 20 | FNV-1a hash of all that follows, little endian |
//! | 20 on | the state in [postcard's format](https://postcard.jamesmunns.com/wire-format) |

use crate::error::WorldError;
use lucerna_flame::{FlameError, Pose, SavedFlames};
use lucerna_fluid::{Snapshot, SnapshotError};
use lucerna_frame::Camera;
use lucerna_scene::{Budget, LoadedScene};
use serde::{Deserialize, Serialize};

const MAGIC: &[u8; 8] = b"LUCWORLD";
/// Rises whenever what is saved changes.
const VERSION: u32 = 1;

/// Why a saved world was refused. The world is then as it was.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The bytes do not start as a saved world does, or end before its header does.
    #[error("this is not a saved world")]
    NotASave,
    /// It was saved by a version whose layout this one does not know.
    #[error("the world was saved in version {found}; known: {VERSION}")]
    Version {
        /// The version that it says.
        found: u32,
    },
    /// The bytes are not those that were saved.
    #[error("the saved world is damaged: its checksum does not fit")]
    Checksum,
    /// The bytes cannot be read as a saved world, or hold what cannot be.
    #[error("the saved world is cut short or malformed")]
    Malformed,
    /// It was saved from a world with other fires, air, motions or seed.
    #[error("the world was saved from another scene: its fires, air, motions or seed differ")]
    Scene,
    /// A box of air is refused.
    #[error("a saved box of air is refused")]
    Air(#[from] SnapshotError),
    /// A flame is refused.
    #[error("a saved flame is refused")]
    Flame(#[from] FlameError),
    /// The world could not be made anew.
    #[error("the world could not be made anew")]
    World(#[from] WorldError),
}

/// The state of a world.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Saved {
    /// Of the scene that it belongs to.
    pub(crate) scene: u64,
    pub(crate) owed_s: f64,
    pub(crate) airs: Vec<Snapshot>,
    pub(crate) flames: SavedFlames,
    /// Where everything that moves is, and where the program wants it.
    pub(crate) movers: Vec<(Pose, Option<Pose>)>,
    pub(crate) budget: Option<Budget>,
    pub(crate) view: Camera,
    /// Which copies burn for themselves, and which are coarse.
    pub(crate) units: Vec<(bool, bool)>,
}

impl Saved {
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        // Writing numbers and arrays of known lengths into memory does not fail.
        let payload = postcard::to_allocvec(self).unwrap_or_default();
        let mut bytes = Vec::with_capacity(20 + payload.len());
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(fnv(&payload).to_le_bytes());
        bytes.extend(payload);
        bytes
    }

    /// Takes no more memory than a few times the length of `bytes`, whatever lengths they claim.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Self, SaveError> {
        let (magic, rest) = bytes.split_first_chunk::<8>().ok_or(SaveError::NotASave)?;
        let (version, rest) = rest.split_first_chunk::<4>().ok_or(SaveError::NotASave)?;
        let (expected, payload) = rest.split_first_chunk::<8>().ok_or(SaveError::NotASave)?;
        if magic != MAGIC {
            return Err(SaveError::NotASave);
        }
        let found = u32::from_le_bytes(*version);
        if found != VERSION {
            return Err(SaveError::Version { found });
        }
        if fnv(payload) != u64::from_le_bytes(*expected) {
            return Err(SaveError::Checksum);
        }
        match postcard::take_from_bytes(payload) {
            Ok((saved, [])) => Ok(saved),
            Ok(_) | Err(_) => Err(SaveError::Malformed),
        }
    }
}

/// A number for all of a scene that burns: camera, look and meshes are no part of it.
pub(crate) fn fingerprint(loaded: &LoadedScene) -> u64 {
    let scene = &loaded.scene;
    let burns = (scene.seed, &scene.air, &scene.fires, &scene.motions, &loaded.wicks);
    fnv(&postcard::to_allocvec(&burns).unwrap_or_default())
}

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), 64 bits.
fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}
