//! Requests as users make them: several goals, via points, soft costs; by flags and by lines.

use crate::common::{Room, Run, formicar_in};
use serde_json::{Value, json};

/// Plans on the near side of the room's door, with more flags.
fn near(room: &Room, more: &[&str]) -> Run {
    let start = ["plan", "--map", "room.yaml", "--start", "2,2,0"];
    room.run(&[&start[..], more].concat())
}

#[test]
fn the_answer_says_which_goal_was_reached() {
    let room = Room::new();
    let goals = ["--goal", "10,2,-90deg", "--goal", "4.5,2,0"];
    let run = near(&room, &goals);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    run.assert_says("at goal 2 of 2");
    let picture = ["--json", "--out", "path.json", "--picture", "path.svg"];
    let answer = near(&room, &[&goals[..], &picture].concat()).json();
    assert_eq!(answer["certificate"]["goal_index"], 1);
    let request = &answer["provenance"]["request"];
    assert_eq!(request["goal"], Value::Null);
    assert_eq!(request["goals"][1], json!([4.5, 2.0, 0.0]));
    assert!(room.read("path.svg").contains("<svg"));
    let checked = room.run(&["check", "path.json", "--map", "room.yaml"]);
    assert_eq!(checked.code, 0, "{}{}", checked.stdout, checked.stderr);
}

#[test]
fn via_points_are_certified_and_judged_again_by_check() {
    let room = Room::new();
    let via = [
        "--via",
        "4.5,5,90deg",
        "--via",
        "3,6.5",
        "--goal",
        "2,4,180deg",
    ];
    let out = ["--out", "path.json", "--picture", "path.svg", "--json"];
    let run = near(&room, &[&via[..], &out].concat());
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let answer = run.json();
    let passed = answer["certificate"]["via_s_m"].as_array().unwrap();
    assert_eq!(passed.len(), 2);
    let record = &answer["provenance"]["request"]["via"];
    let tolerance = json!({"xy": 0.1, "yaw": 0.1});
    assert_eq!(record[1], json!({"at": [3.0, 6.5], "tolerance": tolerance}));
    assert!(room.read("path.svg").contains("via 2"));
    let check = ["check", "path.json", "--map", "room.yaml"];
    assert_eq!(room.run(&check).code, 0);
    // The same path, asked to pass its via points the other way round.
    let mut turned = answer;
    turned["provenance"]["request"]["via"]
        .as_array_mut()
        .unwrap()
        .reverse();
    room.write("path.json", turned.to_string());
    let run = room.run(&check);
    assert_eq!(run.code, 3, "{}", run.stdout);
    assert!(
        run.stdout
            .contains("via point 2 at (4.500, 5.000) after via point 1"),
        "{}",
        run.stdout
    );
}

#[test]
fn lines_name_goals_and_via_points_too() {
    let room = Room::new();
    let args = ["plan", "--map", "room.yaml", "--start", "2,2,0", "--stdin"];
    let lines = [
        r#"{"id": 1, "goals": [[10, 2, -1.5708], [4.5, 2, 0]]}"#,
        r#"{"id": 2, "goal": [4.5, 2, 0], "via": [{"at": [3, 6]}, {"at": [2, 4], "heading": -1.57, "tolerance": {"xy": 0.3, "yaw": 0.3}}]}"#,
        r#"{"id": 3, "goal": [4.5, 2, 0], "goals": [[4.5, 2, 0]]}"#,
        r#"{"id": 4, "goal": [4.5, 2, 0], "via": [{"at": [3, 60]}]}"#,
        r#"{"id": 5, "goal": [4.5, 2, 0], "via": [{"where": [3, 6]}]}"#,
    ];
    let run = formicar_in(room.folder.path(), &args, &lines.join("\n"));
    let answers: Vec<Value> = run
        .stdout
        .lines()
        .map(|l| serde_json::from_str(l).unwrap())
        .collect();
    let statuses: Vec<_> = answers
        .iter()
        .map(|a| a["status"].as_str().unwrap())
        .collect();
    let invalid = "invalid_request";
    assert_eq!(statuses, ["found", "found", invalid, invalid, invalid]);
    assert_eq!(answers[0]["certificate"]["goal_index"], 1);
    assert_eq!(
        answers[1]["certificate"]["via_s_m"]
            .as_array()
            .unwrap()
            .len(),
        2
    );
    let reason = |i: usize| answers[i]["reason"].as_str().unwrap();
    assert!(reason(2).contains("goal and goals"), "{}", reason(2));
    assert!(
        reason(3).contains("via point 1 (3.000, 60.000)"),
        "{}",
        reason(3)
    );
    assert!(reason(4).contains("where"), "{}", reason(4));
}

#[test]
fn soft_costs_come_from_the_map_or_from_a_file() {
    let room = Room::new();
    // A graded block in the way, on a map of its own; 255 is free, 128 half unwanted.
    let mut image = b"P5\n60 40\n255\n".to_vec();
    let unwanted = |col: usize, row: usize| (13..18).contains(&col) && row < 25;
    for row in (0..40).rev() {
        image.extend((0..60).map(|col| if unwanted(col, row) { 90 } else { 254 }));
    }
    room.write("soft.pgm", image);
    let yaml = room.read("room.yaml").replace("room.pgm", "soft.pgm");
    room.write(
        "soft.yaml",
        format!("{yaml}mode: scale\n").replace("0.65", "0.99"),
    );
    let goal = ["--goal", "4.5,2,0", "--json"];
    let straight = near(&room, &goal).json();
    let soft = ["--soft-costs", "soft.yaml", "--soft-weight", "100"];
    let around = near(&room, &[&goal[..], &soft].concat()).json();
    let length = |answer: &Value| answer["metrics"]["length_m"].as_f64().unwrap();
    assert!(length(&around) > length(&straight) + 0.5);
    let record = &around["provenance"]["map"]["soft_costs"];
    assert_eq!(record, &json!({"name": "soft.yaml", "weight": 100.0}));
    assert!(straight["provenance"]["map"].get("soft_costs").is_none());
    // A map without graded cells has no preference.
    let plain = near(&room, &[&goal[..], &["--soft-costs", "map"]].concat()).json();
    assert!((length(&plain) - length(&straight)).abs() < 0.05);
}

