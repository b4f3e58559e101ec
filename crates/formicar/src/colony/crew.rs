//! The threads that ants walk on: which and how many never shows in a result.

use std::ops::Range;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

/// Walks ants, each by random numbers of its own, so that it does not matter who walks which.
pub(super) trait Walk: Send {
    /// What the ants of an iteration read.
    type Shared: Send + Sync;
    /// The ants' ways.
    type Part: Part;

    /// Sends some ants of an iteration, and adds their ways to a part of it.
    fn send(
        &mut self,
        shared: &Self::Shared,
        iteration: u32,
        ants: Range<u32>,
        part: &mut Self::Part,
    );
}

/// The ways of some ants of an iteration, in their order.
pub(super) trait Part: Default + Send {
    /// Forgets them.
    fn clear(&mut self);

    /// Appends those of the ants that follow.
    fn append(&mut self, part: &Self);
}

/// Walks the ants of each iteration: the first part on the caller's thread, the others on helpers
/// that live as long as the run.
pub(super) struct Crew<W: Walk> {
    walker: W,
    n_ants: u32,
    helpers: Vec<Helper<W>>,
}

/// The two ends of a thread.
struct Helper<W: Walk> {
    orders: Sender<Order<W>>,
    parts: Receiver<W::Part>,
}

/// Ants to walk, and a part to put their ways in.
struct Order<W: Walk> {
    shared: Arc<W::Shared>,
    iteration: u32,
    ants: Range<u32>,
    part: W::Part,
}

/// Runs `body` with a crew for so many ants on at most `n_threads` threads.
pub(super) fn with_crew<W: Walk, R>(
    walker: impl Fn() -> W,
    n_ants: u32,
    n_threads: usize,
    body: impl FnOnce(&mut Crew<W>) -> R,
) -> R {
    let n_helpers = n_threads.clamp(1, n_ants as usize) - 1;
    thread::scope(|scope| {
        let helpers = (0..n_helpers).map(|_| {
            let (orders, inbox) = channel::<Order<W>>();
            let (outbox, parts) = channel();
            let mut walker = walker();
            scope.spawn(move || serve(&mut walker, &inbox, &outbox));
            Helper { orders, parts }
        });
        let mut crew = Crew {
            helpers: helpers.collect(),
            walker: walker(),
            n_ants,
        };
        // Helpers end when the crew, and with it their orders, is gone.
        body(&mut crew)
    })
}

/// Walks ants until there are no more orders.
fn serve<W: Walk>(walker: &mut W, inbox: &Receiver<Order<W>>, outbox: &Sender<W::Part>) {
    while let Ok(order) = inbox.recv() {
        let Order {
            shared,
            iteration,
            ants,
            mut part,
        } = order;
        part.clear();
        walker.send(&shared, iteration, ants, &mut part);
        drop(shared);
        if outbox.send(part).is_err() {
            return;
        }
    }
}

impl<W: Walk> Crew<W> {
    /// Walks all ants of an iteration, in their order.
    pub(super) fn walk(&mut self, shared: &Arc<W::Shared>, iteration: u32, into: &mut W::Part) {
        into.clear();
        let n_parts = self.helpers.len() as u32 + 1;
        let part = |i: u32| {
            let from = |i: u32| (u64::from(self.n_ants) * u64::from(i) / u64::from(n_parts)) as u32;
            from(i)..from(i + 1)
        };
        for (i, helper) in self.helpers.iter().enumerate() {
            let order = Order {
                shared: Arc::clone(shared),
                iteration,
                ants: part(i as u32 + 1),
                part: W::Part::default(),
            };
            helper.orders.send(order).expect("helpers wait for orders");
        }
        self.walker.send(shared, iteration, part(0), into);
        for helper in &self.helpers {
            into.append(&helper.parts.recv().expect("helpers answer every order"));
        }
    }
}
