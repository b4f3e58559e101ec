//! Campaigns: what a kill leaves, what is refused, and what `compare` and `report` make of stores.

use crate::common::{Room, Run, Table};
use formicar_lab::campaign::Stored;
use std::fs;
use std::process::{Command, Stdio};

fn column(text: &str, name: &str) -> Vec<String> {
    let table = Table::of(text);
    table.column(name).into_iter().map(str::to_owned).collect()
}

/// 2 scenarios x 2 vehicles x 2 motion modes x 2 planners x 3 seeds.
const CAMPAIGN: &str = r#"
name = "junctions"
seeds = 3
motion = ["reverse", "forward"]
budget_steps = 500
vehicles = ["own", "f1tenth"]

[[scenarios]]
builtin = ["narrow-junction"]

[[planner]]
planner = "hybrid-astar"

[[planner]]
name = "heavy"
planner = "hybrid-astar"
set = ["hybrid_astar.weight=2"]
"#;

fn bench(room: &Room, store: &str) -> Run {
    room.run(&["bench", "c.toml", "--jobs", "2", "--store", store])
}

/// How many runs a store holds, read beside the process that writes it.
fn n_stored(room: &Room, store: &str) -> usize {
    Stored::read(&room.path(store)).map_or(0, |stored| stored.runs.len())
}

/// Kills a campaign when its store holds some runs, and says how many; nothing where the campaign
/// was over before.
#[cfg(unix)]
fn killed_midway(room: &Room, store: &str) -> Option<usize> {
    let _ = fs::remove_file(room.path(store));
    let mut child = Command::new(env!("CARGO_BIN_EXE_formicar"))
        .args(["bench", "c.toml", "--jobs", "2", "--store", store])
        .current_dir(room.folder.path())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let n_before = loop {
        let n = n_stored(room, store);
        if n >= 5 || child.try_wait().unwrap().is_some() {
            break n;
        }
    };
    child.kill().unwrap();
    (!child.wait().unwrap().success()).then_some(n_before)
}

#[test]
#[cfg(unix)]
fn a_killed_campaign_goes_on_and_ends_like_an_undisturbed_one() {
    let room = Room::new();
    room.write("c.toml", CAMPAIGN);
    let run = bench(&room, "whole.sqlite");
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(
        run.stdout
            .contains("48 runs: see whole.sqlite and whole.csv")
    );
    // On a busy machine a campaign may end before it is looked at.
    let n_before = (0..50)
        .find_map(|_| killed_midway(&room, "torn.sqlite"))
        .expect("it was killed");
    assert!((5..48).contains(&n_before), "{n_before}");
    let n_kept = n_stored(&room, "torn.sqlite");
    assert!((n_before..48).contains(&n_kept));
    let run = bench(&room, "torn.sqlite");
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let told = format!("{} runs, {n_kept} kept from before", 48 - n_kept);
    run.assert_says(&told);
    let (whole, torn) = (room.read("whole.csv"), room.read("torn.csv"));
    assert_eq!(
        Table::of(&torn).repeatable(),
        Table::of(&whole).repeatable()
    );
    let mut keys = column(&torn, "run");
    keys.sort();
    keys.dedup();
    assert_eq!(keys.len(), 48);
    assert!(
        bench(&room, "torn.sqlite")
            .stdout
            .contains("0 runs, 48 kept")
    );
    assert_eq!(room.read("torn.csv"), torn);
    assert!(!room.path("torn.sqlite.lock").exists());
}

