//! What `report` tells of a campaign beside its numbers: parameters with their origins, how it was
//! run, names for LaTeX; and what it refuses to count twice.

use crate::common::Room;
use formicar_lab::tuning::tuned_text;
use std::fs;

const CAMPAIGN: &str = r#"
name = "slow & fast, 2nd"
budget_steps = 300

[[scenarios]]
builtin = ["narrow-junction"]
limit = 1

[[planner]]
planner = "hybrid-astar"

[[planner]]
name = "tuned"
planner = "hybrid-astar"
config = "tuned.toml"

[[planner]]
name = "by-hand"
planner = "hybrid-astar"
config = "tuned.toml"
set = ["hybrid_astar.weight=3"]

[[planner]]
planner = "lei2020"
set = ["colony.n_ants=7"]
"#;

/// A room with the store of the campaign, `s.sqlite`.
fn room() -> Room {
    let room = Room::new();
    let values = serde_json::json!({"planner": "hybrid-astar", "hybrid_astar": {"weight": 2.0}});
    room.write("tuned.toml", tuned_text(&values).unwrap());
    room.write("c.toml", CAMPAIGN);
    let run = room.run(&["bench", "c.toml", "--store", "s.sqlite", "--jobs", "2"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    room
}

#[test]
fn every_parameter_has_its_origin() {
    let room = room();
    let run = room.run(&["report", "s.sqlite", "--out", "r"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(!run.stdout.contains("## Parameters"), "{}", run.stdout);
    let summary = room.read("r/summary.md");
    let (_, parameters) = summary.split_once("## Parameters").unwrap();
    for line in [
        "| tuned | `hybrid_astar.weight` | 2.0 |",
        "| by-hand | `hybrid_astar.weight` | 3.0 |",
        "| lei2020 | `colony.n_ants` | 7 | 500 |",
    ] {
        assert!(parameters.contains(line), "no {line} in {parameters}");
    }
    let origin = |begin: &str| {
        let row = parameters.lines().find(|line| line.starts_with(begin));
        let row = row.unwrap_or_else(|| panic!("no {begin} in {parameters}"));
        row.trim_end_matches(" |")
            .rsplit(" | ")
            .next()
            .unwrap()
            .to_owned()
    };
    assert_eq!(origin("| tuned | `hybrid_astar.weight`"), "tuned");
    assert_eq!(origin("| by-hand | `hybrid_astar.weight`"), "chosen");
    assert_eq!(origin("| lei2020 | `colony.n_ants`"), "chosen");
    assert!(
        parameters.contains("| stated | sec. IV.B |"),
        "{parameters}"
    );
    let page = room.read("r/index.html");
    assert!(page.contains("<details class=\"sheet\"><summary id=\"about-parameters-lei2020\">"));
    assert!(page.contains(".sheet::details-content { content-visibility: visible;"));
    assert!(page.contains("<dt>Runs at once</dt><dd>2</dd>"));
    // A table knows no configurations.
    let run = room.run(&["report", "s.csv", "--out", "t"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(!room.read("t/summary.md").contains("## Parameters"));
}

#[test]
fn latex_is_named_after_the_campaign() {
    let room = room();
    assert_eq!(room.run(&["report", "s.sqlite", "--out", "r"]).code, 0);
    let tex = room.read("r/tables.tex");
    for part in [
        "\\label{tab:slow-fast-2nd-planners}",
        "\\label{tab:slow-fast-2nd-compare-tuned}",
        "\\newcommand{\\slowFastTwoNdPlannersTunedSolved}",
        "\\begin{longtable}",
    ] {
        assert!(tex.contains(part), "no {part} in {tex}");
    }
}

#[test]
fn a_file_named_twice_is_refused() {
    let room = room();
    fs::create_dir(room.path("sub")).unwrap();
    for other in ["s.sqlite", "./s.sqlite", "sub/../s.sqlite"] {
        let told = [other, "the same file as s.sqlite"];
        room.run(&["report", "s.sqlite", other, "--out", "r"])
            .assert_refused(&told);
        room.run(&["compare", "s.sqlite", other])
            .assert_refused(&told);
    }
    // The table of a store holds the same runs.
    let run = room.run(&["report", "s.sqlite", "s.csv", "--out", "r"]);
    run.assert_refused(&[
        "s.csv and s.sqlite hold the same run of hybrid-astar",
        "seed 0",
    ]);
    assert!(!room.path("r").exists());
}

#[test]
#[cfg(unix)]
fn a_link_to_a_file_is_that_file() {
    let room = room();
    std::os::unix::fs::symlink(room.path("s.sqlite"), room.path("link.sqlite")).unwrap();
    let run = room.run(&["report", "s.sqlite", "link.sqlite", "--out", "r"]);
    run.assert_refused(&["link.sqlite: the same file as s.sqlite"]);
}

#[test]
fn the_page_of_one_run_has_its_parameters_too() {
    let room = Room::new();
    let flags = ["bench", "narrow-junction", "--planners", "hybrid-astar"];
    let more = [
        "--budget",
        "300",
        "--limit",
        "1",
        "--set",
        "hybrid_astar.weight=2",
    ];
    let run = room.run(&[&flags[..], &more, &["--out", "o"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let n_runs = room.read("o/results.csv").lines().count() - 1;
    let told = formicar::numeric::counted(n_runs, "run");
    run.assert_says(&format!("\n{told}: see o"));
    let page = room.read("o/index.html");
    assert!(
        page.contains("<h2>Parameters</h2>") && page.contains("<td class=\"words\">chosen</td>")
    );
    let again = room.run(&[&flags[..], &more, &["--out", "o"]].concat());
    again.assert_says("\n0 runs, ");
}
