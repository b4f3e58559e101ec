//! The connection of a client: tasks that read, plan and write, none of which waits for another.

use crate::outbox::Outbox;
use crate::protocol::ClientMessage;
use crate::session::Session;
use crate::state::Studio;
use crate::wanted::WantedPlans;
use axum::extract::ws::{Message, WebSocket};
use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{SinkExt, StreamExt};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::OwnedSemaphorePermit;
use tokio::sync::mpsc::{Sender, channel};
use tokio::time::timeout;

/// A client that takes no message for this long is disconnected.
const WRITE_TIMEOUT: Duration = Duration::from_secs(30);

/// Serves a client until it leaves; the permit is returned then.
pub(crate) async fn serve(socket: WebSocket, studio: Arc<Studio>, permit: OwnedSemaphorePermit) {
    let limits = studio.options.limits;
    let outbox = Arc::new(Outbox::new(limits.max_unsent_bytes));
    let wanted = Arc::new(WantedPlans::default());
    let (orders, mut inbox) = channel(limits.max_waiting.max(1));
    let session = Session::new(studio, outbox.clone(), wanted.clone());
    let planning = tokio::task::spawn_blocking(move || session.run(&mut inbox));
    let (sink, stream) = socket.split();
    let writing = tokio::spawn(write(sink, outbox.clone()));
    tokio::select! {
        () = read(stream, &orders, &wanted) => {}
        _ = writing => {}
    }
    // Ends the plan under way and the wait for a permit.
    outbox.close();
    wanted.clear_all();
    drop(orders);
    // The message of a session that panicked is on stderr; its client is disconnected.
    let _ = planning.await;
    drop(permit);
}

async fn write(mut sink: SplitSink<WebSocket, Message>, outbox: Arc<Outbox>) {
    while let Some(message) = outbox.take().await {
        if !matches!(timeout(WRITE_TIMEOUT, sink.send(message)).await, Ok(Ok(()))) {
            break;
        }
    }
    outbox.close();
}

type Order = Result<ClientMessage, String>;

/// Reads messages until the client leaves. While too many orders wait, it is not read from.
async fn read(mut stream: SplitStream<WebSocket>, orders: &Sender<Order>, wanted: &WantedPlans) {
    while let Some(Ok(message)) = stream.next().await {
        let order = match message {
            Message::Text(text) => serde_json::from_str(&text).map_err(|e| e.to_string()),
            Message::Binary(_) => Err("binary messages are not understood".to_owned()),
            Message::Close(_) => return,
            Message::Ping(_) | Message::Pong(_) => continue,
        };
        cancel_obsolete(&order, wanted);
        if orders.send(order).await.is_err() {
            return;
        }
    }
}

/// Cancels the plans that a message makes obsolete, before the orders ahead of it are done.
fn cancel_obsolete(order: &Order, wanted: &WantedPlans) {
    match order {
        Ok(ClientMessage::Plan(order)) => wanted.set(order.slot, order.plan),
        Ok(ClientMessage::Cancel { slot }) => wanted.clear(*slot),
        Ok(ClientMessage::OpenMap { .. } | ClientMessage::SetVehicle { .. }) => wanted.clear_all(),
        _ => {}
    }
}
