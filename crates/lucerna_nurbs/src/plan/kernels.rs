//! The inner loops, compiled once for each set of vector instructions.
//!
//! Every lane sees the same operations in the same order, so that equal inputs give equal bits
//! wherever they stand in a row.

use super::blocks::Blocks;
use super::limit::flat;
use super::net::Net;
use super::{GridPlan, topology};
use crate::Real;
use core::ops::Range;
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdFloatElement, SimdMask};

/// The first stage: control columns `chosen`, contracted along u.
///
/// For each block and chosen column: the parts of the point, a register each, then the parts of its
/// derivative along u.
#[inline(always)]
pub(super) fn contract<T: Real, S: Simd>(
    simd: S,
    blocks: &Blocks<T>,
    net: &Net<'_, T>,
    chosen: &[usize],
    columns: &mut [T],
) {
    match net.parts {
        3 => contract_parts::<T, S, 3>(simd, blocks, net, chosen, columns),
        _ => contract_parts::<T, S, 4>(simd, blocks, net, chosen, columns),
    }
}

#[inline(always)]
fn contract_parts<T: Real, S: Simd, const P: usize>(
    simd: S,
    blocks: &Blocks<T>,
    net: &Net<'_, T>,
    chosen: &[usize],
    columns: &mut [T],
) {
    let lanes = T::Native::<S>::LEN;
    let zero = T::Native::<S>::splat(simd, T::ZERO);
    let points = net.scaled.as_chunks::<P>().0;
    let mut columns = columns.chunks_exact_mut(2 * P * lanes);
    for index in 0..blocks.len() {
        let (rows, factors) = blocks.block(index);
        for (&j, to) in chosen.iter().zip(&mut columns) {
            let mut sums = [[zero; P]; 2];
            for (&row, factors) in rows.iter().zip(factors.chunks_exact(2 * lanes)) {
                let (values, slopes) = factors.split_at(lanes);
                let (values, slopes) = (load::<T, S>(simd, values), load::<T, S>(simd, slopes));
                let point = &points[row * net.n_v + j];
                for c in 0..P {
                    let x = T::Native::<S>::splat(simd, point[c]);
                    sums[0][c] += x * values;
                    sums[1][c] += x * slopes;
                }
            }
            for (sum, to) in sums.as_flattened().iter().zip(to.chunks_exact_mut(lanes)) {
                sum.store_slice(to);
            }
        }
    }
}

#[inline(always)]
fn load<T: Real, S: Simd>(simd: S, from: &[T]) -> T::Native<S> {
    T::Native::<S>::from_slice(simd, &from[..T::Native::<S>::LEN])
}

/// Rows of vertices, in plain form, one behind the other.
#[inline(always)]
pub(super) fn fill_rows<T: Real, S: Simd>(
    simd: S,
    plan: &GridPlan<T>,
    net: &Net<'_, T>,
    columns: &[T],
    pole: &mut [T],
    rows: Range<usize>,
    to: &mut [[T; 8]],
) {
    let mut to = to;
    for j in rows {
        let (row, rest) = to.split_at_mut(topology::row_len(&plan.options, j));
        to = rest;
        let sample = plan.v.sample(j);
        let mut source = Source {
            blocks: &plan.blocks,
            columns,
            chosen: net.n_v,
            indices: sample.indices,
            values: sample.values,
            slopes: sample.slopes,
        };
        let end = plan.v.open && (j == 0 || j == plan.options.rows);
        if !end {
            match net.parts {
                3 => fill_row::<T, S, 3, false>(simd, plan, net, &source, None, j, row),
                _ => fill_row::<T, S, 4, false>(simd, plan, net, &source, None, j, row),
            }
            continue;
        }
        let declared = row.len() == plan.options.columns;
        let shared = plan.collapsed(net, j).or_else(|| declared.then(|| plan.position(net, 0, j)));
        if let Some(middle) = plan.middle.as_ref().filter(|_| declared) {
            contract(simd, &middle.blocks, net, sample.indices, pole);
            let indices = &plan.v.all[..plan.v.width];
            source = Source { blocks: &middle.blocks, columns: pole, chosen: indices.len(), indices, ..source };
        }
        match net.parts {
            3 => fill_row::<T, S, 3, true>(simd, plan, net, &source, shared, j, row),
            _ => fill_row::<T, S, 4, true>(simd, plan, net, &source, shared, j, row),
        }
    }
}

