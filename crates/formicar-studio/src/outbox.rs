//! The queue of messages for a client: plans add to it without ever waiting.

use axum::extract::ws::Message;
use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};
use tokio::sync::Notify;

/// The messages for one client.
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

/// A client is disconnected when more than this many times the limit for frames wait for it.
const DISCONNECT_RATIO: usize = 4;

impl Outbox {
    /// A queue that leaves out frames while this many bytes wait.
    pub(crate) fn new(max_bytes: usize) -> Self {
        Self {
            waiting: Mutex::default(),
            changed: Notify::new(),
            max_bytes,
        }
    }

    /// Adds a message that must arrive. A client that takes none of them is disconnected.
    pub(crate) fn put(&self, message: Message) {
        let mut waiting = self.lock();
        // A single message may be of any size, as a map is.
        let n_first = waiting.messages.front().map_or(0, size);
        if waiting.n_bytes - n_first > DISCONNECT_RATIO * self.max_bytes {
            waiting.messages.clear();
            waiting.is_closed = true;
        } else {
            waiting.n_bytes += size(&message);
            waiting.messages.push_back(message);
        }
        drop(waiting);
        self.changed.notify_one();
    }

    /// Adds a frame, unless too much waits already.
    pub(crate) fn put_frame(&self, frame: impl FnOnce() -> Message) {
        if self.lock().n_bytes < self.max_bytes {
            self.put(frame());
        }
    }

    /// Ends the queue: no more messages are taken.
    pub(crate) fn close(&self) {
        self.lock().is_closed = true;
        self.changed.notify_one();
    }

    /// Whether the client is gone, so that nobody receives further messages.
    pub(crate) fn is_closed(&self) -> bool {
        self.lock().is_closed
    }

    /// Waits for the next message; none once the queue is closed.
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
    async fn frames_are_left_out_and_other_messages_arrive_in_order() {
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
    async fn a_client_that_takes_nothing_is_disconnected() {
        let outbox = Outbox::new(10);
        for _ in 0..7 {
            outbox.put(message(9));
        }
        assert!(outbox.is_closed());
        assert!(outbox.take().await.is_none());
    }
}
