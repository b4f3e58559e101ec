//! `list`, `schema`, `completions`, `man`, help, and readers that leave early.

use crate::common::{Room, Run, formicar_in};
use std::io::Read;
use std::process::{Command, Stdio};

fn run(args: &[&str]) -> Run {
    formicar_in(&std::env::temp_dir(), args, "")
}

#[test]
fn lists_what_there_is() {
    insta::assert_snapshot!(run(&["list", "planners"]).stdout);
    insta::assert_snapshot!(run(&["list", "vehicles"]).stdout);
    let maps = run(&["list", "maps"]).stdout;
    assert!(
        maps.contains("warehouse") && maps.contains("lei-map1"),
        "{maps}"
    );
    assert!(run(&["list", "scenarios"]).stdout.contains("warehouse"));
    run(&["list", "maps", "file"]).assert_refused(&["list scenarios"]);
    run(&["list", "ants"]).assert_refused(&["ants", "planners"]);
}

#[test]
fn schemas_are_json_with_doc_text() {
    for (document, key) in [
        ("config", "hybrid_astar"),
        ("vehicle", "wheelbase_m"),
        ("request", "goal_tolerance"),
        ("answer", "certificate"),
        ("track", "summary"),
    ] {
        let schema = run(&["schema", document]);
        assert_eq!(schema.code, 0);
        let schema: serde_json::Value = serde_json::from_str(&schema.stdout).unwrap();
        assert!(schema["properties"][key].is_object(), "{document}");
    }
}

#[test]
fn the_help_names_every_flag() {
    insta::assert_snapshot!(run(&["plan", "-h"]).stdout);
    assert_eq!(run(&["--version"]).code, 0);
    assert!(run(&["man"]).stdout.contains("formicar"));
    assert!(run(&["completions", "bash"]).stdout.contains("--keep-out"));
    assert_eq!(run(&[]).code, 2);
}

#[test]
fn a_reader_that_leaves_is_no_crash() {
    let room = Room::new();
    let mut child = Command::new(env!("CARGO_BIN_EXE_formicar"))
        .args(["plan", "--map", "room.yaml", "--start", "2,2,0", "--stdin"])
        .current_dir(room.folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut stdin = child.stdin.take().unwrap();
    let _ = std::io::Write::write_all(
        &mut stdin,
        b"{\"goal\": [4, 5, 1]}\n{\"goal\": [4, 5, 1]}\n",
    );
    drop(stdin);
    let mut told = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut told)
        .unwrap();
    assert_eq!((child.wait().unwrap().code(), told.as_str()), (Some(0), ""));
}
