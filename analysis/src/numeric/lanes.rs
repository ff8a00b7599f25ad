//! Numbers side by side: loops of a fixed width, which the compiler turns into vector instructions.
//!
//! Each lane is a sum of its own in a fixed order, so the result does not depend on the processor's instruction set.

/// The widest group in which a whole problem fits; wider ones are cut into groups of [`GROUP`] lanes.
const WIDEST: usize = 16;

/// Lanes of a group of a problem that is cut into groups.
const GROUP: usize = 8;

/// Entries that loops over slices take at once: rows and columns that are padded to a multiple of it need no loop over a remainder.
pub const LANES: usize = 4;

/// `n` rounded up to a multiple of [`LANES`].
pub(crate) fn padded(n: usize) -> usize {
    n.next_multiple_of(LANES)
}

/// Lanes of one group for `n` numbers: all of them in one group, made even, or groups of [`GROUP`].
pub(crate) fn width(n: usize) -> usize {
    if n > WIDEST {
        GROUP
    } else {
        n.max(1).next_multiple_of(2)
    }
}

/// Calls `$call` with `W` as the constant that `$width` is: one of those that [`width`] gives.
macro_rules! with_width {
    ($width:expr, $w:ident => $call:expr) => {
        match $width {
            2 => with_width!(@ 2, $w => $call),
            4 => with_width!(@ 4, $w => $call),
            6 => with_width!(@ 6, $w => $call),
            8 => with_width!(@ 8, $w => $call),
            10 => with_width!(@ 10, $w => $call),
            12 => with_width!(@ 12, $w => $call),
            14 => with_width!(@ 14, $w => $call),
            _ => with_width!(@ 16, $w => $call),
        }
    };
    (@ $n:literal, $w:ident => $call:expr) => {{
        const $w: usize = $n;
        $call
    }};
}
pub(crate) use with_width;

/// The larger of two; the second where they cannot be compared.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two; the second where they cannot be compared.
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The largest of all lanes, by halves, so that few comparisons wait for each other.
pub(crate) fn largest<const W: usize>(mut lanes: [f64; W]) -> f64 {
    let mut n = W;
    while n > 1 {
        // An even half keeps pairs of lanes together.
        let half = if n > 2 {
            (n / 2).next_multiple_of(2)
        } else {
            1
        };
        for k in 0..n - half {
            lanes[k] = larger(lanes[k], lanes[k + half]);
        }
        n = half;
    }
    lanes[0]
}

/// `y += a * x`.
#[inline]
pub(crate) fn add_multiple<const W: usize>(y: &mut [f64; W], a: f64, x: &[f64; W]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += a * x;
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_lane_is_found_in_every_width() {
        for n in 1..=40 {
            with_width!(width(n), W => {
                for at in 0..W {
                    let lanes: [f64; W] = std::array::from_fn(|k| if k == at { 2.0 } else { 1.0 });
                    assert!((largest(lanes) - 2.0).abs() < f64::EPSILON, "{at} of {W}");
                }
                assert!(W >= n || W == GROUP);
            });
        }
    }
}
