//! The parts of a mesh: what its faces and lines connect.

use super::WickGroup;
use std::collections::HashMap;

/// The vertices of each part, in the order of their first vertices. Vertices at the same place are one: files repeat
/// them along seams. Where nothing is connected, as in a cloud of points, all are one part; vertices that no face uses
/// are left out of what is.
pub(super) fn connected(group: WickGroup) -> Vec<Vec<[f32; 3]>> {
    let WickGroup { vertices, links, .. } = group;
    if links.is_empty() {
        return vec![vertices];
    }
    let mut above: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut used = vec![false; vertices.len()];
    let mut at_place: HashMap<[u32; 3], u32> = HashMap::with_capacity(vertices.len());
    for (i, vertex) in vertices.iter().enumerate() {
        // Adding zero makes one of the two zeros.
        let place = vertex.map(|x| (x + 0.0).to_bits());
        let first = *at_place.entry(place).or_insert(i as u32);
        unite(&mut above, first, i as u32);
    }
    for &[a, b] in &links {
        (used[a as usize], used[b as usize]) = (true, true);
        unite(&mut above, a, b);
    }
    let mut part_of: HashMap<u32, usize> = HashMap::new();
    let mut parts: Vec<Vec<[f32; 3]>> = Vec::new();
    for (i, vertex) in vertices.iter().enumerate() {
        let root = top(&mut above, i as u32);
        if !used[i] {
            continue;
        }
        let part = *part_of.entry(root).or_insert_with(|| {
            parts.push(Vec::new());
            parts.len() - 1
        });
        parts[part].push(*vertex);
    }
    parts
}

/// The vertex that stands for the part of `i`; shortens the way there.
fn top(above: &mut [u32], mut i: u32) -> u32 {
    while above[i as usize] != i {
        above[i as usize] = above[above[i as usize] as usize];
        i = above[i as usize];
    }
    i
}

fn unite(above: &mut [u32], a: u32, b: u32) {
    let (a, b) = (top(above, a), top(above, b));
    above[a.max(b) as usize] = a.min(b);
}
