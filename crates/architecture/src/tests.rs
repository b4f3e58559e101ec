//! The checks on the crates of this workspace, and on faults planted in made-up ones.
#![allow(clippy::unwrap_used, reason = "a test suite: its helpers may fail")]

use crate::{
    CLI, Crate, DRIVE, LAB, LIBRARY, MAPPING, PYTHON, Purity, RECORD, STUDIO, circles,
    purity_faults, rank_faults,
};
use std::fs;
use std::path::Path;

/// The parts of the library that may reach out.
const PURITY: Purity = Purity {
    files: "map/format",
    threads: "colony/worker_pool.rs",
    clock: "progress/clock.rs",
};

#[test]
fn modules_of_the_library_use_only_modules_of_lower_rank() {
    report(&rank_faults(&Crate::read("formicar"), LIBRARY));
}

#[test]
fn modules_of_the_command_line_use_only_modules_of_lower_rank() {
    report(&rank_faults(&Crate::read("formicar-cli"), CLI));
}

#[test]
fn modules_of_the_lab_use_only_modules_of_lower_rank() {
    report(&rank_faults(&Crate::read("formicar-lab"), LAB));
}

#[test]
fn modules_of_drive_use_only_modules_of_lower_rank() {
    report(&rank_faults(&Crate::read("formicar-drive"), DRIVE));
}

#[test]
fn modules_of_mapping_use_only_modules_of_lower_rank() {
    report(&rank_faults(&Crate::read("formicar-mapping"), MAPPING));
}

#[test]
fn modules_of_bags_use_only_modules_of_lower_rank() {
    report(&rank_faults(&Crate::read("formicar-record"), RECORD));
}

#[test]
fn modules_of_the_studio_use_only_modules_of_lower_rank() {
    report(&rank_faults(&Crate::read("formicar-studio"), STUDIO));
}

#[test]
fn modules_of_the_python_package_use_only_modules_of_lower_rank() {
    report(&rank_faults(&Crate::read("formicar-py"), PYTHON));
}

/// Parts of the library whose files still use each other in circles. The list only gets shorter.
const OPEN: [&str; 3] = ["map/format/", "planner/", "scenario/"];

#[test]
fn files_do_not_use_each_other_in_circles() {
    let is_open = |file: &String| OPEN.iter().any(|part| file.starts_with(part));
    let crates = [
        "formicar",
        "formicar-cli",
        "formicar-lab",
        "formicar-drive",
        "formicar-mapping",
        "formicar-py",
        "formicar-record",
        "formicar-studio",
    ];
    let found = crates.iter().flat_map(|name| {
        let circles = circles(&Crate::read(name)).into_iter();
        let circles = circles.filter(|circle| *name != "formicar" || !circle.iter().all(is_open));
        circles.map(move |circle| format!("{name}: {}", circle.join(", ")))
    });
    report(&found.collect::<Vec<_>>());
}

#[test]
fn the_libraries_do_not_touch_the_outside_world() {
    report(&purity_faults(&Crate::read("formicar"), &PURITY));
    let nowhere = Purity {
        files: "no folder",
        threads: "no file",
        clock: "no file",
    };
    report(&purity_faults(&Crate::read("formicar-drive"), &nowhere));
    report(&purity_faults(&Crate::read("formicar-mapping"), &nowhere));
    report(&purity_faults(&Crate::read("formicar-record"), &nowhere));
}

#[test]
fn every_file_of_tests_is_a_module_of_its_binary() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut faults = Vec::new();
    for entry in fs::read_dir(crates).unwrap() {
        let tests = entry.unwrap().path().join("tests");
        let Ok(main) = fs::read_to_string(tests.join("main.rs")) else {
            continue;
        };
        for file in fs::read_dir(&tests).unwrap() {
            let file = file.unwrap().path();
            let module = format!("mod {};", file.file_stem().unwrap().display());
            let is_suite =
                file.extension().is_some_and(|e| e == "rs") && !file.ends_with("main.rs");
            if is_suite && !main.lines().any(|line| line == module) {
                faults.push(format!("{}: not in main.rs", file.display()));
            }
        }
    }
    report(&faults);
}

