//! Filling values that no air reaches from the nearest that it does.

use crate::grid::Grid;
use crate::sides::Side;

/// One value and those that it is the mean of.
#[derive(Clone, Copy, Debug)]
struct Entry {
    target: u32,
    count: u32,
    sources: [u32; 6],
}

/// How to fill the values of one lattice: in layers, from the known ones outwards.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fill {
    entries: Vec<Entry>,
    /// Layer of each value: 0 known, counted up from there, `u32::MAX` not yet reached.
    layers: Vec<u32>,
    /// Values not yet reached.
    left: Vec<u32>,
}

impl Fill {
    /// For the values where `is_unknown`; those that nothing known is connected to stay.
    pub(crate) fn find(&mut self, grid: &Grid, counts: [usize; 3], unknown: impl Iterator<Item = bool>) {
        self.entries.clear();
        self.layers.clear();
        self.left.clear();
        self.layers.extend(unknown.map(|is_unknown| if is_unknown { u32::MAX } else { 0 }));
        let unknown = self.layers.iter().enumerate().filter(|(_, layer)| **layer != 0);
        self.left.extend(unknown.map(|(at, _)| at as u32));
        let strides = [1, counts[0], counts[0] * counts[1]];
        let is_periodic = grid.sides.map(|sides| sides[0] == Side::Periodic);
        let mut layer = 1;
        while !self.left.is_empty() {
            let (entries, layers) = (&mut self.entries, &mut self.layers);
            let before = entries.len();
            self.left.retain(|at| {
                let mut entry = Entry { target: *at, count: 0, sources: [0; 6] };
                let at = *at as usize;
                for axis in 0..3 {
                    let index = at / strides[axis] % counts[axis];
                    // The last face of a periodic axis is the first one.
                    let double = usize::from(counts[axis] > grid.cells[axis]);
                    let below = match index {
                        0 if is_periodic[axis] => Some(counts[axis] - 1 - double),
                        0 => None,
                        _ => Some(index - 1),
                    };
                    let above = match index + 1 {
                        next if next < counts[axis] => Some(next),
                        _ if is_periodic[axis] => Some(double),
                        _ => None,
                    };
                    for neighbour in [below, above].into_iter().flatten() {
                        let other = at - index * strides[axis] + neighbour * strides[axis];
                        if layers[other] < layer {
                            entry.sources[entry.count as usize] = other as u32;
                            entry.count += 1;
                        }
                    }
                }
                if entry.count > 0 {
                    entries.push(entry);
                }
                entry.count == 0
            });
            if entries.len() == before {
                break;
            }
            entries[before..].iter().for_each(|entry| layers[entry.target as usize] = layer);
            layer += 1;
        }
    }

    /// Fills values of one number each.
    pub(crate) fn apply(&self, values: &mut [f32]) {
        for entry in &self.entries {
            let sources = &entry.sources[..entry.count as usize];
            let sum: f32 = sources.iter().map(|source| values[*source as usize]).sum();
            values[entry.target as usize] = sum / entry.count as f32;
        }
    }

    /// Fills values of four numbers each.
    pub(crate) fn apply_packs(&self, values: &mut [[f32; 4]]) {
        for entry in &self.entries {
            let mut sum = [0.0; 4];
            for source in &entry.sources[..entry.count as usize] {
                let value = values[*source as usize];
                (0..4).for_each(|lane| sum[lane] += value[lane]);
            }
            values[entry.target as usize] = sum.map(|sum| sum / entry.count as f32);
        }
    }
}
