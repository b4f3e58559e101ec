//! Every parameter of the planners of stores, with where its value comes from.

use crate::campaign::ConfigRecord;
use crate::papers::parameters::Origins;
use crate::report::{Block, Column, Field, Section, Source, Table, leaves};
use crate::tuning::ranges;
use formicar::numeric::counted;
use formicar::planner::{PlannerConfig, PlannerName};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Tables with more rows are opened by whoever wants to see them.
const MOST_OPEN: usize = 12;

const ABOUT: &str = "Every parameter of every configuration, as its runs were given it. Stated: by the \
    paper; read: from what the paper leaves open; chosen: ours, or the campaign's; tuned: found by \
    `formicar tune`, as its file holds it. A value that is not the preset's is neither stated nor \
    read. Ranges are those of the schema, in the unit that the name of a parameter ends with.";

/// The line of one parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Line {
    key: String,
    value: String,
    range: String,
    source: Source,
    note: String,
    /// The preset's value, where that is another one.
    preset: Option<String>,
}

/// The configurations of one planner.
struct Sheet<'a> {
    planner: String,
    names: Vec<&'a str>,
    /// Each line with the configurations that it holds for.
    lines: Vec<(Line, Vec<&'a str>)>,
}

/// The parameters of all configurations, those of one planner in one table; none where no
/// configuration is known.
pub fn parameter_section(configs: &[ConfigRecord]) -> Option<Section> {
    if configs.is_empty() {
        return None;
    }
    let (mut sheets, rivals) = sheets(configs);
    let mut blocks = vec![Block::Text(ABOUT.to_owned())];
    if !rivals.is_empty() {
        let names = rivals.join("`, `");
        let words = "programs of others, of which command and version stand under Provenance";
        blocks.push(Block::Text(format!("`{names}`: {words}.")));
    }
    blocks.extend(differences(&sheets));
    let shared = shared(&mut sheets);
    if !shared.is_empty() {
        let caption = format!(
            "All planners share {}.",
            sums(&shared.iter().collect::<Vec<_>>())
        );
        let lines = shared.iter().map(|line| (line, None));
        blocks.push(table("parameters shared", &caption, lines));
    }
    let also = match shared.len() {
        0 => "",
        _ => ", beside those that all share",
    };
    for sheet in sheets.iter().filter(|sheet| !sheet.lines.is_empty()) {
        blocks.push(sheet.table(also));
    }
    Some(Section {
        heading: "Parameters".to_owned(),
        blocks,
    })
}

/// A sheet for each planner, and the names of programs of others.
fn sheets(configs: &[ConfigRecord]) -> (Vec<Sheet<'_>>, Vec<&str>) {
    let (mut sheets, mut rivals) = (Vec::<Sheet>::new(), Vec::new());
    for config in configs {
        let name = config.name.as_str();
        let value: Value = serde_json::from_str(&config.json).unwrap_or_default();
        let Some(planner) = value["planner"].as_str() else {
            rivals.push(name);
            continue;
        };
        let place = sheets.iter().position(|sheet| sheet.planner == planner);
        let place = place.unwrap_or_else(|| {
            sheets.push(Sheet {
                planner: planner.to_owned(),
                names: Vec::new(),
                lines: Vec::new(),
            });
            sheets.len() - 1
        });
        sheets[place].names.push(name);
        for line in lines(planner, &value, &config.tuned) {
            sheets[place].add(line, name);
        }
    }
    (sheets, rivals)
}

/// The parameters of a configuration, each beside the preset of its planner.
fn lines(planner: &str, config: &Value, tuned: &[String]) -> Vec<Line> {
    let preset = preset(planner);
    let (origins, ranges) = (Origins::of(planner), ranges(config));
    let keys = leaves(config).into_iter();
    let keys = keys.filter(|(key, _)| key != "planner");
    let line = |(key, value): (String, String)| {
        let of_preset = preset.get(&key);
        let is_preset = of_preset == Some(&value);
        let (source, note) = if tuned.contains(&key) {
            (Source::Tuned, String::new())
        } else if is_preset {
            origins.of_key(&key)
        } else {
            (Source::Chosen, String::new())
        };
        let none = || "none".to_owned();
        Line {
            range: ranges.get(&key).cloned().unwrap_or_default(),
            preset: (!is_preset).then(|| of_preset.cloned().unwrap_or_else(none)),
            key,
            value,
            source,
            note,
        }
    };
    keys.map(line).collect()
}

