//! The inner loops: the same work for all columns of a row, in vector registers.
//!
//! Every lane sees the same operations in the same order, so that equal inputs give equal bits
//! wherever they stand in a row.

use super::limit::flat;
use crate::Real;

/// The sum of blocks of `source`, each times its factor, always in the order given.
#[inline]
pub(super) fn combine<T: Real>(out: &mut [T], source: &[T], stride: usize, indices: &[usize], factors: &[T]) {
    let len = out.len();
    let block = |k: usize| &source[indices[k] * stride..indices[k] * stride + len];
    if let (&[_, _, _, _], &[a, b, c, d]) = (indices, factors) {
        let (p, q, r, s) = (block(0), block(1), block(2), block(3));
        for i in 0..len {
            out[i] = p[i] * a + q[i] * b + r[i] * c + s[i] * d;
        }
        return;
    }
    out.fill(T::ZERO);
    for (k, &factor) in factors.iter().enumerate() {
        for (sum, &x) in out.iter_mut().zip(block(k)) {
            *sum += x * factor;
        }
    }
}

/// A4.4 for first derivatives, a row at a time.
pub(super) fn divide<T: Real>(s: &mut [T], su: &mut [T], sv: &mut [T], lanes: usize) {
    let (s, w) = s.split_at_mut(3 * lanes);
    let (su, wu) = su.split_at_mut(3 * lanes);
    let (sv, wv) = sv.split_at_mut(3 * lanes);
    for w in w.iter_mut() {
        *w = T::ONE / *w;
    }
    let parts = s.chunks_exact_mut(lanes).zip(su.chunks_exact_mut(lanes));
    for ((s, su), sv) in parts.zip(sv.chunks_exact_mut(lanes)) {
        let (w, wu, wv) = (&w[..lanes], &wu[..lanes], &wv[..lanes]);
        for i in 0..lanes {
            s[i] *= w[i];
            su[i] = (su[i] - wu[i] * s[i]) * w[i];
            sv[i] = (sv[i] - wv[i] * s[i]) * w[i];
        }
    }
}

/// Unit normals of a row, with a fourth part that is positive where they can be trusted.
pub(super) fn cross_rows<T: Real>(su: &[T], sv: &[T], out: &mut [T], lanes: usize, sign: T) {
    let part = |a, i: usize| -> &[T] {
        let a: &[T] = a;
        &a[i * lanes..(i + 1) * lanes]
    };
    let (ux, uy, uz) = (part(su, 0), part(su, 1), part(su, 2));
    let (vx, vy, vz) = (part(sv, 0), part(sv, 1), part(sv, 2));
    let (nx, out) = out.split_at_mut(lanes);
    let (ny, out) = out.split_at_mut(lanes);
    let (nz, trust) = out.split_at_mut(lanes);
    let (ny, nz, trust) = (&mut ny[..lanes], &mut nz[..lanes], &mut trust[..lanes]);
    let least = flat::<T>() * flat::<T>();
    for i in 0..lanes {
        let x = uy[i] * vz[i] - uz[i] * vy[i];
        let y = uz[i] * vx[i] - ux[i] * vz[i];
        let z = ux[i] * vy[i] - uy[i] * vx[i];
        let uu = ux[i] * ux[i] + uy[i] * uy[i] + uz[i] * uz[i];
        let vv = vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i];
        let nn = x * x + y * y + z * z;
        let good = (uu > least) & (vv > least) & (nn > T::EPSILON * uu * vv);
        let by = sign / nn.sqrt();
        nx[i] = x * by;
        ny[i] = y * by;
        nz[i] = z * by;
        trust[i] = if good & (nn < T::MAX) { T::ONE } else { T::ZERO };
    }
}