#[test]
fn every_row_says_where_it_comes_from() {
    let room = Room::new();
    room.write("c.toml", CAMPAIGN);
    assert_eq!(bench(&room, "s.sqlite").code, 0);
    let text = room.read("s.csv");
    assert!(text.starts_with("scenario,planner,seed,status,valid,map_setup_s,"));
    for name in [
        "version",
        "machine",
        "config_hash",
        "map_hash",
        "vehicle_hash",
    ] {
        assert!(column(&text, name).iter().all(|v| !v.is_empty()), "{name}");
    }
    let distinct = |name: &str| {
        let mut values = column(&text, name);
        values.sort();
        values.dedup();
        values.len()
    };
    assert_eq!(distinct("config_hash"), 2);
    assert_eq!((distinct("map_hash"), distinct("vehicle_hash")), (1, 2));
    assert_eq!(column(&text, "budget_steps")[0], "500");
    let order: Vec<_> = ["scenario", "vehicle", "motion", "planner", "seed"]
        .map(|name| column(&text, name))
        .into();
    let row = |i: usize| order.iter().map(|of| of[i].as_str()).collect::<Vec<_>>();
    let first = "narrow-junction-quarter-turn";
    assert_eq!(row(0), [first, "own", "reverse", "hybrid-astar", "0"]);
    assert_eq!(row(5), [first, "own", "reverse", "heavy", "2"]);
    assert_eq!(row(6), [first, "own", "forward", "hybrid-astar", "0"]);
    assert_eq!(row(12), [first, "f1tenth", "reverse", "hybrid-astar", "0"]);
    // Another campaign does not get in.
    room.write("c.toml", CAMPAIGN.replace("seeds = 3", "seeds = 4"));
    bench(&room, "s.sqlite").assert_refused(&["s.sqlite", "64 runs, of which 48", "--store"]);
    assert_eq!(room.read("s.csv"), text);
}

