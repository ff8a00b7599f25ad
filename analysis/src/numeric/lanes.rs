//! Loops over whole lanes: what is padded to a multiple of a few numbers needs no loop over a remainder.

/// Rows and columns are padded to a multiple of this.
pub const LANES: usize = 4;

/// `n` rounded up to whole lanes.
pub(crate) fn padded(n: usize) -> usize {
    n.next_multiple_of(LANES)
}

/// `y -= a * x` for lengths that are multiples of [`LANES`].
#[inline]
pub(crate) fn subtract_multiple(y: &mut [f64], a: f64, x: &[f64]) {
    let (y, _) = y.as_chunks_mut::<LANES>();
    let (x, _) = x.as_chunks::<LANES>();
    for (y, x) in y.iter_mut().zip(x) {
        for (y, x) in y.iter_mut().zip(x) {
            *y -= a * x;
        }
    }
}

/// `y -= a[0] * x[0]`, then `y -= a[1] * x[1]`, in one pass; lengths are multiples of [`LANES`].
#[inline]
pub(crate) fn subtract_two(y: &mut [f64], [a, b]: [f64; 2], [x, z]: [&[f64]; 2]) {
    let (y, _) = y.as_chunks_mut::<LANES>();
    let ((x, _), (z, _)) = (x.as_chunks::<LANES>(), z.as_chunks::<LANES>());
    for ((y, x), z) in y.iter_mut().zip(x).zip(z) {
        for ((y, x), z) in y.iter_mut().zip(x).zip(z) {
            *y = (*y - a * x) - b * z;
        }
    }
}
