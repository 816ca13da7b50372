//! The tridiagonal system of one line: the same for every line of an axis.

use crate::limits::MAX_AXIS_CELLS;

/// What an end of a line meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// The last value lies on the side, and stays.
    Given,
    /// The last value lies on the side, and there is no gradient across.
    Mirror,
    /// Half a cell beyond the last value the side holds a value of its own. The gradient there is
    /// that of the parabola through it and the last two values, `(8 w - 9 a + b) / 3`: with a
    /// straight line, `2 (w - a)`, the error of the second derivative would not fall with the grid.
    Held,
    /// Half a cell beyond the last value there is no gradient.
    Free,
    /// The other end of the line.
    Cyclic,
}

/// A factored system: going up, each value becomes `scale * value + carry * the one below`;
/// going down, `value + back * the one above`.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) count: usize,
    pub(crate) scale: [f32; MAX_AXIS_CELLS + 1],
    pub(crate) carry: [f32; MAX_AXIS_CELLS + 1],
    pub(crate) back: [f32; MAX_AXIS_CELLS + 1],
    /// Weight of the values that the sides hold.
    pub(crate) held: [f32; 2],
    /// Of a cyclic line.
    pub(crate) circle: Option<Circle>,
}

/// What closes a cyclic system (J. Sherman and W. J. Morrison, 1950): the first value plus
/// `last` times the last one, times `share`, has to be taken off.
#[derive(Clone, Debug)]
pub(crate) struct Circle {
    pub(crate) last: f32,
    pub(crate) share: [f32; MAX_AXIS_CELLS + 1],
}

/// How much more strongly than neighbours are linked the last value of a line of `count` feels
/// what the side holds, and its neighbour: see [`End::Held`]. Both stay positive, so that no
/// maximum rises. A value alone has only the straight line.
pub(super) fn held_weights(count: usize) -> [f64; 2] {
    if count > 1 { [8.0 / 3.0, 1.0 / 3.0] } else { [2.0, 0.0] }
}

impl Line {
    /// For `count` values and the diffusion number `r`.
    pub(crate) fn new(count: usize, r: f64, ends: [End; 2]) -> Self {
        let zeros = [0.0; MAX_AXIS_CELLS + 1];
        let is_cyclic = ends[0] == End::Cyclic;
        let [held, beside] = held_weights(count);
        let mut line = Self {
            count,
            scale: zeros,
            carry: zeros,
            back: zeros,
            held: ends.map(|end| if end == End::Held { (held * r) as f32 } else { 0.0 }),
            circle: None,
        };
        let full = 1.0 + 2.0 * r;
        let (mut above, mut circle) = (0.0, [0.0_f64; MAX_AXIS_CELLS + 1]);
        for node in 0..count {
            let (mut lower, mut upper, mut diagonal) = (r, r, full);
            for (end, is_end) in [node == 0, node + 1 == count].into_iter().enumerate() {
                if !is_end {
                    continue;
                }
                let (outer, inner) = if end == 0 { (&mut lower, &mut upper) } else { (&mut upper, &mut lower) };
                *outer = 0.0;
                match ends[end] {
                    End::Given => (diagonal, *inner) = (1.0, 0.0),
                    End::Mirror => *inner = 2.0 * r,
                    End::Held => {
                        diagonal += (held + beside - 1.0) * r;
                        *inner += beside * r;
                    }
                    End::Free => diagonal -= r,
                    End::Cyclic if node == 0 => diagonal += full,
                    End::Cyclic => diagonal += r * r / full,
                }
            }
            let pivot = diagonal - lower * above;
            above = upper / pivot;
            line.scale[node] = (1.0 / pivot) as f32;
            line.carry[node] = (lower / pivot) as f32;
            line.back[node] = above as f32;
            if is_cyclic {
                let corner = if node == 0 { -full } else { 0.0 } + if node + 1 == count { -r } else { 0.0 };
                let below = if node == 0 { 0.0 } else { circle[node - 1] };
                circle[node] = (corner + lower * below) / pivot;
            }
        }
        if is_cyclic {
            for node in (0..count - 1).rev() {
                circle[node] += f64::from(line.back[node]) * circle[node + 1];
            }
            let last = r / full;
            let all = 1.0 + circle[0] + last * circle[count - 1];
            line.circle = Some(Circle { last: last as f32, share: circle.map(|value| (value / all) as f32) });
        }
        line
    }
}
