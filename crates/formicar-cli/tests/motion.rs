//! `plan --moving`, `check` and `track` in time: files, words and exit codes.

use crate::common::Room;
use serde_json::{Value, json};

const STEERED: &str = r#"{"wheelbase_m": 0.65, "width_m": 0.5, "front_overhang_m": 0.1,
    "rear_overhang_m": 0.1, "max_steer_deg": 40, "max_steer_rate_rad_per_s": 0.8, "speed_mps": 0.8}"#;

/// Somebody who walks through the door of the room, toward the car.
fn walker(pose: [f64; 3], velocity_mps: [f64; 2]) -> Value {
    json!({
        "horizon_s": 40,
        "obstacles": [{
            "name": "walker",
            "shape": {"disc": {"radius_m": 0.3}},
            "motion": {"velocity": {"pose": pose, "velocity_mps": velocity_mps}},
        }],
    })
}

fn room(moving: &Value) -> Room {
    let room = Room::new();
    room.write("car.json", STEERED);
    room.write("moving.json", moving.to_string());
    room
}

const CAR: [&str; 5] = [
    "--vehicle",
    "car.json",
    "--continuous-curvature",
    "--moving",
    "moving.json",
];

#[test]
fn a_drive_waits_for_a_walker_and_is_certified() {
    let room = room(&walker([6.0, 7.5, 0.0], [0.0, -0.25]));
    let files = [
        "--out",
        "plan.json",
        "--out",
        "plan.csv",
        "--picture",
        "plan.svg",
    ];
    let run = room.plan(&[&CAR[..], &files].concat());
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    run.assert_says("in time    ");
    run.assert_says("later than with nothing in the way");
    run.assert_says("from walker at");

    let answer: Value = serde_json::from_str(&room.read("plan.json")).unwrap();
    let motion = &answer["motion"];
    assert_eq!(motion["status"], "arrives");
    assert_eq!(motion["certificate"]["valid"], true);
    let least_m = motion["certificate"]["min_distance_m"].as_f64().unwrap();
    assert!(least_m >= 0.1, "{least_m}");
    let last = answer["path"]["poses"].as_array().unwrap().last().unwrap();
    assert_eq!(last["time"], motion["profile"]["duration_s"]);
    let table = room.read("plan.csv");
    assert!(table.starts_with(
        "x,y,heading,s,direction,curvature,steer,clearance,speed,time,acceleration,steer_rate\n"
    ));
    let picture = room.read("plan.svg");
    assert!(picture.contains("arc length over time") && !picture.contains("NaN"));

    let check = [
        "check",
        "plan.json",
        "--map",
        "room.yaml",
        "--vehicle",
        "car.json",
    ];
    let checked = room.run(&check);
    assert_eq!(checked.code, 0, "{}{}", checked.stdout, checked.stderr);
    checked.assert_says("certified");
    // Another walker is in the way of the same drive.
    let other = walker([6.0, 6.0, 0.0], [0.0, 0.0]).to_string();
    room.write("other.json", other);
    let against = room.run(&[&check[..], &["--moving", "other.json"]].concat());
    assert_eq!(against.code, 3, "{}", against.stdout);
    against.assert_says("obstacle walker touches the vehicle at");
}

