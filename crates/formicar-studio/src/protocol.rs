//! The messages between page and server; the page's side is `web/src/protocol.ts`.
//!
//! Text messages are JSON, told apart by `type`. A binary message is a header of the same kind
//! with a payload behind it: the header's length in bytes (u32, little endian), the header, the
//! payload.

use axum::body::Bytes;
use axum::extract::ws::Message;
use formicar::planner::{Answer, RequestDocument};
use formicar::progress::IterationRecord;
use formicar::vehicle::VehicleParameters;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

/// `[x m, y m, heading rad]`.
pub(crate) type PoseList = [f64; 3];

/// One of two plans side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Slot {
    A,
    B,
}

impl Slot {
    /// Both.
    pub(crate) const ALL: [Self; 2] = [Self::A, Self::B];

    /// Its index.
    pub(crate) fn index(self) -> usize {
        self as usize
    }
}

/// The choice of a map.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum MapChoice {
    /// A built-in by name.
    Builtin(String),
    /// An uploaded or kept one by the hash of its content.
    Hash(String),
}

/// The choice of a vehicle.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum VehicleChoice {
    /// A built-in by name.
    Preset(String),
    /// Measures of a vehicle that is no preset.
    Parameters(Box<VehicleParameters>),
}

/// A rectangle of cells.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Region {
    pub(crate) col: u32,
    pub(crate) row: u32,
    pub(crate) n_cols: u32,
    pub(crate) n_rows: u32,
}

/// The controller that steers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum DriveLaw {
    OpenLoop,
    PurePursuit,
    Stanley,
}

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum PictureFormat {
    Svg,
    Png,
}

/// An order for a plan.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlanOrder {
    pub(crate) plan: u64,
    pub(crate) slot: Slot,
    pub(crate) request: RequestDocument,
    pub(crate) config: Json,
    pub(crate) seed: u64,
    pub(crate) watch: bool,
    #[serde(default)]
    pub(crate) previous: Option<u64>,
}

/// Messages from a page.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(crate) enum ClientMessage {
    OpenMap {
        map: MapChoice,
    },
    SetVehicle {
        vehicle: VehicleChoice,
    },
    Paint {
        region: Region,
        values: Vec<i8>,
    },
    Plan(Box<PlanOrder>),
    Cancel {
        slot: Slot,
    },
    Drive {
        slot: Slot,
        law: DriveLaw,
        speed_mps: Option<f64>,
    },
    Picture {
        slot: Slot,
        format: PictureFormat,
    },
    KeepMap,
}

/// A request of a built-in map.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct NamedRequest {
    pub(crate) id: String,
    pub(crate) start: PoseList,
    pub(crate) goal: PoseList,
}

/// The point where the vehicle comes nearest to an obstacle.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Tightest {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) clearance_m: f64,
    pub(crate) pose: PoseList,
}

/// Intermediate results, as columns and rows, alternating.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct StagesRecord {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) expanded: Option<Vec<u32>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) closed: Option<Vec<u32>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) grid_path: Option<Vec<u32>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) nodes: Option<Vec<u32>>,
}

