//! What the simulation works with, as lines to look at.

use crate::Flames;
use glam::Vec3;
use lucerna_frame::{FlameVertex, LineVertex};

const LEAD: [f32; 3] = [1.0, 0.25, 0.1];
const PERIPHERAL: [f32; 3] = [0.1, 0.7, 1.0];
const NET: [f32; 3] = [0.2, 1.0, 0.3];
const WIRE: [f32; 3] = [0.6, 0.6, 0.6];

fn line(out: &mut Vec<LineVertex>, a: Vec3, b: Vec3, color: [f32; 3]) {
    out.extend([a, b].map(|p| LineVertex { position: p.to_array(), color }));
}

impl Flames {
    /// Adds the particle chains: lead skeletons red, peripheral ones blue.
    pub fn skeleton_lines(&self, out: &mut Vec<LineVertex>) {
        for flame in &self.flames {
            let leads = flame.roots.leads.len();
            for k in 0..flame.chains.skeletons() {
                let mut below = flame.chains.root(k);
                for p in flame.chains.particles(k).skip(1) {
                    line(out, below, p, if k < leads { LEAD } else { PERIPHERAL });
                    below = p;
                }
            }
        }
    }

    /// Adds the control nets.
    pub fn net_lines(&self, out: &mut Vec<LineVertex>) {
        for flame in &self.flames {
            let free = flame.free.iter().filter(|f| f.burning).map(|f| (&f.net, flame.free_plan.key));
            for (net, key) in std::iter::once((&flame.net, flame.plan.key)).chain(free) {
                for r in 0..key.rows {
                    for c in 0..key.columns {
                        let here = Vec3::from(net[r * key.columns + c]);
                        let around = net[(r + 1) % key.rows * key.columns + c];
                        line(out, here, around.into(), NET);
                        if c + 1 < key.columns {
                            line(out, here, net[r * key.columns + c + 1].into(), NET);
                        }
                    }
                }
            }
        }
    }

    /// Adds the edges of all triangles; none where the renderer is to make the vertices.
    pub fn wireframe_lines(&self, out: &mut Vec<LineVertex>) {
        for draw in self.draws() {
            let vertices = draw.first_vertex as usize..(draw.first_vertex + draw.vertex_count) as usize;
            let Some(vertices) = self.vertices().get(vertices) else { return };
            let indices = &self.indices()[draw.first_index as usize..][..draw.index_count as usize];
            let at = |i: u32| Vec3::from(vertices.get(i as usize).unwrap_or(&FlameVertex::default()).position);
            for t in indices.chunks_exact(3) {
                // Each edge belongs to two triangles: one of them draws it.
                for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])].into_iter().filter(|(a, b)| a < b) {
                    line(out, at(a), at(b), WIRE);
                }
            }
        }
    }
}
