//! `demo`: its page holds together, and whatever it calls found is certified.

use crate::common::{Run, formicar_in};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Runs of every chapter, with a way and without, but those of ants.
const QUICK: [&str; 4] = [
    "lei-map1.across",
    "wang-open",
    "quarter-turn",
    "other-street",
];

/// Ants, of which films are made.
const ANTS: &str = "lei-map1.lei2020";

fn demo(folder: &Path, runs: &[&str]) -> Run {
    let only = runs.iter().flat_map(|run| ["--only", run]);
    let args: Vec<&str> = ["demo", "--out", "shown"].into_iter().chain(only).collect();
    let run = formicar_in(folder, &args, "");
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    run
}

/// The answers by file name, without their times.
fn answers(folder: &Path) -> BTreeMap<String, Value> {
    let entries = fs::read_dir(folder.join("shown/runs")).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let answer = |name: String| {
        let text = fs::read_to_string(folder.join("shown/runs").join(&name)).unwrap();
        let mut answer: Value = serde_json::from_str(&text).unwrap();
        answer["timing"].take();
        (name, answer)
    };
    let json = |name: &String| Path::new(name).extension().is_some_and(|e| e == "json");
    names.filter(json).map(answer).collect()
}

/// The values of an attribute in HTML.
fn values<'a>(page: &'a str, attribute: &str) -> Vec<&'a str> {
    let start = format!(" {attribute}=\"");
    let rest = page.split(start.as_str()).skip(1);
    rest.map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn a_demo_holds_together_and_another_differs_in_times_alone() {
    let folders = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let [first, second] = folders.each_ref().map(tempfile::TempDir::path);
    let run = demo(first, &[&QUICK[..], &[ANTS]].concat());
    demo(second, &QUICK);
    run.assert_says("index.html");
    assert_every_link_of_the_page_resolves(first);
    assert_what_is_found_is_certified_and_the_rest_is_explained(first);
    let again = answers(second);
    assert_eq!(again.len(), QUICK.len());
    for (name, answer) in &again {
        assert_eq!(answers(first)[name], *answer, "{name}");
    }
}

fn assert_every_link_of_the_page_resolves(folder: &Path) {
    let page = fs::read_to_string(folder.join("shown/index.html")).unwrap();
    let ids = values(&page, "id");
    assert_eq!(ids.len(), QUICK.len() + 1);
    let links = ["href", "src", "srcset"].map(|attribute| values(&page, attribute));
    assert!(links.iter().all(|links| links.len() >= ids.len()));
    for link in links.concat() {
        match link.strip_prefix('#') {
            Some(id) => assert!(ids.contains(&id), "{link}"),
            None if link.starts_with("data:") => {}
            None => assert!(folder.join("shown").join(link).is_file(), "{link}"),
        }
    }
    assert!(!page.contains("http"), "the page needs no network");
}

fn assert_what_is_found_is_certified_and_the_rest_is_explained(folder: &Path) {
    let answers = answers(folder);
    assert_eq!(answers.len(), QUICK.len() + 1);
    for (name, answer) in &answers {
        if answer["status"] == "found" {
            let certificate = &answer["certificate"];
            assert_eq!(certificate["valid"], true, "{name}");
            assert_eq!(
                certificate["violations"],
                Value::Array(Vec::new()),
                "{name}"
            );
        } else {
            let reason = answer["reason"].as_str().unwrap_or_default();
            assert!(!reason.is_empty() && answer["path"].is_null(), "{name}");
        }
    }
    assert_eq!(
        answers["u-turn-street.other-street.json"]["status"],
        "no_path"
    );
    let again = [
        "check",
        "shown/runs/lei-map1.across.json",
        "--map",
        "lei-map1",
        "--vehicle",
        "lei2020",
    ];
    let checked = formicar_in(folder, &again, "");
    assert_eq!(checked.code, 0, "{}", checked.stdout);
}

#[test]
fn a_folder_that_cannot_be_made_is_refused_before_planning() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let run = formicar_in(folder.path(), &["demo", "--out", "file/demo"], "");
    run.assert_refused(&["file/demo", "hint"]);
    let unknown = formicar_in(folder.path(), &["demo", "--only", "nowhere"], "");
    unknown.assert_refused(&["nowhere"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
