//! The pool of threads on which ants walk. No result depends on the number of threads.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

/// Ants that set out between two looks at whether others still should.
const N_ANTS_PER_LOOK: u32 = 8;

/// Walks ants, each by random numbers of its own, so that any worker may walk any ant.
pub(super) trait AntWorker: Send {
    /// Read by all ants of an iteration.
    type Shared: Send + Sync;
    /// The ants' paths.
    type Batch: Batch;

    /// Walks some ants of an iteration, and adds their paths to a batch.
    fn walk_ants(
        &mut self,
        shared: &Self::Shared,
        iteration: u32,
        ants: Range<u32>,
        batch: &mut Self::Batch,
    );
}

/// The paths of consecutive ants of an iteration, in their order.
pub(super) trait Batch: Default + Send {
    /// Removes all paths.
    fn clear(&mut self);

    /// Appends the paths of the ants that follow.
    fn append(&mut self, batch: &Self);
}

/// Walks the ants of each iteration: the first batch on the caller's thread, the others on threads
/// that live as long as the run.
pub(super) struct WorkerPool<W: AntWorker> {
    worker: W,
    n_ants: u32,
    threads: Vec<WorkerThread<W>>,
}

/// The two channels of a thread.
struct WorkerThread<W: AntWorker> {
    jobs: Sender<Job<W>>,
    batches: Receiver<W::Batch>,
}

/// Ants to walk, and a batch for their paths.
struct Job<W: AntWorker> {
    shared: Arc<W::Shared>,
    iteration: u32,
    ants: Range<u32>,
    batch: W::Batch,
    /// Set where no further ants are to set out; none where all do.
    is_over: Option<Arc<AtomicBool>>,
}

/// Runs `body` with a pool for `n_ants` ants on at most `n_threads` threads.
pub(super) fn with_workers<W: AntWorker, R>(
    worker: impl Fn() -> W,
    n_ants: u32,
    n_threads: usize,
    body: impl FnOnce(&mut WorkerPool<W>) -> R,
) -> R {
    let n_spawned = n_threads.clamp(1, n_ants as usize) - 1;
    thread::scope(|scope| {
        let threads = (0..n_spawned).map(|_| {
            let (jobs, inbox) = channel::<Job<W>>();
            let (outbox, batches) = channel();
            let mut worker = worker();
            scope.spawn(move || serve(&mut worker, &inbox, &outbox));
            WorkerThread { jobs, batches }
        });
        let mut pool = WorkerPool {
            threads: threads.collect(),
            worker: worker(),
            n_ants,
        };
        // The threads end when the pool, and with it their job channels, is dropped.
        body(&mut pool)
    })
}

/// Walks ants until there are no more jobs.
fn serve<W: AntWorker>(worker: &mut W, inbox: &Receiver<Job<W>>, outbox: &Sender<W::Batch>) {
    while let Ok(job) = inbox.recv() {
        let Job {
            shared,
            iteration,
            ants,
            mut batch,
            is_over,
        } = job;
        batch.clear();
        match is_over {
            None => worker.walk_ants(&shared, iteration, ants, &mut batch),
            Some(is_over) => {
                let parts = parts(ants).take_while(|_| !is_over.load(Ordering::Relaxed));
                parts.for_each(|part| worker.walk_ants(&shared, iteration, part, &mut batch));
            }
        }
        drop(shared);
        if outbox.send(batch).is_err() {
            return;
        }
    }
}

impl<W: AntWorker> WorkerPool<W> {
    /// Walks all ants of an iteration, in their order.
    pub(super) fn walk(&mut self, shared: &Arc<W::Shared>, iteration: u32, into: &mut W::Batch) {
        let ants = self.send(shared, iteration, None);
        into.clear();
        self.worker.walk_ants(shared, iteration, ants, into);
        self.collect(into);
    }

    /// The same, but every few ants `goes_on` is asked whether others should set out. Where it says
    /// no, what is in the batch is a part of the iteration and of no use.
    pub(super) fn walk_while(
        &mut self,
        shared: &Arc<W::Shared>,
        iteration: u32,
        into: &mut W::Batch,
        goes_on: &mut dyn FnMut() -> bool,
    ) {
        let is_over = Arc::new(AtomicBool::new(false));
        let ants = self.send(shared, iteration, Some(&is_over));
        into.clear();
        for part in parts(ants) {
            self.worker.walk_ants(shared, iteration, part, into);
            if !goes_on() {
                is_over.store(true, Ordering::Relaxed);
                break;
            }
        }
        self.collect(into);
    }

    /// Gives each thread its ants, and returns those of the caller's thread.
    fn send(
        &mut self,
        shared: &Arc<W::Shared>,
        iteration: u32,
        is_over: Option<&Arc<AtomicBool>>,
    ) -> Range<u32> {
        let n_batches = self.threads.len() as u32 + 1;
        let ants = |i: u32| {
            let from =
                |i: u32| (u64::from(self.n_ants) * u64::from(i) / u64::from(n_batches)) as u32;
            from(i)..from(i + 1)
        };
        for (i, thread) in self.threads.iter().enumerate() {
            let job = Job {
                shared: Arc::clone(shared),
                iteration,
                ants: ants(i as u32 + 1),
                batch: W::Batch::default(),
                is_over: is_over.cloned(),
            };
            thread.jobs.send(job).expect("threads wait for jobs");
        }
        ants(0)
    }

    /// Appends what the threads have walked.
    fn collect(&mut self, into: &mut W::Batch) {
        for thread in &self.threads {
            into.append(&thread.batches.recv().expect("threads answer every job"));
        }
    }
}

/// Ranges of a few ants each.
fn parts(ants: Range<u32>) -> impl Iterator<Item = Range<u32>> {
    let end = ants.end;
    let begins = ants.step_by(N_ANTS_PER_LOOK as usize);
    begins.map(move |begin| begin..end.min(begin + N_ANTS_PER_LOOK))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Notes the ants that it walks.
    struct Counts;

    impl Batch for Vec<u32> {
        fn clear(&mut self) {
            self.clear();
        }

        fn append(&mut self, batch: &Self) {
            self.extend(batch);
        }
    }

    impl AntWorker for Counts {
        type Shared = ();
        type Batch = Vec<u32>;

        fn walk_ants(&mut self, (): &(), _: u32, ants: Range<u32>, batch: &mut Vec<u32>) {
            batch.extend(ants);
        }
    }

    #[test]
    fn all_ants_walk_in_their_order_until_no_more_should() {
        for n_threads in [1, 3] {
            with_workers(
                || Counts,
                50,
                n_threads,
                |pool| {
                    let (shared, mut walked) = (Arc::new(()), Vec::new());
                    pool.walk_while(&shared, 0, &mut walked, &mut || true);
                    assert!(walked.iter().copied().eq(0..50));
                    pool.walk_while(&shared, 1, &mut walked, &mut || false);
                    // The caller's thread has walked a part of its own ants.
                    assert!(walked.starts_with(&[0, 1, 2, 3, 4, 5, 6, 7]) && walked.len() < 50);
                    pool.walk(&shared, 2, &mut walked);
                    assert!(walked.iter().copied().eq(0..50));
                },
            );
        }
    }
}