#[test]
fn a_speed_alone_is_planned_too() {
    let room = room(&json!({}));
    let run = room.plan(&["--vehicle", "car.json", "--speed", "0.4", "--json"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let motion = &run.json()["motion"];
    assert_eq!(motion["profile"]["source"], "fastest");
    let top = motion["certificate"]["max_speed_mps"].as_f64().unwrap();
    assert!(top <= 0.4 + 1e-9, "{top}");
    let jerk = [
        "--vehicle",
        "car.json",
        "--speed",
        "0.4",
        "--jerk",
        "0.5",
        "--json",
    ];
    let run = room.plan(&jerk);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let slower = &run.json()["motion"];
    assert_eq!(slower["certificate"]["valid"], true);
    let jerk = slower["certificate"]["max_jerk_mps3"].as_f64().unwrap();
    assert!(jerk > 0.0 && jerk <= 0.5 + 1e-6, "{jerk}");
    assert_eq!(slower["status"], "arrives");
    let seconds = |motion: &Value| motion["profile"]["duration_s"].as_f64().unwrap();
    assert!(seconds(slower) > seconds(motion));
}

#[test]
fn what_stays_in_the_way_is_waited_for() {
    let mut moving = walker([6.0, 6.5, 0.0], [0.0, 0.0]);
    // It fills the door.
    moving["obstacles"][0]["shape"]["disc"]["radius_m"] = json!(1.2);
    let run = room(&moving).plan(&[&CAR[..], &["--json"]].concat());
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let motion = &run.json()["motion"];
    let (status, arrives) = (&motion["status"], &motion["certificate"]["arrives"]);
    assert_eq!((status, arrives), (&json!("waits"), &json!(false)));
}

#[test]
fn a_way_around_is_taken_where_waiting_takes_longer() {
    // It stands on the path, near one side of the door.
    let room = room(&walker([6.1, 5.6, 0.0], [0.0, 0.0]));
    let run = room.plan(&[&CAR[..], &["--out", "plan.json"]].concat());
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    run.assert_says("the path leads around moving obstacles");
    let answer: Value = serde_json::from_str(&room.read("plan.json")).unwrap();
    assert_eq!(answer["motion"]["status"], "arrives");
    let check = [
        "check",
        "plan.json",
        "--map",
        "room.yaml",
        "--vehicle",
        "car.json",
    ];
    let checked = room.run(&check);
    assert_eq!(checked.code, 0, "{}{}", checked.stdout, checked.stderr);
}

#[test]
fn an_obstacle_that_leaves_no_way_out_is_named() {
    let room = room(&walker([4.5, 2.0, 0.0], [-1.5, 0.0]));
    // The car has no time to back off, and its path leads forward.
    let run = room.plan(&CAR);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    run.assert_says("not driven obstacle walker comes within 0.1 m");
}

#[test]
fn bad_predictions_are_refused_with_value_limit_and_hint() {
    let good = walker([6.0, 7.0, 0.0], [0.0, 0.0]);
    let cases = [
        ("/horizon_s", json!(0), "horizon_s = 0"),
        (
            "/obstacles/0/motion/velocity/pose",
            json!([2.1, 2, 0]),
            "inside the vehicle",
        ),
        (
            "/obstacles/0/motion/velocity/pose",
            json!([60, 7, 0]),
            "off the map",
        ),
        (
            "/obstacles/0/shape/disc/radius_m",
            json!(-1),
            "radius_m = -1",
        ),
        ("/obstacles/0/growth_mps", json!(-1), "growth_mps = -1"),
        (
            "/obstacles/0/motion",
            json!({"waypoints": [{"t_s": 3, "pose": [6, 7, 0]}, {"t_s": 2, "pose": [6, 7, 0]}]}),
            "times must rise",
        ),
        (
            "/obstacles/0/motion",
            json!({"jump": {}}),
            "see `schema moving`",
        ),
    ];
    for (place, value, words) in cases {
        let mut bad = good.clone();
        if place.ends_with("growth_mps") {
            bad["obstacles"][0]["growth_mps"] = value;
        } else {
            *bad.pointer_mut(place).unwrap() = value;
        }
        room(&bad).plan(&CAR).assert_refused(&[words]);
    }
    let room = room(&good);
    room.plan(&["--jerk", "1"]).assert_refused(&["--speed"]);
    let fast = [
        "--vehicle",
        "car.json",
        "--speed",
        "0.5",
        "--from-speed",
        "3",
    ];
    room.plan(&fast)
        .assert_refused(&["present_speed_mps = 3", "hint"]);
}

#[test]
fn speed_zones_bound_the_profile() {
    let room = room(&json!({}));
    // Half the speed everywhere.
    let row = "50 ".repeat(60);
    let rows = vec![row.trim_end(); 40].join("\n");
    let pgm = format!("P2\n60 40\n255\n{rows}\n");
    room.write("zones.pgm", pgm);
    room.write(
        "zones.yaml",
        "image: zones.pgm\nresolution: 0.2\norigin: [0, 0, 0]\nnegate: 0\nmode: raw\n\
         occupied_thresh: 1.0\nfree_thresh: 0.0\n",
    );
    let zones = [
        "--vehicle",
        "car.json",
        "--speed-zones",
        "zones.yaml",
        "--json",
    ];
    let run = room.plan(&zones);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let top = run.json()["motion"]["certificate"]["max_speed_mps"]
        .as_f64()
        .unwrap();
    assert!((top - 0.4).abs() < 1e-6, "{top}");
}

#[test]
fn every_controller_drives_the_planned_times() {
    let room = room(&walker([6.0, 7.5, 0.0], [0.0, -0.25]));
    let run = room.plan(&[&CAR[..], &["--out", "plan.json"]].concat());
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let answer: Value = serde_json::from_str(&room.read("plan.json")).unwrap();
    let due_s = answer["motion"]["profile"]["duration_s"].as_f64().unwrap();
    for law in ["pure-pursuit", "stanley", "regulated-pure-pursuit", "mpc"] {
        let track = [
            "track",
            "plan.json",
            "--map",
            "room.yaml",
            "--vehicle",
            "car.json",
        ];
        let more = [
            "--speed-plan",
            "--controller",
            law,
            "--delay",
            "0.05",
            "--json",
        ];
        let run = room.run(&[&track[..], &more].concat());
        assert_eq!(run.code, 0, "{law}: {}{}", run.stdout, run.stderr);
        let driven = run.json();
        let summary = &driven["summary"];
        let (took_s, off_m) = (
            summary["duration_s"].as_f64().unwrap(),
            summary["max_cross_track_error_m"].as_f64().unwrap(),
        );
        assert!((took_s - due_s).abs() < 6.0, "{law}: {took_s} {due_s}");
        assert!(off_m < 0.15, "{law}: {off_m}");
        assert_eq!(summary.get("n_controller_failures"), None, "{law}");
    }
    let refused = [
        "track",
        "plan.json",
        "--map",
        "room.yaml",
        "--vehicle",
        "car.json",
        "--delay",
        "0.1",
    ];
    room.run(&refused)
        .assert_refused(&["--delay", "--speed-plan"]);
}
