//! Bad input: refused with value, limit and hint, exit code 2, no panic and no partial file.

use crate::common::Room;

/// A YAML for the room's image with one line changed.
fn yaml_with(room: &Room, from: &str, to: &str) {
    let yaml = room.read("room.yaml");
    assert!(yaml.contains(from));
    room.write("bad.yaml", yaml.replace(from, to));
}

fn refused_map(room: &Room, words: &[&str]) {
    let ends = [
        "--start",
        "2,2,0",
        "--goal",
        "4,4,0",
        "--out",
        "no.json",
        "--picture",
        "no.svg",
    ];
    let run = room.run(&[&["plan", "--map", "bad.yaml"][..], &ends].concat());
    run.assert_refused(words);
    assert!(!room.path("no.json").exists() && !room.path("no.svg").exists());
}

#[test]
fn maps_that_are_missing_or_of_unknown_kind() {
    let room = Room::new();
    let plan = |map| room.run(&["plan", "--map", map, "--start", "2,2,0", "--goal", "4,4,0"]);
    plan("nowhere.yaml").assert_refused(&["nowhere.yaml"]);
    plan("ware-house").assert_refused(&["\"ware-house\"", "warehouse"]);
    room.write("map.xyz", "..");
    plan("map.xyz").assert_refused(&["xyz"]);
    room.run(&["plan", "--start", "2,2,0", "--goal", "4,4,0"])
        .assert_refused(&["--map"]);
    yaml_with(&room, "room.pgm", "gone.pgm");
    refused_map(&room, &["gone.pgm"]);
}

#[test]
fn images_that_are_truncated_huge_or_none() {
    let room = Room::new();
    yaml_with(&room, "room.pgm", "bad.pgm");
    room.write("bad.pgm", "P5\n60 40\n255\n....");
    refused_map(&room, &["bad.pgm"]);
    room.write("bad.pgm", "P5\n4000000000 4000000000\n255\n....");
    refused_map(&room, &["bad.pgm", "4000000000"]);
    room.write("bad.pgm", "GIF89a");
    refused_map(&room, &["bad.pgm"]);
    room.write("bad.pgm", "P5\n0 0\n255\n");
    refused_map(&room, &["bad.pgm"]);
    room.write("bad.pgm", "");
    refused_map(&room, &["bad.pgm"]);
}

#[test]
fn resolutions_and_origins_that_are_none() {
    let room = Room::new();
    for bad in ["0", "-0.1", ".nan", ".inf", "fine"] {
        yaml_with(&room, "resolution: 0.2", &format!("resolution: {bad}"));
        refused_map(&room, &["resolution"]);
    }
    yaml_with(&room, "[0.0, 0.0, 0.0]", "[0.0, .nan, 0.0]");
    refused_map(&room, &["origin"]);
    yaml_with(&room, "[0.0, 0.0, 0.0]", "[0.0]");
    refused_map(&room, &[]);
}

#[test]
fn poses_that_are_not_numbers() {
    let room = Room::new();
    for bad in ["nan,2,0", "1,inf,0", "1,2", "1,2,3,4", "a,b,c", ""] {
        let run = room.run(&[
            "plan",
            "--map",
            "room.yaml",
            "--goal",
            "4,4,0",
            "--start",
            bad,
        ]);
        run.assert_refused(&["--start"]);
    }
    room.run(&["plan", "--map", "room.yaml", "--goal", "4,4,0"])
        .assert_refused(&["start is missing"]);
}

#[test]
fn numbers_out_of_range() {
    let room = Room::new();
    let cases = [
        ("--goal-tolerance", "0,0.1"),
        ("--goal-tolerance", "0.1"),
        ("--goal-tolerance", "0.1,nan"),
        ("--margin", "-1"),
        ("--margin", "inf"),
        ("--deadline", "0"),
        ("--deadline", "-5"),
        ("--budget", "many"),
        ("--threads", "0"),
        ("--seed", "x"),
        ("--resolution", "0"),
        ("--unknown", "maybe"),
        ("--motion", "sideways"),
        ("--goal-heading", "both"),
        ("--keep-out", "0,0 1,1"),
        ("--keep-out", "0,0 1,1 2,nan"),
        ("--planner", "ants"),
    ];
    for (flag, bad) in cases {
        room.plan(&[flag, bad]).assert_refused(&[flag]);
    }
    room.plan(&["--deadline", "1e300"])
        .assert_refused(&["deadline_ms", "3e10"]);
}

