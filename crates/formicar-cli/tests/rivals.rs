//! Programs of others in a campaign: judged, tabled beside ours, and told apart where they fail.
#![cfg(unix)]

use crate::common::{Room, Run};
use std::collections::BTreeMap;

/// The rows of a table by planner, each by column.
fn rows(text: &str) -> BTreeMap<String, BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows = reader.deserialize::<BTreeMap<String, String>>();
    let keyed = rows.map(|row| {
        let row = row.unwrap();
        (row["planner"].clone(), row)
    });
    keyed.collect()
}

/// A shell script that answers any question, and says `ready` where its version is asked.
fn script(answer: &str) -> String {
    format!(
        "#!/bin/sh\nif grep -q '\"ask\":\"version\"'; then echo '{{\"status\": \"ready\", \
         \"version\": \"it 1\"}}'; else {answer}; fi\n"
    )
}

fn planner(name: &str, command: &str) -> String {
    format!("[[planner]]\nname = \"{name}\"\ncommand = [{command}]\n")
}

/// A dead straight way of 3 m for a small vehicle, in the left half of the room.
const SCENARIO: &str = r#"{"version": 1, "scenarios": [{"id": "s", "map": "room.yaml",
    "resolution": 0.2, "start": [2, 4, 0], "goal": [5, 4, 0], "vehicle": {"wheelbase": 0.3,
    "max_steer_deg": 30, "length": 0.5, "width": 0.3, "rear_overhang": 0.1,
    "front_overhang": 0.1, "reference": "rear_axle"}}]}"#;

/// A script that finds a path.
fn found(poses: &str, more: &str) -> String {
    script(&format!(
        "echo '{{\"status\": \"found\", \"version\": \"it 1\", \"poses\": {poses}{more}}}'"
    ))
}

const NAMES: [&str; 6] = ["straight", "jump", "points", "odd", "dies", "none"];

/// A campaign of a planner of ours, scripts, and this program itself.
fn room_of_programs() -> Room {
    let room = Room::new();
    room.write("s.json", SCENARIO);
    room.write(
        "straight.sh",
        found("[[2, 4, 0], [3, 4, 0], [5, 4, 0]]", ", \"query_s\": 0.001"),
    );
    room.write("jump.sh", found("[[2, 4, 0], [3, 5, 1.5], [5, 4, 0]]", ""));
    room.write("points.sh", found("[[2, 4], [3, 4], [5, 4]]", ""));
    room.write("odd.sh", script("echo '{\"status\": \"found\"}'"));
    room.write("dies.sh", script("echo no luck >&2; exit 4"));
    room.write(
        "none.sh",
        script("echo '{\"status\": \"not_found\", \"reason\": \"so be it\"}'"),
    );
    let programs = NAMES.map(|name| planner(name, &format!("\"sh\", \"{name}.sh\"")));
    room.write(
        "c.toml",
        format!(
            "[[scenarios]]\nfile = \"s.json\"\n[[planner]]\nplanner = \"hybrid-astar\"\n{}{}",
            programs.concat(),
            planner("cells", "\"formicar\", \"rival\", \"pathfinding\"")
        ),
    );
    room
}