/// The parameters that a planner has by itself; none of a planner that this version does not know.
fn preset(planner: &str) -> BTreeMap<String, String> {
    let known = planner.parse::<PlannerName>().ok();
    let config = known.and_then(|name| serde_json::to_value(PlannerConfig::of(name)).ok());
    config.map_or_else(BTreeMap::new, |config| {
        leaves(&config).into_iter().collect()
    })
}

/// The parameters that differ from their presets, in a table, or a sentence where none do.
fn differences(sheets: &[Sheet]) -> Option<Block> {
    if sheets.is_empty() {
        return None;
    }
    let lines = sheets.iter().flat_map(|sheet| &sheet.lines);
    let changed = lines.filter_map(|(line, names)| Some((line, names, line.preset.as_deref()?)));
    let columns: [Column<(&Line, &Vec<&str>, &str)>; 6] = [
        ("configuration", &|(_, names, _)| {
            Field::Words(names.join(", "))
        }),
        ("parameter", &|(line, ..)| {
            Field::Words(format!("`{}`", line.key))
        }),
        ("value", &|(line, ..)| Field::words(&line.value)),
        ("preset", &|(.., preset)| Field::words(preset)),
        ("range", &|(line, ..)| Field::words(&line.range)),
        ("origin", &|(line, ..)| Field::words(line.source.name())),
    ];
    let table = Table::of("parameters changed", changed, &columns)
        .captioned("What differs from the preset of the planner.");
    Some(if table.rows.is_empty() {
        Block::Text("No configuration differs from the preset of its planner.".to_owned())
    } else {
        Block::Table(table)
    })
}

/// Takes the parameters out of the sheets that are the same in all of them; none of one sheet.
fn shared(sheets: &mut [Sheet]) -> Vec<Line> {
    let Some((first, others)) = sheets.split_first() else {
        return Vec::new();
    };
    if others.is_empty() {
        return Vec::new();
    }
    let of_first = first.lines.iter().map(|(line, _)| line);
    let is_shared =
        |line: &&Line| first.is_of_all(line) && others.iter().all(|sheet| sheet.is_of_all(line));
    let shared: Vec<Line> = of_first.filter(is_shared).cloned().collect();
    for sheet in sheets {
        sheet.lines.retain(|(line, _)| !shared.contains(line));
    }
    shared
}

impl<'a> Sheet<'a> {
    /// Adds what is said of a parameter in a configuration, beside what others say of it.
    fn add(&mut self, line: Line, name: &'a str) {
        let same = self.lines.iter_mut().find(|(other, _)| *other == line);
        if let Some((_, names)) = same {
            names.push(name);
            return;
        }
        let last = self
            .lines
            .iter()
            .rposition(|(other, _)| other.key == line.key);
        let place = last.map_or(self.lines.len(), |last| last + 1);
        self.lines.insert(place, (line, vec![name]));
    }

    /// True if a line holds for all its configurations.
    fn is_of_all(&self, line: &Line) -> bool {
        let found = self.lines.iter().find(|(other, _)| other == line);
        found.is_some_and(|(_, names)| names.len() == self.names.len())
    }

    fn table(&self, also: &str) -> Block {
        let names = self.names.join("`, `");
        let who = if self.names == [self.planner.as_str()] {
            format!("`{names}`")
        } else {
            format!("`{names}` (planner `{}`)", self.planner)
        };
        let lines: Vec<&Line> = self.lines.iter().map(|(line, _)| line).collect();
        let sums = sums(&lines);
        let caption = format!("{who}: {sums}{also}.");
        let has_several = self.names.len() > 1;
        let lines = self.lines.iter().map(|(line, names)| {
            let of = if names.len() == self.names.len() {
                "all".to_owned()
            } else {
                names.join(", ")
            };
            (line, has_several.then_some(of))
        });
        table(&format!("parameters {}", self.planner), &caption, lines)
    }
}

/// The number of parameters, and of those of each origin.
fn sums(lines: &[&Line]) -> String {
    let keys: BTreeSet<&str> = lines.iter().map(|line| line.key.as_str()).collect();
    let sources = [Source::Stated, Source::Read, Source::Chosen, Source::Tuned];
    let told = sources.into_iter().filter_map(|source| {
        let n = lines.iter().filter(|line| line.source == source).count();
        (n > 0).then(|| format!("{n} {}", source.name()))
    });
    let told: Vec<String> = told.collect();
    let values = match lines.len() - keys.len() {
        0 => String::new(),
        _ => format!(" with {}", counted(lines.len(), "value")),
    };
    let n_parameters = counted(keys.len(), "parameter");
    format!("{n_parameters}{values} ({})", told.join(", "))
}

