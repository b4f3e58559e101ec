//! A studio on a free port, and visitors that speak its protocol.

use formicar_studio::{Options, serve};
use futures_util::{SinkExt, StreamExt};
use serde_json::{Value as Json, json};
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::mpsc::channel;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

/// Serves a studio as long as the test runs; where it listens.
pub(crate) fn studio(options: Options) -> SocketAddr {
    let (tell, told) = channel();
    std::thread::spawn(move || {
        let options = Options { port: 0, ..options };
        serve(options, |address| tell.send(address.to_owned()).unwrap()).unwrap();
    });
    let address = told.recv().unwrap();
    let host = address.trim_start_matches("http://");
    host.split('/').next().unwrap().parse().unwrap()
}

/// Runs a test that waits for messages.
pub(crate) fn run<T>(test: impl Future<Output = T>) -> T {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build();
    runtime.unwrap().block_on(test)
}

/// Sends a request as it stands; status line, headers and body of the answer.
pub(crate) fn http(at: SocketAddr, request: &[u8]) -> String {
    let mut line = TcpStream::connect(at).unwrap();
    line.write_all(request).unwrap();
    let mut answer = Vec::new();
    line.read_to_end(&mut answer).unwrap();
    String::from_utf8_lossy(&answer).into_owned()
}

/// Asks for an address.
pub(crate) fn get(at: SocketAddr, path: &str) -> String {
    let request = format!("GET {path} HTTP/1.1\r\nHost: {at}\r\nConnection: close\r\n\r\n");
    http(at, request.as_bytes())
}

/// A visitor.
pub(crate) struct Visitor(WebSocketStream<MaybeTlsStream<tokio::net::TcpStream>>);

impl Visitor {
    /// Comes in, and opens a built-in map.
    pub(crate) async fn on(at: SocketAddr, map: &str) -> Self {
        let mut visitor = Self::new(at).await;
        visitor
            .say(&json!({ "type": "open_map", "map": { "builtin": map } }))
            .await;
        visitor.wait_for("vehicle").await;
        visitor
    }

    /// Comes in.
    pub(crate) async fn new(at: SocketAddr) -> Self {
        let (line, _) = connect_async(format!("ws://{at}/ws")).await.unwrap();
        let mut visitor = Self(line);
        visitor.wait_for("hello").await;
        visitor
    }

    /// Says something.
    pub(crate) async fn say(&mut self, message: &Json) {
        self.0
            .send(Message::text(message.to_string()))
            .await
            .unwrap();
    }

    /// The next message; the header of one with a payload.
    pub(crate) async fn hear(&mut self) -> Json {
        loop {
            match self.0.next().await.unwrap().unwrap() {
                Message::Text(text) => return serde_json::from_str(&text).unwrap(),
                Message::Binary(bytes) => {
                    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
                    return serde_json::from_slice(&bytes[4..4 + length]).unwrap();
                }
                _ => {}
            }
        }
    }

    /// The next message of a type; an error is one only where it was asked for.
    pub(crate) async fn wait_for(&mut self, kind: &str) -> Json {
        loop {
            let message = self.hear().await;
            if message["type"] == kind {
                return message;
            }
            assert_ne!(message["type"], "error", "{message}");
        }
    }
}

/// An order to plan.
pub(crate) fn plan(number: u64, planner: &str, [start, goal]: [[f64; 3]; 2]) -> Json {
    json!({
        "type": "plan",
        "plan": number,
        "slot": "a",
        "request": { "start": start, "goal": goal },
        "config": { "planner": planner },
        "seed": 1,
        "watch": true,
    })
}

/// Start and goal on the built-in map lei-map1.
pub(crate) const LEI_MAP1: [[f64; 3]; 2] = [
    [0.75, 0.75, 0.0],
    [9.25, 4.25, -std::f64::consts::FRAC_PI_2],
];
/// Start and goal on the built-in neighborhood.
pub(crate) const NEIGHBORHOOD: [[f64; 3]; 2] = [
    [29.2, 3.0, std::f64::consts::FRAC_PI_2],
    [110.0, 86.0, std::f64::consts::FRAC_PI_2],
];
