//! Dense matrix product, the kernel of the transforms: rows contiguous, blocks of four rows by
//! eight columns in registers. Every element is summed in the same order wherever blocks fall.

const ROWS: usize = 4;
const COLUMNS: usize = 8;

/// `out[r][c] = sum over i of a[r][i] * b[i][c]`, with `inner` values a row of `a` and
/// `columns` a row of `b` and `out`.
#[inline(always)]
pub(crate) fn multiply(out: &mut [f32], a: &[f32], b: &[f32], inner: usize, columns: usize) {
    let rows = out.len() / columns;
    let mut row = 0;
    while row < rows {
        if rows >= ROWS {
            // The last block reaches back over rows that are already done.
            let first = row.min(rows - ROWS);
            band::<ROWS>(&mut out[first * columns..], &a[first * inner..], b, inner, columns);
            row = first + ROWS;
        } else {
            band::<1>(&mut out[row * columns..], &a[row * inner..], b, inner, columns);
            row += 1;
        }
    }
}

/// `R` rows of the product.
#[inline(always)]
fn band<const R: usize>(out: &mut [f32], a: &[f32], b: &[f32], inner: usize, columns: usize) {
    let mut column = 0;
    while column < columns {
        if columns >= COLUMNS {
            let first = column.min(columns - COLUMNS);
            block::<R, COLUMNS>(out, a, b, inner, columns, first);
            column = first + COLUMNS;
        } else {
            block::<R, 1>(out, a, b, inner, columns, column);
            column += 1;
        }
    }
}

/// `R` rows by `C` columns of the product, summed in registers.
#[inline(always)]
fn block<const R: usize, const C: usize>(
    out: &mut [f32],
    a: &[f32],
    b: &[f32],
    inner: usize,
    columns: usize,
    first: usize,
) {
    let mut sums = [[0.0_f32; C]; R];
    let a_rows: [&[f32]; R] = std::array::from_fn(|r| &a[r * inner..(r + 1) * inner]);
    for (i, b_row) in b.chunks_exact(columns).take(inner).enumerate() {
        let Some(values) = b_row[first..].first_chunk::<C>() else { return };
        for (sum, a_row) in sums.iter_mut().zip(&a_rows) {
            let factor = a_row[i];
            for (lane, value) in sum.iter_mut().zip(values) {
                *lane += factor * value;
            }
        }
    }
    for (sum, out_row) in sums.iter().zip(out.chunks_exact_mut(columns)) {
        out_row[first..first + C].copy_from_slice(sum);
    }
}

#[cfg(test)]
mod tests {
    use super::multiply;

    #[test]
    fn agrees_with_the_definition_at_every_size() {
        for (rows, inner, columns) in [(1, 1, 1), (2, 3, 7), (4, 8, 8), (5, 15, 15), (15, 15, 17), (9, 2, 33)] {
            let a: Vec<f32> = (0..rows * inner).map(|i| ((i * 37 % 11) as f32) - 5.0).collect();
            let b: Vec<f32> = (0..inner * columns).map(|i| ((i * 53 % 13) as f32) - 6.0).collect();
            let mut out = vec![f32::NAN; rows * columns];
            multiply(&mut out, &a, &b, inner, columns);
            for r in 0..rows {
                for c in 0..columns {
                    let sum: f32 = (0..inner).map(|i| a[r * inner + i] * b[i * columns + c]).sum();
                    assert_eq!(out[r * columns + c], sum, "{rows} x {inner} x {columns} at {r}, {c}");
                }
            }
        }
    }
}
