//! Plans take turns: so many at a time, the others wait, first come first served.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Desks at which plans are made.
#[derive(Debug)]
pub(crate) struct Desks {
    hall: Mutex<Hall>,
    changed: Condvar,
}

/// Free desks, and who waits for one, in order.
#[derive(Debug)]
struct Hall {
    n_free: usize,
    waiting: VecDeque<u64>,
    n_tickets: u64,
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
            hall: Mutex::new(Hall {
                n_free: n.max(1),
                waiting: VecDeque::new(),
                n_tickets: 0,
            }),
            changed: Condvar::new(),
        }
    }

    /// Waits for a desk; none if the plan is no longer wanted.
    pub(crate) fn sit_down(&self, is_wanted: impl Fn() -> bool) -> Option<Desk<'_>> {
        let mut hall = self.lock();
        let ticket = hall.n_tickets;
        hall.n_tickets += 1;
        hall.waiting.push_back(ticket);
        while hall.n_free == 0 || hall.waiting.front() != Some(&ticket) {
            let waited = self.changed.wait_timeout(hall, LOOK);
            hall = waited.unwrap_or_else(PoisonError::into_inner).0;
            if !is_wanted() {
                hall.waiting.retain(|&other| other != ticket);
                self.changed.notify_all();
                return None;
            }
        }
        hall.waiting.pop_front();
        hall.n_free -= 1;
        // Where several are free at once, the next in line can sit down too.
        self.changed.notify_all();
        Some(Desk(self))
    }

    fn lock(&self) -> MutexGuard<'_, Hall> {
        self.hall.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Desk<'_> {
    fn drop(&mut self) {
        self.0.lock().n_free += 1;
        self.0.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    #[test]
    fn whoever_does_not_want_it_any_more_gets_no_desk() {
        let desks = Desks::new(1);
        let first = desks.sit_down(|| true).unwrap();
        assert!(desks.sit_down(|| false).is_none());
        drop(first);
        assert!(desks.sit_down(|| false).is_some());
    }

    #[test]
    fn who_came_first_sits_down_first() {
        let desks = &Desks::new(1);
        let first = desks.sit_down(|| true).unwrap();
        let (seated, order) = mpsc::channel();
        std::thread::scope(|scope| {
            for i in 0..8 {
                let seated = seated.clone();
                scope.spawn(move || {
                    let _desk = desks.sit_down(|| true);
                    seated.send(i).unwrap();
                });
                while desks.lock().waiting.len() <= i {
                    std::thread::yield_now();
                }
            }
            drop(first);
        });
        drop(seated);
        assert_eq!(
            order.into_iter().collect::<Vec<_>>(),
            [0, 1, 2, 3, 4, 5, 6, 7]
        );
    }
}