/// What a row is contracted from.
struct Source<'a, T> {
    blocks: &'a Blocks<T>,
    columns: &'a [T],
    /// The number of control columns in `columns`.
    chosen: usize,
    /// Those of them that the row depends on, and their factors.
    indices: &'a [usize],
    values: &'a [T],
    slopes: &'a [T],
}

/// The second stage, for a row: `END` for one at an end of v, where an edge may have collapsed.
#[inline(always)]
fn fill_row<T: Real, S: Simd, const P: usize, const END: bool>(
    simd: S,
    plan: &GridPlan<T>,
    net: &Net<'_, T>,
    source: &Source<'_, T>,
    shared: Option<[T; 3]>,
    j: usize,
    row: &mut [[T; 8]],
) {
    let lanes = T::Native::<S>::LEN;
    let splat = |x| T::Native::<S>::splat(simd, x);
    let (size, origin, v) = (splat(net.size), net.origin, splat(plan.v.places[j]));
    let origin = [splat(origin[0]), splat(origin[1]), splat(origin[2])];
    let side = splat(if j == 0 { T::ONE } else { -T::ONE });
    let sign = splat(if plan.options.flip { -T::ONE } else { T::ONE });
    let per_block = source.chosen * 2 * P * lanes;
    let blocks = source.columns.chunks_exact(per_block).zip(source.blocks.places.chunks_exact(lanes));
    let mut spare = [[T::ZERO; 8]; 16];
    for ((columns, places), start) in blocks.zip((0..row.len()).step_by(lanes)) {
        let mut sums = Sums::<T, S, P>::zero(simd);
        for ((&index, &value), &slope) in source.indices.iter().zip(source.values).zip(source.slopes) {
            let column = &columns[index * 2 * P * lanes..(index + 1) * 2 * P * lanes];
            sums.add::<END>(simd, column, splat(value), splat(slope));
        }
        let jet = sums.jet::<END>(simd);
        let (normal, good) = if END { jet.end_normal(simd, side, sign) } else { jet.normal(simd, sign) };
        let mut position = [jet.s[0] * size + origin[0], jet.s[1] * size + origin[1], jet.s[2] * size + origin[2]];
        if let Some(shared) = shared.filter(|_| END) {
            position = [splat(shared[0]), splat(shared[1]), splat(shared[2])];
        }
        let ([x, y, z], [a, b, c]) = (position, normal);
        let vertex = [x, y, z, load::<T, S>(simd, places), a, b, c, v];
        let rest = &mut row[start..];
        if let Some(to) = rest.get_mut(..lanes) {
            T::store_rows(simd, vertex, to);
        } else {
            T::store_rows(simd, vertex, &mut spare[..lanes]);
            rest.copy_from_slice(&spare[..rest.len()]);
        }
        if !good.all_true() {
            plan.repair(net, start, j, good.to_bitmask(), &mut row[start..]);
        }
    }
}

/// Homogeneous points and derivatives of neighbouring columns.
struct Sums<T: Real, S: Simd, const P: usize> {
    s: [T::Native<S>; P],
    su: [T::Native<S>; P],
    sv: [T::Native<S>; P],
    suv: [T::Native<S>; P],
}

