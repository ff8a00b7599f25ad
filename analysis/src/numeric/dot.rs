//! The product of two vectors, summed in a fixed order: the result does not depend on the processor's instruction set.

/// Σ aᵢbᵢ over the shorter of the two; four sums side by side, so that an addition does not wait for the one before.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((blocks_a, rest_a), (blocks_b, rest_b)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut rest = 0.0;
    for (a, b) in rest_a.iter().zip(rest_b) {
        rest += a * b;
    }
    if blocks_a.is_empty() {
        return rest;
    }
    let mut sums = [0.0; 4];
    for (a, b) in blocks_a.iter().zip(blocks_b) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
