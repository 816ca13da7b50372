//! How well the surface of a flame is formed.

use super::shapes::{AROUND, UP};
use glam::Vec3;
use lucerna_flame::Flames;
use lucerna_frame::FlameVertex;

/// What was seen of the surfaces of some frames.
#[derive(Clone, Copy, Debug, Default)]
pub struct Health {
    /// Surfaces looked at.
    pub surfaces: usize,
    /// Those with a number that is not finite.
    pub not_finite: usize,
    /// Those that enclose no volume, or a negative one.
    pub no_volume: usize,
    /// Those with a cut whose area vector points away from the root, or against that of the next cut.
    pub reversed: usize,
    /// Free flames among them.
    pub reversed_free: usize,
    /// Vertices looked at.
    pub samples: usize,
    /// Those with the outside of the surface behind them.
    pub inside_out: usize,
    /// Those with another part of the surface around them.
    pub overlapping: usize,
    /// The least length from root to tip, through the middles of the cuts, as a share of the flame's width.
    pub shortest: f32,
}

impl Health {
    pub fn new() -> Self {
        Self { shortest: f32::INFINITY, ..Self::default() }
    }

    /// Looks at all surfaces of a frame, made with [`AROUND`] and [`UP`] samples, over wicks of `width_m`.
    pub fn look(&mut self, flames: &Flames, width_m: f32, frame: usize) {
        let (around, up) = (AROUND, UP);
        for draw in flames.draws() {
            let vertices = &flames.vertices()[draw.first_vertex as usize..][..draw.vertex_count as usize];
            let indices = &flames.indices()[draw.first_index as usize..][..draw.index_count as usize];
            // Free flames are made with half of the samples.
            let whole = [(around + 1) * (up + 1), (around + 1) * (up + 1) - 2].contains(&vertices.len());
            let (around, up) = if whole { (around, up) } else { ((around / 4 * 2).max(8), (up / 2).max(6)) };
            self.look_at(vertices, indices, (around, up), whole.then_some(width_m), frame);
        }
    }

    fn look_at(
        &mut self,
        v: &[FlameVertex],
        indices: &[u32],
        (around, up): (usize, usize),
        width_m: Option<f32>,
        frame: usize,
    ) {
        self.surfaces += 1;
        let numbers = |v: &FlameVertex| [&v.position[..], &v.normal, &[v.height, v.radius_m]].concat();
        if !v.iter().all(|v| numbers(v).iter().all(|x| x.is_finite())) {
            self.not_finite += 1;
            return;
        }
        let at = |i: usize| Vec3::from(v[i].position);
        let poles = v.len() != (around + 1) * (up + 1);
        let ring = |r: usize| {
            let start = r * (around + 1) - usize::from(poles);
            start..start + around + 1
        };
        let triangles: Vec<[Vec3; 3]> =
            indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|i| at(i as usize))).collect();
        let volume: f32 = triangles.iter().map(|t| (t[0] - at(0)).dot((t[1] - at(0)).cross(t[2] - at(0)))).sum();
        self.no_volume += usize::from(volume <= 0.0);

        let ends = [at(0), at(v.len() - 1)];
        let cut = |r: usize| {
            if r == 0 || r == up {
                // A slit or a point: only its middle counts.
                let points: Vec<Vec3> = match (poles, r) {
                    (true, 0) => vec![ends[0]],
                    (true, _) => vec![ends[1]],
                    (false, _) => ring(r).skip(1).map(at).collect(),
                };
                return (points.iter().sum::<Vec3>() / points.len() as f32, Vec3::ZERO);
            }
            let middle = ring(r).skip(1).map(at).sum::<Vec3>() / around as f32;
            let area = ring(r).zip(ring(r).skip(1)).map(|(a, b)| (at(a) - middle).cross(at(b) - middle)).sum::<Vec3>();
            (middle, area)
        };
        let cuts: Vec<(Vec3, Vec3)> = (0..=up).map(cut).collect();
        let down = |r: usize| cuts[r + 1].0 - cuts[r - 1].0;
        let reversed =
            (1..up).any(|r| cuts[r].1.dot(down(r)) <= 0.0 || (r + 1 < up && cuts[r].1.dot(cuts[r + 1].1) <= 0.0));
        self.reversed += usize::from(reversed);
        self.reversed_free += usize::from(reversed && width_m.is_none());
        let length: f32 = cuts.windows(2).map(|w| w[0].0.distance(w[1].0)).sum();
        if let Some(width_m) = width_m {
            self.shortest = self.shortest.min(length / width_m);
        }

        for k in 0..4 {
            let r = 1 + (7 * frame + 3 * k) % (up - 1);
            let i = ring(r).start + (frame + 5 * k) % around;
            let step = Vec3::from(v[i].normal) * (0.02 * v[i].radius_m);
            self.samples += 1;
            self.inside_out += usize::from(windings(&triangles, at(i) - step) < 0.5);
            self.overlapping += usize::from(windings(&triangles, at(i) + step) > 0.5);
        }
    }
}

/// How often the surface winds around a point: the sum of its triangles' solid angles (van Oosterom and Strackee 1983)
/// over that of the sphere.
fn windings(triangles: &[[Vec3; 3]], p: Vec3) -> f32 {
    let angle = |t: &[Vec3; 3]| {
        let [a, b, c] = t.map(|q| q - p);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    triangles.iter().map(angle).sum::<f32>() / (2.0 * std::f32::consts::TAU)
}
