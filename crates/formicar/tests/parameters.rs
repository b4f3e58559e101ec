//! The list of parameters, and the tables of the book that are made of it.
//!
//! A table stands below a mark such as `<!-- parameters: drive of formicar -->`: the parameters of
//! a section with the values of a planner. `UPDATE_BOOK=1 cargo test -p formicar tables` writes the
//! tables anew.

use formicar::parameters::{Kind, Parameter};
use formicar::planner::{PlannerConfig, PlannerName};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn of<'a>(parameters: &'a [Parameter], key: &str) -> Vec<&'a Parameter> {
    let all = parameters.iter();
    all.filter(|parameter| parameter.key == key).collect()
}

fn document(planner: PlannerName) -> Value {
    serde_json::to_value(PlannerConfig::of(planner)).unwrap()
}

#[test]
fn the_list_tells_of_numbers_and_words() {
    let all = PlannerConfig::parameters();
    let weight = of(&all, "hybrid_astar.weight")[0];
    assert_eq!(weight.kind, Kind::Number);
    assert_eq!(weight.allowed(), "1 to 10");
    assert_eq!(weight.default, 1.5);
    let margin = of(&all, "smoothing.arc_margin_m")[0];
    assert_eq!(margin.unit.as_deref(), Some("m"));
    let wish = of(&all, "cost.clearance_wish_widths")[0];
    assert!(wish.about.contains("clearance"), "{}", wish.about);
    let corners = of(&all, "smoothing.corners")[0];
    assert_eq!(corners.kind, Kind::Word);
    assert!(corners.allowed().contains("wide-arcs"));
    assert_eq!(of(&all, "colony.n_ants")[0].kind, Kind::Integer);
    assert_eq!(
        of(&all, "colony.stopping.target_cost")[0].allowed(),
        "at least 0"
    );
    let growths = of(&all, "chords.growth_radii")[0];
    assert_eq!(
        (growths.kind, growths.allowed().as_str()),
        (Kind::List, "0 to 10")
    );
    assert_eq!(of(&all, "layers.expansion.cells")[0].allowed(), "0 to 64");
    assert_eq!(of(&all, "colony.evaporation.rule")[0].words.len(), 4);
    assert!(
        of(&all, "cost.turn_factor").is_empty(),
        "no key of documents"
    );
}

#[test]
fn a_parameter_of_a_rule_belongs_to_documents_with_that_rule() {
    let all = PlannerConfig::parameters();
    let lei2020 = document(PlannerName::Lei2020);
    let lambda = of(&all, "colony.evaporation.lambda")[0];
    assert_eq!(lambda.value_in(&lei2020), Some(&Value::from(10.0)));
    let shares = of(&all, "colony.evaporation.rho");
    assert_eq!(shares.len(), 3, "one of each rule that has it");
    for share in shares {
        assert!(share.value_in(&lei2020).is_none());
        assert!(share.default.is_number());
    }
}

#[test]
fn every_number_says_what_it_may_be() {
    /// Counts that may be as large as they like.
    const ANY: [&str; 3] = ["max_steps", "stall_iterations", "stall_generations"];
    for parameter in PlannerConfig::parameters() {
        let is_number = matches!(parameter.kind, Kind::Number | Kind::Integer);
        let is_any = ANY.iter().any(|name| parameter.key.ends_with(name));
        if is_number && !is_any {
            assert!(!parameter.allowed().is_empty(), "{}", parameter.key);
        }
    }
}

#[test]
fn the_tables_of_the_book_are_those_of_the_code() {
    let Some(folder) = book() else { return };
    let parameters = PlannerConfig::parameters();
    let (mut shown, mut stale) = (BTreeSet::new(), Vec::new());
    for page in pages(&folder) {
        let text = fs::read_to_string(&page).unwrap();
        let (fresh, keys) = renewed(&text, &parameters);
        shown.extend(keys);
        if fresh == text {
            continue;
        }
        if std::env::var_os("UPDATE_BOOK").is_some() {
            fs::write(&page, &fresh).unwrap();
        } else {
            stale.push(page);
        }
    }
    let hint = "hint: UPDATE_BOOK=1 cargo test -p formicar tables";
    assert!(stale.is_empty(), "not those of the code: {stale:?}; {hint}");
    // Pages of rules name the rules of a colony in headings.
    let in_headings = |p: &Parameter| p.is_slot() && p.key.starts_with("colony.");
    let missing = parameters.iter().filter(|p| !in_headings(p)).filter(|p| {
        let of_cells = p.key.replacen("chords.", "colony.", 1);
        let is_elsewhere = ELSEWHERE.iter().any(|section| p.key.starts_with(section));
        !(is_elsewhere || shown.contains(&p.key) || shown.contains(&of_cells))
    });
    let missing: Vec<&String> = missing.map(|p| &p.key).collect();
    assert!(missing.is_empty(), "in no table: {missing:?}");
}

/// The page of rules for each slot of a colony.
const PAGES: [(&str, &str); 9] = [
    ("visibility", "heuristic"),
    ("guidance", "heuristic"),
    ("corridor", "corridor"),
    ("initial", "initial-pheromone"),
    ("transition", "transition"),
    ("dead_end", "dead-ends"),
    ("evaporation", "evaporation"),
    ("deposit", "deposit"),
    ("limits", "limits"),
];

