//! Lines whose diffusivity varies, or that end at solid cells: each has a system of its own.

use std::ops::Range;

use super::line::{End, held_weights};
use crate::limits::MAX_AXIS_CELLS;
use crate::sides::Wall;

/// Lines solved together.
const LANES: usize = 16;
type Lanes = [f32; LANES];

/// What the systems of one field are made of. Diffusion numbers are by square metre: they are
/// multiplied by one over the square of a cell's edge.
#[derive(Clone, Copy)]
pub(crate) struct Varying<'a> {
    /// Diffusivity times step at each value, m².
    pub(crate) at_values: &'a [f32],
    /// Diffusivity times step in each cell, m²; for the lines of a velocity along itself.
    pub(crate) in_cells: &'a [f32],
    /// Zero where a value is free. Elsewhere it is held, and this is how much stronger than
    /// between free values its neighbours across the direction of flow feel it; negative if
    /// not at all. Empty where nothing is held.
    pub(crate) held: &'a [f32],
    /// What each value moves by for what its neighbours do to it: one over its mass. Empty where all are alike.
    pub(crate) light: &'a [f32],
}

/// Where the values of a bundle of lines lie.
#[derive(Clone, Copy)]
pub(crate) struct Bundle {
    pub(crate) first: usize,
    /// From a value of a line to its next.
    pub(crate) along: usize,
    /// From a line to the next.
    pub(crate) across: usize,
    pub(crate) lines: usize,
}

/// One axis of a field.
#[derive(Clone, Copy)]
pub(crate) struct Axis {
    pub(crate) count: usize,
    pub(crate) per_square_m: f32,
    pub(crate) ends: [End; 2],
    /// Whether the values are velocities along this axis: cells lie between them.
    pub(crate) is_own: bool,
}

/// What one bundle needs: its place in the values read, in the coefficients, among the cells
/// between its values, in the values written, and what its ends hold.
pub(crate) struct Job<'a> {
    /// Nothing where they are read from where they are written.
    pub(crate) from: Option<&'a [f32]>,
    pub(crate) from_at: Bundle,
    pub(crate) field_at: Bundle,
    pub(crate) cells_at: Bundle,
    pub(crate) walls: [Wall<'a>; 2],
}

#[inline(always)]
fn load(values: &[f32], at: Bundle, lines: &Range<usize>, node: usize) -> Lanes {
    let first = at.first + at.along * node + at.across * lines.start;
    if at.across == 1
        && lines.len() == LANES
        && let Some(lanes) = values[first..].first_chunk::<LANES>()
    {
        return *lanes;
    }
    // A loop: what arrays are mapped by is not compiled for the vectors at hand.
    let mut lanes = [0.0; LANES];
    for (lane, value) in lanes.iter_mut().enumerate() {
        *value = values[first + at.across * lane.min(lines.len() - 1)];
    }
    lanes
}

