//! The pool of threads on which ants walk. No result depends on the number of threads.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

/// While the caller's thread waits for others it looks this often whether they are to go on.
const WAIT: Duration = Duration::from_micros(200);

/// Asks every so many steps of ants whether they are to go on.
pub(super) struct Pace<'a> {
    goes_on: &'a mut dyn FnMut() -> bool,
    steps_per_look: u32,
    n_steps: u32,
    is_over: bool,
}

impl<'a> Pace<'a> {
    fn new(steps_per_look: u32, goes_on: &'a mut dyn FnMut() -> bool) -> Self {
        Self {
            goes_on,
            steps_per_look,
            n_steps: 0,
            is_over: false,
        }
    }

    /// Counts a step; false once no ant is to go on.
    #[inline]
    pub(super) fn step(&mut self) -> bool {
        self.n_steps += 1;
        if self.n_steps >= self.steps_per_look {
            self.n_steps = 0;
            self.is_over = self.is_over || !(self.goes_on)();
        }
        !self.is_over
    }

    /// True once no ant is to go on.
    pub(super) fn is_over(&self) -> bool {
        self.is_over
    }
}

/// Walks ants, each by random numbers of its own, so that any worker may walk any ant.
pub(super) trait AntWorker: Send {
    /// Read by all ants of an iteration.
    type Shared: Send + Sync;
    /// The ants' paths.
    type Batch: Batch;

    /// Steps that take some tenth of a millisecond.
    const STEPS_PER_LOOK: u32;

    /// Walks some ants of an iteration, both by number, and adds their paths to a batch. Once the pace is over, it
    /// stops wherever it is.
    fn walk_ants(
        &mut self,
        shared: &Self::Shared,
        ants: (u32, Range<u32>),
        batch: &mut Self::Batch,
        pace: &mut Pace,
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
    /// Set where ants are to stop.
    is_over: Arc<AtomicBool>,
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
        let mut goes_on = || !is_over.load(Ordering::Relaxed);
        let mut pace = Pace::new(W::STEPS_PER_LOOK, &mut goes_on);
        worker.walk_ants(&shared, (iteration, ants), &mut batch, &mut pace);
        drop(shared);
        if outbox.send(batch).is_err() {
            return;
        }
    }
}

impl<W: AntWorker> WorkerPool<W> {
    /// Walks all ants of an iteration, in their order. Every few steps `goes_on` is asked whether
    /// they are to go on. Where it says no, what is in the batch is a part of the iteration and of
    /// no use.
    pub(super) fn walk_while(
        &mut self,
        shared: &Arc<W::Shared>,
        iteration: u32,
        into: &mut W::Batch,
        goes_on: &mut dyn FnMut() -> bool,
    ) {
        let is_over = Arc::new(AtomicBool::new(false));
        let ants = self.send(shared, iteration, &is_over);
        into.clear();
        let mut goes_on = || {
            let goes_on = goes_on();
            is_over.store(!goes_on, Ordering::Relaxed);
            goes_on
        };
        let mut pace = Pace::new(W::STEPS_PER_LOOK, &mut goes_on);
        self.worker
            .walk_ants(shared, (iteration, ants), into, &mut pace);
        self.collect(into, &mut goes_on);
    }

    /// Gives each thread its ants, and returns those of the caller's thread.
    fn send(
        &mut self,
        shared: &Arc<W::Shared>,
        iteration: u32,
        is_over: &Arc<AtomicBool>,
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
                is_over: Arc::clone(is_over),
            };
            thread.jobs.send(job).expect("threads wait for jobs");
        }
        ants(0)
    }

    /// Appends what the threads have walked.
    fn collect(&mut self, into: &mut W::Batch, goes_on: &mut dyn FnMut() -> bool) {
        for thread in &self.threads {
            let batch = loop {
                match thread.batches.recv_timeout(WAIT) {
                    Err(RecvTimeoutError::Timeout) => drop(goes_on()),
                    answer => break answer.expect("threads answer every job"),
                }
            };
            into.append(&batch);
        }
    }
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

        const STEPS_PER_LOOK: u32 = 8;

        fn walk_ants(
            &mut self,
            (): &(),
            (_, ants): (u32, Range<u32>),
            batch: &mut Vec<u32>,
            pace: &mut Pace,
        ) {
            batch.extend(ants.take_while(|_| pace.step()));
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
                    assert!(walked.starts_with(&[0, 1, 2, 3, 4, 5, 6]) && walked.len() < 50);
                    pool.walk_while(&shared, 2, &mut walked, &mut || true);
                    assert!(walked.iter().copied().eq(0..50));
                },
            );
        }
    }
}
