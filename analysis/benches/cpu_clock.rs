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

/// Prints one row: microseconds of CPU a call, and how many bare products that is.
pub fn print_row(name: &str, nanos: f64, product_nanos: f64) {
    println!(
        "{name:<58} {:>9.3} us {:>7.1} x",
        nanos / 1e3,
        nanos / product_nanos
    );
}
