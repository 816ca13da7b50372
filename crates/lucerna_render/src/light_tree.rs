//! Lights merged by distance: a binary tree over point lights, and cuts through it.
//!
//! An inner node stands for all lights below it (Walter et al. 2005, Lightcuts, section 3): their intensities add up, and
//! it lies in their power-weighted middle. Its radius is the mean of theirs; how far they lie apart is no part of it,
//! because the irradiance of points around a middle is, to second order, that of the middle wherever they spread evenly
//! (n.R / R^3 is harmonic), while a larger radius would dim it.

use glam::Vec3;
use std::ops::Range;

/// A light, or many in one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    /// Power-weighted middle, m.
    pub(crate) position: Vec3,
    /// Mean square of the lights' own radii, m^2.
    pub(crate) radius2: f32,
    /// Sum of the intensities.
    pub(crate) intensity: Vec3,
    /// No light below lies farther from the middle, m^2.
    extent2: f32,
    /// The node that follows this one's last descendant.
    next: u32,
}

impl Node {
    pub(crate) fn light(position: Vec3, radius_m: f32, intensity: Vec3) -> Self {
        Self { position, radius2: radius_m * radius_m, intensity, extent2: 0.0, next: 0 }
    }

    fn power(&self) -> f32 {
        self.intensity.element_sum()
    }
}

/// The tree, node after node in depth-first order: the root is the first, a left child follows its parent.
#[derive(Debug, Default)]
pub(crate) struct LightTree {
    lights: Vec<Node>,
    nodes: Vec<Node>,
}

impl LightTree {
    /// Builds the tree anew. The same lights in the same order make the same tree.
    pub(crate) fn build(&mut self, lights: impl Iterator<Item = Node>) {
        self.lights.clear();
        self.lights.extend(lights);
        self.nodes.clear();
        if !self.lights.is_empty() {
            self.add(0..self.lights.len());
        }
    }

    pub(crate) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Number of lights, not of nodes.
    pub(crate) fn light_count(&self) -> usize {
        self.lights.len()
    }

    /// Adds the subtree over a range of lights, which it sorts.
    fn add(&mut self, range: Range<usize>) {
        let index = self.nodes.len();
        let lights = &mut self.lights[range.clone()];
        if let [light] = lights {
            self.nodes.push(Node { next: index as u32 + 1, ..*light });
            return;
        }
        let left = range.start + split(lights);
        let node = merged(lights);
        self.nodes.push(node);
        self.add(range.start..left);
        self.add(left..range.end);
        self.nodes[index].next = self.nodes.len() as u32;
    }

    /// Calls `visit` with the nodes that stand for all lights as seen from within a box: none reaches farther from its
    /// middle than `angle` times the distance between its middle and the box. With an angle of 0 these are the lights
    /// themselves.
    pub(crate) fn cut(&self, low: Vec3, high: Vec3, angle: f32, mut visit: impl FnMut(u32)) {
        let mut index = 0;
        while let Some(node) = self.nodes.get(index as usize) {
            let nearest = node.position.max(low).min(high);
            let reach2 = angle * angle * nearest.distance_squared(node.position);
            if node.next == index + 1 || node.extent2 <= reach2 {
                visit(index);
                index = node.next;
            } else {
                index += 1;
            }
        }
    }
}

/// Sorts lights into two halves of their box, across its longest edge; returns the size of the first. Halves of the box,
/// not of the number: groups that lie apart stay together.
fn split(lights: &mut [Node]) -> usize {
    let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
    for light in &*lights {
        low = low.min(light.position);
        high = high.max(light.position);
    }
    let size = high - low;
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let middle = low[axis] + 0.5 * size[axis];
    let mut first = 0;
    for index in 0..lights.len() {
        if lights[index].position[axis] < middle {
            lights.swap(first, index);
            first += 1;
        }
    }
    // All in one place, or nowhere.
    if first == 0 || first == lights.len() { lights.len() / 2 } else { first }
}

