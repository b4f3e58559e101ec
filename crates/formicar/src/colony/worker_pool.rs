//! The pool of threads on which ants walk. No result depends on the number of threads.

use std::ops::Range;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

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
        } = job;
        batch.clear();
        worker.walk_ants(&shared, iteration, ants, &mut batch);
        drop(shared);
        if outbox.send(batch).is_err() {
            return;
        }
    }
}

impl<W: AntWorker> WorkerPool<W> {
    /// Walks all ants of an iteration, in their order.
    pub(super) fn walk(&mut self, shared: &Arc<W::Shared>, iteration: u32, into: &mut W::Batch) {
        into.clear();
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
            };
            thread.jobs.send(job).expect("threads wait for jobs");
        }
        self.worker.walk_ants(shared, iteration, ants(0), into);
        for thread in &self.threads {
            into.append(&thread.batches.recv().expect("threads answer every job"));
        }
    }
}
