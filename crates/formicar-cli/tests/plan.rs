//! `plan`: answers, files, statuses and exit codes.

use crate::common::{BARE_VEHICLE, Room, formicar_in};
use serde_json::{Value, json};

fn keys(object: &Value) -> Vec<&str> {
    object
        .as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

#[test]
fn the_answer_has_the_promised_fields() {
    let answer = Room::new().plan(&["--json", "--seed", "7"]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let answer = answer.json();
    assert_eq!(answer["schema"], "formicar/answer/1");
    assert_eq!(answer["status"], "found");
    assert_eq!(
        (&answer["code"], &answer["code_number"]),
        (&json!("NONE"), &json!(0))
    );
    assert_eq!(answer["reason"], Value::Null);
    assert_eq!(
        (&answer["planner"], &answer["seed"]),
        (&json!("formicar"), &json!(7))
    );
    let certificate = &answer["certificate"];
    assert_eq!(certificate["valid"], true);
    for key in [
        "min_clearance_m",
        "max_curvature_per_m",
        "goal_error_m",
        "goal_error_rad",
    ] {
        assert!(certificate[key].as_f64().unwrap() >= 0.0, "{key}");
    }
    assert_eq!(certificate["violations"], json!([]));
    for key in ["map_hash", "vehicle_hash", "path_hash"] {
        assert_eq!(certificate[key].as_str().unwrap().len(), 32, "{key}");
    }
    let timing = ["first_feasible_s", "map_setup_s", "query_s", "total_s"];
    assert_eq!(keys(&answer["timing"]), timing);
    assert!(answer["timing"]["first_feasible_s"].is_f64());
    assert!(answer["metrics"]["length_m"].as_f64().unwrap() > 8.0);
    let of_pose = [
        "clearance",
        "curvature",
        "direction",
        "heading",
        "s",
        "speed",
        "steer",
        "time",
        "x",
        "y",
    ];
    assert_eq!(keys(&answer["path"]["poses"][0]), of_pose);
    let of_segment = ["curvature", "direction", "heading", "length", "x", "y"];
    assert_eq!(keys(&answer["path"]["segments"][0]), of_segment);
    assert_eq!(answer["provenance"]["request"]["goal"][0], 10.0);
}

#[test]
fn poses_are_dense_and_follow_their_segments() {
    let answer = Room::new().plan(&["--json"]).json();
    let number = |value: &Value, key: &str| value[key].as_f64().unwrap();
    let poses = answer["path"]["poses"].as_array().unwrap();
    for w in poses.windows(2) {
        assert!(number(&w[1], "s") - number(&w[0], "s") <= 0.1 + 1e-9);
    }
    let last = poses.last().unwrap();
    let segments = answer["path"]["segments"].as_array().unwrap();
    let length_m: f64 = segments
        .iter()
        .map(|segment| number(segment, "length"))
        .sum();
    assert!((number(last, "s") - length_m).abs() < 1e-9);
    assert!((number(last, "x") - 10.0).hypot(number(last, "y") - 2.0) <= 0.01);
    for pose in poses {
        let steer = (0.65 * number(pose, "curvature")).atan();
        assert!((number(pose, "steer") - steer).abs() < 1e-12);
        let least = number(&answer["certificate"], "min_clearance_m");
        assert!(number(pose, "clearance") >= least - 1e-9);
    }
}

#[test]
fn runs_differ_in_their_timing_alone() {
    let room = Room::new();
    let [one, two] = ["1", "2"].map(|n_threads| {
        let mut answer = room.plan(&["--json", "--threads", n_threads]).json();
        answer["timing"] = Value::Null;
        answer
    });
    assert_eq!(one, two);
}

#[test]
fn a_few_calm_lines_for_people() {
    let run = Room::new().plan(&[]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let lines: Vec<_> = run.stdout.lines().collect();
    assert_eq!(lines.len(), 4, "{}", run.stdout);
    assert!(
        lines[0].starts_with("found ") && lines[0].contains("of 1.29 1/m"),
        "{}",
        lines[0]
    );
    assert!(lines[1].starts_with("driven     in "), "{}", lines[1]);
    assert!(
        lines[2].starts_with("note       the curvature jumps at ") && lines[2].contains("hint"),
        "{}",
        lines[2]
    );
    assert!(
        lines[3].starts_with("certified ") && lines[3].contains("poses"),
        "{}",
        lines[3]
    );
    assert!(!run.stdout.contains('\u{1b}'));
}

#[test]
fn writes_answer_poses_and_picture() {
    let room = Room::new();
    let files = [
        "--out",
        "path.json",
        "--out",
        "path.csv",
        "--picture",
        "path.svg",
    ];
    assert_eq!(room.plan(&files).code, 0);
    let answer: Value = serde_json::from_str(&room.read("path.json")).unwrap();
    let csv = room.read("path.csv");
    let n_poses = answer["path"]["poses"].as_array().unwrap().len();
    assert_eq!(csv.lines().count(), n_poses + 1);
    assert!(csv.starts_with("x,y,heading,s,direction,curvature,steer,clearance,speed,time\n"));
    assert!(room.read("path.svg").contains("<svg"));
    assert_eq!(
        room.files(),
        ["path.csv", "path.json", "path.svg", "room.pgm", "room.yaml"]
    );
}

#[test]
fn start_equal_to_goal_is_found_with_length_0() {
    let answer = Room::new().run(&[
        "plan",
        "--map",
        "room.yaml",
        "--start",
        "2,2,0",
        "--goal",
        "2,2,0",
        "--json",
    ]);
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    assert_eq!(answer.json()["metrics"]["length_m"], 0.0);
}

#[test]
fn a_closed_door_is_exit_3_with_a_reason() {
    let room = Room::new();
    let door = ["--keep-out", "6,5 6.2,5 6.2,8 6,8"];
    let run = room.plan(&[&door[..], &["--out", "no.csv", "--json"]].concat());
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    let answer = run.json();
    assert_eq!(
        (&answer["status"], &answer["code"]),
        (&json!("no_path"), &json!("NO_VALID_PATH"))
    );
    assert!(answer["reason"].as_str().unwrap().len() > 10);
    assert_eq!(answer["path"], Value::Null);
    assert!(
        run.stderr.contains("no.csv is not written"),
        "{}",
        run.stderr
    );
    assert_eq!(room.files(), ["room.pgm", "room.yaml"]);
}

#[test]
fn a_spent_budget_says_so() {
    let run = Room::new().plan(&["--budget", "1", "--json"]);
    assert_eq!(run.code, 3);
    assert_eq!(run.json()["status"], "budget_exhausted");
}

#[test]
fn ends_outside_or_occupied_are_the_callers_fault_with_nav2_codes() {
    let room = Room::new();
    let cases = [
        ("--start", "-5,2,0", "START_OUTSIDE_MAP", 203),
        ("--goal", "50,2,0", "GOAL_OUTSIDE_MAP", 204),
        ("--start", "6.1,2,0", "START_OCCUPIED", 205),
        ("--goal", "6.1,2,0", "GOAL_OCCUPIED", 206),
    ];
    for (flag, pose, code, number) in cases {
        let other = if flag == "--start" {
            "--goal"
        } else {
            "--start"
        };
        let ends = ["plan", "--map", "room.yaml", flag, pose, other, "3,3,0"];
        let run = room.run(&[&ends[..], &["--json", "--out", "no.json"]].concat());
        assert_eq!(run.code, 2, "{}", run.stdout);
        let answer = run.json();
        assert_eq!(answer["status"], "invalid_request");
        assert_eq!(
            (&answer["code"], &answer["code_number"]),
            (&json!(code), &json!(number))
        );
        room.run(&ends)
            .assert_refused(&[flag.trim_start_matches('-'), "m"]);
    }
    assert_eq!(room.files(), ["room.pgm", "room.yaml"]);
}

#[test]
fn built_in_maps_bring_start_goal_and_vehicle() {
    let run = Room::new().run(&["plan", "--map", "warehouse", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    assert_eq!(run.json()["provenance"]["map"]["name"], "warehouse");
}

#[test]
fn grid_problems_are_planned_for_points() {
    let answer = Room::new()
        .run(&["plan", "--map", "aco20", "--json"])
        .json();
    assert_eq!(
        (&answer["status"], &answer["planner"]),
        (&json!("found"), &json!("astar"))
    );
}

#[test]
fn vehicles_come_from_toml_and_json() {
    let room = Room::new();
    let toml = "wheelbase_m = 0.5\nwidth_m = 0.5\nfront_overhang_m = 0.1\nrear_overhang_m = 0.1\n\
                max_steer_deg = 35\n";
    room.write("cart.toml", toml);
    room.write(
        "cart.json",
        r#"{"footprint": "[[0.6,0.25],[-0.1,0.25],[-0.1,-0.25],[0.6,-0.25]]", "min_turning_radius": 0.8}"#,
    );
    assert_eq!(room.plan(&["--vehicle", "cart.toml"]).code, 0);
    let answer = room
        .plan(&["--vehicle", "cart.json", "--margin", "0.02", "--json"])
        .json();
    assert_eq!(answer["status"], "found");
    assert_eq!(answer["path"]["poses"][0]["steer"], Value::Null);
    assert_eq!(
        answer["provenance"]["vehicle"]["parameters"]["safety_margin_m"],
        0.02
    );
}

#[test]
fn parameters_come_from_file_and_flags() {
    let room = Room::new();
    room.write(
        "planner.toml",
        "[hybrid_astar]\nweight = 2.0\nchange_penalty = 0.5\n",
    );
    let flags = [
        "--config",
        "planner.toml",
        "--set",
        "hybrid_astar.weight=1.2",
        "--json",
    ];
    let config = room.plan(&flags).json()["provenance"]["config"]["hybrid_astar"].clone();
    assert_eq!(
        (&config["weight"], &config["change_penalty"]),
        (&json!(1.2), &json!(0.5))
    );
}

#[test]
fn scenario_files_are_planned_by_id() {
    let room = Room::new();
    room.write(
        "cars.json",
        r#"{"version": 1, "frame": "map", "scenarios": [
            {"id": "a", "map": "room.yaml", "resolution": 0.2, "start": [2, 2, 0], "goal": [4, 5, 1],
             "vehicle": {"wheelbase": 0.65, "max_steer_deg": 40, "width": 0.62,
                         "front_overhang": 0.125, "rear_overhang": 0.125}},
            {"id": "b", "map": "room.yaml", "resolution": 0.2, "start": [2, 2, 0], "goal": [3, 4, 1],
             "vehicle": {"wheelbase": 0.65, "max_steer_deg": 40, "width": 0.62,
                         "front_overhang": 0.125, "rear_overhang": 0.125}}]}"#,
    );
    let run = room.run(&["plan", "--scenario", "cars.json", "--id", "b", "--json"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    assert_eq!(
        run.json()["provenance"]["request"]["goal"],
        json!([3.0, 4.0, 1.0])
    );
    room.run(&["plan", "--scenario", "cars.json"])
        .assert_refused(&["--id", "a", "b"]);
    room.run(&["plan", "--scenario", "cars.json", "--id", "c"])
        .assert_refused(&["\"c\"", "a, b"]);
}

#[test]
fn a_warm_planner_answers_line_by_line() {
    let room = Room::new();
    let lines = r#"{"id": 1, "goal": [4, 5, 1]}

{"id": "two", "start": [2, 2, 0], "goal": [6.1, 2, 0]}
nonsense
{"goal": [4, 5, 1], "deadline": 3}
{"id": {"n": 5}, "goal": [4, 5, 1], "seed": 3, "motion": "forward", "budget_steps": 1000000}
{"id": 6}
"#;
    let args = ["plan", "--map", "room.yaml", "--start", "2,2,0", "--stdin"];
    let run = formicar_in(room.folder.path(), &args, lines);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let answers: Vec<Value> = run
        .stdout
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let of = |key: &str| answers.iter().map(|a| a[key].clone()).collect::<Vec<_>>();
    assert_eq!(
        of("status"),
        [
            "found",
            "invalid_request",
            "invalid_request",
            "invalid_request",
            "found",
            "invalid_request"
        ]
    );
    assert_eq!(
        of("id"),
        [
            json!(1),
            json!("two"),
            Value::Null,
            Value::Null,
            json!({"n": 5}),
            json!(6)
        ]
    );
    assert_eq!(answers[1]["code"], "GOAL_OCCUPIED");
    assert!(
        answers[2]["reason"]
            .as_str()
            .unwrap()
            .starts_with("line 4: ")
    );
    assert!(
        answers[3]["reason"]
            .as_str()
            .unwrap()
            .contains("deadline_ms")
    );
    assert_eq!(answers[4]["seed"], 3);
    assert!(
        answers[5]["reason"]
            .as_str()
            .unwrap()
            .contains("goal is missing")
    );
}

/// A car that says how fast it drives and steers.
const STEERED: &str = r#"{"wheelbase_m": 0.65, "width_m": 0.5, "front_overhang_m": 0.1,
    "rear_overhang_m": 0.1, "max_steer_deg": 40, "max_steer_rate_rad_per_s": 0.8, "speed_mps": 0.8}"#;

#[test]
fn continuous_curvature_is_planned_written_and_checked() {
    let room = Room::new();
    room.write("steered.json", STEERED);
    let vehicle = ["--vehicle", "steered.json"];
    let run = room.plan(
        &[
            &vehicle[..],
            &["--continuous-curvature", "--out", "smooth.json"],
        ]
        .concat(),
    );
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    run.assert_says("curvature continuous, up to ");
    run.assert_says("driven     in ");

    let answer: Value = serde_json::from_str(&room.read("smooth.json")).unwrap();
    assert_eq!(answer["certificate"]["is_curvature_continuous"], true);
    let rate = &answer["certificate"]["max_curvature_rate_per_m2"];
    assert!(
        rate.as_f64().unwrap() <= 0.8 / (0.65 * 0.8) * (1.0 + 1e-9),
        "{rate}"
    );
    assert_eq!(
        answer["provenance"]["request"]["curvature"],
        json!({"continuous": {}})
    );
    let segments = answer["path"]["segments"].as_array().unwrap();
    assert!(segments.iter().any(|s| s["curvature_rate"].is_f64()));
    let last = answer["path"]["poses"].as_array().unwrap().last().unwrap();
    assert_eq!(last["speed"], 0.0);
    assert!(
        (last["time"].as_f64().unwrap() - answer["metrics"]["travel_time_s"].as_f64().unwrap())
            .abs()
            < 1e-9
    );

    let check = ["check", "smooth.json", "--map", "room.yaml", "--json"];
    let check = room.run(&[&check[..], &vehicle[..]].concat());
    assert_eq!(check.code, 0, "{}{}", check.stdout, check.stderr);
    assert_eq!(check.json()["matches_record"]["path"], true);
    assert_eq!(check.json()["matches_record"]["numbers"], true);
}

#[test]
fn a_rate_that_is_none_is_refused_in_words() {
    let room = Room::new();
    room.plan(&["--continuous-curvature", "-1"])
        .assert_refused(&["max_rate_per_m2", "-1", "0.0001 to 10000", "hint"]);
    room.plan(&["--continuous-curvature", "fast"])
        .assert_refused(&["fast", "not a number"]);
    room.write("bare.toml", BARE_VEHICLE);
    room.plan(&["--continuous-curvature", "--vehicle", "bare.toml"])
        .assert_refused(&["max_steer_rate_rad_per_s", "hint"]);
}

#[test]
fn a_budget_that_cuts_the_improvement_is_named() {
    let cut = ["--map", "warehouse", "--budget", "2000", "--json"];
    let room = Room::new();
    let answer = room.run(&[&["plan"], &cut[..]].concat()).json();
    assert_eq!(answer["status"], "found");
    assert_eq!(answer["cut_by"], "budget_exhausted");
    let whole = room.run(&["plan", "--map", "warehouse", "--json"]).json();
    assert!(whole.get("cut_by").is_none());
    let words = room.run(&["plan", "--map", "warehouse", "--budget", "2000"]);
    words.assert_says("stopped by the budget");
}

#[test]
fn poses_lie_as_close_as_asked_and_check_reads_them_all() {
    let room = Room::new();
    let check = |path: &str| {
        let check = [
            "check",
            path,
            "--map",
            "room.yaml",
            "--vehicle",
            "warehouse_amr",
        ];
        room.run(&check)
    };
    let mut counts = Vec::new();
    for spacing in ["0.01", "0.5", "0.5,2deg", "1000,10"] {
        let files = [
            "--spacing",
            spacing,
            "--out",
            "path.json",
            "--out",
            "path.csv",
        ];
        let plan = room.plan(&[&files[..], &["--goal-heading", "exact"]].concat());
        assert_eq!(plan.code, 0, "{}", plan.stderr);
        let answer: Value = serde_json::from_str(&room.read("path.json")).unwrap();
        let poses = answer["path"]["poses"].as_array().unwrap();
        counts.push(poses.len());
        let checked = check("path.json");
        assert_eq!(checked.code, 0, "{spacing}: {}", checked.stdout);
        checked.assert_says("the certificate is for this map, vehicle and path");
        let checked = check("path.csv");
        assert_eq!(checked.code, 0, "{spacing}: {}", checked.stdout);
    }
    assert!(counts[0] > counts[2] && counts[2] > counts[1] && counts[1] > counts[3]);
    for (bad, told) in [
        ("1e-9", &["max_m", "1e-9", "0.001", "hint"][..]),
        ("1e300", &["max_m", "1000"]),
        ("0.1,0", &["max_turn_rad", "0.001"]),
        ("nan", &["not finite"]),
        ("0.1,0.2,0.3", &["3 numbers", "M,RAD"]),
    ] {
        room.plan(&["--spacing", bad]).assert_refused(told);
    }
}

#[test]
fn a_change_of_gear_has_a_row_for_each_gear() {
    let room = Room::new();
    let scene = ["--map", "parking-lot"];
    let flags = ["--request", "back-in", "--set", "improve.max_tries=0"];
    let files = ["--out", "path.json", "--out", "path.csv"];
    let plan = room.run(&[&["plan"], &scene[..], &flags, &files].concat());
    assert_eq!(plan.code, 0, "{}", plan.stderr);
    let answer: Value = serde_json::from_str(&room.read("path.json")).unwrap();
    let poses = answer["path"]["poses"].as_array().unwrap();
    let cusps = poses
        .windows(2)
        .filter(|w| w[0]["direction"] != w[1]["direction"]);
    let cusps: Vec<_> = cusps.collect();
    assert_eq!(
        cusps.len() as u64,
        answer["metrics"]["n_cusps"].as_u64().unwrap()
    );
    assert!(!cusps.is_empty());
    for cusp in cusps {
        for key in ["x", "y", "heading", "s", "clearance"] {
            assert_eq!(cusp[0][key], cusp[1][key], "{key}");
        }
    }
    for path in ["path.json", "path.csv"] {
        let checked = room.run(&[&["check", path], &scene[..]].concat());
        assert_eq!(checked.code, 0, "{path}: {}", checked.stdout);
    }
}

#[test]
fn a_mask_closes_ground_and_is_named_in_answer_and_certificate() {
    let room = Room::new();
    // A mask of its own size and place: it closes the door of the room, 30 columns from the left.
    let mut image = b"P5\n40 40\n255\n".to_vec();
    image.extend((0..40 * 40).map(|i| if i / 40 < 36 { 0 } else { 205 }));
    room.write("mask.pgm", image);
    let yaml = "image: mask.pgm\nresolution: 0.07\norigin: [5.0, 5.2, 0.1]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    room.write("mask.yaml", yaml);
    let shut = room.plan(&["--keep-out", "mask.yaml"]);
    assert_eq!(shut.code, 3, "{}{}", shut.stdout, shut.stderr);
    room.write(
        "mask.yaml",
        yaml.replace("[5.0, 5.2, 0.1]", "[2.0, 5.2, 0.1]"),
    );
    let answer = room.plan(&["--keep-out", "mask.yaml", "--json", "--out", "path.json"]);
    let answer = answer.json();
    let maps = &answer["provenance"]["map"]["keep_out_maps"];
    assert_eq!(maps[0]["name"], "mask.yaml");
    let words = format!(
        "the keep-out map mask.yaml closes {} cells",
        maps[0]["n_cells"]
    );
    assert_eq!(answer["certificate"]["assumptions"], json!([words]));
    room.plan(&["--keep-out", "mask.yaml"]).assert_says(&words);
    let check = ["check", "path.json", "--map", "room.yaml"];
    let with_mask = room.run(&[&check[..], &["--keep-out", "mask.yaml"]].concat());
    assert_eq!(with_mask.code, 0, "{}", with_mask.stdout);
    with_mask.assert_says("the certificate is for this map, vehicle and path");
    room.run(&check).assert_says("for another map");
    room.write("mask.yaml", yaml.replace("[5.0, 5.2, 0.1]", "[50, 50, 0]"));
    let beside = room.plan(&["--keep-out", "mask.yaml"]);
    assert!(
        beside.stderr.contains("closes no ground"),
        "{}",
        beside.stderr
    );
    room.plan(&["--keep-out", "mesk.yaml"])
        .assert_refused(&["--keep-out", "mesk.yaml"]);
    room.plan(&["--keep-out", "1,2 3"])
        .assert_refused(&["not x,y", "map file"]);
}

#[test]
fn out_of_contact_first_and_certified_from_there_on() {
    let room = Room::new();
    // Its front 7.5 cm in the wall across the room.
    let stuck = [
        "plan",
        "--map",
        "room.yaml",
        "--start",
        "5.3,2,0",
        "--goal",
        "2,5,90deg",
    ];
    let plan = |more: &[&str]| room.run(&[&stuck[..], more].concat());
    plan(&[]).assert_refused(&["overlaps", "--escape"]);
    let answer = plan(&["--escape", "--json", "--out", "path.json"]).json();
    assert_eq!(answer["status"], "found");
    let out = &answer["escape"]["path"];
    assert_eq!(out["segments"][0]["direction"], -1);
    let length_m = out["segments"][0]["length"].as_f64().unwrap();
    assert!((0.075..0.13).contains(&length_m), "{length_m}");
    assert_eq!(
        out["poses"].as_array().unwrap().last().unwrap()["x"],
        answer["path"]["segments"][0]["x"]
    );
    assert_eq!(answer["provenance"]["request"]["start"][0], 5.3);
    plan(&["--escape"]).assert_says("out of contact, uncertified; the path begins at");
    let check = || room.run(&["check", "path.json", "--map", "room.yaml"]);
    let checked = check();
    assert_eq!(checked.code, 0, "{}", checked.stdout);
    checked.assert_says("escape     touches nothing but the cells in which it begins");
    // A drive through the wall is no way out, and one that begins elsewhere is not that of the request.
    let honest = room.read("path.json");
    for (pointer, value) in [
        ("/escape/path/segments/0/direction", json!(1)),
        ("/escape/path/segments/0/x", json!(5.0)),
        ("/escape/path/segments/0/length", json!(0.05)),
    ] {
        let mut forged: Value = serde_json::from_str(&honest).unwrap();
        *forged.pointer_mut(pointer).unwrap() = value;
        room.write("path.json", forged.to_string());
        let checked = check();
        assert_eq!(checked.code, 3, "{pointer}: {}", checked.stdout);
    }
    // From free ground the flag changes nothing.
    let free = |more: &[&str]| room.plan(&[&["--json"], more].concat()).json();
    assert!(free(&["--escape"]).get("escape").is_none());
    assert_eq!(free(&["--escape"])["path"], free(&[])["path"]);
    // In the middle of the wall, lengthwise, there is none.
    let shut = [
        "plan",
        "--map",
        "room.yaml",
        "--start",
        "6.1,2,90deg",
        "--goal",
        "2,5,90deg",
        "--escape",
    ];
    room.run(&shut).assert_refused(&["no way out", "hint"]);
}

#[test]
fn a_budget_ends_a_run_by_default_and_none_lifts_it() {
    let room = Room::new();
    let budget = |more: &[&str]| {
        let answer = room.plan(&[&["--json"], more].concat()).json();
        answer["provenance"]["request"]["budget_steps"].clone()
    };
    assert_eq!(budget(&[]), 200_000);
    assert_eq!(budget(&["--budget", "none"]), Value::Null);
    assert_eq!(budget(&["--budget", "70"]), 70);
    assert_eq!(budget(&["--planner", "dijkstra"]), Value::Null);
    for bad in ["-1", "1.5", "many"] {
        room.plan(&["--budget", bad])
            .assert_refused(&[bad, "steps", "none"]);
    }
}

#[test]
fn a_plan_is_recorded_and_its_map_planned_on_again() {
    let room = Room::new();
    let plan = |map: &str, more: &[&str]| {
        let ends = ["--start", "2,2,0", "--goal", "9,2,0", "--json"];
        room.run(&[&["plan", "--map", map], &ends[..], more].concat())
    };
    let from_file = plan("room.yaml", &["--record", "plan.mcap"]).json();
    let segments = |answer: &Value| answer["path"]["segments"].clone();
    for map in ["plan.mcap", "plan.mcap:/map", "plan.mcap:map@0"] {
        let from_bag = plan(map, &[]).json();
        assert_eq!(segments(&from_bag), segments(&from_file), "{map}");
        assert_eq!(from_bag["provenance"]["map"]["name"], map);
    }
    plan("plan.mcap:/plan", &[]).assert_refused(&["/plan has messages of type nav_msgs/msg/Path"]);
    plan("plan.mcap", &["--resolution", "1"]).assert_refused(&["their own resolution"]);
    plan("room.yaml", &["--record", "plan.bag"]).assert_refused(&["plan.bag", ".mcap"]);
    let blocked = ["--goal", "9,2,0", "--budget", "1", "--record", "none.mcap"];
    let run = room.run(
        &[
            &["plan", "--map", "room.yaml", "--start", "2,2,0"],
            &blocked[..],
        ]
        .concat(),
    );
    assert_eq!(run.code, 3, "{}", run.stdout);
    assert!(!room.path("none.mcap").exists());
}