/// Messages from the server.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub(crate) enum ServerMessage<'a> {
    Hello {
        version: &'static str,
    },
    Map {
        name: &'a str,
        hash: Option<&'a str>,
        n_cols: usize,
        n_rows: usize,
        resolution_m: f64,
        origin: PoseList,
        vehicle: Option<&'a str>,
        requests: Vec<NamedRequest>,
    },
    Vehicle {
        name: &'a str,
        parameters: &'a VehicleParameters,
        footprint: Vec<[f64; 2]>,
        motion: &'static str,
        min_turning_radius_m: Option<f64>,
        wheelbase_m: Option<f64>,
        track_width_m: Option<f64>,
        max_steer_rad: Option<f64>,
    },
    Iteration {
        plan: u64,
        record: &'a IterationRecord,
        arrived: Vec<u32>,
        lost: Vec<u32>,
        best: Vec<u32>,
    },
    Generation {
        plan: u64,
        record: &'a IterationRecord,
        free: Vec<Vec<u32>>,
        colliding: Vec<Vec<u32>>,
        best: Vec<u32>,
    },
    Drive {
        plan: u64,
        generation: u32,
        n_steps: u64,
        arrived: Vec<Vec<f64>>,
        died: Vec<Vec<f64>>,
    },
    Expanded {
        plan: u64,
        n_steps: u64,
        motions: Vec<f64>,
    },
    Improved {
        plan: u64,
        slot: Slot,
        length_m: f64,
        n_steps: u64,
        at_ms: f64,
        poses: Vec<f64>,
    },
    Answer {
        plan: u64,
        slot: Slot,
        history: &'a [IterationRecord],
        stages: StagesRecord,
        tightest: Option<Tightest>,
        cli: String,
        toml: String,
        /// The last field: the page cuts its text out of the message, to save it as it was sent.
        answer: &'a Answer,
    },
    /// A newer plan of the slot was ordered before this one began.
    Dropped {
        plan: u64,
        slot: Slot,
    },
    Driven {
        slot: Slot,
        plan: u64,
        law: DriveLaw,
        tracked: bool,
        status: &'static str,
        summary: Json,
        min_clearance_m: Option<f64>,
        contact: Option<Json>,
        trace: Json,
    },
    Picture {
        slot: Slot,
        format: PictureFormat,
    },
    Kept {
        hash: &'a str,
    },
    Error {
        about: &'a str,
        message: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        plan: Option<u64>,
    },
}

impl ServerMessage<'_> {
    fn json(&self) -> String {
        serde_json::to_string(self).expect("messages have text keys and cannot fail otherwise")
    }

    /// As a text message.
    pub(crate) fn text(&self) -> Message {
        Message::text(self.json())
    }

    /// As a binary message, with a payload.
    pub(crate) fn with_payload(&self, payload: &[u8]) -> Message {
        let header = self.json();
        let mut bytes = Vec::with_capacity(4 + header.len() + payload.len());
        bytes.extend_from_slice(&(header.len() as u32).to_le_bytes());
        bytes.extend_from_slice(header.as_bytes());
        bytes.extend_from_slice(payload);
        Message::Binary(Bytes::from(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_the_page_sends_and_refuses_the_rest() {
        let read = serde_json::from_str::<ClientMessage>;
        let plan = r#"{"type": "plan", "plan": 3, "slot": "a", "seed": 7, "watch": true,
            "request": {"start": [1, 2, 0], "goal": [3, 4, 0]}, "config": {"planner": "formicar"}}"#;
        let ClientMessage::Plan(order) = read(plan).unwrap() else {
            panic!("a plan");
        };
        assert_eq!((order.plan, order.slot, order.previous), (3, Slot::A, None));
        let map = r#"{"type": "open_map", "map": {"builtin": "neighborhood"}}"#;
        assert!(matches!(read(map), Ok(ClientMessage::OpenMap { .. })));
        assert!(matches!(
            read(r#"{"type": "keep_map"}"#),
            Ok(ClientMessage::KeepMap)
        ));
        for bad in [
            "",
            "{}",
            r#"{"type": "format_disk"}"#,
            r#"{"type": "paint", "region": {}, "values": [1]}"#,
            r#"{"type": "paint", "region": {"col": -1, "row": 0, "n_cols": 1, "n_rows": 1}, "values": [1]}"#,
            r#"{"type": "open_map", "map": {"file": "/etc/passwd"}}"#,
        ] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_payload_follows_its_header() {
        let Message::Binary(bytes) = ServerMessage::Hello { version: "1" }.with_payload(&[7, 8])
        else {
            panic!("binary");
        };
        let length = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize;
        assert_eq!(&bytes[4..4 + length], br#"{"type":"hello","version":"1"}"#);
        assert_eq!(&bytes[4 + length..], &[7, 8]);
    }
}
