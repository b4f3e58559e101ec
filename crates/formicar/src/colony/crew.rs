//! The threads that ants walk on: which and how many never shows in a result.

use super::ant::Walker;
use super::config::ColonyConfig;
use super::generation::Generation;
use super::ground::Ground;
use super::node::Node;
use crate::numeric::Seed;
use std::ops::Range;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;

/// Walks the ants of each iteration: the first part on the caller's thread, the others on helpers
/// that live as long as the run.
pub(super) struct Crew<'a> {
    walker: Walker<'a>,
    n_ants: u32,
    helpers: Vec<Helper>,
}

/// The two ends of a thread.
struct Helper {
    orders: Sender<Order>,
    parts: Receiver<Generation>,
}

/// Ants to walk, and a generation to put their ways in.
struct Order {
    nodes: Arc<Vec<Node>>,
    iteration: u32,
    ants: Range<u32>,
    part: Generation,
}

/// Runs `body` with a crew on at most `n_threads` threads.
pub(super) fn with_crew<R>(
    ground: &Ground,
    (config, seed): (&ColonyConfig, Seed),
    n_threads: usize,
    body: impl FnOnce(&mut Crew) -> R,
) -> R {
    let walker = || Walker::new(ground, config, seed);
    let n_helpers = n_threads.clamp(1, config.n_ants as usize) - 1;
    thread::scope(|scope| {
        let helpers = (0..n_helpers).map(|_| {
            let (orders, inbox) = channel::<Order>();
            let (outbox, parts) = channel();
            let mut walker = walker();
            scope.spawn(move || serve(&mut walker, &inbox, &outbox));
            Helper { orders, parts }
        });
        let mut crew = Crew {
            helpers: helpers.collect(),
            walker: walker(),
            n_ants: config.n_ants,
        };
        // Helpers end when the crew, and with it their orders, is gone.
        body(&mut crew)
    })
}

/// Walks ants until there are no more orders.
fn serve(walker: &mut Walker, inbox: &Receiver<Order>, outbox: &Sender<Generation>) {
    while let Ok(order) = inbox.recv() {
        let Order {
            nodes,
            iteration,
            ants,
            mut part,
        } = order;
        part.clear();
        walker.send(&nodes, iteration, ants, &mut part);
        drop(nodes);
        if outbox.send(part).is_err() {
            return;
        }
    }
}

impl Crew<'_> {
    /// Walks all ants of an iteration, in their order.
    pub(super) fn walk(&mut self, nodes: &Arc<Vec<Node>>, iteration: u32, into: &mut Generation) {
        into.clear();
        let n_parts = self.helpers.len() as u32 + 1;
        let part = |i: u32| {
            let from = |i: u32| (u64::from(self.n_ants) * u64::from(i) / u64::from(n_parts)) as u32;
            from(i)..from(i + 1)
        };
        for (i, helper) in self.helpers.iter().enumerate() {
            let order = Order {
                nodes: Arc::clone(nodes),
                iteration,
                ants: part(i as u32 + 1),
                part: Generation::default(),
            };
            helper.orders.send(order).expect("helpers wait for orders");
        }
        self.walker.send(nodes, iteration, part(0), into);
        for helper in &self.helpers {
            into.append(&helper.parts.recv().expect("helpers answer every order"));
        }
    }
}