#[test]
fn every_path_that_a_program_shows_is_judged() {
    let room = Room::new();
    room.write("s.json", SCENARIO);
    let straight = "[[2, 4, 0], [3, 4, 0], [5, 4, 0]]";
    // The first path cannot be driven, the two after it can.
    let course = format!(
        ", \"improvements\": [[0.001, 9], [0.002, 8], [0.003, 3]], \"first_feasible_s\": 0.001, \
         \"improvements_cpu_s\": [0.0005, 0.001, 0.002], \
         \"earlier_poses\": [[[2, 4, 0], [3, 5, 1.5], [5, 4, 0]], {straight}]"
    );
    room.write("shows.sh", found(straight, &course));
    let program = planner("shows", "\"sh\", \"shows.sh\"");
    room.write(
        "c.toml",
        format!("[[scenarios]]\nfile = \"s.json\"\n{program}"),
    );
    let run = room.run(&["bench", "c.toml", "--store", "s.sqlite"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let row = &rows(&room.read("s.csv"))["shows"];
    let columns = [
        "first_feasible_s",
        "first_feasible_cpu_s",
        "first_length_m",
        "length_0.1s_m",
    ];
    assert_eq!(
        columns.map(|column| row[column].as_str()),
        ["0.002", "0.001", "3.0", "3.0"]
    );
    assert_eq!(room.run(&["report", "s.sqlite", "--out", "page"]).code, 0);
    let page = room.read("page/summary.md");
    assert!(page.contains("| shows | 1.0000 | 1.0000 |"), "{page}");
}

#[test]
fn paths_of_programs_are_judged_and_tabled_beside_ours() {
    let room = room_of_programs();
    let run = room.run(&["bench", "c.toml", "--store", "s.sqlite"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let rows = rows(&room.read("s.csv"));
    assert_eq!(rows.len(), 8);
    let of = |planner: &str, columns: [&str; 3]| columns.map(|c| rows[planner][c].clone());
    for planner in ["hybrid-astar", "straight", "points"] {
        let [status, valid, length_m] = of(planner, ["status", "valid", "length_m"]);
        assert_eq!([status.as_str(), &valid], ["found", "true"], "{planner}");
        let length_m: f64 = length_m.parse().unwrap();
        assert!((length_m - 3.0).abs() < 0.02, "{planner}: {length_m}");
    }
    assert_eq!(rows["straight"]["query_s"], "0.001");
    assert_eq!(rows["straight"]["first_feasible_s"], "0.001");
    let [status, valid, reason] = of("jump", ["status", "valid", "reason"]);
    assert_eq!([status.as_str(), &valid], ["found", "false"]);
    assert!(reason.contains("turns on the spot"), "{reason}");
    for (planner, status, told) in [
        ("odd", "crashed", "poses: none"),
        ("dies", "crashed", "exit status: 4: no luck"),
        ("none", "not_found", "so be it"),
        ("cells", "refused", "for points"),
    ] {
        assert_eq!(rows[planner]["status"], status, "{planner}");
        assert!(rows[planner]["reason"].contains(told), "{planner}");
    }
    let hashes = NAMES.map(|name| rows[name]["config_hash"].clone());
    assert_ne!(hashes[0], hashes[1]);
    // Another program under the same name is another campaign.
    room.write("jump.sh", found("[[2, 4, 0]]", ""));
    let again = room.run(&["bench", "c.toml", "--store", "s.sqlite"]);
    again.assert_refused(&["another campaign", "8 runs, of which 7"]);
    let page = room.run(&["report", "s.sqlite", "--out", "page"]);
    page.assert_says("| straight | 1/1");
    assert!(room.read("page/index.html").contains("straight.sh"));
}

#[test]
fn over_cells_the_crate_finds_ways_as_short_as_ours() {
    let room = Room::new();
    let rows_of_map = [
        "..........",
        "..@@@@....",
        ".....@....",
        "..@..@....",
        "..@.......",
    ];
    let map = format!(
        "type octile\nheight 5\nwidth 10\nmap\n{}\n",
        rows_of_map.join("\n")
    );
    room.write("m.map", map);
    room.write(
        "m.map.scen",
        "version 1\n0\tm.map\t10\t5\t4\t3\t9\t0\t9.65685425\n0\tm.map\t10\t5\t0\t4\t9\t4\t9.82842712\n",
    );
    let cells = planner("pathfinding", "\"formicar\", \"rival\", \"pathfinding\"");
    room.write(
        "c.toml",
        format!("[[scenarios]]\nfile = \"m.map.scen\"\n[[planner]]\nplanner = \"astar\"\n{cells}"),
    );
    let run = room.run(&["bench", "c.toml", "--store", "s.sqlite"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let text = room.read("s.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows: Vec<BTreeMap<String, String>> =
        reader.deserialize().collect::<Result<_, _>>().unwrap();
    assert_eq!(rows.len(), 4);
    for pair in rows.chunks(2) {
        let lengths = [&pair[0], &pair[1]].map(|row| {
            assert_eq!(
                (row["status"].as_str(), row["valid"].as_str()),
                ("found", "true")
            );
            row["length_cells"].parse::<f64>().unwrap()
        });
        assert!((lengths[0] - lengths[1]).abs() < 1e-6, "{lengths:?}");
    }
}

#[test]
fn programs_that_do_not_start_are_told_before_any_run() {
    let room = Room::new();
    room.write("s.json", SCENARIO);
    for (command, told) in [
        ("\"./no-such-program\"", "it cannot be started"),
        ("\"sh\", \"-c\", \"echo once upon a time\"", "its answer"),
        ("\"sh\", \"-c\", \"exit 7\"", "exit status: 7"),
        ("\"formicar\", \"rival\", \"pathfinder\"", "pathfinder"),
    ] {
        let rival = planner("it", command);
        room.write(
            "c.toml",
            format!("[[scenarios]]\nfile = \"s.json\"\n{rival}"),
        );
        let run = room.run(&["bench", "c.toml", "--store", "s.sqlite"]);
        run.assert_refused(&["planner \"it\"", told]);
    }
}

/// Imports into `r.csv`.
fn import(room: &Room, words: &[&str]) -> Run {
    let shared = ["import", "--scenario", "s.json", "--out", "r.csv"];
    room.run(&[&shared[..], words].concat())
}

/// Files of others, and the scenario that they are for.
fn room_of_files() -> Room {
    let room = Room::new();
    room.write("s.json", SCENARIO);
    room.write("good.csv", "x,y,yaw\n2,4,0\n3,4,0\n5,4,0\n");
    room.write("short.csv", "2,4,0\n3,4,0\n");
    let pose = |x: f64| {
        format!(
            r#"{{"pose": {{"position": {{"x": {x}, "y": 4}}, "orientation": {{"z": 0, "w": 1}}}}}}"#
        )
    };
    room.write(
        "nav.json",
        format!(r#"{{"poses": [{}, {}]}}"#, pose(2.0), pose(5.0)),
    );
    room.write(
        "door.log",
        "OMPL version 2.0.1\nExperiment door\n1 planners\ngeometric_RRT\n0 common properties\n\
         3 properties for each run\nsolved BOOLEAN\ntime REAL\nsolution length REAL\n2 runs\n\
         1; 0.25; 3.5; \n0; 1; 0; \n.\n",
    );
    room
}

#[test]
fn files_of_others_are_judged_and_tabled_beside_ours() {
    let room = room_of_files();
    let run = import(
        &room,
        &[
            "good.csv",
            "short.csv",
            "--planner",
            "lattice",
            "--query",
            "0.5",
        ],
    );
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    run.assert_says("s  lattice  seed 0  valid\n");
    assert!(
        run.stdout
            .contains("seed 1  invalid: the path misses the goal"),
        "{}",
        run.stdout
    );
    // Once more, with a goal that is reached more loosely: the row is replaced.
    let loose = [
        "--goal-tolerance",
        "2.5,0.1",
        "--seed",
        "1",
        "--planner",
        "lattice",
    ];
    let run = import(&room, &[&["short.csv"], &loose[..]].concat());
    let told = "1 run imported, 2 in all: see r.csv";
    run.assert_says(told);
    import_the_others(&room);
    table_beside_ours(&room);
}

/// A path of ROS, and a log with and without trust.
fn import_the_others(room: &Room) {
    assert_eq!(import(room, &["nav.json", "--planner", "nav"]).code, 0);
    assert!(
        import(room, &["door.log"])
            .stdout
            .contains("geometric_RRT  seed 0  found: its log holds no")
    );
    assert_eq!(import(room, &["door.log", "--trust"]).code, 0);
}

/// A report and a comparison of the imported rows with ours.
fn table_beside_ours(room: &Room) {
    room.write(
        "c.toml",
        "[[scenarios]]\nfile = \"s.json\"\n[[planner]]\nplanner = \"hybrid-astar\"\n",
    );
    assert_eq!(
        room.run(&["bench", "c.toml", "--store", "o.sqlite"]).code,
        0
    );
    let page = room.run(&["report", "o.sqlite", "r.csv", "--out", "page"]);
    assert_eq!((page.code, page.stderr.as_str()), (0, ""));
    for row in [
        "| hybrid-astar | 1/1",
        "| lattice | 2/2",
        "| nav | 1/1",
        "| geometric_RRT | 0/2",
        "| geometric_RRT (own word) | 1/2",
    ] {
        assert!(page.stdout.contains(row), "no {row:?} in: {}", page.stdout);
    }
    import_what_a_report_writes(room);
    let only = [
        "import",
        "--scenario",
        "s.json",
        "nav.json",
        "--planner",
        "nav",
        "--out",
        "n.csv",
    ];
    assert_eq!(room.run(&only).code, 0);
    let compared = room.run(&["compare", "o.sqlite", "n.csv"]);
    assert_eq!((compared.code, compared.stderr.as_str()), (0, ""));
}

/// The OMPL log of a report, which holds no path to judge.
fn import_what_a_report_writes(room: &Room) {
    let log = "page/ompl-s-own-reverse.log";
    let run = room.run(&["import", "--scenario", "s.json", log, "--out", "l.csv"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let told = "hybrid-astar  seed 0  found: its log holds no path: not judged";
    run.assert_says(told);
}

#[test]
fn files_that_are_none_are_refused_with_the_place() {
    let room = room_of_files();
    for (name, text, words) in [
        ("a.csv", "1,2,3\n1,two,3\n", ["a.csv", "line 2", "\"two\""]),
        (
            "b.json",
            "{\"poses\": [{}]}",
            ["b.json", "nav_msgs/Path", "expected a pose"],
        ),
        (
            "c.log",
            "OMPL version 2\n1 planners\nRRT\nodd\n",
            ["c.log", "line 4", "common properties"],
        ),
    ] {
        room.write(name, text);
        import(&room, &[name, "--planner", "it"]).assert_refused(&words);
    }
    import(&room, &["good.csv"]).assert_refused(&["good.csv", "--planner NAME"]);
    let late = [
        "good.csv",
        "--planner",
        "it",
        "--query",
        "0.1",
        "--first",
        "0.3",
    ];
    import(&room, &late).assert_refused(&["--first 0.3", "--query 0.1"]);
    let base = [
        "import",
        "--scenario",
        "s.json",
        "good.csv",
        "--planner",
        "it",
    ];
    let run = room.run(&[&base[..], &["--out", "r.sqlite"]].concat());
    run.assert_refused(&["--out r.sqlite", "a table as CSV", "--out r.csv"]);
    assert!(!room.path("r.sqlite").exists());
}
