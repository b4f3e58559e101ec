//! The line to one visitor: who reads it, who plans, and who writes to it never wait for each
//! other.

use crate::Studio;
use crate::outbox::Outbox;
use crate::protocol::{ClientMessage, Slot};
use crate::session::{Newest, Session};
use axum::extract::ws::{Message, WebSocket};
use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{SinkExt, StreamExt};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::time::Duration;
use tokio::time::timeout;

/// A visitor that takes nothing for so long has left.
const PATIENCE: Duration = Duration::from_secs(30);
/// How long to wait while too many of a visitor's requests wait.
const PAUSE: Duration = Duration::from_millis(5);
/// No plan has this number: in a slot with it nothing is wanted.
const NOTHING: u64 = u64::MAX;

/// The right to be here; given back when it is dropped.
pub(crate) struct Seat(pub(crate) Arc<Studio>);

impl Drop for Seat {
    fn drop(&mut self) {
        self.0.n_clients.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Serves a visitor until it leaves.
pub(crate) async fn receive(socket: WebSocket, seat: Seat) {
    let studio = seat.0.clone();
    let outbox = Arc::new(Outbox::new(studio.options.limits.max_unsent_bytes));
    let newest: Arc<Newest> = Arc::default();
    let (orders, inbox) = sync_channel(studio.options.limits.max_waiting);
    let session = Session::new(studio, outbox.clone(), newest.clone());
    let planning = tokio::task::spawn_blocking(move || session.run(&inbox));
    let (sink, stream) = socket.split();
    let writing = tokio::spawn(write(sink, outbox.clone()));
    tokio::select! {
        () = read(stream, &orders, &newest) => {}
        () = closed(writing) => {}
    }
    // A plan under way sees that nobody waits for it any more.
    outbox.close();
    drop(orders);
    // A session that panicked has told so on stderr; its visitor is cut off.
    let _ = planning.await;
    drop(seat);
}

async fn closed(writing: tokio::task::JoinHandle<()>) {
    let _ = writing.await;
}

async fn write(mut sink: SplitSink<WebSocket, Message>, outbox: Arc<Outbox>) {
    while let Some(message) = outbox.take().await {
        if !matches!(timeout(PATIENCE, sink.send(message)).await, Ok(Ok(()))) {
            break;
        }
    }
    outbox.close();
}

type Order = Result<ClientMessage, String>;

async fn read(mut stream: SplitStream<WebSocket>, orders: &SyncSender<Order>, newest: &Newest) {
    while let Some(Ok(message)) = stream.next().await {
        let order = match message {
            Message::Text(text) => serde_json::from_str(&text).map_err(|e| e.to_string()),
            Message::Binary(_) => Err("binary messages are not understood".to_owned()),
            Message::Close(_) => return,
            Message::Ping(_) | Message::Pong(_) => continue,
        };
        foresee(&order, newest);
        if !hand_over(order, orders).await {
            return;
        }
    }
}

/// Stops the plan that a message makes idle, before those that wait get their turn.
fn foresee(order: &Order, newest: &Newest) {
    let set = |slot: Slot, plan: u64| newest[slot.index()].store(plan, Ordering::Relaxed);
    match order {
        Ok(ClientMessage::Plan(order)) => set(order.slot, order.plan),
        Ok(ClientMessage::Cancel { slot }) => set(*slot, NOTHING),
        Ok(ClientMessage::OpenMap { .. } | ClientMessage::SetVehicle { .. }) => {
            for slot in Slot::ALL {
                set(slot, NOTHING);
            }
        }
        _ => {}
    }
}

/// Hands an order to the session; while too many wait, the visitor is not read from.
async fn hand_over(mut order: Order, orders: &SyncSender<Order>) -> bool {
    loop {
        match orders.try_send(order) {
            Ok(()) => return true,
            Err(TrySendError::Disconnected(_)) => return false,
            Err(TrySendError::Full(back)) => order = back,
        }
        tokio::time::sleep(PAUSE).await;
    }
}
