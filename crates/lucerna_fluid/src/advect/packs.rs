//! Semi-Lagrangian advection of packed scalars: one way back moves four of them.

use super::semi_lagrangian::{LANES, Lanes, load, outside_shares};
use crate::field::sample_packs;
use crate::grid::Grid;
use crate::parallel::for_planes;
use crate::scalars::PACK;
use crate::sides::Side;

/// Fills `out` with `pack` carried along `trace`; `outside` is what comes in.
pub(crate) fn advect_pack(
    grid: &Grid,
    pack: &[[f32; PACK]],
    trace: &[f32],
    outside: [f32; PACK],
    out: &mut [[f32; PACK]],
) {
    let cells = grid.cells;
    let [nx, _, _] = cells;
    let plane = grid.plane();
    let lets_in = grid.sides.map(|sides| sides.map(Side::lets_in));
    let has_inflow = lets_in.iter().flatten().any(|lets_in| *lets_in);
    for_planes(
        grid.exec,
        out,
        plane,
        #[inline(always)]
        |k, out| {
            let trace = &trace[3 * plane * k..][..3 * plane];
            for (j, out) in out.chunks_exact_mut(nx).enumerate() {
                let ways = [0, 1, 2].map(|axis| &trace[axis * plane + j * nx..][..nx]);
                for (block, out) in out.chunks_mut(LANES).enumerate() {
                    let first = LANES * block;
                    let from = [
                        places(first as f32, 1.0, load(ways[0], first, 0)),
                        places(j as f32, 0.0, load(ways[1], first, 0)),
                        places(k as f32, 0.0, load(ways[2], first, 0)),
                    ];
                    let mut samples = sample_packs(pack, cells, from);
                    if has_inflow {
                        let shares = outside_shares(from, cells, lets_in);
                        for (sample, share) in samples.iter_mut().zip(shares) {
                            for (sample, outside) in sample.iter_mut().zip(outside) {
                                *sample += share * (outside - *sample);
                            }
                        }
                    }
                    out.copy_from_slice(&samples[..out.len()]);
                }
            }
        },
    );
}

/// Places that start at `first`, `spacing` apart, less a way.
#[inline(always)]
fn places(first: f32, spacing: f32, way: Lanes) -> Lanes {
    let mut out = [0.0; LANES];
    for lane in 0..LANES {
        out[lane] = (first + spacing * lane as f32) - way[lane];
    }
    out
}
