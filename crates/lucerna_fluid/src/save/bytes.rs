//! The compact binary form: a header, then the snapshot as postcard writes it.
//!
//! | bytes | what |
//! |---|---|
//! | 0 to 8 | `LUCFLUID` |
//! | 8 to 12 | version, little endian |
//! | 12 to 20 | FNV-1a hash of all that follows, little endian |
//! | 20 on | the snapshot in [postcard's format](https://postcard.jamesmunns.com/wire-format), little endian |

use super::{Snapshot, SnapshotError, VERSION};
use crate::read::Fnv;

const MAGIC: &[u8; 8] = b"LUCFLUID";

impl Snapshot {
    /// The snapshot as bytes: 4 a value, the same on every machine.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        // Writing numbers and arrays of known lengths into memory does not fail.
        let payload = postcard::to_allocvec(self).unwrap_or_default();
        let mut bytes = Vec::with_capacity(20 + payload.len());
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(hash(&payload).to_le_bytes());
        bytes.extend(payload);
        bytes
    }

    /// Reads what [`Snapshot::to_bytes`] wrote. Takes no more memory than a few times the
    /// length of `bytes`, whatever lengths they claim; what the numbers mean is checked by
    /// [`crate::Fluid::load`].
    ///
    /// # Errors
    /// Bytes that are none of ours, of another version, changed, cut short or too many.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SnapshotError> {
        let (magic, rest) = bytes.split_first_chunk::<8>().ok_or(SnapshotError::NotASnapshot)?;
        let (version, rest) = rest.split_first_chunk::<4>().ok_or(SnapshotError::NotASnapshot)?;
        let (expected, payload) = rest.split_first_chunk::<8>().ok_or(SnapshotError::NotASnapshot)?;
        if magic != MAGIC {
            return Err(SnapshotError::NotASnapshot);
        }
        let found = u32::from_le_bytes(*version);
        if found != VERSION {
            return Err(SnapshotError::Version { found });
        }
        if hash(payload) != u64::from_le_bytes(*expected) {
            return Err(SnapshotError::Checksum);
        }
        match postcard::take_from_bytes(payload) {
            Ok((snapshot, [])) => Ok(snapshot),
            Ok(_) | Err(_) => Err(SnapshotError::Malformed),
        }
    }
}

fn hash(bytes: &[u8]) -> u64 {
    let mut hash = Fnv::default();
    hash.add(bytes);
    hash.0
}