impl<T: Real, S: Simd, const P: usize> Sums<T, S, P> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        let zero = [T::Native::<S>::splat(simd, T::ZERO); P];
        Self { s: zero, su: zero, sv: zero, suv: zero }
    }

    #[inline(always)]
    fn add<const END: bool>(&mut self, simd: S, column: &[T], value: T::Native<S>, slope: T::Native<S>) {
        let lanes = T::Native::<S>::LEN;
        for c in 0..P {
            let point = load::<T, S>(simd, &column[c * lanes..]);
            let along = load::<T, S>(simd, &column[(P + c) * lanes..]);
            self.s[c] += point * value;
            self.sv[c] += point * slope;
            self.su[c] += along * value;
            if END {
                self.suv[c] += along * slope;
            }
        }
    }

    /// A4.4 for first derivatives, and for the mixed one where it is used. Inside, derivatives keep
    /// the factor of the weight: only their directions matter.
    #[inline(always)]
    fn jet<const END: bool>(self, simd: S) -> Jet<T, S> {
        let one = T::Native::<S>::splat(simd, T::ONE);
        let xyz = |a: [T::Native<S>; P]| [a[0], a[1], a[2]];
        let mut jet = Jet { s: xyz(self.s), su: xyz(self.su), sv: xyz(self.sv), suv: xyz(self.suv), w: one };
        if P == 3 {
            return jet;
        }
        jet.w = self.s[P - 1];
        let (wu, wv, wuv, by) = (self.su[P - 1], self.sv[P - 1], self.suv[P - 1], one / jet.w);
        for c in 0..3 {
            jet.s[c] *= by;
            jet.su[c] -= wu * jet.s[c];
            jet.sv[c] -= wv * jet.s[c];
            if END {
                jet.su[c] *= by;
                jet.sv[c] *= by;
                jet.suv[c] = (jet.suv[c] - wuv * jet.s[c] - wu * jet.sv[c] - wv * jet.su[c]) * by;
            }
        }
        if END {
            jet.w = one;
        }
        jet
    }
}

/// Points and derivatives in space; the first derivatives times `w`.
struct Jet<T: Real, S: Simd> {
    s: [T::Native<S>; 3],
    su: [T::Native<S>; 3],
    sv: [T::Native<S>; 3],
    suv: [T::Native<S>; 3],
    w: T::Native<S>,
}

type Mask<T, S> = <<T as SimdFloatElement>::Native<S> as SimdBase<S>>::Mask;

impl<T: Real, S: Simd> Jet<T, S> {
    /// The unit normal, and where it can be trusted.
    #[inline(always)]
    fn normal(&self, simd: S, sign: T::Native<S>) -> ([T::Native<S>; 3], Mask<T, S>) {
        let splat = |x| T::Native::<S>::splat(simd, x);
        let ([ux, uy, uz], [vx, vy, vz]) = (self.su, self.sv);
        let x = uy * vz - uz * vy;
        let y = uz * vx - ux * vz;
        let z = ux * vy - uy * vx;
        let uu = ux * ux + uy * uy + uz * uz;
        let vv = vx * vx + vy * vy + vz * vz;
        let nn = x * x + y * y + z * z;
        let least = self.w * self.w * splat(flat::<T>() * flat::<T>());
        let good = uu.simd_gt(least) & vv.simd_gt(least);
        // Neither lost in rounding nor too small or too large for a square root.
        let rounding = uu * vv * splat(T::EPSILON) + splat(T::MIN_POSITIVE);
        let good = good & nn.simd_gt(rounding) & nn.simd_lt(splat(T::MAX));
        let by = sign / nn.sqrt();
        ([x * by, y * by, z * by], good)
    }

    /// The same at an end of v: where dS/du vanishes, d2S/du dv takes its place, in the direction
    /// `side`.
    #[inline(always)]
    fn end_normal(&self, simd: S, side: T::Native<S>, sign: T::Native<S>) -> ([T::Native<S>; 3], Mask<T, S>) {
        let least = T::Native::<S>::splat(simd, flat());
        let above =
            |a: &[T::Native<S>; 3]| a[0].abs().simd_gt(least) | a[1].abs().simd_gt(least) | a[2].abs().simd_gt(least);
        let limit = !above(&self.su) & above(&self.suv);
        let mut turned = Self { ..*self };
        for c in 0..3 {
            turned.su[c] = limit.select(self.suv[c] * side, self.su[c]);
        }
        turned.normal(simd, sign)
    }
}
