//! Knot removal (The NURBS Book, A5.8).

use alloc::vec::Vec;

use super::Strip;
use crate::Real;

impl<T: Real> Strip<T> {
    /// Takes one occurrence of the inner knot `t` out and returns how far this moves a point of
    /// `parts` scalars at most; `None` when `t` is no knot.
    ///
    /// The points are those from which inserting `t` again gives the old ones. There is one
    /// equation more than unknowns: half are solved from below, half from above, and where they
    /// meet the two differ by what is returned.
    pub(crate) fn remove(&mut self, t: T, parts: usize) -> Option<T> {
        let (p, width, s) = (self.degree, self.width, self.multiplicity(t));
        if s == 0 || s > p {
            return None;
        }
        let r = self.knots.partition_point(|&knot| knot <= t) - 1;
        let (first, last) = (r - p, r - s);
        let alpha = |i: usize| (t - self.knots[i]) / (self.knots[i + p + 1] - self.knots[i]);
        let row = |i: usize| &self.data[i * width..(i + 1) * width];
        // Old point = alpha (new point) + (1 - alpha) (new point before it).
        let mut below: Vec<Vec<T>> = [row(first - 1).to_vec()].into();
        let mut above: Vec<Vec<T>> = [row(last + 1).to_vec()].into();
        let (mut i, mut j) = (first, last);
        while i < j {
            let (a, b) = (alpha(i), alpha(j));
            below.push(mix(row(i), &below[below.len() - 1], |old, known| (old - (T::ONE - a) * known) / a));
            above.push(mix(row(j), &above[above.len() - 1], |old, known| (old - b * known) / (T::ONE - b)));
            (i, j) = (i + 1, j - 1);
        }
        let (from_below, from_above) = (&below[below.len() - 1], &above[above.len() - 1]);
        let moved = if i == j {
            let a = alpha(i);
            distance(row(i), &mix(from_above, from_below, |hi, lo| lo + (hi - lo) * a), parts)
        } else {
            let moved = distance(from_below, from_above, parts);
            let mean = mix(from_below, from_above, |x, y| x + (y - x) * T::from_f64(0.5));
            above.pop();
            below.pop();
            below.push(mean);
            moved
        };
        let new = below.iter().skip(1).chain(above.iter().skip(1).rev());
        let new: Vec<T> = new.flatten().copied().collect();
        self.data.splice(first * width..(last + 1) * width, new);
        self.knots.remove(r);
        Some(moved)
    }
}

fn mix<T: Real>(a: &[T], b: &[T], f: impl Fn(T, T) -> T) -> Vec<T> {
    a.iter().zip(b).map(|(&a, &b)| f(a, b)).collect()
}

/// The largest distance between blocks of `parts` scalars.
fn distance<T: Real>(a: &[T], b: &[T], parts: usize) -> T {
    let blocks = a.chunks_exact(parts).zip(b.chunks_exact(parts));
    blocks.fold(T::ZERO, |largest, (a, b)| {
        let square: T = a.iter().zip(b).map(|(&a, &b)| (a - b) * (a - b)).sum();
        largest.max(square.sqrt())
    })
}
