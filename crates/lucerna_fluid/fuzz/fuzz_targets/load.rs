//! Loads whatever the bytes are; what is taken must step, stay finite, and save as it was loaded.

#![no_main]

use libfuzzer_sys::fuzz_target;
use lucerna_fluid::{Fluid, Snapshot};

/// Boxes of more cells would make the search slow, and find nothing that small ones do not.
const MOST_CELLS: usize = 4096;

fuzz_target!(|payload: &[u8]| {
    // A header that fits, so that the search begins behind the checksum.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for byte in payload {
        hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    }
    let bytes = [b"LUCFLUID\x01\0\0\0", hash.to_le_bytes().as_slice(), payload].concat();
    let Ok(snapshot) = Snapshot::from_bytes(&bytes) else { return };
    let Ok(mut fluid) = Fluid::load(&snapshot) else { return };
    if fluid.cells().iter().product::<usize>() > MOST_CELLS {
        return;
    }
    assert_eq!(fluid.save(), snapshot);
    let _ = fluid.step(0.05).expect("a length of step in its range");
    assert!(fluid.face_velocities().into_iter().chain([fluid.temperatures()]).flatten().all(|value| value.is_finite()));
});