#[test]
fn vehicles_that_cannot_be() {
    let room = Room::new();
    let cases = [
        ("[1]", "bad.json"),
        ("{\"wheelbase\": -1}", "-1"),
        ("{\"wheelbase\": 1e999}", "bad.json"),
        ("{\"wheelbse\": 1}", "wheelbse"),
        (
            "{\"footprint\": [[0, 0], [1, 1]], \"r_min\": 1}",
            "footprint",
        ),
        ("{\"footprint\": \"[[0, 0\", \"r_min\": 1}", "footprint"),
        (
            "{\"footprint\": [[1, 1], [-1, 1], [-1, -1], [1, -1]], \"r_min\": 0}",
            "on the spot",
        ),
        (
            "{\"wheelbase\": 1, \"width\": 1, \"front_overhang\": 0, \"rear_overhang\": 0}",
            "max_steer_rad",
        ),
        ("", "bad.json"),
    ];
    for (json, word) in cases {
        room.write("bad.json", json);
        room.plan(&["--vehicle", "bad.json"])
            .assert_refused(&["bad.json", word]);
    }
    room.write("bad.toml", "wheelbase_m = \"long\"");
    room.plan(&["--vehicle", "bad.toml"])
        .assert_refused(&["bad.toml"]);
    room.plan(&["--vehicle", "tank"])
        .assert_refused(&["\"tank\"", "sedan"]);
    room.plan(&["--vehicle", "gone.toml"])
        .assert_refused(&["gone.toml"]);
}

#[test]
fn parameters_that_nobody_knows() {
    let room = Room::new();
    room.write("bad.toml", "[hybrid_astar]\nwieght = 1.0\n");
    room.plan(&["--config", "bad.toml"]).assert_refused(&[
        "bad.toml",
        "hybrid_astar.wieght",
        "hybrid_astar.weight",
    ]);
    room.write("bad.toml", "[hybrid_astar\n");
    room.plan(&["--config", "bad.toml"])
        .assert_refused(&["bad.toml"]);
    room.plan(&["--config", "gone.toml"])
        .assert_refused(&["gone.toml"]);
    room.plan(&["--set", "weight=1"])
        .assert_refused(&["\"weight\"", "hybrid_astar.weight"]);
    room.plan(&["--set", "hybrid_astar.weight=0.5"])
        .assert_refused(&["0.5", "1 to 10"]);
    room.plan(&["--set", "hybrid_astar.weight=abc"])
        .assert_refused(&["hybrid_astar.weight=abc", "\"abc\""]);
    room.write("bad.toml", "[hybrid_astar]\nweight = \"x\"\n");
    room.plan(&["--config", "bad.toml"])
        .assert_refused(&["bad.toml", "\"x\""]);
    room.plan(&["--set", "hybrid_astar.weight"])
        .assert_refused(&["KEY=VALUE"]);
}

#[test]
fn outputs_that_cannot_be_written_are_refused_first() {
    let room = Room::new();
    room.write("folder.json", "");
    std::fs::remove_file(room.path("folder.json")).unwrap();
    std::fs::create_dir(room.path("folder.json")).unwrap();
    let cases = [
        ("--out", "gone/path.json", "does not exist"),
        ("--out", "path.txt", ".json or .csv"),
        ("--out", "folder.json", "no regular file"),
        ("--picture", "gone/path.svg", "does not exist"),
        ("--picture", "path.gif", ".svg or .png"),
    ];
    for (flag, bad, word) in cases {
        room.plan(&[flag, bad]).assert_refused(&[bad, word]);
    }
    assert_eq!(room.files(), ["folder.json", "room.pgm", "room.yaml"]);
}

#[test]
fn scenario_files_that_are_none() {
    let room = Room::new();
    let cases = [
        "",
        "{}",
        "{\"version\": 9, \"scenarios\": []}",
        "{\"version\": 1, \"scenarios\": []}",
    ];
    for json in cases {
        room.write("bad.json", json);
        room.run(&["plan", "--scenario", "bad.json"])
            .assert_refused(&["bad.json"]);
    }
    for csv in [
        "",
        "1,2,3",
        "0,0,0,5,5,0,-1",
        "0,0,0,5,5,0,1,1e300",
        "nan,0,0,1,1,0,0",
    ] {
        room.write("Case1.csv", csv);
        room.run(&["plan", "--scenario", "Case1.csv"])
            .assert_refused(&["Case1.csv"]);
    }
}

#[test]
fn flags_that_contradict_each_other() {
    let room = Room::new();
    room.plan(&["--scenario", "cars.json"])
        .assert_refused(&["--scenario"]);
    room.plan(&["--stdin", "--json"])
        .assert_refused(&["--stdin"]);
    room.plan(&["--request", "x"])
        .assert_refused(&["--request"]);
    room.plan(&["--id", "x"]).assert_refused(&["--id"]);
    room.plan(&["--no-such-flag"])
        .assert_refused(&["--no-such-flag"]);
}
