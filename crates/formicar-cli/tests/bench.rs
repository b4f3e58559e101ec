//! `bench`: tables, what survives a kill, answers, refusals.

use crate::common::{Room, Run, Table};
use std::collections::BTreeSet;
use std::fs;

#[test]
#[cfg(target_os = "linux")]
fn processor_time_and_memory_are_measured_warm_and_cold() {
    let room = Room::new();
    for cold in [&["--cold"][..], &[]] {
        let args = ["bench", "narrow-junction", "--limit", "1", "--out"];
        let out = if cold.is_empty() { "warm" } else { "cold" };
        assert_eq!(room.run(&[&args[..], &[out], cold].concat()).code, 0);
        let table = Table::of(&room.read(&format!("{out}/results.csv")));
        let number = |column| table.get(0, column).parse::<f64>().unwrap();
        assert!(number("cpu_s") > 0.0 && number("peak_rss_bytes") > 1e6);
        let is_same = table.get(0, "cold_first_s") == table.get(0, "first_feasible_s");
        assert_eq!(is_same, !cold.is_empty());
    }
}

/// Two maps of two requests each, two seeds.
const JUNCTIONS: [&str; 9] = [
    "bench",
    "narrow-junction",
    "wang-open",
    "--planners",
    "hybrid-astar,astar",
    "--seeds",
    "2",
    "--out",
    "out",
];

fn bench(room: &Room, more: &[&str]) -> Run {
    room.run(&[&JUNCTIONS[..], more].concat())
}

