//! Jobs over the machine's cores, results in the order of the jobs.

use std::{
    num::NonZero,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
};

/// Most threads: a job holds a take and all its solutions.
const MAX_THREADS: usize = 8;

/// Does `work` on every job; each thread has a helper of its own from `start`.
pub fn map<J: Sync, H, T: Send>(
    jobs: &[J],
    start: impl Fn() -> H + Sync,
    work: impl Fn(&mut H, &J) -> T + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::with_capacity(jobs.len()));
    let n_threads = std::thread::available_parallelism().map_or(1, NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..n_threads.min(MAX_THREADS) {
            scope.spawn(|| {
                let mut helper = start();
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(job) = jobs.get(index) else { break };
                    let result = work(&mut helper, job);
                    results.lock().unwrap().push((index, result));
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap();
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}
