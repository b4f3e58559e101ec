//! `drive`: the loop from outside, its files and exit codes.

use crate::common::{Room, Run};
use serde_json::Value;

/// Drives through the door of the room; flags that are given take the place of the usual ones.
fn drive(room: &Room, more: &[&str]) -> Run {
    let usual = [
        ["--map", "room.yaml"],
        ["--start", "2,2,0"],
        ["--goal", "10,2,0"],
        ["--goal-heading", "any"],
    ];
    let missing = usual.iter().filter(|[flag, _]| !more.contains(flag));
    let words: Vec<&str> = ["drive"]
        .into_iter()
        .chain(missing.flatten().copied())
        .chain(more.iter().copied())
        .collect();
    room.run(&words)
}

/// The record without what a clock measures.
fn untimed(mut record: Value) -> Value {
    record.as_object_mut().unwrap().remove("latencies");
    record
}

#[test]
fn an_unknown_room_is_crossed_and_the_record_says_how() {
    let room = Room::new();
    let files = [
        "--out",
        "run.json",
        "--picture",
        "run.svg",
        "--film",
        "run.gif",
        "--json",
    ];
    let run = drive(&room, &[&["--unknown-map"], &files[..]].concat());
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let record = run.json();
    assert_eq!(record["schema"], "formicar/drive/1");
    assert_eq!(record["status"], "arrived");
    assert_eq!(record["contacts"], Value::Array(Vec::new()));
    assert!(record["goal_error_m"].as_f64().unwrap() < 0.11);
    assert!(record["min_static_distance_m"].as_f64().unwrap() > 0.0);
    let known_share = record["known_share"].as_f64().unwrap();
    assert!(known_share > 0.2 && known_share < 1.0, "{known_share}");
    for who in ["planner", "controller"] {
        let latency = &record["latencies"][who];
        let [median, p99, worst] =
            ["median_ms", "p99_ms", "worst_ms"].map(|key| latency[key].as_f64().unwrap());
        assert!(0.0 < median && median <= p99 && p99 <= worst);
    }
    let trace = record["trace"].as_array().unwrap();
    assert!(trace.len() > 50);
    assert_eq!(trace[0]["t_s"], 0.0);
    let written: Value = serde_json::from_str(&room.read("run.json")).unwrap();
    assert_eq!(written, record);
    assert!(room.read("run.svg").starts_with("<svg"));
    let film = std::fs::read(room.path("run.gif")).unwrap();
    assert!(film.starts_with(b"GIF89a"));
    // Known from the beginning, the room takes no longer; the same seed, the same drive.
    let known = drive(&room, &["--json"]);
    assert_eq!(known.code, 0, "{}", known.stderr);
    let again = drive(&room, &["--json"]);
    assert_eq!(untimed(known.json()), untimed(again.json()));
}

#[test]
fn time_that_is_over_and_a_goal_out_of_reach_end_with_3() {
    let room = Room::new();
    let run = drive(&room, &["--max-time", "2"]);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    run.assert_says("timed_out");
}

#[test]
fn agents_come_from_files_and_who_ran_into_whom_is_said() {
    let room = Room::new();
    // It comes at 4 m/s from ahead, before the robot has set out.
    room.write(
        "agents.json",
        r#"{"agents": [{"name": "ball", "shape": {"disc": {"radius_m": 0.2}}, "behavior":
            {"scripted": [{"t_s": 0, "pose": [3.2, 2, 0]}, {"t_s": 0.2, "pose": [2.5, 2, 0]}, {"t_s": 2, "pose": [2.5, 5, 0]}]}}]}"#,
    );
    let run = drive(
        &room,
        &[
            "--agents",
            "agents.json",
            "--pose-noise",
            "0.01,0.5deg",
            "--json",
        ],
    );
    let record = run.json();
    let contact = &record["contacts"][0];
    assert_eq!(contact["by"], "other", "{contact}");
    assert_eq!(contact["with"]["agent"], "ball");
    assert_eq!(record["agents"][0]["name"], "ball");
    let walkers = drive(
        &room,
        &["--agents-random", "3", "--max-time", "1", "--json"],
    );
    assert_eq!(walkers.json()["agents"].as_array().unwrap().len(), 3);
}

#[test]
fn bad_input_is_refused_with_value_and_hint() {
    let room = Room::new();
    room.write("far.json", r#"{"agents": [{"shape": {"disc": {"radius_m": 0.2}}, "behavior": {"walker": {"position": [99, 2], "speed_mps": 1, "yields": true}}}]}"#);
    room.write("inside.json", r#"{"agents": [{"shape": {"disc": {"radius_m": 0.2}}, "behavior": {"velocity": {"pose": [2.1, 2, 0], "velocity_mps": [0, 0]}}}]}"#);
    room.write(
        "odd.json",
        r#"{"agents": [{"shape": {"disc": {"radius_m": 0.2}}, "behavior": {"flies": {}}}]}"#,
    );
    room.write("back.json", r#"{"agents": [{"shape": {"disc": {"radius_m": 0.2}}, "behavior": {"scripted": [{"t_s": 1, "pose": [5, 5, 0]}, {"t_s": 0, "pose": [5, 5, 0]}]}}]}"#);
    for (words, expected) in [
        (
            &["--agents", "far.json"][..],
            &["agent 1", "off the map"][..],
        ),
        (
            &["--agents", "inside.json"],
            &["agent 1", "inside the robot"],
        ),
        (&["--agents", "odd.json"], &["odd.json", "flies"]),
        (&["--agents", "back.json"], &["times must rise"]),
        (
            &["--start", "99,2,0"],
            &["start (99.000, 2.000) m", "outside the map"],
        ),
        (
            &["--goal", "99,2,0"],
            &["goal (99.000, 2.000) m", "outside the map"],
        ),
        (&["--start", "nan,2,0"], &["not finite"]),
        (&["--max-time", "0"], &["above 0"]),
        (&["--delay", "9"], &["delay_s"]),
        (&["--vehicle", "point"], &["point"]),
        (&["--out", "run.txt"], &["unknown extension"]),
    ] {
        drive(&room, words).assert_refused(expected);
    }
}
