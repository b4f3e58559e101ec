//! Pages that must keep step with the code: links, tables that are not made of the list of
//! parameters, the first example.

use formicar::layers::{LayersConfig, MAX_EXPANSION_CELLS};
use formicar::planner::{PlannerConfig, PlannerName};
use formicar::tracking::{
    Actuators, MpcParameters, PurePursuit, RegulatedPurePursuit, Stanley, StartOffset,
    TrackingConfig,
};
use schemars::schema_for;
use serde_json::Value;
use std::collections::BTreeMap;
use std::f64::consts::PI;
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
    let folders = [
        ".",
        "docs/src",
        "docs/src/planners",
        "docs/src/rules",
        "crates/formicar",
    ];
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
fn the_table_of_layers_has_every_parameter() {
    let Some(root) = project() else { return };
    let page = fs::read_to_string(root.join("docs/src/layers.md")).unwrap();
    let defaults = serde_json::to_value(LayersConfig::default()).unwrap();
    let defaults = defaults.as_object().unwrap();
    for (key, default) in defaults {
        let row = format!("| `{key}` | `{}` |", default.as_str().unwrap());
        assert!(page.contains(&row), "no row {row}");
    }
    let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
    assert_eq!(n_rows, defaults.len(), "rows without a parameter");
    assert!(page.contains(&format!("n in 0 to {MAX_EXPANSION_CELLS}")));
}

/// A value as pages write it: words in backticks.
fn cell(value: &Value) -> String {
    let word = value.as_str().map(|word| format!("`{word}`"));
    word.unwrap_or_else(|| value.to_string())
}

/// Dotted keys of a document with their values.
fn flat(value: &Value) -> BTreeMap<String, Value> {
    let Some(table) = value.as_object() else {
        return BTreeMap::from([(String::new(), value.clone())]);
    };
    let inner = table.iter().flat_map(|(key, value)| {
        let entries = flat(value).into_iter();
        entries.map(move |(rest, value)| match rest.as_str() {
            "" => (key.clone(), value),
            rest => (format!("{key}.{rest}"), value),
        })
    });
    inner.collect()
}

/// Rows for the keys in which a planner differs from another one; those of the other come first.
fn differences(base: &Value, own: &Value) -> Vec<String> {
    let (base, own) = (flat(base), flat(own));
    let keys = base
        .keys()
        .chain(own.keys().filter(|&k| !base.contains_key(k)));
    let text = |value: Option<&Value>| value.map_or("-".to_owned(), cell);
    let row = |key: &String| {
        format!(
            "| `{key}` | {} | {}",
            text(base.get(key)),
            text(own.get(key))
        )
    };
    keys.filter(|&k| base.get(k) != own.get(k))
        .map(row)
        .collect()
}

#[test]
fn every_variant_has_a_page_that_tells_how_it_differs() {
    let Some(root) = project() else { return };
    let summary = fs::read_to_string(root.join("docs/src/SUMMARY.md")).unwrap();
    let parameters = |planner| {
        let mut all = serde_json::to_value(PlannerConfig::of(planner)).unwrap();
        all.as_object_mut().unwrap().remove("planner");
        all
    };
    let mut n_variants = 0;
    for planner in PlannerName::ALL {
        let base = match planner {
            PlannerName::Zhang2016 | PlannerName::Joshy2016 => PlannerName::Wang2019,
            PlannerName::Acof => PlannerName::Aco,
            PlannerName::Aga => PlannerName::Ga,
            _ if planner.colony().is_some() => PlannerName::AntSystem,
            _ => continue,
        };
        n_variants += 1;
        let file = format!("planners/{}.md", planner.name());
        assert!(summary.contains(&format!("]({file})")), "{file}");
        if planner == base {
            continue;
        }
        let page = fs::read_to_string(root.join("docs/src").join(&file)).unwrap();
        let [mut base, mut own] = [base, planner].map(parameters);
        if planner == PlannerName::Aga {
            [base, own] = [base, own].map(|all| all["evolution"].clone());
        }
        let differing = differences(&base, &own);
        for row in &differing {
            assert!(page.contains(row), "{file}: no row {row}");
        }
        let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
        assert_eq!(n_rows, differing.len(), "{file}: stray rows");
    }
    assert!(n_variants > 1);
}

#[test]
fn the_table_of_tracking_has_every_parameter() {
    let Some(root) = project() else { return };
    let page = fs::read_to_string(root.join("docs/src/tracking.md")).unwrap();
    let number = |value: f64| match value {
        PI => "pi".to_owned(),
        value if value == -PI => "-pi".to_owned(),
        value => value.to_string(),
    };
    let mut n_parameters = 0;
    for schema in [
        schema_for!(TrackingConfig),
        schema_for!(StartOffset),
        schema_for!(PurePursuit),
        schema_for!(Stanley),
        schema_for!(Actuators),
        schema_for!(RegulatedPurePursuit),
        schema_for!(MpcParameters),
    ] {
        for (key, of_key) in schema.to_value()["properties"].as_object().unwrap() {
            let row = page
                .lines()
                .find(|l| l.starts_with(&format!("| `{key}` |")));
            let row = row.unwrap_or_else(|| panic!("no row of {key}"));
            let limit = |which: &str| of_key[which].as_f64().map(number);
            if let (Some(low), Some(high)) = (limit("minimum"), limit("maximum")) {
                assert!(row.contains(&format!("| {low} to {high} |")), "{row}");
            }
            n_parameters += 1;
        }
    }
    let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
    assert_eq!(n_rows, n_parameters, "rows without a parameter");
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
