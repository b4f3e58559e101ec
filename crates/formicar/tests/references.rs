//! The tables of `references/` and the presets say the same.

use formicar::planner::{PlannerConfig, PlannerName};
use serde_json::Value;
use std::collections::BTreeMap;

const PAGES: [&str; 3] = [
    include_str!("../references/lei2020.md"),
    include_str!("../references/wang2019.md"),
    include_str!("../references/li2024.md"),
];
const ORIGINS: [&str; 3] = ["stated", "read", "chosen"];

/// Parameters of a planner by dotted key, as JSON; its name aside.
fn parameters(planner: PlannerName) -> BTreeMap<String, String> {
    let config = serde_json::to_value(PlannerConfig::of(planner)).expect("a document");
    let mut parameters = BTreeMap::new();
    flatten("", &config, &mut parameters);
    parameters.remove("planner");
    parameters
}

fn flatten(prefix: &str, value: &Value, into: &mut BTreeMap<String, String>) {
    let Value::Object(table) = value else {
        into.insert(prefix.to_owned(), value.to_string());
        return;
    };
    for (key, value) in table {
        let dot = if prefix.is_empty() { "" } else { "." };
        flatten(&format!("{prefix}{dot}{key}"), value, into);
    }
}

/// The rows of the table below a heading, up to the next heading: key and value.
fn table(heading: &str) -> BTreeMap<String, String> {
    let page = PAGES.iter().find(|page| page.contains(heading));
    let page = page.unwrap_or_else(|| panic!("no page has {heading:?}"));
    let (_, rest) = page.split_once(heading).expect("it was found");
    let section = rest.split("\n#").next().unwrap_or_default();
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let fields: Vec<&str> = row.split('|').map(str::trim).collect();
        assert!(ORIGINS.contains(&fields[3]), "{row}");
        assert!(!fields[4].is_empty(), "{row}: where from?");
        let bare = |field: &str| field.trim_matches('`').to_owned();
        (bare(fields[1]), bare(fields[2]))
    })
    .collect()
}

#[test]
fn every_parameter_of_a_paper_is_in_its_table() {
    for planner in [
        PlannerName::Lei2020,
        PlannerName::Wang2019,
        PlannerName::Faco2024,
    ] {
        let heading = format!("## Parameters of `{}`\n", planner.name());
        assert_eq!(table(&heading), parameters(planner), "{heading}");
    }
}

#[test]
fn every_difference_between_presets_is_in_a_table() {
    for (planner, base) in [
        (PlannerName::AntSystem, PlannerName::Lei2020),
        (PlannerName::Elitist, PlannerName::AntSystem),
        (PlannerName::MaxMin, PlannerName::AntSystem),
        (PlannerName::Zhang2016, PlannerName::Wang2019),
        (PlannerName::Joshy2016, PlannerName::Wang2019),
        (PlannerName::Aco, PlannerName::AntSystem),
        (PlannerName::Acof, PlannerName::Aco),
    ] {
        let base_parameters = parameters(base);
        let mut differences = parameters(planner);
        differences.retain(|key, value| base_parameters.get(key) != Some(value));
        let heading = format!("### `{}`, from `{}`\n", planner.name(), base.name());
        assert_eq!(table(&heading), differences, "{heading}");
    }
}
