//! What waits for a visitor: a plan puts it there and never waits itself.

use axum::extract::ws::Message;
use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};
use tokio::sync::Notify;

/// Messages for one visitor.
#[derive(Debug)]
pub(crate) struct Outbox {
    waiting: Mutex<Waiting>,
    changed: Notify,
    max_bytes: usize,
}

#[derive(Debug, Default)]
struct Waiting {
    messages: VecDeque<Message>,
    n_bytes: usize,
    is_closed: bool,
}

/// What nobody takes grows to so many times the bytes at which frames are left out, at most.
const CUT_OFF_RATIO: usize = 4;

impl Outbox {
    /// One in which frames are left out while so many bytes wait.
    pub(crate) fn new(max_bytes: usize) -> Self {
        Self {
            waiting: Mutex::default(),
            changed: Notify::new(),
            max_bytes,
        }
    }

    /// Puts a message that must arrive. Who takes none of them is cut off.
    pub(crate) fn put(&self, message: Message) {
        let mut waiting = self.lock();
        // One message may be as large as it likes: a map is.
        let n_first = waiting.messages.front().map_or(0, size);
        if waiting.n_bytes - n_first > CUT_OFF_RATIO * self.max_bytes {
            waiting.messages.clear();
            waiting.is_closed = true;
        } else {
            waiting.n_bytes += size(&message);
            waiting.messages.push_back(message);
        }
        drop(waiting);
        self.changed.notify_one();
    }

    /// Puts a frame, unless too much waits already.
    pub(crate) fn put_frame(&self, frame: impl FnOnce() -> Message) {
        if self.lock().n_bytes < self.max_bytes {
            self.put(frame());
        }
    }

    /// No more is taken from it.
    pub(crate) fn close(&self) {
        self.lock().is_closed = true;
        self.changed.notify_one();
    }

    /// Whether it is closed: what a plan sends is for nobody.
    pub(crate) fn is_closed(&self) -> bool {
        self.lock().is_closed
    }

    /// Takes the next message when there is one; none when it is closed.
    pub(crate) async fn take(&self) -> Option<Message> {
        loop {
            {
                let mut waiting = self.lock();
                if waiting.is_closed {
                    return None;
                }
                if let Some(message) = waiting.messages.pop_front() {
                    waiting.n_bytes -= size(&message);
                    return Some(message);
                }
            }
            self.changed.notified().await;
        }
    }

    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn size(message: &Message) -> usize {
    match message {
        Message::Text(text) => text.len(),
        Message::Binary(bytes) => bytes.len(),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(n_bytes: usize) -> Message {
        Message::Binary(vec![0; n_bytes].into())
    }

    #[tokio::test]
    async fn frames_are_left_out_and_all_else_arrives_in_order() {
        let outbox = Outbox::new(10);
        for n in [6, 7, 8] {
            outbox.put_frame(|| message(n));
        }
        outbox.put(message(3));
        let sizes = [outbox.take().await, outbox.take().await];
        assert_eq!(sizes.map(|m| size(&m.unwrap())), [6, 7]);
        outbox.put_frame(|| message(2));
        assert_eq!(size(&outbox.take().await.unwrap()), 3);
        assert_eq!(size(&outbox.take().await.unwrap()), 2);
    }

    #[tokio::test]
    async fn who_takes_nothing_is_cut_off() {
        let outbox = Outbox::new(10);
        for _ in 0..7 {
            outbox.put(message(9));
        }
        assert!(outbox.is_closed());
        assert!(outbox.take().await.is_none());
    }
}