impl Varying<'_> {
    /// Solves a bundle of lines; `out` gets the values at `out_at`.
    #[inline(always)]
    pub(crate) fn solve(self, axis: Axis, job: &Job<'_>, out: &mut [f32], out_at: Bundle) {
        // Clearing long buffers for short lines would cost more than solving them.
        let (mut short, mut middle, mut long);
        let [values, links, back, circle]: [&mut [Lanes]; 4] = if axis.count < 40 {
            short = [[[0.0; LANES]; 40]; 4];
            short.each_mut().map(|buffer| &mut buffer[..])
        } else if axis.count < 136 {
            middle = [[[0.0; LANES]; 136]; 4];
            middle.each_mut().map(|buffer| &mut buffer[..])
        } else {
            long = [[[0.0; LANES]; MAX_AXIS_CELLS + 2]; 4];
            long.each_mut().map(|buffer| &mut buffer[..])
        };
        let count = axis.count;
        for start in (0..job.field_at.lines).step_by(LANES) {
            let lines = start..(start + LANES).min(job.field_at.lines);
            let is_cyclic = axis.ends[0] == End::Cyclic;
            let from = job.from.unwrap_or(out);
            let ends = self.prepare(axis, job, from, &lines, &mut values[..count], &mut links[..=count]);
            let light = |node: usize| self.light(job, &lines, node);
            let last_weight = eliminate(axis, &ends, light, &mut values[..count], links, back, circle);
            for node in (0..count - 1).rev() {
                let (low, high) = values.split_at_mut(node + 1);
                for lane in 0..LANES {
                    low[node][lane] += back[node][lane] * high[0][lane];
                }
            }
            if is_cyclic {
                for node in (0..count - 1).rev() {
                    for lane in 0..LANES {
                        circle[node][lane] += back[node][lane] * circle[node + 1][lane];
                    }
                }
                close(&last_weight, &mut values[..count], circle);
            }
            for (node, values) in values[..count].iter().enumerate() {
                let first = out_at.first + out_at.along * node + out_at.across * lines.start;
                for lane in 0..lines.len() {
                    out[first + out_at.across * lane] = values[lane];
                }
            }
        }
    }

    /// What a value moves by: zero where it is held.
    #[inline(always)]
    fn light(self, job: &Job<'_>, lines: &Range<usize>, node: usize) -> Lanes {
        let mut light = if self.light.is_empty() { [1.0; LANES] } else { load(self.light, job.field_at, lines, node) };
        if !self.held.is_empty() {
            let held = load(self.held, job.field_at, lines, node);
            for lane in 0..LANES {
                light[lane] = if held[lane] == 0.0 { light[lane] } else { 0.0 };
            }
        }
        light
    }

    /// Reads the values, and finds how strongly neighbours are linked: link `n` lies below value `n`.
    #[inline(always)]
    fn prepare(
        self,
        axis: Axis,
        job: &Job<'_>,
        from: &[f32],
        lines: &Range<usize>,
        values: &mut [Lanes],
        links: &mut [Lanes],
    ) -> Ends {
        let count = axis.count;
        let r = axis.per_square_m;
        let number = |node: usize| load(self.at_values, job.field_at, lines, node);
        let between = |(low, low_number): (usize, &Lanes), (high, high_number): (usize, &Lanes)| {
            let mut link = [0.0; LANES];
            if axis.is_own {
                let cells = load(self.in_cells, job.cells_at, lines, low);
                for lane in 0..LANES {
                    link[lane] = r * cells[lane];
                }
            } else {
                for lane in 0..LANES {
                    link[lane] = 0.5 * r * (low_number[lane] + high_number[lane]);
                }
            }
            if !self.held.is_empty() {
                let low = load(self.held, job.field_at, lines, low);
                let high = load(self.held, job.field_at, lines, high);
                for lane in 0..LANES {
                    // At most one of the two counts: between two held values nothing matters.
                    let held = if low[lane] == 0.0 { high[lane] } else { low[lane] };
                    let across = if held > 0.0 { held } else { 0.0 };
                    let factor = if held == 0.0 || axis.is_own { 1.0 } else { across };
                    link[lane] *= factor;
                }
            }
            link
        };
        for (node, value) in values.iter_mut().enumerate() {
            *value = load(from, job.from_at, lines, node);
        }
        let first = if axis.is_own { [0.0; LANES] } else { number(0) };
        let mut below = first;
        for (node, link) in links[..count].iter_mut().enumerate().skip(1) {
            let here = if axis.is_own { below } else { number(node) };
            *link = between((node - 1, &below), (node, &here));
            below = here;
        }
        let zero = [[0.0; LANES]; 2];
        let mut ends = Ends { held: zero, beside: zero, wrap: zero };
        let [held, beside] = held_weights(count).map(|weight| weight as f32);
        for (end, node) in [0, count - 1].into_iter().enumerate() {
            if axis.ends[end] == End::Held {
                let number = number(node);
                let light = self.light(job, lines, node);
                let wall: Lanes = match job.walls[end] {
                    Wall::Same(value) => [value; LANES],
                    Wall::Each(values) => std::array::from_fn(|lane| values[lines.start + lane.min(lines.len() - 1)]),
                };
                let beside_is_free = if count > 1 { self.light(job, lines, [1, count - 2][end]) } else { light };
                for lane in 0..LANES {
                    // Between a side and a solid there is only the straight line.
                    let [held, beside] = if beside_is_free[lane] > 0.0 { [held, beside] } else { [2.0, 0.0] };
                    ends.beside[end][lane] = beside * r * number[lane] * light[lane];
                    ends.held[end][lane] = held * r * number[lane] * light[lane];
                    values[node][lane] += ends.held[end][lane] * wall[lane];
                }
            }
        }
        if axis.ends[0] == End::Cyclic {
            let link = between((count - 1, &below), (0, &first));
            for (wrap, node) in ends.wrap.iter_mut().zip([0, count - 1]) {
                let light = self.light(job, lines, node);
                for lane in 0..LANES {
                    wrap[lane] = link[lane] * light[lane];
                }
            }
        }
        (links[0], links[count]) = ([0.0; LANES], [0.0; LANES]);
        ends
    }
}

