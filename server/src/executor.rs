//! Where work that would hold up the runtime runs: a bounded pool, or inline.
//!
//! Catalogue commits, imports and exports go through [`Workers`], never the frame path (CONTRACTS O-6).
//! Inline workers make the whole server run on one thread, which a deterministic simulation needs.

use std::sync::Arc;

use tokio::{sync::Semaphore, task::JoinError};

/// Runs closures that may take longer than a poll should.
///
/// Cheap to clone; all clones share the same pool.
/// When every worker is busy a caller waits its turn, first come first served.
/// A caller that goes away before its turn takes its work with it; work that has begun is finished.
#[derive(Clone, Debug)]
pub struct Workers(Kind);

#[derive(Clone, Debug)]
enum Kind {
    Pool(Arc<Semaphore>),
    Inline,
}

impl Workers {
    /// At most `n_workers` closures at once, on threads of their own.
    pub fn pool(n_workers: usize) -> Self {
        Self(Kind::Pool(Arc::new(Semaphore::new(n_workers.max(1)))))
    }

    /// Every closure runs where it is awaited.
    pub fn inline() -> Self {
        Self(Kind::Inline)
    }

    /// Runs `work` and returns what it returns.
    ///
    /// # Panics
    ///
    /// When `work` does: its panic goes on in the caller.
    pub async fn run<T, F>(&self, work: F) -> T
    where
        F: FnOnce() -> T + Send + 'static,
        T: Send + 'static,
    {
        let Kind::Pool(turns) = &self.0 else {
            return work();
        };
        let turn = Arc::clone(turns)
            .acquire_owned()
            .await
            .expect("invariant: the semaphore is never closed");
        let job = move || {
            let _turn = turn;
            work()
        };
        tokio::task::spawn_blocking(job)
            .await
            .unwrap_or_else(|error| resume(error))
    }
}

/// Whether a server has threads for its long work.
#[derive(Clone, Copy, Debug)]
pub enum Threads {
    /// Bounded pools of them.
    Pools,
    /// None but the caller's, as in a simulation.
    Inline,
}

impl Threads {
    /// Workers that run at most `n_workers` closures at once.
    pub fn workers(self, n_workers: usize) -> Workers {
        match self {
            Self::Pools => Workers::pool(n_workers),
            Self::Inline => Workers::inline(),
        }
    }
}

fn resume<T>(error: JoinError) -> T {
    match error.try_into_panic() {
        Ok(panic) => std::panic::resume_unwind(panic),
        Err(_) => unreachable!("blocking work that has begun is never cancelled"),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[tokio::test]
    async fn a_pool_runs_no_more_at_once_than_it_has_workers() {
        let workers = Workers::pool(2);
        let (running, most) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
        let jobs = (0..8).map(|_| {
            let (workers, running, most) = (workers.clone(), running.clone(), most.clone());
            async move {
                workers
                    .run(move || {
                        let now = running.fetch_add(1, Ordering::SeqCst) + 1;
                        most.fetch_max(now, Ordering::SeqCst);
                        std::hint::black_box((0..100_000).sum::<u64>());
                        running.fetch_sub(1, Ordering::SeqCst);
                    })
                    .await;
            }
        });
        futures::future::join_all(jobs).await;
        assert!(most.load(Ordering::SeqCst) <= 2);
    }

    #[tokio::test]
    async fn a_panic_reaches_the_caller_and_frees_the_worker() {
        let workers = Workers::pool(1);
        let shared = workers.clone();
        let failed = tokio::spawn(async move { shared.run(|| panic!("on purpose")).await }).await;
        assert!(failed.is_err());
        assert_eq!(workers.run(|| 7).await, 7);
    }

    #[tokio::test]
    async fn inline_work_runs_on_the_callers_thread() {
        let caller = std::thread::current().id();
        let worker = Workers::inline().run(|| std::thread::current().id()).await;
        assert_eq!(caller, worker);
    }
}