#[test]
fn tables_have_the_promised_columns_and_every_run() {
    let room = Room::new();
    let run = bench(&room, &["--jobs", "2"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(
        run.stdout
            .contains("narrow-junction  hybrid-astar  4 of 4 found")
    );
    assert!(run.stdout.ends_with("12 runs: see out\n"), "{}", run.stdout);
    let text = room.read("out/results.csv");
    assert!(text.starts_with(
        "scenario,planner,seed,status,valid,map_setup_s,first_feasible_s,query_s,cpu_s,\
         peak_rss_bytes,length_m,min_clearance_m,n_cusps,"
    ));
    let table = Table::of(&text);
    assert_eq!(table.rows.len(), 12);
    let keys: Vec<_> = (0..12)
        .map(|i| ["scenario", "planner", "seed"].map(|c| table.get(i, c)))
        .collect();
    assert!(keys.is_sorted());
    let driven = keys
        .iter()
        .position(|k| *k == ["narrow-junction-quarter-turn", "hybrid-astar", "1"])
        .unwrap();
    assert_eq!(table.get(driven, "status"), "found");
    assert_eq!(table.get(driven, "valid"), "true");
    for column in [
        "map_setup_s",
        "first_feasible_s",
        "query_s",
        "length_m",
        "min_clearance_m",
        "ends_clearance_m",
        "first_length_m",
        "cost_m",
        "judge_s",
        "max_curvature_per_m",
        "steering_share_to_5_deg",
        "benchmr_aol",
        "steps",
        "total_s",
    ] {
        let value: f64 = table.get(driven, column).parse().unwrap();
        assert!(value >= 0.0, "{column}");
    }
    let refused = keys
        .iter()
        .position(|k| *k == ["wang-open-across", "hybrid-astar", "0"])
        .unwrap();
    assert_eq!(table.get(refused, "status"), "invalid_request");
    assert!(table.get(refused, "reason").contains("point"));
    assert!(
        room.read("out/summary.md")
            .contains("| narrow-junction | hybrid-astar | 4 | 4 | 4 |")
    );
    assert!(
        room.read("out/MACHINE.md")
            .contains("--planners hybrid-astar,astar")
    );
}

#[test]
fn a_killed_bench_goes_on_where_it_stopped() {
    let room = Room::new();
    assert_eq!(bench(&room, &[]).code, 0);
    let whole = room.read("out/results.csv");
    let lines: Vec<_> = whole.lines().collect();
    // Builds before this one kept no store: a kill left them a torn table.
    let torn = [&lines[..6].join("\n"), "\n", &lines[6][..20]].concat();
    room.write("out/results.csv", &torn);
    fs::remove_file(room.path("out/results.sqlite")).unwrap();
    let run = bench(&room, &[]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    run.assert_says("7 runs, 5 kept from before");
    let again = room.read("out/results.csv");
    assert_eq!(
        Table::of(&again).repeatable(),
        Table::of(&whole).repeatable()
    );
    assert!(
        again.contains(lines[3]),
        "rows that are complete stay as they are"
    );
    let run = bench(&room, &[]);
    assert!(run.stdout.contains("0 runs, 12 kept from before"));
    assert_eq!(room.read("out/results.csv"), again);
    bench(&room, &["--motion", "forward"]).assert_refused(&["settings.json", "forward", "--out"]);
    assert_eq!(room.read("out/results.csv"), again);
    // The table is written from the store.
    room.write("out/results.csv", torn);
    assert!(bench(&room, &[]).stdout.contains("0 runs, 12 kept"));
    assert_eq!(room.read("out/results.csv"), again);
    room.write("out/results.csv", again.replace(",found,", ",found\n,"));
    fs::remove_file(room.path("out/results.sqlite")).unwrap();
    bench(&room, &[]).assert_refused(&["results.csv", "no row of 58 values"]);
}

#[test]
fn kept_answers_pass_the_judge() {
    let room = Room::new();
    let args = ["bench", "narrow-junction", "--paths", "--out", "out"];
    assert_eq!(room.run(&args).code, 0);
    let path = "out/paths/narrow-junction-quarter-turn.formicar.0.json";
    let vehicle = "warehouse_amr";
    let check = [
        "check",
        path,
        "--map",
        "narrow-junction",
        "--vehicle",
        vehicle,
    ];
    let run = room.run(&check);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.starts_with("valid "), "{}", run.stdout);
    assert_eq!(fs::read_dir(room.path("out/paths")).unwrap().count(), 2);
    fs::remove_file(room.path(path)).unwrap();
    let run = room.run(&args);
    run.assert_says("1 run, 1 kept");
    assert_eq!(Table::of(&room.read("out/results.csv")).rows.len(), 2);
    assert!(room.path(path).exists());
}

/// Lines on a 4 x 3 map with a wall in the middle. Rows count from the top; the second optimum is
/// wrong.
fn yard(room: &Room) {
    let map = "type octile\nheight 3\nwidth 4\nmap\n.@..\n.@..\n....\n";
    room.write("yard.map", map);
    let line = |goal: &str, length: &str| format!("0\tyard.map\t4\t3\t0\t2\t{goal}\t{length}\n");
    let scen = [
        "version 1\n",
        &line("3\t2", "3.0000000"),
        &line("2\t1", "5.0000000"),
        &line("3\t0", "4.41421356"),
        "1\tyard.map\t4\t3\t0\t0\t2\t0\t6.0000000\n",
    ];
    room.write("yard.map.scen", scen.concat());
}

#[test]
fn movingai_lines_are_met_by_both_planners() {
    let room = Room::new();
    yard(&room);
    let scen = ["bench", "yard.map.scen", "--planners", "astar,dijkstra"];
    let run = room.run(&[&scen[..], &["--out", "out"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let table = Table::of(&room.read("out/results.csv"));
    assert_eq!(table.rows.len(), 8);
    assert_eq!(table.column("status"), ["found"; 8]);
    assert_eq!(table.column("valid"), ["true"; 8]);
    for i in [0, 1, 4, 5, 6, 7] {
        let number = |column| table.get(i, column).parse::<f64>().unwrap();
        let (length, optimum) = (number("length_cells"), number("optimal_length_cells"));
        assert!((length - optimum).abs() < 1e-4, "{length} is not {optimum}");
        assert!((number("length_m") - length).abs() < 1e-9);
    }
    assert_eq!(table.get(2, "length_cells"), "3.0", "the file says 5");
    let summary = room.read("out/summary.md");
    assert!(summary.contains("| 3 of 4 |"), "{summary}");
    let some = [&scen[..], &["--limit", "2", "--out", "two"]].concat();
    assert_eq!(room.run(&some).code, 0);
    let table = Table::of(&room.read("two/results.csv"));
    let names: BTreeSet<_> = table.column("scenario").into_iter().collect();
    assert_eq!(names, BTreeSet::from(["yard-00001", "yard-00004"]));
}

#[test]
fn wrong_input_is_refused_before_anything_is_started() {
    let room = Room::new();
    yard(&room);
    room.write("other.scen", "version 1\n0\tm\t9\t9\t0\t0\t1\t1\t1.4\n");
    room.write("other.map", room.read("yard.map"));
    room.write("lonely.scen", room.read("yard.map.scen"));
    room.write("empty.json", "{\"version\": 1, \"scenarios\": []}");
    let cases: [(&[&str], &[&str]); 9] = [
        (&["nowhere"], &["nowhere", "narrow-junction", "narrow"]),
        (&["nowhere.json"], &["nowhere.json"]),
        (&["empty.json"], &["empty.json", "no scenarios"]),
        (&["yard.map.scen"], &["yard.map.scen", "--planners astar"]),
        (&["other.scen", "--planners", "astar"], &["9 x 9", "4 x 3"]),
        (&["lonely.scen", "--planners", "astar"], &["lonely.map"]),
        (
            &["narrow", "narrow-junction"],
            &["two scenarios", "narrow-junction-"],
        ),
        (&["narrow", "--planners", "ants"], &["ants", "hybrid-astar"]),
        (
            &["narrow", "--set", "weight=2"],
            &["weight", "hybrid_astar.weight"],
        ),
    ];
    for (args, words) in cases {
        room.run(&[&["bench", "--out", "out"], args].concat())
            .assert_refused(words);
    }
    assert!(!room.path("out").exists());
    room.write("taken", "");
    room.run(&["bench", "narrow", "--out", "taken"])
        .assert_refused(&["taken"]);
}

/// A scenario file with the room twice, and peers beside it.
fn cars(room: &Room) {
    let scenario = |id: &str| {
        serde_json::json!({
            "id": id, "map": "room.yaml", "resolution": 0.2,
            "start": [2.0, 2.0, 0.0], "goal": [10.0, 2.0, 0.0],
            "vehicle": {
                "wheelbase": 0.65, "width": 0.62, "front_overhang": 0.125,
                "rear_overhang": 0.125, "max_steer_deg": 40.0,
            },
        })
    };
    let file =
        serde_json::json!({"version": 1, "scenarios": [scenario("room-0"), scenario("room-1")]});
    room.write("cars.json", file.to_string());
    let peers = "scenario,peer,solved,valid,first_s,length_1s_m,cusps,min_clearance_m,peak_mb\n\
                 room-0,nav2-smac-rs,1,1,900,1000,3,0.1,99\n\
                 room-1,nav2-smac-rs,0,0,2,,,,99\n";
    room.write("peers.csv", peers);
}

#[test]
fn goals_are_told_with_peers_and_without() {
    let room = Room::new();
    cars(&room);
    let run = |out: &str| room.run(&["bench", "cars.json", "--seeds", "2", "--out", out]);
    assert_eq!(run("with").code, 0);
    let (told, page) = (room.read("with/standing.md"), room.read("with/index.html"));
    assert!(told.contains("| solved and certified | all seeds of all 1 scenarios that any peer solves | 2 of 2 runs | yes |"), "{told}");
    assert!(told.contains("| first path, times faster than Smac |"));
    assert!(told.contains("| room-0 nav2-smac-rs | yes | yes | 900000.0 |"));
    assert!(told.contains("| room-1 formicar | 2/2 | 2/2 |"));
    assert_eq!(told.matches(" seed 1 | found |").count(), 2);
    assert!(page.contains("room-0 nav2-smac-rs") && page.contains("Provenance"));
    fs::remove_file(room.path("peers.csv")).unwrap();
    assert_eq!(run("without").code, 0);
    let told = room.read("without/standing.md");
    assert!(told.contains("no `peers.csv` lies beside the scenarios") && !told.contains("Smac |"));
    room.write("peers.csv", "who,what\na,b\n");
    room.run(&["bench", "cars.json", "--out", "wrong"])
        .assert_refused(&["peers.csv"]);
}

#[test]
fn ablations_stand_beside_the_whole() {
    let room = Room::new();
    cars(&room);
    let budget = ["--budget", "3000", "--out", "out"];
    let run = room.run(&[&["bench", "cars.json", "--ablations"], &budget[..]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let told = room.read("out/standing.md");
    let (_, variants) = told.split_once("## Variants").unwrap();
    let rows: Vec<_> = variants
        .lines()
        .filter(|l| l.starts_with("| formicar"))
        .take(9)
        .collect();
    assert_eq!(rows.len(), 9, "{told}");
    assert!(
        rows[0].starts_with("| formicar | 2/2 |") && rows[0].contains("1.0000 | 1.0000 | 1.0000")
    );
    assert!(rows[2].starts_with("| formicar-without-hybrid-astar |"));
    let table = Table::of(&room.read("out/results.csv"));
    assert_eq!(table.rows.len(), 18);
    let both = [
        "bench",
        "cars.json",
        "--ablations",
        "--planners",
        "astar",
        "--out",
        "o",
    ];
    assert_eq!(room.run(&both).code, 2);
}

#[test]
fn worlds_of_barn_are_scenarios_for_any_vehicle() {
    let room = Room::new();
    room.write(
        "barn.json",
        r#"{"radius_m": 0.075, "start": [0, 0, 0], "goal": [4, 0, 0],
            "worlds": {"12": [[2, 1]], "3": [[2, 0]], "7": []}}"#,
    );
    let args = [
        "bench",
        "barn.json",
        "--planners",
        "hybrid-astar",
        "--limit",
        "2",
    ];
    for (out, vehicle) in [
        ("small", &[][..]),
        ("large", &["--vehicle", "warehouse_amr"]),
    ] {
        let run = room.run(&[&args[..], &["--out", out], vehicle].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    }
    let lengths = ["small", "large"].map(|out| {
        let table = Table::of(&room.read(&format!("{out}/results.csv")));
        assert_eq!(table.rows.len(), 2);
        assert_eq!(
            [table.get(0, "scenario"), table.get(1, "scenario")],
            ["barn-003", "barn-012"]
        );
        assert_eq!(table.get(0, "valid"), "true");
        table.get(0, "length_m").parse::<f64>().unwrap()
    });
    // Around the cylinder in the way: the larger vehicle drives farther.
    assert!(4.0 < lengths[0] && lengths[0] < lengths[1], "{lengths:?}");
    let missing = room.run(&["bench", "no/barn.json", "--out", "none"]);
    assert_eq!(missing.code, 2);
    assert!(
        missing.stderr.contains("no/barn.json cannot be read"),
        "{}",
        missing.stderr
    );
}