/// Parameters as a table, with whom each line is of where that is told.
fn table<'a>(
    key: &str,
    caption: &str,
    lines: impl Iterator<Item = (&'a Line, Option<String>)>,
) -> Block {
    let lines: Vec<_> = lines.collect();
    let with_names = lines.iter().any(|(_, of)| of.is_some());
    let with_reasons = lines.iter().any(|(line, _)| !line.why().is_empty());
    let mut heading = vec!["parameter", "value", "range", "origin"];
    if with_names {
        heading.insert(1, "of");
    }
    if with_reasons {
        heading.push("where, or why");
    }
    let mut table = Table::new(key, &heading).captioned(caption);
    table.is_folded = lines.len() > MOST_OPEN;
    for (line, of) in lines {
        let mut row = vec![
            Field::Words(format!("`{}`", line.key)),
            Field::words(&line.value),
            Field::words(&line.range),
            Field::words(line.source.name()),
        ];
        if let Some(of) = of {
            row.insert(1, Field::Words(of));
        }
        if with_reasons {
            row.push(Field::Words(line.why()));
        }
        table.row(row);
    }
    Block::Table(table)
}

impl Line {
    fn why(&self) -> String {
        match &self.preset {
            Some(preset) => format!("the preset has {preset}"),
            None => self.note.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Report, markdown};
    use formicar::planner::HybridAstarParameters;

    fn config(name: &str, planner: PlannerName, change: fn(&mut PlannerConfig)) -> ConfigRecord {
        let mut config = PlannerConfig::of(planner);
        change(&mut config);
        ConfigRecord::new(name, &config).unwrap()
    }

    fn text(configs: &[ConfigRecord]) -> String {
        let sections = parameter_section(configs).into_iter().collect();
        markdown(&Report {
            sections,
            ..Report::default()
        })
    }

    #[test]
    fn origins_of_the_paper_hold_for_its_values_alone() {
        let configs = [
            config("lei2020", PlannerName::Lei2020, |_| {}),
            config("few", PlannerName::Lei2020, |c| {
                c.colony_mut().unwrap().colony.n_ants = 7;
            }),
        ];
        let text = text(&configs);
        for line in [
            "| few | `colony.n_ants` | 7 | 500 |",
            "| `colony.n_ants` | lei2020 | 500 | 1 to ",
            " | stated | sec. IV.B, map 1; 1000 on maps 2 and 3 |\n| `colony.n_ants` | few | 7 |",
            " | chosen | the preset has 500 |",
            "| `colony.alpha` | all | 1.0 |",
            "`lei2020`, `few` (planner `lei2020`): ",
        ] {
            assert!(text.contains(line), "no {line} in {text}");
        }
        assert_eq!(text.matches("`colony.alpha`").count(), 1);
        let row = text
            .lines()
            .find(|line| line.contains("`colony.n_ants` | few"));
        assert!(!row.unwrap().contains("stated"), "{row:?}");
    }

    #[test]
    fn what_a_tuning_found_is_tuned() {
        let mut tuned = config("t", PlannerName::HybridAstar, |c| {
            let parameters = c.family_mut::<HybridAstarParameters>();
            parameters.unwrap().hybrid_astar.weight = 3.0;
        });
        tuned.tuned = vec!["hybrid_astar.weight".to_owned()];
        let text = text(&[tuned, config("h", PlannerName::HybridAstar, |_| {})]);
        let row = text
            .lines()
            .find(|l| l.starts_with("| t | `hybrid_astar.weight` | 3.0 |"));
        assert!(row.unwrap().ends_with("| tuned |"), "{text}");
        let sums = " 17 parameters with 18 values (17 chosen, 1 tuned).";
        assert!(text.contains(sums), "{text}");
    }

    #[test]
    fn what_planners_share_is_told_once() {
        let plain = |planner: PlannerName| config(planner.name(), planner, |_| {});
        let rival = ConfigRecord::of_json("ompl", "{\"command\": [\"x\"]}".to_owned());
        let configs = [
            plain(PlannerName::Astar),
            plain(PlannerName::ImprovedAstar),
            rival,
        ];
        let text = text(&configs);
        assert_eq!(text.matches("`smoothing.corner_radii`").count(), 1);
        assert!(
            text.contains("No configuration differs from the preset"),
            "{text}"
        );
        assert!(text.contains("All planners share "), "{text}");
        assert!(text.contains(", beside those that all share."), "{text}");
        assert!(text.contains("`ompl`: programs of others"), "{text}");
        assert_eq!(parameter_section(&[]), None);
    }
}
