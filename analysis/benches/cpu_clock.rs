//! CPU time of a piece of work on this thread, beside a bare matrix-vector product measured in the same run.
#![allow(
    dead_code,
    clippy::allow_attributes,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "shared by tests and benches that each use a part; counts and times are small and positive"
)]

use std::hint::black_box;

use rustix::time::{ClockId, clock_gettime};

/// Batches timed a measurement; their median is quoted.
const BATCHES: usize = 31;

/// CPU time that a batch should take, nanoseconds: long against the clock's own resolution.
const BATCH_NANOS: f64 = 4e6;

/// CPU nanoseconds that this thread has used.
fn thread_cpu_nanos() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e9 + time.tv_nsec as f64
}

fn time(repetitions: usize, work: &mut impl FnMut()) -> f64 {
    let start = thread_cpu_nanos();
    for _ in 0..repetitions {
        work();
    }
    (thread_cpu_nanos() - start) / repetitions as f64
}

/// Median CPU nanoseconds of one call of `work`.
pub fn median_nanos(mut work: impl FnMut()) -> f64 {
    let once = time(3, &mut work).max(1.0);
    let repetitions = (BATCH_NANOS / once).ceil() as usize;
    let mut batches: Vec<f64> = (0..BATCHES).map(|_| time(repetitions, &mut work)).collect();
    batches.sort_by(f64::total_cmp);
    batches[BATCHES / 2]
}

/// A bare 81 × 16 matrix-vector product: the arithmetic that one frame of 27 markers and 16 muscles cannot do without.
pub fn matrix_vector_nanos() -> f64 {
    let columns: Vec<f64> = (0..81 * 16).map(|it| f64::from(it) * 1e-3).collect();
    let x: Vec<f64> = (0..16).map(f64::from).collect();
    let mut y = vec![0.0; 81];
    median_nanos(|| {
        y.fill(0.0);
        for (column, x) in columns.chunks_exact(81).zip(black_box(&x)) {
            for (y, d) in y.iter_mut().zip(column) {
                *y += d * x;
            }
        }
        black_box(&mut y);
    })
}

/// What a frame of the plain problem, regions split, cannot do without: Dᵀd over the 11 markers × 6 muscles and 16 × 10 of
/// the two regions, and one 16 × 16 product. The sums of all columns run side by side.
pub fn projection_and_product_nanos() -> f64 {
    fn by_rows<const W: usize>(rows: &[[f64; W]], d: &[f64]) -> [f64; W] {
        let mut sums = [0.0; W];
        for (row, d) in rows.iter().zip(d) {
            for (sum, entry) in sums.iter_mut().zip(row) {
                *sum += entry * d;
            }
        }
        sums
    }
    fn filled<const W: usize>(n: usize) -> Vec<[f64; W]> {
        (0..n)
            .map(|i| std::array::from_fn(|k| (i * W + k) as f64 * 1e-3))
            .collect()
    }
    let (upper, lower, square) = (filled::<6>(33), filled::<10>(48), filled::<16>(16));
    let d: Vec<f64> = (0..81).map(f64::from).collect();
    let x: Vec<f64> = (0..16).map(f64::from).collect();
    median_nanos(|| {
        let d = black_box(&d);
        black_box(by_rows(&upper, &d[..33]));
        black_box(by_rows(&lower, &d[33..]));
        black_box(by_rows(&square, black_box(&x)));
    })
}

/// Prints one row: microseconds of CPU a call, and how many bare products that is.
pub fn print_row(name: &str, nanos: f64, product_nanos: f64) {
    println!(
        "{name:<58} {:>9.3} us {:>7.1} x",
        nanos / 1e3,
        nanos / product_nanos
    );
}
