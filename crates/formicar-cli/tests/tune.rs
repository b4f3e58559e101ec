//! `tune`: a configuration that `plan` takes, the same after a kill, refusals.

use crate::common::{Room, Run};
use std::process::{Command, Stdio};

const FLAGS: [&str; 21] = [
    "tune",
    "narrow-junction",
    "perpendicular-parking",
    "--parameter",
    "drive.beta",
    "--parameter",
    "improve.shift_share",
    "--range",
    "improve.shift_share=0..5",
    "--evaluations",
    "12",
    "--sources",
    "4",
    "--seeds",
    "1",
    "--check-seeds",
    "2",
    "--hold-back",
    "0.5",
    "--budget",
    "500",
];

fn tune(room: &Room, more: &[&str]) -> Run {
    room.run(&[&FLAGS[..], more].concat())
}

#[test]
fn what_was_tuned_is_a_configuration_for_plan() {
    let room = Room::new();
    let run = tune(&room, &["--out", "out", "--jobs", "2"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    for part in [
        "# Tuning of formicar",
        "| `drive.beta` | 8.000 |",
        "12 evaluations in",
        "## Held back: default against tuned",
        "| runs that found a path |",
    ] {
        assert!(run.stdout.contains(part), "no {part:?} in {}", run.stdout);
    }
    let config = room.read("out/tuned.toml");
    let (mark, values) = config.split_once('\n').unwrap();
    assert!(mark.starts_with("# Found by formicar tune"), "{config}");
    assert!(values.starts_with("planner = \"formicar\"\n"), "{config}");
    let n_values = config.lines().filter(|line| line.contains(" = ")).count();
    assert_eq!(n_values, 3, "{config}");
    let plan = [
        "plan",
        "--map",
        "narrow-junction",
        "--budget",
        "2000",
        "--json",
    ];
    let plan = room.run(&[&plan[..], &["--config", "out/tuned.toml"]].concat());
    assert!([0, 3].contains(&plan.code), "{}", plan.stderr);
    for name in [
        "convergence.svg",
        "index.html",
        "summary.md",
        "cycles.csv",
        "runs.csv",
    ] {
        assert!(room.read(&format!("out/{name}")).len() > 100, "{name}");
    }
}

#[test]
fn a_killed_tuning_comes_to_the_same_result() {
    let room = Room::new();
    assert_eq!(tune(&room, &["--out", "whole"]).code, 0);
    let mut child = Command::new(env!("CARGO_BIN_EXE_formicar"))
        .args(FLAGS)
        .args(["--out", "torn"])
        .current_dir(room.folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let state = room.path("torn/state.json");
    while !state.exists() && child.try_wait().unwrap().is_none() {
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let run = tune(&room, &["--out", "torn"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    for name in [
        "state.json",
        "tuned.toml",
        "runs.csv",
        "cycles.csv",
        "summary.md",
    ] {
        let [whole, torn] = ["whole", "torn"].map(|out| room.read(&format!("{out}/{name}")));
        assert_eq!(whole, torn, "{name}");
    }
}

#[test]
fn what_cannot_be_tuned_is_refused() {
    let room = Room::new();
    let refused = |more: &[&str], words: &[&str]| {
        let run = room.run(&[&["tune", "narrow-junction", "--out", "out"], more].concat());
        run.assert_refused(words);
    };
    refused(&["--parameter", "drive.bta"], &["drive.bta", "drive.beta"]);
    refused(&["--group", "chords"], &["chords", "drive"]);
    refused(&["--range", "drive.beta"], &["KEY=LOW..HIGH"]);
    refused(
        &["--parameter", "drive.beta", "--range", "drive.beta=9..4"],
        &["drive.beta", "above 9"],
    );
    refused(
        &["--parameter", "drive.beta", "--range", "drive.beta=0..4"],
        &["drive.beta = 8", "--range around it"],
    );
    refused(&["--evaluations", "5"], &["max_evaluations = 5", "10 to"]);
    refused(&["--hold-back", "1"], &["--hold-back 1", "below 1"]);
    refused(
        &["--held-back", "narrow-junction"],
        &["tuned on and held back"],
    );
    refused(
        &["--planner", "faco2024", "--parameter", "chords.alpha"],
        &["chords.alpha"],
    );
    room.run(&["tune", "nowhere", "--out", "out"])
        .assert_refused(&["nowhere", "narrow-junction"]);
    room.run(&["tune", "missing.json", "--out", "out"])
        .assert_refused(&["missing.json"]);
    let of_point = [
        "tune",
        "wang-open",
        "--group",
        "drive.trails",
        "--out",
        "out",
    ];
    room.run(&of_point)
        .assert_refused(&["wang-open-", "formicar cannot be asked this", "a point"]);
    assert!(!room.path("out").exists());

    assert_eq!(tune(&room, &["--out", "mine"]).code, 0);
    let run = tune(&room, &["--out", "mine", "--seed", "1"]);
    run.assert_refused(&["state.json", "another tuning", "another --out"]);
    room.write("mine/state.json", "{}");
    tune(&room, &["--out", "mine"]).assert_refused(&["state.json", "subject"]);
}