#[test]
fn bad_flags_are_refused_with_value_and_hint() {
    let room = Room::new();
    let refused = |more: &[&str], words: &[&str]| {
        let goal = ["--goal", "4.5,2,0"];
        near(&room, &[&goal[..], more].concat()).assert_refused(words);
    };
    refused(&["--via", "1"], &["--via", "X,Y"]);
    refused(&["--via", "1,nan"], &["--via", "nan"]);
    refused(&["--via", "1,2,3,4"], &["--via", "4 numbers"]);
    refused(
        &["--via", "6.1,2"],
        &["via point 1 (6.100, 2.000)", "nearest free pose"],
    );
    refused(&["--via", "-5,2"], &["via point 1", "outside the map"]);
    refused(&["--via-tolerance", "0.1,0.1"], &["--via"]);
    refused(&["--via", "3,3", "--via-tolerance", "0,1"], &["above 0"]);
    refused(&["--goal", "6.1,2"], &["--goal", "X,Y,HEADING"]);
    refused(
        &["--goal", "50,2,0"],
        &["goal (50.000, 2.000)", "outside the map"],
    );
    refused(
        &["--soft-costs", "gone.yaml"],
        &["--soft-costs", "gone.yaml"],
    );
    refused(&["--soft-weight", "2"], &["--soft-costs"]);
    refused(
        &["--soft-costs", "map", "--soft-weight", "-1"],
        &["at least 0"],
    );
    refused(
        &["--soft-costs", "map", "--soft-weight", "1e6"],
        &["1000000", "0 to 1000"],
    );
    let other = ["--soft-costs", "map", "--planner", "astar"];
    refused(
        &other,
        &["astar does not use soft costs", "--planner formicar"],
    );
}

#[test]
fn a_budget_that_ends_after_a_path_was_found_tells_what_did_not_fit() {
    let room = Room::new();
    let continuous = ["--continuous-curvature", "0.05", "--budget", "5000"];
    let run = room.run(&[&["plan", "--map", "warehouse"], &continuous[..]].concat());
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    for words in ["budget_exhausted", "found a path, but", "cut short"] {
        run.assert_says(words);
    }
}

#[test]
fn headings_that_nobody_can_turn_back_are_refused() {
    let room = Room::new();
    near(&room, &["--goal", "4.5,2,1e16"]).assert_refused(&["heading", "within a turn"]);
}

#[test]
fn cells_that_block_are_called_by_their_kind() {
    let room = Room::new();
    let yard = ["--map", "room.yaml", "--goal", "4,2,0"];
    let plan = |more: &[&str]| room.run(&[&["plan"], &yard[..], more].concat()).stderr;
    let wall = plan(&["--start", "6.1,2,0"]);
    assert!(
        wall.contains("obstacle cell") && !wall.contains("--unknown"),
        "{wall}"
    );
    let closed = plan(&[
        "--start",
        "2,2,0",
        "--keep-out",
        "1.5,1.5 2.5,1.5 2.5,2.5 1.5,2.5",
    ]);
    assert!(
        closed.contains("keep-out cells") && !closed.contains("obstacle"),
        "{closed}"
    );
    room.write(
        "u.pgm",
        [b"P5\n60 40\n255\n".as_slice(), &[205; 60 * 40]].concat(),
    );
    room.write(
        "u.yaml",
        room.read("room.yaml").replace("room.pgm", "u.pgm"),
    );
    let unknown = room.run(&[
        "plan", "--map", "u.yaml", "--start", "2,2,0", "--goal", "4,2,0",
    ]);
    assert!(
        unknown.stderr.contains("unknown cells"),
        "{}",
        unknown.stderr
    );
    assert!(
        unknown.stderr.contains("--unknown free"),
        "{}",
        unknown.stderr
    );
}

#[test]
fn headings_in_degrees_are_refused_with_the_radians_at_every_door() {
    let room = Room::new();
    let run = near(&room, &["--goal", "4.5,2,90"]);
    run.assert_refused(&["goal heading = 90", "1.5708"]);
    let lines = "{\"id\": 4, \"goal\": [4.5, 2, 180]}\n{\"id\": 5, \"goal\": [4.5, 2,}\n";
    let words = ["plan", "--map", "room.yaml", "--start", "2,2,0", "--stdin"];
    let run = formicar_in(room.folder.path(), &words, lines);
    let answers: Vec<Value> = run
        .stdout
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(
        (&answers[0]["id"], &answers[1]["id"]),
        (&json!(4), &json!(5))
    );
    let reason = answers[0]["reason"].as_str().unwrap();
    assert!(reason.contains("180 degrees are 3.1416"), "{reason}");
    room.write("room.yaml", room.read("room.yaml").replace("0.0]", "90]"));
    near(&room, &["--goal", "4.5,2,0"]).assert_refused(&["room.yaml", "yaw", "1.5708"]);
}