fn merged(lights: &[Node]) -> Node {
    // Dark lights have a place as well.
    let weight = |light: &Node| light.power().max(f32::MIN_POSITIVE);
    let total: f32 = lights.iter().map(weight).sum();
    let from = lights[0].position;
    let (mut first, mut radius2, mut intensity) = (Vec3::ZERO, 0.0, Vec3::ZERO);
    for light in lights {
        let share = weight(light) / total;
        first += (light.position - from) * share;
        radius2 += light.radius2 * share;
        intensity += light.intensity;
    }
    let position = from + first;
    let extent2 = lights.iter().map(|light| light.position.distance_squared(position)).fold(0.0, f32::max);
    Node { position, radius2, intensity, extent2, next: 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Repeatable numbers from 0 to 1.
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> f32 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 40) as f32 / (1 << 24) as f32
        }

        fn point(&mut self) -> Vec3 {
            Vec3::new(self.next(), self.next(), self.next())
        }
    }

    /// Groups of lights in a room of 10 m, of very different powers and colours.
    fn lights(seed: u64) -> Vec<Node> {
        let mut numbers = Numbers(seed);
        let centers: Vec<Vec3> = (0..40).map(|_| numbers.point() * 10.0).collect();
        let mut light = |center: &Vec3| {
            let position = *center + 0.6 * (numbers.point() - 0.5);
            let power = (4.0 * numbers.next()).exp();
            Node::light(position, 0.03 * numbers.next(), numbers.point() * power)
        };
        centers.iter().flat_map(|center| std::iter::repeat_n(center, 12)).map(&mut light).collect()
    }

    fn tree(lights: &[Node]) -> LightTree {
        let mut tree = LightTree::default();
        tree.build(lights.iter().copied());
        tree
    }

    /// What the opaque pass adds up: the diffuse light of a white surface.
    fn irradiance(light: &Node, point: Vec3, normal: Vec3) -> Vec3 {
        let to_light = light.position - point;
        let squared = to_light.length_squared() + light.radius2;
        let wrap = (light.radius2 / squared).sqrt();
        let cosine = normal.dot(to_light.normalize_or_zero());
        light.intensity * (((cosine + wrap) / (1.0 + wrap)).max(0.0) / squared)
    }

    #[test]
    fn every_cut_keeps_the_light_of_all() {
        for seed in 0..10 {
            let lights = lights(seed);
            let tree = tree(&lights);
            let exact: Vec3 = lights.iter().map(|light| light.intensity).sum();
            let root = tree.nodes()[0];
            assert!(root.intensity.distance(exact) < 1e-5 * exact.length(), "{} of {exact}", root.intensity);
            let weighted: Vec3 =
                lights.iter().map(|light| light.position * light.power()).sum::<Vec3>() / exact.element_sum();
            assert!(root.position.distance(weighted) < 1e-4, "{} is not {weighted}", root.position);
            let mut numbers = Numbers(seed);
            for angle in [0.0, 0.05, 0.3, 1.0] {
                let (mut sum, mut count) = (Vec3::ZERO, 0);
                let low = numbers.point() * 10.0;
                tree.cut(low, low + 1.0, angle, |index| {
                    sum += tree.nodes()[index as usize].intensity;
                    count += 1;
                });
                assert!(sum.distance(exact) < 1e-5 * exact.length(), "angle {angle}: {sum} of {exact}");
                assert_eq!(count == lights.len(), angle == 0.0, "angle {angle}: {count} of {} lights", lights.len());
            }
        }
    }

    #[test]
    fn merged_lights_shine_like_all_of_them() {
        for (angle, mean_bound, largest_bound) in [(0.05, 5e-4, 5e-3), (0.1, 2e-3, 2e-2), (0.2, 8e-3, 8e-2)] {
            let (mut errors, mut taken, mut all) = (Vec::new(), 0, 0);
            for seed in 0..10 {
                let lights = lights(seed);
                let tree = tree(&lights);
                let mut numbers = Numbers(seed + 100);
                for _ in 0..60 {
                    let low = numbers.point() * 9.5;
                    let point = low + 0.5 * numbers.point();
                    let normal = (numbers.point() - 0.5).normalize();
                    let mut sum = Vec3::ZERO;
                    tree.cut(low, low + 0.5, angle, |index| {
                        sum += irradiance(&tree.nodes()[index as usize], point, normal);
                        taken += 1;
                    });
                    let exact: Vec3 = lights.iter().map(|light| irradiance(light, point, normal)).sum();
                    // Of the light that comes from all sides: what is turned away from it gets next to none.
                    let arrives = |light: &Node| light.intensity / light.position.distance_squared(point);
                    let arriving: Vec3 = lights.iter().map(arrives).sum();
                    errors.push(((sum - exact) / arriving).abs().max_element());
                    all += lights.len();
                }
            }
            let mean = errors.iter().sum::<f32>() / errors.len() as f32;
            let largest = errors.iter().copied().fold(0.0, f32::max);
            println!("angle {angle}: {taken} of {all} lights, error {mean:.2e} on average, {largest:.2e} at most");
            assert!(mean < mean_bound && largest < largest_bound, "angle {angle}: {mean} and {largest}");
        }
    }

    #[test]
    fn lights_that_cannot_be_told_apart_or_have_no_place_still_make_a_tree() {
        for position in [Vec3::ONE, Vec3::NAN, Vec3::INFINITY] {
            let tree = tree(&[Node::light(position, 0.0, Vec3::ONE); 40]);
            assert_eq!((tree.light_count(), tree.nodes().len()), (40, 79));
            let mut sum = Vec3::ZERO;
            tree.cut(Vec3::ZERO, Vec3::ONE, 0.1, |index| sum += tree.nodes()[index as usize].intensity);
            assert_eq!(sum, Vec3::splat(40.0), "at {position}");
        }
        assert!(tree(&[]).nodes().is_empty());
    }
}
