//! Reductions over a row in eight lanes, which the compiler keeps in vector registers.

const LANES: usize = 8;

/// Greatest magnitude.
#[inline(always)]
pub(crate) fn max_abs(row: &[f32]) -> f32 {
    let mut lanes = [0.0_f32; LANES];
    let (chunks, rest) = row.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            let size = value.abs();
            *lane = if size > *lane { size } else { *lane };
        }
    }
    rest.iter().chain(&lanes).fold(0.0, |most, value| most.max(value.abs()))
}

/// Greatest value, or zero.
#[inline(always)]
pub(crate) fn highest(row: &[f32]) -> f32 {
    let mut lanes = [0.0_f32; LANES];
    let (chunks, rest) = row.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane = if *value > *lane { *value } else { *lane };
        }
    }
    rest.iter().chain(&lanes).fold(0.0, |most, value| most.max(*value))
}

/// Sum of the squares.
#[inline(always)]
pub(crate) fn sum_squares(row: &[f32]) -> f64 {
    let mut lanes = [0.0_f32; LANES];
    let (chunks, rest) = row.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane += value * value;
        }
    }
    let lanes: f64 = lanes.iter().map(|lane| f64::from(*lane)).sum();
    lanes + rest.iter().map(|value| f64::from(value * value)).sum::<f64>()
}

/// Sum.
#[inline(always)]
pub(crate) fn sum(row: &[f32]) -> f64 {
    let mut lanes = [0.0_f32; LANES];
    let (chunks, rest) = row.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane += value;
        }
    }
    let lanes: f64 = lanes.iter().map(|lane| f64::from(*lane)).sum();
    lanes + rest.iter().map(|value| f64::from(*value)).sum::<f64>()
}
