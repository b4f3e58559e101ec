//! Cancelling a query from another thread.

use super::Observer;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Cancels queries from any thread. Clones share one flag.
///
/// ```
/// use formicar::progress::{CancelToken, Observer, StdClock};
///
/// let token = CancelToken::new();
/// let mut observer = (StdClock::start(), token.clone());
/// std::thread::spawn(move || token.cancel()).join().unwrap();
/// assert!(observer.is_cancelled());
/// ```
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// A token that nobody has cancelled yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Cancels every query that watches the token; it stays cancelled.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// True once [`Self::cancel`] was called on any clone.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Observer for CancelToken {
    fn is_cancelled(&mut self) -> bool {
        Self::is_cancelled(self)
    }
}
