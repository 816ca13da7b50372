//! Cuts across a surface, straight from its control net.
//!
//! A ring of the surface is a closed curve over uniform cubic B-splines, so integrals along it are sums over its
//! control points: the mean of the curve is theirs, and its area vector, half the integral of c x dc, weighs the
//! products of neighbours by the integrals of one spline times the derivative of another.

use glam::Vec3;

/// A cut at one height.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Section {
    /// Mean of the ring, m.
    pub(crate) middle: Vec3,
    /// Its area vector, m^2; rings run clockwise seen from the tip, so it points to the root.
    pub(crate) area: Vec3,
    /// Height in the flame, 0 at the root and 1 at the tip; 0 until the flame is measured.
    pub(crate) height: f32,
    /// Half thickness, m.
    pub(crate) radius_m: f32,
}

/// Integrals of a uniform cubic B-spline times the derivative of the one so many intervals on, from 1.
const AREA: [f32; 3] = [245.0 / 720.0, 56.0 / 720.0, 1.0 / 720.0];
/// The splines at a knot, and between two knots.
const AT_KNOT: [f32; 4] = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0];
const BETWEEN: [f32; 4] = [1.0 / 48.0, 23.0 / 48.0, 23.0 / 48.0, 1.0 / 48.0];

impl Section {
    /// The cut whose ring has these control points, 4 or more, of which the first lies on the axis that the others
    /// mirror.
    pub(crate) fn of(ring: &[Vec3]) -> Self {
        let n = ring.len();
        let middle = ring.iter().sum::<Vec3>() / n as f32;
        let wrapped = |i: usize| if i < n { i } else { i - n };
        let at = |i: usize| ring[wrapped(i)] - middle;
        let mut area = Vec3::ZERO;
        let mut four = [at(0), at(1), at(2), at(3)];
        for i in 0..n {
            let [here, first, second, third] = four;
            area += here.cross(first * AREA[0] + second * AREA[1] + third * AREA[2]);
            four = [first, second, third, at(i + 4)];
        }
        // Distance to the mirror image, at every knot and halfway to the next.
        let across = |i: usize| ring[wrapped(i)] - ring[wrapped(n - wrapped(i))];
        let mut four = [across(n - 1), across(0), across(1), across(2)];
        let mut square = 0.0_f32;
        for i in 0..n.div_ceil(2) {
            for splines in [AT_KNOT, BETWEEN] {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| four[k] * splines[k]);
                square = square.max((a + b + c + d).length_squared());
            }
            four = [four[1], four[2], four[3], across(i + 3)];
        }
        Self { middle, area, height: 0.0, radius_m: (0.5 * square.sqrt()).max(crate::surface::THINNEST_M) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_round_net_is_cut_as_the_circle_that_it_draws() {
        let center = Vec3::new(0.3, 2.0, -0.1);
        for n in [4, 6, 9, 30] {
            let turn = std::f32::consts::TAU / n as f32;
            let ring: Vec<Vec3> =
                (0..n).map(|i| center + Vec3::new((i as f32 * turn).cos(), 0.0, -(i as f32 * turn).sin())).collect();
            let section = Section::of(&ring);
            // A closed uniform cubic through a regular polygon is round within a few per cent.
            let radius = (2.0 + turn.cos()) / 3.0;
            let area = std::f32::consts::PI * radius * radius;
            println!("{n}: area {} of {area}, half thickness {} of {radius}", section.area.y, section.radius_m);
            assert!((section.area.y / area - 1.0).abs() < 0.04, "{n}: {section:?}");
            assert!((section.radius_m / radius - 1.0).abs() < 0.04, "{n}: {section:?}");
            assert!(section.middle.distance(center) < 1e-5 && section.area.with_y(0.0).length() < 1e-5, "{section:?}");
        }
    }
    /// Mean, area vector and half thickness of a ring of vertices, whose last repeats the first.
    fn of_vertices(ring: &[lucerna_frame::FlameVertex]) -> (Vec3, Vec3, f32) {
        let once = &ring[1..];
        let middle = once.iter().map(|v| Vec3::from(v.position)).sum::<Vec3>() / once.len() as f32;
        let from = |v: &lucerna_frame::FlameVertex| Vec3::from(v.position) - middle;
        (middle, 0.5 * ring.windows(2).map(|w| from(&w[0]).cross(from(&w[1]))).sum::<Vec3>(), ring[0].radius_m)
    }

    #[test]
    fn flames_are_cut_as_their_vertices_are() {
        let line = crate::WickShape::Polyline { points: vec![[-0.04, 0.0, 0.0], [0.05, 0.01, 0.02]], radius_m: 0.002 };
        let point = crate::WickShape::Polyline { points: vec![[0.3, 0.0, 0.0]], radius_m: 0.001 };
        let settings = [line, point].map(|wick| {
            let mut settings = crate::FlameSettings::new(wick);
            (settings.surface.around, settings.skeletons.turbulence_m_s) = (64, 0.3);
            settings.skeletons.shed_per_s = 20.0;
            settings
        });
        let mut flames = crate::Flames::new(settings.to_vec(), 3).expect("flames");
        let up = crate::UniformAir { velocity_m_s: Vec3::new(0.1, 0.5, 0.0), low_m: Vec3::NEG_ONE, high_m: Vec3::ONE };
        let (mut cuts, mut worst) = (0, [0.0_f32; 4]);
        for _ in 0..40 {
            flames.step(&up, 1.0 / 60.0);
            flames.build();
            for flame in &flames.flames {
                for (surface, _, _, free) in flame.surfaces() {
                    let plan = if free { &flame.free_plan } else { &flame.plan };
                    let sizes = surface.sections.iter().map(|s| s.area.length());
                    let (size, length) = (
                        sizes.fold(0.0, f32::max),
                        surface.sections[0].middle.distance(surface.sections[plan.key.up].middle),
                    );
                    for (ring, section) in surface.sections.iter().enumerate() {
                        let (middle, area, radius_m) = of_vertices(&surface.vertices[plan.ring(ring)]);
                        let free = usize::from(free);
                        worst[free] = worst[free].max((section.area - area).length() / size);
                        worst[2] = worst[2].max(section.middle.distance(middle) / length);
                        worst[3] = worst[3].max((section.radius_m - radius_m).abs() / size.sqrt());
                        cuts += 1;
                    }
                }
            }
        }
        println!(
            "{cuts} cuts: areas {:.1e}, of free flames {:.1e}, middles {:.1e}, thickness {:.1e}",
            worst[0], worst[1], worst[2], worst[3]
        );
        // Vertices lie on a polygon, with half as many corners in a free flame.
        assert!(
            worst[1] > 0.0 && worst[0] < 0.005 && worst[1] < 0.02 && worst[2] < 1e-4 && worst[3] < 0.01,
            "{worst:?}"
        );
    }
}