/// What the ends of a bundle add.
struct Ends {
    /// Weight of what the sides hold.
    held: [Lanes; 2],
    /// What that adds to the links of the first value and the last with those beside them.
    beside: [Lanes; 2],
    /// Links of the first value to the last and of the last to the first.
    wrap: [Lanes; 2],
}

/// Upward elimination. All is sums and products of what is positive, so that no digits are lost
/// however strong the links. Returns the weight of the last value in what closes a circle.
#[inline(always)]
fn eliminate(
    axis: Axis,
    ends: &Ends,
    light: impl Fn(usize) -> Lanes,
    values: &mut [Lanes],
    links: &[Lanes],
    back: &mut [Lanes],
    circle: &mut [Lanes],
) -> Lanes {
    let count = values.len();
    let is_cyclic = axis.ends[0] == End::Cyclic;
    // How much of the value below is not passed on from above it: one less `back`.
    let mut rest = [1.0_f32; LANES];
    let mut first_diagonal = [1.0_f32; LANES];
    for node in 0..count {
        let light = light(node);
        let (mut lower, mut upper) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            lower[lane] = links[node][lane] * light[lane];
            upper[lane] = links[node + 1][lane] * light[lane];
        }
        let mut own = [1.0_f32; LANES];
        for (end, is_end) in [node == 0, node + 1 == count].into_iter().enumerate() {
            if is_end {
                match axis.ends[end] {
                    End::Given => (lower, upper) = ([0.0; LANES], [0.0; LANES]),
                    End::Mirror if end == 0 => upper = upper.map(|link| 2.0 * link),
                    End::Mirror => lower = lower.map(|link| 2.0 * link),
                    End::Held => {
                        let inner = if end == 0 { &mut upper } else { &mut lower };
                        for lane in 0..LANES {
                            own[lane] += ends.held[end][lane];
                            inner[lane] += ends.beside[end][lane];
                        }
                    }
                    End::Free | End::Cyclic => {}
                }
            }
        }
        if is_cyclic && node == 0 {
            // Twice the diagonal.
            for lane in 0..LANES {
                first_diagonal[lane] = 1.0 + upper[lane] + ends.wrap[0][lane];
                own[lane] = first_diagonal[lane] + 1.0 + ends.wrap[0][lane];
            }
        }
        if is_cyclic && node + 1 == count {
            for lane in 0..LANES {
                own[lane] += ends.wrap[1][lane] * (1.0 + ends.wrap[0][lane] / first_diagonal[lane]);
            }
        }
        let corner = |lane: usize| {
            let first = if node == 0 { -first_diagonal[lane] } else { 0.0 };
            first - if node + 1 == count { ends.wrap[1][lane] } else { 0.0 }
        };
        for lane in 0..LANES {
            let kept = own[lane] + lower[lane] * rest[lane];
            let pivot = kept + upper[lane];
            let inverse = 1.0 / pivot;
            let below = if node > 0 { values[node - 1][lane] } else { 0.0 };
            values[node][lane] = (values[node][lane] + lower[lane] * below) * inverse;
            back[node][lane] = upper[lane] * inverse;
            rest[lane] = kept * inverse;
            if is_cyclic {
                let below = if node > 0 { circle[node - 1][lane] } else { 0.0 };
                circle[node][lane] = (corner(lane) + lower[lane] * below) * inverse;
            }
        }
    }
    std::array::from_fn(|lane| ends.wrap[0][lane] / first_diagonal[lane])
}

/// Closes cyclic systems (J. Sherman and W. J. Morrison, 1950).
#[inline(always)]
fn close(last_weight: &Lanes, values: &mut [Lanes], circle: &[Lanes]) {
    let last = values.len() - 1;
    let off: Lanes = std::array::from_fn(|lane| {
        let weight = last_weight[lane];
        let all = 1.0 + circle[0][lane] + weight * circle[last][lane];
        (values[0][lane] + weight * values[last][lane]) / all
    });
    for (value, circle) in values.iter_mut().zip(circle) {
        for lane in 0..LANES {
            value[lane] -= circle[lane] * off[lane];
        }
    }
}
