//! `check`: the judge on answers and on foreign paths.

use crate::common::Room;
use serde_json::{Value, json};

#[test]
fn an_answer_is_confirmed_with_its_hashes() {
    let room = Room::new();
    assert_eq!(room.plan(&["--out", "path.json"]).code, 0);
    let run = room.run(&["check", "path.json", "--map", "room.yaml", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let checked = run.json();
    let planned: Value = serde_json::from_str(&room.read("path.json")).unwrap();
    assert_eq!(checked["certificate"], planned["certificate"]);
    let all_match = json!({"map": true, "vehicle": true, "path": true, "numbers": true});
    assert_eq!(checked["matches_record"], all_match);
}

#[test]
fn a_tampered_answer_is_told() {
    let room = Room::new();
    assert_eq!(room.plan(&["--out", "path.json"]).code, 0);
    let planned: Value = serde_json::from_str(&room.read("path.json")).unwrap();
    let check = |changed: &Value| {
        room.write("tampered.json", changed.to_string());
        room.run(&["check", "tampered.json", "--map", "room.yaml"])
    };
    let mut claim = planned.clone();
    claim["certificate"]["min_clearance_m"] = json!(5.0);
    let run = check(&claim);
    assert!(run.stdout.contains("numbers are not"), "{}", run.stdout);
    let mut moved = planned;
    moved["path"]["poses"][1]["y"] = json!(0.1);
    let run = check(&moved);
    assert_eq!(run.code, 3, "{}", run.stdout);
    assert!(run.stdout.contains("poses on record"), "{}", run.stdout);
}

#[test]
fn our_poses_alone_are_valid_too() {
    let room = Room::new();
    assert_eq!(room.plan(&["--out", "path.csv"]).code, 0);
    let poses = room.read("path.csv");
    let points: String = poses
        .lines()
        .map(|line| line.splitn(3, ',').take(2).collect::<Vec<_>>().join(",") + "\n")
        .collect();
    room.write("points.csv", points);
    for (name, source) in [("path.csv", "poses"), ("points.csv", "points")] {
        let run = room.run(&["check", name, "--map", "room.yaml", "--json"]);
        assert_eq!(run.code, 0, "{name}: {}{}", run.stdout, run.stderr);
        let checked = run.json();
        assert_eq!(checked["source"], source);
        assert_eq!(checked["curvature_slack"], 0.05);
    }
}

#[test]
fn what_cannot_be_driven_is_exit_3_with_every_reason() {
    let room = Room::new();
    room.write("wall.csv", "x,y\n2,2\n5,2\n8,2\n");
    let run = room.run(&["check", "wall.csv", "--map", "room.yaml"]);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.starts_with("invalid"), "{}", run.stdout);
    assert!(run.stdout.contains("5 % of slack") && run.stdout.contains("violation"));
    room.write("corner.csv", "2,2\n3,2\n3,3\n3,4\n");
    let run = room.run(&["check", "corner.csv", "--map", "room.yaml", "--json"]);
    assert_eq!(run.code, 3, "{}", run.stdout);
    assert_eq!(
        run.json()["certificate"]["violations"][0]["kind"],
        "curvature"
    );
}

#[test]
fn points_are_driven_in_either_gear() {
    let room = Room::new();
    // The nose would reach into the wall on the right; the rear is short.
    room.write("back.csv", "x,y\n4,3\n4.5,3\n5.2,3\n5.7,3\n");
    let run = room.run(&["check", "back.csv", "--map", "room.yaml", "--json"]);
    assert_eq!(run.code, 0, "{}", run.stdout);
    assert_eq!(run.json()["first_gear"], -1);
}

#[test]
fn another_map_or_vehicle_than_certified_is_told() {
    let room = Room::new();
    assert_eq!(room.plan(&["--out", "path.json"]).code, 0);
    let others = ["--margin", "0.01", "--keep-out", "1,7 1.2,7 1.2,7.2"];
    let check = ["check", "path.json", "--map", "room.yaml"];
    let run = room.run(&[&check[..], &others].concat());
    assert!(
        run.stdout.contains("another map and vehicle"),
        "{}",
        run.stdout
    );
}

#[test]
fn a_tampered_path_is_not_believed() {
    let room = Room::new();
    assert_eq!(room.plan(&["--out", "path.json"]).code, 0);
    let mut answer: Value = serde_json::from_str(&room.read("path.json")).unwrap();
    answer["path"]["segments"][0]["curvature"] = json!(9.0);
    room.write("path.json", answer.to_string());
    let run = room.run(&["check", "path.json", "--map", "room.yaml"]);
    assert_eq!(run.code, 3, "{}", run.stdout);
    assert!(run.stdout.contains("another path"), "{}", run.stdout);
}

#[test]
fn files_that_are_no_paths_are_refused() {
    let room = Room::new();
    let cases = [
        ("{}", "schema"),
        (
            "{\"schema\": \"formicar/answer/9\", \"status\": \"found\"}",
            "formicar/answer/1",
        ),
        (
            "{\"schema\": \"formicar/answer/1\", \"status\": \"no_path\"}",
            "no_path",
        ),
        ("", "no rows"),
        ("x,y\n1,nan\n", "line 2"),
        ("x,y\n1,2\n1\n", "line 3"),
        ("a,b\n1,2\n", "no column x"),
        ("\u{0}\u{1}\u{2}", "bad"),
    ];
    for (text, word) in cases {
        room.write("bad", text);
        room.run(&["check", "bad", "--map", "room.yaml"])
            .assert_refused(&["bad", word]);
    }
    room.run(&["check", "gone.csv", "--map", "room.yaml"])
        .assert_refused(&["gone.csv"]);
    room.write("bytes", [0xff_u8, 0xfe, 0x00]);
    room.run(&["check", "bytes", "--map", "room.yaml"])
        .assert_refused(&["bytes"]);
}

/// A straight drive along y = 4, with a header and a line for each x.
fn along(header: &str, row: impl Fn(f64) -> String) -> String {
    let rows = (0..7).map(|i| row(2.0 + 0.4 * f64::from(i)) + "\n");
    format!("{header}\n{}", rows.collect::<String>())
}

#[test]
fn headers_are_read_as_tools_write_them() {
    let room = Room::new();
    let cases = [
        // A race line as `numpy.savetxt` writes it, its heading from the y axis.
        (
            along("# s_m; x_m; y_m; psi_rad; kappa_radpm", |x| {
                format!("{:.4}; {x:.4}; 4.0000; -1.5708; 0.0000", x - 2.0)
            }),
            "psi_rad, in radians from the y axis",
        ),
        (
            along("# x_m, y_m, w_tr_right_m, w_tr_left_m", |x| {
                format!("{x}, 4.0, 1.1, 1.1")
            }),
            "x_m and y_m, no headings",
        ),
        (
            along("x,y,z,qx,qy,qz,qw", |x| format!("{x},4,0,0,0,0,1")),
            "quaternion",
        ),
        (
            along("x,y,heading_deg", |x| format!("{x},4,720")),
            "heading_deg, in degrees",
        ),
        (
            along("", |x| format!("{x},4,6.2831853")),
            "first three columns",
        ),
    ];
    for (text, told) in cases {
        room.write("theirs.csv", &text);
        let run = room.run(&["check", "theirs.csv", "--map", "room.yaml"]);
        assert_eq!(run.code, 0, "{text}{}{}", run.stdout, run.stderr);
        assert!(run.stdout.contains(told), "{told}: {}", run.stdout);
        let json = room.run(&["check", "theirs.csv", "--map", "room.yaml", "--json"]);
        assert!(json.json()["reading"].as_str().unwrap().contains(told));
    }
}

#[test]
fn many_violations_are_summarized_unless_all_are_asked_for() {
    let room = Room::new();
    // Headings in degrees, read as radians: every curve is far too sharp.
    room.write("jumps.csv", along("x,y,yaw", |y| format!("4,{y},90")));
    let run = room.run(&["check", "jumps.csv", "--map", "room.yaml"]);
    assert_eq!(run.code, 3, "{}", run.stdout);
    let count = |text: &str| text.lines().filter(|l| l.starts_with("violation")).count();
    assert!(run.stdout.contains(" times; first: "), "{}", run.stdout);
    assert!(run.stdout.contains("worst: "), "{}", run.stdout);
    assert!(run.stdout.contains("--all prints all"), "{}", run.stdout);
    assert!(count(&run.stdout) <= 3, "{}", run.stdout);
    assert!(
        run.stdout.contains("hint       the headings follow"),
        "{}",
        run.stdout
    );
    let all = room.run(&["check", "jumps.csv", "--map", "room.yaml", "--all"]);
    assert!(count(&all.stdout) > 4, "{}", all.stdout);
}

#[test]
fn what_import_reads_check_reads() {
    let room = Room::new();
    let pose = |x: f64| {
        format!(r#"{{"position": {{"x": {x}, "y": 4}}, "orientation": {{"z": 0, "w": 1}}}}"#)
    };
    let stamped = |x: f64| format!(r#"{{"header": {{}}, "pose": {}}}"#, pose(x));
    let path = format!(r#"{{"poses": [{}, {}]}}"#, stamped(2.0), stamped(5.0));
    let array = format!(r#"{{"poses": [{}, {}]}}"#, pose(2.0), pose(5.0));
    let echo = "header:\n  frame_id: map\nposes:\n- pose:\n    position: {x: 2.0, y: 4.0, z: 0.0}\n    \
                orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}\n- pose:\n    position: {x: 5.0, y: 4.0, \
                z: 0.0}\n    orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}\n---\n";
    for (name, text) in [
        ("path.json", path.as_str()),
        ("array.json", array.as_str()),
        ("echo.yaml", echo),
    ] {
        room.write(name, text);
        let run = room.run(&["check", name, "--map", "room.yaml", "--json"]);
        assert_eq!(run.code, 0, "{name}: {}{}", run.stdout, run.stderr);
        let checked = run.json();
        assert_eq!(
            (&checked["source"], &checked["length_m"]),
            (&json!("poses"), &json!(3.0))
        );
    }
}

#[test]
fn an_answer_that_lost_the_signs_of_zeros_is_of_the_same_path() {
    let room = Room::new();
    assert_eq!(room.plan(&["--out", "path.json"]).code, 0);
    let text = room.read("path.json");
    // As JavaScript writes it.
    room.write(
        "path.json",
        text.replace(":-0.0,", ":0,").replace(":0.0,", ":0,"),
    );
    let run = room.run(&["check", "path.json", "--map", "room.yaml", "--json"]);
    assert_eq!(run.json()["matches_record"]["path"], true, "{}", run.stdout);
}
