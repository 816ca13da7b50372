//! Lines of equal value in a plane, by marching squares.

use std::collections::BTreeMap;

/// An edge of the lattice: its low end, and whether it runs along the second axis.
type Edge = (usize, usize, bool);
/// What each crossed edge is joined to.
type Links = BTreeMap<Edge, Vec<Edge>>;

/// Lines along which a lattice of `nx` columns has the value `level`, in units of its spacing.
pub(crate) fn contour(values: &[f64], nx: usize, level: f64) -> Vec<Vec<(f64, f64)>> {
    let ny = values.len() / nx;
    let at = |i: usize, j: usize| values[i + nx * j] - level;
    let mut links = Links::new();
    for j in 0..ny - 1 {
        for i in 0..nx - 1 {
            let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)].map(|value| value > 0.0);
            let edges = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
            let crossed: Vec<_> =
                (0..4).filter(|side| corners[*side] != corners[(side + 1) % 4]).map(|side| edges[side]).collect();
            for pair in crossed.chunks_exact(2) {
                links.entry(pair[0]).or_default().push(pair[1]);
                links.entry(pair[1]).or_default().push(pair[0]);
            }
        }
    }
    let place = |(i, j, is_up): Edge| {
        let (from, to) = (at(i, j), if is_up { at(i, j + 1) } else { at(i + 1, j) });
        let share = from / (from - to);
        (i as f64 + if is_up { 0.0 } else { share }, j as f64 + if is_up { share } else { 0.0 })
    };
    let mut lines = Vec::new();
    // Lines that end on the rim start there; what is left are rings.
    while let Some(start) = links.iter().min_by_key(|(_, next)| next.len()).map(|(edge, _)| *edge) {
        let mut line = vec![place(start)];
        let mut here = start;
        while let Some(next) = take_link(&mut links, here) {
            line.push(place(next));
            here = next;
        }
        links.remove(&start);
        lines.push(line);
    }
    lines
}

/// Takes one neighbour of an edge out of both lists.
fn take_link(links: &mut Links, here: Edge) -> Option<Edge> {
    let next = links.get_mut(&here)?.pop();
    if links.get(&here).is_some_and(Vec::is_empty) {
        links.remove(&here);
    }
    let next = next?;
    if let Some(back) = links.get_mut(&next) {
        if let Some(at) = back.iter().position(|edge| *edge == here) {
            back.swap_remove(at);
        }
        if back.is_empty() {
            links.remove(&next);
        }
    }
    Some(next)
}
