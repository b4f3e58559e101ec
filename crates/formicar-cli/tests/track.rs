//! `track`: drives in simulation, their files, words and exit codes.

use crate::common::{BARE_VEHICLE, Room, Run, formicar_in};
use serde_json::Value;

/// The room with a plan in it.
fn planned() -> Room {
    let room = Room::new();
    room.write("bare.toml", BARE_VEHICLE);
    let plan = room.plan(&["--vehicle", "bare.toml", "--out", "plan.json"]);
    assert_eq!(plan.code, 0, "{}", plan.stderr);
    room
}

fn track(room: &Room, more: &[&str]) -> Run {
    let track = ["track", "plan.json", "--map", "room.yaml"];
    let bare: &[&str] = if more.contains(&"--vehicle") {
        &[]
    } else {
        &["--vehicle", "bare.toml"]
    };
    room.run(&[&track[..], bare, more].concat())
}

#[test]
fn a_plan_is_driven_by_every_law() {
    let room = planned();
    for law in ["open-loop", "pure-pursuit", "stanley"] {
        let run = track(&room, &["--controller", law, "--json"]);
        assert_eq!(run.code, 0, "{law}: {}{}", run.stdout, run.stderr);
        let answer = run.json();
        assert_eq!(answer["schema"], "formicar/track/1");
        assert_eq!(
            (&answer["tracked"], &answer["status"]),
            (&true.into(), &"arrived".into())
        );
        assert_eq!(answer["config"]["controller"]["law"], law);
        assert_eq!(answer["config"]["speed_mps"], 0.3);
        assert!(answer["clearance"]["min_clearance_m"].as_f64().unwrap() > 0.0);
        assert_eq!(answer["clearance"]["contact"], Value::Null);
        let error_m = answer["summary"]["max_cross_track_error_m"]
            .as_f64()
            .unwrap();
        assert!(error_m < 0.1, "{law}: {error_m}");
    }
}

#[test]
fn a_preset_drives_at_its_pace_and_arcs_are_no_path_for_it() {
    let room = planned();
    let drive = |path: &str, more: &[&str]| {
        let track = [
            "track",
            path,
            "--map",
            "room.yaml",
            "--vehicle",
            "warehouse_amr",
        ];
        room.run(&[&track[..], more].concat())
    };
    let config = drive("plan.json", &["--json"]).json();
    assert_eq!(config["config"]["speed_mps"], 1.0);
    assert_eq!(config["config"]["max_steer_rate_rad_per_s"], 1.0);
    let lost = drive("plan.json", &["--give-up", "0.05"]);
    assert_eq!(lost.code, 3);
    lost.assert_says("--continuous-curvature");
    let plan = room.plan(&["--continuous-curvature", "--out", "smooth.json"]);
    assert_eq!(plan.code, 0, "{}", plan.stderr);
    let smooth = drive("smooth.json", &["--give-up", "0.05"]);
    assert_eq!(smooth.code, 0, "{}", smooth.stdout);
}

#[test]
fn open_loop_repeats_the_certificate() {
    let room = planned();
    let planned: Value = serde_json::from_str(&room.read("plan.json")).unwrap();
    let driven = track(&room, &["--controller", "open-loop", "--json"]).json();
    let number = |value: &Value| value.as_f64().unwrap();
    for (ours, theirs) in [
        (
            &driven["clearance"]["min_clearance_m"],
            &planned["certificate"]["min_clearance_m"],
        ),
        (
            &driven["summary"]["driven_m"],
            &planned["metrics"]["length_m"],
        ),
        (
            &driven["summary"]["max_steer_rad"],
            &planned["metrics"]["max_steer_rad"],
        ),
    ] {
        assert!(
            (number(ours) - number(theirs)).abs() < 1e-6,
            "{ours} {theirs}"
        );
    }
}

