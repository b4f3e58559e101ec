//! The plans that a client still waits for, and the permits to make them.

use crate::protocol::Slot;
use std::pin::pin;
use std::sync::atomic::{AtomicU64, Ordering};
use tokio::sync::{Notify, Semaphore, SemaphorePermit};

/// No plan has this number: in a slot with it nothing is wanted.
const NOTHING: u64 = u64::MAX;

/// The newest plan that a client has asked for in each slot; any older one is obsolete.
#[derive(Debug, Default)]
pub(crate) struct WantedPlans {
    newest: [AtomicU64; 2],
    changed: Notify,
}

impl WantedPlans {
    /// Makes a plan the newest of its slot.
    pub(crate) fn set(&self, slot: Slot, plan: u64) {
        self.newest[slot.index()].store(plan, Ordering::Relaxed);
        self.changed.notify_one();
    }

    /// Makes all plans of a slot obsolete.
    pub(crate) fn clear(&self, slot: Slot) {
        self.set(slot, NOTHING);
    }

    /// Makes all plans obsolete.
    pub(crate) fn clear_all(&self) {
        for slot in Slot::ALL {
            self.clear(slot);
        }
    }

    /// Whether a plan is the newest of its slot.
    pub(crate) fn is_newest(&self, slot: Slot, plan: u64) -> bool {
        self.newest[slot.index()].load(Ordering::Relaxed) == plan
    }

    /// Waits in line for a permit to plan; none once the plan is no longer wanted.
    pub(crate) async fn permit<'a>(
        &self,
        permits: &'a Semaphore,
        is_wanted: impl Fn() -> bool,
    ) -> Option<SemaphorePermit<'a>> {
        let mut permit = pin!(permits.acquire());
        loop {
            if !is_wanted() {
                return None;
            }
            tokio::select! {
                permit = &mut permit => return permit.ok().filter(|_| is_wanted()),
                // A change before this wait is remembered: it ends at once.
                () = self.changed.notified() => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use tokio::sync::mpsc::unbounded_channel;

    #[tokio::test]
    async fn an_obsolete_plan_gets_no_permit() {
        let permits = Semaphore::new(1);
        let wanted = WantedPlans::default();
        wanted.set(Slot::A, 1);
        let is_wanted = |plan| wanted.is_newest(Slot::A, plan);
        let first = wanted.permit(&permits, || is_wanted(1)).await.unwrap();
        let waiting = wanted.permit(&permits, || is_wanted(1));
        let change = async { wanted.set(Slot::A, 2) };
        assert!(tokio::join!(waiting, change).0.is_none());
        drop(first);
        assert!(wanted.permit(&permits, || is_wanted(1)).await.is_none());
        assert!(wanted.permit(&permits, || is_wanted(2)).await.is_some());
        wanted.clear_all();
        assert!(wanted.permit(&permits, || is_wanted(2)).await.is_none());
    }

    #[tokio::test]
    async fn plans_are_made_in_the_order_in_which_they_were_asked_for() {
        let permits = Arc::new(Semaphore::new(1));
        let first = permits.clone().acquire_owned().await.unwrap();
        let (sender, mut order) = unbounded_channel();
        for i in 0..8 {
            let (permits, sender) = (permits.clone(), sender.clone());
            tokio::spawn(async move {
                let wanted = WantedPlans::default();
                let _permit = wanted.permit(&permits, || true).await;
                sender.send(i).unwrap();
            });
            // Lets the task come to its wait.
            tokio::task::yield_now().await;
        }
        drop((first, sender));
        let mut served = Vec::new();
        while let Some(i) = order.recv().await {
            served.push(i);
        }
        assert_eq!(served, [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}