#[test]
fn every_rule_of_a_colony_has_a_heading() {
    let Some(folder) = book() else { return };
    let parameters = PlannerConfig::parameters();
    for (slot, page) in PAGES {
        let text = fs::read_to_string(folder.join(format!("rules/{page}.md"))).unwrap();
        let rules = &of(&parameters, &format!("colony.{slot}.rule"))[0].words;
        assert!(rules.len() > 1, "{slot}");
        for rule in rules {
            let is_named = text.contains(&format!("# `{rule}`\n"));
            let is_none = rule == "none" && text.contains("`none`");
            assert!(is_named || is_none, "{page}: {rule}");
        }
    }
}

/// Parameters that pages explain in words or beside those of another planner.
const ELSEWHERE: [&str; 4] = ["planner", "layers.", "grid_search.", "evolution.initial."];

/// The sources of the book; none where the crate was published without it.
fn book() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src");
    folder.join("SUMMARY.md").exists().then_some(folder)
}

/// All pages in a folder and the folders in it.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let pages = paths.flat_map(|path| {
        if path.is_dir() {
            pages(&path)
        } else {
            vec![path]
        }
    });
    pages
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect()
}

/// A page with its tables made anew, and the keys in them.
fn renewed(page: &str, parameters: &[Parameter]) -> (String, Vec<String>) {
    let (mut fresh, mut keys) = (String::new(), Vec::new());
    let mut lines = page.lines().peekable();
    while let Some(line) = lines.next() {
        fresh.push_str(line);
        fresh.push('\n');
        let Some(mark) = line.strip_prefix("<!-- parameters: ") else {
            continue;
        };
        let mut old = Vec::new();
        while lines.next_if(|row| row.is_empty()).is_some() {}
        while let Some(row) = lines.next_if(|row| row.starts_with('|')) {
            old.extend(row.split('`').nth(1).map(str::to_owned));
        }
        let table = Table::of(mark.trim_end_matches(" -->"), parameters);
        fresh.push_str(&table.markdown(&old));
        keys.extend(table.rows.into_iter().map(|row| row.key));
    }
    (fresh, keys)
}

/// A table of parameters: their keys begin with that of a section.
struct Table {
    section: String,
    rows: Vec<Row>,
}

struct Row {
    key: String,
    default: Value,
    allowed: String,
    about: String,
}

impl Table {
    /// The table that a mark asks for: `SECTION of PLANNER` for a section with a planner's values,
    /// `SECTION outside of rules of PLANNER`, or `SECTION as RULE` for the parameters of a rule.
    fn of(mark: &str, parameters: &[Parameter]) -> Self {
        let row = |parameter: &Parameter, default: &Value| Row {
            key: parameter.key.clone(),
            default: default.clone(),
            allowed: allowed(parameter),
            about: about(&parameter.about),
        };
        let rows = |section: &str, take: &dyn Fn(&Parameter) -> Option<Row>| {
            let within = format!("{section}.");
            let inside = parameters.iter().filter(|p| p.key.starts_with(&within));
            Self {
                section: within.clone(),
                rows: inside.filter_map(take).collect(),
            }
        };
        if let Some((section, rule)) = mark.split_once(" as ") {
            let slot = (format!("{section}.rule"), rule.to_owned());
            return rows(section, &|p| {
                p.rules.contains(&slot).then(|| row(p, &p.default))
            });
        }
        let (section, planner) = mark.rsplit_once(" of ").expect("a section of a planner");
        let document = document(planner.parse().expect("a planner"));
        let is_slot = |p: &Parameter| !p.rules.is_empty() || p.is_slot();
        match section.strip_suffix(" outside of rules") {
            Some(section) => rows(section, &|p| {
                let value = p.value_in(&document).filter(|_| !is_slot(p))?;
                Some(row(p, value))
            }),
            None => rows(section, &|p| Some(row(p, p.value_in(&document)?))),
        }
    }

    /// The table in the order of the old keys, further ones behind.
    fn markdown(&self, old: &[String]) -> String {
        let place = |row: &&Row| {
            let key = &row.key[self.section.len()..];
            old.iter().position(|old| old == key).unwrap_or(old.len())
        };
        let mut rows: Vec<&Row> = self.rows.iter().collect();
        rows.sort_by_key(place);
        let lines = rows.iter().map(|row| {
            let key = &row.key[self.section.len()..];
            let default = word(&row.default);
            format!(
                "| `{key}` | {default} | {} | {} |\n",
                row.allowed, row.about
            )
        });
        let head = "\n| key | default | allowed | meaning |\n|---|---|---|---|\n".to_owned();
        head + &lines.collect::<String>()
    }
}

fn word(value: &Value) -> String {
    let text = value.as_str().map(|text| format!("`{text}`"));
    text.unwrap_or_else(|| value.to_string())
}

fn allowed(parameter: &Parameter) -> String {
    let words = parameter.words.iter().map(|word| format!("`{word}`"));
    match (parameter.range, &parameter.unit) {
        (Some(_), Some(unit)) => format!("{} {unit}", parameter.allowed()),
        (Some(_), None) => parameter.allowed(),
        (None, _) => words.collect::<Vec<_>>().join(", "),
    }
}

/// The first paragraph of a description as a cell: links to items become their names.
fn about(description: &str) -> String {
    let paragraph = description.split("\n\n").next().unwrap_or_default();
    let text = paragraph
        .replace('\n', " ")
        .replace("[`", "`")
        .replace("`]", "`");
    let text = text.replace('|', "\\|").replace('*', "\\*");
    text.trim_end_matches('.').to_owned()
}