#[test]
fn scenario_files_are_beside_the_campaign_file() {
    let room = Room::new();
    fs::create_dir(room.path("sub")).unwrap();
    let scenario = |id: &str| {
        serde_json::json!({
            "id": id, "map": "../room.yaml", "resolution": 0.2,
            "start": [2.0, 2.0, 0.0], "goal": [10.0, 2.0, 0.0],
            "vehicle": {
                "wheelbase": 0.65, "width": 0.62, "front_overhang": 0.125,
                "rear_overhang": 0.125, "max_steer_deg": 40.0,
            },
        })
    };
    let all: Vec<_> = ["a", "b", "c"].into_iter().map(scenario).collect();
    let file = serde_json::json!({"version": 1, "scenarios": all});
    room.write("sub/cars.json", file.to_string());
    room.write("sub/heavy.toml", "[hybrid_astar]\nweight = 3.0\n");
    let campaign = "[[scenarios]]\nfile = \"cars.json\"\nids = [\"c\", \"a\"]\n\
                    [[planner]]\nplanner = \"hybrid-astar\"\nconfig = \"heavy.toml\"\n";
    room.write("sub/c.toml", campaign);
    let run = room.run(&["bench", "sub/c.toml", "--store", "s.sqlite"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(column(&room.read("s.csv"), "scenario"), ["c", "a"]);
    // Flags can fill a store too.
    let flags = ["bench", "sub/cars.json", "--planners", "hybrid-astar"];
    let run = room.run(&[&flags[..], &["--store", "f.sqlite"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let run = room.run(&["compare", "s.sqlite", "f.sqlite"]);
    run.assert_says("2 pairs of runs.");
    run.assert_says("left out: 0 and 1");
}

/// What stands at the beginning of a file, and words of what is said of it.
const MISTAKES: [(&str, &[&str]); 17] = [
    (
        "seeds = { from = 5, to = 2 }\n",
        &["line 1, seeds: from = 5 must not exceed to = 2"],
    ),
    (
        "[[planner]]\nplanner = \"formicar\"\n[planner.config]\ndrive = 3\n",
        &["line 4, drive: drive: ", "`3`, expected a table\n"],
    ),
    (
        "[[planner]]\nplanner = \"formicar\"\n[planner.config.drive]\nn_ants = 3\nbeta = \"x\"\n",
        &["line 5, beta: drive.beta: ", "\"x\"", "a finite number"],
    ),
    (
        "[[planner]]\nplanner = \"formicar\"\n[planner.config.drive.repair]\n\
         toll_per_death = \"x\"\n",
        &["line 4, toll_per_death: drive.repair.toll_per_death: "],
    ),
    (
        "[[planner]]\nplanner = \"formicar\"\n[planner.config.hybrid_astar]\nweight = nan\n",
        &["line 4, weight: hybrid_astar.weight: nan or inf"],
    ),
    (
        "[[planner]]\nplanner = \"formicar\"\nset = [\"hybrid_astar.weight=nan\"]\n",
        &[
            "line 3, set",
            "weight",
            "nan or inf, expected a finite number",
        ],
    ),
    ("sedes = 3\n", &["c.toml, line 1, sedes", "`seeds`"]),
    (
        "seeds = \"a\"\n",
        &["c.toml, line 1, seeds", "a count from 1"],
    ),
    (
        "vehicles = [\"own\",\n \"tank\"]\n",
        &["line 2, vehicles", "tank", "lei2020", "own"],
    ),
    (
        "[[planner]]\nplanner = \"rrt\"\n",
        &["line 2, planner", "rrt", "hybrid-astar"],
    ),
    (
        "[[planner]]\nplanner = \"astar\"\n[planner.config.hybrid_astar]\nwieght = 2\n",
        &[
            "line 4, wieght",
            "hybrid_astar.wieght",
            "hybrid_astar.weight",
        ],
    ),
    (
        "[[planner]]\nplanner = \"astar\"\nset = [\n  \"hybrid_astar.weight=0\",\n]\n",
        &["line 4, set", "weight"],
    ),
    (
        "[[planner]]\nplanner = \"hybrid-astar\"\n[planner.config.hybrid_astar]\nweight = 0\n",
        &["line 4, weight", "hybrid_astar.weight"],
    ),
    (
        "[[planner]]\nplanner = \"astar\"\nconfig = 3\n",
        &["line 3, config", "a table"],
    ),
    (
        "[[scenarios]]\nbuiltin = [\"nowhere\"]\n",
        &["line 2, builtin", "nowhere", "narrow"],
    ),
    (
        "[[scenarios]]\nfile = \"no.json\"\n",
        &["line 2, file", "no.json"],
    ),
    (
        "[[scenarios]]\nbuiltin = [\"narrow-junction\"]\nids = [\"x\"]\n",
        &["line 3, ids", "\"x\"", "quarter-turn"],
    ),
];

#[test]
fn wrong_campaigns_name_file_line_key_and_what_is_allowed() {
    let room = Room::new();
    let good = "[[scenarios]]\nbuiltin = [\"narrow-junction\"]\n";
    for (text, words) in MISTAKES {
        room.write("c.toml", format!("{text}{good}"));
        bench(&room, "s.sqlite").assert_refused(words);
    }
    room.write("c.toml", good);
    room.run(&["bench", "c.toml", "--out", "out"])
        .assert_refused(&["--store"]);
    room.run(&["bench", "c.toml", "--store", "s.sqlite", "--seeds", "2"])
        .assert_refused(&["--seeds", "c.toml"]);
    assert!(!room.path("s.sqlite").exists());
    bench(&room, "nowhere/s.sqlite")
        .assert_refused(&["nowhere/s.sqlite: there is no folder nowhere"]);
    room.write("text.sqlite", "no store");
    bench(&room, "text.sqlite").assert_refused(&["text.sqlite", "no store of campaigns"]);
    let run = room.run(&["report", "text.sqlite", "--out", "r"]);
    run.assert_refused(&[
        "text.sqlite",
        "expected the SQLite file that `bench --store",
    ]);
    assert!(!run.stderr.contains("another --store"), "{}", run.stderr);
    room.run(&["report", "none.sqlite", "--out", "r"])
        .assert_refused(&["none.sqlite"]);
}

#[test]
fn a_store_that_its_table_would_be_written_over_is_refused_before_any_run() {
    let room = Room::new();
    room.write("c.toml", "[[scenarios]]\nbuiltin = [\"narrow-junction\"]\n");
    bench(&room, "z.csv").assert_refused(&["--store z.csv", "hint: --store z.sqlite"]);
    let flags = ["bench", "narrow-junction", "--store", "z.csv"];
    room.run(&flags).assert_refused(&["--store z.csv"]);
    assert!(!room.path("z.csv").exists());
}

#[test]
fn tables_of_no_runs_are_refused() {
    let room = Room::new();
    let header = "scenario,planner,seed,status,valid\n";
    let report = |rows: &str| {
        room.write("r.csv", format!("{header}{rows}"));
        room.run(&["report", "r.csv", "--out", "page"])
    };
    report("").assert_refused(&["r.csv", "line 1", "a row for each run"]);
    report("a,b,0,found,true\na,b,1,fnd,true\n").assert_refused(&[
        "r.csv",
        "line 3",
        "\"fnd\"",
        "found, no_path",
    ]);
    assert!(!room.path("page").exists());
    let run = report("a,b,0,found,true\n");
    run.assert_says("\n1 run: see");
}

#[test]
fn what_is_worse_is_told() {
    let room = Room::new();
    let campaign = |budget: u32| {
        format!(
            "budget_steps = {budget}\n[[scenarios]]\nbuiltin = [\"narrow\"]\n\
             [[planner]]\nplanner = \"hybrid-astar\"\n"
        )
    };
    for (name, budget) in [("much", 2000), ("little", 60)] {
        room.write("c.toml", campaign(budget));
        let run = bench(&room, &format!("{name}.sqlite"));
        assert_eq!(run.code, 0, "{}", run.stderr);
    }
    let compare = |more: &[&str]| room.run(&[&["compare"], more].concat());
    let run = compare(&["much.csv", "little.sqlite", "--fail-on-lost"]);
    assert_eq!(run.code, 3, "{}{}", run.stdout, run.stderr);
    assert!(
        run.stdout.starts_with("# little beside much"),
        "{}",
        run.stdout
    );
    run.assert_says("budget_steps differ");
    let run = compare(&[
        "much.sqlite",
        "much.csv",
        "--fail-on-worse",
        "--fail-on-lost",
    ]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let run = compare(&["much.sqlite", "much.csv", "--results-only"]);
    assert!(run.stdout.contains("| length m |") && !run.stdout.contains("| query ms |"));
    let run = compare(&["much.sqlite", "little.sqlite", "--json", "--out", "cmp"]);
    assert_eq!(run.code, 0);
    assert_eq!(run.json()["duels"][0]["findings"][0]["metric"], "success");
    assert_eq!(room.files().iter().filter(|f| *f == "cmp").count(), 1);
    assert!(room.read("cmp/index.html").contains("little beside much"));
    let run = room.run(&["report", "much.sqlite", "little.sqlite", "--out", "both"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let page = room.read("both/index.html");
    assert!(page.contains("hybrid-astar (much)") && page.contains("hybrid-astar (little)"));
    assert!(room.read("both/tables.tex").contains("\\toprule"));
    room.write("c.csv", "a,b\n1,2\n");
    compare(&["much.sqlite", "c.csv"]).assert_refused(&["c.csv", "scenario"]);
}

#[test]
fn a_build_beside_itself_is_not_worse() {
    let room = Room::new();
    let text = "budget_steps = 200\nseeds = 2\n[[scenarios]]\nbuiltin = [\"narrow-junction\"]\n";
    room.write("c.toml", text);
    let this = env!("CARGO_BIN_EXE_formicar");
    let run = room.run(&["compare", "c.toml", "--with", this, "--json", "--out", "o"]);
    assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
    let duel = &run.json()["duels"][0];
    assert_eq!(duel["n_pairs"], 4);
    for finding in duel["findings"].as_array().unwrap() {
        let name = finding["metric"].as_str().unwrap();
        if [
            "success",
            "length m",
            "cost m",
            "clearance m",
            "cusps",
            "steps",
        ]
        .contains(&name)
        {
            assert_eq!(finding["n_equal"], finding["n_pairs"], "{name}");
        }
    }
    assert_eq!(
        Table::of(&room.read("o/a.csv")).repeatable(),
        Table::of(&room.read("o/b.csv")).repeatable()
    );
    room.run(&["compare", "c.toml", "--with", "/bin/true"])
        .assert_refused(&["/bin/true", "no formicar"]);
}

#[test]
fn the_example_of_the_book_runs() {
    let room = Room::new();
    let book = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/src/campaigns.md");
    let page = fs::read_to_string(book).unwrap();
    let (_, example) = page.split_once("```toml\n").unwrap();
    let (example, _) = example.split_once("```").unwrap();
    room.write("junctions.toml", example);
    let run = room.run(&[
        "bench",
        "junctions.toml",
        "--store",
        "j.sqlite",
        "--jobs",
        "2",
    ]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    run.assert_says("32 runs: see j.sqlite");
    let run = room.run(&["report", "j.sqlite", "--out", "junctions"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.starts_with("# junctions\n"), "{}", run.stdout);
    // What the book says of a wrong file.
    room.write(
        "junctions.toml",
        example.replacen("\"hybrid-astar\"", "\"rrt\"", 1),
    );
    let told = page.split_once("error: junctions.toml, ").unwrap().1;
    let told = told.split_once(", hybrid-astar").unwrap().0;
    room.run(&["bench", "junctions.toml", "--store", "j.sqlite"])
        .assert_refused(&[told]);
}
