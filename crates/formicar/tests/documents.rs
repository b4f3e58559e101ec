//! Pages that must keep step with the code: links, the table of parameters, the first example.

use formicar::colony::chord::ChordConfig;
use formicar::colony::drive::DriveConfig;
use formicar::colony::{
    ColonyConfig, corridor, dead_end, deposit, evaporation, heuristic, initial, limits, transition,
};
use formicar::evolution::EvolutionConfig;
use formicar::layers::{LayersConfig, MAX_EXPANSION_CELLS};
use formicar::objective::DriveCost;
use formicar::planner::{HybridAstarConfig, ImprovedAstarConfig, PlannerConfig, PlannerName};
use formicar::smoothing::{ImproveConfig, SmoothingConfig};
use formicar::tracking::{PurePursuit, Stanley, StartOffset, TrackingConfig};
use schemars::{JsonSchema, schema_for};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
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
fn the_table_of_hybrid_astar_has_every_parameter() {
    let Some(root) = project() else { return };
    let page = fs::read_to_string(root.join("docs/src/hybrid-astar.md")).unwrap();
    let defaults = serde_json::to_value(HybridAstarConfig::default()).unwrap();
    let schema = schema_for!(HybridAstarConfig).to_value();
    let defaults = defaults.as_object().unwrap();
    for (key, default) in defaults {
        let limit = |which: &str| schema["properties"][key][which].as_f64().unwrap();
        let (low, high) = (limit("minimum"), limit("maximum"));
        let row = format!("| `{key}` | {default} | {low} to {high} ");
        assert!(page.contains(&row), "no row {row}");
    }
    let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
    assert_eq!(n_rows, defaults.len(), "rows without a parameter");
}

/// The rows of a table of parameters: keys of inner sections behind their section's name.
fn rows(defaults: &Value, schema: &Value, before: &str) -> Vec<String> {
    let fields = defaults.as_object().unwrap().iter();
    let row = |(key, default): (&String, &Value)| {
        let field = &schema["properties"][key];
        if default.is_object() {
            let name = field["$ref"].as_str().unwrap().rsplit('/').next().unwrap();
            let inner = &schema["$defs"][name];
            return rows(default, inner, &format!("{key}."));
        }
        let limit = |which: &str| field[which].as_f64();
        let start = format!("| `{before}{key}` | {} |", cell(default));
        match (limit("minimum"), limit("maximum")) {
            (Some(low), Some(high)) => vec![format!("{start} {low} to {high} ")],
            _ => vec![start],
        }
    };
    fields.flat_map(row).collect()
}

#[test]
fn the_tables_of_the_default_planner_have_every_parameter() {
    let Some(root) = project() else { return };
    let page = fs::read_to_string(root.join("docs/src/formicar.md")).unwrap();
    let mut wanted = Vec::new();
    let drive = serde_json::to_value(DriveConfig::default()).unwrap();
    let cost = serde_json::to_value(DriveCost::default()).unwrap();
    let schema = |schema: schemars::Schema, value: Value| rows(&value, &schema.to_value(), "");
    wanted.extend(schema(schema_for!(DriveConfig), drive));
    wanted.extend(schema(schema_for!(DriveCost), cost));
    let improve = serde_json::to_value(ImproveConfig::default()).unwrap();
    wanted.extend(schema(schema_for!(ImproveConfig), improve));
    for row in &wanted {
        assert!(page.contains(row), "no row {row}");
    }
    let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
    assert_eq!(n_rows, wanted.len(), "rows without a parameter");
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
            (Some(low), Some(high)) => format!("| `{key}` | {default} | {low} to {high} "),
            _ => format!("| `{key}` | {} | `", cell(default)),
        };
        assert!(page.contains(&row), "no row {row}");
    }
    let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
    assert_eq!(n_rows, defaults.len(), "rows without a parameter");
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

/// What stands below the heading that is a rule's name.
fn section<'a>(page: &'a str, rule: &str) -> Option<&'a str> {
    let heading = format!("# `{rule}`\n");
    let (_, rest) = page.split_once(&heading)?;
    rest.split("\n#").next()
}