#[test]
fn five_lines_for_people() {
    let run = track(&planned(), &[]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let firsts: Vec<_> = run
        .stdout
        .lines()
        .map(|line| line.split_whitespace().next().unwrap())
        .collect();
    assert_eq!(firsts, ["tracked", "error", "goal", "wheels", "body"]);
    run.assert_says("by stanley (gain 1 1/s)");
    run.assert_says("of 40.0 deg");
}

#[test]
fn an_answer_comes_through_a_pipe_too() {
    let room = planned();
    let piped = "track - --map room.yaml --vehicle bare.toml --json";
    let piped: Vec<_> = piped.split(' ').collect();
    let run = formicar_in(room.folder.path(), &piped, &room.read("plan.json"));
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(run.stdout, track(&room, &["--json"]).stdout);
    let check = ["check", "-", "--map", "room.yaml"];
    let run = formicar_in(room.folder.path(), &check, &room.read("plan.json"));
    assert_eq!(run.code, 0, "{}", run.stderr);
}

#[test]
fn paths_from_elsewhere_are_driven_too() {
    let room = Room::new();
    room.write("line.csv", "x,y,heading\n2,3,0\n3,3,0\n4,3,0\n");
    let run = room.run(&["track", "line.csv", "--map", "room.yaml", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let summary = &run.json()["summary"];
    assert!(
        (summary["driven_m"].as_f64().unwrap() - 2.0).abs() < 1e-3,
        "{summary}"
    );
}

#[test]
fn a_collision_is_exit_3_with_its_place() {
    let room = Room::new();
    room.write("line.csv", "x,y,heading\n2,3,0\n4,3,0\n");
    let posts = ["--keep-out", "4.25,3.45 4.35,3.45 4.35,3.55"];
    let command = [
        "track",
        "line.csv",
        "--map",
        "room.yaml",
        "--controller",
        "open-loop",
    ];
    let beside = |offset: &str, more: &[&str]| {
        room.run(&[&command[..], &posts, &["--offset", offset], more].concat())
    };
    assert_eq!(beside("-0.1", &[]).code, 0);
    let run = beside("0.2", &["--json"]);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    let answer = run.json();
    assert_eq!(
        (&answer["tracked"], &answer["status"]),
        (&false.into(), &"arrived".into())
    );
    let contact = &answer["clearance"]["contact"];
    // The front is 0.775 m ahead of the rear axle, the post's cell begins at 4.2 m.
    assert_eq!(contact["kind"], "collision");
    assert!(
        (contact["driven_m"].as_f64().unwrap() - 1.425).abs() < 1e-4,
        "{contact}"
    );
    let run = beside("0.2", &[]);
    assert!(run.stdout.starts_with("collides "), "{}", run.stdout);
    run.assert_says("an obstacle after 1.42 m");
    run.assert_says("touches at 1 place");
}

#[test]
fn a_path_that_is_left_is_exit_3() {
    let room = planned();
    let slow = [
        "--controller",
        "open-loop",
        "--steer-rate",
        "1deg",
        "--give-up",
        "0.3",
    ];
    let run = track(&room, &slow);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    run.assert_says("left_path ");
    run.assert_says("the limit is 0.3 m");
}

#[test]
fn a_path_for_another_vehicle_is_told() {
    let run = track(&planned(), &["--vehicle", "sedan"]);
    assert_eq!(run.code, 3);
    run.assert_says("not valid to begin with");
}

#[test]
fn writes_trace_and_pictures() {
    let room = planned();
    let files = ["--csv", "trace.csv", "--picture", "drive.svg"];
    assert_eq!(track(&room, &files).code, 0);
    assert_eq!(track(&room, &["--picture", "drive.png"]).code, 0);
    let answer = track(&room, &["--json"]).json();
    let trace = room.read("trace.csv");
    assert!(trace.starts_with("t_s,driven_m,s_m,x,y,heading,direction,steer_rad,"));
    let n_points = answer["trace"].as_array().unwrap().len();
    assert_eq!(trace.lines().count(), n_points + 1);
    let svg = room.read("drive.svg");
    for words in [
        "left wheel",
        "right wheel",
        "planned",
        "cross-track error",
        "heading error",
    ] {
        assert!(svg.contains(&format!("\"{words}\"")), "{words}");
    }
    assert_eq!(
        room.files(),
        [
            "bare.toml",
            "drive.png",
            "drive.svg",
            "plan.json",
            "room.pgm",
            "room.yaml",
            "trace.csv"
        ]
    );
}

#[test]
fn flags_become_parameters() {
    let flags = [
        "--controller=pure-pursuit",
        "--lookahead=0.9",
        "--speed=1.5",
        "--steer-rate=90deg",
        "--offset=-0.1,2deg,0.05",
        "--time-step=0.01",
        "--record=0.5",
        "--give-up=1",
        "--json",
    ];
    let config = track(&planned(), &flags).json()["config"].take();
    let law = serde_json::json!({"law": "pure-pursuit", "lookahead_m": 0.9});
    assert_eq!(config["controller"], law);
    let number = |key: &str| config[key].as_f64().unwrap();
    assert_eq!((number("speed_mps"), number("time_step_s")), (1.5, 0.01));
    assert_eq!(
        (number("record_interval_s"), number("give_up_error_m")),
        (0.5, 1.0)
    );
    assert!((number("max_steer_rate_rad_per_s") - 90_f64.to_radians()).abs() < 1e-12);
    assert_eq!(config["start_offset"]["lateral_m"], -0.1);
    assert_eq!(config["start_offset"]["along_m"], 0.05);
}

#[test]
fn a_drive_repeats_itself() {
    let room = planned();
    let run = || track(&room, &["--offset", "0.05,3deg", "--json"]).stdout;
    assert_eq!(run(), run());
}

#[test]
fn what_makes_no_sense_is_refused() {
    let room = planned();
    let cases: [(&[&str], &[&str]); 13] = [
        (&["--controller", "ants"], &["--controller", "stanley"]),
        (
            &["--lookahead", "1"],
            &["--lookahead", "stanley has no such", "pure-pursuit"],
        ),
        (
            &["--gain", "1", "--controller", "open-loop"],
            &["--gain", "hint"],
        ),
        (&["--gain", "1000"], &["gain_per_s", "1000", "0.01 to 100"]),
        (&["--speed", "0"], &["--speed", "above 0"]),
        (&["--speed", "1000"], &["speed_mps", "1000", "0.001 to 100"]),
        (
            &["--time-step", "1", "--speed", "5"],
            &["time_step_s", "at most"],
        ),
        (&["--offset", "1,2,3,4"], &["--offset", "LEFT"]),
        (&["--offset", "5"], &["lateral_m", "give_up_error_m"]),
        (&["--steer-rate", "-1"], &["--steer-rate"]),
        (&["--vehicle", "point"], &["point"]),
        (&["--csv", "trace.txt"], &["trace.txt", ".csv"]),
        (
            &["--picture", "gone/drive.svg"],
            &["gone", "does not exist"],
        ),
    ];
    for (flags, words) in cases {
        track(&room, flags).assert_refused(words);
    }
    assert_eq!(
        room.files(),
        ["bare.toml", "plan.json", "room.pgm", "room.yaml"]
    );
}

#[test]
fn paths_that_are_none_are_refused() {
    let room = planned();
    let track = |path: &str| room.run(&["track", path, "--map", "room.yaml"]);
    track("gone.json").assert_refused(&["gone.json"]);
    room.write("bad.json", "{}");
    track("bad.json").assert_refused(&["bad.json", "schema"]);
    let mut torn: Value = serde_json::from_str(&room.read("plan.json")).unwrap();
    torn["path"]["segments"][1]["x"] = 99.0.into();
    room.write("torn.json", torn.to_string());
    track("torn.json").assert_refused(&["torn.json", "jumps", "segment 1"]);
    room.run(&["track", "plan.json"]).assert_refused(&["--map"]);
}
