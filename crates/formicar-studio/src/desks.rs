//! Plans take turns: so many at a time, the others wait.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Desks at which plans are made.
#[derive(Debug)]
pub(crate) struct Desks {
    n_free: Mutex<usize>,
    freed: Condvar,
}

/// A desk in use; free again when it is dropped.
#[derive(Debug)]
pub(crate) struct Desk<'a>(&'a Desks);

/// How often one who waits looks whether it still wants to.
const LOOK: Duration = Duration::from_millis(20);

impl Desks {
    /// So many desks.
    pub(crate) fn new(n: usize) -> Self {
        Self {
            n_free: Mutex::new(n.max(1)),
            freed: Condvar::new(),
        }
    }

    /// Waits for a desk; none if the plan is no longer wanted.
    pub(crate) fn sit_down(&self, is_wanted: impl Fn() -> bool) -> Option<Desk<'_>> {
        let mut n_free = self.lock();
        while *n_free == 0 {
            let waited = self.freed.wait_timeout(n_free, LOOK);
            n_free = waited.unwrap_or_else(PoisonError::into_inner).0;
            if !is_wanted() {
                return None;
            }
        }
        *n_free -= 1;
        Some(Desk(self))
    }

    fn lock(&self) -> MutexGuard<'_, usize> {
        self.n_free.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Desk<'_> {
    fn drop(&mut self) {
        *self.0.lock() += 1;
        self.0.freed.notify_one();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whoever_does_not_want_it_any_more_gets_no_desk() {
        let desks = Desks::new(1);
        let first = desks.sit_down(|| true).unwrap();
        assert!(desks.sit_down(|| false).is_none());
        drop(first);
        assert!(desks.sit_down(|| false).is_some());
    }
}