/// Each rule of a slot with its defaults, the name aside, as the schema and serde know them.
fn rules_of<R: JsonSchema + Serialize + DeserializeOwned>() -> Vec<(String, Vec<(String, Value)>)> {
    let schema = schema_for!(R).to_value();
    let variants = schema["oneOf"].as_array().unwrap().clone();
    let rule = |variant: Value| {
        let name = variant["properties"]["rule"]["const"].as_str().unwrap();
        let default: R = serde_json::from_value(json!({ "rule": name })).unwrap();
        let mut defaults = serde_json::to_value(default).unwrap();
        let defaults = defaults.as_object_mut().unwrap();
        defaults.remove("rule");
        (name.to_owned(), defaults.clone().into_iter().collect())
    };
    variants.into_iter().map(rule).collect()
}

fn compare_rules<R: JsonSchema + Serialize + DeserializeOwned>(root: &Path, slot: &str) {
    let file = root.join(format!("docs/src/rules/{slot}.md"));
    let page = fs::read_to_string(&file).unwrap();
    let rules = rules_of::<R>();
    assert!(rules.len() > 1, "{slot}: the schema was not understood");
    for (rule, defaults) in rules {
        if rule == "none" && defaults.is_empty() {
            assert!(page.contains("`none`"), "{slot}: none is not named");
            continue;
        }
        let text = section(&page, &rule).unwrap_or_else(|| panic!("{slot}: no section {rule}"));
        for (key, default) in &defaults {
            let row = format!("| `{key}` | {} |", cell(default));
            assert!(text.contains(&row), "{slot}, {rule}: no row {row}");
        }
        let n_rows = text.lines().filter(|l| l.starts_with("| `")).count();
        assert_eq!(n_rows, defaults.len(), "{slot}, {rule}: stray rows");
    }
}

