//! `map build`, `map evaluate`, `locate`: a small log in the format of CARMEN.

use crate::common::Room;
use std::fmt::Write;

/// Scans of a room of 6 m x 4 m with a bay, from a robot that drives through it.
fn log() -> String {
    let mut text = String::new();
    for i in 0..30 {
        let x = 1.5 + 0.1 * f64::from(i);
        let _ = write!(text, "FLASER 180");
        for beam in 0..180 {
            let angle = f64::from(beam - 90).to_radians();
            let (dx, dy) = (angle.cos().max(1e-9), angle.sin());
            let wall_y = if dy > 0.0 { 2.0 } else { -2.0 };
            let to_side = wall_y / dy;
            // The bay: between x = 3 and x = 4 the left wall is a meter farther off.
            let at = x + to_side * dx;
            let side = if dy > 0.0 && (3.0..4.0).contains(&at) {
                3.0 / dy
            } else {
                to_side
            };
            let range = ((6.0 - x) / dx).min(if dy == 0.0 { 99.0 } else { side });
            let _ = write!(text, " {range:.2}");
        }
        let t = 0.2 * f64::from(i);
        let _ = writeln!(text, " {x} 0 0 {x} 0 0 {t} host {t}");
    }
    text
}

#[test]
fn a_log_becomes_a_map_that_is_judged_and_searched() {
    let room = Room::new();
    room.write("drive.log", log());
    let run = room.run(&[
        "map",
        "build",
        "drive.log",
        "--out",
        "new.yaml",
        "--trajectory",
        "t.csv",
        "--session",
        "new.session",
        "--report",
        "report",
    ]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    run.assert_says("30, ");
    let rows = room.read("t.csv");
    assert_eq!(rows.lines().count(), 31);
    assert!(
        rows.starts_with("scan,time_s,x_m,y_m,heading_rad\n0,0,"),
        "{rows}"
    );
    assert!(room.read("new.yaml").contains("free_thresh: 0.196"));
    for name in [
        "report/index.html",
        "report/map.svg",
        "report/map.png",
        "report/report.json",
    ] {
        assert!(room.path(name).exists(), "{name}");
    }
    let info = room.run(&["map", "info", "new.yaml", "--json"]).json();
    assert!(info["n_free"].as_u64().unwrap() > 3000, "{info}");
    is_searched(&room);
}

fn is_searched(room: &Room) {
    let run = room.run(&[
        "locate",
        "drive.log",
        "--map",
        "new.session",
        "--start",
        "0,0,0",
        "--trajectory",
        "l.csv",
    ]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    run.assert_says("lost        0");
    let last = room.read("l.csv").lines().last().unwrap().to_owned();
    let x: f64 = last.split(',').nth(2).unwrap().parse().unwrap();
    assert!((x - 2.9).abs() < 0.05, "{last}");
    let run = room.run(&[
        "map",
        "evaluate",
        "new.session",
        "drive.log",
        "--start",
        "0,0,0",
        "--json",
    ]);
    let found = run.json();
    assert!(
        found["beams"]["n_beams"].as_u64().unwrap() > 3000,
        "{found}"
    );
}

#[test]
fn bad_logs_and_names_are_refused_before_anything_is_written() {
    let room = Room::new();
    room.write("empty.log", "# nothing\n");
    let build = |log: &str, out: &str| room.run(&["map", "build", log, "--out", out]);
    build("empty.log", "a.yaml").assert_refused(&["no laser scan", "FLASER"]);
    build("missing.log", "a.yaml").assert_refused(&["missing.log"]);
    build("empty.log", "a.jpg").assert_refused(&["a.jpg", ".yaml"]);
    room.write("x.db3", "SQLite");
    build("x.db3", "a.yaml").assert_refused(&["x.db3", "MCAP"]);
    room.write("x.bag", "#ROSBAG V2.0");
    build("x.bag", "a.yaml").assert_refused(&["x.bag", "rosbags-convert --src x.bag --dst x"]);
    room.write("x.mcap", "\u{1}");
    build("x.mcap", "a.yaml").assert_refused(&["x.mcap", "MCAP"]);
    let flags = [
        "map",
        "build",
        "empty.log",
        "--out",
        "a.yaml",
        "--scan-topic",
        "/scan",
    ];
    room.run(&flags)
        .assert_refused(&["--scan-topic", "no topics"]);
    let jump = format!(
        "{}{}",
        log(),
        log().replace(" 0 0 ", " 90 0 ").lines().next().unwrap()
    );
    room.write("jump.log", jump);
    build("jump.log", "a.yaml").assert_refused(&["90.0 m", "--no-odometry"]);
    room.write("bad.session", "formicar-session 7 0\n");
    let run = room.run(&["locate", "empty.log", "--map", "bad.session"]);
    run.assert_refused(&["no laser scan"]);
    assert!(!room.path("a.yaml").exists());
}
