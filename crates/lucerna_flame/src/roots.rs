//! Roots: where the particle chains of a flame start (paper 003, section 4.1).

use crate::wick::{Centreline, along};
use glam::Vec3;

/// A root of a lead skeleton: on the wick, in the middle of the flame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeadRoot {
    /// Where it rests, m.
    pub position: Vec3,
    /// Where it is along the wick, -1 to 1 (0 for a point-like wick).
    pub u: f32,
}

/// A root of a peripheral skeleton: beside the wick, at the flame's rim. One row of the control net.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeripheralRoot {
    /// Where it rests, m.
    pub position: Vec3,
    /// Unit vector away from the wick, horizontal.
    pub outward: Vec3,
    /// Index of the nearest lead root.
    pub lead: usize,
}

/// All roots of one flame.
#[derive(Clone, Debug, PartialEq)]
pub struct Roots {
    /// `N_l` roots along the wick.
    pub leads: Vec<LeadRoot>,
    /// `N_p` roots around it, clockwise seen from above, starting beyond the left end.
    pub peripherals: Vec<PeripheralRoot>,
}

/// The lead skeleton that row `row` of the control net refers to, for `leads` lead skeletons.
///
/// A flame of one lead has four rows; any other `2 N_l + 2`: one beyond the left end, `N_l` along one
/// side, one beyond the right end, `N_l` back along the other side.
#[must_use]
pub fn lead_of_row(row: usize, leads: usize) -> usize {
    if leads <= 1 || row == 0 {
        0
    } else if row <= leads {
        row - 1
    } else if row == leads + 1 {
        leads - 1
    } else {
        (2 * leads + 1).saturating_sub(row)
    }
}

impl Roots {
    /// The mean of the lead roots, and the distance between the first and the last along the wick, m.
    pub(crate) fn middle_and_length(&self) -> (Vec3, f32) {
        let middle = self.leads.iter().map(|lead| lead.position).sum::<Vec3>() / self.leads.len().max(1) as f32;
        let length = self.leads.windows(2).map(|pair| pair[0].position.distance(pair[1].position)).sum();
        (middle, length)
    }

    /// Places roots along a centreline: `slices` + 2 leads, one for a point-like wick.
    #[must_use]
    pub fn place(centreline: &Centreline, slices: u32, width_m: f32) -> Self {
        match centreline {
            Centreline::Point(centre) => Self::around(*centre, width_m),
            Centreline::Line(line) => Self::beside(line, slices.max(1), width_m),
        }
    }

    fn around(centre: Vec3, width_m: f32) -> Self {
        let peripherals = [Vec3::X, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Z].map(|outward| PeripheralRoot {
            position: centre + outward * width_m,
            outward,
            lead: 0,
        });
        Self { leads: vec![LeadRoot { position: centre, u: 0.0 }], peripherals: peripherals.to_vec() }
    }

    fn beside(line: &[Vec3], slices: u32, width_m: f32) -> Self {
        // The ends, and the middle of each slice between them.
        let middles = (0..slices).map(|i| (i as f32 + 0.5) / slices as f32);
        let stations: Vec<f32> = std::iter::once(0.0).chain(middles).chain(std::iter::once(1.0)).collect();
        let leads: Vec<LeadRoot> =
            stations.iter().map(|&s| LeadRoot { position: along(line, s).0, u: 2.0 * s - 1.0 }).collect();
        // A steep stretch has no side of its own: it takes that of the wick as a whole.
        let whole = (line[line.len() - 1] - line[0]).with_y(0.0).normalize_or(Vec3::X);
        let level = |s: f32| {
            let direction = along(line, (s - 0.02).max(0.0)).1 + along(line, (s + 0.02).min(1.0)).1;
            let flat = direction.with_y(0.0);
            if flat.length() > 0.2 { flat.normalize() } else { whole }
        };
        let n = leads.len();
        let peripherals = (0..2 * n + 2)
            .map(|row| {
                let lead = lead_of_row(row, n);
                let forward = level(stations[lead]);
                let outward = match row {
                    0 => -forward,
                    r if r <= n => Vec3::Y.cross(forward),
                    r if r == n + 1 => forward,
                    _ => forward.cross(Vec3::Y),
                };
                PeripheralRoot { position: leads[lead].position + outward * width_m, outward, lead }
            })
            .collect();
        Self { leads, peripherals }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_follow_the_paper() {
        // Paper 003, equation 1, with its right end mended.
        let rows: Vec<usize> = (0..10).map(|r| lead_of_row(r, 4)).collect();
        assert_eq!(rows, [0, 0, 1, 2, 3, 3, 3, 2, 1, 0]);
        assert!((0..4).all(|r| lead_of_row(r, 1) == 0));
    }

    #[test]
    fn a_straight_wick_has_its_roots_on_and_beside_it() {
        let line = Centreline::Line(vec![Vec3::new(-0.3, 0.1, 0.0), Vec3::new(0.3, 0.1, 0.0)]);
        for slices in 1..6 {
            let roots = Roots::place(&line, slices, 0.02);
            let n = slices as usize + 2;
            assert_eq!((roots.leads.len(), roots.peripherals.len()), (n, 2 * n + 2));
            assert_eq!((roots.leads[0].u, roots.leads[n - 1].u), (-1.0, 1.0));
            assert!(roots.leads.windows(2).all(|w| w[0].position.x < w[1].position.x && w[0].u < w[1].u));
            assert!((roots.peripherals[0].position - Vec3::new(-0.32, 0.1, 0.0)).length() < 1e-6);
            assert!((roots.peripherals[n + 1].position - Vec3::new(0.32, 0.1, 0.0)).length() < 1e-6);
            for row in 1..=n {
                let (a, b) = (roots.peripherals[row], roots.peripherals[2 * n + 2 - row]);
                assert_eq!(a.lead, b.lead, "opposite rows share a lead");
                assert!((a.position.z + 0.02).abs() < 1e-6 && (b.position.z - 0.02).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn the_rim_is_clockwise_from_above() {
        let bent = Centreline::Line(vec![Vec3::ZERO, Vec3::new(0.2, 0.0, 0.0), Vec3::new(0.2, 0.0, 0.2)]);
        for line in [bent, Centreline::Point(Vec3::ONE)] {
            let roots = Roots::place(&line, 3, 0.01);
            let rim = &roots.peripherals;
            let twice: f32 = (0..rim.len()).map(|i| rim[i].position.cross(rim[(i + 1) % rim.len()].position).y).sum();
            assert!(twice < 0.0, "{twice}");
        }
    }
}