#[test]
fn the_pages_of_rules_have_every_rule_and_parameter() {
    let Some(root) = project() else { return };
    compare_rules::<heuristic::Visibility>(&root, "heuristic");
    compare_rules::<heuristic::Guidance>(&root, "heuristic");
    compare_rules::<corridor::Corridor>(&root, "corridor");
    compare_rules::<initial::InitialPheromone>(&root, "initial-pheromone");
    compare_rules::<transition::Transition>(&root, "transition");
    compare_rules::<dead_end::DeadEnd>(&root, "dead-ends");
    compare_rules::<evaporation::Evaporation>(&root, "evaporation");
    compare_rules::<deposit::Deposit>(&root, "deposit");
    compare_rules::<limits::PheromoneLimits>(&root, "limits");
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

#[test]
fn the_page_of_the_engine_has_every_parameter_without_a_slot() {
    let Some(root) = project() else { return };
    let page = fs::read_to_string(root.join("docs/src/ant-colonies.md")).unwrap();
    let all = serde_json::to_value(ColonyConfig::default()).unwrap();
    let mut all = all.as_object().unwrap().clone();
    all.retain(|_, value| value.get("rule").is_none());
    let defaults = flat(&Value::Object(all));
    assert!(defaults.len() > 10);
    for (key, default) in defaults {
        let row = format!("| `{key}` | {} |", cell(&default));
        assert!(page.contains(&row), "no row {row}");
    }
}

#[test]
fn the_page_of_ants_that_steer_has_every_parameter() {
    let Some(root) = project() else { return };
    let page = fs::read_to_string(root.join("docs/src/chords.md")).unwrap();
    let defaults = flat(&serde_json::to_value(ChordConfig::default()).unwrap());
    for (key, default) in &defaults {
        let row = format!("| `{key}` | {} |", cell(default));
        assert!(page.contains(&row), "no row {row}");
    }
    let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
    assert_eq!(n_rows, defaults.len(), "rows without a parameter");
}

#[test]
fn every_colony_has_a_page_that_tells_how_it_differs() {
    let Some(root) = project() else { return };
    let summary = fs::read_to_string(root.join("docs/src/SUMMARY.md")).unwrap();
    let mut n_colonies = 0;
    for planner in PlannerName::ALL {
        if planner.colony().is_none() {
            continue;
        }
        n_colonies += 1;
        let file = format!("planners/{}.md", planner.name());
        assert!(summary.contains(&format!("]({file})")), "{file}");
        let page = fs::read_to_string(root.join("docs/src").join(&file)).unwrap();
        let base = match planner {
            PlannerName::AntSystem => continue,
            PlannerName::Zhang2016 | PlannerName::Joshy2016 => PlannerName::Wang2019,
            PlannerName::Acof => PlannerName::Aco,
            _ => PlannerName::AntSystem,
        };
        let [base, own] = [base, planner].map(|planner| {
            let mut all = serde_json::to_value(PlannerConfig::of(planner)).unwrap();
            all.as_object_mut().unwrap().remove("planner");
            flat(&all)
        });
        let keys = base
            .keys()
            .chain(own.keys().filter(|&k| !base.contains_key(k)));
        let differing: Vec<&String> = keys.filter(|&k| base.get(k) != own.get(k)).collect();
        let text = |value: Option<&Value>| value.map_or("-".to_owned(), cell);
        for key in &differing {
            let row = format!(
                "| `{key}` | {} | {} |",
                text(base.get(*key)),
                text(own.get(*key))
            );
            assert!(page.contains(&row), "{file}: no row {row}");
        }
        let n_rows = page.lines().filter(|l| l.starts_with("| `")).count();
        assert_eq!(n_rows, differing.len(), "{file}: stray rows");
    }
    assert!(n_colonies > 0);
}

#[test]
fn the_pages_of_improved_astar_and_of_populations_have_every_parameter() {
    let Some(root) = project() else { return };
    let rows_of = |name: &str, n_cells: usize| {
        let page = fs::read_to_string(root.join(format!("docs/src/planners/{name}.md"))).unwrap();
        let rows = page.lines().filter(|l| l.starts_with("| `"));
        let cells = rows.map(|row| row.split(" | ").take(n_cells).collect::<Vec<_>>());
        let cut = |cells: Vec<&str>| format!("{} |", cells.join(" | ").trim_end_matches(" |"));
        cells.map(cut).collect::<Vec<_>>()
    };
    let schema = schema_for!(ImprovedAstarConfig).to_value();
    let improved = serde_json::to_value(ImprovedAstarConfig::default()).unwrap();
    let rows = flat(&improved).into_iter().map(|(key, value)| {
        let limit = |which: &str| schema["properties"][&key][which].as_f64().unwrap();
        let (low, high) = (limit("minimum"), limit("maximum"));
        format!("| `{key}` | {value} | {low} to {high} |")
    });
    assert_eq!(rows_of("improved-astar", 3), rows.collect::<Vec<_>>());
    let sorted = |mut rows: Vec<String>| {
        rows.sort();
        rows
    };
    let [ga, aga] = [EvolutionConfig::ga(), EvolutionConfig::aga()]
        .map(|config| flat(&serde_json::to_value(config).unwrap()));
    let number = |value: &Value| match value.as_f64() {
        Some(number) if value.is_f64() => {
            let text = number.to_string();
            if text.contains('.') {
                text
            } else {
                format!("{text}.0")
            }
        }
        _ => cell(value),
    };
    let rows = ga
        .iter()
        .map(|(key, value)| format!("| `{key}` | {} |", number(value)));
    assert_eq!(sorted(rows_of("ga", 2)), sorted(rows.collect()));
    let text = |value: Option<&Value>| value.map_or("-".to_owned(), number);
    let differing = aga
        .iter()
        .filter(|(key, value)| ga.get(*key) != Some(value));
    let rows = differing.map(|(key, value)| {
        let of_ga = text(ga.get(key));
        format!("| `{key}` | {of_ga} | {} |", number(value))
    });
    assert_eq!(sorted(rows_of("aga", 3)), sorted(rows.collect()));
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