#[test]
fn planted_faults_are_found() {
    let faults = |name: &str, text: &str| {
        let planted = Crate::of([("lib.rs", ""), (name, text)]);
        rank_faults(&planted, LIBRARY).len() + purity_faults(&planted, &PURITY).len()
    };
    for bad in [
        "use crate::planner::Planner;",
        "use crate::{\n    geometry::Pose2,\n    search::{astar, GoalField},\n};",
        "fn f() { crate::search::astar() }",
        "use crate :: render;",
        "pub use crate::*;",
        "use super::super::search;",
        "mod tests {\n    use super::super::cell;\n}",
        "use crate as home;",
        "use ::std::{collections::BTreeMap, fs};",
        "fn f() { std::env::var(\"HOME\") }",
        "fn f() { println!(\"here\") }",
        "use std::time::{Duration, Instant};",
        "fn f() { let fields = [crate::search::GoalField::new()]; }",
        "fn f(field: &crate::search::GoalField<f64>) {}",
    ] {
        assert_eq!(faults("map/grid.rs", bad), 1, "{bad}");
    }
    assert_eq!(faults("map.rs", "use super::search::astar;"), 1);
    assert_eq!(faults("map/mod.rs", "use super::{geometry, search};"), 1);
    for good in [
        "use crate::geometry::{Pose2, angle};\nuse crate::map::Cell;",
        "//! Not [`crate::search`].\n/* crate::planner */ pub(crate) fn f<'a>(c: &'a char) {}",
        "const S: &str = \"crate::search, println!, std::fs\"; const Q: char = '\"';",
        "const R: &str = r#\"use \"crate::search\";\"#;",
        "use super::search::astar;",
        "use std::time::Duration;\nuse std::{fmt, io};",
    ] {
        assert_eq!(faults("map/grid.rs", good), 0, "{good}");
    }
    assert_eq!(faults("map/format/files.rs", "use std::fs::File;"), 0);
    assert_eq!(faults(PURITY.threads, "use std::thread;"), 0);
    assert_eq!(faults(PURITY.threads, "use std::fs::File;"), 1);
    assert_eq!(faults(PURITY.clock, "use std::time::Instant;"), 0);
    assert_eq!(faults("colony/ant.rs", "use std::thread;"), 1);
    assert_eq!(faults("map/formation.rs", "use std::fs::File;"), 1);
}

#[test]
fn modules_without_a_rank_are_found() {
    let planted = Crate::of([("lib.rs", "mod map;\npub mod atlas;"), ("atlas.rs", "")]);
    assert_eq!(
        rank_faults(&planted, LIBRARY),
        ["module `atlas` has no rank"]
    );
}

#[test]
fn ranks_may_go_deeper_than_the_root() {
    let ranks = [
        "low",
        "commands::bench",
        "commands::compare",
        "commands",
        "cli",
    ];
    let faults = |name: &str, text: &str| {
        rank_faults(&Crate::of([("main.rs", ""), (name, text)]), &ranks).len()
    };
    assert_eq!(
        faults(
            "commands/compare/mod.rs",
            "use crate::commands::bench::run;"
        ),
        0
    );
    assert_eq!(
        faults("commands/compare/mod.rs", "use super::bench::run;"),
        0
    );
    assert_eq!(faults("commands/bench.rs", "use super::compare;"), 1);
    assert_eq!(faults("commands/bench.rs", "use crate::cli::Cli;"), 1);
}

#[test]
fn circles_are_found_through_what_is_handed_on() {
    let root = ("lib.rs", "mod a;\nmod b;");
    let names = |files: &[(&str, &str)]| circles(&Crate::of([&[root], files].concat()));
    let handed_on = [
        (
            "a/mod.rs",
            "mod cell;\nmod grid;\npub use cell::Cell;\npub use grid::Grid;",
        ),
        ("a/cell.rs", "pub struct Cell;"),
        ("a/grid.rs", "use super::Cell;\npub struct Grid(Cell);"),
        ("b.rs", "use crate::a::Grid;\nfn f(grid: &Grid) {}"),
    ];
    assert!(names(&handed_on).is_empty());
    let circle = [
        ("a/mod.rs", "mod cell;\npub use cell::Cell;"),
        (
            "a/cell.rs",
            "use crate::b;\npub struct Cell;\nfn f() { b::go() }",
        ),
        ("b.rs", "use crate::a::Cell;\npub fn go() -> Cell { Cell }"),
    ];
    assert_eq!(names(&circle), [["a/cell.rs", "b.rs"]]);
    let parent = [
        (
            "a/mod.rs",
            "mod cell;\npub struct Frame;\nfn f() { cell::go() }",
        ),
        ("a/cell.rs", "use super::Frame;\npub fn go() {}"),
        ("b.rs", ""),
    ];
    assert_eq!(names(&parent), [["a/cell.rs", "a/mod.rs"]]);
    let tests = [
        (
            "a.rs",
            "pub struct Cell;\n#[cfg(test)]\nmod tests { use crate::b::go; }",
        ),
        ("b.rs", "use crate::a::Cell;\npub fn go() -> Cell { Cell }"),
    ];
    assert!(names(&tests).is_empty());
}

fn report(faults: &[String]) {
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults.join("\n")
    );
}
