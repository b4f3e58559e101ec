//! Pages that must keep step with the code: links, the table of parameters, the first example.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test suite: helpers outside of tests may fail and say that they skip"
)]

use formicar::planner::HybridAstarConfig;
use formicar::smoothing::SmoothingConfig;
use schemars::schema_for;
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the whole project; none where the crate was published without it.
fn project() -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let found = root.join("docs/src/SUMMARY.md").exists();
    if !found {
        println!("no project around this crate: nothing to compare");
    }
    found.then_some(root)
}

fn pages(root: &Path) -> Vec<PathBuf> {
    let folders = [".", "docs/src", "crates/formicar"];
    let files = folders.iter().flat_map(|folder| {
        let entries = fs::read_dir(root.join(folder)).unwrap();
        entries.map(|entry| entry.unwrap().path())
    });
    files
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .collect()
}

/// Targets of Markdown links and pictures.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let targets = text.split("](").skip(1);
    targets.filter_map(|rest| rest.split(')').next())
}

/// The anchor that a heading gets.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase();
    kept.chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

#[test]
fn links_lead_somewhere() {
    let Some(root) = project() else { return };
    let mut n_links = 0;
    for page in pages(&root) {
        let text = fs::read_to_string(&page).unwrap();
        for link in links(&text).filter(|link| !link.contains("://")) {
            n_links += 1;
            let (file, part) = link.split_once('#').unwrap_or((link, ""));
            let target = match file {
                "" => page.clone(),
                file => page.with_file_name(file),
            };
            assert!(target.exists(), "{}: {link}", page.display());
            if !part.is_empty() {
                let text = fs::read_to_string(&target).unwrap();
                let headings = text.lines().filter_map(|line| line.strip_prefix('#'));
                let mut anchors = headings.map(|heading| anchor(heading.trim_start_matches('#')));
                assert!(anchors.any(|a| a == part), "{}: {link}", page.display());
            }
        }
    }
    assert!(n_links > 20, "pages were not understood: {n_links} links");
}

#[test]
fn the_table_of_hybrid_astar_has_every_parameter() {
    let Some(root) = project() else { return };
    let page = fs::read_to_string(root.join("docs/src/hybrid-astar.md")).unwrap();
    let defaults = serde_json::to_value(HybridAstarConfig::default()).unwrap();
    let schema = schema_for!(HybridAstarConfig).to_value();
    let defaults = defaults.as_object().unwrap();
    for (key, default) in defaults {
        let limit = |which: &str| schema["properties"][key][which].as_f64().unwrap();
        let (low, high) = (limit("minimum"), limit("maximum"));
        let row = format!("| `{key}` | {default} | {low} to {high} |");
        assert!(page.contains(&row), "no row {row}");
    }
    let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
    assert_eq!(n_rows, defaults.len(), "rows without a parameter");
}

#[test]
fn the_table_of_smoothing_has_every_parameter() {
    let Some(root) = project() else { return };
    let page = fs::read_to_string(root.join("docs/src/smoothing.md")).unwrap();
    let defaults = serde_json::to_value(SmoothingConfig::default()).unwrap();
    let schema = schema_for!(SmoothingConfig).to_value();
    let defaults = defaults.as_object().unwrap();
    for (key, default) in defaults {
        let limit = |which: &str| schema["properties"][key][which].as_f64();
        let row = match (limit("minimum"), limit("maximum")) {
            (Some(low), Some(high)) => format!("| `{key}` | {default} | {low} to {high} |"),
            _ => format!("| `{key}` | {default} | \""),
        };
        assert!(page.contains(&row), "no row {row}");
    }
    let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
    assert_eq!(n_rows, defaults.len(), "rows without a parameter");
}

#[test]
fn both_readmes_show_the_same_program() {
    let Some(root) = project() else { return };
    let program = |folder: &str| {
        let text = fs::read_to_string(root.join(folder).join("README.md")).unwrap();
        let (_, rest) = text.split_once("```rust").unwrap();
        rest.split_once("```").unwrap().0.to_owned()
    };
    // That of the crate is compiled with its documentation.
    assert_eq!(program("."), program("crates/formicar"));
}
